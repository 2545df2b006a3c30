//! Signals of the system that would end the program without a word.

/// Lets a write beyond the largest size of a file (`ulimit -f`, a quota of a batch system) be an error as that of a full disk,
/// where by default its signal ends the program. Called first, so that all threads follow.
#[cfg(unix)]
pub(super) fn hold_back() {
    use nix::sys::signal::{SigSet, Signal};
    let mut signals = SigSet::empty();
    signals.add(Signal::SIGXFSZ);
    // Where it cannot be held back it does what it always does.
    let _ = signals.thread_block();
}

#[cfg(not(unix))]
pub(super) fn hold_back() {}
