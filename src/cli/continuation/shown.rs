//! What is shown beside the parameter: a measure, a section coordinate, or the spectral radius.

use crate::cli::{InputError, inputs};
use crate::load::Loaded;
use gaitc_runtime::study::continuation::Point;

const SPECTRAL_RADIUS: &str = "spectral_radius";

/// A quantity of a gait, in a unit for people.
pub(super) struct Shown {
    pub(super) name: String,
    /// The unit that the spec gives it.
    pub(super) unit: String,
    which: Which,
}

enum Which {
    Measure(usize),
    Coordinate(usize),
    SpectralRadius,
}

impl Shown {
    /// What `--measure` names; else the first measure, or the first coordinate where there is none.
    pub(super) fn new(loaded: &Loaded, name: Option<&str>) -> Result<Self, InputError> {
        let all = Self::all(loaded);
        let Some(name) = name else {
            return Ok(all.into_iter().next().unwrap_or_else(Self::spectral_radius));
        };
        let names: Vec<String> = all.iter().map(|shown| shown.name.clone()).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let unknown = || inputs::unknown("--measure", "measure or section coordinate", name, &names);
        all.into_iter().find(|shown| shown.name == name).ok_or_else(unknown)
    }

    fn all(loaded: &Loaded) -> Vec<Self> {
        let spec = &loaded.spec;
        let mut all: Vec<Self> = (spec.measures.iter().enumerate())
            .map(|(i, m)| Self { name: m.name.clone(), unit: m.unit.clone(), which: Which::Measure(i) })
            .collect();
        let states = loaded.coordinates().iter().map(|&i| &spec.states[i]).enumerate();
        all.extend(states.map(|(i, s)| Self {
            name: s.name.clone(),
            unit: s.unit.clone(),
            which: Which::Coordinate(i),
        }));
        all.push(Self::spectral_radius());
        all
    }

    fn spectral_radius() -> Self {
        Self { name: SPECTRAL_RADIUS.to_owned(), unit: String::new(), which: Which::SpectralRadius }
    }

    /// Its value (SI units); NaN where there is none.
    pub(super) fn of(&self, point: &Point) -> f64 {
        let value = match self.which {
            Which::Measure(i) => point.measures.get(i),
            Which::Coordinate(i) => point.section.get(i),
            Which::SpectralRadius => Some(&point.spectral_radius),
        };
        value.copied().unwrap_or(f64::NAN)
    }
}
