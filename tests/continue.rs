//! Gaits followed over a parameter through the program: where they lose stability, double, end, and what is said of it.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use approx::assert_abs_diff_eq;
use common::{gaitc, json, number, text};
use serde_json::Value;
use std::fs;

const SPRAWL: [&str; 4] = ["continue", "prescribed_length", "--over", "psi=10..30 deg"];

fn list<'v>(value: &'v Value, key: &str) -> &'v Vec<Value> {
    value[key].as_array().unwrap_or_else(|| panic!("no list {key} in {value:#}"))
}

/// The product of the multipliers is cos(2 psi) (l_b + l_s)/l_b as long as they are a pair.
#[test]
fn the_prescribed_length_climber_becomes_stable_where_the_closed_form_says() {
    let (code, all) = json(&[&SPRAWL[..], &["--step", "2 deg"]].concat());
    assert_eq!((code, all["status"].as_str()), (0, Some("complete")), "{all:#}");
    let (points, bifurcations) = (list(&all, "points"), list(&all, "bifurcations"));
    assert_eq!((number(&points[0], "/value"), bifurcations.len()), (10.0_f64.to_radians(), 1));
    assert_eq!(number(points.last().unwrap(), "/value"), 30.0_f64.to_radians());
    let at = &bifurcations[0];
    let expected = 0.5 * (0.5_f64 / 0.63).acos();
    assert_eq!(at["kind"], "neimark_sacker");
    assert_abs_diff_eq!(number(at, "/value"), expected, epsilon = 1e-9);
    assert_abs_diff_eq!(number(at, "/spectral_radius"), 1.0, epsilon = 1e-9);
    assert!(number(at, "/multipliers/0/1") != 0.0);
    // There the map preserves areas: swings keep their size on both sides.
    assert_eq!(at["criticality"], Value::Null);
    for point in points {
        let psi = number(point, "/value");
        assert_abs_diff_eq!(number(point, "/spectral_radius").powi(2), (2.0 * psi).cos() * 0.63 / 0.5, epsilon = 1e-8);
        assert_eq!(point["stable"].as_bool(), Some(psi > expected));
        assert!(number(point, "/residual") < 1e-10);
    }
    // A point of the branch is what `gait` finds there.
    let point = &points[points.len() / 2];
    let set = format!("psi={} rad", number(point, "/value"));
    let (_, gait) = json(&["gait", "prescribed_length", "--set", &set]);
    for path in ["/section/q_theta", "/section/p_theta", "/measures/climb_speed"] {
        assert_abs_diff_eq!(number(&gait, path), number(point, path), epsilon = 1e-9);
    }
    // The same as the first of all branches, and who made it.
    assert_eq!(all["branches"][0]["points"], all["points"]);
    assert_eq!(all["branches"][0]["ends"][1]["reason"], "upper_end");
    assert_eq!(all["gaitc"]["run"]["over"], "psi=10..30 deg");
}

#[test]
fn people_read_windows_bifurcations_and_ends() {
    let (code, out, errors) = text(&[&SPRAWL[..], &["--step", "2 deg", "--measure", "q_theta"]].concat());
    assert_eq!((code, errors.as_str()), (0, ""), "{out}");
    for part in [
        "not stable from 10 deg to 18.736 deg",
        "stable from 18.736 deg to 30 deg",
        "Neimark-Sacker  18.736 deg",
        "begins at 10 deg: the lower end of the range",
        "ends at 30 deg: the upper end of the range",
        "q_theta",
    ] {
        assert!(out.contains(part), "no `{part}` in {out}");
    }
}

