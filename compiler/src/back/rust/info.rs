//! Names, units and structure of a model as a constant.

use super::values::one_line;
use super::{Context, text};
use crate::dimension::Dimension;
use crate::front::si_unit;
use crate::ir::{AlsoZero, Direction, FunctionalKind};
use crate::valid::Reference;
use proc_macro2::TokenStream;
use quote::quote;

/// The static `INFO`.
pub(super) fn info(context: &Context<'_>, fingerprint: &str) -> TokenStream {
    let (model, facts) = (context.model(), context.validated.facts());
    let name = &model.name;
    let parameters = model.parameters.iter().map(|p| quantity(&p.name, p.dimension));
    let states = model.states.iter().map(|s| quantity(&s.name, s.dimension));
    let measures = model.measures.iter().map(|m| quantity(&m.name, m.dimension));
    let memory = model.memory.iter().map(|m| &m.name);
    let switches = model.switches.iter().map(|s| &s.text);
    let switches_of_modes = facts.mode_switches.iter().zip(&facts.measured_switches);
    let modes = model.modes.iter().zip(switches_of_modes).map(|(mode, (switches, measured))| {
        let name = &mode.name;
        let [switches, measured] = [switches, measured].map(|list| list.iter().map(|&i| text::count(i)));
        quote!(model::ModeInfo { name: #name, switches: &[#(#switches),*], measured_switches: &[#(#measured),*] })
    });
    let transitions = model.transitions.iter().map(|t| {
        let (name, from, to, direction) = (&t.name, text::count(t.from), text::count(t.to), direction(t.direction));
        let also_zero = t.also_zero.iter().map(also_zero);
        quote!(model::TransitionInfo {
            name: #name, from: #from, to: #to, direction: model::Direction::#direction, also_zero: &[#(#also_zero),*],
        })
    });
    let coordinates = model.section.iter().flat_map(|s| &s.coordinates).map(|&i| text::count(i));
    let section = match &model.section {
        Some(section) => {
            let transition = text::count(section.transition);
            let side = if section.before { quote!(Before) } else { quote!(After) };
            quote!(::core::option::Option::Some(model::Section::#side(#transition)))
        }
        None => quote!(::core::option::Option::None),
    };
    let returning = facts.returning.iter().map(|&i| text::count(i));
    let symmetric = model.section.as_ref().is_some_and(|s| s.symmetry.is_some());
    let functionals = model.functionals.iter().zip(&facts.references).map(|(f, &r)| functional(f.kind, r));
    let (uses_time, explicit) = (facts.uses_time, facts.explicit);
    quote! {
        /// Names, units and structure.
        static INFO: model::ModelInfo = model::ModelInfo {
            name: #name,
            fingerprint: #fingerprint,
            parameters: &[#(#parameters),*],
            states: &[#(#states),*],
            memory: &[#(#memory),*],
            modes: &[#(#modes),*],
            transitions: &[#(#transitions),*],
            switches: &[#(#switches),*],
            coordinates: &[#(#coordinates),*],
            section: #section,
            returning: &[#(#returning),*],
            symmetric: #symmetric,
            functionals: &[#(#functionals),*],
            measures: &[#(#measures),*],
            uses_time: #uses_time,
            explicit: #explicit,
        };
    }
}

fn quantity(name: &str, dimension: Dimension) -> TokenStream {
    let si = si_unit(dimension);
    quote!(model::Quantity { name: #name, si: #si })
}

fn also_zero(zero: &AlsoZero) -> TokenStream {
    let (text, si) = (one_line(&zero.text), zero.dimension.to_string());
    let [start, end, rate] = [zero.start, zero.end, zero.rate].map(text::count);
    quote!(model::AlsoZero { text: #text, si: #si, start: #start, end: #end, rate: #rate })
}

fn direction(direction: Direction) -> proc_macro2::Ident {
    match direction {
        Direction::Falling => quote::format_ident!("Falling"),
        Direction::Rising => quote::format_ident!("Rising"),
        Direction::Either => quote::format_ident!("Either"),
    }
}

fn functional(kind: FunctionalKind, reference: Reference) -> TokenStream {
    let index = match reference {
        Reference::Integral(i) | Reference::Observable(i) => text::count(i),
        Reference::None => return quote!(model::Functional::Duration),
    };
    match kind {
        FunctionalKind::Integral => quote!(model::Functional::Integral(#index)),
        FunctionalKind::Mean => quote!(model::Functional::Mean(#index)),
        FunctionalKind::Start => quote!(model::Functional::Start(#index)),
        FunctionalKind::End => quote!(model::Functional::End(#index)),
        FunctionalKind::Maximum => quote!(model::Functional::Maximum(#index)),
        FunctionalKind::Minimum => quote!(model::Functional::Minimum(#index)),
        FunctionalKind::Duration => quote!(model::Functional::Duration),
    }
}
