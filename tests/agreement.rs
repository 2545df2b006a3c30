//! Multipliers, Jacobians and second derivatives of every model in `specs/` by different routes: single and multiple shooting,
//! the explicit and the implicit method, runs and replays, one map at a time and several in lanes, closed forms.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod maps;
#[path = "agreement/measures.rs"]
mod measures;

use approx::{assert_abs_diff_eq, assert_relative_eq};
use gaitc::models::MODELS;
use gaitc_runtime::orbit::{Gait, GaitRequest, GaitStatus, find_gait};
use gaitc_runtime::return_map::{
    Accuracy, Images, MapOutcome, MapRequest, MapResult, Method, Plan, Points, RequestError, SecondOrder, Sensitivity,
};
use gaitc_runtime::scalar::Scalar;
use gaitc_runtime::sensitivity::Dual;
use maps::Machine;
use nalgebra::{Complex, DMatrix};

fn tight(method: Method) -> Accuracy {
    Accuracy { relative: 1e-13, absolute: 1e-14, method, ..Accuracy::default() }
}

/// A model at its gait.
struct At {
    machine: Machine,
    z: Vec<f64>,
}

impl At {
    fn gait_of(machine: Machine) -> Self {
        let z = machine.gait(None).coordinates.as_slice().to_vec();
        Self { machine, z }
    }

    /// All models at the values of their specs.
    fn all() -> impl Iterator<Item = Self> {
        MODELS.iter().map(|entry| Self::gait_of(Machine::new(entry.compiled.info().name, &[])))
    }

    /// Those with an explicit flow: they have plans.
    fn planned() -> impl Iterator<Item = (Self, Plan)> {
        let explicit = Self::all().filter(|at| at.machine.model.compiled.info().explicit);
        explicit.map(|at| {
            let plan = at.plan().unwrap_or_else(|| panic!("{} has no plan", at.name()));
            (at, plan)
        })
    }

    fn name(&self) -> &'static str {
        self.machine.model.compiled.info().name
    }

    fn ask<R>(&self, z: &[f64], p: &[f64], answer: impl FnOnce(&MapRequest<'_>) -> R) -> R {
        answer(&MapRequest {
            coordinates: z,
            parameters: p,
            memory: &self.machine.model.memory(),
            period: 1,
            sensitivity: Sensitivity::Coordinates,
            measures: false,
            accuracy: tight(Method::Automatic),
        })
    }

    fn run(&self, z: &[f64], p: &[f64]) -> MapOutcome {
        self.ask(z, p, |request| self.machine.model.compiled.evaluate(request).unwrap())
    }

    fn plan(&self) -> Option<Plan> {
        self.ask(&self.z, &self.machine.parameters, |request| self.machine.model.compiled.plan(request).unwrap().1)
    }

    fn replay(&self, plan: &Plan, z: &[f64], p: &[f64]) -> Images {
        let mut images = Images::default();
        self.machine.model.compiled.replay(plan, Points { coordinates: z, parameters: p }, &mut images).unwrap();
        images
    }

    fn second(&self, plan: &Plan) -> SecondOrder {
        let chosen: Vec<usize> = (0..self.machine.parameters.len()).collect();
        let point = Points { coordinates: &self.z, parameters: &self.machine.parameters };
        self.machine.model.compiled.second_order(plan, point, &chosen).unwrap().expect("the plan holds")
    }

    /// The direction of a parameter among those of `second`.
    fn direction(&self, name: &str) -> usize {
        self.z.len() + self.machine.model.parameter(name).unwrap()
    }

    /// The gait again, at a tight tolerance.
    fn gait(&self, method: Method, segments: usize) -> Result<Gait, RequestError> {
        let memory = self.machine.model.memory();
        let request = GaitRequest {
            accuracy: tight(method),
            segments,
            measures: false,
            ..GaitRequest::new(&self.machine.parameters, &memory)
        };
        let outcome = find_gait(self.machine.model.compiled, &request, &self.z)?;
        assert_eq!(outcome.status, GaitStatus::Converged, "{}: {}", self.name(), outcome.message);
        Ok(outcome.gait.unwrap())
    }
}

