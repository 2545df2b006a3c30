//! A request to stop: looked at before every step of an integration, and by what runs many of them.

use core::sync::atomic::{AtomicBool, Ordering};

/// Set from outside (another thread, a signal handler) to end a piece of work early. Copies share the request; the default can
/// never be set.
#[derive(Clone, Copy, Debug, Default)]
pub struct Interrupt(Option<&'static AtomicBool>);

impl Interrupt {
    /// One that can be requested. Its flag, one byte, lives as long as the process: a handler may set it at any time.
    pub fn new() -> Self {
        Self(Some(Box::leak(Box::default())))
    }

    /// Asks to stop; returns whether that had been asked before.
    pub fn request(&self) -> bool {
        self.0.is_some_and(|flag| flag.swap(true, Ordering::Relaxed))
    }

    /// Whether somebody asked to stop.
    #[inline]
    pub fn requested(&self) -> bool {
        self.0.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }
}

/// Two are equal when they are the same request.
impl PartialEq for Interrupt {
    fn eq(&self, other: &Self) -> bool {
        match (self.0, other.0) {
            (Some(a), Some(b)) => core::ptr::eq(a, b),
            (None, None) => true,
            _ => false,
        }
    }
}
