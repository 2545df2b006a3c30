//! Parameters of parts that their user has fixed: what takes the place of one has its dimension and is as constant.

use super::lowering::{Expected, Lowering};
use super::value::{Place, Style, Uses};
use crate::diagnostic::{Code, Diagnostic};
use crate::front::quantity::Quantities;
use crate::front::spec::{Named, Parameter, Spec};

impl Lowering<'_> {
    /// Checks every fixed parameter.
    pub(super) fn fixed(&mut self, spec: &Spec) {
        for item in &spec.fixed {
            if let Some(fix) = spec.lets.iter().find(|fix| fix.span == item.span && fix.name == item.name) {
                self.fixed_parameter(item, &fix.value);
            }
        }
    }

    fn fixed_parameter(&mut self, item: &Named<Parameter>, equation: &crate::front::spec::Equation) {
        let mut quantities = Quantities { sources: self.sources, diagnostics: self.diagnostics };
        let quantity = item.value.value.as_ref().and_then(|value| quantities.any(value));
        let expected = Expected {
            dimension: quantity.and_then(|quantity| quantity.dimension),
            what: format!("what takes the place of the parameter `{}`", item.name),
            help: "it has the dimension that the parameter has in its part; a number takes its unit behind it"
                .to_owned(),
        };
        let Some(value) = self.checked(equation, Place::Let(Style::Frozen), &expected) else { return };
        if !value.uses.only(Uses::PARAMETER) {
            let message = format!("the parameter `{}` would not be constant", item.name);
            let error = Diagnostic::error(Code::NotConstant, message).at(self.root_span(equation), "");
            self.diagnostics.push(error.help("use numbers and parameters; what changes belongs into [let]"));
        }
    }
}
