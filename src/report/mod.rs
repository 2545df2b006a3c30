//! A model and its gait as one HTML page: animation, tables, pictures, equations, and how to make it again.
//!
//! The page needs nothing but itself: no network, no fonts, no scripts from elsewhere, which its content security policy also
//! forbids. Without JavaScript everything but the animation is there. All text is escaped where it is put in (`html`).

mod animation;
mod collect;
mod comparison;
mod equations;
mod html;
mod page;
mod run;

pub use animation::Animation;
pub use collect::{Study, contents};
pub use equations::equations;
pub use page::page;

use crate::picture::Picture;
use crate::provenance::Provenance;

/// What a page shows.
pub struct Contents {
    /// Heading.
    pub title: String,
    /// Name of the model.
    pub model: String,
    /// Where its equations come from.
    pub source: String,
    /// What the reader has to know first: what was found, warnings.
    pub summary: Vec<String>,
    /// The machine in motion, or why there is no animation.
    pub animation: Result<Animation, String>,
    /// The gait and its measures, its multipliers.
    pub gait: Vec<Table>,
    /// Pictures of the gait.
    pub figures: Vec<Figure>,
    /// Published numbers beside computed ones.
    pub published: Vec<Comparison>,
    /// Values of all parameters.
    pub parameters: Table,
    /// The model's page in Markdown, as `gaitc show` has it.
    pub equations: String,
    /// Where the page comes from.
    pub provenance: Provenance,
    /// The command that makes it again.
    pub command: String,
}

/// A table of text.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// What it shows.
    pub caption: String,
    /// Names of the columns.
    pub header: Vec<String>,
    /// The first column is the head of its row.
    pub rows: Vec<Vec<String>>,
    /// Whether these heads are names of the spec.
    pub names: bool,
}

/// A picture with what there is to say of it.
pub struct Figure {
    /// Below the picture.
    pub caption: String,
    /// The picture.
    pub picture: Box<dyn Picture>,
}

/// What one source has published, beside what was computed.
pub struct Comparison {
    /// Its name in the spec.
    pub name: String,
    /// Where it is published, and remarks.
    pub about: String,
    /// The numbers side by side.
    pub table: Table,
    /// The computed motion with published values as levels.
    pub figure: Option<Figure>,
}
