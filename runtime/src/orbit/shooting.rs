//! Multiple shooting: Newton's method on the states at several times of a step at once.
//!
//! The map is cut into k pieces phi_j. Unknowns are the section coordinates z and the states x_1 ... x_(k-1) at the cuts;
//!
//! ```text
//! phi_1(z) = x_1,  phi_2(x_1) = x_2,  ...,  phi_k(x_(k-1)) = z.
//! ```
//!
//! A deviation grows over a piece only, not over the whole step, so that Newton's method converges from further away where a
//! gait is unstable. The steps of the states follow from that of z (condensing): with A_j the derivative of phi_j and r_j the
//! gap after it, d x_j = A_j d x_(j-1) + r_j, and what comes around is d z again. At the solution the product of the A_j is
//! the Jacobian of the return map.

use crate::return_map::{Piece, PieceEnd, RequestError, ReturnMap};
use nalgebra::{DMatrix, DVector};

/// How often a step is halved. Where a plan does not hold further on, a new one from where the search stands does.
const HALVINGS: usize = 5;

/// A solution, as far as it was found.
pub(super) struct Shot {
    /// Section coordinates.
    pub(super) z: DVector<f64>,
    /// The product of the pieces' derivatives, d x d.
    pub(super) jacobian: DMatrix<f64>,
    /// Largest gap, relative to `max(1, |component|)`.
    pub(super) residual: f64,
    /// Newton steps taken.
    pub(super) iterations: usize,
}

/// Starts of the pieces, and where they lead.
struct Chain {
    starts: Vec<DVector<f64>>,
    ends: Vec<PieceEnd>,
    residual: f64,
}

/// Newton's method from `z` on the pieces of a plan, until the largest gap is below `tolerance` and no longer shrinks. `None`
/// where the plan does not hold at the start.
///
/// # Errors
/// When the pieces do not belong to the map.
pub(super) fn shoot(
    map: &dyn ReturnMap,
    parameters: &[f64],
    pieces: &[Piece],
    z: &[f64],
    (tolerance, limit): (f64, usize),
) -> Result<Option<Shot>, RequestError> {
    let Some(starts) = states_along(map, parameters, pieces, z)? else {
        return Ok(None);
    };
    let Some(mut chain) = run(map, parameters, pieces, starts)? else {
        return Ok(None);
    };
    let mut iterations = 0;
    while iterations < limit && chain.residual > 0.0 {
        let Some(steps) = newton_steps(&chain) else {
            break;
        };
        iterations += 1;
        match shorten(map, parameters, pieces, &chain, &steps, tolerance)? {
            Some(better) => chain = better,
            None => break,
        }
    }
    let Some(z) = chain.starts.first().cloned() else {
        return Ok(None);
    };
    let identity = DMatrix::identity(z.len(), z.len());
    let jacobian = chain.ends.iter().fold(identity, |product, end| &end.jacobian * product);
    Ok(Some(Shot { z, jacobian, residual: chain.residual, iterations }))
}

/// The states at the cuts on the way from `z`.
fn states_along(
    map: &dyn ReturnMap,
    parameters: &[f64],
    pieces: &[Piece],
    z: &[f64],
) -> Result<Option<Vec<DVector<f64>>>, RequestError> {
    let mut starts = vec![DVector::from_column_slice(z)];
    for piece in pieces.get(..pieces.len().saturating_sub(1)).unwrap_or(&[]) {
        let Some(start) = starts.last() else {
            return Ok(None);
        };
        match map.piece(piece, start.as_slice(), parameters)? {
            Some(end) => starts.push(end.value),
            None => return Ok(None),
        }
    }
    Ok(Some(starts))
}

/// Runs all pieces.
fn run(
    map: &dyn ReturnMap,
    parameters: &[f64],
    pieces: &[Piece],
    starts: Vec<DVector<f64>>,
) -> Result<Option<Chain>, RequestError> {
    let mut ends = Vec::with_capacity(pieces.len());
    for (piece, start) in pieces.iter().zip(&starts) {
        match map.piece(piece, start.as_slice(), parameters)? {
            Some(end) => ends.push(end),
            None => return Ok(None),
        }
    }
    let mut residual = 0.0;
    for (end, next) in ends.iter().zip(starts.iter().cycle().skip(1)) {
        for (a, b) in end.value.iter().zip(next.iter()) {
            let gap = (a - b).abs() / b.abs().max(1.0);
            // NaN wins, and stays.
            if gap > residual || gap.is_nan() {
                residual = gap;
            }
        }
    }
    Ok(Some(Chain { starts, ends, residual }))
}

/// The Newton steps of all starts, by condensing.
fn newton_steps(chain: &Chain) -> Option<Vec<DVector<f64>>> {
    let d = chain.starts.first()?.len();
    // The step of a start as a function of that of z: product dz + gap.
    let (mut product, mut gap) = (DMatrix::identity(d, d), DVector::zeros(d));
    let mut affine = vec![(product.clone(), gap.clone())];
    for (end, next) in chain.ends.iter().zip(chain.starts.iter().cycle().skip(1)) {
        gap = &end.jacobian * gap + &end.value - next;
        product = &end.jacobian * product;
        affine.push((product.clone(), gap.clone()));
    }
    let dz = (&product - DMatrix::identity(d, d)).lu().solve(&-gap)?;
    let steps: Vec<DVector<f64>> =
        affine.iter().take(chain.starts.len()).map(|(product, gap)| product * &dz + gap).collect();
    steps.iter().all(|step| step.iter().all(|v| v.is_finite())).then_some(steps)
}

/// The first point along the step where the gaps shrink sufficiently.
fn shorten(
    map: &dyn ReturnMap,
    parameters: &[f64],
    pieces: &[Piece],
    chain: &Chain,
    steps: &[DVector<f64>],
    tolerance: f64,
) -> Result<Option<Chain>, RequestError> {
    let mut length = 1.0;
    for _ in 0..HALVINGS {
        let trial = chain.starts.iter().zip(steps).map(|(start, step)| start + step * length).collect();
        if let Some(better) = run(map, parameters, pieces, trial)?
            && better.residual < chain.residual * (1.0 - 0.1 * length)
        {
            return Ok(Some(better));
        }
        if chain.residual <= tolerance {
            break;
        }
        length *= 0.5;
    }
    Ok(None)
}
