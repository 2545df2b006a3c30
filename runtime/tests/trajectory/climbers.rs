//! Trajectories of climbers: symmetric ones, and one whose mass matrix vanishes at dead centres.

use super::common::climbers::{M_L, parameters};
use super::common::crank::{self, M_S};
use super::common::{completed, request};
use super::trajectory::{differences, follow, from_section};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use gaitc_runtime::return_map::{Accuracy, MapRequest, Method, Sensitivity};
use gaitc_runtime::trajectory::{FollowRequest, Sampling, Start};

/// P = S o R with memory at its start. R with the memory after a step is S o R o S: two steps of the machine are P o P, one is S o P.
#[test]
fn the_real_machine_is_the_map_without_its_symmetry() {
    let (z, p, memory) = ([-0.4, -0.3], parameters(25.0), [0.0]);
    let one = MapRequest { memory: &memory, ..request(&z, &p, Sensitivity::None) };
    let single = completed(&M_L, &one);
    let once = follow(&M_L, &from_section(&z, &p, &memory, 1));
    let double = completed(&M_L, &MapRequest { period: 2, ..one });
    let twice = follow(&M_L, &from_section(&z, &p, &memory, 2));
    for i in 0..2 {
        assert_abs_diff_eq!(once.end[i], -single.coordinates[i], epsilon = 1e-12);
        assert_abs_diff_eq!(twice.end[i], double.coordinates[i], epsilon = 1e-12);
    }
    let memories: Vec<f64> = twice.events.iter().map(|e| e.memory[0]).collect();
    assert_eq!(memories, [1.0, 2.0]);
    assert_eq!((twice.segments[0].memory[0], twice.segments[1].memory[0]), (0.0, 1.0));
}

/// Started elsewhere: at a sample of a run, with its clock and memory, a run goes on as that one did.
#[test]
fn a_run_can_be_started_at_any_place() {
    let (z, p, memory) = ([-0.4, -0.3], parameters(25.0), [0.0]);
    let whole = follow(&M_L, &from_section(&z, &p, &memory, 2));
    let sample = whole.samples.iter().filter(|s| s.segment == 1).nth(7).unwrap();
    let start = Start::State { mode: 0, state: sample.state, tau: sample.tau };
    let rest = follow(&M_L, &FollowRequest { start, ..from_section(&z, &p, &whole.segments[1].memory, 1) });
    assert_eq!(rest.segments[0].tau, sample.tau);
    assert_eq!((rest.samples.t[0], rest.samples.tau[0]), (0.0, sample.tau));
    assert_abs_diff_eq!(rest.time, whole.time - sample.t, epsilon = 1e-13);
    for (a, b) in rest.end.iter().zip(&whole.end) {
        assert_abs_diff_eq!(*a, *b, epsilon = 1e-12);
    }
}

/// The bounds are those of the ends of steps, far below what polynomials through the stages would give.
#[test]
fn samples_are_as_exact_as_steps() {
    let (p, crank, memory) = (parameters(25.0), crank::parameters(56.57, 58.0, 20.0), [0.0]);
    let sampling = Sampling::Interval(1.7e-3);
    let by = |relative: f64, method| Accuracy { relative, absolute: 0.1 * relative, method, ..Accuracy::default() };
    let climber = FollowRequest { sampling, ..from_section(&[-0.4, -0.3], &p, &memory, 1) };
    let exact = follow(&M_L, &FollowRequest { accuracy: by(1e-14, Method::Explicit), ..climber });
    for method in [Method::Explicit, Method::Radau5] {
        for tolerance in [1e-6, 1e-8, 1e-10] {
            let accuracy = by(tolerance, method);
            let (states, rates) = differences(&exact, &follow(&M_L, &FollowRequest { accuracy, ..climber }));
            assert!(states < tolerance && rates < tolerance, "{method:?} {tolerance:e}: {states:e} {rates:e}");
        }
    }
    let climber = FollowRequest { sampling, ..from_section(&[-0.35, -0.22], &crank, &[], 1) };
    let exact = follow(&M_S, &FollowRequest { accuracy: by(1e-14, Method::Radau5), ..climber });
    for (method, tolerance, state, rate) in [
        (Method::Radau5, 1e-10, 5e-9, 2e-6),
        (Method::Radau5, 1e-12, 2e-9, 2e-7),
        (Method::Radau3, 1e-10, 1.5e-8, 6e-6),
    ] {
        let accuracy = by(tolerance, method);
        let (states, rates) = differences(&exact, &follow(&M_S, &FollowRequest { accuracy, ..climber }));
        assert!(states < state && rates < rate, "{method:?} {tolerance:e}: {states:e} {rates:e}");
    }
}

/// By differences of sixth order, over a whole step and both dead centres; and where the step ends the mass matrix is zero.
#[test]
fn rates_are_the_derivatives_of_states() {
    let (p, crank, memory) = (parameters(25.0), crank::parameters(56.57, 58.0, 20.0), [0.0]);
    let h = 2e-4;
    let sampling = Sampling::Interval(h);
    let climber = follow(&M_L, &FollowRequest { sampling, ..from_section(&[-0.4, -0.3], &p, &memory, 1) });
    let slider = follow(&M_S, &FollowRequest { sampling, ..from_section(&[-0.35, -0.22], &crank, &[], 1) });
    for (run, tolerance) in [(&climber, 1e-9), (&slider, 1e-5)] {
        // Without the places of events and switches.
        let grid: Vec<_> = run.samples.iter().filter(|s| ((s.t / h).round() * h - s.t).abs() < 1e-13).collect();
        assert!(grid.len() > 700, "{}", grid.len());
        for seven in grid.windows(7).filter(|seven| (seven[6].t - seven[0].t - 6.0 * h).abs() < 1e-12) {
            for i in 0..seven[3].state.len() {
                let odd = |a: usize, b: usize| seven[b].state[i] - seven[a].state[i];
                let rate = (odd(0, 6) - 9.0 * odd(1, 5) + 45.0 * odd(2, 4)) / (60.0 * h);
                assert_relative_eq!(seven[3].rate[i], rate, epsilon = tolerance, max_relative = tolerance);
            }
        }
    }
    let measured = MapRequest { measures: true, ..request(&[-0.35, -0.22], &crank, Sensitivity::None) };
    let map = completed(&M_S, &measured);
    let last = slider.samples.get(slider.samples.len() - 1).unwrap();
    assert_relative_eq!(last.rate[1], map.measures[5], max_relative = 1e-8);
    assert!(slider.samples.rates.iter().all(|v| v.is_finite()));
    assert_abs_diff_eq!(slider.end[2], -map.coordinates[0], epsilon = 1e-12);
}
