//! Sweeps: what stands in their tables, and that it does not depend on how they were computed.

use crate::common::{json, number};
use crate::{at, done};
use serde_json::Value;
use std::fs;

pub(crate) const GRID: [&str; 6] =
    ["sweep", "prescribed_length", "--over", "psi=5..40 deg:12", "--over", "omega=15, 20 rad/s"];

/// The values of a column of a sweep's JSON.
fn column<'v>(sweep: &'v Value, name: &str) -> &'v [Value] {
    sweep["columns"][name]["values"].as_array().unwrap_or_else(|| panic!("no column `{name}` in {sweep:#}"))
}

#[test]
fn a_row_is_what_gait_says_of_its_point() {
    let (code, sweep) = json(&GRID);
    assert_eq!((code, &sweep["status"], &sweep["points"]), (0, &"complete".into(), &24.into()), "{sweep:#}");
    assert_eq!(sweep["columns"]["psi"]["unit"], "rad");
    assert_eq!(sweep["columns"]["omega"]["unit"], "rad/s");
    assert_eq!(sweep["columns"]["climb_speed"]["unit"], "m/s");
    for point in [0, 7, 23] {
        let psi = 5.0 + 35.0 * (point / 2) as f64 / 11.0;
        let omega = [15, 20][point % 2];
        let (_, gait) = json(&[
            "gait",
            "prescribed_length",
            "--set",
            &format!("psi={psi:?} deg"),
            "--set",
            &format!("omega={omega} rad/s"),
        ]);
        let near = |name: &str, path: &str| {
            let (own, other) = (column(&sweep, name)[point].as_f64().unwrap(), number(&gait, path));
            assert!((own - other).abs() <= 1e-9 * other.abs().max(1.0), "{name} of {point}: {own}, {other}");
        };
        assert_eq!(column(&sweep, "point")[point], point);
        assert_eq!(column(&sweep, "status")[point], "converged");
        assert_eq!(column(&sweep, "stable")[point], i32::from(gait["stable"].as_bool().unwrap()));
        near("psi", "/parameters/psi");
        near("omega", "/parameters/omega");
        near("q_theta", "/section/q_theta");
        near("p_theta", "/section/p_theta");
        near("climb_speed", "/measures/climb_speed");
        near("spectral_radius", "/spectral_radius");
        near("duration", "/duration");
        near("multiplier_1_re", "/multipliers/0/0");
        near("multiplier_2_im", "/multipliers/1/1");
    }
}

/// Bytes of the table do not depend on threads, chunks, the folder, or shards.
#[test]
fn however_it_is_computed_the_bytes_are_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let json = |threads: &str| done(&[&GRID[..], &["--json", "--threads", threads]].concat());
    assert!(json("1") == json("4"));
    for ending in ["csv", "parquet"] {
        let at = |name: &str| at(folder.path(), &format!("{ending}_{name}"));
        let (one, two) = (at("one") + "." + ending, at("two") + "." + ending);
        done(&[&GRID[..], &["--threads", "1", "--out", &one]].concat());
        done(&[&GRID[..], &["--threads", "4", "--chunk", "7", "--dir", &at("kept"), "--out", &two]].concat());
        let bytes = fs::read(&one).unwrap();
        assert!(bytes == fs::read(&two).unwrap(), "{ending}: threads and chunks change the table");
        assert!(bytes == fs::read(at("kept") + "/sweep." + ending).unwrap());
        let shards: Vec<String> = (1..=3).map(|i| at(&format!("shard{i}"))).collect();
        for (i, shard) in shards.iter().enumerate() {
            done(&[&GRID[..], &["--chunk", "5", "--dir", shard, "--shard", &format!("{}/3", i + 1)]].concat());
        }
        let merged = at("merged") + "." + ending;
        done(&["merge", &shards[2], &shards[0], &shards[1], "--out", &merged]);
        // Chunks of another size are other folders, not another table.
        assert!(bytes == fs::read(&merged).unwrap(), "{ending}: shards change the table");
    }
}

