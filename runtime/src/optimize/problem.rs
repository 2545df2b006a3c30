//! What is to be optimised: an objective over measures and parameters, what may vary, and what must hold.
//!
//! minimise or maximise F(m(z, p), p) over the varied parameters and the section coordinates z, subject to P(z; p) = z,
//! lower <= p_j <= upper, margins >= 0 and `spectral_radius <= r`.

use super::solver::{Clarabel, Tally};
use crate::interrupt::Interrupt;
use crate::return_map::{Accuracy, RequestError, ReturnMap};
use thiserror::Error;

/// A function of the measures of one map and of all parameters; expressions of a spec live outside the runtime.
pub trait Expression: Send + Sync {
    /// Value and first derivatives. A value that is not finite means: not defined here; the search then turns back.
    fn evaluate(&self, measures: &[f64], parameters: &[f64]) -> Value;
}

/// Value of an [`Expression`], SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// The value.
    pub value: f64,
    /// Partial derivative with respect to each measure, length of `info().measures`.
    pub dmeasures: Vec<f64>,
    /// Partial derivative with respect to each parameter, length of `info().parameters`.
    pub dparameters: Vec<f64>,
}

/// The larger the better, or the smaller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sense {
    /// The larger the better.
    Maximize,
    /// The smaller the better.
    Minimize,
}

/// What is maximised or minimised.
pub enum Objective {
    /// A function of measures and parameters.
    Expression(Box<dyn Expression>),
    /// The largest magnitude of a multiplier; can only be minimised.
    SpectralRadius,
}

/// A parameter that the optimiser varies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vary {
    /// Index into `info().parameters`.
    pub parameter: usize,
    /// Lower bound, SI units, finite.
    pub lower: f64,
    /// Upper bound, SI units, finite; equal to `lower` holds the parameter there.
    pub upper: f64,
}

/// A bound on the spectral radius.
pub enum Bound {
    /// A positive number.
    Constant(f64),
    /// A function of parameters (and measures).
    Expression(Box<dyn Expression>),
}

/// The two kinds of inequality.
pub enum ConstraintKind {
    /// `margin >= 0`.
    Margin {
        /// The margin.
        margin: Box<dyn Expression>,
        /// Its natural size in SI units, positive: a violation of `feasibility` times this is none.
        scale: f64,
    },
    /// `spectral_radius <= bound`, through the Jury inequalities.
    SpectralRadius {
        /// The bound.
        bound: Bound,
    },
}

/// An inequality that must hold at the optimum.
pub struct Constraint {
    /// As the user wrote it, for messages.
    pub name: String,
    /// What must hold.
    pub kind: ConstraintKind,
}

/// How to search.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Accuracy of the return maps.
    pub accuracy: Accuracy,
    /// Largest KKT residual of an optimum, relative to the size of the objective's gradient over the ranges.
    pub optimality: f64,
    /// Largest violation of a constraint, relative to its natural scale; ten times the maps' relative tolerance if
    /// that is more.
    pub feasibility: f64,
    /// Most iterations of one start.
    pub max_iterations: usize,
    /// Most single maps of one search (a gait of k maps takes k, for each machine of a robust problem): a search that needs more
    /// ends with its best gait so far.
    pub work: usize,
    /// How many starts; the first is the given one, the others fill the ranges evenly.
    pub starts: usize,
    /// Chooses the further starts.
    pub seed: u64,
    /// How many starts run side by side; 0 for one a core. The result does not depend on it.
    pub threads: usize,
    /// First radius of the trust region, as a fraction of the ranges.
    pub trust_radius: f64,
    /// Whether the answer has to pass the long tests, too: a thousand disturbed maps, and another integrator.
    pub long_tests: bool,
    /// Ends the optimisation early, with the best gait so far.
    pub interrupt: Interrupt,
    /// How Clarabel solves the subproblems.
    pub clarabel: Clarabel,
    /// Counts what Clarabel does.
    pub tally: Tally,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            accuracy: Accuracy::default(),
            optimality: 1e-7,
            feasibility: 1e-10,
            max_iterations: 200,
            work: 100_000,
            starts: 1,
            seed: 0,
            threads: 0,
            trust_radius: 0.25,
            long_tests: true,
            interrupt: Interrupt::default(),
            clarabel: Clarabel::USED,
            tally: Tally::default(),
        }
    }
}

