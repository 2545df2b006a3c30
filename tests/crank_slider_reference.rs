//! Checks of the reference itself (`crank_slider`): it converges, its derivatives are those of its values, it keeps
//! energy's book, and it meets the limits that are known at the dead centres. gaitc is not involved.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod crank_slider;

use approx::assert_abs_diff_eq;
use crank_slider::cases;
use crank_slider::chebyshev::Basis;
use crank_slider::gait::{Gait, Method};
use crank_slider::machine::Machine;
use crank_slider::step::Mesh;
use nalgebra::DVector;

/// Largest differences of two gaits in coordinates, duration and multipliers.
fn difference(a: &Gait, b: &Gait) -> f64 {
    let multipliers = a.multipliers.iter().zip(&b.multipliers).map(|(a, b)| (a - b).norm());
    let duration = (a.map.step.duration - b.map.step.duration).abs();
    multipliers.chain([(&a.coordinates - &b.coordinates).amax(), duration]).fold(0.0, f64::max)
}

#[test]
fn gaits_do_not_depend_on_mesh_or_degree() {
    let method = Method::default();
    for machine in cases() {
        let gait = method.gait(&machine).unwrap_or_else(|| panic!("no gait for {machine:?}"));
        let halved = Method { mesh: Mesh::Fixed(gait.map.step.boundaries(2)), ..Method::default() };
        let other = Method { basis: Basis::new(20), mesh: Mesh::Adaptive(1e-13) };
        for finer in [halved, other] {
            let again = finer.gait_from(&machine, &gait.coordinates).unwrap();
            assert!(difference(&gait, &again) < 1e-12, "{machine:?}: {:e}", difference(&gait, &again));
        }
    }
}

#[test]
fn errors_fall_with_the_number_of_elements_at_the_order_of_the_degree() {
    for machine in [Machine::new(20.0, 20.0, 58.0), Machine::new(30.0, 56.57, 200.0)] {
        let gait = Method::default().gait(&machine).unwrap();
        let coarse = Method { basis: Basis::new(6), mesh: Mesh::Adaptive(1e-3) };
        let coarse = coarse.gait_from(&machine, &gait.coordinates).unwrap();
        // Half the coarse mesh's elements is where the error starts to behave.
        let errors: Vec<f64> = [2, 4, 8]
            .into_iter()
            .map(|parts| {
                let method = Method { basis: Basis::new(6), mesh: Mesh::Fixed(coarse.map.step.boundaries(parts)) };
                difference(&gait, &method.gait_from(&machine, &gait.coordinates).unwrap())
            })
            .collect();
        for pair in errors.windows(2) {
            // Order 6 less a margin: halved elements divide the error by 64.
            assert!(pair[1] < pair[0] / 32.0, "{machine:?}: {errors:?}");
        }
    }
}

#[test]
fn the_jacobian_is_the_derivative_of_the_map() {
    let nominal = Machine::nominal();
    for (machine, z) in [
        (nominal, vec![-0.3, -0.4]),
        (Machine::new(27.0, 18.0, 130.0), vec![-0.5, 0.2]),
        (Machine { rotor: 1e-6, ..nominal }, vec![-0.3, -0.4, 21.0]),
        (Machine { rotor: 1e-4, ..nominal }, vec![-0.4, -0.3, 25.0]),
    ] {
        let method = Method::default();
        let z = DVector::from_vec(z);
        let at = method.map(&machine, &z).unwrap();
        for c in 0..z.len() {
            let h = 1e-4;
            let shifted = |sign: f64| {
                let mut z = z.clone();
                z[c] += sign * h;
                let mapped = method.map(&machine, &z).unwrap();
                (mapped.image, mapped.step.duration)
            };
            // Fourth-order differences.
            let [a, b, d, e] = [-2.0, -1.0, 1.0, 2.0].map(shifted);
            let difference = ((d.0 - b.0) * 8.0 - (e.0 - a.0)) / (12.0 * h);
            assert_abs_diff_eq!((difference - at.jacobian.column(c)).amax(), 0.0, epsilon = 1e-9);
            let difference = ((d.1 - b.1) * 8.0 - (e.1 - a.1)) / (12.0 * h);
            assert_abs_diff_eq!(difference, at.step.duration_gradient[c], epsilon = 1e-9);
        }
    }
}