/// How far the farthest of some multipliers is from its next among others, relative to the largest or 1.
fn apart(a: &[Complex<f64>], b: &[Complex<f64>]) -> f64 {
    assert_eq!(a.len(), b.len());
    let scale = b.iter().map(|b| b.norm()).fold(1.0, f64::max);
    let next = |a: &Complex<f64>| b.iter().map(|b| (a - b).norm()).fold(f64::INFINITY, f64::min);
    a.iter().map(next).fold(0.0, f64::max) / scale
}

/// The largest difference, relative to the largest entry or 1. Not a number where an entry is not.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let scale = b.iter().map(|b| b.abs()).fold(1.0, f64::max);
    let worse = |worst: f64, x: f64| if x > worst || x.is_nan() { x } else { worst };
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / scale).fold(0.0, worse)
}

/// The largest difference of a replay from a run, each array relative to its largest entry or 1.
fn off(images: &Images, map: &MapResult) -> f64 {
    let pairs = [
        (images.coordinates.as_slice(), map.coordinates.as_slice()),
        (images.jacobians.as_slice(), map.jacobian.as_slice()),
        (images.durations.as_slice(), &[map.duration]),
        (images.duration_gradients.as_slice(), map.duration_gradient.as_slice()),
    ];
    pairs.into_iter().map(|(a, b)| difference(a, b)).fold(0.0, |a, b| if b > a || b.is_nan() { b } else { a })
}

#[test]
fn multipliers_do_not_depend_on_the_number_of_segments() {
    for at in At::all() {
        let single = at.gait(Method::Automatic, 1).unwrap();
        for segments in [3, 5, 8] {
            match at.gait(Method::Automatic, segments) {
                Ok(gait) => {
                    assert!(at.machine.model.compiled.info().explicit, "{}", at.name());
                    let [multipliers, z] = [
                        apart(&gait.multipliers, &single.multipliers),
                        difference(gait.coordinates.as_slice(), single.coordinates.as_slice()),
                    ];
                    let said = format!("{} {segments}: {multipliers:e}, section {z:e}", at.name());
                    assert!(multipliers <= 1e-10 && z <= 1e-10, "{said}");
                }
                // Rates of models with a mass matrix are found by steps of their own, which no plan holds.
                Err(error) => {
                    assert!(!at.machine.model.compiled.info().explicit, "{}: {error}", at.name());
                    assert_eq!(error, RequestError::NoPlan(at.name()));
                }
            }
        }
    }
}

#[test]
fn multipliers_do_not_depend_on_the_method() {
    let mut compared = 0;
    for at in At::all().filter(|at| at.machine.model.compiled.info().explicit) {
        let [explicit, implicit] = [Method::Explicit, Method::Radau5].map(|method| at.gait(method, 1).unwrap());
        assert_eq!((explicit.map.method, implicit.map.method), (Method::Explicit, Method::Radau5));
        let off = apart(&explicit.multipliers, &implicit.multipliers);
        assert!(off <= 1e-10, "{}: {off:e}", at.name());
        compared += 1;
    }
    assert!(compared >= 9, "{compared}");
}

/// Number `k` of a sequence that fills 0 to 1 evenly (Weyl's).
fn weyl(k: usize) -> f64 {
    (k as f64 * 2.0_f64.sqrt()).fract()
}

/// `count` points around a gait, each coordinate and parameter varied by up to `size` of itself.
fn around(at: &At, count: usize, size: f64) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let varied = |values: &[f64], k: usize| {
        let vary = |(i, v): (usize, &f64)| v * (1.0 + size * (2.0 * weyl(31 * k + i + 1) - 1.0));
        values.iter().enumerate().map(vary).collect()
    };
    (0..count).map(|k| (varied(&at.z, k), varied(&at.machine.parameters, k + count))).unzip()
}

/// Whether the plan held, and the bits of all numbers of an image.
fn bits(images: &Images, i: usize, d: usize) -> (bool, Vec<u64>) {
    let parts = [
        &images.coordinates[d * i..d * (i + 1)],
        &images.jacobians[d * d * i..d * d * (i + 1)],
        &images.durations[i..=i],
        &images.duration_gradients[d * i..d * (i + 1)],
    ];
    (images.held[i], parts.concat().iter().map(|v| v.to_bits()).collect())
}

