//! Where the extrema of a map could have been taken: all measures for each of the best few places.
//!
//! The largest value of an observable is smooth as long as its place moves smoothly. Where two places compete it has a kink, and
//! what either gives is smooth across it.

use super::functionals::Offered;
use super::gather::measures;
use super::run::Run;
use crate::integrate::{Carried, Method};
use crate::model::{Functional, Model};
use crate::return_map::Candidate;
use nalgebra::DMatrix;

/// So many places of each functional are kept, the best.
const MOST: usize = 6;
/// Places closer to each other than this part of the duration, with values and derivatives closer than this, are one: the end of
/// a segment and the start of the next.
const SAME: f64 = 1e-9;

/// The candidates for all extrema of a completed run, functional by functional in order of time.
pub(super) fn gather<X, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>(
    run: &Run<'_, X, M, R, N, P, Q, W, C>,
    width: usize,
) -> Vec<Candidate>
where
    X: Method,
    M: Model<N, P, Q>,
    R: Carried<M, N, P, Q, W, C>,
{
    let (duration, taken) = (run.duration().value, run.functionals());
    let mut candidates = Vec::new();
    for (functional, kind) in M::INFO.functionals.iter().enumerate() {
        let sense = match kind {
            Functional::Maximum(_) => 1.0,
            Functional::Minimum(_) => -1.0,
            _ => continue,
        };
        let offered = run.functionals.offered.iter().flatten().filter(|offered| offered.functional == functional);
        for place in best(offered.copied().collect(), sense, duration) {
            let mut functionals = taken.clone();
            functionals[functional] = place.varied;
            let (measures, measures_jacobian) =
                measures::<M, N, P, Q, C>(&functionals, &run.segment.dp, run.segment.p, width);
            candidates.push(Candidate { functional, phase: place.time / duration, measures, measures_jacobian });
        }
    }
    candidates
}

/// The best of the places, in order of time.
fn best<const C: usize>(mut offered: Vec<Offered<C>>, sense: f64, duration: f64) -> Vec<Offered<C>> {
    // Stable: of two equal places the first is the one that was taken.
    offered.sort_by(|a, b| (sense * b.varied.value).total_cmp(&(sense * a.varied.value)));
    let mut kept: Vec<Offered<C>> = Vec::new();
    for place in offered {
        if kept.len() < MOST && !kept.iter().any(|known| same(known, &place, duration)) {
            kept.push(place);
        }
    }
    kept.sort_by(|a, b| a.time.total_cmp(&b.time));
    kept
}

fn same<const C: usize>(a: &Offered<C>, b: &Offered<C>, duration: f64) -> bool {
    let close = |a: f64, b: f64| (a - b).abs() <= SAME * (a.abs() + b.abs());
    let gradients = a.varied.gradient.iter().zip(&b.varied.gradient);
    (a.time - b.time).abs() <= SAME * duration
        && close(a.varied.value, b.varied.value)
        && gradients.fold(true, |all, (a, b)| all && (a - b).abs() <= 1e3 * SAME * (1.0 + a.abs() + b.abs()))
}

/// The columns of a further pass of the same map. The places are the same, since steps do not depend on the columns; where
/// rounding says otherwise there are none.
pub(super) fn append(all: Vec<Candidate>, part: &[Candidate]) -> Vec<Candidate> {
    let alike = all.len() == part.len()
        && all.iter().zip(part).all(|(a, b)| a.functional == b.functional && (a.phase - b.phase).abs() <= SAME);
    if !alike {
        return Vec::new();
    }
    let side_by_side = |a: &DMatrix<f64>, b: &DMatrix<f64>| {
        let mut both = DMatrix::zeros(a.nrows(), a.ncols() + b.ncols());
        both.columns_mut(0, a.ncols()).copy_from(a);
        both.columns_mut(a.ncols(), b.ncols()).copy_from(b);
        both
    };
    let joined = |(a, b): (Candidate, &Candidate)| Candidate {
        measures_jacobian: side_by_side(&a.measures_jacobian, &b.measures_jacobian),
        ..a
    };
    all.into_iter().zip(part).map(joined).collect()
}
