//! Robust problems through the program: closed forms, optima against each machine on its own, and what is refused.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use approx::{assert_abs_diff_eq, assert_relative_eq};
use common::{json, number, text};
use serde_json::Value;
use std::fs;
use std::path::Path;

fn optimum(args: &[&str]) -> Value {
    let (code, solution) = json(args);
    assert_eq!((code, solution["status"].as_str()), (0, Some("optimal")), "{solution:#}");
    solution
}

fn scenarios(solution: &Value) -> &[Value] {
    solution["robust"]["scenarios"].as_array().unwrap()
}

/// The multipliers are a complex pair, and their product is cos(2 psi) (l_b + l_s)/l_b.
#[test]
fn the_sprawl_is_that_of_the_closed_form_at_the_worst_machine() {
    let cases: [(&[&str], f64, &str, f64); 3] = [
        (&["--robust", "l_s=12..14 cm"], 0.64 / 0.5, "l_s", 0.14),
        (&["--robust", "l_b=45..55 cm"], 0.58 / 0.45, "l_b", 0.45),
        (&["--robust", "l_s=12..14 cm", "--robust", "l_b=45..55 cm"], 0.59 / 0.45, "l_s", 0.14),
    ];
    for (flags, ratio, name, value) in cases {
        let solution = optimum(&[&["optimize", "prescribed_length"], flags].concat());
        let psi = 0.5 * (0.95_f64.powi(2) / ratio).acos();
        assert_abs_diff_eq!(number(&solution, "/parameters/psi"), psi, epsilon = 1e-8);
        // The constraint limits the machine at that corner, and no other.
        let limited: Vec<&Value> =
            scenarios(&solution).iter().filter(|s| !s["limits"].as_array().unwrap().is_empty()).collect();
        assert_eq!(limited.len(), 1, "{solution:#}");
        assert_eq!(number(limited[0], &format!("/parameters/{name}")), value);
        assert_eq!(number(&solution, "/robust/checked"), 64.0);
        assert!(solution["robust"]["exceptions"].as_array().unwrap().is_empty(), "{solution:#}");
        assert!(number(&solution, "/objective/value") < number(&solution, "/robust/nominal"));
    }
}

/// The price of the bound on stability is the slope of the worst climb speed, through another corner than the one it binds at.
#[test]
fn the_price_is_the_slope_of_the_worst_case() {
    let at = |bound: &str| {
        let constraint = format!("spectral_radius <= {bound}");
        optimum(&[
            "optimize",
            "prescribed_length",
            "--maximize",
            "climb_speed",
            "--vary",
            "psi=0..45 deg",
            "--subject-to",
            &constraint,
            "--robust",
            "l_s=12..14 cm",
        ])
    };
    let value = |solution: &Value| number(solution, "/objective/value");
    let slope = (value(&at("0.951")) - value(&at("0.949"))) / 0.002;
    assert_relative_eq!(number(&at("0.95"), "/active/0/multiplier"), slope, max_relative = 1e-4);
}

/// A folder with a spec of the project, and something added to it.
fn with(model: &str, name: &str, tables: &str) -> String {
    let specs = Path::new(env!("CARGO_MANIFEST_DIR")).join("specs");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).unwrap();
    let spec = fs::read_to_string(specs.join(format!("{model}.toml"))).unwrap();
    fs::write(folder.join(format!("{model}.toml")), spec + tables).unwrap();
    folder.to_str().unwrap().to_owned()
}

/// `robust` of a problem and `--robust` ask for the same; flags add to it and replace ranges.
#[test]
fn the_key_of_a_problem_does_what_the_flag_does() {
    let problem = "[problems.grown]\nmaximize = \"climb_speed\"\nvary = { psi = [\"0 deg\", \"45 deg\"] }\n\
                   robust = { l_s = [\"12 cm\", \"14 cm\"] }\nsubject_to = [\"spectral_radius <= 0.95\"]\n";
    let specs = with("prescribed_length", "robust_key", problem);
    let keyed = ["optimize", "prescribed_length", "--specs", &specs, "--problem", "grown"];
    let flagged = ["optimize", "prescribed_length"];
    let cases: [(&[&str], &[&str]); 3] = [
        (&[], &["--robust", "l_s=12..14 cm"]),
        (&["--robust", "l_b=45..55 cm"], &["--robust", "l_s=12..14 cm", "--robust", "l_b=45..55 cm"]),
        (&["--robust", "l_s=13..14 cm"], &["--robust", "l_s=13..14 cm"]),
    ];
    for (added, flags) in cases {
        let (by_key, by_flag) = (optimum(&[&keyed[..], added].concat()), optimum(&[&flagged[..], flags].concat()));
        for part in ["parameters", "objective", "section", "active", "robust", "iterations", "confirmation", "notes"] {
            assert_eq!(by_key[part], by_flag[part], "{added:?}");
        }
        assert!(!scenarios(&by_key).is_empty());
    }
    let cases: [(&[&str], &str); 2] = [
        (&["--vary", "l_s=10..20 cm"], "`l_s` is varied, so it cannot be uncertain"),
        (&["--trade", "climb_speed:mean_power"], "problem `grown` is robust"),
    ];
    for (flags, expected) in cases {
        let (code, _, errors) = text(&[&keyed[..], flags].concat());
        assert!(code != 0 && errors.contains(expected) && errors.contains("help:"), "{flags:?}: {errors}");
    }
}

