//! What is in the way of an infeasible problem: a smallest set of constraints that cannot hold together.
//!
//! Periodicity and ranges always hold. A restoration that ended in the way gives a set that cannot hold together; from
//! this, one constraint after the other is taken out, and stays out when the rest still cannot be brought to hold from
//! several starts (deletion filtering). What remains is irreducible: without any one of its members the others can hold,
//! and how far that one then gets is a search of its own. All of it is what local searches find, not a proof.

use super::gait::Start;
use super::problem::{Problem, ProblemError};
use super::restore::{Blocked, Pushed, Restored, push, restore};
use super::standing::standing;
use rayon::prelude::*;
use std::cmp::Ordering;

/// From how many starts each set is tried.
const POOL: usize = 3;
/// Margin, in units of its scale, from which a constraint is unlikely to be in the way.
const LOOSE: f64 = 1e-3;

/// Constraints that cannot hold together, as far as local searches find; without any one of them the others can.
#[derive(Clone, Debug, PartialEq)]
pub struct Conflict {
    /// The members and how far each gets.
    pub members: Vec<Reached>,
    /// From how many starts the searches ended in an optimum at which the last missing member does not hold.
    pub agreeing: usize,
}

/// The best that was reached of one constraint while the other members of its conflict hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Reached {
    /// Which (index into `Problem::constraints`).
    pub constraint: usize,
    /// Its margin there, SI units, negative; for `spectral_radius <= r` this is r less the spectral radius.
    pub margin: f64,
    /// The margin in units of the constraint's natural scale.
    pub scaled: f64,
    /// All parameters there, SI units.
    pub parameters: Vec<f64>,
    /// The gait's section coordinates, SI units.
    pub section: Vec<f64>,
    /// Its measures, SI units.
    pub measures: Vec<f64>,
    /// Its spectral radius.
    pub spectral_radius: f64,
}

/// What the filter found.
pub(super) enum Found {
    /// A conflict.
    Conflict(Conflict),
    /// There was none: a gait at which all constraints hold.
    Feasible(Start),
    /// Neither.
    Nothing,
}

/// A smallest conflict behind restorations that were blocked.
///
/// # Errors
/// Only for a problem that turns out to be wrong as stated.
pub(super) fn find(problem: &Problem<'_>, blocked: &[Blocked]) -> Result<Found, ProblemError> {
    let size = |b: &Blocked| b.kept.iter().filter(|kept| **kept).count();
    let Some(first) = blocked.iter().min_by_key(|b| size(b)) else { return Ok(Found::Nothing) };
    // The gait that came closest, and other places.
    let mut pool = vec![&first.at];
    pool.extend(blocked.iter().map(|b| &b.from).take(POOL - 1));
    let mut members = first.kept.clone();
    members[first.failing] = true;
    let mut smaller = members.clone();
    if let Ok(standing) = standing(problem, &first.at) {
        for (i, member) in smaller.iter_mut().enumerate() {
            *member &= i == first.failing || standing.scaled[i] <= LOOSE;
        }
    }
    if smaller != members && cannot_hold(problem, &smaller, &pool)? {
        members = smaller;
    }
    for i in (0..members.len()).filter(|&i| i != first.failing) {
        let without = except(&members, i);
        if members[i] && cannot_hold(problem, &without, &pool)? {
            members = without;
        }
    }
    reached(problem, &members, &pool)
}

/// How far each member gets while the others hold.
fn reached(problem: &Problem<'_>, members: &[bool], pool: &[&Start]) -> Result<Found, ProblemError> {
    let numbers: Vec<usize> = (0..members.len()).filter(|&i| members[i]).collect();
    let furthest = numbers.par_iter().map(|&i| furthest(problem, members, i, pool));
    let furthest: Vec<Furthest> = furthest.collect::<Result<_, _>>()?;
    let mut agreeing = usize::MAX;
    let mut conflict = Vec::new();
    for (&constraint, furthest) in numbers.iter().zip(furthest) {
        let Some(Pushed { gait, standing, reached, .. }) = furthest.best else { return Ok(Found::Nothing) };
        if reached {
            // They can hold together after all; perhaps the rest can, too, from there.
            let all = vec![true; members.len()];
            return Ok(match restore(problem, &all, &gait)? {
                Restored::Feasible(gait) => Found::Feasible(gait),
                Restored::Blocked(_) | Restored::Lost => Found::Nothing,
            });
        }
        agreeing = agreeing.min(furthest.converged);
        conflict.push(Reached {
            constraint,
            margin: standing.margins[constraint],
            scaled: standing.scaled[constraint],
            parameters: gait.parameters,
            section: gait.section,
            measures: standing.measures,
            spectral_radius: standing.spectral_radius,
        });
    }
    Ok(Found::Conflict(Conflict { members: conflict, agreeing }))
}

/// The largest margin of a member over all starts, and how many searches for it converged.
struct Furthest {
    best: Option<Pushed>,
    converged: usize,
}

/// Pushes a member from every start, while the others hold.
fn furthest(
    problem: &Problem<'_>,
    members: &[bool],
    constraint: usize,
    pool: &[&Start],
) -> Result<Furthest, ProblemError> {
    let others = except(members, constraint);
    let mut found = Furthest { best: None, converged: 0 };
    for start in pool {
        let Restored::Feasible(from) = restore(problem, &others, start)? else { continue };
        let Some(pushed) = push(problem, &others, constraint, &from)? else { continue };
        found.converged += usize::from(pushed.converged);
        let margin = |pushed: &Pushed| pushed.standing.scaled[constraint];
        let further = |best: &Pushed| margin(&pushed).total_cmp(&margin(best)) == Ordering::Greater;
        if found.best.as_ref().is_none_or(|best| !best.reached && (pushed.reached || further(best))) {
            found.best = Some(pushed);
        }
    }
    Ok(found)
}

/// Whether constraints cannot be brought to hold together from any of these starts.
fn cannot_hold(problem: &Problem<'_>, members: &[bool], pool: &[&Start]) -> Result<bool, ProblemError> {
    let mut blocked = false;
    for start in pool {
        match restore(problem, members, start)? {
            Restored::Feasible(_) => return Ok(false),
            Restored::Blocked(_) => blocked = true,
            Restored::Lost => {}
        }
    }
    Ok(blocked)
}

fn except(members: &[bool], i: usize) -> Vec<bool> {
    members.iter().enumerate().map(|(k, member)| *member && k != i).collect()
}
