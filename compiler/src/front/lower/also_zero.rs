//! Functions that are zero together with the guard of the section's transition: their values at both ends of a map, and
//! their time derivative at its end, which is 0 where they only touch zero.

use super::lowering::{Context, Lowering};
use super::value::Place;
use crate::diagnostic::{Code, Diagnostic};
use crate::dimension::Dimension;
use crate::front::spec::{Equation, Named, Spec, Transition};
use crate::ir::{AlsoZero, FunctionalKind};
use crate::source::Span;

impl Lowering<'_> {
    /// Lowers `also_zero` of all transitions.
    pub(super) fn also_zero(&mut self, spec: &Spec) {
        let after = spec.section.as_ref().map(|section| section.anchor.as_ref().map(|a| a.name().value.as_str()));
        for (i, item) in spec.transitions.iter().enumerate() {
            let Some((span, equations)) = &item.value.also_zero else { continue };
            match after {
                Some(Some(name)) if name == item.name => {}
                // Which transition is meant has been asked for already.
                Some(None) => continue,
                _ => {
                    self.not_of_the_section(item, *span, after.flatten());
                    continue;
                }
            }
            for equation in equations {
                let Some(zero) = self.also_zero_entry(equation) else { continue };
                if let Some(transition) = self.model.transitions.get_mut(i) {
                    transition.also_zero.push(zero);
                }
            }
        }
    }

    fn also_zero_entry(&mut self, equation: &Equation) -> Option<AlsoZero> {
        let value = self.equation(equation, Place::Functional)?;
        if !self.moves(value, equation, "this function") {
            return None;
        }
        let span = self.root_span(equation);
        let rate = self.rate(value, span, span, Context::of(Place::Functional))?;
        Some(AlsoZero {
            text: equation.text.value.trim().to_owned(),
            dimension: value.dimension.unwrap_or(Dimension::NONE),
            start: self.functional_index(FunctionalKind::Start, value.node),
            end: self.functional_index(FunctionalKind::End, value.node),
            rate: self.functional_index(FunctionalKind::End, rate.node),
        })
    }

    fn not_of_the_section(&mut self, item: &Named<Transition>, span: Span, after: Option<&str>) {
        let message = format!("`also_zero` of transition `{}`, at which there is no section", item.name);
        let error = Diagnostic::error(Code::UnknownReference, message).at(span, "");
        self.diagnostics.push(match after {
            Some(after) => error.help(format!("it is known at the ends of a map: move it to [transitions.{after}]")),
            None => error.help(format!("add a [section] with `after = \"{}\"`, or remove it", item.name)),
        });
    }
}
