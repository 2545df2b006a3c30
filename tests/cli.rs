//! The command line as a person meets it: wrong input ends in a message that says what to write instead, exit code 1.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use common::{gaitc_in, json, text};
use std::fs;
use std::path::Path;

/// Arguments, and what stderr has to contain.
const WRONG: &[(&[&str], &[&str])] = &[
    (
        &["gait", "prescribed_lenght"],
        &["no compiled model is named `prescribed_lenght`", "did you mean `prescribed_length`?"],
    ),
    (&["gait", "../etc/passwd"], &["no compiled model"]),
    (&["gait", "prescribed_length", "--set", "pis=20 deg"], &["no parameter is named `pis`", "did you mean `psi`?"]),
    (&["gait", "prescribed_length", "--set", "psi"], &["psi", "="]),
    (&["gait", "prescribed_length", "--set", "psi=20 m"], &["20 m", "deg"]),
    (&["gait", "prescribed_length", "--set", "l_s=13"], &["m"]),
    (&["gait", "prescribed_length", "--set", "psi=1/0"], &["1/0"]),
    (&["gait", "prescribed_length", "--guess", "r=1 m"], &["no section coordinate is named `r`", "q_theta"]),
    (&["gait", "prescribed_length", "--tol", "0"], &["--tol", "1e-15"]),
    (&["gait", "prescribed_length", "--tol", "nan"], &["--tol"]),
    (
        &["gait", "prescribed_length", "--method", "rk4"],
        &["--method: no method is named `rk4`", "auto, explicit, radau5, radau3"],
    ),
    (&["optimize", "prescribed_length", "--method", "radau4"], &["did you mean `radau5`?"]),
    (&["gait", "self_exciting", "--method", "explicit"], &["`self_exciting` has a mass matrix", "`radau5`"]),
    (&["optimize", "self_exciting", "--method", "explicit"], &["`self_exciting` has a mass matrix", "`radau5`"]),
    (&["gait", "prescribed_length", "--period", "0"], &["--period"]),
    (&["gait", "prescribed_length", "--segments", "0"], &["--segments 0", "from 1 to 100"]),
    (&["gait", "self_exciting", "--segments", "3"], &["`self_exciting` cannot be cut into segments", "use 1 segment"]),
    (&["gait", "prescribed_length", "--segments", "3", "--period", "2"], &["cannot be cut into segments"]),
    (&["gait", "prescribed_length", "--specs", "/nonexistent"], &["/nonexistent"]),
    (
        &["optimize", "prescribed_length", "--problem", "fastst"],
        &["no problem is named `fastst`", "did you mean `fastest`?"],
    ),
    (&["optimize", "prescribed_length", "--maximize", "climb_speed"], &["nothing to vary", "--vary"]),
    (
        &["optimize", "prescribed_length", "--maximize", "climbspeed", "--vary", "psi=1..45 deg"],
        &["climbspeed", "climb_speed"],
    ),
    (&["optimize", "prescribed_length", "--maximize", "spectral_radius", "--vary", "psi=1..45 deg"], &["minimi"]),
    (&["optimize", "prescribed_length", "--vary", "psi=45..1 deg"], &["45", "1"]),
    (&["optimize", "prescribed_length", "--vary", "psi=1..45 kg"], &["kg"]),
    (&["optimize", "prescribed_length", "--vary", "psi=1 deg"], &[".."]),
    (&["optimize", "prescribed_length", "--subject-to", "mean_power <= 60 [m]"], &["mean_power"]),
    (&["optimize", "prescribed_length", "--subject-to", "mean_power"], &["mean_power", "<="]),
    (&["optimize", "prescribed_length", "--starts", "0"], &["--starts"]),
    (&["optimize", "prescribed_length", "--maximize", "g", "--vary", "psi=1..45 deg"], &["`g` does not depend on"]),
    (&["verify", "prescribed_length", "--samples", "0"], &["--samples"]),
    (&["gait", "prescribed_length", "--set", "psi=20 deg", "--set", "psi=30 deg"], &["`psi` is given twice"]),
    (&["check", "no/such/file.toml"], &["no/such/file.toml"]),
    (&["check", "src/cli"], &["src/cli", "no file below this folder"]),
    (&["frobnicate"], &["frobnicate"]),
];

#[test]
fn wrong_input_is_explained() {
    for (args, parts) in WRONG {
        let (code, _, stderr) = text(args);
        assert_eq!(code, 1, "{args:?}: {stderr}");
        for part in *parts {
            assert!(stderr.contains(part), "{args:?} does not say {part:?}:\n{stderr}");
        }
        assert!(!stderr.contains("panicked"), "{args:?}:\n{stderr}");
    }
}

