//! The health of guards and the choice of the integration method, through the binary.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use approx::assert_abs_diff_eq;
use common::{gaitc_in, json, number, text};
use serde_json::Value;
use std::fs;
use std::path::Path;

fn gait(args: &[&str]) -> Value {
    let (code, gait) = json(&[&["gait"], args].concat());
    assert_eq!((code, gait["status"].as_str()), (0, Some("converged")), "{gait:#}");
    gait
}

/// At the inner dead centre the crank turns at the no-load speed behind the gear, while the leg length has its minimum.
#[test]
fn the_crank_crosses_its_dead_centre_where_the_leg_only_touches_its_shortest_length() {
    for gear in [20.0, 56.57, 100.0] {
        let gait = gait(&["self_exciting", "--set", &format!("G={gear}")]);
        assert_eq!(gait["events"].as_array().unwrap().len(), 1);
        assert_eq!(gait["events"][0]["transition"].as_str(), Some("step"));
        assert_eq!(gait["events"][0]["guard"].as_str(), Some("pi - phi"));
        assert_eq!(number(&gait, "/events/0/time"), number(&gait, "/duration"));
        let transversality = number(&gait, "/events/0/transversality");
        assert_abs_diff_eq!(transversality, -1250.0 / gear, epsilon = 1e-9);
        // The motor's largest speed is that of the crank, which is how fast the guard falls.
        let largest = number(&gait, "/measures/peak_motor_speed") / gear;
        let fastest = number(&gait, "/events/0/fastest");
        assert!(fastest >= -transversality && fastest <= largest * (1.0 + 1e-9), "{fastest} {largest}");

        assert_eq!(gait["also_zero"].as_array().unwrap().len(), 1);
        let leg = &gait["also_zero"][0];
        assert_eq!(leg["transition"].as_str(), Some("step"));
        assert_eq!(leg["expression"].as_str(), Some("r - l_b"));
        assert_eq!((leg["zero"].as_bool(), leg["touches"].as_bool()), (Some(true), Some(true)), "{leg:#}");
        assert_abs_diff_eq!(number(leg, "/start"), 0.13, epsilon = 1e-15);
        assert_abs_diff_eq!(number(leg, "/end"), 0.0, epsilon = 1e-15);
        assert_abs_diff_eq!(number(leg, "/rate"), 0.0, epsilon = 1e-9);
    }
}

#[test]
fn people_read_how_a_guard_crosses_and_what_only_touches() {
    let (code, out, _) = text(&["gait", "self_exciting"]);
    assert_eq!(code, 0);
    let line = |start: &str| out.lines().find(|line| line.trim().starts_with(start)).expect(&out).to_owned();
    let step = line("step ");
    assert!(step.contains("pi - phi") && step.contains("crosses zero at 0.1506 s"), "{step}");
    assert!(step.contains("transversality -22.1 s^-1"), "{step}");
    let leg = line("also zero");
    assert!(leg.contains("r - l_b") && leg.contains("only touches zero") && leg.contains("m/s"), "{leg}");
    assert!(out.contains("integrated with radau5"), "{out}");
}

#[test]
fn a_guard_on_time_alone_falls_with_time() {
    let gait = gait(&["prescribed_length", "--period", "2"]);
    assert_eq!(gait["events"].as_array().unwrap().len(), 2);
    for i in 0..2 {
        assert_abs_diff_eq!(number(&gait, &format!("/events/{i}/transversality")), -1.0, epsilon = 1e-14);
        assert_abs_diff_eq!(number(&gait, &format!("/events/{i}/fastest")), 1.0, epsilon = 1e-14);
    }
    assert_eq!(gait["also_zero"], Value::Array(Vec::new()));
    let (_, out, _) = text(&["gait", "prescribed_length", "--period", "2"]);
    assert!(out.contains("transversality -1 (100% of its fastest rate); the flattest of 2 crossings"), "{out}");
    assert!(!out.contains("integrated with"), "{out}");
}

#[test]
fn all_methods_find_the_same_gait() {
    let explicit = gait(&["prescribed_length"]);
    assert_eq!(explicit["method"].as_str(), Some("explicit"));
    assert_eq!(gait(&["self_exciting", "--method", "auto"])["method"].as_str(), Some("radau5"));
    for (model, methods) in [("prescribed_length", &["radau5"][..]), ("self_exciting", &["radau5", "radau3"])] {
        let usual = gait(&[model]);
        for method in methods.iter().copied() {
            let other = gait(&[model, "--method", method]);
            assert_eq!(other["method"].as_str(), Some(method));
            for path in ["/section/q_theta", "/section/p_theta", "/duration", "/multipliers/0/0", "/multipliers/0/1"] {
                assert_abs_diff_eq!(number(&other, path), number(&usual, path), epsilon = 1e-8);
            }
        }
    }
}

#[test]
fn without_a_gait_the_keys_are_there() {
    let (code, value) = json(&["gait", "prescribed_length", "--set", "omega=0.001 rad/s"]);
    assert_eq!(code, 2);
    for key in ["events", "also_zero", "method"] {
        assert_eq!(value.get(key), Some(&Value::Null), "{key}: {value:#}");
    }
}

#[test]
fn verify_looks_at_the_guards_of_the_default_gait() {
    let (code, value) = json(&["verify", "self_exciting"]);
    assert_eq!(code, 0, "{value:#}");
    let gait = gait(&["self_exciting"]);
    assert_eq!(value["guards"], gait["events"]);
    assert_eq!(value["also_zero"], gait["also_zero"]);
    assert_eq!(value["no_gait"], Value::Null);
    let (_, out, _) = text(&["verify", "self_exciting"]);
    assert!(out.contains("pi - phi") && out.contains("only touches zero"), "{out}");
}

#[test]
fn verify_does_not_fail_for_want_of_a_gait() {
    let folder = tempfile::tempdir().unwrap();
    let spec = Path::new(env!("CARGO_MANIFEST_DIR")).join("specs/prescribed_length.toml");
    let spec = fs::read_to_string(spec).unwrap();
    // So slow that a step outlasts the time limit of a map.
    let spec = spec.replace("\"2*pi*3 rad/s\", range = [\"2*pi*2 rad/s\"", "\"0.001 rad/s\", range = [\"0 rad/s\"");
    fs::create_dir(folder.path().join("specs")).unwrap();
    fs::write(folder.path().join("specs/prescribed_length.toml"), spec).unwrap();
    let run = |more: &[&str]| {
        let output = gaitc_in(folder.path(), &[&["verify", "prescribed_length"], more].concat());
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    assert!(run(&[]).contains("without a gait: the map has no next section crossing"));
    let value: Value = serde_json::from_str(&run(&["--json"])).unwrap();
    assert_eq!((&value["guards"], &value["also_zero"]), (&Value::Null, &Value::Null));
    assert!(value["no_gait"].as_str().unwrap().contains("time limit"), "{value:#}");
}
