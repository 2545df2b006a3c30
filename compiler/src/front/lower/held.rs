//! Whether points that a drawing calls held stand still in the world: the velocity of the body, which the drawing gives, and that
//! of the point seen from the body, which follows from the equations of motion, cancel. Evaluated at points of each mode.

use super::lowering::{Context, Lowering};
use super::observed::Observed;
use super::sample::{POINTS, around_section, parameters, spread};
use super::value::{Place, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::front::spec::{Equation, Spec};
use crate::ir::eval::{Environment, value};
use crate::ir::{Mode, Model, Node, NodeId, Observer, Point, Symbol};

/// A velocity below this part of its two terms is none.
const STILL: f64 = 1e-9;

/// The velocity of a held point along one axis of the world, by its two terms.
#[derive(Clone, Debug)]
pub(crate) struct Held {
    /// Index of the point.
    point: usize,
    axis: usize,
    /// Of the point as the body sees it.
    own: NodeId,
    /// Of the body.
    body: NodeId,
}

impl Lowering<'_> {
    /// The velocities of all held points.
    pub(super) fn held_points(&mut self, spec: &Spec) -> Vec<Held> {
        let Some((velocity, drawing)) = spec.drawing.as_ref().and_then(|d| Some((d.velocity.as_ref()?, d))) else {
            return Vec::new();
        };
        let held = drawing.points.iter().enumerate().filter(|(_, item)| item.value.held);
        held.filter_map(|(i, item)| Some((i, item.value.at.as_ref()?)))
            .flat_map(|(i, at)| self.held(i, at, velocity))
            .collect()
    }

    /// The velocities of a held point; none where it has no rate to speak of.
    fn held(&mut self, point: usize, at: &[Equation; 2], velocity: &[Equation; 2]) -> Vec<Held> {
        // What is wrong with an expression has been said, and that a place does not move is no reason for a warning.
        let said = self.diagnostics.len();
        let mut held = Vec::new();
        for (axis, (at, velocity)) in at.iter().zip(velocity).enumerate() {
            let pair = self.equation(at, Place::Observation).zip(self.equation(velocity, Place::Observation));
            if let Some((own, body)) = pair
                && let Some(own) = self.velocity_of(own, at)
            {
                held.push(Held { point, axis, own, body: body.node });
            }
        }
        self.diagnostics.truncate(said);
        held
    }

    fn velocity_of(&mut self, place: Value, equation: &Equation) -> Option<NodeId> {
        let span = self.root_span(equation);
        let context = Context::of(Place::Observation);
        self.rate(place, span, span, context).map(|rate| rate.node)
    }
}

/// Warns about held points that move; of a spec without errors.
pub(super) fn check(spec: &Spec, model: &Model, observed: &Observed, diagnostics: &mut Vec<Diagnostic>) {
    let (Some(plane), Some(drawing)) = (observed.drawing.as_ref().and_then(|d| d.plane.as_ref()), &spec.drawing) else {
        return;
    };
    let mut told = None;
    for held in &observed.held {
        let (Some(point), Some(item)) = (plane.points.get(held.point), drawing.points.get(held.point)) else {
            continue;
        };
        let modes = model.modes.iter().enumerate().filter(|(i, _)| point.modes.get(*i) == Some(&true));
        let Some((mode, _)) = { modes }.find(|(i, _)| moves(model, observed, held, *i)) else { continue };
        if told.replace(held.point) == Some(held.point) {
            continue; // along the other axis as well
        }
        let mode = model.modes.get(mode).map_or("?", |mode| mode.name.as_str());
        let message = format!("the point `{}` is held, but moves in mode `{mode}`", item.name);
        let at = item.value.at.as_ref().and_then(|at| at.get(held.axis));
        let span = at.map_or(item.span, |at| at.text.span);
        let term = plane.velocity.get(held.axis).map_or("", |velocity| velocity.text.as_str());
        let warning = Diagnostic::warning(Code::HeldMoves, message).at(span, format!("its rate is not -({term})"));
        diagnostics
            .push(warning.help("check `at` and `velocity`, whose signs are to the right and up; or leave `held` away"));
    }
}

/// Whether the point moves somewhere in a mode.
fn moves(model: &Model, observed: &Observed, held: &Held, mode: usize) -> bool {
    let graph = &observed.names.graph;
    let Some(of_mode) = model.modes.get(mode) else { return false };
    let unknown = |symbol| matches!(symbol, Symbol::Rate(i) if !is_identity(model, of_mode, i));
    if graph.depends(&[held.own, held.body], unknown) {
        return false; // the rate comes from a mass matrix
    }
    let mut observer = Observer::of(graph, &[held.own, held.body], &parameters(model));
    (0..POINTS).any(|n| {
        let (x, memory, tau) = place(model, mode, n);
        let k = rates(model, of_mode, &x, &memory, tau);
        match observer.at(&Point { x: &x, k: &k, tau, t: tau, memory: &memory })[..] {
            // What is no number there says nothing.
            [own, body] => (own + body).abs() > STILL * own.abs().max(body.abs()),
            _ => false,
        }
    })
}

/// States, memory and clock of point number `n` of a mode.
fn place(model: &Model, mode: usize, n: u32) -> (Vec<f64>, Vec<f64>, f64) {
    let section = model.section.as_ref().filter(|section| section.mode(&model.transitions) == Some(mode));
    let anywhere = || (0..model.states.len()).map(|i| 0.4 + 0.3 * spread(n, i)).collect();
    let mut states: Vec<f64> = section.map_or_else(anywhere, |section| around_section(model, section, n));
    let has_state = model.modes.get(mode).map_or(&[][..], |mode| &mode.has_state);
    for (state, has) in states.iter_mut().zip(has_state) {
        *state = if *has { *state } else { 0.0 };
    }
    let memory = model.memory.iter().map(|memory| memory.initial as f64).collect();
    (states, memory, 0.01 * (f64::from(n) + 0.5))
}

/// What the flow says of the rates; those that a mass matrix makes are not asked for.
fn rates(model: &Model, mode: &Mode, states: &[f64], memory: &[f64], tau: f64) -> Vec<f64> {
    let parameters = parameters(model);
    let mut branch = Vec::with_capacity(model.switches.len());
    for switch in &model.switches {
        // A switch that needs others comes behind them.
        let at = Environment {
            states,
            parameters: &parameters,
            memory,
            branch: &branch,
            tau,
            time: tau,
            ..Default::default()
        };
        let on = value(&model.graph, switch.expr, &at) >= 0.0;
        branch.push(on);
    }
    let at =
        Environment { states, parameters: &parameters, memory, branch: &branch, tau, time: tau, ..Default::default() };
    mode.flow.iter().map(|&flow| value(&model.graph, flow, &at)).collect()
}

/// Whether the flow of a state is its rate.
fn is_identity(model: &Model, mode: &Mode, state: usize) -> bool {
    let Some(row) = mode.mass.as_ref().and_then(|mass| mass.get(state)) else { return true };
    row.iter().enumerate().all(|(column, &entry)| {
        let expected: f64 = if column == state { 1.0 } else { 0.0 };
        model.graph.node(entry) == Node::Constant(expected.to_bits())
    })
}
