//! `gaitc compare` through the program: published numbers stand beside what `gait` computes at the same parameters.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use common::{json, number, text};
use serde_json::Value;
use std::fs;

fn comparisons(answer: &Value) -> Vec<Value> {
    answer["comparisons"].as_array().unwrap().clone()
}

/// One number of a comparison.
fn of<'a>(comparison: &'a Value, name: &str) -> &'a Value {
    let numbers = comparison["numbers"].as_array().unwrap();
    numbers.iter().find(|number| number["name"] == name).unwrap_or_else(|| panic!("{name}: {comparison:#}"))
}

#[test]
fn published_numbers_stand_beside_those_of_the_gait() {
    let (code, answer) = json(&["compare", "self_exciting"]);
    assert_eq!(code, 0, "{answer:#}");
    let all = comparisons(&answer);
    let names: Vec<_> = all.iter().map(|one| one["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["machine", "thesis"]);
    let (_, gait) = json(&["gait", "self_exciting", "--set", "psi=20 deg"]);
    let published = [[0.72, 0.20, 3.7], [0.75, 0.15, 3.0]];
    for (comparison, published) in all.iter().zip(published) {
        assert_eq!(comparison["status"], "converged");
        for (name, value) in ["climb_speed", "lateral_speed", "stride_frequency"].into_iter().zip(published) {
            let row = of(comparison, name);
            let computed = number(&gait, &format!("/measures/{name}"));
            assert!((number(row, "/published") - value).abs() < 1e-12 * value, "{row:#}");
            assert!((number(row, "/computed") - computed).abs() < 1e-9 * computed, "{row:#} {computed}");
            assert!((number(row, "/deviation") - (computed - value) / value).abs() < 1e-9, "{row:#}");
        }
    }
}

/// The gait is computed at the parameters of the publication, and found from what is published of it.
#[test]
fn each_source_is_compared_at_its_own_parameters() {
    let (code, answer) = json(&["compare"]);
    assert_eq!(code, 0, "{answer:#}");
    let all = comparisons(&answer);
    for comparison in &all {
        assert_eq!(comparison["status"], "converged", "{comparison:#}");
        assert_ne!(comparison["source"], "", "{comparison:#}");
    }
    let find = |model: &str, name: &str| {
        let found = all.iter().find(|one| one["model"] == model && one["name"] == name);
        found.unwrap_or_else(|| panic!("{model} {name}")).clone()
    };
    for (name, sprawl) in [("at_5_deg", 5.0_f64), ("at_10_deg", 10.0), ("at_15_deg", 15.0)] {
        let comparison = find("angle_switched", name);
        assert!((number(&comparison, "/set/psi") - sprawl.to_radians()).abs() < 1e-15);
        // All published digits agree.
        let row = of(&comparison, "spectral_radius").clone();
        assert!((number(&row, "/published") - number(&row, "/computed")).abs() < 5e-4, "{row:#}");
    }
    let walker = find("compass_walker", "simplest");
    for name in ["theta_st", "w_st"] {
        assert!(number(of(&walker, name), "/deviation").abs() < 5e-6, "{walker:#}");
    }
}

#[test]
fn the_table_has_both_columns_in_the_published_unit() {
    let (code, said, _) = text(&["compare", "self_exciting"]);
    assert_eq!(code, 0, "{said}");
    let rows: Vec<&str> = said.lines().filter(|line| line.contains("climb_speed")).collect();
    assert_eq!(rows.len(), 2, "{said}");
    assert!(rows[1].contains("75 cm/s") && rows[1].matches("cm/s").count() == 2 && rows[1].contains(" %"), "{said}");
    assert!(said.contains("at psi = 20 deg") && said.contains("source: "), "{said}");
}

/// The animals' speeds scatter: the spread stands behind the number, and is drawn.
#[test]
fn spreads_are_shown() {
    let (_, answer) = json(&["compare", "fg_template"]);
    let row = of(&comparisons(&answer)[0], "climb_speed").clone();
    assert!((number(&row, "/spread") - 0.042).abs() < 1e-15, "{row:#}");
    let (_, said, _) = text(&["compare", "fg_template"]);
    assert!(said.contains("19.5 cm/s ± 4.2 cm/s"), "{said}");
    let spec = fs::read_to_string("specs/fg_template.toml").unwrap();
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path().to_str().unwrap();
    for (own, says) in [
        ("spread = { climb_speed = \"-4.2 cm/s\" }", "the spread of `climb_speed` is negative"),
        ("spread = { climb_sped = \"4.2 cm/s\" }", "did you mean `climb_speed`?"),
        ("spread = { climb_speed = \"4.2 cm\" }", "`climb_speed`"),
    ] {
        let own = spec.replace("spread = { climb_speed = \"4.2 cm/s\" }", own);
        assert_ne!(own, spec);
        fs::write(format!("{folder}/fg_template.toml"), own).unwrap();
        let (code, _, errors) = text(&["--specs", folder, "compare", "fg_template"]);
        assert!(code == 1 && errors.contains(says), "{errors}");
    }
}

/// What is a value of a curve is drawn: means, also of what the spec does not draw, and coordinates of the section.
#[test]
fn published_values_of_curves_are_lines_in_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let drawn = |model: &str| {
        let file = folder.path().join(format!("{model}.svg"));
        let (code, _, errors) = text(&["compare", model, "--plot", file.to_str().unwrap()]);
        assert_eq!(code, 0, "{errors}");
        (fs::read_to_string(file).unwrap_or_default(), errors)
    };
    for (model, levels) in [
        (
            "self_exciting",
            &["thesis, v_y: mean, published, 0.75 m/s", "thesis, abs(v_x): mean, published, 0.15 m/s"][..],
        ),
        ("compass_walker", &["theta_st: on the section, published, -0.1913 rad", "w_st, w_sw [rad/s]"]),
        ("fg_template", &["v_y: mean, published, 0.195 m/s ± 0.042 m/s"]),
    ] {
        let (picture, _) = drawn(model);
        for level in levels {
            assert!(picture.contains(level), "{model}: no {level}");
        }
    }
    let (picture, errors) = drawn("angle_switched");
    assert!(
        picture.is_empty() && errors.contains("warning: --plot") && errors.contains("value of a curve"),
        "{errors}"
    );
}

/// A spec of one's own: a gait that is not found is said, the other is shown; what is wrong is an error.
#[test]
fn a_gait_that_is_not_found_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path().to_str().unwrap();
    let spec = fs::read_to_string("specs/angle_switched.toml").unwrap();
    let own = spec.replace("set = { psi = \"5 deg\" }", "set = { psi = \"18 deg\" }");
    assert_ne!(own, spec);
    fs::write(format!("{folder}/angle_switched.toml"), own).unwrap();
    let (code, answer) = json(&["--specs", folder, "compare"]);
    let all = comparisons(&answer);
    assert_eq!((code, all.len()), (2, 3), "{answer:#}");
    assert_ne!(all[0]["status"], "converged");
    assert_eq!(of(&all[0], "spectral_radius")["computed"], Value::Null);
    assert!(of(&all[1], "spectral_radius")["computed"].is_number());
    let (_, out, _) = text(&["--specs", folder, "compare", "angle_switched"]);
    assert!(out.contains(all[0]["message"].as_str().unwrap()), "{out}");
    for (args, said) in [
        (&["compare", "rotational"][..], "has no published numbers"),
        (&["compare", "rotationl"], "did you mean `rotational`?"),
        (&["--specs", "docs/language", "compare"], "no model has published numbers"),
    ] {
        let (code, _, err) = text(args);
        assert_eq!(code, 1);
        assert!(err.contains(said), "{err}");
    }
}
