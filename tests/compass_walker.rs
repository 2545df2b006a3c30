//! The compass-gait walker: as its legs lose their mass but for the feet it becomes the simplest walking model, whose gait is published.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod maps;

use approx::{assert_abs_diff_eq, assert_relative_eq};
use maps::{Machine, differences, until};

/// Slope (rad), and the leg's angle from its normal and its rate just after touch-down in the gait of Garcia, Chatterjee, Ruina and
/// Coleman (1998), lengths in legs and times in sqrt(l/g).
const SLOPE: f64 = 0.009;
const ANGLE: f64 = 0.200310900544287;
const RATE: f64 = -0.199832473004977;

/// A walker of unit hip mass, leg length and gravity whose feet have the mass m.
fn light_legs(m: f64) -> Machine {
    let set = [("m_H", 1.0), ("m", m), ("a", 0.0), ("b", 1.0), ("g", 1.0), ("gamma", SLOPE)];
    Machine::new("compass_walker", &set)
}

/// The value at 0 of the polynomial through points (Neville).
fn extrapolate(points: &[(f64, f64)]) -> f64 {
    let mut values: Vec<f64> = points.iter().map(|p| p.1).collect();
    for k in 1..points.len() {
        for i in 0..points.len() - k {
            let (a, b) = (points[i].0, points[i + k].0);
            values[i] = (a * values[i + 1] - b * values[i]) / (a - b);
        }
    }
    values[0]
}

#[test]
fn with_light_legs_the_gait_is_that_of_the_simplest_walking_model() {
    let guess = [SLOPE - ANGLE, -RATE, -RATE * (2.0 * ANGLE).cos()];
    let gaits: Vec<_> =
        [8e-3, 4e-3, 2e-3, 1e-3, 5e-4].map(|m| (m, light_legs(m).gait(Some(&guess)).coordinates)).into_iter().collect();
    let limit = |i: usize| extrapolate(&gaits.iter().map(|(m, z)| (*m, z[i])).collect::<Vec<_>>());
    assert_abs_diff_eq!(SLOPE - limit(0), ANGLE, epsilon = 1e-12);
    assert_abs_diff_eq!(-limit(1), RATE, epsilon = 1e-12);
    // The new swing leg moves with the hip.
    assert_abs_diff_eq!(limit(2), -RATE * (2.0 * ANGLE).cos(), epsilon = 1e-10);
}

/// The paper's period-1 gaits are stable up to this slope, where a multiplier passes -1.
#[test]
fn with_light_legs_the_gait_turns_unstable_at_the_published_slope() {
    for (slope, stable) in [(0.0150, true), (0.0152, false)] {
        let mut machine = light_legs(1e-7);
        let index = machine.model.parameter("gamma").unwrap();
        machine.parameters[index] = slope;
        let gait = machine.gait(Some(&[-0.22, 0.23, 0.2]));
        assert_eq!(gait.spectral_radius < 1.0, stable, "{slope}: {:?}", gait.multipliers);
        assert!(gait.multipliers[0].im == 0.0 && gait.multipliers[0].re < 0.0, "{:?}", gait.multipliers);
    }
}

/// Lagrange's equations of a walker with masses on its legs, and conservation of angular momentum at touch-down, with places and
/// velocities of the three masses instead of the formulas of the spec.
mod masses {
    use nalgebra::{Matrix2, Vector2};

    pub(super) struct Walker {
        pub(super) hip: f64,
        pub(super) leg: f64,
        pub(super) a: f64,
        pub(super) b: f64,
        pub(super) g: f64,
    }

    type Pair = [f64; 2];

    fn along(angle: f64) -> Vector2<f64> {
        Vector2::new(angle.sin(), angle.cos())
    }

    fn across(angle: f64) -> Vector2<f64> {
        Vector2::new(angle.cos(), -angle.sin())
    }

    fn moment(r: Vector2<f64>, v: Vector2<f64>) -> f64 {
        r.y * v.x - r.x * v.y
    }

    impl Walker {
        /// Masses with their places as (mass, parts along the stance leg and the swing leg).
        fn bodies(&self) -> [(f64, Pair); 3] {
            let l = self.a + self.b;
            [(self.hip, [l, 0.0]), (self.leg, [self.a, 0.0]), (self.leg, [l, -self.b])]
        }

