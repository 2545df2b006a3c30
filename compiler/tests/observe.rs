//! Observations: names of `[let]` and expressions given at run time, against formulas written out by hand.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed unwrap fails the test

use approx::assert_relative_eq;
use gaitc_compiler::front::{Observations, Parsed, parse_file, parse_text};
use gaitc_compiler::ir::canonical::canonical;
use gaitc_compiler::ir::eval::{Environment, value};
use gaitc_compiler::ir::{Model, Point};
use std::f64::consts::PI;
use std::path::{Path, PathBuf};

fn specs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs")
}

fn spec(name: &str) -> (Model, Observations) {
    whole(parse_file(&specs().join(format!("{name}.toml"))).unwrap())
}

fn whole(parsed: Parsed) -> (Model, Observations) {
    (parsed.model.unwrap(), parsed.observations.unwrap())
}

fn parameters(model: &Model) -> Vec<f64> {
    model.parameters.iter().map(|parameter| parameter.value).collect()
}

/// The values of some observations at a point.
fn at(name: &str, observed: &[&str], point: &Point<'_>) -> Vec<f64> {
    let (model, mut observations) = spec(name);
    let chosen: Vec<_> = observed.iter().map(|text| observations.observe(text).unwrap()).collect();
    observations.observer(&chosen, &parameters(&model)).at(point)
}

/// Relative to the size of the numbers that make it up.
fn assert_values(got: &[f64], want: &[f64]) {
    assert_eq!(got.len(), want.len());
    for (i, (got, want)) in got.iter().zip(want).enumerate() {
        assert!((got - want).abs() <= 1e-13 * (1.0 + want.abs()), "number {i}: {got} instead of {want}");
    }
}

#[test]
fn lets_of_a_leg_of_prescribed_length() {
    let (l_s, l_b, m, g, psi, omega) = (0.13, 0.5, 2.6, 9.81, 20f64.to_radians(), 6.0 * PI);
    let names = ["r", "v_r", "delta", "rho_a", "v_x", "v_y", "power"];
    let (q, p) = (0.3_f64, -0.7);
    for (tau, n) in [(0.0, 0), (0.05, 1), (0.11, 2), (0.2, 3)] {
        let shortening = tau <= PI / omega;
        let phase: f64 = omega * tau;
        let r = if shortening { l_b + l_s / 2.0 * (1.0 + phase.cos()) } else { l_b };
        let v_r = if shortening { -l_s / 2.0 * omega * phase.sin() } else { 0.0 };
        let a_r = if shortening { -l_s / 2.0 * omega * omega * phase.cos() } else { 0.0 };
        let rho_a = -m * a_r + m * g * q.cos() + m * p * p / r;
        let delta = if n % 2 == 0 { 2.0 * psi } else { -2.0 * psi };
        let (v_x, v_y) = (v_r * q.sin() + p * q.cos(), -v_r * q.cos() + p * q.sin());
        let point = Point { x: &[q, p], tau, t: 1.0, memory: &[f64::from(n)], ..Point::default() };
        let got = at("prescribed_length", &names, &point);
        assert_values(&got, &[r, v_r, delta, rho_a, v_x, v_y, -rho_a * v_r]);
    }
}

#[test]
fn rates_of_the_crank_slider_are_those_that_the_integrator_knows() {
    let (a, c, l_b, m, g): (f64, f64, f64, f64, f64) = (0.065, 0.195, 0.5, 2.6, 9.81);
    let (phi, rate, q, p) = (1.1_f64, 17.0, -0.2_f64, 0.4);
    let k = [17.0, -90.0, 0.6, 1.3];
    let root = (c * c - a * a * phi.sin().powi(2)).sqrt();
    let r = l_b + a * phi.cos() + root - (c - a);
    // By hand: r' = -a sin - a^2 sin cos/root, and r'' from it.
    let (s, o) = (phi.sin(), phi.cos());
    let r_1 = -a * s - a * a * s * o / root;
    let r_2 = -a * o - a * a * (o * o - s * s) / root - a.powi(4) * s * s * o * o / root.powi(3);
    let a_r = r_2 * k[0] * rate + r_1 * k[1];
    let (v_r, weight) = (r_1 * rate, m * g * q.cos() + m * p * p / r);
    let point = Point { x: &[phi, rate, q, p], k: &k, memory: &[1.0], ..Point::default() };
    let names = ["r", "r_1", "r_2", "dot(v_r)", "rho_a", "v_y", "motor_power", "delta"];
    let drive = 56.57 * 0.321 * (1.0 - 56.57 * rate / 1250.0);
    let want = [r, r_1, r_2, a_r, weight - m * a_r, -v_r * q.cos() + p * q.sin(), drive * rate, -40f64.to_radians()];
    assert_values(&at("self_exciting", &names, &point), &want);
}

