//! Models for tests.
#![allow(dead_code, unreachable_pub, reason = "each test file uses some of it")]

use gaitc_compiler::back::rust::{Options, emit};
use gaitc_compiler::casadi::environment::Search;
use gaitc_compiler::casadi::{self, Python};
use gaitc_compiler::diagnostic::render;
use gaitc_compiler::front;
use gaitc_compiler::ir::canonical::fingerprint;
use gaitc_compiler::ir::*;
use gaitc_compiler::valid::{Validated, validate};
use std::path::{Path, PathBuf};

/// Python with CasADi: as a build finds it, its private packages below this workspace's target directory.
pub fn search() -> Search {
    let temporary = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let target = temporary.ancestors().find(|folder| folder.join("CACHEDIR.TAG").is_file()).unwrap_or(temporary);
    Search::from_environment(Some(target.join("gaitc-python")))
}

pub fn python() -> Python {
    search().find().unwrap()
}

/// A file of the tests.
pub fn test_file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(path)
}

/// The model of a spec.
pub fn parse(name: &str, text: &str) -> Model {
    let parsed = front::parse_text(Path::new(&format!("{name}.toml")), text);
    parsed.model.unwrap_or_else(|| panic!("{}", render(&parsed.diagnostics, &parsed.sources, false)))
}

/// Every operation, and what the language does not offer yet: a second mode, rates in observables and resets.
pub fn every_operation() -> Model {
    let mut model =
        parse("every_operation", &std::fs::read_to_string(test_file("golden/every_operation.toml")).unwrap());
    let [x, y, z] = [0, 1, 2].map(|i| model.graph.symbol(Symbol::State(i)));
    let rate = model.graph.symbol(Symbol::Rate(0));
    let minus_x = model.graph.unary(Unary::Neg, x);
    let product = model.graph.binary(Binary::Mul, y, z);
    model.modes.push(Mode {
        name: "second".into(),
        flow: vec![y, minus_x, product],
        mass: None,
        has_state: vec![true; 3],
    });
    let mut back = model.transitions[0].clone();
    back.name = "back".into();
    (back.from, back.to) = (1, 0);
    (back.guard, back.direction, back.when) = (y, Direction::Either, None);
    let sum = model.graph.binary(Binary::Add, x, rate);
    back.reset = vec![sum, minus_x, product];
    model.transitions.push(back);
    model.transitions[0].to = 1;
    model.functionals.push(Functional { kind: FunctionalKind::Minimum, expr: rate });
    let value = model.graph.symbol(Symbol::Functional(model.functionals.len() - 1));
    let product = model.graph.binary(Binary::Mul, rate, y);
    model.functionals.push(Functional { kind: FunctionalKind::Integral, expr: product });
    let mut slowest = model.measures[0].clone();
    (slowest.name, slowest.expr) = ("slowest".into(), value);
    model.measures.push(slowest);
    model
}

/// A model with a mass matrix, and measures of rates: a rod on a cart.
pub fn with_mass_matrix() -> Model {
    parse("cart", &std::fs::read_to_string(test_file("golden/cart.toml")).unwrap())
}

/// The texts that are generated for some models.
pub fn generate(python: &Python, models: &[Validated]) -> Vec<String> {
    let all: Vec<&Validated> = models.iter().collect();
    let programs = casadi::derive(python, &all).unwrap();
    let text = |(model, programs): (&Validated, &casadi::Programs)| {
        let options = Options { runtime_path: "::gaitc_runtime".into(), fingerprint: fingerprint(model.model()) };
        emit(model, programs, &options).unwrap()
    };
    models.iter().zip(&programs).map(text).collect()
}

pub fn validated(model: Model) -> Validated {
    validate(model).unwrap_or_else(|defects| panic!("{}", defects.join("\n")))
}
