//! Numbers that others have published about a machine: data, to be shown beside computed ones.

/// What one source says.
#[derive(Clone, Debug, PartialEq)]
pub struct Published {
    /// Name in the spec.
    pub name: String,
    /// For people.
    pub doc: String,
    /// Where it is published.
    pub source: String,
    /// Parameters and their values in SI units, at which to compare.
    pub set: Vec<(usize, f64)>,
    /// First guesses: coordinates of the section by their index, SI units; published ones are guesses as well.
    pub start: Vec<(usize, f64)>,
    /// In the order of the spec.
    pub numbers: Vec<PublishedNumber>,
}

/// A published number.
#[derive(Clone, Debug, PartialEq)]
pub struct PublishedNumber {
    /// Of what.
    pub of: PublishedOf,
    /// SI units.
    pub value: f64,
    /// By how much it scatters, or how exactly it is known; SI units, at least 0.
    pub spread: Option<f64>,
    /// Unit as it was published, for print (empty: dimensionless).
    pub unit: String,
}

/// Of what a number is published.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PublishedOf {
    /// A measure of the model.
    Measure(usize),
    /// The spectral radius of the gait.
    SpectralRadius,
    /// A coordinate of the section, by its index there.
    Coordinate(usize),
}