#[test]
fn a_let_that_spans_modes_takes_the_states_of_the_mode_at_hand() {
    let (q, p_r, p_theta): (f64, f64, f64) = (0.1, -0.3, 0.2);
    let stance = Point { x: &[0.02, p_r, q, p_theta, 0.0, 0.0], tau: 0.01, memory: &[0.0], ..Point::default() };
    let flight = Point { x: &[0.0, 0.0, 0.0, 0.0, 0.05, 0.4], tau: 0.001, memory: &[0.0], ..Point::default() };
    let speeds = [p_r * q.sin() + p_theta * q.cos(), -p_r * q.cos() + p_theta * q.sin()];
    assert_values(&at("fg_template", &["v_x", "v_y"], &stance), &speeds);
    assert_values(&at("fg_template", &["v_x", "v_y"], &flight), &[0.05, 0.4]);
    let (l_0, z, f) = (0.0154, 0.6, 9.0);
    let phase: f64 = 2.0 * PI * f * 0.01;
    let length = l_0 * (1.0 + z * phase.cos());
    let rate = -l_0 * z * 2.0 * PI * f * phase.sin();
    let force = 6.0 * (0.02 - length) + 0.09 * (p_r - rate);
    assert_values(&at("fg_template", &["L", "rho_a", "q_next"], &stance), &[length, force, -10f64.to_radians()]);
}

#[test]
fn expressions_of_the_user() {
    let (model, mut observations) = spec("prescribed_length");
    let weight = observations.observe(" m*g ").unwrap();
    assert_eq!((weight.name.as_str(), weight.unit.as_str()), ("m*g", "N"));
    let angle = observations.observe("q_theta").unwrap();
    assert_eq!((angle.name.as_str(), angle.text.as_str()), ("q_theta", "leg angle from the downward vertical"));
    let rate = observations.observe("dot(q_theta)").unwrap();
    assert_eq!(rate.unit, "s^-1");
    let largest = observations.observe("max(m*g, abs(rho_a))").unwrap();
    let force = observations.observe("rho_a").unwrap();
    assert!(observations.named().contains(&force));
    let share = observations.observe("if(q_theta < 0, t/2, tau*n)").unwrap();
    let chosen = [weight, angle, rate, largest, force, share];
    let mut observer = observations.observer(&chosen, &parameters(&model));
    let point = Point { x: &[-0.2, 0.1], k: &[7.0, 8.0], tau: 0.2, t: 3.0, memory: &[4.0] };
    let force = 2.6 * 9.81 * 0.2f64.cos() + 2.6 * 0.01 / 0.5;
    assert_values(&observer.at(&point), &[2.6 * 9.81, -0.2, 7.0, 2.6 * 9.81, force, 1.5]);
    let point = Point { x: &[0.2, 1.0], ..point };
    let force = 2.6 * 9.81 * 0.2f64.cos() + 2.6 / 0.5;
    assert_values(&observer.at(&point), &[2.6 * 9.81, 0.2, 7.0, force, force, 0.8]);
}

#[test]
fn functions_of_parts_can_be_called() {
    let point = Point { x: &[0.5, 10.0, 0.0, 0.0], ..Point::default() };
    let torque = 56.57 * 0.321 * (1.0 - 56.57 * 20.0 / 1250.0);
    assert_values(&at("self_exciting", &["drive(2*Omega)", "d(r, phi) - r_1"], &point), &[torque, 0.0]);
}

#[test]
fn what_cannot_be_observed_is_told_with_what_to_write() {
    let (_, mut observations) = spec("self_exciting");
    for (text, code, message, help) in [
        ("m*rho_b", "E0201", "undefined name `rho_b`", "did you mean `rho_a`?"),
        ("m + g", "E0301", "`+` cannot join kg and m/s^2", ""),
        ("climb_speed", "E0207", "`climb_speed` is available in measures and problems only", "known after a map"),
        ("mean(v_y)", "E0207", "`mean` is available in measures only", "define a measure"),
        ("dot(rho_a)", "E0207", "this is a second time derivative, which is not computed", "without `dot`"),
        ("q_theta >= 0", "E0106", "a condition stands where a number is expected", "if(condition, a, b)"),
        ("m*", "E0101", "", ""),
        ("", "E0101", "", ""),
        ("drive", "E0208", "`drive` is a function, not a value", "drive(...)"),
        ("drive()", "E0105", "`drive` takes 1 argument, not 0", ""),
        ("1/0", "E0108", "division by zero", ""),
    ] {
        let error = observations.observe(text).unwrap_err();
        let diagnostic = &error.diagnostics[0];
        assert_eq!(diagnostic.code.to_string(), code, "{text}: {error}");
        assert!(diagnostic.message.contains(message), "{text}: {error}");
        assert!(diagnostic.help.as_deref().unwrap_or("").contains(help), "{text}: {error}");
        assert!(error.to_string().contains("command line"), "{text}: {error}");
    }
    // Nothing is left behind by what was wrong.
    assert!(observations.observe("m*g").is_ok());
}

