//! The independent route of `verify`: what a spec's expressions are, with rates as flow or as arguments.

#![allow(clippy::unwrap_used)] // a test may fail loudly

use approx::assert_relative_eq;
use gaitc::verify::reference::Reference;
use gaitc_compiler::front::parse_text;
use gaitc_runtime::model::{Functional, ModeInfo, ModelInfo, Quantity};
use gaitc_runtime::probe::{Function, Point, Variable};
use std::path::Path;

const NUMBER: Quantity = Quantity { name: "", si: "1" };
static INFO: ModelInfo = ModelInfo {
    name: "m",
    fingerprint: "",
    parameters: &[NUMBER],
    states: &[NUMBER, NUMBER],
    memory: &[],
    modes: &[ModeInfo { name: "go", switches: &[], measured_switches: &[] }],
    transitions: &[],
    switches: &[],
    coordinates: &[],
    section: None,
    symmetric: false,
    functionals: &[Functional::Mean(0), Functional::Maximum(0)],
    measures: &[NUMBER, NUMBER],
    returning: &[],
    uses_time: false,
    explicit: true,
};
const FLOW: &str = "[modes.go.flow]\nx = \"v\"\nv = \"-k*sin(x)\"\n";

fn spec(mass: &str, flow: &str) -> gaitc_compiler::ir::Model {
    let text = format!(
        "spec = 1\nname = \"m\"\n[parameters]\nk = \"3 1/s^2\"\n[state]\nx = {{ unit = \"1\" }}\nv = {{ unit = \"1/s\" }}\n\
         {mass}{flow}[measures]\na = {{ expr = \"mean(x*dot(v))\", unit = \"1/s^2\" }}\n\
         b = {{ expr = \"cycle_max(dot(v*tau))\", unit = \"1/s\" }}\n"
    );
    parse_text(Path::new("m.toml"), &text).model.unwrap()
}

fn at(tau: f64) -> Point<'static> {
    Point { x: &[0.4, 0.7], k: &[5.0, 6.0], p: &[3.0], memory: &[], functionals: &[], branch: &[], tau, t: 0.0 }
}

/// x*dot(v) = -k x sin x, and dot(v tau) = v - k tau sin x.
#[test]
fn the_flow_stands_in_for_rates_where_there_is_one() {
    let spec = spec("", FLOW);
    let (reference, at) = (Reference::new(&INFO, &spec), at(0.2));
    let (sin, cos) = 0.4_f64.sin_cos();
    assert_relative_eq!(reference.value(Function::Integrands(0), &at)[0], -3.0 * 0.4 * sin);
    let by_state = reference.derivative(Function::Integrands(0), Variable::State, &at);
    assert_relative_eq!(by_state[..], [-3.0 * (sin + 0.4 * cos), 0.0][..], max_relative = 1e-15);
    let by_parameter = reference.derivative(Function::Integrated(0), Variable::Parameter, &at);
    assert_relative_eq!(by_parameter[..], [0.0, -sin, -0.4 * sin][..], max_relative = 1e-15);
    let observable = Function::Observable { index: 0, mode: 0 };
    assert_relative_eq!(reference.value(observable, &at)[0], 0.7 - 3.0 * 0.2 * sin, max_relative = 1e-15);
    assert_relative_eq!(reference.derivative(observable, Variable::Tau, &at)[0], -3.0 * sin, max_relative = 1e-15);
    assert_eq!(reference.derivative(observable, Variable::Rate, &at), [0.0, 0.0]);
}

#[test]
fn rates_are_arguments_where_there_is_a_mass_matrix() {
    let spec = spec("[modes.go.mass]\nv = \"x\"\n", FLOW);
    let info = ModelInfo { explicit: false, ..INFO };
    let (reference, at) = (Reference::new(&info, &spec), at(0.2));
    assert_relative_eq!(reference.value(Function::Integrands(0), &at)[0], 0.4 * 6.0);
    assert_relative_eq!(reference.derivative(Function::Integrands(0), Variable::Rate, &at)[..], [0.0, 0.4][..]);
    let residual = reference.value(Function::Linearised(0), &at);
    assert_relative_eq!(residual[..], [5.0 - 0.7, 0.4 * 6.0 + 3.0 * 0.4_f64.sin()][..], max_relative = 1e-15);
    let by_rate = reference.derivative(Function::Linearised(0), Variable::Rate, &at);
    assert_relative_eq!(by_rate[..], [1.0, 0.0, 0.0, 0.4][..]);
}
