//! Parameters of parts that their user has fixed: what takes the place of one has its dimension and is as constant.

use super::dimension_text;
use super::lowering::Lowering;
use super::value::{Uses, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::front::quantity::Quantities;

impl Lowering<'_> {
    /// Whether a let can take the place of the parameter whose place it has taken, if it has; reports one that cannot.
    pub(super) fn fits(&mut self, item: usize, value: Value) -> bool {
        let Some(fix) = self.definitions.lets.get(item) else { return true };
        let parameter = self.definitions.fixed.iter().find(|fixed| fixed.span == fix.span && fixed.name == fix.name);
        let Some(parameter) = parameter else { return true };
        let span = self.root_span(&fix.value);
        // What the part itself says wrongly of its parameter is not to be heard twice.
        let mut unheard = Vec::new();
        let mut quantities = Quantities { sources: self.sources, diagnostics: &mut unheard };
        let quantity = parameter.value.value.as_ref().and_then(|value| quantities.any(value));
        if let (Some(wanted), Some(got)) = (quantity.and_then(|quantity| quantity.dimension), value.dimension)
            && wanted != got
        {
            let message =
                format!("the parameter `{}` is {}, not {}", fix.name, dimension_text(wanted), dimension_text(got));
            let label = format!("{} is {}", self.quote(span), dimension_text(got));
            let place = parameter.value.value.as_ref().map_or(fix.span, |value| value.span);
            let error =
                Diagnostic::error(Code::EquationDimension, message).at(span, label).see(place, "its value in the part");
            self.diagnostics.push(error.help("write something of that dimension; a number takes its unit behind it"));
            return false;
        }
        if !value.uses.only(Uses::PARAMETER) {
            let message = format!("the parameter `{}` would not be constant", fix.name);
            let error = Diagnostic::error(Code::NotConstant, message).at(span, "");
            self.diagnostics.push(error.help("use numbers and parameters; what changes belongs into [let]"));
            return false;
        }
        true
    }
}
