//! The crank-slider climber with a rotor whose inertia is not neglected: its crank speed is a state that steps hand over, so
//! the section has three coordinates. As the inertia goes to zero it becomes the climber without.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod crank_slider;
mod gaits;

use approx::assert_abs_diff_eq;
use crank_slider::gait::Method;
use crank_slider::machine::Machine;
use gaitc::load::load;
use gaitc_runtime::return_map::Accuracy;
use gaits::gait;

/// Rotor inertias (kg m^2) of which the first two are noticed and the last is next to none.
const INERTIAS: [f64; 4] = [1e-5, 1e-6, 1e-7, 1e-9];

#[test]
fn gaits_agree_with_collocation_over_the_crank_angle() {
    let (model, method) = (load("self_exciting_rotor", None).unwrap(), Method::default());
    for machine in [Machine::nominal(), Machine::new(25.0, 30.0, 200.0)] {
        for rotor in INERTIAS {
            let machine = Machine { rotor, ..machine };
            let expected = method.gait(&machine).unwrap();
            let found = gait(&model, &machine, Accuracy::default());
            assert_eq!(found.section.len(), 3);
            for (name, expected) in ["q_theta", "p_theta", "Omega"].into_iter().zip(&expected.coordinates) {
                assert_abs_diff_eq!(found.section[name], *expected, epsilon = 1e-8 * expected.abs().max(1.0));
            }
            assert_abs_diff_eq!(found.gait.map.duration, expected.map.step.duration, epsilon = 1e-8);
            for (a, b) in found.gait.multipliers.iter().zip(&expected.multipliers) {
                assert!((a - b).norm() < 1e-8, "{machine:?}: {a} for {b}");
            }
        }
    }
}

/// First order in the inertia: the crank needs a time proportional to it to reach the motor's no-load speed after touch-down,
/// and before the dead centre it lags behind by a speed proportional to it. The third multiplier, what is left at the end of a step of
/// a disturbance of the crank's speed at its start, goes to zero faster than any power.
#[test]
fn the_gait_tends_to_the_one_without_rotor_at_first_order() {
    let with = load("self_exciting_rotor", None).unwrap();
    let without = load("self_exciting", None).unwrap();
    let limit = gait(&without, &Machine::nominal(), Accuracy::default());
    let errors = |rotor: f64| {
        let found = gait(&with, &Machine { rotor, ..Machine::nominal() }, Accuracy::default());
        let coordinates = limit.section.iter().map(|(name, value)| (found.section[name] - value).abs());
        let pairs = limit.gait.multipliers.iter().zip(&found.gait.multipliers);
        [
            coordinates.fold(0.0, f64::max),
            (found.gait.map.duration - limit.gait.map.duration).abs(),
            pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max),
        ]
    };
    let [coarse, fine] = [1e-8, 1e-9].map(errors);
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        assert_abs_diff_eq!((coarse / fine).log10(), 1.0, epsilon = 0.01);
    }
}

#[test]
fn the_third_multiplier_goes_to_zero() {
    let model = load("self_exciting_rotor", None).unwrap();
    let third = INERTIAS.map(|rotor| {
        let found = gait(&model, &Machine { rotor, ..Machine::nominal() }, Accuracy::default());
        found.gait.multipliers[2].norm()
    });
    // From 4 % over a hundred-millionth to nothing but rounding.
    assert!(third[0] > 0.03 && third[1] < 1e-6 && third[2] < 1e-9 && third[3] < 1e-9, "{third:?}");
}