/// Neither the place in a batch, nor its size, nor what is in the other lanes shows in a result, whether they hold or not.
#[test]
fn a_lane_has_the_bits_of_a_single_replay() {
    for (at, plan) in At::planned() {
        let (d, p) = (at.z.len(), &at.machine.parameters);
        let alone = at.replay(&plan, &at.z, p);
        assert!(alone.held[0], "{}", at.name());
        let mut declined = 0;
        for (size, count) in [(1e-6, 8), (1e-4, 11), (0.3, 17)] {
            let (mut zs, mut ps) = around(&at, count, size);
            let own = count / 3;
            (zs[own], ps[own]) = (at.z.clone(), p.clone());
            for turn in [0, 1, 3, 5] {
                zs.rotate_left(turn);
                ps.rotate_left(turn);
                let batch = at.replay(&plan, &zs.concat(), &ps.concat());
                for (i, (z, p)) in zs.iter().zip(&ps).enumerate() {
                    let single = at.replay(&plan, z, p);
                    declined += usize::from(!single.held[0]);
                    assert_eq!(bits(&single, 0, d), bits(&batch, i, d), "{} {size:e}: point {i}", at.name());
                }
                let place = zs.iter().zip(&ps).position(|point| (point.0, point.1) == (&at.z, p)).unwrap();
                assert_eq!(bits(&alone, 0, d), bits(&batch, place, d), "{} {size:e}", at.name());
            }
        }
        // Otherwise it was not seen what lanes that are declined do to the others.
        assert!(declined > 0 || at.name() == "bouncing_ball", "{}: none declined", at.name());
    }
}

#[test]
fn replays_are_what_runs_are() {
    for (at, plan) in At::planned() {
        let (mut zs, mut ps) = around(&at, 8, 1e-6);
        zs.push(at.z.clone());
        ps.push(at.machine.parameters.clone());
        for (z, p) in zs.iter().zip(&ps) {
            let images = at.replay(&plan, z, p);
            assert!(images.held[0], "{}", at.name());
            let MapOutcome::Completed(map) = at.run(z, p) else { panic!("{} stops", at.name()) };
            let off = off(&images, &map);
            assert!(off <= 1e-12, "{}: {off:e}", at.name());
        }
    }
}

/// Far away the plan may still be right, as that of a ball is for any speed; where it holds the run says the same, and
/// where the run ends otherwise it does not hold.
#[test]
fn what_held_is_what_the_run_gives_and_the_rest_is_declined() {
    let (mut held, mut declined, mut stopped) = (0, 0, 0);
    for (at, plan) in At::planned() {
        let p = &at.machine.parameters;
        let mut points = Vec::new();
        for factor in [0.2, 0.5, 0.7, 0.9, 1.1, 1.3, 1.5, 3.0] {
            for i in 0..p.len() {
                let mut p = p.clone();
                p[i] *= factor;
                points.push((at.z.clone(), p));
            }
        }
        for factor in [-3.0, -1.0, 0.0, 0.3, 0.8, 1.2, 1.5, 3.0, 10.0, 1e3, 1e200] {
            for i in 0..at.z.len() {
                let mut z = at.z.clone();
                z[i] *= factor;
                points.push((z, p.clone()));
            }
        }
        for (z, p) in points {
            let images = at.replay(&plan, &z, &p);
            let numbers = bits(&images, 0, z.len()).1;
            if !images.held[0] {
                assert!(numbers.iter().all(|bits| f64::from_bits(*bits).is_nan()), "{}", at.name());
                declined += 1;
                continue;
            }
            held += 1;
            match at.run(&z, &p) {
                MapOutcome::Completed(map) => {
                    let off = off(&images, &map);
                    assert!(off <= 1e-10, "{} {z:?} {p:?}: {off:e}", at.name());
                }
                MapOutcome::Stopped(stop) => panic!("{} {z:?} {p:?} held: {stop:?}", at.name()),
            }
        }
        // A step without an end in time, or a fall.
        for (z, p) in falls(&at) {
            let MapOutcome::Stopped(stop) = at.run(&z, &p) else { continue };
            assert!(!at.replay(&plan, &z, &p).held[0], "{}: {stop:?}", at.name());
            stopped += 1;
        }
    }
    assert!(held > 100 && declined > 300 && stopped > 20, "{held} held, {declined} declined, {stopped} stopped");
}

