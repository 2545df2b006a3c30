//! Studies that end early: killed, interrupted, with torn chunks. They go on where they were, and end with the same bytes.

use crate::{at, done};
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Kills that a study has to survive.
const KILLS: usize = 22;

const STUDY: [&str; 6] = ["sweep", "prescribed_length", "--over", "psi=5..40 deg:400", "--chunk", "16"];

fn start(folder: &Path, name: &str) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gaitc"));
    command.current_dir(env!("CARGO_MANIFEST_DIR")).args(STUDY).args(["--resume", "--dir", &at(folder, name)]);
    command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

fn tables(folder: &Path, name: &str) -> [Vec<u8>; 2] {
    ["sweep.csv", "sweep.parquet"].map(|table| fs::read(folder.join(name).join(table)).unwrap())
}

/// Killed at any moment, a study goes on from what is complete, and ends with the bytes of one that was left alone.
#[test]
fn a_killed_study_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let alone = at(folder.path(), "alone");
    done(&[&STUDY[..], &["--dir", &alone]].concat());
    let (mut kills, mut random, mut study) = (0, 12345_u64, 0);
    while kills < KILLS {
        study += 1;
        let name = format!("study{study}");
        loop {
            let mut child = start(folder.path(), &name);
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            std::thread::sleep(Duration::from_micros(5_000 + (random >> 33) % 150_000));
            // Kills at once, without a chance to clean up.
            child.kill().unwrap();
            let output = child.wait_with_output().unwrap();
            if output.status.success() {
                break;
            }
            assert_eq!(output.status.code(), None, "{}", String::from_utf8_lossy(&output.stderr));
            kills += 1;
        }
        assert!(tables(folder.path(), &name) == tables(folder.path(), "alone"), "after {kills} kills");
    }
}

/// What is torn or edited is computed again, what is whole is believed.
#[test]
fn damaged_chunks_are_computed_again() {
    let folder = tempfile::tempdir().unwrap();
    let (alone, other) = (at(folder.path(), "alone"), at(folder.path(), "other"));
    done(&[&STUDY[..], &["--dir", &alone]].concat());
    let before = tables(folder.path(), "alone");
    let chunk = |number: usize| folder.path().join(format!("alone/chunks/{number:08}.chunk"));
    let whole = fs::read(chunk(3)).unwrap();
    let kept = fs::metadata(chunk(9)).unwrap().modified().unwrap();
    fs::write(chunk(3), &whole[..whole.len() / 2]).unwrap();
    let mut edited = fs::read(chunk(4)).unwrap();
    edited[100] ^= 1;
    fs::write(chunk(4), &edited).unwrap();
    fs::write(chunk(5), b"").unwrap();
    fs::copy(chunk(7), chunk(6)).unwrap();
    // A chunk of another study: the same place, other parameters.
    done(&["sweep", "prescribed_length", "--over", "psi=5..41 deg:400", "--chunk", "16", "--dir", &other]);
    fs::copy(folder.path().join("other/chunks/00000008.chunk"), chunk(8)).unwrap();
    fs::write(folder.path().join("alone/chunks/.left.1.tmp"), b"half").unwrap();
    fs::remove_file(folder.path().join("alone/sweep.csv")).unwrap();
    done(&[&STUDY[..], &["--resume", "--dir", &alone]].concat());
    assert!(tables(folder.path(), "alone") == before);
    assert!(fs::read(chunk(3)).unwrap() == whole);
    assert_eq!(fs::metadata(chunk(9)).unwrap().modified().unwrap(), kept, "whole chunks stay");
    assert!(!folder.path().join("alone/chunks/.left.1.tmp").exists());
}

/// Ctrl-C in the middle of many long maps (a walker that has fallen tumbles on to the time limit): nothing waits for their ends.
#[cfg(unix)]
#[test]
fn an_interruption_is_heard_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_gaitc"));
    command.current_dir(env!("CARGO_MANIFEST_DIR")).args([
        "basin",
        "compass_walker",
        "--over",
        "theta_st=0.3..0.6 rad:3200",
    ]);
    command.args(["--set", "gamma=40 deg", "--chunk", "3200", "--dir", &at(folder.path(), "study")]);
    let long = command.stderr(Stdio::piped()).stdout(Stdio::null()).spawn().unwrap();
    while !folder.path().join("study/study.json").exists() {
        std::thread::sleep(Duration::from_millis(10));
    }
    std::thread::sleep(Duration::from_millis(300));
    let asked = Instant::now();
    assert!(Command::new("kill").args(["-INT", &long.id().to_string()]).status().unwrap().success());
    let output = long.wait_with_output().unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(130), "{errors}");
    assert!(errors.contains("interrupted: 0 points are kept in"), "{errors}");
    // A second where nothing else runs; a group of starts would take half a minute.
    assert!(asked.elapsed() < Duration::from_secs(8), "{:?}", asked.elapsed());
}

/// Ctrl-C: says how to go on.
#[cfg(unix)]
#[test]
fn an_interrupted_study_says_how_to_go_on() {
    let folder = tempfile::tempdir().unwrap();
    let dir = at(folder.path(), "study");
    let mut command = Command::new(env!("CARGO_BIN_EXE_gaitc"));
    command.current_dir(env!("CARGO_MANIFEST_DIR")).args([
        "sweep",
        "prescribed_length",
        "--over",
        "psi=5..40 deg:90000",
    ]);
    let long =
        command.args(["--chunk", "10", "--dir", &dir]).stderr(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    while !folder.path().join("study/chunks/00000001.chunk").exists() {
        std::thread::sleep(Duration::from_millis(10));
    }
    assert!(Command::new("kill").args(["-INT", &long.id().to_string()]).status().unwrap().success());
    let output = long.wait_with_output().unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(130), "{errors}");
    assert!(errors.contains("points are kept in") && errors.contains("--resume"), "{errors}");
}
