//! Every model of specs/ has a gait at its own values, and a problem that is solved from there.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use common::json;
use gaitc::load::load;
use gaitc::models::MODELS;

fn names() -> impl Iterator<Item = &'static str> {
    MODELS.iter().map(|entry| entry.compiled.info().name)
}

#[test]
fn every_model_has_a_gait() {
    for name in names() {
        let (code, gait) = json(&["gait", name]);
        assert_eq!((code, gait["status"].as_str()), (0, Some("converged")), "{name}: {gait:#}");
        assert!(gait["warnings"].as_array().unwrap().is_empty(), "{name}: {gait:#}");
        let measures = gait["measures"].as_object().unwrap();
        assert!(!measures.is_empty() && measures.values().all(serde_json::Value::is_number), "{name}: {gait:#}");
    }
}

#[test]
fn every_model_has_a_problem_that_is_solved() {
    for name in names() {
        let (code, best) = json(&["optimize", name]);
        assert_eq!((code, best["status"].as_str()), (0, Some("optimal")), "{name}: {best:#}");
    }
}

#[test]
fn every_model_says_where_it_comes_from_and_what_its_quantities_are() {
    for name in names() {
        let spec = load(name, None).unwrap().spec;
        assert!(!spec.source.is_empty(), "{name}");
        let documented = spec.parameters.iter().map(|p| (&p.name, &p.doc));
        let documented = documented.chain(spec.states.iter().map(|s| (&s.name, &s.doc)));
        for (what, doc) in documented.chain(spec.measures.iter().map(|m| (&m.name, &m.doc))) {
            assert!(!doc.is_empty(), "{name}: {what} has no doc");
        }
        assert!(spec.parameters.iter().all(|p| p.range.is_some()), "{name}");
    }
}
