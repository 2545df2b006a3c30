//! The table of docs/design_study.md: each row's command gives the speed that the row says.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use approx::assert_abs_diff_eq;
use common::{json, number};
use std::fs;

/// A row: the words behind `gaitc optimize`, and the speed in m/s.
fn rows() -> Vec<(Vec<String>, f64)> {
    let page = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/design_study.md")).unwrap();
    let cells = page.lines().map(|line| line.split('|').map(str::trim).collect::<Vec<_>>());
    cells
        .filter(|cells| cells.len() > 4 && cells[2].starts_with('`') && cells[3].ends_with(" m/s"))
        .map(|cells| (words(cells[2].trim_matches('`')), cells[3].trim_end_matches(" m/s").parse().unwrap()))
        .collect()
}

/// Splits a command as a shell does, as far as it is used there: single quotes keep words together.
fn words(command: &str) -> Vec<String> {
    let parts = command.split('\'').enumerate();
    let quoted = |i: usize| i % 2 == 1;
    parts
        .flat_map(|(i, part)| match quoted(i) {
            true => vec![part.to_owned()],
            false => part.split_whitespace().map(str::to_owned).collect(),
        })
        .collect()
}

#[test]
fn every_row_is_what_its_command_gives() {
    let rows = rows();
    assert!(rows.len() >= 9, "{rows:?}");
    for (words, speed) in rows {
        let mut args = vec!["optimize"];
        args.extend(words.iter().map(String::as_str));
        let (code, best) = json(&args);
        assert_eq!((code, best["status"].as_str()), (0, Some("optimal")), "{args:?}: {best:#}");
        assert_abs_diff_eq!(number(&best, "/objective/value"), speed, epsilon = 0.6e-4);
    }
}

/// Without losses at touch-down all power becomes height: the budget over the weight, a closed form.
#[test]
fn the_lossless_transmission_climbs_at_the_power_over_the_weight() {
    let budget = ["--vary", "l_s=5..30 cm", "--subject-to", "mean_power + spring_power <= 40 W"];
    let (_, best) = json(&[&["optimize", "self_exciting_rack"], &budget[..]].concat());
    assert_abs_diff_eq!(number(&best, "/objective/value"), 40.0 / (2.6 * 9.81), epsilon = 1e-8);
    assert_eq!(best["second_order"]["shape"], "flat", "{best:#}");
}