#[test]
fn points_of_a_sobol_sequence_fill_the_box() {
    let over = ["sweep", "prescribed_length", "--sobol", "16", "--over", "psi=8..24 deg", "--over", "l_s=0.05..0.21 m"];
    let (code, sweep) = json(&over);
    assert_eq!(code, 0, "{sweep:#}");
    for (name, lower, width) in [("psi", 8f64.to_radians(), 1f64.to_radians()), ("l_s", 0.05, 0.01)] {
        let mut hit = [false; 16];
        for value in column(&sweep, name) {
            hit[((value.as_f64().unwrap() - lower) / width) as usize] = true;
        }
        assert!(hit.iter().all(|hit| *hit), "{name}: {:?}", column(&sweep, name));
    }
    let (_, other) = json(&[&over[..], &["--seed", "1"]].concat());
    assert_ne!(column(&sweep, "psi"), column(&other, "psi"));
}

/// At each point the optimum that `gaitc optimize` finds there.
#[test]
fn an_optimum_at_each_point() {
    let problem = json(&["show", "prescribed_length"]).1;
    assert!(problem.is_object());
    let (code, sweep) = json(&["sweep", "prescribed_length", "--over", "l_s=0.1, 0.13 m", "--optimize", "fastest"]);
    assert_eq!((code, &sweep["optimal"]), (0, &2.into()), "{sweep:#}");
    for (point, length) in [(0, "0.1 m"), (1, "0.13 m")] {
        let set = format!("l_s={length}");
        let (_, best) = json(&["optimize", "prescribed_length", "--problem", "fastest", "--set", &set]);
        let (own, other) = (column(&sweep, "objective")[point].as_f64().unwrap(), number(&best, "/objective/value"));
        assert!((own - other).abs() < 1e-7, "{own} {other}");
        assert_eq!(column(&sweep, "status")[point], "optimal");
    }
}

/// Without a kick the ball has no gait, whatever it is followed from; with the smallest kick it has.
#[test]
fn steps_of_no_length_are_no_gaits() {
    let (code, all) = json(&["sweep", "bouncing_ball", "--over", "kick=0, 1e-12, 1e-6, 1e-3 m/s"]);
    assert_eq!((code, &all["converged"]), (0, &3.into()), "{all:#}");
    let status: Vec<_> = column(&all, "status").iter().map(|status| status.as_str().unwrap().to_owned()).collect();
    assert_eq!(status, ["zeno", "converged", "converged", "converged"]);
    // v = kick/(1 - e)
    for (i, kick) in [(1, 1e-12), (2, 1e-6), (3, 1e-3)] {
        let v = column(&all, "v")[i].as_f64().unwrap();
        assert!((v / kick / 5.0 - 1.0).abs() < 1e-6, "{v} for {kick}");
    }
}

#[test]
fn people_are_told_what_was_found_and_where_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let file = at(folder.path(), "gaits.csv");
    let text = done(&[&GRID[..], &["--out", &file]].concat());
    for part in ["24 points", "24 with a gait", "stable", "best: climb_speed = ", "psi = ", "written: ", "time: "] {
        assert!(text.contains(part), "no `{part}` in {text}");
    }
    let table = fs::read_to_string(&file).unwrap();
    let (first, rest) = table.split_once('\n').unwrap();
    let origin: Value = serde_json::from_str(first.strip_prefix("# ").unwrap()).unwrap();
    assert_eq!((&origin["run"]["command"], &origin["run"]["over"][0]), (&"sweep".into(), &"psi=5..40 deg:12".into()));
    assert!(origin["run"]["set"]["l_b"].as_str().unwrap().ends_with(" cm"), "{origin:#}");
    assert!(rest.starts_with("point,psi [rad],omega [rad/s],status,route,duration [s],stable,"), "{rest}");
    assert_eq!(rest.lines().count(), 25);
    // What made it makes it again.
    let again = at(folder.path(), "again.csv");
    done(&["run", &file, "--out", &again]);
    assert!(fs::read_to_string(&again).unwrap() == table);
}
