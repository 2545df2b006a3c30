//! Command-line flags in the language of specs.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed unwrap fails the test

use gaitc_compiler::dimension::Dimension;
use gaitc_compiler::front::flags::{
    FlagError, Values, parse_assignment, parse_constraint, parse_objective, parse_quantity, parse_range, parse_values,
};
use gaitc_compiler::front::{parse_file, units::parse_unit};
use gaitc_compiler::ir::{Model, Node, Symbol};
use std::path::Path;

fn dimension(unit: &str) -> Dimension {
    parse_unit(unit).unwrap().dimension
}

/// Code, message and underlined characters of an error with one diagnostic.
fn told<T: std::fmt::Debug>(result: Result<T, FlagError>) -> (String, String, String) {
    let error = result.unwrap_err();
    let diagnostic = &error.diagnostics[0];
    let underlined = error.sources.slice(diagnostic.primary().unwrap()).to_owned();
    (diagnostic.code.to_string(), diagnostic.message.clone(), underlined)
}

fn told_str(code: &str, message: &str, underlined: &str) -> (String, String, String) {
    (code.to_owned(), message.to_owned(), underlined.to_owned())
}

fn climber() -> Model {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/prescribed_length.toml");
    parse_file(&path).unwrap().model.unwrap()
}

#[test]
fn quantities() {
    assert_eq!(parse_quantity("25 deg", Dimension::NONE).unwrap(), 25f64.to_radians());
    assert_eq!(parse_quantity("13 cm", dimension("m")).unwrap(), 0.13);
    assert_eq!(parse_quantity("2*pi*3 rad/s", dimension("1/s")).unwrap(), std::f64::consts::PI * 6.0);
    assert_eq!(parse_quantity("1e-3 kg m^2", dimension("kg m^2")).unwrap(), 1e-3);
    assert_eq!(parse_quantity("(1 + 1/2) N/m", dimension("N/m")).unwrap(), 1.5);
    assert_eq!(parse_quantity("sqrt(2) m", dimension("m")).unwrap(), 2f64.sqrt());
    assert_eq!(parse_quantity("max(1, 2)*3 [cm]", dimension("m")).unwrap(), 0.06);
    assert_eq!(parse_quantity("0", dimension("m")).unwrap(), 0.0);
    assert_eq!(parse_quantity("-0.5", Dimension::NONE).unwrap(), -0.5);
    assert_eq!(parse_quantity("50 %", Dimension::NONE).unwrap(), 0.5);
    assert_eq!(parse_quantity("20°", Dimension::NONE).unwrap(), 20f64.to_radians());
}

#[test]
fn values_of_a_sweep() {
    let metre = dimension("m");
    let range = |lower, upper, count| Values::Range { lower, upper, count };
    assert_eq!(parse_values("0..2 m:11", metre).unwrap(), range(0.0, 2.0, Some(11)));
    assert_eq!(parse_values("0..2 m", metre).unwrap(), range(0.0, 2.0, None));
    assert_eq!(parse_values("-50 cm .. 2 m : 3", metre).unwrap(), range(-0.5, 2.0, Some(3)));
    assert_eq!(parse_values("1, 2 cm, 5 m", metre).unwrap(), Values::List(vec![1.0, 0.02, 5.0]));
    assert_eq!(parse_values("max(1, 2), 3 m", metre).unwrap(), Values::List(vec![2.0, 3.0]));
    assert_eq!(parse_values("3", Dimension::NONE).unwrap(), Values::List(vec![3.0]));
    assert_eq!(told(parse_values("1, 2 kg, 3 m", metre)).2, "2 kg");
    assert_eq!(told(parse_values("1, 2", metre)).1, "the last value needs a unit");
    assert_eq!(told(parse_values("0..2 m:x", metre)), told_str("E0101", "this is no number of values", "x"));
    assert_eq!(told(parse_values("0..2 m:1:2", metre)).0, "E0104");
    for wrong in ["", ",", "1 m,", "..", "0..2 m:", "0..2 m:0", "0..2 m:-1", "2..0 m:3", "(1, 2 m"] {
        assert!(parse_values(wrong, metre).is_err(), "{wrong}");
    }
}

#[test]
fn wrong_quantities() {
    let metre = dimension("m");
    assert_eq!(told(parse_quantity("13", metre)), told_str("E0305", "this quantity needs a unit", "13"));
    assert_eq!(told(parse_quantity("13 kg", metre)), told_str("E0305", "this quantity must be m, not kg", "13 kg"));
    assert_eq!(told(parse_quantity("13 cmm", metre)), told_str("E0104", "unknown unit `cmm`", "cmm"));
    assert_eq!(told(parse_quantity("2*l_s", metre)), told_str("E0107", "a quantity cannot use `l_s`", "l_s"));
    assert_eq!(told(parse_quantity("", metre)), told_str("E0101", "an expression is missing here", ""));
    assert_eq!(told(parse_quantity("1/0 m", metre)), told_str("E0108", "division by zero", "0"));
    assert_eq!(told(parse_quantity("10^400 m", metre)).0, "E0108");
    assert_eq!(told(parse_quantity("1e300*1e300 m", metre)).0, "E0108");
    assert_eq!(told(parse_quantity("1 m)", metre)).0, "E0104");
}

