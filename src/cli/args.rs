//! The command line as clap reads it.

use super::continuation::ContinueArgs;
use super::study::{BasinArgs, MergeArgs, SweepArgs};
use super::whole::whole;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Gaits, stability and the fastest stable climber, from models written as TOML specs.
#[derive(Debug, Parser)]
#[command(name = "gaitc", version, propagate_version = true, arg_required_else_help = true)]
pub(crate) struct Cli {
    /// Folder with the specs whose parameter values and problems are used
    #[arg(
        long,
        global = true,
        value_name = "DIR",
        help = "Folder to read specs from [default: ./specs where it exists]"
    )]
    pub(crate) specs: Option<PathBuf>,
    /// Print JSON (SI units) instead of tables
    #[arg(long, global = true)]
    pub(crate) json: bool,
    /// Say nothing on stderr but errors: no warnings, no progress
    #[arg(long, short, global = true, conflicts_with = "verbose")]
    pub(crate) quiet: bool,
    /// Say on stderr where values come from and how long it took
    #[arg(long, short, global = true)]
    pub(crate) verbose: bool,
    #[command(subcommand)]
    pub(crate) command: Command,
    /// What of the command line makes the result, as a run file has it.
    #[arg(skip)]
    pub(crate) run: toml::Table,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// List the compiled models
    Models,
    /// Check spec files without building anything
    Check(CheckArgs),
    /// Show a model: equations, parameters, the graph of its modes
    Show(ShowArgs),
    /// Explain a code of `gaitc check`, or list all codes
    Explain(ExplainArgs),
    /// Find a periodic gait and its stability
    Gait(GaitArgs),
    /// Follow the machine from any start, through steps, until it falls
    Simulate(Box<super::simulate::SimulateArgs>),
    /// Show what others have published beside what is computed
    Compare(super::compare::CompareArgs),
    /// Follow a gait over a parameter: where it is stable, where it changes in kind, where it ends
    Continue(ContinueArgs),
    /// Find the best gait over parameters
    Optimize(Box<OptimizeArgs>),
    /// Find the gait, or the optimum, at each of many points
    Sweep(Box<SweepArgs>),
    /// Find which starts lead to which gait
    Basin(Box<BasinArgs>),
    /// Join the shards of a sweep or basin
    Merge(MergeArgs),
    /// Write a page with animation, equations, tables and pictures of a model
    Report(super::report::ReportArgs),
    /// Measure every generated derivative against an independent route
    Verify(VerifyArgs),
    /// Make a cargo project with a model of your own
    New(NewArgs),
    /// Print the JSON Schema of specs, for editors
    Schema(SchemaArgs),
    /// Do again what a run file says, or what made a result
    Run(super::run::RunArgs),
    /// Print a script that completes commands and flags in a shell
    Completions(super::completions::CompletionsArgs),
    /// Write the manual pages
    Man(super::man::ManArgs),
}

impl Command {
    /// `check` has printed its diagnostics as JSON already when it fails.
    pub(crate) fn prints_its_own_errors(&self) -> bool {
        matches!(self, Self::Check(_))
    }
}

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    /// Spec files, parts, or folders with such files
    #[arg(required = true, value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gaitc show self_exciting\n  gaitc show my_model.toml --format latex > my_model.tex\n  \
                        gaitc show self_exciting --graph dot | dot -Tsvg > modes.svg"
)]
pub(crate) struct ShowArgs {
    /// Name of a model, or the path of a spec file that ends in .toml
    #[arg(value_name = "MODEL_OR_FILE")]
    pub(crate) model: String,
    /// How to typeset
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,
    /// Print only the graph of modes and transitions
    #[arg(long, value_enum, conflicts_with = "format")]
    pub(crate) graph: Option<GraphFormat>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// For a terminal
    Text,
    /// A LaTeX document
    Latex,
    /// Markdown with formulas between $$
    Markdown,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum GraphFormat {
    /// One arrow a line
    Text,
    /// The DOT language of Graphviz
    Dot,
}

#[derive(Debug, Args)]
pub(crate) struct ExplainArgs {
    /// A code such as E0107; without it all codes are listed
    #[arg(value_name = "CODE")]
    pub(crate) code: Option<String>,
}

/// Which model, and with which values.
#[derive(Debug, Args)]
pub(crate) struct ModelArgs {
    /// Name of a compiled model (see `gaitc models`)
    #[arg(value_name = "MODEL")]
    pub(crate) model: String,
    /// Set a parameter, e.g. --set 'psi=25 deg'
    #[arg(long, value_name = "NAME=QUANTITY", allow_hyphen_values = true)]
    pub(crate) set: Vec<String>,
}

/// Where and how exactly to look for a gait.
#[derive(Debug, Args)]
pub(crate) struct SearchArgs {
    /// First guess of a section coordinate, e.g. --guess 'q_theta=-20 deg'
    #[arg(long, value_name = "COORD=QUANTITY", allow_hyphen_values = true)]
    pub(crate) guess: Vec<String>,
    /// Relative tolerance of the integration's local error
    #[arg(long, value_name = "NUMBER")]
    pub(crate) tol: Option<f64>,
    /// How to integrate: auto, explicit (order 8), radau5 (Radau IIA with 5 stages) or radau3
    #[arg(long, value_name = "METHOD")]
    pub(crate) method: Option<String>,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gaitc gait prescribed_length --set 'psi=25 deg'\n  gaitc gait prescribed_length --period 2 --json\n  \
                  gaitc gait prescribed_length --plot-multipliers multipliers.svg --plot-map map.png"
)]
pub(crate) struct GaitArgs {
    #[command(flatten)]
    pub(crate) model: ModelArgs,
    #[command(flatten)]
    pub(crate) search: SearchArgs,
    /// Number of maps that make one period
    #[arg(long, default_value_t = 1, value_name = "K")]
    pub(crate) period: usize,
    /// Number of segments that a map is cut into: more than 1 is multiple shooting, which finds unstable gaits from further
    /// away (models without a mass matrix)
    #[arg(long, default_value_t = 1, value_name = "N")]
    pub(crate) segments: usize,
    /// Draw the multipliers in the unit circle, as SVG or PNG
    #[arg(long, value_name = "FILE")]
    pub(crate) plot_multipliers: Option<PathBuf>,
    /// Draw the return map with the orbit of the first guess, as SVG or PNG
    #[arg(long, value_name = "FILE")]
    pub(crate) plot_map: Option<PathBuf>,
}

