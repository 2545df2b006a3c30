//! Pictures and reports: files as others read them, and the page in a real browser.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly
#![allow(clippy::print_stdout, unreachable_pub)] // a test says why it was left out; modules of one binary

mod browser;
#[path = "../common/mod.rs"]
mod common;
mod page;
mod pictures;
