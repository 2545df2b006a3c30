//! Replays: return maps near one that was run before, on its mesh and along its events, in any number.
//!
//! [`ReturnMap::plan`](crate::return_map::ReturnMap::plan) runs a map with error control and event location and keeps its
//! [`Plan`]. A replay integrates on the plan's mesh, locates the plan's events anew, and checks what error control and
//! event location would have seen to: where an error is beyond the tolerance or a surface on another side, the replay is
//! *declined* and the map has to be run in full. What it saves is the search; and as nothing in it branches on numbers, the
//! same code runs eight maps side by side in SIMD lanes, and carries second derivatives in nested dual numbers.

mod batch;
mod course;
mod landing;
mod mesh;
mod moving;
mod number;
mod pieces;
mod plan;
mod points;
mod record;
mod second;
mod segment;
mod watching;

pub(crate) use batch::side_by_side;
pub(crate) use pieces::run_piece;
pub use pieces::{Piece, PieceEnd};
pub(crate) use plan::Checks;
pub use plan::Plan;
pub use points::{Images, Points, SecondOrder};
pub(crate) use record::Record;
pub(crate) use second::second_order;
