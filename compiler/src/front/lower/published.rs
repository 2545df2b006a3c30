//! The tables `[published.NAME]`: quantities of measures, parameters and coordinates of the section.

use super::lowering::Lowering;
use super::scope::Entity;
use crate::diagnostic::{Code, Diagnostic};
use crate::dimension::Dimension;
use crate::front::quantity::Quantities;
use crate::front::spec::{self, Named, Spec};
use crate::front::text::Text;
use crate::ir::{Published, PublishedNumber, PublishedOf};

/// What the spectral radius is called.
const RADIUS: &str = "spectral_radius";

impl Lowering<'_> {
    /// Lowers `[published]`.
    pub(super) fn published(&mut self, spec: &Spec) {
        for item in &spec.published {
            let published = self.publication(item);
            self.model.published.extend(published);
        }
    }

    fn publication(&mut self, item: &Named<spec::Published>) -> Option<Published> {
        let spec::Published { doc, source, set, start, measures, section, spread } = &item.value;
        let names: Vec<String> = self.model.parameters.iter().map(|parameter| parameter.name.clone()).collect();
        let set: Vec<_> = set.iter().map(|item| self.given("parameter", item, &names)).collect();
        let names = self.coordinate_names();
        let start: Vec<_> = start.iter().map(|item| self.given("section coordinate", item, &names)).collect();
        let of_section: Vec<_> = section.iter().map(|item| self.given("section coordinate", item, &names)).collect();
        let known: Vec<String> = measures.iter().chain(section).map(|item| item.name.clone()).collect();
        let spread: Vec<_> = spread.iter().map(|item| self.spread(item, &known)).collect();
        let mut names: Vec<String> = self.model.measures.iter().map(|measure| measure.name.clone()).collect();
        let radius = names.len();
        names.push(RADIUS.to_owned());
        let measures: Vec<_> = measures.iter().map(|item| self.given("measure", item, &names)).collect();
        let measure = |i| if i == radius { PublishedOf::SpectralRadius } else { PublishedOf::Measure(i) };
        let number = |of: PublishedOf, (_, value, unit): Given| PublishedNumber { of, value, spread: None, unit };
        let measures = measures.into_iter().map(|given| given.map(|given| number(measure(given.0), given)));
        let coordinate = |given: Given| number(PublishedOf::Coordinate(given.0), given);
        let numbers = measures.chain(of_section.into_iter().map(|given| given.map(coordinate)));
        let mut numbers = numbers.collect::<Option<Vec<_>>>()?;
        for (i, value) in spread.into_iter().collect::<Option<Vec<_>>>()? {
            if let Some(number) = numbers.get_mut(i) {
                number.spread = Some(value);
            }
        }
        let value = |given: Option<Given>| given.map(|(i, value, _)| (i, value));
        Some(Published {
            name: item.name.clone(),
            doc: doc.clone(),
            source: source.as_ref()?.value.clone(),
            numbers,
            set: set.into_iter().map(value).collect::<Option<_>>()?,
            start: start.into_iter().map(value).collect::<Option<_>>()?,
        })
    }

    /// How much a number that is published scatters: its index among `known` and the spread in SI units.
    fn spread(&mut self, item: &Named<Text>, known: &[String]) -> Option<(usize, f64)> {
        let (index, value, _) = self.given("published number", item, known)?;
        if value < 0.0 {
            let message = format!("the spread of `{}` is negative", item.name);
            let error = Diagnostic::error(Code::BadValue, message).at(item.value.span, "");
            self.diagnostics.push(error.help("give by how much the number scatters on either side, as in \"4 cm/s\""));
            return None;
        }
        Some((index, value))
    }

    fn coordinate_names(&self) -> Vec<String> {
        let coordinates = self.model.section.iter().flat_map(|section| &section.coordinates);
        coordinates.map(|&state| self.state_name(state)).collect()
    }

    /// A quantity of something named: its index among `names`, SI value and unit.
    fn given(&mut self, kind: &str, item: &Named<Text>, names: &[String]) -> Option<Given> {
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let index = self.reference(kind, &item.name, item.span, &names);
        let definition = self.scope.get(&item.name);
        let radius = item.name == RADIUS && !matches!(definition.map(|d| d.entity), Some(Entity::Measure(_)));
        let dimension = if radius { Some(Dimension::NONE) } else { definition.and_then(|d| d.dimension) };
        let mut quantities = Quantities { sources: self.sources, diagnostics: self.diagnostics };
        // Read in any case, for its messages.
        let quantity = quantities.any(&item.value)?;
        quantities.check(&quantity, item.value.span, dimension?, &format!("`{}`", item.name))?;
        Some((index?, quantity.value, quantity.unit))
    }
}

/// Index, SI value and unit.
type Given = (usize, f64, String);
