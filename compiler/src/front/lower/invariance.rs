//! Whether a model is invariant under the symmetry of its section, S: evaluated at points around the section.
//!
//! With the memory n of the run and n' of its image, S carries motions into motions where f_n'(S x) = DS f_n(x) in each mode
//! (M(S x) DS k = f_n'(S x) for rates k with M k = f where there is a mass matrix), each transition has an image, itself or
//! another one, whose guard is the same up to a factor of the right sign, and resets follow: R_n'(S x) = S R_n(x). Only then is a fixed point of the mirrored map a gait. Which memory the image
//! has is not said; it is looked for among those that one or two transitions make of the initial one.

use super::sample;
use crate::diagnostic::{Code, Diagnostic};
use crate::front::spec::Spec;
use crate::ir::eval::{Environment, derivative, value};
use crate::ir::{Direction, Model, NodeId, Section, Symbol};
use crate::source::Span;

/// Differences below this part of the terms are rounding.
const ROUNDING: f64 = 1e-8;

/// What is not invariant.
#[derive(Clone, Copy)]
enum Broken {
    /// The flow of a state in a mode.
    Flow { mode: usize, state: usize },
    /// The guard of a transition.
    Guard(usize),
    /// The reset of a state in a transition.
    Reset { transition: usize, state: usize },
}

impl Broken {
    /// The state in question.
    const fn state(self) -> Option<usize> {
        match self {
            Self::Flow { state, .. } | Self::Reset { state, .. } => Some(state),
            Self::Guard(_) => None,
        }
    }
}

/// Warns about a symmetry under which a spec without errors is not invariant.
pub(super) fn check(spec: &Spec, model: &Model, diagnostics: &mut Vec<Diagnostic>) {
    let Some(section) = &model.section else { return };
    let Some(symmetry) = &section.symmetry else { return };
    let check = Check { model, section, symmetry, parameters: sample::parameters(model) };
    let Some(broken) = check.broken() else { return };
    let (what, span) = describe(spec, model, broken);
    let message = format!("the model is not invariant under its symmetry: {what} does not follow");
    let place = spec.section.as_ref().map(|section| section.span);
    let lines = || spec.section.iter().flat_map(|section| section.symmetry.iter().flatten());
    let name = broken.state().and_then(|state| model.states.get(state)).map(|state| state.name.as_str());
    let line = lines().find(|equation| Some(equation.name.as_str()) == name).or_else(|| lines().next());
    let Some(place) = line.map(|equation| equation.value.text.span).or(place) else { return };
    let warning = Diagnostic::warning(Code::NotInvariant, message).at(place, "the symmetry");
    let warning = span.map_or(warning.clone(), |span| warning.see(span, "the equation"));
    let help = "a fixed point of the mirrored map is then no gait; look for a missing sign, or for a memory, as in `(-1)^n`, that \
                tells one side from the other";
    diagnostics.push(warning.help(help));
}

fn describe(spec: &Spec, model: &Model, broken: Broken) -> (String, Option<Span>) {
    let state = |i: usize| model.states.get(i).map_or("?", |state| state.name.as_str());
    match broken {
        Broken::Flow { mode, state: i } => {
            let item = spec.modes.get(mode);
            let flow = item.and_then(|item| item.value.flow.iter().find(|flow| flow.name == state(i)));
            let name = item.map_or("?", |item| item.name.as_str());
            (format!("the flow of `{}` in mode `{name}`", state(i)), flow.map(|flow| flow.value.text.span))
        }
        Broken::Guard(i) => {
            let name = model.transitions.get(i).map_or("?", |transition| transition.name.as_str());
            let surface = || spec.surfaces.get(i.checked_sub(spec.transitions.len())?)?.value.guard.as_ref();
            let guard = spec.transitions.get(i).and_then(|item| item.value.guard.as_ref()).or_else(surface);
            (format!("the guard of `{name}`"), guard.map(|guard| guard.text.span))
        }
        Broken::Reset { transition, state: i } => {
            let item = spec.transitions.get(transition);
            let reset = item.and_then(|item| item.value.reset.iter().find(|reset| reset.name == state(i)));
            let name = item.map_or("?", |item| item.name.as_str());
            (format!("the reset of `{}` by `{name}`", state(i)), reset.map(|reset| reset.value.text.span))
        }
    }
}

struct Check<'a> {
    model: &'a Model,
    section: &'a Section,
    symmetry: &'a [NodeId],
    parameters: Vec<f64>,
}

