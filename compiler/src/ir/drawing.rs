//! How a machine is drawn, and what of it is worth plotting: data, beside the equations.

use super::Observation;

/// How to draw a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// The machine in the plane, where it has one.
    pub plane: Option<Plane>,
    /// What is worth plotting over time; all curves of a panel have one dimension.
    pub panels: Vec<Vec<Observation>>,
}

/// A machine in the plane, in metres to the right and up.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// The body's velocity in the world, m/s. Its time integral, continuous over all events, is the body's path.
    pub velocity: [Observation; 2],
    /// Other points.
    pub points: Vec<DrawnPoint>,
    /// Line segments to draw where both ends are there.
    pub links: Vec<[Joint; 2]>,
}

/// A point that is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnPoint {
    /// Name in the spec.
    pub name: String,
    /// For people.
    pub doc: String,
    /// Where it is, seen from the body, in m and in directions of the world.
    pub at: [Observation; 2],
    /// For each mode of the model whether the point is there.
    pub modes: Vec<bool>,
    /// Whether it stands still in the world from one transition to the next, as an attachment point does.
    pub held: bool,
}

/// An end of a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joint {
    /// The body.
    Body,
    /// One of [`Plane::points`].
    Point(usize),
}
