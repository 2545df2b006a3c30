//! Every generated derivative of every model against an independent route: nothing to edit when a spec is added.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

use approx::assert_relative_eq;
use gaitc::load::embedded;
use gaitc::models::MODELS;
use gaitc::verify::verify;
use gaitc_runtime::probe::{Function, Point, Variable};

#[test]
fn every_generated_derivative_has_twelve_digits() {
    assert!(!MODELS.is_empty());
    for entry in MODELS {
        let loaded = embedded(entry).unwrap();
        let checked = verify(&loaded, 300, 7);
        assert!(!checked.is_empty());
        for c in checked {
            assert!(c.samples >= 100, "{}: {c:?}", loaded.spec.name);
            assert_relative_eq!(10f64.powf(-c.digits), 0.0, epsilon = 1e-12);
        }
    }
}

/// M_L written by hand: df/dx, df/domega, df/dl_s at one point of the stroke.
#[test]
fn flow_derivatives_of_the_prescribed_length_climber_by_hand() {
    let entry = MODELS.iter().find(|e| e.compiled.info().name == "prescribed_length").unwrap();
    let loaded = embedded(entry).unwrap();
    let (q, p, tau) = (0.31_f64, -0.7, 0.061);
    let (l_s, l_b, g, omega) = (0.13, 0.5, 9.81, 6.0 * std::f64::consts::PI);
    let (sin, cos) = (omega * tau).sin_cos();
    let r = l_b + l_s / 2.0 * (1.0 + cos);
    let v = -l_s / 2.0 * omega * sin;
    let info = entry.compiled.info();
    let at = Point {
        x: &[q, p],
        k: &[0.0; 2],
        p: &loaded.parameters(),
        memory: &[0.0],
        functionals: &vec![1.0; info.functionals.len()],
        branch: &vec![true; info.switches.len()],
        tau,
        t: tau,
    };
    let flow = entry.compiled.probe(Function::Flow(0), &at).unwrap();
    let column = |variable: Variable, j: usize| {
        let (_, columns) = flow.derivatives.iter().find(|(v, _)| *v == variable).unwrap();
        [columns[j][0], columns[j][1]]
    };
    let check = |got: [f64; 2], expected: [f64; 2]| {
        for (got, expected) in got.into_iter().zip(expected) {
            assert_relative_eq!(got, expected, epsilon = 1e-14, max_relative = 1e-13);
        }
    };
    check([flow.value[0], flow.value[1]], [p / r, -g * q.sin() - v * p / r]);
    check(column(Variable::State, 0), [0.0, -g * q.cos()]);
    check(column(Variable::State, 1), [1.0 / r, -v / r]);
    let (r_omega, v_omega) = (-l_s / 2.0 * tau * sin, -l_s / 2.0 * (sin + omega * tau * cos));
    let expected = [-p / (r * r) * r_omega, -v_omega * p / r + v * p / (r * r) * r_omega];
    check(column(Variable::Parameter, loaded.parameter("omega").unwrap()), expected);
    let (r_l, v_l) = ((1.0 + cos) / 2.0, -omega * sin / 2.0);
    let expected = [-p / (r * r) * r_l, -v_l * p / r + v * p / (r * r) * r_l];
    check(column(Variable::Parameter, loaded.parameter("l_s").unwrap()), expected);
}