/// A whole optimisation problem.
pub struct Problem<'a> {
    /// The return map.
    pub map: &'a dyn ReturnMap,
    /// Initial memory, in the order of `info().memory`.
    pub memory: Vec<f64>,
    /// All parameters in SI units; where one is varied, its first value.
    pub parameters: Vec<f64>,
    /// How many maps make the gait; usually 1.
    pub period: usize,
    /// What varies.
    pub vary: Vec<Vary>,
    /// Maximise or minimise.
    pub sense: Sense,
    /// What.
    pub objective: Objective,
    /// What must hold.
    pub constraints: Vec<Constraint>,
    /// First guess of the section coordinates at `parameters`.
    pub start: Vec<f64>,
    /// How to search.
    pub settings: Settings,
}

/// A problem that is wrong as stated; found before any work is done.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ProblemError {
    /// A vector has the wrong length.
    #[error("{what}: expected {expected} values, got {got}")]
    Length {
        /// Which.
        what: String,
        /// Expected length.
        expected: usize,
        /// Length given.
        got: usize,
    },
    /// A number is not finite.
    #[error("{0} is not a finite number; give a finite value in its unit")]
    NotFinite(String),
    /// No parameter may vary.
    #[error("nothing to vary; name at least one parameter with a range")]
    NothingToVary,
    /// A varied parameter does not exist.
    #[error("cannot vary parameter number {index}: the model has {count} parameters")]
    UnknownParameter {
        /// The index given.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A parameter is varied twice.
    #[error("parameter `{0}` is varied twice; keep one of the two ranges")]
    VariedTwice(&'static str),
    /// No parameter of a robust problem is uncertain.
    #[error("nothing is uncertain; name at least one parameter with a range, or solve the problem as it is")]
    NothingUncertain,
    /// A parameter is varied and uncertain.
    #[error("parameter `{0}` is varied, so it cannot be uncertain; keep its range in one of the two")]
    VariedAndUncertain(&'static str),
    /// A parameter is uncertain twice.
    #[error("parameter `{0}` is uncertain twice; keep one of the two ranges")]
    UncertainTwice(&'static str),
    /// A bound on the spectral radius that depends on something, in a robust problem.
    #[error(
        "constraint `{0}`: in a robust problem the bound on the spectral radius has to be a number; write one, such as 0.95"
    )]
    RobustBound(String),
    /// Bounds the wrong way round.
    #[error("the range of `{name}` is empty: {lower} is above {upper}; write the smaller bound first")]
    EmptyRange {
        /// The parameter.
        name: &'static str,
        /// Lower bound, SI units.
        lower: f64,
        /// Upper bound, SI units.
        upper: f64,
    },
    /// The spectral radius cannot be maximised.
    #[error("the spectral radius can only be minimised; write `minimize` instead of `maximize`")]
    MaximizeSpectralRadius,
    /// A bound on the spectral radius that nothing can meet with a margin.
    #[error(
        "constraint `{name}`: the bound {bound} on the spectral radius is not positive; write a number above 0, such as 0.95"
    )]
    SpectralBound {
        /// The constraint.
        name: String,
        /// The bound.
        bound: f64,
    },
    /// A constraint's natural scale is not positive.
    #[error("constraint `{name}`: its natural scale {scale} is not a positive number")]
    Scale {
        /// The constraint.
        name: String,
        /// The scale.
        scale: f64,
    },
    /// A setting makes no sense.
    #[error("setting `{setting}`: {hint}")]
    Setting {
        /// Which.
        setting: &'static str,
        /// What to write.
        hint: &'static str,
    },
    /// The return map refused the request.
    #[error(transparent)]
    Request(#[from] RequestError),
}

