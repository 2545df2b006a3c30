//! A problem with its model: gaits, and what they are worth, from measures and eigenvalues alone.

use super::problems::{Asked, Case, Flags};
use gaitc::load::{Loaded, load};
use gaitc_compiler::front::flags::{parse_constraint, parse_objective, parse_range};
use gaitc_compiler::ir::eval::{Environment, value};
use gaitc_compiler::ir::{Model, Problem, Sense, Vary};
use gaitc_runtime::orbit::{GaitRequest, GaitStatus, find_gait};

/// Violation, relative to the size of a bound, that counts as none: rounding.
const NOTHING: f64 = 1e-10;
/// Smallest part of the way that a gait is followed at once.
const SHORTEST: f64 = 1.0 / 256.0;

/// A case ready to be evaluated.
pub struct Instance {
    pub loaded: Loaded,
    pub spec: Model,
    pub problem: Problem,
}

/// A gait, and what it is worth.
#[derive(Clone, Debug)]
pub struct Sample {
    /// Fractions of the ranges.
    pub at: Vec<f64>,
    pub coordinates: Vec<f64>,
    /// Objective, SI units.
    pub objective: f64,
    /// The objective, or minus it: to be minimised.
    pub cost: f64,
    /// Sum of the constraints' violations, each relative to its bound; 0 where all hold.
    pub violation: f64,
}

impl Sample {
    /// Less violation is better, then less cost.
    pub fn better(&self, other: &Self) -> bool {
        (self.violation, self.cost) < (other.violation, other.cost)
    }

    /// By how much the objective is better, where both keep all constraints.
    pub fn gain(&self, other: &Self) -> f64 {
        if self.violation > 0.0 { 0.0 } else { other.cost - self.cost }
    }
}

impl Instance {
    pub fn of(case: &Case) -> Self {
        let loaded = load(case.model, None).expect("the spec is the compiled one");
        let mut spec = loaded.spec.clone();
        let problem = match &case.problem {
            Asked::Named(name) => {
                spec.problems.iter().find(|p| p.name == *name).expect("a problem of that name").clone()
            }
            Asked::Flags(flags) => from_flags(&mut spec, flags),
        };
        Self { loaded, spec, problem }
    }

    /// Number of varied parameters.
    pub fn len(&self) -> usize {
        self.problem.vary.len()
    }

    /// All parameters at fractions of the ranges.
    pub fn parameters(&self, at: &[f64]) -> Vec<f64> {
        let mut parameters = self.loaded.parameters();
        for (vary, x) in self.problem.vary.iter().zip(at) {
            let value = vary.lower + x * (vary.upper - vary.lower);
            parameters[vary.parameter] = value.clamp(vary.lower, vary.upper);
        }
        parameters
    }

    /// The fractions at which parameters stand, inside the ranges.
    pub fn fractions(&self, parameters: &[f64]) -> Vec<f64> {
        let fraction = |v: &Vary| ((parameters[v.parameter] - v.lower) / (v.upper - v.lower)).clamp(0.0, 1.0);
        self.problem.vary.iter().map(fraction).collect()
    }

    /// The gait at the spec's own parameters.
    pub fn home(&self) -> (Vec<f64>, Vec<f64>) {
        let parameters = self.loaded.parameters();
        let (coordinates, _, _) = self.gait(&parameters, &self.loaded.start()).expect("the spec has a gait");
        (parameters, coordinates)
    }

    /// Coordinates, measures and spectral radius of the gait near a guess.
    fn gait(&self, parameters: &[f64], guess: &[f64]) -> Option<(Vec<f64>, Vec<f64>, f64)> {
        let memory = self.loaded.memory();
        let outcome =
            find_gait(self.loaded.compiled, &GaitRequest::new(parameters, &memory), guess).expect("a request");
        let gait = outcome.gait.filter(|_| outcome.status == GaitStatus::Converged)?;
        let measures = gait.map.measures.as_slice().to_vec();
        Some((gait.coordinates.as_slice().to_vec(), measures, gait.spectral_radius))
    }

    /// The gait at fractions of the ranges, near a guess; `None` where there is none.
    pub fn sample(&self, at: &[f64], guess: &[f64]) -> Option<Sample> {
        let parameters = self.parameters(at);
        let (coordinates, measures, spectral_radius) = self.gait(&parameters, guess)?;
        let graph = &self.spec.graph;
        let here =
            Environment { measures: &measures, parameters: &parameters, spectral_radius, ..Environment::default() };
        let zeros = vec![0.0; measures.len()];
        let bare = Environment { measures: &zeros, parameters: &parameters, ..Environment::default() };
        let violation = |c: &gaitc_compiler::ir::Constraint| {
            let size = value(graph, c.margin, &bare).abs();
            -value(graph, c.margin, &here) / if size.is_normal() { size } else { 1.0 }
        };
        let violations = self.problem.constraints.iter().map(violation).filter(|v| *v > NOTHING);
        let violation: f64 = violations.sum();
        let objective = value(graph, self.problem.objective, &here);
        let cost = if self.problem.sense == Sense::Maximize { -objective } else { objective };
        let finite = cost.is_finite() && violation.is_finite();
        finite.then(|| Sample { at: at.to_vec(), coordinates, objective, cost, violation })
    }

    /// Follows a gait from one set of parameters to another in a straight line.
    pub fn follow(&self, from: &(Vec<f64>, Vec<f64>), to: &[f64]) -> Option<Vec<f64>> {
        let (start, mut coordinates) = (&from.0, from.1.clone());
        let (mut done, mut stride) = (0.0, 0.25);
        while done < 1.0 {
            let next = f64::min(1.0, done + stride);
            let between: Vec<f64> = start.iter().zip(to).map(|(a, b)| a + next * (b - a)).collect();
            let target = if next < 1.0 { &between[..] } else { to };
            match self.gait(target, &coordinates) {
                Some((found, _, _)) => (coordinates, done, stride) = (found, next, 1.5 * stride),
                None => stride *= 0.5,
            }
            if stride < SHORTEST {
                return None;
            }
        }
        Some(coordinates)
    }
}

fn from_flags(spec: &mut Model, flags: &Flags) -> Problem {
    let (objective, objective_dimension) = parse_objective(spec, flags.objective).expect("an objective");
    let constraints = flags.subject_to.iter().map(|text| parse_constraint(spec, text).expect("a constraint")).collect();
    let vary = |(name, range): &(&str, &str)| {
        let parameter = spec.parameters.iter().position(|p| p.name == *name).expect("a parameter");
        let (lower, upper) = parse_range(range, spec.parameters[parameter].dimension).expect("a range");
        Vary { parameter, lower, upper }
    };
    Problem {
        name: flags.name.to_owned(),
        default: false,
        doc: String::new(),
        sense: if flags.maximize { Sense::Maximize } else { Sense::Minimize },
        objective,
        objective_text: flags.objective.to_owned(),
        objective_dimension,
        vary: flags.vary.iter().map(vary).collect(),
        robust: Vec::new(),
        constraints,
        period: 1,
    }
}
