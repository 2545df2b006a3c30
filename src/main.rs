//! The gaitc command.
fn main() {}