impl Problem<'_> {
    /// Checks everything that can be known before the first map is evaluated.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn validate(&self) -> Result<(), ProblemError> {
        let info = self.map.info();
        if info.uses_time {
            return Err(RequestError::ExplicitTime(info.name).into());
        }
        length("parameters", info.parameters.len(), self.parameters.len())?;
        length("memory", info.memory.len(), self.memory.len())?;
        length("the first guess of the section coordinates", info.coordinates.len(), self.start.len())?;
        finite("parameter", &self.parameters)?;
        finite("memory", &self.memory)?;
        finite("section coordinate", &self.start)?;
        self.validate_ranges()?;
        if self.sense == Sense::Maximize && matches!(self.objective, Objective::SpectralRadius) {
            return Err(ProblemError::MaximizeSpectralRadius);
        }
        self.constraints.iter().try_for_each(Constraint::validate)?;
        if self.period == 0 {
            return Err(ProblemError::Setting { setting: "period", hint: "must be at least 1" });
        }
        self.settings.validate()
    }

    fn validate_ranges(&self) -> Result<(), ProblemError> {
        let known = self.map.info().parameters;
        if self.vary.is_empty() {
            return Err(ProblemError::NothingToVary);
        }
        let mut seen = vec![false; known.len()];
        for vary in &self.vary {
            let Some(quantity) = known.get(vary.parameter) else {
                return Err(ProblemError::UnknownParameter { index: vary.parameter, count: known.len() });
            };
            let name = quantity.name;
            if !(vary.lower.is_finite() && vary.upper.is_finite() && (vary.upper - vary.lower).is_finite()) {
                return Err(ProblemError::NotFinite(format!("the range of `{name}`")));
            }
            if vary.lower > vary.upper {
                return Err(ProblemError::EmptyRange { name, lower: vary.lower, upper: vary.upper });
            }
            if std::mem::replace(&mut seen[vary.parameter], true) {
                return Err(ProblemError::VariedTwice(name));
            }
        }
        Ok(())
    }

    /// Checks that an expression's derivatives have the lengths of this model.
    pub(super) fn check_value(&self, what: &str, value: &Value) -> Result<(), ProblemError> {
        let info = self.map.info();
        length(&format!("{what}: derivative in the measures"), info.measures.len(), value.dmeasures.len())?;
        length(&format!("{what}: derivative in the parameters"), info.parameters.len(), value.dparameters.len())
    }
}

impl Constraint {
    fn validate(&self) -> Result<(), ProblemError> {
        match &self.kind {
            ConstraintKind::Margin { scale, .. } if !(scale.is_finite() && *scale > 0.0) => {
                Err(ProblemError::Scale { name: self.name.clone(), scale: *scale })
            }
            ConstraintKind::SpectralRadius { bound: Bound::Constant(bound) }
                if !(bound.is_finite() && *bound > 0.0) =>
            {
                Err(ProblemError::SpectralBound { name: self.name.clone(), bound: *bound })
            }
            _ => Ok(()),
        }
    }
}

impl Settings {
    /// Feasibility that can be asked of maps of this accuracy.
    pub(super) fn attainable_feasibility(&self) -> f64 {
        self.feasibility.max(10.0 * self.accuracy.relative)
    }

    /// Checks the settings.
    ///
    /// # Errors
    /// The first setting that makes no sense.
    pub fn validate(&self) -> Result<(), ProblemError> {
        let tolerance = |x: f64| x > 0.0 && x < 1.0;
        let rules = [
            ("optimality", tolerance(self.optimality), "must lie between 0 and 1, such as 1e-7"),
            ("feasibility", tolerance(self.feasibility), "must lie between 0 and 1, such as 1e-10"),
            ("trust_radius", tolerance(self.trust_radius), "must lie between 0 and 1, such as 0.25"),
            ("max_iterations", self.max_iterations > 0, "must be at least 1"),
            ("work", self.work > 0, "must be at least 1"),
            ("starts", (1..=100_000).contains(&self.starts), "must be between 1 and 100000"),
            ("threads", self.threads <= 1024, "must be at most 1024"),
        ];
        match rules.into_iter().find(|(_, holds, _)| !holds) {
            Some((setting, _, hint)) => Err(ProblemError::Setting { setting, hint }),
            None => Ok(()),
        }
    }
}

fn length(what: &str, expected: usize, got: usize) -> Result<(), ProblemError> {
    if expected == got { Ok(()) } else { Err(ProblemError::Length { what: what.to_owned(), expected, got }) }
}

fn finite(what: &str, values: &[f64]) -> Result<(), ProblemError> {
    match values.iter().position(|v| !v.is_finite()) {
        Some(i) => Err(ProblemError::NotFinite(format!("{what} number {i}"))),
        None => Ok(()),
    }
}
