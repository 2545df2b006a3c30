//! `gaitc run`: run files, and results that are made again from what they carry. Completions and manual pages.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;
#[path = "run/files.rs"]
mod files;

use common::{json, text};
use gaitc::provenance::{KEY, Provenance, find};
use serde_json::json;
use std::fs;
use std::path::Path;

/// Exit code and what is printed.
fn stdout(arguments: &[&str]) -> (i32, String) {
    let (code, out, _) = text(arguments);
    (code, out)
}

/// What is said on stderr.
fn stderr(arguments: &[&str]) -> String {
    text(arguments).2
}

#[test]
fn a_result_is_made_again_from_itself() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("result.json");
    let file = file.to_str().unwrap();
    // A value in degrees whose radians have no short decimal, one in SI units, a guess.
    let flags =
        ["--set", "psi=25.3 deg", "--set", "omega=19 rad/s", "--guess", "q_theta=-21 deg", "--tol", "1e-11", "--json"];
    let (code, first) = stdout(&[&["gait", "prescribed_length"][..], &flags].concat());
    assert_eq!(code, 0);
    fs::write(file, &first).unwrap();
    let (code, again) = stdout(&["run", file, "--json"]);
    assert_eq!((code, again), (0, first.clone()));
    // Further arguments add to the run; `--json` may stand before the file, too.
    let (_, other) = json(&["run", file, "--period", "2"]);
    assert_eq!(other[KEY]["run"]["period"], "2");
    assert_eq!(stdout(&["--json", "run", file]).1, first);
    // What is given again wins.
    let (code, other) = json(&["run", file, "--set", "psi=21 deg", "--tol=1e-10"]);
    assert_eq!(code, 0);
    assert_eq!((&other[KEY]["run"]["tol"], &other[KEY]["run"]["set"]["psi"]), (&json!("1e-10"), &json!("21 deg")));
}

#[test]
fn pictures_and_pages_are_made_again_from_themselves() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    for (arguments, flag, ending) in [
        (&["compare", "self_exciting"][..], "--plot", "svg"),
        (&["report", "bouncing_ball", "--set", "e=50 %"], "--out", "html"),
        (&["simulate", "bouncing_ball", "--steps", "2", "--set", "g=5 m/s^2"], "--plot", "png"),
        (&["gait", "bouncing_ball"], "--plot-map", "svg"),
    ] {
        let (first, again) = (at(&format!("first.{ending}")), at(&format!("again.{ending}")));
        assert_eq!(stdout(&[arguments, &[flag, &first]].concat()).0, 0, "{arguments:?}");
        assert_eq!(stdout(&["run", &first, flag, &again]).0, 0, "{arguments:?}");
        assert!(fs::read(&first).unwrap() == fs::read(&again).unwrap(), "{arguments:?}");
    }
    let (code, compared) = json(&["compare", "prescribed_length"]);
    assert_eq!((code, &compared[KEY]["run"]["command"]), (0, &json!("compare")));
}

#[test]
fn every_parameter_is_in_the_run_to_the_last_bit() {
    let (_, result) = json(&["gait", "self_exciting", "--set", "psi=0.35"]);
    let (set, values) = (result[KEY]["run"]["set"].as_object().unwrap(), result["parameters"].as_object().unwrap());
    assert_eq!(set.keys().collect::<Vec<_>>(), values.keys().collect::<Vec<_>>());
    let flags: Vec<String> = set.iter().map(|(name, value)| format!("{name}={}", value.as_str().unwrap())).collect();
    let mut arguments = vec!["gait", "self_exciting"];
    for flag in &flags {
        arguments.extend(["--set", flag]);
    }
    assert_eq!(json(&arguments).1["parameters"], result["parameters"]);
    assert_eq!(result[KEY]["version"], env!("CARGO_PKG_VERSION"));
}

#[test]
fn a_run_file_is_the_command_line() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("study.toml");
    fs::write(&file, "command = \"gait\"\nmodel = \"prescribed_length\"\ntol = 1e-10\n[set]\npsi = \"25 deg\"\n")
        .unwrap();
    let (code, ran) = json(&["run", file.to_str().unwrap()]);
    let (_, typed) = json(&["gait", "prescribed_length", "--tol", "0.0000000001", "--set", "psi=25 deg"]);
    assert_eq!(code, 0);
    assert_eq!(ran["section"], typed["section"]);
}

/// What the program says of a run file, without the file's own name.
fn complaint(contents: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("run.toml");
    fs::write(&file, contents).unwrap();
    let (code, _, said) = text(&["run", file.to_str().unwrap()]);
    assert_eq!(code, 1, "{contents}");
    said.replace(&format!("{}", file.display()), "run.toml")
}