        /// Accelerations of both angles: d'Alembert's principle for each angle.
        pub(super) fn accelerations(&self, q: Pair, w: Pair) -> Pair {
            let (mut matrix, mut right) = (Matrix2::zeros(), Vector2::zeros());
            for (mass, parts) in self.bodies() {
                // v = sum parts_i w_i across_i; the centripetal part of the acceleration is -parts_i w_i^2 along_i
                let columns = [0, 1].map(|i| across(q[i]) * parts[i]);
                let centripetal = -(along(q[0]) * parts[0] * w[0] * w[0] + along(q[1]) * parts[1] * w[1] * w[1]);
                let load = Vector2::new(0.0, -self.g) - centripetal;
                for i in 0..2 {
                    right[i] += mass * columns[i].dot(&load);
                    for j in 0..2 {
                        matrix[(i, j)] += mass * columns[i].dot(&columns[j]);
                    }
                }
            }
            let solved = matrix.lu().solve(&right).unwrap();
            [solved[0], solved[1]]
        }

        /// Places relative to the stance foot and velocities of hip, stance leg's mass and swing leg's mass.
        fn motion(&self, q: Pair, w: Pair) -> [(f64, Vector2<f64>, Vector2<f64>); 3] {
            self.bodies().map(|(mass, parts)| {
                let place = along(q[0]) * parts[0] + along(q[1]) * parts[1];
                let velocity = across(q[0]) * (parts[0] * w[0]) + across(q[1]) * (parts[1] * w[1]);
                (mass, place, velocity)
            })
        }

        /// Rates after touch-down, of the new stance and the new swing leg.
        pub(super) fn touch_down(&self, q: Pair, w: Pair) -> Pair {
            let l = self.a + self.b;
            let foot = (along(q[0]) - along(q[1])) * l;
            let before = self.motion(q, w);
            let hip = before[0].1;
            let whole: f64 = before.iter().map(|(m, r, v)| m * moment(r - foot, *v)).sum();
            let old = before[1].0 * moment(before[1].1 - hip, before[1].2);
            // The same two moments after it, as linear functions of the new rates; legs have changed their names.
            let after = |w: Pair| {
                let q = [q[1], q[0]];
                let motion = self.motion(q, w);
                let whole: f64 = motion.iter().map(|(m, r, v)| m * moment(*r, *v)).sum();
                Vector2::new(whole, motion[2].0 * moment(motion[2].1 - motion[0].1, motion[2].2))
            };
            let matrix = Matrix2::from_columns(&[after([1.0, 0.0]), after([0.0, 1.0])]);
            let solved = matrix.lu().solve(&Vector2::new(whole, old)).unwrap();
            [solved[0], solved[1]]
        }
    }
}

fn by_masses(z: [f64; 3], gamma: f64) -> ([f64; 3], f64) {
    let walker = masses::Walker { hip: 10.0, leg: 5.0, a: 0.5, b: 0.5, g: 9.81 };
    let rate = |_: f64, [st, sw, w_st, w_sw]: &[f64; 4]| {
        let [a, b] = walker.accelerations([*st, *sw], [*w_st, *w_sw]);
        [*w_st, *w_sw, a, b]
    };
    // Height of the swing foot's lack, which is 0 also when it passes below the slope: only then is the leg behind the normal.
    let guard = |_: f64, y: &[f64; 4]| {
        let ahead = y[0] > gamma;
        if ahead { 2.0 * gamma - y[0] - y[1] } else { 1.0 }
    };
    let start = [z[0], 2.0 * gamma - z[0], z[1], z[2]];
    let (time, y) = until(start, 2e-4, &rate, &guard);
    let [w_st, w_sw] = walker.touch_down([y[0], y[1]], [y[2], y[3]]);
    ([y[1], w_st, w_sw], time)
}

#[test]
fn map_and_jacobian_agree_with_a_formulation_by_masses() {
    let machine = Machine::new("compass_walker", &[]);
    let gait = machine.gait(None);
    let z = [gait.coordinates[0], gait.coordinates[1], gait.coordinates[2]];
    let gamma = machine.value("gamma");
    let (image, duration) = by_masses(z, gamma);
    let jacobian = differences(z, 1e-4, &|z| by_masses(z, gamma).0);
    assert_abs_diff_eq!(gait.map.duration, duration, epsilon = 1e-9);
    for i in 0..3 {
        assert_abs_diff_eq!(image[i], z[i], epsilon = 1e-9);
        for j in 0..3 {
            assert_relative_eq!(gait.map.jacobian[(i, j)], jacobian[i][j], epsilon = 1e-6, max_relative = 1e-6);
        }
    }
    assert_eq!(gait.map.events.len(), 1);
    assert!(machine.measure(&gait.map, "drift") < 1e-10);
    assert!(gait.spectral_radius < 1.0);
}