#[test]
fn ranges() {
    let stiffness = dimension("N/m");
    assert_eq!(parse_range("0..200 N/m", stiffness).unwrap(), (0.0, 200.0));
    assert_eq!(parse_range("15..120", Dimension::NONE).unwrap(), (15.0, 120.0));
    assert_eq!(parse_range("1..45 deg", Dimension::NONE).unwrap(), (1f64.to_radians(), 45f64.to_radians()));
    assert_eq!(parse_range("50 cm..2 m", dimension("m")).unwrap(), (0.5, 2.0));
    assert_eq!(parse_range("2*pi*2 .. 2*pi*4 rad/s", dimension("1/s")).unwrap().1, std::f64::consts::PI * 8.0);
    assert_eq!(parse_range("-0.5..0.5", Dimension::NONE).unwrap(), (-0.5, 0.5));
    // A third dot is a slip of the hand more often than the point of `.5`.
    assert_eq!(told(parse_range("-0.5...5", Dimension::NONE)), told_str("E0101", "a range has two dots", "-0.5...5"));
}

#[test]
fn wrong_ranges() {
    let metre = dimension("m");
    assert_eq!(
        told(parse_range("2..1 m", metre)),
        told_str("E0404", "the lower bound of the range is above the upper one", "2..1 m")
    );
    assert_eq!(told(parse_range("2 m", metre)), told_str("E0101", "this is not a range", "2 m"));
    assert_eq!(told(parse_range("1 m..2", metre)), told_str("E0305", "the upper bound needs a unit", "2"));
    assert_eq!(told(parse_range("1..2 s", metre)).0, "E0305");
    assert_eq!(told(parse_range("..2 m", metre)), told_str("E0101", "an expression is missing here", ""));
    assert_eq!(told(parse_range("1..", metre)), told_str("E0101", "an expression is missing here", ""));
}

#[test]
fn assignments() {
    assert_eq!(parse_assignment("psi=25 deg").unwrap(), ("psi", "25 deg"));
    assert_eq!(parse_assignment(" k = 0..200 N/m").unwrap(), ("k", "0..200 N/m"));
    assert_eq!(told(parse_assignment("psi")).0, "E0101");
    assert_eq!(told(parse_assignment("2x=3")), told_str("E0205", "what stands before `=` is no name", "2x"));
}

#[test]
fn constraints_and_objectives() {
    let mut model = climber();
    let stable = parse_constraint(&mut model, "spectral_radius <= 0.9").unwrap();
    assert_eq!(model.graph.constant_value(stable.stability_bound.unwrap()), Some(0.9));
    let force = parse_constraint(&mut model, "peak_force <= 150 N").unwrap();
    assert_eq!((force.stability_bound, force.dimension, &*force.text), (None, dimension("N"), "peak_force <= 150 N"));
    let faster = parse_constraint(&mut model, "climb_speed >= 2*lateral_speed").unwrap();
    assert_eq!((faster.dimension, &faster.unit), (dimension("m/s"), &None));
    let unit = |text: &str, model: &mut Model| parse_constraint(model, text).unwrap().unit;
    assert_eq!(unit("climb_speed <= 2*pi km / h ", &mut model).as_deref(), Some("km / h"));
    assert_eq!(unit("climb_speed <= 2 [km/h]", &mut model), None);
    let (node, unit) = parse_objective(&mut model, "spectral_radius").unwrap();
    assert_eq!((model.graph.node(node), unit), (Node::Symbol(Symbol::SpectralRadius), Dimension::NONE));
    assert_eq!(parse_objective(&mut model, "climb_speed/omega").unwrap().1, dimension("m"));

    let told = |text: &str, model: &mut Model| told(parse_constraint(model, text));
    assert_eq!(told("climb_sped <= 1 m/s", &mut model), told_str("E0201", "undefined name `climb_sped`", "climb_sped"));
    assert_eq!(told("climb_speed", &mut model).0, "E0408");
    assert_eq!(told("climb_speed <= 1", &mut model).0, "E0301");
    assert_eq!(told("p_theta <= 1 m/s", &mut model).0, "E0207");
    assert_eq!(told("climb_speed <= psi m/s", &mut model).0, "E0101");
}

#[test]
fn errors_underline_the_flag() {
    let error = parse_quantity("25 degr", Dimension::NONE).unwrap_err();
    let text = error.to_string();
    assert!(text.contains("error[E0104]: unknown unit `degr`") && text.contains("did you mean `deg`?"), "{text}");
    assert!(text.contains("1 | 25 degr\n  |    ^^^^"), "{text}");
    assert!(error.render(true).contains('\u{1b}'));
}

/// The end of an argument is what is read of it; the whole is what is shown.
#[test]
fn a_flag_is_shown_with_its_whole_argument() {
    let said = |argument: &str| {
        let (_, text) = parse_assignment(argument).unwrap();
        parse_values(text, dimension("m")).unwrap_err().given_as("--over", argument).to_string()
    };
    let shown = said("l_s = 1..z m:3");
    assert!(shown.contains("--> --over:1:10\n") && shown.contains("1 | l_s = 1..z m:3\n  |          ^"), "{shown}");
    assert!(said("l_s=").contains("--> --over:1:5\n"), "{}", said("l_s="));
    assert!(said("l_s=1 µg").contains("--> --over:1:5\n"), "{}", said("l_s=1 µg"));
    // What is no part of the argument stays as it was read.
    let alone = parse_quantity("1 kg", dimension("m")).unwrap_err().given_as("--set", "other").to_string();
    assert!(alone.contains("--> command line:1:1") && alone.contains("| 1 kg"), "{alone}");
}