fn copy_spec(folder: &Path, edit: impl Fn(String) -> String) {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("specs/prescribed_length.toml")).unwrap();
    fs::create_dir_all(folder.join("specs")).unwrap();
    fs::write(folder.join("specs/prescribed_length.toml"), edit(text)).unwrap();
}

fn duration(folder: &Path) -> f64 {
    let output = gaitc_in(folder, &["gait", "prescribed_length", "--json"]);
    let value: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    value["duration"].as_f64().unwrap()
}

#[test]
fn parameter_values_are_read_at_run_time() {
    let folder = tempfile::tempdir().unwrap();
    approx::assert_relative_eq!(duration(folder.path()), 1.0 / 6.0, max_relative = 1e-12);
    copy_spec(folder.path(), |text| text.replace("\"2*pi*3 rad/s\"", "\"2*pi*2.5 rad/s\""));
    approx::assert_relative_eq!(duration(folder.path()), 1.0 / 5.0, max_relative = 1e-12);
}

#[test]
fn changed_equations_ask_for_a_rebuild() {
    let folder = tempfile::tempdir().unwrap();
    copy_spec(folder.path(), |text| text.replace("-g*sin(q_theta) -", "-2*g*sin(q_theta) -"));
    let output = gaitc_in(folder.path(), &["gait", "prescribed_length"]);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{stderr}");
    assert!(stderr.contains("rebuild") && stderr.contains("specs/prescribed_length.toml"), "{stderr}");
}

#[test]
fn check_names_every_problem_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    copy_spec(folder.path(), |text| {
        text.replace("p_theta/r\"", "p_thta/r\"").replace("q_theta + delta", "q_theta + p_theta")
    });
    let path = folder.path().join("specs/prescribed_length.toml");
    let output = gaitc_in(folder.path(), &["check", path.to_str().unwrap(), "--json"]);
    assert_eq!(output.status.code(), Some(1));
    let value: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let diagnostics = value["diagnostics"].as_array().unwrap();
    assert_eq!(diagnostics.len(), 3, "{value:#}");
    for d in diagnostics {
        assert!(d["line"].as_u64().unwrap() > 1 && d["column"].as_u64().unwrap() > 1, "{d}");
        assert!(d["code"].as_str().unwrap().starts_with('E'), "{d}");
    }
}

#[test]
fn a_gait_that_is_not_there_is_an_outcome() {
    // A step that ends 0.001 s before the time limit of a map cannot be shown to end at all.
    let (code, value) = json(&["gait", "prescribed_length", "--set", "omega=0.001 rad/s"]);
    assert_eq!(code, 2, "{value:#}");
    assert_eq!(value["status"].as_str(), Some("no_event"), "{value:#}");
    assert!(!value["message"].as_str().unwrap().is_empty());
}

#[test]
fn models_and_help_are_there() {
    let (code, value) = json(&["models"]);
    assert_eq!(code, 0);
    assert!(value["models"].as_array().unwrap().iter().any(|m| m["model"] == "prescribed_length"), "{value:#}");
    for args in [&["--help"][..], &["gait", "--help"], &["optimize", "--help"], &["--version"]] {
        assert_eq!(text(args).0, 0, "{args:?}");
    }
}

/// What a newton more is worth is a thousandth of what a kilonewton more is; both are printed as the user wrote them.
#[test]
fn a_price_is_in_the_unit_of_its_constraint() {
    let price = |constraint: &str| {
        let vary = ["--vary", "psi=1..45 deg", "--subject-to", constraint];
        let (_, out, _) = text(&[&["optimize", "prescribed_length", "--maximize", "climb_speed"], &vary[..]].concat());
        let line = out.lines().find_map(|line| line.trim().strip_prefix(constraint)).expect(&out).trim().to_owned();
        let (number, per) = line.split_once(" m/s per ").expect(&line);
        (number.parse::<f64>().unwrap(), per.to_owned())
    };
    let (in_newton, newton) = price("peak_force <= 85 N");
    let (in_kilonewton, kilonewton) = price("peak_force <= 0.085 kN");
    assert_eq!((newton.as_str(), kilonewton.as_str()), ("N", "kN"));
    approx::assert_relative_eq!(1000.0 * in_newton, in_kilonewton, max_relative = 1e-3);
    // Without a unit behind the bound it is that of the measure.
    assert_eq!(price("peak_force <= 85/25.506*m*g").1, "N");
}

