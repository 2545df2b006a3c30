//! Trade-off curves through the program: closed forms, slopes, files, and what cannot be traded.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use approx::{assert_abs_diff_eq, assert_relative_eq};
use common::{gaitc, json, number, text};
use serde_json::Value;
use std::fs;

/// Climb speed of the prescribed-length climber for every spectral radius, over sprawl alone.
const SPRAWL: [&str; 8] = [
    "optimize",
    "prescribed_length",
    "--maximize",
    "climb_speed",
    "--vary",
    "psi=5..34 deg",
    "--trade",
    "climb_speed:spectral_radius",
];

fn points(curve: &Value) -> Vec<Value> {
    curve["points"].as_array().unwrap().clone()
}

#[test]
fn the_curve_of_the_prescribed_length_climber_is_the_closed_form() {
    let (code, curve) = json(&[&SPRAWL[..], &["--points", "8"]].concat());
    assert_eq!((code, curve["status"].as_str()), (0, Some("complete")), "{curve:#}");
    let points = points(&curve);
    assert_eq!(points.len(), 8);
    for (i, point) in points.iter().enumerate() {
        let psi = number(point, "/parameters/psi");
        // As long as the multipliers are a complex pair, their product is cos(2 psi) (l_b + l_s)/l_b.
        let radius = ((2.0 * psi).cos() * 0.63 / 0.5).sqrt();
        assert_abs_diff_eq!(number(point, "/second"), radius, epsilon = 1e-8);
        assert_eq!(point["second"], point["spectral_radius"]);
        let set = format!("psi={} deg", psi.to_degrees());
        let (_, gait) = json(&["gait", "prescribed_length", "--set", &set]);
        assert_abs_diff_eq!(number(&gait, "/measures/climb_speed"), number(point, "/first"), epsilon = 1e-9);
        if i > 0 {
            assert!(number(point, "/first") < number(&points[i - 1], "/first"), "{curve:#}");
        }
    }
    // The bounds are spread evenly between the ends.
    let second: Vec<f64> = points.iter().map(|p| number(p, "/second")).collect();
    for pair in second.windows(3) {
        assert_abs_diff_eq!(pair[0] - pair[1], pair[1] - pair[2], epsilon = 1e-8);
    }
}

/// The slope at a point is that of the curve through its neighbours.
#[test]
fn slopes_are_those_of_the_curve() {
    let (_, curve) = json(&[&SPRAWL[..], &["--points", "41"]].concat());
    let points = points(&curve);
    for three in points[1..].windows(3).step_by(7) {
        let [a, c] = [&three[0], &three[2]];
        let chord = (number(a, "/first") - number(c, "/first")) / (number(a, "/second") - number(c, "/second"));
        assert_relative_eq!(number(&three[1], "/slope"), chord, max_relative = 2e-4);
    }
    assert_eq!(points.first().unwrap()["slope"], Value::Null);
    assert_eq!(points.last().unwrap()["slope"], Value::Null);
}

/// The same quantities the other way round: the same curve, read from its other end.
#[test]
fn either_quantity_may_come_first() {
    let (_, one) = json(&[&SPRAWL[..], &["--points", "3"]].concat());
    let mut other = SPRAWL.to_vec();
    other[7] = "spectral_radius:climb_speed";
    let (code, other) = json(&[&other[..], &["--points", "3"]].concat());
    assert_eq!(code, 0, "{other:#}");
    let (one, other) = (points(&one), points(&other));
    for (mine, theirs) in [(0, 2), (2, 0)] {
        assert_abs_diff_eq!(number(&one[mine], "/first"), number(&other[theirs], "/second"), epsilon = 1e-7);
        assert_abs_diff_eq!(number(&one[mine], "/second"), number(&other[theirs], "/first"), epsilon = 1e-7);
    }
    // Price one way, price the other way: inverse functions.
    let slope = |points: &[Value]| number(&points[1], "/slope");
    let between = |x: f64, points: &[Value]| x > number(&points[2], "/first") && x < number(&points[0], "/first");
    assert!(between(number(&one[1], "/first"), &one));
    assert!(slope(&one) > 0.0 && slope(&other) > 0.0);
}

#[test]
fn a_gait_that_is_best_in_both_is_a_single_point() {
    let trade = ["optimize", "power_stroke", "--trade", "climb_speed:cost_of_transport", "--points", "5"];
    let (code, curve) = json(&trade);
    assert_eq!((code, points(&curve).len()), (0, 1), "{curve:#}");
    assert!(curve["message"].as_str().unwrap().contains("nothing to trade"), "{curve:#}");
}