/// The design of the worst case, held, meets the constraints with every machine, and is never better than the nominal optimum.
#[test]
fn every_machine_of_the_self_exciting_climber_is_stable() {
    let nominal = optimum(&["optimize", "self_exciting"]);
    let solution = optimum(&["optimize", "self_exciting", "--problem", "payload"]);
    let value = number(&solution, "/objective/value");
    assert_relative_eq!(
        number(&solution, "/robust/nominal"),
        number(&nominal, "/objective/value"),
        max_relative = 1e-7
    );
    assert!(value <= number(&nominal, "/objective/value") * (1.0 + 1e-9), "{solution:#}");
    let own: Vec<f64> = scenarios(&solution).iter().map(|s| number(s, "/objective")).collect();
    assert_relative_eq!(own.iter().copied().fold(f64::INFINITY, f64::min), value, max_relative = 1e-8);
    // Each machine again with this design, by the command for gaits.
    let set = |name: &str, unit: &str| format!("{name}={} {unit}", number(&solution, &format!("/parameters/{name}")));
    for scenario in scenarios(&solution) {
        let mass = format!("m={} kg", number(scenario, "/parameters/m"));
        let (gear, spring, sprawl) = (set("G", ""), set("k", "N/m"), set("psi", "rad"));
        let sets = ["--set", &mass, "--set", gear.trim(), "--set", &spring, "--set", &sprawl];
        let (code, gait) = json(&[&["gait", "self_exciting"], &sets[..]].concat());
        assert_eq!(code, 0, "{gait:#}");
        assert_relative_eq!(
            number(&gait, "/measures/climb_speed"),
            number(scenario, "/objective"),
            max_relative = 1e-8
        );
        assert!(number(&gait, "/spectral_radius") <= 0.95 * (1.0 + 1e-7), "{gait:#}");
        assert!(number(&gait, "/measures/peak_push") <= 100.0 * (1.0 + 1e-7), "{gait:#}");
    }
}

#[test]
fn what_is_wrong_is_said() {
    let cases: [(&[&str], &str); 6] = [
        (&["--robust", "psi=1..2 deg"], "`psi` is varied"),
        (&["--robust", "mass=1..2 kg"], "no parameter is named `mass`"),
        (&["--robust", "m=3..2 kg"], "above the upper one"),
        (&["--robust", "m=2..3 m"], "must be kg"),
        (&["--robust", "m=2..3 kg", "--robust", "m=2..3 kg"], "given twice"),
        (&["--robust", "m=2..3 kg", "--trade", "climb_speed:mean_power"], "--trade"),
    ];
    for (flags, expected) in cases {
        let (code, _, errors) = text(&[&["optimize", "prescribed_length"], flags].concat());
        assert!(code != 0 && errors.contains(expected), "{flags:?}: {errors}");
    }
    let dependent = ["--subject-to", "spectral_radius <= 1 - 0.01*m/(1 [kg])", "--robust", "m=2..3 kg"];
    let (code, _, errors) = text(&[&["optimize", "prescribed_length"], &dependent[..]].concat());
    assert!(code != 0 && errors.contains("not the same for all machines"), "{errors}");
}

/// Where the gait cannot be followed to a machine, that machine is named, and no table is shown that could be taken for the answer.
#[test]
fn a_machine_without_a_gait_is_named() {
    let asked = ["optimize", "power_stroke", "--robust", "m=2..60 kg"];
    let (code, out, _) = text(&asked);
    assert!(
        code != 0 && out.contains("cannot be followed to the machine with m = 60 kg: no step ends within"),
        "{out}"
    );
    assert!(out.contains("the best design without uncertainty has climb_speed = 0.8856 m/s"), "{out}");
    assert!(!out.contains("parameter  value"), "{out}");
    let (_, solution) = json(&asked);
    assert_eq!(solution["status"].as_str(), Some("no_gait"), "{solution:#}");
    assert_eq!(number(&solution, "/robust/lost/parameters/m"), 60.0);
    assert!(solution["objective"]["value"].is_null() && number(&solution, "/robust/nominal") > 0.8, "{solution:#}");
}

/// A machine that no design makes fast enough is named with its constraint.
#[test]
fn a_constraint_that_one_machine_cannot_meet() {
    let flags = ["--subject-to", "peak_force <= 75 N", "--robust", "m=1..4 kg", "--set", "m=1 kg"];
    let (code, solution) = json(&[&["optimize", "prescribed_length"], &flags[..]].concat());
    assert_ne!(code, 0, "{solution:#}");
    let message = solution["message"].as_str().unwrap();
    assert!(message.starts_with("`peak_force <= 75 N` cannot hold for all machines"), "{message}");
    let (way, reached) = (&solution["robust"]["in_the_way"], "/robust/in_the_way/reached");
    assert_eq!(number(way, "/parameters/m"), 4.0, "{solution:#}");
    // The force is in proportion to the mass, and the one that can be reached is said in its unit.
    let (least, psi) = (number(&solution, &format!("{reached}/value")), format!("{reached}/parameters/psi"));
    assert!(least > 75.0 && message.contains("for m = 4 kg `peak_force` is at least "), "{message}");
    let psi = format!("psi={} rad", number(&solution, &psi));
    for (mass, force) in [("m=4 kg", least), ("m=1 kg", least / 4.0)] {
        let (_, gait) = json(&["gait", "prescribed_length", "--set", mass, "--set", &psi]);
        assert_relative_eq!(number(&gait, "/measures/peak_force"), force, max_relative = 1e-6);
    }
}
