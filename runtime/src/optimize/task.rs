//! What a search is after: the problem as asked, or a step on the way to it, in which one constraint is pushed towards
//! holding while some others are kept.

use super::problem::{ConstraintKind, Objective, Problem};

/// The goal of a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Goal {
    /// The problem's own objective.
    Asked,
    /// The largest margin of this constraint; for a bound on the spectral radius, the smallest spectral radius. The search
    /// ends as soon as the constraint holds.
    Push(usize),
}

/// A goal, and which of the problem's constraints are imposed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Task {
    pub(super) goal: Goal,
    /// For each constraint, whether it is imposed.
    pub(super) kept: Vec<bool>,
}

impl Task {
    /// The problem as asked.
    pub(super) fn asked(problem: &Problem<'_>) -> Self {
        Self { goal: Goal::Asked, kept: vec![true; problem.constraints.len()] }
    }

    /// Whether constraint `i` is imposed.
    pub(super) fn keeps(&self, i: usize) -> bool {
        self.kept.get(i).copied().unwrap_or(false)
    }

    /// Whether the spectral radius is minimised, through its epigraph.
    pub(super) fn minimises_radius(&self, problem: &Problem<'_>) -> bool {
        match self.goal {
            Goal::Asked => matches!(problem.objective, Objective::SpectralRadius),
            Goal::Push(i) => {
                problem.constraints.get(i).is_some_and(|c| matches!(c.kind, ConstraintKind::SpectralRadius { .. }))
            }
        }
    }
}