/// A state with its memory, its clock and the selectors there.
struct At {
    states: Vec<f64>,
    memory: Vec<f64>,
    tau: f64,
    branch: Vec<bool>,
}

impl Check<'_> {
    /// What is not invariant, whatever the memory of the image.
    fn broken(&self) -> Option<Broken> {
        let initial: Vec<f64> = self.model.memory.iter().map(|memory| memory.initial as f64).collect();
        let mut found = None;
        for memory in self.memories(&initial) {
            found = self.broken_with(&initial, &memory);
            found?;
        }
        found
    }

    /// What one or two transitions make of a memory, and itself.
    fn memories(&self, initial: &[f64]) -> Vec<Vec<f64>> {
        let mut all = vec![initial.to_vec()];
        let mut next = 0;
        for _ in 0..2 {
            let known = all.len();
            for i in next..known {
                let states = sample::around_section(self.model, self.section, 0);
                let at = self.at(states, all[i].clone(), 0);
                for transition in &self.model.transitions {
                    let memory: Vec<f64> = transition.memory_reset.iter().map(|&root| self.value(root, &at)).collect();
                    if !all.contains(&memory) && all.len() < 16 {
                        all.push(memory);
                    }
                }
            }
            next = known;
        }
        all
    }

    fn broken_with(&self, memory: &[f64], image_memory: &[f64]) -> Option<Broken> {
        let points: Vec<(At, At)> = (0..sample::POINTS)
            .map(|n| {
                let at = self.at(sample::around_section(self.model, self.section, n), memory.to_vec(), n);
                let image = self.at(self.image(&at.states), image_memory.to_vec(), n);
                (at, image)
            })
            .filter(|(at, image)| at.states.iter().chain(&image.states).all(|value| value.is_finite()))
            .collect();
        let modes = 0..self.model.modes.len();
        let flow = points.iter().find_map(|(at, image)| modes.clone().find_map(|mode| self.flow(mode, at, image)));
        flow.or_else(|| (0..self.model.transitions.len()).find_map(|i| self.without_image(i, &points)))
    }

    /// What is wrong with a transition that no transition is the image of. The image of the section's is itself: the map
    /// ends there.
    fn without_image(&self, index: usize, points: &[(At, At)]) -> Option<Broken> {
        let own = self.not_image(index, index, points)?;
        let others = 0..self.model.transitions.len();
        let found = |&other: &usize| other != self.section.transition && self.not_image(index, other, points).is_none();
        (index == self.section.transition || !others.into_iter().any(|other| found(&other))).then_some(own)
    }

    /// Why the transition `other` is not the image of `index`, if it is not.
    fn not_image(&self, index: usize, other: usize, points: &[(At, At)]) -> Option<Broken> {
        let (transition, image) = (self.model.transitions.get(index)?, self.model.transitions.get(other)?);
        let same_modes = (transition.from, transition.to) == (image.from, image.to);
        // The image passes zero in the direction that its transition asks for: the factor between the guards says which way.
        let allowed = |ratio: f64| match (transition.direction, image.direction) {
            (Direction::Either, Direction::Either) => ratio != 0.0,
            (a, b) if a == b => ratio > 0.0,
            (Direction::Either, _) | (_, Direction::Either) => false,
            _ => ratio < 0.0,
        };
        let ratios = points.iter().map(|(at, of)| self.value(image.guard, of) / self.value(transition.guard, at));
        let ratios: Vec<f64> = ratios.filter(|ratio| ratio.is_finite()).collect();
        let same = |ratio: &f64| allowed(*ratio) && (ratio - ratios[0]).abs() <= 1e-6 * ratios[0].abs();
        if !same_modes || !ratios.iter().all(same) {
            return Some(Broken::Guard(index));
        }
        points.iter().find_map(|(at, of)| self.reset((index, other), at, of))
    }

    fn at(&self, states: Vec<f64>, memory: Vec<f64>, n: u32) -> At {
        let tau = 0.1 * sample::spread(n, 2).abs();
        let mut at = At { states, memory, tau, branch: vec![false; self.model.switches.len()] };
        // Conditions may depend on each other, each on those before it.
        for i in 0..at.branch.len() {
            at.branch[i] = self.value(self.model.switches[i].expr, &at) >= 0.0;
        }
        at
    }

    fn environment<'e>(&'e self, at: &'e At) -> Environment<'e> {
        Environment {
            states: &at.states,
            parameters: &self.parameters,
            memory: &at.memory,
            branch: &at.branch,
            tau: at.tau,
            ..Environment::default()
        }
    }

    fn value(&self, root: NodeId, at: &At) -> f64 {
        value(&self.model.graph, root, &self.environment(at))
    }

    fn image(&self, states: &[f64]) -> Vec<f64> {
        let at = Environment { states, parameters: &self.parameters, ..Environment::default() };
        self.symmetry.iter().map(|&root| value(&self.model.graph, root, &at)).collect()
    }

    /// A state of the mode whose flow does not follow.
    fn flow(&self, index: usize, at: &At, image: &At) -> Option<Broken> {
        let mode = self.model.modes.get(index)?;
        let states: Vec<usize> = (0..mode.flow.len()).filter(|&i| mode.has_state.get(i) == Some(&true)).collect();
        let rates = self.rates(index, &states, at)?;
        let environment = Environment { states: &at.states, parameters: &self.parameters, ..Environment::default() };
        let carried: Vec<f64> = states
            .iter()
            .map(|&i| {
                let slope =
                    |&j: &usize| derivative(&self.model.graph, self.symmetry[i], &environment, Symbol::State(j));
                states.iter().zip(&rates).map(|(j, rate)| slope(j) * rate).sum()
            })
            .collect();
        let state = states.iter().enumerate().find(|(row, state)| {
            let flow = self.value(mode.flow[**state], image);
            let (mut sum, mut size) = (-flow, flow.abs());
            for (column, other) in states.iter().enumerate() {
                let term = self.mass(index, (**state, *other), image) * carried[column];
                (sum, size) = (sum + term, size + term.abs());
            }
            let scale = size + rates[*row].abs();
            sum.is_finite() && sum.abs() > ROUNDING * scale.max(1e-3)
        });
        state.map(|(_, &state)| Broken::Flow { mode: index, state })
    }

    fn mass(&self, mode: usize, (row, column): (usize, usize), at: &At) -> f64 {
        match self.model.modes.get(mode).and_then(|mode| mode.mass.as_ref()) {
            Some(rows) => rows.get(row).and_then(|row| row.get(column)).map_or(0.0, |&entry| self.value(entry, at)),
            None => f64::from(u8::from(row == column)),
        }
    }

    /// The rates k with M k = f of some states; `None` where the matrix is singular or something is not finite.
    fn rates(&self, mode: usize, states: &[usize], at: &At) -> Option<Vec<f64>> {
        let flow = &self.model.modes.get(mode)?.flow;
        let mut rows: Vec<Vec<f64>> = states
            .iter()
            .map(|&i| {
                let entries = states.iter().map(|&j| self.mass(mode, (i, j), at));
                entries.chain([self.value(flow[i], at)]).collect()
            })
            .collect();
        for pivot in 0..rows.len() {
            let best = (pivot..rows.len()).max_by(|&a, &b| rows[a][pivot].abs().total_cmp(&rows[b][pivot].abs()))?;
            rows.swap(pivot, best);
            let (head, tail) = rows.split_at_mut(pivot + 1);
            let lead = &head[pivot];
            for row in tail {
                let factor = row[pivot] / lead[pivot];
                row.iter_mut().zip(lead).for_each(|(entry, lead)| *entry -= factor * lead);
            }
        }
        let size = rows.len();
        let mut rates = vec![0.0; size];
        for i in (0..size).rev() {
            let known: f64 = (i + 1..size).map(|j| rows[i][j] * rates[j]).sum();
            rates[i] = (rows[i][size] - known) / rows[i][i];
        }
        rates.iter().all(|rate| rate.is_finite()).then_some(rates)
    }

    /// A state whose reset by a transition is not carried into that by its image.
    fn reset(&self, (index, other): (usize, usize), at: &At, image: &At) -> Option<Broken> {
        let (transition, of) = (self.model.transitions.get(index)?, self.model.transitions.get(other)?);
        let values =
            |roots: &[NodeId], at: &At| -> Vec<f64> { roots.iter().map(|&root| self.value(root, at)).collect() };
        let (carried, made) = (self.image(&values(&transition.reset, at)), values(&of.reset, image));
        let has_state = &self.model.modes.get(transition.to)?.has_state;
        let differs = |i: &usize| {
            let (a, b) = (carried[*i], made[*i]);
            has_state.get(*i) == Some(&true)
                && (a - b).is_finite()
                && (a - b).abs() > ROUNDING * (1e-3 + a.abs() + b.abs())
        };
        (0..made.len()).find(differs).map(|state| Broken::Reset { transition: index, state })
    }
}
