//! Replays of many maps: one after the other, or side by side in lanes.

use super::course::Course;
use super::number::Number;
use super::plan::Plan;
use super::points::{Images, Rows};
use crate::model::{Model, Section};
use crate::scalar::filled;

/// Replays `plan` at the points from number `first`, as many as there are lanes, with C columns; d is at most C.
pub(crate) fn side_by_side<M, S, const N: usize, const P: usize, const Q: usize, const C: usize>(
    plan: &Plan,
    section: Section,
    points: &Rows<'_>,
    first: usize,
    images: &mut Images,
) where
    M: Model<N, P, Q>,
    S: Number,
{
    let d = M::INFO.coordinates.len();
    let p: [S; P] = if points.shared() {
        filled(S::constant(0.0), |i| S::constant(points.parameter(first, i)))
    } else {
        filled(S::constant(0.0), |i| S::from_values(|lane| points.parameter(first + lane, i)))
    };
    let z: [S; N] = filled(S::constant(0.0), |i| match i < d {
        true => S::from_values(|lane| points.coordinate(first + lane, i)),
        false => S::constant(0.0),
    });
    let mut dz = [[S::constant(0.0); N]; C];
    for (c, column) in dz.iter_mut().enumerate().take(d.min(N)) {
        column[c] = S::constant(1.0);
    }
    let mut course = Course::<M, S, N, P, Q, C>::new(plan, section, &p);
    let end = course.map(z.get(..d).unwrap_or(&[]), &dz);
    let numbers = end.x.iter().chain(end.dx.iter().flatten());
    let held = numbers.fold(course.valid, |held, v| S::and(held, v.abs().less(S::constant(f64::INFINITY))));
    for lane in 0..S::LANES {
        let point = first + lane;
        let Some(slot) = images.held.get_mut(point) else {
            break;
        };
        *slot = S::holds(held, lane);
        if !*slot {
            continue;
        }
        let put = |values: &mut Vec<f64>, at: usize, value: S| {
            if let Some(slot) = values.get_mut(at) {
                *slot = value.lane(lane);
            }
        };
        put(&mut images.durations, point, course.segment.start);
        for i in 0..d.min(N) {
            put(&mut images.coordinates, point * d + i, end.x[i]);
            for j in 0..d.min(C) {
                put(&mut images.jacobians, (point * d + j) * d + i, end.dx[j][i]);
            }
        }
        for j in 0..d.min(C) {
            put(&mut images.duration_gradients, point * d + j, course.segment.dstart[j]);
        }
    }
}
