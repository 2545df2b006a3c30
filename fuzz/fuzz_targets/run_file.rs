//! Any bytes as a result that carries its run, and as a run file, up to the arguments of the command.
#![no_main]

use gaitc::cli::run::check;
use gaitc::provenance::find;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Some(found) = find(bytes) {
        assert!(found.get("run").is_some());
    }
    if let Some(Err(message)) = std::str::from_utf8(bytes).ok().map(check) {
        assert!(!message.is_empty());
    }
});