#[test]
fn wrong_run_files_are_refused_with_what_to_write() {
    for (contents, expected) in [
        ("model = \"x\"", "`command` is missing"),
        ("command = \"giat\"", "did you mean `gait`?"),
        ("command = \"run\"", "no command is named `run`"),
        ("command = \"gait\"\nmodel = \"x\"\nperiode = 2", "did you mean `period`?"),
        ("command = \"gait\"\nmodel = \"x\"\njson = 3", "write `true` or `false`"),
        ("command = \"gait\"\nmodel = \"x\"\n[set]\npsi = [1, 2]", "run.toml:4:1"),
        ("command = \"gait\"\nmodel = \"x\"\n[set.psi]\na = 1", "`set.psi` has no value that can be used"),
        ("command = \"gait\"\nmodel = \"x\"\ntol = 1979-05-27", "is a date"),
        ("command = \"gait\"\nmodel = \"x\"\nperiod = true", "`period` has no value that can be used"),
        ("command = 3", "`command` is a number, not the name of a command"),
        ("command = ", "run.toml:1:11"),
        ("command = \"gait\"\ncommand = \"gait\"", "run.toml:2:1"),
        ("command = \"gait\"", "<MODEL>"),
        ("command = \"gait\"\nmodel = \"--help\"", "no compiled model is named `--help`"),
    ] {
        let said = complaint(contents);
        assert!(said.contains(expected), "{contents}\n{said}");
        assert!(said.contains("run.toml") && said.contains("help: "), "{said}");
    }
    // Nothing that is much too long is said again.
    let long = "x".repeat(200_000);
    for contents in [
        format!("command = \"gait\" {long}"),
        format!("command = \"{long}\""),
        format!("command = \"gait\"\n{long} = 1"),
        format!("command = \"gait\"\nmodel = \"{long}\""),
        format!("command = \"gait\"\nmodel = \"bouncing_ball\"\nset = [\"{long}\"]"),
        format!("command = \"gait\"\nmodel = \"bouncing_ball\"\ntol = \"{long}\""),
    ] {
        let said = complaint(&contents);
        assert!(said.contains("run.toml") && said.len() < 1500, "{} bytes: {:.2000}", said.len(), said);
    }
    // Not a run file, not a result.
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("picture.png");
    fs::write(&file, [0_u8, 159, 146, 150]).unwrap();
    assert!(stderr(&["run", file.to_str().unwrap()]).contains("there is no run in this file"));
}

#[test]
fn a_result_of_other_equations_or_versions_is_pointed_out() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("result.json");
    let (_, mut result) = json(&["gait", "bouncing_ball"]);
    for (key, expected) in
        [("fingerprint", "other equations"), ("spec", "the spec was changed"), ("version", "made by gaitc 9")]
    {
        let kept = result[KEY][key].take();
        result[KEY][key] = json!("9");
        fs::write(&file, result.to_string()).unwrap();
        assert!(stderr(&["run", file.to_str().unwrap()]).contains(expected));
        assert_eq!(stderr(&["run", "--quiet", file.to_str().unwrap()]), "");
        result[KEY][key] = kept;
    }
}

#[test]
fn a_provenance_is_found_in_any_file() {
    let mut made = Provenance { model: "a<b>&".to_owned(), ..Provenance::default() };
    made.run.insert("subject-to".to_owned(), "x <= 1".into());
    let line = made.line();
    assert!(!line.contains(['<', '>', '&']));
    assert_eq!(find(format!("<svg><metadata>{line}</metadata></svg>").as_bytes()), Some(made.json()));
    assert_eq!(find(&[&[0, 255, 7][..], line.as_bytes(), &[0, 1]].concat()), Some(made.json()));
    let result = json!({ "status": "converged", KEY: made.json() });
    assert_eq!(find(result.to_string().as_bytes()), Some(made.json()));
    assert_eq!(find(b"{\"fingerprint\":}"), None);
}