/// Starts and parameters at which many models do not come to the end of a step.
fn falls(at: &At) -> Vec<(Vec<f64>, Vec<f64>)> {
    let p = &at.machine.parameters;
    let mut points = Vec::new();
    for factor in [-10.0, -1.0, -0.1, 0.0, 1e-3, 0.1, 10.0] {
        points.push((at.z.iter().map(|z| z * factor).collect(), p.clone()));
        for i in 0..p.len() {
            let mut p = p.clone();
            p[i] *= factor;
            points.push((at.z.clone(), p));
        }
    }
    points
}

#[test]
fn wrong_plans_and_points_are_refused() {
    let mut planned = At::planned();
    let (wheel, foreign) = planned.find(|(at, _)| at.name() == "rimless_wheel").unwrap();
    for (at, plan) in planned {
        let (map, p, mut images) = (at.machine.model.compiled, &at.machine.parameters, Images::default());
        let points = Points { coordinates: &at.z, parameters: p };
        let refused = RequestError::ForeignPlan { made_for: wheel.name(), given_to: at.name() };
        assert_eq!(map.replay(&foreign, points, &mut images).unwrap_err(), refused);
        assert_eq!(map.second_order(&foreign, points, &[]).unwrap_err(), refused);
        assert_eq!(map.piece(&foreign.pieces(2)[0], &at.z, p).unwrap_err(), refused);
        let z = [at.z.as_slice(), &at.z].concat();
        for (coordinates, parameters) in [
            (&at.z[..0], &p[1..]),
            (&at.z, &p[1..]),
            (&z, &[p.as_slice(), p, p].concat()),
            (&z[..at.z.len()], &[p.as_slice(), p].concat()),
        ] {
            let error = map.replay(&plan, Points { coordinates, parameters }, &mut images).unwrap_err();
            assert!(matches!(error, RequestError::Length { .. }), "{}: {error}", at.name());
        }
        let error = map.second_order(&plan, Points { coordinates: &z, parameters: p }, &[]).unwrap_err();
        assert!(matches!(error, RequestError::Length { expected: 1, got: 2, .. }), "{error}");
        let error = map.second_order(&plan, points, &[0, p.len()]).unwrap_err();
        assert!(matches!(error, RequestError::Length { .. }), "{error}");
        let error = map.piece(&plan.pieces(2)[1], &at.z[..0], p).unwrap_err();
        assert!(matches!(error, RequestError::Length { got: 0, .. }), "{error}");
        let mut p = p.clone();
        p[0] = f64::NAN;
        let error = map.replay(&plan, Points { coordinates: &at.z, parameters: &p }, &mut images).unwrap_err();
        assert!(matches!(error, RequestError::NotFinite { index: 0, .. }), "{error}");
    }
}

/// Values with their first and second derivatives along up to 8 directions.
type Second = Dual<Dual<f64, 8>, 8>;

fn variable(value: f64, direction: usize) -> Second {
    Dual { value: Dual::variable(value, direction), ..Dual::variable(Dual::constant(value), direction) }
}

/// A number's first and second derivatives against a closed form whose directions are the section coordinates, then `names`.
fn compare(at: &At, names: &[&str], got: (&[f64], &DMatrix<f64>), expected: Second) {
    let d = at.z.len();
    let directions: Vec<usize> = (0..d).chain(names.iter().map(|name| at.direction(name))).collect();
    let (first, second) = got;
    let largest = second.amax().max(1.0);
    for (i, &row) in directions.iter().enumerate() {
        assert_abs_diff_eq!(first[row], expected.value.derivative[i], epsilon = 1e-12 * largest);
        for (j, &column) in directions.iter().enumerate() {
            assert_abs_diff_eq!(second[(row, column)], expected.derivative[i].derivative[j], epsilon = 1e-12 * largest);
        }
    }
}

/// Second derivatives of coordinate `i` of the image by all pairs of directions.
fn of_coordinate(second: &SecondOrder, i: usize) -> DMatrix<f64> {
    let n = second.second.len();
    DMatrix::from_fn(n, n, |j, k| second.second[j][(i, k)])
}

