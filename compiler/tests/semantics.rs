//! What expressions mean: each text of the language against the same formula written in Rust, both where selectors are
//! frozen (a flow) and where they are chosen at once (a measure).

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

use approx::assert_relative_eq;
use gaitc_compiler::front::parse_text;
use gaitc_compiler::ir::Model;
use gaitc_compiler::ir::eval::{Environment, value};
use std::path::Path;

type Formula = fn(f64, f64, f64) -> f64;

const FORMULAS: &[(&str, Formula)] = &[
    ("a + b - c", |a, b, c| a + b - c),
    ("a - b - c", |a, b, c| (a - b) - c),
    ("a/b/c", |a, b, c| (a / b) / c),
    ("a*b/c*a", |a, b, c| a * b / c * a),
    ("-a^2", |a, _, _| -(a * a)),
    ("2^-1*a", |a, _, _| 0.5 * a),
    ("2^3^2", |_, _, _| 512.0),
    ("-2^2 + a*0", |_, _, _| -4.0),
    ("(a + b)*c", |a, b, c| (a + b) * c),
    ("1.5e1 - .5*a", |a, _, _| 15.0 - 0.5 * a),
    ("pi*a", |a, _, _| std::f64::consts::PI * a),
    ("sin(a) + cos(b)*tan(c)", |a, b, c| a.sin() + b.cos() * c.tan()),
    ("asin(a/10) + acos(b/10) + atan(c)", |a, b, c| (a / 10.0).asin() + (b / 10.0).acos() + c.atan()),
    ("atan2(a, b)", |a, b, _| a.atan2(b)),
    ("sinh(a) + cosh(b) + tanh(c)", |a, b, c| a.sinh() + b.cosh() + c.tanh()),
    ("asinh(a) + acosh(2 + b^2) + atanh(c/10)", |a, b, c| a.asinh() + (2.0 + b * b).acosh() + (c / 10.0).atanh()),
    ("exp(a) + log(1 + b^2) + sqrt(1 + c^2)", |a, b, c| a.exp() + (1.0 + b * b).ln() + (1.0 + c * c).sqrt()),
    ("min(a, b)", |a, b, _| a.min(b)),
    ("max(a, b)", |a, b, _| a.max(b)),
    ("max(a, 0)", |a, _, _| a.max(0.0)),
    ("min(max(a, b), c)", |a, b, c| a.max(b).min(c)),
    ("abs(a) + abs(b - c)", |a, b, c| a.abs() + (b - c).abs()),
    ("sign(a)*b", |a, b, _| a.signum() * b),
    ("if(a <= b, a, c)", |a, b, c| if a <= b { a } else { c }),
    ("if(a >= b, a, c)", |a, b, c| if a >= b { a } else { c }),
    ("if(a < b, 1, 2)", |a, b, _| if a < b { 1.0 } else { 2.0 }),
    ("if(a > b, 1, 2)", |a, b, _| if a > b { 1.0 } else { 2.0 }),
    ("if(a > b and b > c, 1, 2)", |a, b, c| if a > b && b > c { 1.0 } else { 2.0 }),
    ("if(a > b or b > c, 1, 2)", |a, b, c| if a > b || b > c { 1.0 } else { 2.0 }),
    ("if(not (a > b or b > c) and a < 1, 1, 2)", |a, b, c| if !(a > b || b > c) && a < 1.0 { 1.0 } else { 2.0 }),
    ("if(a > b, if(b > c, 1, 2), 3)", |a, b, c| if a > b { if b > c { 1.0 } else { 2.0 } } else { 3.0 }),
    ("d(a^3*b, a)", |a, b, _| 3.0 * a * a * b),
    ("d(d(sin(a*b), a), b)", |a, b, _| (a * b).cos() - a * b * (a * b).sin()),
    ("twice(b, a) + c", |a, b, c| 2.0 * b + a + c),
    ("u", |a, b, _| (a + b) * (a + b)),
];

fn model(text: &str) -> Model {
    let spec = format!(
        r#"
        spec = 1
        name = "one"
        title = "one"
        source = "test"
        [parameters]
        a = "1"
        b = "1"
        c = "1"
        [state]
        x = {{ unit = "s", doc = "x" }}
        [let]
        v = "a + b"
        u = "v*v"
        [functions]
        twice = {{ args = ["z", "w"], expr = "2*z + w" }}
        [modes.m.flow]
        x = "{text}"
        [transitions.e]
        from = "m"
        to = "m"
        guard = "x"
        direction = "falling"
        [transitions.e.reset]
        x = "x"
        [section]
        after = "e"
        coordinates = ["x"]
        [section.start]
        x = "1 s"
        [measures]
        m = {{ expr = "{text}", unit = "1", doc = "m" }}
        "#
    );
    let parsed = parse_text(Path::new("one.toml"), &spec);
    let said = gaitc_compiler::diagnostic::render(&parsed.diagnostics, &parsed.sources, false);
    parsed.model.unwrap_or_else(|| panic!("{text}: {said}"))
}

const POINTS: &[[f64; 3]] =
    &[[0.3, 0.7, 0.5], [0.7, 0.3, 0.5], [-0.7, 0.3, 0.1], [0.9, -0.3, -1.1], [-0.2, -0.6, -0.4], [1.3, 0.2, 0.8]];

#[test]
fn every_expression_means_what_its_formula_says() {
    for (text, formula) in FORMULAS {
        let model = model(text);
        for p @ [a, b, c] in POINTS {
            let at = Environment { parameters: p, states: &[0.2], ..Environment::default() };
            // A switching function may depend on other selectors: as many passes as there are settle any order.
            let mut sides = vec![false; model.switches.len()];
            for _ in 0..model.switches.len() {
                let frozen = Environment { branch: &sides, ..at };
                sides = model.switches.iter().map(|s| value(&model.graph, s.expr, &frozen) >= 0.0).collect();
            }
            let frozen = Environment { branch: &sides, ..at };
            let flow = value(&model.graph, model.modes[0].flow[0], &frozen);
            let measure = value(&model.graph, model.measures[0].expr, &at);
            for got in [flow, measure] {
                assert_relative_eq!(got, formula(*a, *b, *c), max_relative = 1e-13, epsilon = 1e-14);
            }
        }
    }
}