#[test]
fn shells_and_manuals_know_every_command() {
    let (_, commands) = stdout(&["--help"]);
    let commands: Vec<&str> = commands
        .lines()
        .skip_while(|l| *l != "Commands:")
        .skip(1)
        .take_while(|l| !l.is_empty())
        .filter(|l| !l.starts_with("    "))
        .filter_map(|l| l.split_whitespace().next())
        .collect();
    assert!(commands.contains(&"optimize"), "{commands:?}");
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let (code, script) = stdout(&["completions", shell]);
        assert_eq!(code, 0);
        assert!(commands.iter().all(|command| script.contains(command)), "{shell}");
    }
    let folder = tempfile::tempdir().unwrap();
    let pages = folder.path().join("man/man1");
    assert_eq!(stdout(&["man", pages.to_str().unwrap()]).0, 0);
    for command in commands.iter().filter(|command| **command != "help") {
        let page = fs::read_to_string(pages.join(format!("gaitc-{command}.1"))).unwrap();
        assert!(page.contains(".TH") && page.contains("OPTIONS"), "{command}");
    }
    assert!(pages.join("gaitc.1").exists());
    let blocked = Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml").join("man");
    let (code, _, said) = text(&["man", blocked.to_str().unwrap()]);
    assert!(code == 1 && said.contains("help: choose another place"), "{said}");
}

#[test]
fn verbose_says_how_long_it_took_and_quiet_nothing() {
    let outside = ["gait", "prescribed_length", "--set", "psi=46 deg"];
    let said = stderr(&[&outside[..], &["--verbose"]].concat());
    assert!(said.ends_with(" s\n") && said.contains("values of prescribed_length: from specs/"), "{said}");
    assert_eq!(stderr(&[&outside[..], &["-q"]].concat()), "");
}

#[test]
fn a_wrong_flag_is_named_and_shown() {
    for (arguments, expected) in [
        (
            &["gait", "bouncing_ball", "--set", "kick=0.4 x"][..],
            &["--> --set:1:10", "| kick=0.4 x", "|          ^"][..],
        ),
        (&["gait", "bouncing_ball", "--set", "kick"], &["--> --set:1:1", "a `=` is missing"]),
        (&["gait", "bouncing_ball", "--guess", "v= 2 kg"], &["--> --guess:1:4", "m/s, not kg"]),
        (&["simulate", "bouncing_ball", "--show", "v + "], &["--> --show:1:5"]),
        (&["simulate", "bouncing_ball", "--time", "x"], &["--> --time:1:1"]),
        (&["simulate", "bouncing_ball", "--interval", "1 m"], &["--> --interval:1:1"]),
        (&["simulate", "bouncing_ball", "--from", "v=y"], &["--> --from:1:3"]),
        (&["simulate", "bouncing_ball", "--state", "y=1 kg"], &["--> --state:1:3"]),
        (&["continue", "bouncing_ball", "--over", "kick=0.1 m/s..z"], &["--> --over:1:15"]),
        (&["continue", "bouncing_ball", "--over", "e=0.1..0.9", "--from", "q"], &["--> --from:1:1"]),
        (&["continue", "bouncing_ball", "--over", "e=0.1..0.9", "--step", "q"], &["--> --step:1:1"]),
        (&["sweep", "bouncing_ball", "--over", "kick=0.1..z m/s:3"], &["--> --over:1:11"]),
        (&["basin", "bouncing_ball", "--over", "v=1..2 m/s:z"], &["--> --over:1:12"]),
        (&["optimize", "bouncing_ball", "--vary", "kick=0.4..z"], &["--> --vary:1:11"]),
        (&["optimize", "bouncing_ball", "--robust", "kick=1"], &["--> --robust:1:6"]),
        (
            &["optimize", "bouncing_ball", "--subject-to", "nothing_like_it <= 3"],
            &["--> --subject-to:1:1", "gaitc show"],
        ),
        (&["optimize", "bouncing_ball", "--maximize", "2*z", "--vary", "e=0..1"], &["--> --maximize:1:3"]),
        (&["optimize", "bouncing_ball", "--minimize", "2*z", "--vary", "e=0..1"], &["--> --minimize:1:3"]),
        (&["optimize", "bouncing_ball", "--trade", "height:2*zz"], &["--> --trade:1:10"]),
    ] {
        let (code, _, said) = text(arguments);
        assert_eq!(code, 1, "{arguments:?}");
        assert!(expected.iter().all(|expected| said.contains(expected)), "{arguments:?}\n{said}");
    }
}

#[test]
fn manuals_and_completions_know_json() {
    let folder = tempfile::tempdir().unwrap();
    let (code, pages) = json(&["man", folder.path().to_str().unwrap()]);
    let pages = pages["files"].as_array().unwrap().len();
    assert_eq!((code, pages), (0, fs::read_dir(folder.path()).unwrap().count()));
    let (code, refused) = json(&["completions", "bash"]);
    assert!(code == 1 && refused["message"].as_str().unwrap().contains("leave --json out"), "{refused}");
}
