//! Files that are read and written: what is refused, what stays, and that all of it says what to do.

use crate::common::{gaitc_in, text};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Runs the program in a folder; it has to fail with `help:` and all that is expected, in words and as JSON.
fn refused(folder: &Path, arguments: &[&str], expected: &[&str]) {
    let output = gaitc_in(folder, &[arguments, &["--json"]].concat());
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{arguments:?}\n{said}");
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    // `check` has its diagnostics in one place only.
    let told = match document.pointer("/diagnostics/0") {
        Some(found) => {
            vec![format!("{}\nhelp: {}", found["message"].as_str().unwrap(), found["help"].as_str().unwrap())]
        }
        None => vec![document["message"].as_str().unwrap().to_owned(), said],
    };
    for said in &told {
        for expected in expected.iter().chain(&["help: "]) {
            assert!(said.contains(expected), "{arguments:?}: no `{expected}` in\n{said}");
        }
        assert!(said.len() < 1500 && !said.contains("os error"), "{said}");
    }
}

#[test]
fn what_cannot_be_read_is_refused_with_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::create_dir(folder.join("folder.toml")).unwrap();
    fs::write(folder.join("large.toml"), vec![b'#'; (1 << 20) + 1]).unwrap();
    fs::write(folder.join("latin.toml"), b"command = \"\xe4\"").unwrap();
    for (arguments, expected) in [
        (&["run", "none.toml"][..], "there is no such file"),
        (&["run", "folder.toml"], "this is a folder"),
        (&["run", "large.toml"], "1048577 bytes"),
        (&["run", "latin.toml"], "not UTF-8"),
        (&["run", "large.toml/x"], "a part of the path is not a folder"),
        (&["show", "none.toml"], "there is no such file"),
        (&["show", "folder.toml"], "this is a folder"),
        (&["check", "none.toml"], "there is no such file"),
        (&["check", "folder.toml"], "no file below this folder"),
        (&["gait", "bouncing_ball", "--specs", "none"], "there is no such file"),
        (&["merge", "none", "--out", "x.csv"], "there is no such file"),
    ] {
        refused(folder, arguments, &[expected]);
    }
}

/// A pipe that nobody writes to, and a device that never ends: neither is waited for.
#[cfg(target_os = "linux")]
#[test]
fn pipes_and_devices_are_not_read() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    assert!(std::process::Command::new("mkfifo").arg(folder.join("pipe.toml")).status().unwrap().success());
    std::os::unix::fs::symlink("pipe.toml", folder.join("link.toml")).unwrap();
    fs::create_dir(folder.join("study")).unwrap();
    std::os::unix::fs::symlink("/dev/zero", folder.join("study/study.json")).unwrap();
    let spec = include_str!("../../specs/bouncing_ball.toml").replace("spec = 1", "spec = 1\nuse = [\"pipe.toml\"]");
    fs::write(folder.join("bouncing_ball.toml"), spec).unwrap();
    for file in ["pipe.toml", "link.toml", "/dev/zero"] {
        refused(folder, &["run", file], &["a pipe or a device"]);
    }
    refused(folder, &["show", "link.toml"], &["a pipe or a device"]);
    refused(folder, &["check", "pipe.toml"], &["a pipe or a device"]);
    refused(folder, &["merge", "study", "--out", "x.csv"], &["is a link or a folder"]);
    refused(folder, &["gait", "bouncing_ball", "--specs", "."], &["the part `pipe.toml`", "a pipe or a device"]);
}

const GAIT: [&str; 3] = ["simulate", "bouncing_ball", "--quiet"];

#[test]
fn what_cannot_be_written_is_refused_before_the_work() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::create_dir(folder.join("folder.csv")).unwrap();
    fs::write(folder.join("kept.csv"), "mine").unwrap();
    let mut rights = fs::metadata(folder.join("kept.csv")).unwrap().permissions();
    rights.set_readonly(true);
    fs::set_permissions(folder.join("kept.csv"), rights).unwrap();
    let long = format!("{}.csv", "x".repeat(300));
    for (file, expected) in [
        ("none/x.csv", "there is no such folder"),
        ("kept.csv/x.csv", "a part of the path is not a folder"),
        ("folder.csv", "this is a folder"),
        ("kept.csv", "write-protected"),
        (&long, "File name too long"),
    ] {
        refused(folder, &[&GAIT[..], &["--out", file]].concat(), &["--out: cannot write", expected]);
        let picture = file.replace("csv", "svg");
        if !picture.contains("kept") && !picture.contains("folder") {
            refused(folder, &[&GAIT[..], &["--plot", &picture]].concat(), &["--plot: cannot write", expected]);
        }
        refused(folder, &["report", "bouncing_ball", "--out", "none/x.html"], &["cannot write"]);
    }
    refused(folder, &["man", "kept.csv/man"], &["cannot write `kept.csv/man`"]);
    refused(folder, &["new", "kept.csv/new"], &["something is in the way"]);
    refused(folder, &["sweep", "bouncing_ball", "--over", "e=0.5", "--dir", "kept.csv/x"], &["cannot write"]);
    assert_eq!(fs::read_to_string(folder.join("kept.csv")).unwrap(), "mine");
    assert_eq!(fs::read_dir(folder).unwrap().count(), 2, "nothing was left behind");
}

