//! The vertical climber with a crank-slider: every step begins alike, so that the section has no coordinates.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;
mod crank_slider;
mod maps;

use approx::{assert_abs_diff_eq, assert_relative_eq};
use common::{json, number, text};
use crank_slider::gait::Method;
use crank_slider::machine::Machine as Reference;
use nalgebra::DVector;

#[test]
fn a_gait_without_coordinates_has_no_multipliers() {
    let (code, gait) = json(&["gait", "power_stroke_crank"]);
    assert_eq!((code, gait["status"].as_str()), (0, Some("converged")), "{gait:#}");
    assert_eq!(gait["multipliers"].as_array().map(Vec::len), Some(0));
    assert_eq!(gait["jacobian"].as_array().map(Vec::len), Some(0));
    assert_eq!(gait["section"].as_object().map(serde_json::Map::len), Some(0));
    assert_eq!(number(&gait, "/state/phi"), 0.0);
    let (_, out, _) = text(&["gait", "power_stroke_crank"]);
    assert!(out.contains("the section has no coordinates"), "{out}");
    assert!(!out.contains("spectral radius"), "{out}");
    let (code, _, errors) = text(&["optimize", "power_stroke_crank"]);
    assert_eq!(code, 0, "{errors}");
}

/// The planar climber that hangs straight down and has no sprawl is this one; its reference is collocation over the crank angle.
#[test]
fn the_step_is_that_of_the_planar_climber_without_sprawl() {
    let method = Method::default();
    for (gear, spring) in [(56.57, 58.0), (30.0, 58.0), (90.0, 150.0)] {
        let reference = Reference::new(0.0, gear, spring);
        let expected = method.map(&reference, &DVector::zeros(2)).unwrap();
        assert_abs_diff_eq!(expected.image.amax(), 0.0, epsilon = 1e-14);
        let machine = maps::Machine::new("power_stroke_crank", &[("G", gear), ("k", spring)]);
        let gait = machine.gait(None);
        assert_abs_diff_eq!(gait.map.duration, expected.step.duration, epsilon = 1e-9);
        let measures = method.measures(&reference, &expected.step);
        let measure = |name| machine.measure(&gait.map, name);
        assert_abs_diff_eq!(measure("climb_speed"), 0.13 / expected.step.duration, epsilon = 1e-8);
        assert_abs_diff_eq!(measure("mean_power"), measures.mean_power, epsilon = 1e-7);
        assert_relative_eq!(measure("peak_pull"), measures.peak_pull, max_relative = 1e-6);
    }
}