/// P = e v + kick, after 2 v/g.
#[test]
fn second_derivatives_of_the_ball_are_the_closed_form() {
    for (e, kick) in [(0.8, 0.5), (0.3, 2.0), (0.95, 0.1)] {
        let at = At::gait_of(Machine::new("bouncing_ball", &[("e", e), ("kick", kick)]));
        let second = at.second(&at.plan().unwrap());
        let [v, e, kick, g] = [at.z[0], e, kick, at.machine.value("g")];
        let [v, e, kick, g] = [variable(v, 0), variable(e, 1), variable(kick, 2), variable(g, 3)];
        let names = ["e", "kick", "g"];
        let row: Vec<f64> = second.jacobian.row(0).iter().copied().collect();
        compare(&at, &names, (&row, &of_coordinate(&second, 0)), e * v + kick);
        let duration = Second::constant(2.0) * v / g;
        compare(&at, &names, (second.duration_gradient.as_slice(), &second.duration_second), duration);
    }
}

/// P = mu sqrt(w^2 + 4 lambda^2 g/l sin(alpha) sin(gamma)), mu = 1 + lambda^2 (cos(2 alpha) - 1).
#[test]
fn second_derivatives_of_the_wheel_are_the_closed_form() {
    for (lambda, alpha, gamma) in [(0.9, 15.0, 5.0), (1.0, 15.0, 3.0), (0.6, 22.5, 9.0), (1.0, 30.0, 16.0)] {
        let (alpha, gamma) = (f64::to_radians(alpha), f64::to_radians(gamma));
        let at = At::gait_of(Machine::new("rimless_wheel", &[("lambda", lambda), ("alpha", alpha), ("gamma", gamma)]));
        let second = at.second(&at.plan().unwrap());
        let values = [at.z[0], lambda, alpha, gamma, at.machine.value("g"), at.machine.value("l")];
        let mut direction = 0;
        let [w, lambda, alpha, gamma, g, l] = values.map(|value| {
            direction += 1;
            variable(value, direction - 1)
        });
        let c = Second::constant;
        let square = lambda * lambda;
        let mu = c(1.0) + square * ((c(2.0) * alpha).cos() - c(1.0));
        let image = mu * (w * w + c(4.0) * square * g / l * alpha.sin() * gamma.sin()).sqrt();
        let row: Vec<f64> = second.jacobian.row(0).iter().copied().collect();
        let names = ["lambda", "alpha", "gamma", "g", "l"];
        compare(&at, &names, (&row, &of_coordinate(&second, 0)), image);
    }
}

/// The determinant is cos(2 psi) (l_b + l_s)/l_b wherever the step starts, and so is its derivative along all directions.
#[test]
fn the_determinant_of_the_prescribed_length_climber_changes_as_its_closed_form() {
    for degrees in [10.0_f64, 20.0, 35.0, 40.0] {
        let psi = degrees.to_radians();
        let at = At::gait_of(Machine::new("prescribed_length", &[("psi", psi)]));
        let second = at.second(&at.plan().unwrap());
        let (l_b, l_s) = (at.machine.value("l_b"), at.machine.value("l_s"));
        let stretch = (l_b + l_s) / l_b;
        let jacobian = second.jacobian.columns(0, 2).clone_owned();
        for (j, slope) in second.second.iter().enumerate() {
            let minor = |i: usize, k: usize| jacobian[(i, k)];
            let got = slope[(0, 0)] * minor(1, 1) + minor(0, 0) * slope[(1, 1)]
                - slope[(0, 1)] * minor(1, 0)
                - minor(0, 1) * slope[(1, 0)];
            let expected = match j {
                j if j == at.direction("psi") => -2.0 * (2.0 * psi).sin() * stretch,
                j if j == at.direction("l_s") => (2.0 * psi).cos() / l_b,
                j if j == at.direction("l_b") => -(2.0 * psi).cos() * l_s / (l_b * l_b),
                _ => 0.0,
            };
            let scale = slope.columns(0, 2).amax() * jacobian.amax();
            assert_abs_diff_eq!(got, expected, epsilon = 1e-12 * scale.max(1.0));
        }
        // A step lasts pi/omega.
        let (j, omega) = (at.direction("omega"), at.machine.value("omega"));
        let exact = 2.0 * std::f64::consts::PI / omega.powi(3);
        assert_relative_eq!(second.duration_second[(j, j)], exact, max_relative = 1e-13);
    }
}