#[derive(Debug, Args)]
#[command(
    after_help = "With no flags the spec's default problem is solved. With --maximize or --minimize the flags are the \
whole problem. Otherwise --vary and --subject-to add to the problem.\n\nExamples:\n  gaitc optimize prescribed_length\n  \
gaitc optimize prescribed_length --minimize spectral_radius --vary 'psi=5..45 deg' --vary 'omega=15..25 rad/s'"
)]
pub(crate) struct OptimizeArgs {
    #[command(flatten)]
    pub(crate) model: ModelArgs,
    #[command(flatten)]
    pub(crate) search: SearchArgs,
    /// Problem of the spec to solve
    #[arg(long, value_name = "NAME", conflicts_with_all = ["maximize", "minimize"])]
    pub(crate) problem: Option<String>,
    /// Measure (or expression over measures and parameters) to make as large as possible
    #[arg(long, value_name = "MEASURE", conflicts_with = "minimize", allow_hyphen_values = true)]
    pub(crate) maximize: Option<String>,
    /// Measure (or `spectral_radius`) to make as small as possible
    #[arg(long, value_name = "MEASURE", allow_hyphen_values = true)]
    pub(crate) minimize: Option<String>,
    /// Parameter to vary with its bounds, e.g. --vary 'psi=1..45 deg'
    #[arg(long, value_name = "NAME=LO..HI", allow_hyphen_values = true)]
    pub(crate) vary: Vec<String>,
    /// Constraint, e.g. --subject-to 'mean_power <= 60 [W]'
    #[arg(long = "subject-to", value_name = "EXPR", allow_hyphen_values = true)]
    pub(crate) subject_to: Vec<String>,
    /// Parameter that is only known to lie in a range: the best worst case over it, e.g. --robust 'm=2.4..2.8 kg'
    #[arg(long, value_name = "NAME=LO..HI", allow_hyphen_values = true, conflicts_with = "trade")]
    pub(crate) robust: Vec<String>,
    /// Number of maps that make the gait [default: that of the problem, else 1]
    #[arg(long, value_name = "K", value_parser = whole)]
    pub(crate) period: Option<usize>,
    /// Number of starting points
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = whole)]
    pub(crate) starts: usize,
    /// Seed of the further starting points
    #[arg(long, default_value_t = 0, value_name = "N")]
    pub(crate) seed: u64,
    /// Number of starts that run side by side, which does not change the result [default: one a core]
    #[arg(long, value_name = "N", value_parser = whole)]
    pub(crate) threads: Option<usize>,
    /// Most maps of the model that one search may take; a gait of K maps takes K
    #[arg(long, default_value_t = 100_000, value_name = "N", value_parser = whole)]
    pub(crate) work: usize,
    /// Two quantities to trade for each other: the best A for every bound on B, e.g. --trade climb_speed:spectral_radius
    #[arg(long, value_name = "A:B", allow_hyphen_values = true)]
    pub(crate) trade: Option<String>,
    /// Number of points of the trade-off curve
    #[arg(long, default_value_t = 20, value_name = "N", requires = "trade", value_parser = whole)]
    pub(crate) points: usize,
    /// Write the trade-off curve as CSV
    #[arg(long, value_name = "FILE", requires = "trade")]
    pub(crate) csv: Option<PathBuf>,
    /// Draw the trade-off curve as SVG or PNG
    #[arg(long, value_name = "FILE", requires = "trade")]
    pub(crate) plot: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct VerifyArgs {
    /// Name of a compiled model
    #[arg(value_name = "MODEL")]
    pub(crate) model: String,
    /// Number of random points
    #[arg(long, default_value_t = 100, value_name = "N")]
    pub(crate) samples: usize,
    /// Seed of the random points
    #[arg(long, default_value_t = 1, value_name = "N")]
    pub(crate) seed: u64,
}

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  gaitc new hopper\n  cd hopper\n  cargo run")]
pub(crate) struct NewArgs {
    /// Folder of the project: it must not exist yet, or be empty
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// Name of the model [default: made from the folder's name]
    #[arg(long, value_name = "NAME", allow_hyphen_values = true)]
    pub(crate) name: Option<String>,
    /// Sources of gaitc to build with: a checkout, or a folder with its unpacked packages
    #[arg(long, value_name = "DIR")]
    pub(crate) crates: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct SchemaArgs {
    /// The schema of parts
    #[arg(long)]
    pub(crate) part: bool,
}

/// What is wrong with the arguments, without the usage that clap prints below it.
pub(crate) fn message(error: &clap::Error) -> String {
    let text = error.render().to_string();
    let end = ["\n\nUsage:", "\n\nFor more information"].iter().filter_map(|tail| text.find(tail)).min();
    let message = text.get(..end.unwrap_or(text.len())).unwrap_or(&text);
    message.strip_prefix("error: ").unwrap_or(message).trim_end().to_owned()
}
