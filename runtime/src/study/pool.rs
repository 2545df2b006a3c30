//! Threads that share the points of a study.

use crate::interrupt::Interrupt;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::ops::Range;

/// A number of threads.
#[derive(Debug)]
pub struct Pool(ThreadPool);

impl Pool {
    /// So many threads; 0 for one a core.
    ///
    /// # Errors
    /// When the system has no more threads.
    pub fn new(threads: usize) -> Result<Self, ThreadPoolBuildError> {
        ThreadPoolBuilder::new().num_threads(threads).build().map(Self)
    }

    /// Does `work` for every number, and gives the results in their order; `None` where somebody asked to stop before all was done.
    ///
    /// # Errors
    /// One of those of `work`.
    pub fn map<T: Send, E: Send>(
        &self,
        numbers: Range<u64>,
        interrupt: &Interrupt,
        work: impl Fn(u64) -> Result<T, E> + Sync + Send,
    ) -> Result<Option<Vec<T>>, E> {
        let one = |number| if interrupt.requested() { Ok(None) } else { work(number).map(Some) };
        let all: Result<Vec<Option<T>>, E> = self.0.install(|| numbers.into_par_iter().map(one).collect());
        // What was begun before the request may be done, or be cut short: neither its results nor its errors count.
        if interrupt.requested() { Ok(None) } else { Ok(all?.into_iter().collect()) }
    }
}
