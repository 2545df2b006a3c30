//! The inequality rows of the nonlinear program: where each comes from, and their order.

use super::factors::Groups;
use super::jury;
use super::problem::{ConstraintKind, Problem};
use super::task::Task;

/// Where an inequality row comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Row {
    /// A margin (index into the problem's constraints); which of its pieces.
    Margin(usize, usize),
    /// A Jury inequality: of a constraint, or of the epigraph of the objective (`None`); which of them.
    Jury(Option<usize>, usize),
    /// The objective of a scene is no worse than the epigraph variable; which of its pieces.
    Worst(usize),
}

/// How many rows a bound on the spectral radius has: as many as its polynomial needs, or room for those of all its factors,
/// whatever these are.
pub(super) fn slots(dimension: usize) -> usize {
    if Groups::matter(dimension) { 2 * dimension } else { jury::count(dimension) }
}

/// Rows with their scenes, in the order in which `evaluate` writes them; so many for the pieces of each margin and of the objective.
pub(super) fn rows(problem: &Problem<'_>, task: &Task, scenes: usize, pieces: usize) -> Vec<(Row, usize)> {
    let count = slots(problem.start.len());
    let jury = |of| (0..scenes).flat_map(move |s| (0..count).map(move |which| (Row::Jury(of, which), s)));
    let each = |row: &dyn Fn(usize) -> Row| -> Vec<(Row, usize)> {
        (0..scenes).flat_map(|s| (0..pieces).map(move |which| (which, s))).map(|(which, s)| (row(which), s)).collect()
    };
    let mut rows = Vec::new();
    if task.minimises_radius(problem) {
        rows.extend(jury(None));
    } else if scenes > 1 || pieces > 1 {
        rows.extend(each(&Row::Worst));
    }
    for (i, constraint) in problem.constraints.iter().enumerate() {
        match constraint.kind {
            _ if !task.keeps(i) => {}
            ConstraintKind::Margin { .. } => rows.extend(each(&|which| Row::Margin(i, which))),
            ConstraintKind::SpectralRadius { .. } => rows.extend(jury(Some(i))),
        }
    }
    rows
}
