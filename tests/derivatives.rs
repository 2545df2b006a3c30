//! Every generated derivative of every model against an independent route: nothing to edit when a spec is added.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

use approx::assert_relative_eq;
use gaitc::load::{Loaded, embedded};
use gaitc::models::MODELS;
use gaitc::verify::{Points, verify};
use gaitc_compiler::ir::eval::{Environment, value};
use gaitc_runtime::probe::{Function, Point, Variable};
use nalgebra::DMatrix;

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

/// What depends only on the clock and parameters, taken out and put in again, changes nothing but the last places.
#[test]
fn terms_of_the_clock_and_the_rest_make_the_whole_flow() {
    let mut modes = 0;
    for entry in MODELS.iter().filter(|entry| entry.compiled.info().explicit) {
        let loaded = embedded(entry).unwrap();
        let mut points = Points::new(&loaded, 11);
        let points: Vec<_> = (0..200).map(|_| points.next_point()).collect();
        for mode in 0..entry.compiled.info().modes.len() {
            modes += 1;
            let at = |function: Function, point: &Point<'_>| -> Vec<f64> {
                let evaluation = entry.compiled.probe(function, point).unwrap();
                let columns = evaluation.derivatives.into_iter().flat_map(|(_, columns)| columns.concat());
                evaluation.value.into_iter().chain(columns).collect()
            };
            let whole: Vec<_> = points.iter().map(|point| at(Function::Variational(mode), &point.borrow())).collect();
            let parts: Vec<_> = points.iter().map(|point| at(Function::Staged(mode), &point.borrow())).collect();
            for i in 0..whole[0].len() {
                let finite = |row: &&Vec<f64>| row[i].is_finite();
                let scale = whole.iter().filter(finite).map(|row| row[i].abs()).fold(0.0, f64::max);
                for (whole, parts) in whole.iter().zip(&parts) {
                    let close = (whole[i] - parts[i]).abs() <= 8.0 * f64::EPSILON * scale;
                    assert!(close || !whole[i].is_finite(), "{}: {} {}", loaded.spec.name, whole[i], parts[i]);
                }
            }
        }
    }
    assert!(modes > 5);
}

/// A mass matrix that is singular where maps begin is compared there, and not only where it is regular.
#[test]
fn points_include_those_where_a_mass_matrix_is_singular() {
    let mut singular_on_section = 0;
    for entry in MODELS.iter().filter(|entry| !entry.compiled.info().explicit) {
        let loaded = embedded(entry).unwrap();
        let mut points = Points::new(&loaded, 7);
        let points: Vec<_> = (0..300).map(|_| points.next_point()).collect();
        let regularity = |at: &Point<'_>| {
            let residual = entry.compiled.probe(Function::Linearised(0), at).unwrap();
            let (_, columns) = residual.derivatives.iter().find(|(v, _)| *v == Variable::Rate).unwrap();
            DMatrix::from_fn(columns.len(), columns.len(), |i, j| columns[j][i]).singular_values().min()
        };
        let regularities: Vec<f64> = points.iter().map(|point| regularity(&point.borrow())).collect();
        let regular = regularities.iter().filter(|r| **r > 1e-6).count();
        assert!(regular >= 50, "{}: {regular} regular points", loaded.spec.name);
        let start = Point { x: &section_start(&loaded), ..points[0].borrow() };
        if regularity(&start) < 1e-20 {
            singular_on_section += 1;
            let singular = regularities.iter().filter(|r| **r < 1e-20).count();
            assert!(singular >= 100, "{}: {singular} singular points", loaded.spec.name);
        }
    }
    assert!(singular_on_section > 0, "no model has a mass matrix that is singular on its section any more");
}

/// The first guess of a gait as a full state.
fn section_start(loaded: &Loaded) -> Vec<f64> {
    let section = loaded.spec.section.as_ref().unwrap();
    let mut x = vec![0.0; loaded.spec.states.len()];
    for (&i, start) in section.coordinates.iter().zip(&section.start) {
        x[i] = *start;
    }
    let at = Environment { states: &x, parameters: &loaded.parameters(), ..Environment::default() };
    section.embed.iter().map(|&e| value(&loaded.spec.graph, e, &at)).collect()
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