#[test]
fn an_optimum_comes_with_its_reasons() {
    let (code, found) = json(&["optimize", "prescribed_length"]);
    assert_eq!(code, 0, "{found:#}");
    let second = &found["second_order"];
    assert_eq!((second["shape"].as_str(), second["constraints"].as_u64()), (Some("vertex"), Some(1)));
    let omega = found["sensitivities"].as_array().unwrap().iter().find(|s| s["parameter"] == "omega").unwrap();
    let value = found["parameters"]["omega"].as_f64().unwrap();
    let percent = 0.01 * value * omega["derivative"].as_f64().unwrap();
    approx::assert_relative_eq!(omega["per_percent"].as_f64().unwrap(), percent, max_relative = 1e-12);
    let confirmation = &found["confirmation"];
    assert_eq!(confirmation["disturbed"]["outcome"], "stays");
    assert_eq!(confirmation["disturbed"]["maps"], 1000);
    assert_eq!(confirmation["independent"]["route"], "Radau IIA");
    let (_, table, _) = text(&["optimize", "prescribed_length"]);
    for part in ["held fixed", "a vertex: one active constraint, one parameter", "confirmed: 1,000 disturbed maps"] {
        assert!(table.contains(part), "{part}: {table}");
    }
    let (_, table, _) = text(&["optimize", "angle_switched"]);
    assert!(table.contains("not stable, and a small deviation grows"), "{table}");
}

#[test]
fn multiple_shooting_finds_the_same_gait() {
    let radius = |segments: &str| {
        let (code, gait) = json(&["gait", "slip_runner", "--segments", segments]);
        assert_eq!(code, 0, "{gait:#}");
        gait["spectral_radius"].as_f64().unwrap()
    };
    let single = radius("1");
    for segments in ["4", "5"] {
        assert!((radius(segments) - single).abs() < 1e-9 * single, "{segments}: {} {single}", radius(segments));
    }
}

#[test]
fn a_coarse_tolerance_still_finds_a_gait() {
    for tolerance in ["1e-3", "1e-5", "1e-7"] {
        for method in ["explicit", "radau5"] {
            let (code, gait) = json(&["gait", "prescribed_length", "--tol", tolerance, "--method", method]);
            assert_eq!((code, gait["method"].as_str()), (0, Some(method)), "{gait:#}");
        }
    }
}

#[test]
fn a_value_outside_its_range_is_pointed_out() {
    let (code, value) = json(&["gait", "prescribed_length", "--set", "psi=20"]);
    assert_eq!(code, 0);
    let said = value["warnings"].to_string();
    assert!(said.contains("`psi` = 1146 deg is outside the range"), "{said}");
}

#[test]
fn wrong_input_is_json_too() {
    let (code, value) = json(&["gait", "nope"]);
    assert_eq!((code, value["status"].as_str()), (1, Some("error")), "{value:#}");
    assert!(value["message"].as_str().unwrap().contains("`nope`"));
}

#[test]
fn wrong_arguments_are_json_too() {
    for (args, said) in [
        (&["gait"][..], "<MODEL>"),
        (&["gait", "prescribed_length", "--tol", "abc"], "invalid value 'abc' for '--tol <NUMBER>'"),
        (
            &["optimize", "prescribed_length", "--maximize", "climb_speed", "--minimize", "climb_speed"],
            "cannot be used with",
        ),
        (&["frobnicate"], "unrecognized subcommand 'frobnicate'"),
        (&["check"], "<FILE>"),
        (&[], "subcommand"),
    ] {
        let (code, value) = json(args);
        assert_eq!((code, value["status"].as_str()), (1, Some("error")), "{value:#}");
        let message = value["message"].as_str().unwrap();
        assert!(message.contains(said) && !message.contains("Usage") && !message.starts_with("error"), "{message}");
        let (_, stdout, stderr) = text(args);
        assert!(stdout.is_empty() && stderr.contains("Usage") | stderr.contains("--help"), "{stdout}\n{stderr}");
    }
    // Behind `--` it is no flag.
    assert_eq!(text(&["gait", "a", "--", "--json"]).1, "");
}

#[cfg(target_os = "linux")]
#[test]
fn a_result_that_cannot_be_written_is_a_failure() {
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_gaitc"));
    let output = command.arg("models").stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8(output.stderr).unwrap().contains("could not be written"));
    // Two files are two results; that neither can be written is said once.
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_gaitc"));
    let specs = ["specs/rotational.toml", "specs/rimless_wheel.toml"];
    let output =
        command.current_dir(env!("CARGO_MANIFEST_DIR")).arg("check").args(specs).stdout(full).output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!((output.status.code(), stderr.matches("could not be written").count()), (Some(1), 1), "{stderr}");
}

#[test]
fn the_table_of_measures_says_where_they_are_explained() {
    let hint = "what the measures mean: gaitc show rimless_wheel";
    let (code, out, _) = text(&["gait", "rimless_wheel"]);
    assert_eq!((code, out.lines().filter(|line| *line == hint).count()), (0, 1), "{out}");
    let (_, out, _) = text(&["optimize", "rimless_wheel"]);
    assert_eq!(out.lines().filter(|line| *line == hint).count(), 1, "{out}");
    let (_, value) = json(&["gait", "rimless_wheel"]);
    assert!(!value.to_string().contains("gaitc show"), "{value:#}");
}
