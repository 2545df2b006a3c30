//! The vertical climber with rack and pinion: during a step it is linear, so that everything is a matrix exponential.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;
mod maps;

use approx::assert_abs_diff_eq;
use common::json;
use maps::Machine;
use nalgebra::{Matrix3, Vector3};

const L_S: f64 = 0.13;

/// The flow of (y_1, y_2, 1): y_1' = y_2, y_2' = c + a y_1 + b y_2.
struct Linear {
    generator: Matrix3<f64>,
}

impl Linear {
    /// From eqs. 6.3.1, 6.3.2 and 7.1.1.
    fn of(machine: &Machine) -> Self {
        let v = |name| machine.value(name);
        let (m, lever) = (v("m"), v("G") / v("r_p"));
        let stall = lever * v("tau_stall") * v("command") / m;
        let damping = lever * lever * v("tau_stall") / v("omega_nl") / m;
        let spring = v("k") / m;
        let constant = stall + spring * L_S - v("g");
        Self { generator: Matrix3::new(0.0, 1.0, 0.0, -spring, -damping, constant, 0.0, 0.0, 0.0) }
    }

    fn at(&self, t: f64) -> Matrix3<f64> {
        (self.generator * t).exp()
    }

    /// Duration of a step that begins with the speed v, its last speed and the derivative of that by v.
    fn step(&self, v: f64) -> [f64; 3] {
        let start = Vector3::new(0.0, v, 1.0);
        let (mut low, mut high) = (0.0, 10.0 * L_S / v);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if (self.at(middle) * start)[0] < L_S { low = middle } else { high = middle }
        }
        let mut time = high;
        for _ in 0..3 {
            let y = self.at(time) * start;
            time -= (y[0] - L_S) / y[1];
        }
        let flow = self.at(time);
        let y = flow * start;
        let rate = self.generator * y;
        // The height at the end is fixed: the time makes up for what the start adds to it.
        [time, y[1], flow[(1, 1)] - rate[1] / y[1] * flow[(0, 1)]]
    }
}

#[test]
fn map_duration_and_derivative_are_the_matrix_exponential() {
    for (gear, spring) in [(56.57, 58.0), (56.57, 0.0), (25.0, 58.0), (12.0, 200.0), (6.0, 10.0)] {
        let machine = Machine::new("power_stroke", &[("G", gear), ("k", spring)]);
        let linear = Linear::of(&machine);
        for v in [0.2, 0.86, 2.5] {
            let map = machine.map(&[v]);
            let [time, end, slope] = linear.step(v);
            assert_abs_diff_eq!(map.duration, time, epsilon = 1e-11);
            assert_abs_diff_eq!(map.coordinates[0], end, epsilon = 1e-11);
            assert_abs_diff_eq!(map.jacobian[(0, 0)], slope, epsilon = 1e-11);
        }
    }
}

#[test]
fn gait_and_multiplier_are_the_matrix_exponential() {
    for (gear, spring) in [(56.57, 58.0), (25.0, 58.0), (12.0, 200.0)] {
        let machine = Machine::new("power_stroke", &[("G", gear), ("k", spring)]);
        let linear = Linear::of(&machine);
        let gait = machine.gait(None);
        // Newton on the closed form.
        let mut v = 1.0;
        for _ in 0..30 {
            let [_, end, slope] = linear.step(v);
            v += (end - v) / (1.0 - slope);
        }
        let [time, _, slope] = linear.step(v);
        assert_abs_diff_eq!(gait.coordinates[0], v, epsilon = 1e-11);
        assert_abs_diff_eq!(gait.map.duration, time, epsilon = 1e-11);
        assert_abs_diff_eq!(gait.multipliers[0].re, slope, epsilon = 1e-11);
        assert_abs_diff_eq!(machine.measure(&gait.map, "climb_speed"), L_S / time, epsilon = 1e-11);
        assert!(slope > 0.0 && slope < 1.0);
    }
}

#[test]
fn the_tool_reports_a_stable_gait() {
    let (code, gait) = json(&["gait", "power_stroke", "--set", "G=12"]);
    assert_eq!((code, gait["stable"].as_bool()), (0, Some(true)), "{gait:#}");
    assert_eq!(gait["multipliers"].as_array().unwrap().len(), 1);
}
