//! The self-exciting climber with its crank-slider as gaitc computes it, against the reference in `crank_slider`: another
//! formulation (the crank angle as independent variable) and another method (collocation), over sprawl, gear ratio and
//! spring, down to gear ratios where the crank overspeeds in a thin layer before the dead centre.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod crank_slider;
mod gaits;

use approx::{assert_abs_diff_eq, assert_relative_eq};
use crank_slider::cases;
use crank_slider::gait::Method;
use gaitc::load::load;
use gaitc_runtime::return_map::Accuracy;
use gaits::gait;

#[test]
fn gaits_agree_with_collocation_over_the_crank_angle() {
    let (model, method) = (load("self_exciting", None).unwrap(), Method::default());
    for machine in cases() {
        let expected = method.gait(&machine).unwrap();
        let found = gait(&model, &machine, Accuracy::default());
        assert_eq!(found.section.len(), 2, "{machine:?}");
        for (name, expected) in ["q_theta", "p_theta"].into_iter().zip(&expected.coordinates) {
            assert_abs_diff_eq!(found.section[name], *expected, epsilon = 1e-8);
        }
        assert_abs_diff_eq!(found.gait.map.duration, expected.map.step.duration, epsilon = 1e-8);
        assert_eq!(found.gait.multipliers.len(), 2);
        for (a, b) in found.gait.multipliers.iter().zip(&expected.multipliers) {
            assert!((a - b).norm() < 1e-8, "{machine:?}: {a} for {b}");
        }
    }
}

#[test]
fn results_do_not_change_when_the_tolerance_is_tightened() {
    let model = load("self_exciting", None).unwrap();
    let usual = Accuracy::default();
    let tight = Accuracy { relative: usual.relative / 100.0, absolute: usual.absolute / 100.0, ..usual };
    for machine in cases() {
        let [a, b] = [usual, tight].map(|accuracy| gait(&model, &machine, accuracy).gait);
        assert_abs_diff_eq!((a.coordinates - b.coordinates).amax(), 0.0, epsilon = 1e-9);
        assert_abs_diff_eq!(a.map.duration, b.map.duration, epsilon = 1e-9);
        for (a, b) in a.multipliers.iter().zip(&b.multipliers) {
            assert!((a - b).norm() < 1e-9, "{machine:?}: {a} and {b}");
        }
    }
}

#[test]
fn measures_agree_with_collocation_over_the_crank_angle() {
    let (model, method) = (load("self_exciting", None).unwrap(), Method::default());
    for machine in cases() {
        let expected = method.measures(&machine, &method.gait(&machine).unwrap().map.step);
        let found = gait(&model, &machine, Accuracy::default());
        let means = [
            ("climb_speed", expected.climb_speed),
            ("lateral_speed", expected.lateral_speed),
            ("mean_power", expected.mean_power),
            ("regenerated_power", expected.regenerated_power),
        ];
        for (name, expected) in means {
            assert_abs_diff_eq!(found.measures[name], expected, epsilon = 1e-8 * expected.abs().max(1.0));
        }
        // Extrema are read off the continuous output, whose order is lower, and forces off its derivative.
        let extrema = [
            ("peak_pull", expected.peak_pull),
            ("peak_push", expected.peak_push),
            ("peak_motor_speed", expected.peak_motor_speed),
        ];
        for (name, expected) in extrema {
            assert_relative_eq!(found.measures[name], expected, max_relative = 1e-6);
        }
    }
}
