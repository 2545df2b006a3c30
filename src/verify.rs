//! Checks every generated derivative of a model against an evaluation of its spec that shares nothing with CasADi or
//! the emitter: the expression graph evaluated with nilpotent numbers.
//!
//! Digits are counted relative to each entry's scale, its largest magnitude over all points: an entry that happens to
//! pass near zero at one point is not asked for digits that cancellation has taken away.

mod points;
pub mod reference;

use crate::load::Loaded;
use gaitc_runtime::probe::{Function, Point, Variable, functions};
pub use points::{Owned, Points};
use reference::Reference;

/// Correct digits of one generated derivative.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// The function, e.g. `flow of stance`.
    pub function: String,
    /// `value`, `state`, `parameter`, `tau`, ...
    pub with_respect_to: &'static str,
    /// Correct decimal digits of the worst entry, at most 17; 0 where an entry that should vanish does not.
    pub digits: f64,
    /// Number of points at which both routes gave finite numbers.
    pub samples: usize,
}

/// Compares all derivatives at `samples` random points made from `seed`, on the section and at zeros of guards too.
pub fn verify(loaded: &Loaded, samples: usize, seed: u64) -> Vec<Checked> {
    let info = loaded.compiled.info();
    let mut points = Points::new(loaded, seed);
    let points: Vec<_> = (0..samples).map(|_| points.next_point()).collect();
    let reference = Reference::new(info, &loaded.spec);
    let mut all = Vec::new();
    for function in functions(info) {
        let mut tables: Vec<Table> = Vec::new();
        for point in &points {
            accumulate(loaded, &reference, function, &point.borrow(), &mut tables);
        }
        let name = reference.name(function);
        all.extend(tables.iter().map(|table| table.checked(&name)));
    }
    all
}

/// Pairs (generated, reference) of one block of entries over all points.
struct Table {
    with_respect_to: &'static str,
    scale: Vec<f64>,
    error: Vec<f64>,
    samples: usize,
}

impl Table {
    fn new(with_respect_to: &'static str, entries: usize) -> Self {
        Self { with_respect_to, scale: vec![0.0; entries], error: vec![0.0; entries], samples: 0 }
    }

    /// Adds the entries of one point, unless the reference is not finite there (a point outside the model's domain).
    fn add(&mut self, generated: &[f64], reference: &[f64]) {
        if generated.len() != self.scale.len() || reference.len() != self.scale.len() {
            self.error.fill(f64::INFINITY);
            return;
        }
        if !reference.iter().all(|r| r.is_finite()) {
            return;
        }
        self.samples += 1;
        for (i, (g, r)) in generated.iter().zip(reference).enumerate() {
            let error = (g - r).abs();
            self.scale[i] = self.scale[i].max(r.abs());
            self.error[i] = self.error[i].max(if error.is_nan() { f64::INFINITY } else { error });
        }
    }

    fn checked(&self, function: &str) -> Checked {
        let digits = |(error, scale): (&f64, &f64)| match (*error, *scale) {
            (0.0, _) => 17.0,
            (error, scale) => (-(error / scale).log10()).clamp(0.0, 17.0),
        };
        let worst = self.error.iter().zip(&self.scale).map(digits).fold(17.0, f64::min);
        Checked {
            function: function.to_owned(),
            with_respect_to: self.with_respect_to,
            digits: if self.samples == 0 { 0.0 } else { worst },
            samples: self.samples,
        }
    }
}

fn accumulate(loaded: &Loaded, reference: &Reference<'_>, function: Function, at: &Point<'_>, tables: &mut Vec<Table>) {
    let Some(evaluation) = loaded.compiled.probe(function, at) else {
        return;
    };
    let value = reference.value(function, at);
    // An empty block (a model without parameters, say) has nothing to check.
    let mut blocks =
        vec![("value", evaluation.value, value.clone()), ("value without derivatives", evaluation.plain, value)];
    for (variable, columns) in evaluation.derivatives {
        if !columns.is_empty() {
            blocks.push((label(variable), columns.concat(), reference.derivative(function, variable, at)));
        }
    }
    if tables.is_empty() {
        tables.extend(blocks.iter().map(|(name, _, reference)| Table::new(name, reference.len())));
    }
    for (table, (_, generated, reference)) in tables.iter_mut().zip(&blocks) {
        table.add(generated, reference);
    }
}

fn label(variable: Variable) -> &'static str {
    match variable {
        Variable::State => "state",
        Variable::Coordinate => "coordinate",
        Variable::Functional => "functional",
        Variable::Rate => "rate",
        Variable::Parameter => "parameter",
        Variable::Tau => "tau",
        Variable::Time => "t",
    }
}
