//! Measures of a step: mean speeds, extreme forces and speeds, mean powers.

use super::gait::Method;
use super::machine::Machine;
use super::step::{Element, Step};
use std::f64::consts::PI;

/// Measures of one step, SI units.
#[derive(Clone, Copy, Debug)]
pub struct Measures {
    /// Mean upward speed.
    pub climb_speed: f64,
    /// Mean magnitude of the sideways speed.
    pub lateral_speed: f64,
    /// Largest actuation force (spring included).
    pub peak_pull: f64,
    /// Largest actuation force outwards.
    pub peak_push: f64,
    /// Largest motor speed.
    pub peak_motor_speed: f64,
    /// Mean of the motor's power where it is positive.
    pub mean_power: f64,
    /// Mean of the power that is fed back into the motor.
    pub regenerated_power: f64,
}

/// Samples an element for sign changes and extrema.
const SAMPLES: usize = 60;

impl Method {
    /// Measures of a step of the machine.
    pub fn measures(&self, machine: &Machine, step: &Step) -> Measures {
        let duration = step.duration;
        let sideways = |phi: f64, u: [f64; 3]| machine.leg(phi)[1] * u[0] * u[1].sin() + u[2] * u[1].cos();
        let power = |_: f64, u: [f64; 3]| machine.torque(u[0]) * u[0];
        let net: f64 = self.integral(step, power);
        let positive = self.positive_integral(step, power);
        let across: f64 = self.integral(step, sideways);
        Measures {
            climb_speed: self.climb_speed(machine, step),
            lateral_speed: (2.0 * self.positive_integral(step, sideways) - across) / duration,
            peak_pull: self.maximum(step, |phi, u, slope| machine.actuation(phi, u, slope * u[0])),
            peak_push: self.maximum(step, |phi, u, slope| -machine.actuation(phi, u, slope * u[0])),
            peak_motor_speed: machine.gear * self.maximum(step, |_, u, _| u[0]),
            mean_power: positive / duration,
            regenerated_power: (positive - net) / duration,
        }
    }

    /// Mean upward speed: the height -r cos(q_theta) gained, over the duration.
    pub fn climb_speed(&self, machine: &Machine, step: &Step) -> f64 {
        let height = |phi: f64, u: [f64; 3]| -machine.leg(phi)[0] * u[1].cos();
        (height(PI, step.end()) - height(0.0, step.elements[0].values[0])) / step.duration
    }

    /// Time integral of a function of phi and u.
    pub fn integral(&self, step: &Step, f: impl Fn(f64, [f64; 3]) -> f64) -> f64 {
        step.elements.iter().map(|e| self.piece(e, e.range, &f)).sum()
    }

    /// Time integral of the positive part, in pieces between the function's sign changes.
    fn positive_integral(&self, step: &Step, f: impl Fn(f64, [f64; 3]) -> f64) -> f64 {
        let mut sum = 0.0;
        for element in &step.elements {
            let value = |phi: f64| f(phi, element.at(&self.basis, phi));
            let mut cuts = vec![element.range[0]];
            for pair in samples(element).windows(2) {
                if (value(pair[0]) > 0.0) != (value(pair[1]) > 0.0) {
                    cuts.push(bisect(&value, pair[0], pair[1]));
                }
            }
            cuts.push(element.range[1]);
            for pair in cuts.windows(2) {
                if value(0.5 * (pair[0] + pair[1])) > 0.0 {
                    sum += self.piece(element, [pair[0], pair[1]], &f);
                }
            }
        }
        sum
    }

    fn piece(&self, element: &Element, [from, to]: [f64; 2], f: &impl Fn(f64, [f64; 3]) -> f64) -> f64 {
        let half = 0.5 * (to - from);
        let nodes = self.basis.nodes.iter().map(|x| from + half * (1.0 + x));
        let values = nodes.map(|phi| {
            let u = element.at(&self.basis, phi);
            f(phi, u) / u[0]
        });
        half * values.zip(&self.basis.weights).map(|(value, weight)| value * weight).sum::<f64>()
    }

    /// Largest value of a function of phi, u and d Omega/d phi: the best sample, then golden sections around it.
    fn maximum(&self, step: &Step, f: impl Fn(f64, [f64; 3], f64) -> f64) -> f64 {
        let mut best = f64::NEG_INFINITY;
        for element in &step.elements {
            let value = |phi: f64| f(phi, element.at(&self.basis, phi), element.slope_at(&self.basis, phi));
            let points = samples(element);
            let values: Vec<f64> = points.iter().map(|phi| value(*phi)).collect();
            let top = (0..values.len()).max_by(|a, b| values[*a].total_cmp(&values[*b])).unwrap_or(0);
            let (left, right) = (points[top.saturating_sub(1)], points[(top + 1).min(SAMPLES)]);
            best = best.max(values[top]).max(value(golden(&value, left, right, 60)));
        }
        best
    }
}

fn samples(element: &Element) -> Vec<f64> {
    let [from, to] = element.range;
    (0..=SAMPLES).map(|i| if i == SAMPLES { to } else { from + (to - from) * i as f64 / SAMPLES as f64 }).collect()
}

/// Where a function changes sign between two points.
fn bisect(f: &impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let sign = f(a) > 0.0;
    for _ in 0..60 {
        let middle = 0.5 * (a + b);
        if (f(middle) > 0.0) == sign { a = middle } else { b = middle }
    }
    0.5 * (a + b)
}

/// Where a function with one maximum between two points has it; each iteration shortens the bracket to 0.618 of its length.
pub fn golden(f: &impl Fn(f64) -> f64, mut a: f64, mut b: f64, iterations: usize) -> f64 {
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut c, mut d) = (b - ratio * (b - a), a + ratio * (b - a));
    let (mut at_c, mut at_d) = (f(c), f(d));
    for _ in 0..iterations {
        if at_c > at_d {
            (b, d, at_d) = (d, c, at_c);
            c = b - ratio * (b - a);
            at_c = f(c);
        } else {
            (a, c, at_c) = (c, d, at_d);
            d = a + ratio * (b - a);
            at_d = f(d);
        }
    }
    0.5 * (a + b)
}
