//! Return maps by Gauss collocation on a fixed grid: a second route, to confirm what the others say.
//!
//! It shares nothing with `ode/`, `integrate/`, `event/` and `hybrid/` but the model: other methods (Gauss-Legendre, order
//! 12, which is not stiffly accurate and never looks at the ends of a step, where a mass matrix may be singular), steps of
//! equal size without error control, events located by a bracketing search on the size of the last step. It carries no
//! derivatives: those of a map are differences of maps, which share nothing with variational equations and saltation
//! matrices.
//!
//! What it does not do: control its error (compare two grids), or notice a guard that is passed twice within a step.

mod course;
mod gauss;
mod stages;

pub(crate) use course::image;