/// A. Goswami, B. Thuilot and B. Espiau, "A study of the passive gait of a compass-like biped robot", 1998: for these masses and lengths
/// the period doubles near 4.37 deg.
#[test]
fn the_compass_walker_doubles_its_period() {
    let over = ["continue", "compass_walker", "--over", "gamma=4.34..4.46 deg", "--step", "0.06 deg"];
    let (code, all) = json(&[&over[..], &["--doublings", "1"]].concat());
    assert_eq!((code, list(&all, "branches").len()), (0, 2), "{all:#}");
    let flip = &list(&all, "bifurcations")[0];
    assert_eq!((flip["kind"].as_str(), flip["criticality"].as_str()), (Some("flip"), Some("supercritical")));
    assert_abs_diff_eq!(number(flip, "/value").to_degrees(), 4.38, epsilon = 0.02);
    assert_abs_diff_eq!(number(flip, "/multipliers/0/0"), -1.0, epsilon = 1e-7);
    let doubled = &all["branches"][1];
    assert_eq!((doubled["period"].as_u64(), doubled["parent"]["branch"].as_u64()), (Some(2), Some(0)));
    let last = list(doubled, "points").last().unwrap();
    assert_eq!((last["stable"].as_bool(), number(last, "/value")), (Some(true), 4.46_f64.to_radians()));
    // One of them, found by itself.
    let value = format!("gamma={} rad", number(last, "/value"));
    let guess = |name: &str| format!("{name}={}", number(last, &format!("/section/{name}")));
    let (theta, st, sw) = (guess("theta_st") + " rad", guess("w_st") + " rad/s", guess("w_sw") + " rad/s");
    let start = ["--set", &value, "--guess", &theta, "--guess", &st, "--guess", &sw];
    let (_, twice) = json(&[&["gait", "compass_walker", "--period", "2"], &start[..]].concat());
    assert_abs_diff_eq!(number(&twice, "/section/theta_st"), number(last, "/section/theta_st"), epsilon = 1e-9);
    let (_, once) = json(&[&["gait", "compass_walker"], &start[..]].concat());
    assert!((number(&once, "/section/theta_st") - number(last, "/section/theta_st")).abs() > 1e-4);
}

/// The leg then swings up to the vertical and needs ever longer: see tests/angle_switched.rs for where.
#[test]
fn the_angle_switched_climber_ends_where_its_leg_tips_over() {
    let over = ["continue", "angle_switched", "--over", "psi=16..18 deg", "--step", "0.5 deg"];
    let (code, all) = json(&over);
    let end = &all["branches"][0]["ends"][1];
    assert_eq!((code, end["reason"].as_str()), (0, Some("no_event")), "{end:#}");
    let last = list(&all, "points").last().unwrap();
    assert_abs_diff_eq!(number(last, "/value").to_degrees(), 16.197, epsilon = 1e-3);
    assert!(number(last, "/measures/swing") > 3.0 && number(last, "/duration") > 2.0, "{last:#}");
    let (_, out, _) = text(&over);
    assert!(
        out.contains("beyond it the map does not come back") && out.contains("help: look at the last gait"),
        "{out}"
    );
}

#[test]
fn without_a_gait_to_start_from_the_ways_out_are_named() {
    let over = ["continue", "angle_switched", "--over", "psi=18..40 deg"];
    let (code, all) = json(&over);
    assert_eq!((code, all["status"].as_str(), list(&all, "points").len()), (2, Some("zeno"), 0), "{all:#}");
    let (code, out, _) = text(&[&over[..], &["--from", "20 deg"]].concat());
    assert!(code == 2 && out.contains("at psi = 20 deg") && out.contains("--from"), "{out}");
}

#[test]
fn files_hold_the_diagram() {
    let folder = tempfile::tempdir().unwrap();
    let [csv, svg, circle] = ["branches.csv", "branches.svg", "multipliers.svg"].map(|name| folder.path().join(name));
    let files = ["--out", csv.to_str().unwrap(), "--plot", svg.to_str().unwrap()];
    let files = [&files[..], &["--plot-multipliers", circle.to_str().unwrap()]].concat();
    let (code, out, errors) = text(&[&SPRAWL[..], &["--step", "4 deg"], &files].concat());
    assert_eq!((code, errors.as_str()), (0, ""), "{out}");
    let table = fs::read_to_string(&csv).unwrap();
    assert!(table.contains("psi") && table.contains("multiplier_1_re") && table.contains("climb_speed"), "{table}");
    assert_eq!(table.lines().filter(|line| line.contains("Neimark-Sacker")).count(), 1, "{table}");
    let picture = fs::read_to_string(&svg).unwrap();
    for label in ["psi [deg]", "climb_speed [m/s]", "Neimark-Sacker", ">stable<", ">unstable<"] {
        assert!(picture.contains(label), "{label}");
    }
    let picture = fs::read_to_string(&circle).unwrap();
    for label in ["magnitude of multipliers", "psi [deg]", "largest", "number 2", "1: stable below"] {
        assert!(picture.contains(label), "{label}");
    }
}

