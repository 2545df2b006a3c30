//! The path of the body in the plane: the time integral of the velocity that the spec's drawing names, and the points that are drawn
//! beside it.

use super::observe::observe;
use super::quadrature::integral;
use gaitc_compiler::front::Observations;
use gaitc_compiler::ir::{Joint, Observation, Plane};
use gaitc_runtime::trajectory::Trajectory;

/// Where a machine is, at every sample of a trajectory; in metres to the right and up, from where the body starts.
#[derive(Clone, Debug)]
pub struct BodyPath {
    /// The body.
    pub body: Vec<(f64, f64)>,
    /// The points of the drawing, in its order.
    pub points: Vec<DrawnPath>,
    /// Between which of them lines are drawn.
    pub links: Vec<[Joint; 2]>,
}

/// A point of the drawing on its way.
#[derive(Clone, Debug)]
pub struct DrawnPath {
    /// Name in the spec.
    pub name: String,
    /// Whether it stands still from one transition to the next.
    pub held: bool,
    /// Where it is, one a sample; not a number where the mode does not have it.
    pub at: Vec<(f64, f64)>,
}

impl BodyPath {
    /// Where an end of a link is, at a sample.
    pub fn joint(&self, joint: Joint, sample: usize) -> Option<(f64, f64)> {
        match joint {
            Joint::Body => self.body.get(sample).copied(),
            Joint::Point(point) => self.points.get(point)?.at.get(sample).copied(),
        }
    }
}

/// The path of a trajectory; `None` where the spec does not say how the machine is drawn in the plane. `parameters` are all of the
/// model's.
pub fn body_path(observations: &Observations, parameters: &[f64], trajectory: &Trajectory) -> Option<BodyPath> {
    let plane: &Plane = observations.drawing()?.plane.as_ref()?;
    let chosen: Vec<Observation> =
        plane.velocity.iter().chain(plane.points.iter().flat_map(|point| &point.at)).cloned().collect();
    let columns = observe(observations, &chosen, parameters, trajectory);
    let pair = |i: usize| columns.get(2 * i).zip(columns.get(2 * i + 1));
    let samples = &trajectory.samples;
    let (v_x, v_y) = pair(0)?;
    let body: Vec<(f64, f64)> = integral(&samples.t, v_x).into_iter().zip(integral(&samples.t, v_y)).collect();
    let mut points = Vec::with_capacity(plane.points.len());
    for (i, point) in plane.points.iter().enumerate() {
        let (x, y) = pair(i + 1)?;
        let mut at: Vec<(f64, f64)> = Vec::with_capacity(body.len());
        for (s, &segment) in samples.segment.iter().enumerate() {
            let mode = trajectory.segments.get(segment)?.mode;
            let goes_on = s > 0 && samples.segment.get(s - 1) == Some(&segment);
            at.push(match at.last() {
                _ if point.modes.get(mode) != Some(&true) => (f64::NAN, f64::NAN),
                Some(&place) if point.held && goes_on => place,
                _ => (body[s].0 + x[s], body[s].1 + y[s]),
            });
        }
        points.push(DrawnPath { name: point.name.clone(), held: point.held, at });
    }
    Some(BodyPath { body, points, links: plane.links.clone() })
}
