//! Basins: which starts lead where.

use crate::common::{json, number};
use crate::{at, done};
use serde_json::Value;
use std::fs;

/// A runner that falls from too low and from too high.
const RUNNER: [&str; 4] = ["basin", "slip_runner", "--over", "y=0.8..1.2 m:41"];

fn column<'v>(basin: &'v Value, name: &str) -> &'v [Value] {
    basin["columns"][name]["values"].as_array().unwrap_or_else(|| panic!("no column `{name}` in {basin:#}"))
}

#[test]
fn starts_lead_to_the_gait_or_nowhere() {
    let (code, basin) = json(&RUNNER);
    assert_eq!((code, &basin["points"]), (0, &41.into()), "{basin:#}");
    let (_, gait) = json(&["gait", "slip_runner"]);
    assert!(gait["stable"].as_bool().unwrap());
    let y = number(&gait, "/section/y");
    assert!((number(&basin, "/gaits/0/section/y") - y).abs() < 1e-8, "{basin:#}");
    let mut reached = Vec::new();
    for (row, outcome) in column(&basin, "outcome").iter().enumerate() {
        let end = column(&basin, "y_end")[row].as_f64().unwrap();
        let is_gait = outcome == "gait";
        assert_eq!((column(&basin, "gait")[row] == 1, column(&basin, "period")[row] == 1), (is_gait, is_gait), "{row}");
        assert_eq!((end - y).abs() < 1e-8, is_gait, "{row}: {end}");
        if is_gait {
            reached.push(row);
        }
    }
    // An interval that contains the gait, and not all of the starts.
    assert!(reached.len() > 5 && reached.len() < 41, "{reached:?}");
    assert!(reached.windows(2).all(|pair| pair[1] == pair[0] + 1), "{reached:?}");
    assert!(reached.contains(&(((y - 0.8) / 0.01).round() as usize)));
    assert_eq!(basin["gaits"][0]["starts"], reached.len());
}

/// Which starts are followed side by side, and by how many threads, changes no bit.
#[test]
fn however_it_is_computed_the_bytes_are_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let [one, two, merged, csv] =
        ["one.parquet", "two.parquet", "merged.parquet", "one.csv"].map(|name| at(folder.path(), name));
    done(&[&RUNNER[..], &["--threads", "1", "--out", &one]].concat());
    done(&[&RUNNER[..], &["--threads", "1", "--out", &csv]].concat());
    let json = |threads: &str| done(&[&RUNNER[..], &["--json", "--threads", threads]].concat());
    assert!(json("1") == json("4"));
    let dir = at(folder.path(), "study");
    let study = [&RUNNER[..], &["--threads", "4", "--chunk", "3", "--dir", &dir, "--out", &two]].concat();
    done(&study);
    let bytes = fs::read(&one).unwrap();
    assert!(bytes == fs::read(&two).unwrap());
    assert!(fs::read(&csv).unwrap() == fs::read(folder.path().join("study/basin.csv")).unwrap());
    fs::remove_file(folder.path().join("study/chunks/00000004.chunk")).unwrap();
    fs::remove_file(folder.path().join("study/chunks/00000007.chunk")).unwrap();
    done(&[&study[..], &["--resume"]].concat());
    assert!(bytes == fs::read(&two).unwrap());
    let shards = ["1/2", "2/2"].map(|shard| {
        let dir = at(folder.path(), &shard.replace('/', "_"));
        done(&[&RUNNER[..], &["--chunk", "7", "--dir", &dir, "--shard", shard]].concat());
        dir
    });
    done(&["merge", &shards[0], &shards[1], "--out", &merged]);
    assert!(bytes == fs::read(&merged).unwrap());
}

/// Turned once around, the climber is the same machine, and its symmetry leads back only after two steps.
#[test]
fn gaits_of_longer_period_are_found() {
    let over = ["basin", "prescribed_length", "--set", "psi=30 deg", "--over", "q_theta=-20, 340, -19 deg"];
    let (code, basin) = json(&over);
    assert_eq!(code, 0, "{basin:#}");
    assert_eq!(column(&basin, "gait"), [1, 2, 1]);
    assert_eq!(column(&basin, "period"), [1, 2, 1]);
    let (_, short) = json(&[&over[..], &["--periods", "1", "--steps", "200"]].concat());
    assert_eq!(column(&short, "outcome"), ["gait", "undecided", "gait"]);
    assert_eq!(column(&short, "steps")[1], 200);
    let text = done(&over);
    for part in ["gait 1, period 1", "gait 2, period 2", "q_theta = ", " rad"] {
        assert!(text.contains(part), "no `{part}` in {text}");
    }
}