/// Through a link its file is replaced, and the link stays; a device is written to. What was there before stays when it fails.
#[cfg(target_os = "linux")]
#[test]
fn links_are_followed_and_a_full_disk_harms_nothing() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("file.csv"), "old").unwrap();
    symlink("file.csv", folder.join("link.csv")).unwrap();
    symlink("round.csv", folder.join("round.csv")).unwrap();
    symlink("/dev/full", folder.join("full.csv")).unwrap();
    symlink("/dev/null", folder.join("null.csv")).unwrap();
    let run = |file: &str| {
        let output = gaitc_in(folder, &[&GAIT[..], &["--out", file]].concat());
        (output.status.code(), String::from_utf8(output.stderr).unwrap(), output.stdout.len())
    };
    assert_eq!(run("link.csv").0, Some(0));
    assert!(folder.join("link.csv").is_symlink());
    assert!(fs::read_to_string(folder.join("file.csv")).unwrap().starts_with("# {\"fingerprint\""));
    assert_eq!(run("null.csv").0, Some(0));
    let (code, said, shown) = run("full.csv");
    assert!(code == Some(1) && shown > 100, "what was found is shown all the same: {said}");
    assert!(
        said.contains("--out: cannot write `full.csv`: No space left") && said.contains("help: make room"),
        "{said}"
    );
    refused(folder, &[&GAIT[..], &["--out", "round.csv"]].concat(), &["--out: cannot write `round.csv`"]);
    // A limit on the size of files is as good as a full disk.
    let report = "ulimit -f 1; exec \"$0\" report bouncing_ball --out page.html";
    let mut shell = std::process::Command::new("sh");
    fs::write(folder.join("page.html"), "old").unwrap();
    let limited = shell.args(["-c", report, env!("CARGO_BIN_EXE_gaitc")]).current_dir(folder).output().unwrap();
    let said = String::from_utf8(limited.stderr).unwrap();
    assert_eq!(limited.status.code(), Some(1), "{said}");
    assert!(said.contains("File too large") && said.contains("help: make room"), "{said}");
    assert_eq!(fs::read_to_string(folder.join("page.html")).unwrap(), "old");
    assert_eq!(fs::read_dir(folder).unwrap().count(), 6, "nothing was left behind");
}

#[test]
fn absurd_numbers_are_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let huge = "1000000000000000";
    for (arguments, expected) in [
        (&["simulate", "bouncing_ball", "--steps", huge][..], "from 1 to 1000000"),
        (&["simulate", "bouncing_ball", "--samples", huge], "more than 10000000 values"),
        (&["simulate", "bouncing_ball", "--interval", "1e-300 s"], "more than 10000000 values"),
        (&["gait", "bouncing_ball", "--period", huge], "from 1 to 1000"),
        (&["gait", "bouncing_ball", "--segments", huge], "from 1 to 100"),
        (&["verify", "bouncing_ball", "--samples", huge], "from 1 to 20000"),
        (&["report", "bouncing_ball", "--steps", huge], "from 1 to 200"),
        (&["optimize", "bouncing_ball", "--starts", huge], "from 1 to 100000"),
        (&["optimize", "bouncing_ball", "--work", huge], "from 1 to 1000000000"),
        (&["optimize", "bouncing_ball", "--trade", "height:kick", "--points", huge], "from 2 to 10000"),
        (&["continue", "bouncing_ball", "--over", "e=0.1..0.9", "--points", huge], "from 1 to 10000"),
        (&["sweep", "bouncing_ball", "--over", "e=0.1..0.9:1000000000"], "at most 10000000"),
        (&["sweep", "bouncing_ball", "--sobol", huge, "--over", "e=0.1..0.9"], "at most 10000000"),
        (&["basin", "bouncing_ball", "--over", "v=1..2 m/s:1000000000000"], "at most 10000000"),
        (&["basin", "bouncing_ball", "--over", "v=1..2 m/s:3", "--steps", huge], "from 1 to 10000000"),
        (&["sweep", "bouncing_ball", "--over", "e=0.1..0.9:3", "--threads", huge], "from 1 to 1024"),
    ] {
        let output = gaitc_in(folder.path(), arguments);
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(1) && said.contains(expected), "{arguments:?}\n{said}");
    }
    // A spec with a million states.
    let states: String = (0..1_000_000).map(|i| format!("x{i} = {{}}\n")).collect();
    fs::write(folder.path().join("many.toml"), format!("spec = 1\nname = \"many\"\n[state]\n{states}")).unwrap();
    let said = text(&["check", folder.path().join("many.toml").to_str().unwrap()]).1;
    assert!(said.contains("bytes; a spec has at most 4194304"), "{said}");
}
