//! How far a long piece of work has come: a line on stderr when that is a terminal, else nothing.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal as _;

/// What is shown; it disappears when the work is done.
#[derive(Debug)]
pub struct Progress(ProgressBar);

impl Progress {
    /// Of `total` pieces, called `unit` (in the plural); nothing is shown when `quiet`.
    pub fn new(total: u64, unit: &str, quiet: bool) -> Self {
        let target = match !quiet && std::io::stderr().is_terminal() {
            true => ProgressDrawTarget::stderr(),
            false => ProgressDrawTarget::hidden(),
        };
        let bar = ProgressBar::with_draw_target(Some(total), target);
        let template =
            format!("[{{bar:30}}] {{percent:>3}} % · {{pos}} of {{len}} {unit} · {{per_sec}} · {{eta}} left");
        // A template that cannot be read leaves the plain bar.
        if let Ok(style) = ProgressStyle::with_template(&template) {
            bar.set_style(style.progress_chars("=> "));
        }
        Self(bar)
    }

    /// So many pieces were done before: they count, but not for the rate.
    pub fn skip(&self, pieces: u64) {
        self.0.inc(pieces);
        self.0.reset_eta();
    }

    /// So many more pieces are done.
    pub fn add(&self, pieces: u64) {
        self.0.inc(pieces);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
