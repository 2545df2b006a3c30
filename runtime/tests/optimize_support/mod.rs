//! Closed-form return maps and expressions for the optimizer's tests, differentiated by dual numbers.
#![allow(unreachable_pub)] // shared by test files
#![allow(dead_code)] // every test file uses its own part
#![allow(clippy::print_stdout)] // shown for failing tests only
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failing test should say where

use gaitc_runtime::model::{ModelInfo, Quantity, Section};
use gaitc_runtime::optimize::{
    Bound, Constraint, ConstraintKind, Expression, Objective, Problem, Sense, Settings, Solution, Value, Vary, solve,
};
use gaitc_runtime::return_map::{
    MapOutcome, MapRequest, MapResult, Method, RequestError, ReturnMap, Sensitivity, Statistics, Stop, StopReason,
};
use nalgebra::{DMatrix, DVector};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Room for derivatives: coordinates, parameters, measures.
const ROOM: usize = 16;

/// A number with derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Dual {
    pub v: f64,
    pub d: [f64; ROOM],
}

impl Dual {
    pub fn constant(v: f64) -> Self {
        Self { v, d: [0.0; ROOM] }
    }
    fn variable(v: f64, i: usize) -> Self {
        let mut x = Self::constant(v);
        x.d[i] = 1.0;
        x
    }
    fn chain(self, v: f64, slope: f64) -> Self {
        Self { v, d: self.d.map(|d| d * slope) }
    }
    pub fn sin(self) -> Self {
        self.chain(self.v.sin(), self.v.cos())
    }
    pub fn cos(self) -> Self {
        self.chain(self.v.cos(), -self.v.sin())
    }
    pub fn exp(self) -> Self {
        self.chain(self.v.exp(), self.v.exp())
    }
}

fn both(a: Dual, b: Dual, v: f64, da: f64, db: f64) -> Dual {
    Dual { v, d: std::array::from_fn(|i| a.d[i] * da + b.d[i] * db) }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        both(self, b, self.v + b.v, 1.0, 1.0)
    }
}
impl Sub for Dual {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        both(self, b, self.v - b.v, 1.0, -1.0)
    }
}
impl Mul for Dual {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        both(self, b, self.v * b.v, b.v, self.v)
    }
}
impl Div for Dual {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        both(self, b, self.v / b.v, 1.0 / b.v, -self.v / (b.v * b.v))
    }
}
impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        self.chain(-self.v, -1.0)
    }
}
impl Add<f64> for Dual {
    type Output = Self;
    fn add(self, b: f64) -> Self {
        self + Self::constant(b)
    }
}
impl Sub<f64> for Dual {
    type Output = Self;
    fn sub(self, b: f64) -> Self {
        self - Self::constant(b)
    }
}
impl Mul<f64> for Dual {
    type Output = Self;
    fn mul(self, b: f64) -> Self {
        self.chain(self.v * b, b)
    }
}

/// Next coordinates and measures; `None` where the map stops.
pub type Formula = fn(&[Dual], &[Dual]) -> Option<(Vec<Dual>, Vec<Dual>)>;

/// A return map in closed form.
pub struct Closed {
    info: &'static ModelInfo,
    formula: Formula,
}

const NAMES: [&str; 6] = ["p0", "p1", "p2", "p3", "p4", "p5"];

impl Closed {
    /// d coordinates, `parameters` parameters, `measures` measures.
    pub fn new(d: usize, parameters: usize, measures: usize, formula: Formula) -> Self {
        let quantities = |n: usize| -> &'static [Quantity] {
            Box::leak(NAMES[..n].iter().map(|name| Quantity { name, si: "1" }).collect())
        };
        let info = ModelInfo {
            name: "closed_form",
            fingerprint: "",
            parameters: quantities(parameters),
            states: quantities(d),
            memory: &[],
            modes: &[],
            transitions: &[],
            switches: &[],
            coordinates: Box::leak((0..d).collect()),
            section: Some(Section::After(0)),
            symmetric: false,
            functionals: &[],
            measures: quantities(measures),
            returning: &[],
            uses_time: false,
            explicit: true,
        };
        Self { info: Box::leak(Box::new(info)), formula }
    }
}

