//! Flags of studies.

use crate::cli::args::{ModelArgs, SearchArgs};
use crate::study::Shard;
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gaitc sweep prescribed_length --over 'psi=1..45 deg:45' --out gaits.csv\n  gaitc sweep \
prescribed_length --over 'psi=1..45 deg:45' --over 'omega=15, 20, 25 rad/s' --dir study\n  gaitc sweep prescribed_length \
--sobol 1000 --over 'psi=1..45 deg' --over 'l_s=0.05..0.2 m' --dir study --resume\n  gaitc sweep prescribed_length --over \
'l_s=0.05..0.2 m:16' --optimize fastest --out fastest.parquet"
)]
pub(crate) struct SweepArgs {
    #[command(flatten)]
    pub(crate) model: ModelArgs,
    #[command(flatten)]
    pub(crate) search: SearchArgs,
    /// Parameter and its values: a range and how many (psi=1..45 deg:45), or a list (psi=1, 2, 5 deg)
    #[arg(long, value_name = "NAME=VALUES", required = true, allow_hyphen_values = true)]
    pub(crate) over: Vec<String>,
    /// Instead of a grid, N points that fill the ranges evenly (a Sobol sequence)
    #[arg(long, value_name = "N")]
    pub(crate) sobol: Option<u64>,
    /// Chooses the Sobol sequence
    #[arg(long, default_value_t = 0, value_name = "N", requires = "sobol")]
    pub(crate) seed: u64,
    /// At each point solve this problem of the spec, with what is swept held fixed, instead of finding the gait
    #[arg(long, value_name = "PROBLEM", conflicts_with = "period")]
    pub(crate) optimize: Option<String>,
    /// Number of maps that make one period
    #[arg(long, default_value_t = 1, value_name = "K")]
    pub(crate) period: usize,
    /// Draw it as SVG or PNG, by the ending: over one range the measure and the spectral radius, over two which points have a stable gait
    #[arg(long, value_name = "FILE", conflicts_with = "shard")]
    pub(crate) plot: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) storage: StorageArgs,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gaitc basin prescribed_length --over 'q_theta=-40..0 deg:60' --over 'p_theta=-1..1 m/s:60' \
--out basin.csv\n  gaitc basin compass_walker --over 'theta_st=-0.3..-0.1 rad:50' --dir study --resume"
)]
pub(crate) struct BasinArgs {
    #[command(flatten)]
    pub(crate) model: ModelArgs,
    #[command(flatten)]
    pub(crate) search: SearchArgs,
    /// Section coordinate and its starts: a range and how many (q_theta=-40..0 deg:60), or a list; others start at the spec's
    /// start, or at --guess
    #[arg(long, value_name = "COORD=VALUES", required = true, allow_hyphen_values = true)]
    pub(crate) over: Vec<String>,
    /// Most maps from each start
    #[arg(long, default_value_t = 1000, value_name = "N")]
    pub(crate) steps: usize,
    /// Longest period of a gait to look for, in maps
    #[arg(long, default_value_t = 8, value_name = "K")]
    pub(crate) periods: usize,
    /// Draw it as SVG or PNG, by the ending: over two ranges which start leads where
    #[arg(long, value_name = "FILE", conflicts_with = "shard")]
    pub(crate) plot: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) storage: StorageArgs,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gaitc merge part1 part2 part3 --out gaits.parquet\n  gaitc merge part1 part2 part3 --dir whole"
)]
pub(crate) struct MergeArgs {
    /// Folders of the shards of one study
    #[arg(value_name = "DIR", required = true)]
    pub(crate) folders: Vec<PathBuf>,
    /// Write the table here: CSV or Parquet, by the ending
    #[arg(long, value_name = "FILE", required_unless_present = "dir")]
    pub(crate) out: Option<PathBuf>,
    /// Keep the whole study in this folder, as if it had been computed there: chunks and tables
    #[arg(long, value_name = "DIR")]
    pub(crate) dir: Option<PathBuf>,
}

/// Where a study is kept, and how it is computed. None of it changes the result.
#[derive(Debug, Args)]
pub(crate) struct StorageArgs {
    /// Folder to keep the study in: nothing that is complete is lost when the run ends early
    #[arg(long, value_name = "DIR")]
    pub(crate) dir: Option<PathBuf>,
    /// Go on with the study in --dir
    #[arg(long, requires = "dir")]
    pub(crate) resume: bool,
    /// Compute only the I-th of N parts; `gaitc merge` joins their folders
    #[arg(long, value_name = "I/N", requires = "dir")]
    pub(crate) shard: Option<Shard>,
    /// Number of points that are written at a time
    #[arg(long, value_name = "N", requires = "dir")]
    pub(crate) chunk: Option<u64>,
    /// Number of points that are computed side by side [default: one a core]
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<usize>,
    /// Write the table here: CSV or Parquet, by the ending
    #[arg(long, value_name = "FILE", conflicts_with = "shard")]
    pub(crate) out: Option<PathBuf>,
}