#[test]
fn files_hold_the_curve_with_units_and_appear_whole() {
    let folder = tempfile::tempdir().unwrap();
    let (csv, svg) = (folder.path().join("curve.csv"), folder.path().join("curve.svg"));
    fs::write(&csv, "old").unwrap();
    let mut args = [&SPRAWL[..], &["--points", "4", "--out"]].concat();
    args.extend([csv.to_str().unwrap(), "--plot", svg.to_str().unwrap()]);
    let (code, out, errors) = text(&args);
    assert_eq!((code, errors.as_str()), (0, ""), "{out}");
    let rows: Vec<String> = fs::read_to_string(&csv).unwrap().lines().map(str::to_owned).collect();
    assert_eq!(rows.len(), 6, "{rows:?}");
    assert!(
        rows[0].starts_with("# {\"fingerprint\":") && rows[0].contains("\"trade\":\"climb_speed:spectral_radius\"")
    );
    assert!(rows[1].starts_with("climb_speed [m/s],spectral_radius,slope,psi [deg],"), "{}", rows[1]);
    let psi: f64 = rows[2].split(',').nth(3).unwrap().parse().unwrap();
    assert_abs_diff_eq!(psi, 5.0, epsilon = 1e-9);
    let picture = fs::read_to_string(&svg).unwrap();
    for label in ["climb_speed [m/s]", "spectral_radius", "psi = 5 deg", "psi = 34 deg"] {
        assert!(picture.contains(label), "{label}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "nothing is left beside the files");
    // Nowhere to write to: said before the work begins, as one document.
    let lost = folder.path().join("no/such/folder.csv");
    let lost = lost.to_str().unwrap();
    let (code, error) = json(&[&SPRAWL[..], &["--points", "2", "--out", lost]].concat());
    assert!(code == 1 && error["message"].as_str().unwrap().contains("--out"), "{error:#}");
    // A disk that turns out to be full: said, with the curve all the same.
    #[cfg(target_os = "linux")]
    {
        let full = folder.path().join("full.csv");
        std::os::unix::fs::symlink("/dev/full", &full).unwrap();
        let (code, curve) = json(&[&SPRAWL[..], &["--points", "2", "--out", full.to_str().unwrap()]].concat());
        assert_eq!((code, points(&curve).len()), (1, 2), "{curve:#}");
    }
}

/// Who could read the old file can read the new one.
#[cfg(unix)]
#[test]
fn a_file_keeps_its_permissions() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("curve.csv");
    fs::write(&csv, "old").unwrap();
    fs::set_permissions(&csv, fs::Permissions::from_mode(0o600)).unwrap();
    let (code, ..) = text(&[&SPRAWL[..], &["--points", "2", "--out", csv.to_str().unwrap()]].concat());
    assert_eq!((code, fs::metadata(&csv).unwrap().permissions().mode() & 0o777), (0, 0o600));
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let run = |threads: &str| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_gaitc"));
        command.current_dir(env!("CARGO_MANIFEST_DIR")).env("RAYON_NUM_THREADS", threads);
        command.args(SPRAWL).args(["--points", "6", "--json"]).output().unwrap().stdout
    };
    assert_eq!(run("1"), run("4"));
}

#[test]
fn what_cannot_be_traded_is_said() {
    let cases: [(&[&str], &[&str]); 12] = [
        (&["--trade", "climb_speed"], &["not two quantities", "climb_speed:spectral_radius"]),
        (&["--trade", "climb_speed:climb_speed"], &["the same"]),
        (&["--trade", "climb_speed:"], &["missing"]),
        (&["--trade", "climb_sped:spectral_radius"], &["climb_sped", "climb_speed"]),
        (&["--trade", "climb_sped:mean_power"], &["climb_sped", "did you mean `climb_speed`"]),
        (&["--trade", "climb_speed:mean_power", "--out", "a", "--plot", "a"], &["the same file"]),
        (&["--trade", "climb_speed:mean_power", "--plot", "a.gif"], &["an SVG or a PNG", "`.svg`"]),
        (
            &["--trade", "climb_speed:mean_power", "--maximize", "peak_force", "--vary", "psi=5..30 deg"],
            &["`peak_force`", "neither of the two"],
        ),
        (&["--trade", "climb_speed:max spectral_radius"], &["can only be minimised"]),
        (&["--trade", "peak_force:lateral_speed"], &["more or less", "`max` or `min`"]),
        (&["--trade", "climb_speed:spectral_radius", "--points", "1"], &["--points 1", "from 2"]),
        (&["--points", "5"], &["--trade"]),
    ];
    for (flags, expected) in cases {
        let output = gaitc(&[&["optimize", "prescribed_length"], flags].concat());
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{flags:?}: {errors}");
        for part in expected {
            assert!(errors.contains(part), "{flags:?}: no `{part}` in {errors}");
        }
    }
}

/// Ctrl-C leaves the points found so far, as one whole document.
#[cfg(unix)]
#[test]
fn an_interrupted_curve_is_what_was_found_until_then() {
    use std::process::{Command, Stdio};
    let long = Command::new(env!("CARGO_BIN_EXE_gaitc"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(SPRAWL)
        .args(["--points", "5000", "--json"])
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_millis(1500));
    assert!(Command::new("kill").args(["-INT", &long.id().to_string()]).status().unwrap().success());
    let output = long.wait_with_output().unwrap();
    let curve: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((output.status.code(), curve["status"].as_str()), (Some(130), Some("interrupted")), "{curve:#}");
    if let Some(points) = curve["points"].as_array() {
        assert!(points.iter().all(|point| point["first"].is_number()));
        assert_eq!(
            points.len() + curve["gaps"].as_array().unwrap().len() + curve["dominated"].as_u64().unwrap() as usize,
            5000
        );
    }
}