impl ReturnMap for Closed {
    fn info(&self) -> &'static ModelInfo {
        self.info
    }

    fn evaluate(&self, request: &MapRequest<'_>) -> Result<MapOutcome, RequestError> {
        assert_eq!(request.period, 1);
        let d = request.coordinates.len();
        let z: Vec<Dual> = request.coordinates.iter().enumerate().map(|(i, &v)| Dual::variable(v, i)).collect();
        let p: Vec<Dual> = request.parameters.iter().enumerate().map(|(i, &v)| Dual::variable(v, d + i)).collect();
        let columns: Vec<usize> = match request.sensitivity {
            Sensitivity::None => vec![],
            Sensitivity::Coordinates => (0..d).collect(),
            Sensitivity::CoordinatesAndParameters(chosen) => (0..d).chain(chosen.iter().map(|i| d + i)).collect(),
        };
        let Some((next, measures)) = (self.formula)(&z, &p) else {
            return Ok(MapOutcome::Stopped(Stop { reason: StopReason::NoEvent, time: 1.0, state: vec![] }));
        };
        let measures = if request.measures { measures } else { vec![] };
        let values = |x: &[Dual]| DVector::from_iterator(x.len(), x.iter().map(|x| x.v));
        let slopes = |x: &[Dual]| DMatrix::from_fn(x.len(), columns.len(), |i, j| x[i].d[columns[j]]);
        Ok(MapOutcome::Completed(Box::new(MapResult {
            end: DVector::zeros(0),
            coordinates: values(&next),
            jacobian: slopes(&next),
            state: DVector::from_column_slice(request.coordinates),
            duration: 1.0,
            duration_gradient: DVector::zeros(columns.len()),
            measures: values(&measures),
            measures_jacobian: slopes(&measures),
            events: vec![],
            also_zero: vec![],
            method: Method::Explicit,
            statistics: Statistics::default(),
            warnings: vec![],
        })))
    }
}

/// An expression over measures and parameters.
pub struct Formed(pub fn(&[Dual], &[Dual]) -> Dual);

impl Expression for Formed {
    fn evaluate(&self, measures: &[f64], parameters: &[f64]) -> Value {
        let n = measures.len();
        let m: Vec<Dual> = measures.iter().enumerate().map(|(i, &v)| Dual::variable(v, i)).collect();
        let p: Vec<Dual> = parameters.iter().enumerate().map(|(i, &v)| Dual::variable(v, n + i)).collect();
        let value = (self.0)(&m, &p);
        Value {
            value: value.v,
            dmeasures: value.d[..n].to_vec(),
            dparameters: value.d[n..n + parameters.len()].to_vec(),
        }
    }
}

/// An affine expression: what shadow prices are tested with (its constant is the relaxation).
pub struct Shifted(pub fn(&[Dual], &[Dual]) -> Dual, pub f64);

impl Expression for Shifted {
    fn evaluate(&self, measures: &[f64], parameters: &[f64]) -> Value {
        let mut value = Formed(self.0).evaluate(measures, parameters);
        value.value += self.1;
        value
    }
}

pub fn expression(f: fn(&[Dual], &[Dual]) -> Dual) -> Objective {
    Objective::Expression(Box::new(Formed(f)))
}

pub fn margin(name: &str, f: fn(&[Dual], &[Dual]) -> Dual) -> Constraint {
    Constraint { name: name.to_owned(), kind: ConstraintKind::Margin { margin: Box::new(Formed(f)), scale: 1.0 } }
}

pub fn spectral(bound: f64) -> Constraint {
    Constraint {
        name: format!("spectral_radius <= {bound}"),
        kind: ConstraintKind::SpectralRadius { bound: Bound::Constant(bound) },
    }
}

/// All parameters vary in the given ranges, from `parameters`; the section starts at zero.
pub fn problem<'a>(
    map: &'a Closed,
    sense: Sense,
    objective: Objective,
    parameters: &[f64],
    ranges: &[(f64, f64)],
) -> Problem<'a> {
    Problem {
        map,
        memory: vec![],
        parameters: parameters.to_vec(),
        period: 1,
        vary: ranges.iter().enumerate().map(|(parameter, &(lower, upper))| Vary { parameter, lower, upper }).collect(),
        sense,
        objective,
        constraints: vec![],
        start: vec![0.0; map.info.coordinates.len()],
        settings: Settings::default(),
    }
}

pub fn solved(problem: &Problem<'_>) -> Solution {
    let solution = solve(problem).expect("the problem is right as stated");
    println!(
        "{:?}: {} {:?} after {} iterations",
        solution.status, solution.message, solution.notes, solution.iterations
    );
    solution
}

/// z* + J (z - z*) + a small square, in any dimension.
pub fn about(z: &[Dual], center: &[Dual], jacobian: &[Vec<Dual>]) -> Vec<Dual> {
    let e: Vec<Dual> = z.iter().zip(center).map(|(z, c)| *z - *c).collect();
    (0..z.len())
        .map(|i| {
            let linear = e.iter().enumerate().fold(center[i], |sum, (j, e)| sum + jacobian[i][j] * *e);
            linear + e[i] * e[i] * 0.01
        })
        .collect()
}
