//! How far a long piece of work has come: a line on stderr when that is a terminal, else nothing.

use crate::words::plural;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal as _;

/// What is shown; it disappears when the work is done.
#[derive(Debug)]
pub struct Progress(ProgressBar);

impl Progress {
    /// Of `total` pieces, each called `unit` (in the singular); nothing is shown when `quiet`.
    pub fn new(total: u64, unit: &str, quiet: bool) -> Self {
        let unit = if total == 1 { unit.to_owned() } else { plural(unit) };
        let template =
            format!("[{{bar:30}}] {{percent:>3}} % · {{pos}} of {{len}} {unit} · {{per_sec}} · {{eta}} left");
        Self::drawn(Some(total), &template, quiet)
    }

    /// Of pieces whose number is not known, but perhaps that there are no more than `most`; nothing is shown when `quiet`.
    pub fn up_to(most: Option<u64>, unit: &str, quiet: bool) -> Self {
        let (of, left) = match most {
            Some(_) => (" of at most {len}", " · at most {eta} left"),
            None => ("", ""),
        };
        let template = format!("{{spinner}} {{pos}}{of} {} · {{msg}} · {{per_sec}}{left}", plural(unit));
        Self::drawn(most, &template, quiet)
    }

    fn drawn(total: Option<u64>, template: &str, quiet: bool) -> Self {
        let target = match !quiet && std::io::stderr().is_terminal() {
            true => ProgressDrawTarget::stderr(),
            false => ProgressDrawTarget::hidden(),
        };
        let bar = ProgressBar::with_draw_target(total, target);
        // A template that cannot be read leaves the plain bar.
        if let Ok(style) = ProgressStyle::with_template(template) {
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

    /// One more piece is done, here.
    pub fn reach(&self, here: &str) {
        self.0.inc(1);
        self.0.set_message(here.to_owned());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
