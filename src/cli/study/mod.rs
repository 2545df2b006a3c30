//! `gaitc sweep`, `gaitc basin`, `gaitc merge`: studies over many points, kept in folders and written as tables.

mod args;
mod axes;
mod basin;
mod columns;
mod merge;
mod picture;
mod run;
mod summary;
mod sweep;

pub(super) use args::{BasinArgs, MergeArgs, SweepArgs};
pub(super) use basin::run as basin;
pub(super) use merge::run as merge;
pub(super) use sweep::run as sweep;
