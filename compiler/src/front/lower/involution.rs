//! Whether a symmetry is its own inverse, as a reflection is: evaluated twice at points around the section.

use super::sample;
use crate::diagnostic::{Code, Diagnostic};
use crate::front::spec::Spec;
use crate::ir::eval::{Environment, value};
use crate::ir::{Model, NodeId, Section};

/// Differences below this part of the values are rounding.
const ROUNDING: f64 = 1e-9;

/// Warns about a symmetry that does not lead back; `spec` has no errors.
pub(super) fn check(spec: &Spec, model: &Model, diagnostics: &mut Vec<Diagnostic>) {
    let Some(section) = &model.section else { return };
    let Some(symmetry) = &section.symmetry else { return };
    let points: Vec<Moved> = (0..sample::POINTS).filter_map(|n| moved(model, section, symmetry, n)).collect();
    let Some(state) = (0..model.states.len()).find(|&state| wanders(model, state, &points)) else { return };
    let name = model.states.get(state).map_or("", |state| state.name.as_str());
    let equations = spec.section.iter().flat_map(|section| section.symmetry.iter().flatten());
    let Some(equation) = equations.into_iter().find(|equation| equation.name == name) else { return };
    let message = format!("the symmetry applied twice does not lead `{name}` back to where it was");
    let warning = Diagnostic::warning(Code::NoInvolution, message).at(equation.value.text.span, "");
    diagnostics
        .push(warning.help("a mirror image of a mirror image is the original; look for a sign or a missing equation"));
}

/// By how much each state is moved, and below which difference that is rounding.
type Moved = Vec<(f64, f64)>;

/// Whether a state is not led back. A pure number may be moved by the same at every point: an angle by a turn, a phase by a
/// period.
fn wanders(model: &Model, state: usize, points: &[Moved]) -> bool {
    let of = |point: &Moved| point.get(state).copied().unwrap_or((0.0, 0.0));
    let away = points.iter().map(of).any(|(by, rounding)| by.abs() > rounding);
    let (first, _) = points.first().map_or((0.0, 0.0), of);
    let shifted = points.iter().map(of).all(|(by, rounding)| (by - first).abs() <= rounding);
    let number = model.states.get(state).is_some_and(|state| state.dimension.is_none());
    away && !(number && shifted)
}

/// What the symmetry applied twice does at point number `n`; `None` where some value is not finite.
fn moved(model: &Model, section: &Section, symmetry: &[NodeId], n: u32) -> Option<Moved> {
    let parameters = sample::parameters(model);
    let apply = |equations: &[NodeId], states: &[f64]| -> Vec<f64> {
        let at = Environment { states, parameters: &parameters, ..Environment::default() };
        equations.iter().map(|&equation| value(&model.graph, equation, &at)).collect()
    };
    let first = sample::around_section(model, section, n);
    let image = apply(symmetry, &first);
    let back = apply(symmetry, &image);
    let finite = |states: &[f64]| states.iter().all(|value| value.is_finite());
    if !(finite(&first) && finite(&image) && finite(&back)) {
        return None;
    }
    let one = |i: usize| (back[i] - first[i], ROUNDING * (1.0 + first[i].abs() + image[i].abs()));
    Some((0..first.len()).map(one).collect())
}
