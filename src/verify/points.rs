//! Random points at which derivatives are compared: parameters in their ranges, states around the section's start,
//! branch selectors as the switching functions give them and, at every other point, turned at random (frozen selectors
//! may be on either side).
//!
//! Of three points one is anywhere, one on the section and one where a guard is zero: that is where a map begins and
//! ends, and where mass matrices like to be singular.

use crate::load::Loaded;
use gaitc_compiler::ir::eval::{Environment, derivative, value};
use gaitc_compiler::ir::{NodeId, Symbol};
use gaitc_runtime::probe::Point;
use gaitc_runtime::random::SplitMix64;

/// Most steps of Newton's method to a guard's zero.
const NEWTON_STEPS: usize = 50;

/// Makes random points.
pub struct Points<'a> {
    loaded: &'a Loaded,
    random: SplitMix64,
    made: usize,
}

/// A point that owns its numbers.
pub struct Owned {
    x: Vec<f64>,
    k: Vec<f64>,
    p: Vec<f64>,
    memory: Vec<f64>,
    functionals: Vec<f64>,
    branch: Vec<bool>,
    tau: f64,
    t: f64,
}

impl Owned {
    /// The point as generated functions take it.
    pub fn borrow(&self) -> Point<'_> {
        let Self { x, k, p, memory, functionals, branch, tau, t } = self;
        Point { x, k, p, memory, functionals, branch, tau: *tau, t: *t }
    }

    fn environment(&self) -> Environment<'_> {
        Environment {
            states: &self.x,
            rates: &self.k,
            parameters: &self.p,
            memory: &self.memory,
            branch: &self.branch,
            tau: self.tau,
            time: self.t,
            ..Environment::default()
        }
    }
}

impl<'a> Points<'a> {
    /// Points of a model, reproducible by seed.
    pub fn new(loaded: &'a Loaded, seed: u64) -> Self {
        Self { loaded, random: SplitMix64::new(seed.wrapping_mul(SplitMix64::STEP)), made: 0 }
    }

    fn between(&mut self, lower: f64, upper: f64) -> f64 {
        lower + (upper - lower) * self.random.uniform()
    }

    fn parameters(&mut self) -> Vec<f64> {
        let loaded = self.loaded;
        let one = |p: &gaitc_compiler::ir::Parameter| match p.range {
            Some((lower, upper)) => self.between(lower, upper),
            None => p.value * self.between(0.8, 1.2),
        };
        loaded.spec.parameters.iter().map(one).collect()
    }

    /// States around the point of the section where gaits are first looked for.
    fn states(&mut self, p: &[f64]) -> Vec<f64> {
        let spec = &self.loaded.spec;
        let mut center = vec![0.0; spec.states.len()];
        if let Some(section) = &spec.section {
            for (&i, &start) in section.coordinates.iter().zip(&section.start) {
                center[i] = start;
            }
            center = self.embedded(&center, p);
        }
        center.into_iter().map(|c| c + c.abs().max(0.2) * self.between(-1.0, 1.0)).collect()
    }

    /// The point of the section with the same coordinates; the same state where there is no section.
    fn embedded(&self, x: &[f64], p: &[f64]) -> Vec<f64> {
        let spec = &self.loaded.spec;
        let at = Environment { states: x, parameters: p, ..Environment::default() };
        let embed = |section: &gaitc_compiler::ir::Section| -> Vec<f64> {
            section.embed.iter().map(|&e| value(&spec.graph, e, &at)).collect()
        };
        spec.section.as_ref().map_or_else(|| x.to_vec(), embed)
    }

    /// Moves state and tau to the zero of a guard, by Newton's method along its gradient; selectors stay as they are.
    /// Leaves the point where it was if that leads nowhere.
    fn to_zero(&self, guard: NodeId, point: &mut Owned) {
        let graph = &self.loaded.spec.graph;
        let (x, tau) = (point.x.clone(), point.tau);
        for _ in 0..NEWTON_STEPS {
            let at = point.environment();
            let miss = value(graph, guard, &at);
            let slopes: Vec<f64> = (0..x.len()).map(|i| derivative(graph, guard, &at, Symbol::State(i))).collect();
            let by_tau = derivative(graph, guard, &at, Symbol::Tau);
            let square = slopes.iter().map(|s| s * s).sum::<f64>() + by_tau * by_tau;
            let step = miss / square;
            if !step.is_finite() {
                (point.x, point.tau) = (x, tau);
                return;
            }
            point.x.iter_mut().zip(&slopes).for_each(|(x, slope)| *x -= step * slope);
            point.tau -= step * by_tau;
            if miss == 0.0 {
                return;
            }
        }
    }

    /// The next point.
    pub fn next_point(&mut self) -> Owned {
        let spec = &self.loaded.spec;
        self.made += 1;
        let p = self.parameters();
        let mut x = self.states(&p);
        if self.made % 3 == 1 {
            x = self.embedded(&x, &p);
        }
        let k = spec.states.iter().map(|_| self.between(-2.0, 2.0)).collect();
        let memory =
            spec.memory.iter().map(|m| m.initial as f64 + (self.random.uniform() * 4.0).floor()).collect::<Vec<_>>();
        let functionals = spec.functionals.iter().map(|_| self.between(0.2, 2.0)).collect();
        let (tau, t) = (self.between(0.0, 0.5), self.between(0.0, 5.0));
        let branch = vec![false; spec.switches.len()];
        let mut point = Owned { x, k, p, memory, functionals, branch, tau, t };
        self.select(&mut point);
        if self.made % 3 == 2 && !spec.transitions.is_empty() {
            // Each guard in its turn.
            let transition = &spec.transitions[self.made / 3 % spec.transitions.len()];
            self.to_zero(transition.guard, &mut point);
            self.select(&mut point);
        }
        if self.made.is_multiple_of(2) {
            for selector in &mut point.branch {
                *selector = self.random.uniform() < 0.5;
            }
        }
        point
    }

    /// Sets the selectors as the switching functions say.
    fn select(&self, point: &mut Owned) {
        let spec = &self.loaded.spec;
        // Selectors may depend on one another: as many passes as there are switches settle any acyclic order.
        for _ in 0..spec.switches.len() {
            let at = point.environment();
            point.branch = spec.switches.iter().map(|s| value(&spec.graph, s.expr, &at) >= 0.0).collect();
        }
    }
}
