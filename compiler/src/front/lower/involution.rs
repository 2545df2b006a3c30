//! Whether a symmetry is its own inverse, as a reflection is: evaluated twice at points of the section.

use crate::diagnostic::{Code, Diagnostic};
use crate::front::spec::Spec;
use crate::ir::eval::{Environment, value};
use crate::ir::{Model, NodeId, Section};

/// How many points are looked at.
const POINTS: u32 = 8;
/// Differences below this part of the values are rounding.
const ROUNDING: f64 = 1e-9;

/// Warns about a symmetry that does not lead back; `spec` has no errors.
pub(super) fn check(spec: &Spec, model: &Model, diagnostics: &mut Vec<Diagnostic>) {
    let Some(section) = &model.section else { return };
    let Some(symmetry) = &section.symmetry else { return };
    let Some(state) = (0..POINTS).find_map(|n| moved(model, section, symmetry, n)) else { return };
    let name = model.states.get(state).map_or("", |state| state.name.as_str());
    let equations = spec.section.iter().flat_map(|section| section.symmetry.iter().flatten());
    let Some(equation) = equations.into_iter().find(|equation| equation.name == name) else { return };
    let message = format!("the symmetry applied twice does not lead `{name}` back to where it was");
    let warning = Diagnostic::warning(Code::NoInvolution, message).at(equation.value.text.span, "");
    diagnostics
        .push(warning.help("a mirror image of a mirror image is the original; look for a sign or a missing equation"));
}

/// A state that is not led back at point number `n`; `None` where there is none, or some value is not finite.
fn moved(model: &Model, section: &Section, symmetry: &[NodeId], n: u32) -> Option<usize> {
    let parameters: Vec<f64> = model.parameters.iter().map(|parameter| parameter.value).collect();
    let apply = |equations: &[NodeId], states: &[f64]| -> Vec<f64> {
        let at = Environment { states, parameters: &parameters, ..Environment::default() };
        equations.iter().map(|&equation| value(&model.graph, equation, &at)).collect()
    };
    let mut on_section = vec![0.0; model.states.len()];
    for (i, (&state, start)) in section.coordinates.iter().zip(&section.start).enumerate() {
        *on_section.get_mut(state)? = start + (0.1 + 0.3 * start.abs()) * spread(n, i);
    }
    let first = apply(&section.embed, &on_section);
    let image = apply(symmetry, &first);
    let back = apply(symmetry, &image);
    let finite = |states: &[f64]| states.iter().all(|value| value.is_finite());
    if !(finite(&first) && finite(&image) && finite(&back)) {
        return None;
    }
    (0..first.len()).find(|&i| (back[i] - first[i]).abs() > ROUNDING * (1.0 + first[i].abs() + image[i].abs()))
}

/// Numbers from -1 to 1 that are spread evenly and follow no pattern of the model.
fn spread(n: u32, i: usize) -> f64 {
    // Multiples of the roots of primes, as Richtmyer's sequence takes them.
    const ROOTS: [f64; 4] =
        [std::f64::consts::SQRT_2, 1.732_050_807_568_877_2, 2.236_067_977_499_79, 2.645_751_311_064_590_7];
    let root = ROOTS[i % ROOTS.len()] * (1 + i / ROOTS.len()) as f64;
    2.0 * ((f64::from(n) + 0.5) * root).fract() - 1.0
}
