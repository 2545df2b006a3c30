//! The arguments of `gaitc continue`.

use crate::cli::args::{ModelArgs, SearchArgs};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  gaitc continue prescribed_length --over 'psi=5..45 deg'\n  \
gaitc continue compass_walker --over 'gamma=3..5 deg' --doublings 2\n  \
gaitc continue angle_switched --over 'psi=15..30 deg' --measure climb_speed --plot branches.svg --out branches.csv")]
pub(crate) struct ContinueArgs {
    #[command(flatten)]
    pub(crate) model: ModelArgs,
    #[command(flatten)]
    pub(crate) search: SearchArgs,
    /// Parameter to follow the gait over, with its range, e.g. --over 'psi=0..45 deg'
    #[arg(long, value_name = "NAME=LO..HI", allow_hyphen_values = true)]
    pub(crate) over: String,
    /// Value of that parameter to start at [default: its own, or the nearest end of the range]
    #[arg(long, value_name = "QUANTITY", allow_hyphen_values = true)]
    pub(crate) from: Option<String>,
    /// Number of maps that make one period
    #[arg(long, default_value_t = 1, value_name = "K")]
    pub(crate) period: usize,
    /// Number of period doublings in a row whose branches are followed, too
    #[arg(long, default_value_t = 0, value_name = "N")]
    pub(crate) doublings: usize,
    /// Follow the branches that cross at branch points, too
    #[arg(long)]
    pub(crate) branches: bool,
    /// Most points of a branch in each direction
    #[arg(long, default_value_t = 1000, value_name = "N")]
    pub(crate) points: usize,
    /// Longest step along a branch, in units of the parameter [default: 1/50 of the range]
    #[arg(long, value_name = "QUANTITY", allow_hyphen_values = true)]
    pub(crate) step: Option<String>,
    /// Measure or section coordinate to show beside the parameter [default: the first measure]
    #[arg(long, value_name = "NAME")]
    pub(crate) measure: Option<String>,
    /// Write all gaits and bifurcations as a table: .csv or .parquet
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Draw the branches: .svg or .png
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
    /// Draw the magnitudes of all multipliers over the parameter: .svg or .png
    #[arg(long, value_name = "FILE")]
    pub(crate) plot_multipliers: Option<PathBuf>,
}