/// Over a step, the motor's work is what kinetic, potential and spring energy gain together.
#[test]
fn the_motor_s_work_is_the_energy_gained() {
    let method = Method::default();
    for machine in cases() {
        let gait = method.gait(&machine).unwrap();
        let energy = |phi: f64, [omega, q, p]: [f64; 3]| {
            let [r, slope, _] = machine.leg(phi);
            let speed = (slope * omega).powi(2) + p * p;
            let stretch = r - machine.body;
            machine.mass * (0.5 * speed - machine.gravity * r * q.cos()) + 0.5 * machine.stiffness * stretch * stretch
        };
        let step = &gait.map.step;
        let first = step.elements[0].values[0];
        let gained = energy(std::f64::consts::PI, step.end()) - energy(0.0, first);
        let work = method.integral(step, |_, u| machine.torque(u[0]) * u[0]);
        // Powers of some 10 kW are in play at low gear ratios.
        assert_abs_diff_eq!(work, gained, epsilon = 1e-10);
    }
}

/// Where the crank-slider stretches and folds the equation for the crank speed is 0/0; its limits are known:
/// Omega' = r'' Omega (F - m r'' Omega^2) omega_nl/(G^2 tau_stall).
#[test]
fn dead_centres_have_their_limits() {
    for machine in cases() {
        let method = Method::default();
        let gait = method.gait(&machine).unwrap();
        let elements = &gait.map.step.elements;
        for (phi, element) in [(0.0, elements.first().unwrap()), (std::f64::consts::PI, elements.last().unwrap())] {
            let u = element.at(&method.basis, phi);
            assert_abs_diff_eq!(u[0], machine.free(), epsilon = 1e-12 * machine.free());
            let [r, _, bend] = machine.leg(phi);
            let rate = bend * u[0] * (machine.pull_out(r, u) - machine.mass * bend * u[0] * u[0]) / machine.damping();
            let slope = element.slope_at(&method.basis, phi);
            assert_abs_diff_eq!(slope * u[0], rate, epsilon = 1e-6 * rate.abs());
        }
    }
}

#[test]
fn the_leg_s_derivatives_are_those_of_its_length() {
    let machine = Machine::nominal();
    for phi in [0.0, 0.3, 1.0, 2.0, 3.0, std::f64::consts::PI] {
        let h = 1e-3;
        let [a, b, c, d, e] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|i| machine.leg(phi + i * h));
        for i in 0..2 {
            let slope = (8.0 * (d[i] - b[i]) - (e[i] - a[i])) / (12.0 * h);
            assert_abs_diff_eq!(slope, c[i + 1], epsilon = 1e-11);
        }
    }
    let [r, ..] = machine.leg(0.0);
    assert_abs_diff_eq!(r, 0.63, epsilon = 1e-15);
    assert_abs_diff_eq!(machine.leg(std::f64::consts::PI)[0], 0.5, epsilon = 1e-15);
}

/// The rotor's climber tends to the one without, linearly in the rotor's inertia.
#[test]
fn the_rotor_s_gait_tends_to_the_one_without_at_first_order() {
    let method = Method::default();
    let machine = Machine::nominal();
    let limit = method.gait(&machine).unwrap();
    let error = |rotor: f64| {
        let gait = method.gait(&Machine { rotor, ..machine }).unwrap();
        assert!(gait.multipliers[2].norm() < 1e-12);
        let coordinates = (gait.coordinates.rows(0, 2) - &limit.coordinates).amax();
        let duration = (gait.map.step.duration - limit.map.step.duration).abs();
        let multipliers = (0..2).map(|i| (gait.multipliers[i] - limit.multipliers[i]).norm()).fold(0.0, f64::max);
        [coordinates, duration, multipliers]
    };
    let [coarse, fine] = [1e-8, 1e-9].map(error);
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        assert_abs_diff_eq!((coarse / fine).log10(), 1.0, epsilon = 0.01);
    }
}

/// Prints the gaits: `cargo test --release --test crank_slider_reference -- --ignored --nocapture`.
#[test]
#[ignore = "prints a table for people"]
#[allow(clippy::print_stdout)] // its purpose
fn table() {
    let method = Method::default();
    println!(
        "psi gear k | q_theta p_theta duration | multiplier (re, im) | climb, lateral m/s | pull, push N | motor rad/s"
    );
    for machine in cases() {
        let gait = method.gait(&machine).unwrap();
        let m = method.measures(&machine, &gait.map.step);
        let (z, step, lambda) = (&gait.coordinates, &gait.map.step, gait.multipliers[0]);
        println!(
            "{:4.1} {:6.2} {:3} | {:.11} {:.11} {:.12} | {:.10} {:.10} | {:.9} {:.9} | {:.4} {:.4} | {:.3}",
            machine.psi.to_degrees(),
            machine.gear,
            machine.stiffness,
            z[0],
            z[1],
            step.duration,
            lambda.re,
            lambda.im,
            m.climb_speed,
            m.lateral_speed,
            m.peak_pull,
            m.peak_push,
            m.peak_motor_speed
        );
    }
}
