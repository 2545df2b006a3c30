//! Second derivatives of a return map, by replaying it in nested dual numbers.
//!
//! A pass carries derivatives along A directions of derivatives along B directions; all pairs of the n directions take
//! (n/A) (n/B) passes. The time of an event varies like everything else, so that the second-order terms of the saltation
//! come about by themselves (docs/mathematics.md has them written out).

use super::course::Course;
use super::plan::Plan;
use super::points::SecondOrder;
use crate::model::{Model, Section};
use crate::scalar::filled;
use crate::sensitivity::Dual;
use nalgebra::{DMatrix, DVector};

/// Directions of the outer and of the inner derivatives in one pass.
const OUTER: usize = 2;
const INNER: usize = 4;

type Inner = Dual<f64, INNER>;
type Nested = Dual<Inner, OUTER>;

/// Replays `plan` from section coordinates `z` with parameters `p`, along the coordinates and the `chosen` parameters.
pub(crate) fn second_order<M, const N: usize, const P: usize, const Q: usize>(
    plan: &Plan,
    section: Section,
    z: &[f64],
    p: &[f64; P],
    chosen: &[usize],
) -> SecondOrder
where
    M: Model<N, P, Q>,
{
    let d = z.len();
    let n = d + chosen.len();
    let mut result = SecondOrder {
        coordinates: DVector::zeros(d),
        jacobian: DMatrix::zeros(d, n),
        second: vec![DMatrix::zeros(d, n); n],
        duration: 0.0,
        duration_gradient: DVector::zeros(n),
        duration_second: DMatrix::zeros(n, n),
    };
    // A pair of blocks and its mirror image hold the same numbers; the inner block comes first in one of them.
    for outer in (0..n.max(1)).step_by(OUTER) {
        for inner in (0..n.max(1)).step_by(INNER).filter(|inner| inner + INNER > outer) {
            let seed = |value: f64, direction: usize| -> Nested {
                let along = |first: usize, k: usize| if first + k == direction { 1.0 } else { 0.0 };
                let value = Dual { value, derivative: filled(0.0, |k| along(inner, k)) };
                let rate = |k| Dual { value: along(outer, k), derivative: [0.0; INNER] };
                Dual { value, derivative: filled(rate(0), rate) }
            };
            let at: Vec<Nested> = z.iter().enumerate().map(|(i, z)| seed(*z, i)).collect();
            let by_parameter = |i: usize| chosen.iter().position(|c| *c == i).map_or(usize::MAX, |k| d + k);
            let p = filled(seed(0.0, usize::MAX), |i| seed(p[i], by_parameter(i)));
            let mut course = Course::<M, Nested, N, P, Q, 0>::new(plan, section, &p);
            let end = course.map(&at, &[]);
            for i in 0..d.min(N) {
                put(&mut result, Some(i), (outer, inner), &end.x[i]);
            }
            put(&mut result, None, (outer, inner), &course.segment.start);
        }
    }
    result
}

/// Puts the derivatives of one number, a coordinate of the image or the duration, into their places.
fn put(result: &mut SecondOrder, of: Option<usize>, (outer, inner): (usize, usize), value: &Nested) {
    let n = result.duration_gradient.len();
    match of {
        Some(i) => result.coordinates[i] = value.value.value,
        None => result.duration = value.value.value,
    }
    for b in (0..INNER).filter(|b| inner + b < n) {
        let first = value.value.derivative[b];
        match of {
            Some(i) => result.jacobian[(i, inner + b)] = first,
            None => result.duration_gradient[inner + b] = first,
        }
        for a in (0..OUTER).filter(|a| outer + a < n) {
            let second = value.derivative[a].derivative[b];
            for (row, column) in [(outer + a, inner + b), (inner + b, outer + a)] {
                match of {
                    Some(i) => result.second[row][(i, column)] = second,
                    None => result.duration_second[(row, column)] = second,
                }
            }
        }
    }
}