#[test]
fn wrong_input_is_refused_with_what_to_write() {
    let cases: [(&[&str], &[&str]); 18] = [
        (&["--over", "psi=20..20 deg"], &["both ends", "20 deg", "gaitc gait"]),
        (&["--over", "psi=30..10 deg"], &["above the upper"]),
        (&["--over", "psy=10..30 deg"], &["`psy`", "did you mean `psi`"]),
        (&["--over", "psi=10..30 m"], &["not m", "`deg`"]),
        (&["--over", "l_b=1..2"], &["unit"]),
        (&["--over", "psi"], &["`=`"]),
        (&["--over", "psi=nan..30 deg"], &["nan"]),
        (&[], &["--over"]),
        (&["--over", "psi=10..30 deg", "--points", "0"], &["--points 0", "from 1"]),
        (&["--over", "psi=10..30 deg", "--points", "1000000000"], &["--points", "from 1"]),
        (&["--over", "psi=10..30 deg", "--period", "0"], &["--period 0", "from 1"]),
        (&["--over", "psi=10..30 deg", "--doublings", "60"], &["--doublings 60", "smaller"]),
        (&["--over", "psi=10..30 deg", "--from", "40 deg"], &["--from 40 deg", "inside the range"]),
        (&["--over", "psi=10..30 deg", "--step", "0 deg"], &["--step 0 deg", "give a step from"]),
        (&["--over", "psi=10..30 deg", "--measure", "climb_sped"], &["did you mean `climb_speed`"]),
        (&["--over", "psi=10..30 deg", "--out", "a.xls"], &["--out", "`.csv` or `.parquet`"]),
        (&["--over", "psi=10..30 deg", "--plot", "/no/such/folder/a.svg"], &["--plot", "folder"]),
        (&["--over", "psi=10..30 deg", "--plot", "a.svg", "--plot-multipliers", "a.svg"], &["same file", "name two"]),
    ];
    for (flags, expected) in cases {
        let output = gaitc(&[&["continue", "prescribed_length"], flags].concat());
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{flags:?}: {errors}");
        for part in expected {
            assert!(errors.contains(part), "{flags:?}: no `{part}` in {errors}");
        }
    }
    // Beyond the spec's range: done, with a warning; here the gait goes on to negative angles.
    let (code, all) = json(&["continue", "prescribed_length", "--over", "psi=-5..20 deg", "--step", "5 deg"]);
    assert!(code == 0 && all["warnings"][0].as_str().unwrap().contains("beyond the range"), "{all:#}");
}

/// Ctrl-C leaves the points found so far, as one whole document.
#[cfg(unix)]
#[test]
fn an_interrupted_branch_is_what_was_found_until_then() {
    use std::process::{Command, Stdio};
    let long = Command::new(env!("CARGO_BIN_EXE_gaitc"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(SPRAWL)
        .args(["--step", "0.0001 deg", "--points", "10000", "--json"])
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_millis(1000));
    assert!(Command::new("kill").args(["-INT", &long.id().to_string()]).status().unwrap().success());
    let output = long.wait_with_output().unwrap();
    let all: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((output.status.code(), all["status"].as_str()), (Some(130), Some("interrupted")));
    assert!(!list(&all, "points").is_empty());
    assert!(list(&all, "points").iter().all(|point| number(point, "/measures/climb_speed") > 0.0));
}