/// The route that checks derivatives evaluates each expression alone; the observer shares what they have in common.
#[test]
fn every_let_of_every_spec_has_the_value_that_the_interpreter_gives_it() {
    let mut count = 0;
    for entry in std::fs::read_dir(specs()).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let (model, observations) = whole(parse_file(&path).unwrap());
        count += observations.named().len();
        let parameters = parameters(&model);
        let mut observer = observations.observer(observations.named(), &parameters);
        for n in 0..5 {
            let number = |i: usize| (1.3 * i as f64 + 0.7 * f64::from(n)).sin();
            let x: Vec<f64> = (0..model.states.len()).map(number).collect();
            let k: Vec<f64> = (0..model.states.len()).map(|i| 3.0 * number(i + 9)).collect();
            let memory: Vec<f64> = model.memory.iter().map(|_| f64::from(n)).collect();
            let (tau, t) = (0.05 * f64::from(n), 2.0);
            let got = observer.at(&Point { x: &x, k: &k, tau, t, memory: &memory });
            let at = Environment {
                states: &x,
                rates: &k,
                parameters: &parameters,
                memory: &memory,
                tau,
                time: t,
                ..Environment::default()
            };
            for (observation, got) in observations.named().iter().zip(got) {
                let want = value(observations.graph(), observation.expr, &at);
                assert!(got == want || (got.is_nan() && want.is_nan()), "{}: {got} {want}", observation.name);
            }
        }
    }
    assert!(count > 50, "only {count}");
}

const BALL: &str = r#"
spec = 1
name = "ball"
[parameters]
g = "9.81 m/s^2"
[state]
x = { unit = "m" }
v = { unit = "m/s" }
[let]
speed = "abs(v)"
LET
[modes.flight.flow]
x = "v"
v = "-g"
[transitions.bounce]
from = "flight"
to = "flight"
guard = "x"
direction = "falling"
[transitions.bounce.reset]
x = "x"
v = "-v/2"
[measures]
top_speed = { expr = "cycle_max(speed)", unit = "m/s" }
"#;

fn ball(lets: &str) -> (Model, Observations) {
    whole(parse_text(Path::new("ball.toml"), &BALL.replace("LET", lets)))
}

#[test]
fn observations_leave_no_trace_in_the_equations() {
    let (plain, _) = ball("");
    let (model, observations) = ball("height = \"if(x > 1 [m], 2*x, min(x, v^2/g)) + d(x*v, x)*0 [s]\"");
    assert_eq!(canonical(&model), canonical(&plain));
    assert_eq!((model.switches.len(), model.graph.nodes().len()), (1, plain.graph.nodes().len()));
    assert_eq!(observations.named().len(), 2);
    let (other, _) = ball("height = \"3*x\"");
    assert_eq!(canonical(&other), canonical(&plain));
    // A let that a measure uses is an equation.
    let (used, _) = whole(parse_text(Path::new("ball.toml"), &BALL.replace("LET", "").replace("abs(v)", "v")));
    assert_ne!(canonical(&used), canonical(&plain));
}

#[test]
fn derivatives_nest_and_the_branch_not_taken_does_not_matter() {
    let lets = r#"
cube = "x^3*v"
slope = "d(d(cube, x), x)"
mixed = "d(d(slope, v), x)"
turn = "if(x >= 0, sqrt(x), 0 [m^(1/2)])"
steep = "d(turn, x)"
along = "dot(cube)"
"#;
    let (model, mut observations) = ball(lets);
    let names = ["slope", "mixed", "turn", "steep", "along", "d(speed, v)", "dot(abs(x))"];
    let chosen: Vec<_> = names.iter().map(|name| observations.observe(name).unwrap()).collect();
    let mut observer = observations.observer(&chosen, &parameters(&model));
    let got = observer.at(&Point { x: &[4.0, -3.0], k: &[-3.0, -9.81], ..Point::default() });
    let along = 3.0 * 16.0 * -3.0 * -3.0 + 64.0 * -9.81;
    for (got, want) in got.iter().zip([6.0 * 4.0 * -3.0, 6.0, 2.0, 0.25, along, -1.0, -3.0]) {
        assert_relative_eq!(*got, want, max_relative = 1e-14);
    }
    let got = observer.at(&Point { x: &[-4.0, 3.0], k: &[3.0, -9.81], ..Point::default() });
    assert_eq!(got[2..4], [0.0, 0.0]);
    assert_eq!(got[5..], [1.0, -3.0]);
    // A rate that is not given is not a number, and makes nothing else wrong.
    let got = observer.at(&Point { x: &[4.0, -3.0], ..Point::default() });
    assert!(got[4].is_nan() && got[2] == 2.0);
}
