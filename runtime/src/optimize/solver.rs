//! How Clarabel is asked to solve the subproblems, in one place, and a tally of what it made of them.
//!
//! `docs/optimizer.md` has the study behind the numbers (`cargo bench --bench clarabel`).

use clarabel::solver::{DefaultSettings, SolverStatus};
use std::sync::{Arc, Mutex, PoisonError};

/// Clarabel's settings at the first attempt at a subproblem; later attempts depart from these (module `subproblem`).
#[derive(Clone, Debug, PartialEq)]
pub struct Clarabel {
    /// Duality gap and residuals at which a subproblem counts as solved.
    pub tolerance: f64,
    /// Whether rows and columns are scaled first.
    pub equilibrate: bool,
    /// What is added to the diagonal of the KKT system; 0 for nothing.
    pub static_regularisation: f64,
    /// Pivots smaller than this are replaced; 0 for none.
    pub dynamic_regularisation: f64,
    /// Most corrections of each direct solution; 0 for none.
    pub refinements: u32,
    /// Most interior-point iterations.
    pub iterations: u32,
    /// The direct solver, by Clarabel's name.
    pub direct: &'static str,
}

impl Clarabel {
    /// The settings in use.
    pub const USED: Self = Self {
        tolerance: 1e-8,
        equilibrate: true,
        static_regularisation: 1e-8,
        dynamic_regularisation: 1e-13,
        refinements: 10,
        iterations: 200,
        direct: "qdldl",
    };

    /// In Clarabel's form.
    pub(super) fn settings(&self) -> DefaultSettings<f64> {
        DefaultSettings {
            verbose: false,
            max_threads: 1,
            max_iter: self.iterations,
            tol_gap_abs: self.tolerance,
            tol_gap_rel: self.tolerance,
            tol_feas: self.tolerance,
            equilibrate_enable: self.equilibrate,
            static_regularization_enable: self.static_regularisation > 0.0,
            static_regularization_constant: self.static_regularisation,
            dynamic_regularization_enable: self.dynamic_regularisation > 0.0,
            dynamic_regularization_eps: self.dynamic_regularisation,
            iterative_refinement_enable: self.refinements > 0,
            iterative_refinement_max_iter: self.refinements,
            direct_solve_method: self.direct.to_owned(),
            ..DefaultSettings::default()
        }
    }
}

impl Default for Clarabel {
    fn default() -> Self {
        Self::USED
    }
}

/// What Clarabel made of subproblems.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Subproblems.
    pub subproblems: usize,
    /// Those that took more than one attempt.
    pub again: usize,
    /// Those that no attempt solved (an infeasible tied one is asked again with elastic equalities, and counts here).
    pub unsolved: usize,
    /// Interior-point iterations of all attempts.
    pub iterations: usize,
    /// Attempts that ended as `AlmostSolved`.
    pub almost_solved: usize,
    /// Attempts that ended as `InsufficientProgress`.
    pub insufficient_progress: usize,
    /// Attempts that ended as `NumericalError`.
    pub numerical_error: usize,
    /// Attempts that ended as `MaxIterations`.
    pub max_iterations: usize,
}

/// Counts what Clarabel does in a search, for studies. Clones share the counts; the default counts nothing.
#[derive(Clone, Debug, Default)]
pub struct Tally(Option<Arc<Mutex<Counts>>>);

impl Tally {
    /// One that counts.
    pub fn new() -> Self {
        Self(Some(Arc::default()))
    }

    /// The counts so far.
    pub fn counts(&self) -> Counts {
        self.0.as_ref().map_or_else(Counts::default, |counts| *counts.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// One attempt.
    pub(super) fn attempt(&self, status: SolverStatus, iterations: u32) {
        self.change(|counts| {
            counts.iterations += iterations as usize;
            match status {
                SolverStatus::AlmostSolved => counts.almost_solved += 1,
                SolverStatus::InsufficientProgress => counts.insufficient_progress += 1,
                SolverStatus::NumericalError => counts.numerical_error += 1,
                SolverStatus::MaxIterations => counts.max_iterations += 1,
                _ => {}
            }
        });
    }

    /// One subproblem.
    pub(super) fn subproblem(&self, attempts: usize, solved: bool) {
        self.change(|counts| {
            counts.subproblems += 1;
            counts.again += usize::from(attempts > 1);
            counts.unsolved += usize::from(!solved);
        });
    }

    fn change(&self, change: impl FnOnce(&mut Counts)) {
        if let Some(counts) = &self.0 {
            change(&mut counts.lock().unwrap_or_else(PoisonError::into_inner));
        }
    }
}

/// Two are equal when they count together.
impl PartialEq for Tally {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (None, None) => true,
            _ => false,
        }
    }
}
