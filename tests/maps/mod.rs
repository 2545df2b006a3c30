//! Return maps of compiled models from tests, and an integrator on a fixed grid to compare them with.

#![allow(dead_code, unreachable_pub)] // shared by several test files, none of which uses all of it
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

use gaitc::load::{Loaded, load};
use gaitc_runtime::orbit::{Gait, GaitRequest, GaitStatus, find_gait};
use gaitc_runtime::return_map::{Accuracy, MapOutcome, MapRequest, MapResult, Sensitivity};

/// A compiled model with parameter values.
pub struct Machine {
    /// The model.
    pub model: Loaded,
    /// All parameters.
    pub parameters: Vec<f64>,
}

impl Machine {
    /// The model `name` at the values of its spec but for those of `set` (SI units).
    pub fn new(name: &str, set: &[(&str, f64)]) -> Self {
        let model = load(name, None).unwrap();
        let mut parameters = model.parameters();
        for (name, value) in set {
            let index = model.parameter(name).unwrap_or_else(|| panic!("no parameter {name}"));
            parameters[index] = *value;
        }
        Self { model, parameters }
    }

    /// The value of a parameter.
    pub fn value(&self, name: &str) -> f64 {
        self.parameters[self.model.parameter(name).unwrap_or_else(|| panic!("no parameter {name}"))]
    }

    /// What the map at z ends with; `period` maps composed.
    pub fn run(&self, z: &[f64], period: usize) -> MapOutcome {
        let request = MapRequest {
            coordinates: z,
            parameters: &self.parameters,
            memory: &self.model.memory(),
            period,
            sensitivity: Sensitivity::Coordinates,
            measures: true,
            accuracy: Accuracy::default(),
        };
        self.model.compiled.evaluate(&request).unwrap()
    }

    /// The map at z.
    pub fn map(&self, z: &[f64]) -> MapResult {
        match self.run(z, 1) {
            MapOutcome::Completed(map) => *map,
            MapOutcome::Stopped(stop) => panic!("{stop:?}"),
        }
    }

    /// The gait near a guess; without one near the start of the spec.
    pub fn gait(&self, guess: Option<&[f64]>) -> Gait {
        let (memory, start) = (self.model.memory(), self.model.start());
        let request = GaitRequest::new(&self.parameters, &memory);
        let outcome = find_gait(self.model.compiled, &request, guess.unwrap_or(&start)).unwrap();
        assert_eq!(outcome.status, GaitStatus::Converged, "{}", outcome.message);
        outcome.gait.unwrap()
    }

    /// A measure of a map.
    pub fn measure(&self, map: &MapResult, name: &str) -> f64 {
        map.measures[self.model.spec.measures.iter().position(|m| m.name == name).unwrap()]
    }
}

/// One step of the classical Runge-Kutta method.
pub fn rk4<const N: usize>(t: f64, y: [f64; N], h: f64, rate: &impl Fn(f64, &[f64; N]) -> [f64; N]) -> [f64; N] {
    let along = |k: &[f64; N], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
    let a = rate(t, &y);
    let b = rate(t + h / 2.0, &along(&a, h / 2.0));
    let c = rate(t + h / 2.0, &along(&b, h / 2.0));
    let d = rate(t + h, &along(&c, h));
    std::array::from_fn(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
}

/// Steps of size h from y until `guard`, once it has been positive at a grid point, is not; the last step is halved until the time is exact.
/// Time and state there.
pub fn until<const N: usize>(
    y: [f64; N],
    h: f64,
    rate: &impl Fn(f64, &[f64; N]) -> [f64; N],
    guard: &impl Fn(f64, &[f64; N]) -> f64,
) -> (f64, [f64; N]) {
    let (mut y, mut armed) = (y, false);
    for i in 0..10_000_000_u32 {
        let t = h * f64::from(i);
        let next = rk4(t, y, h, rate);
        let after = guard(t + h, &next);
        if armed && after <= 0.0 {
            let (mut low, mut high) = (0.0, h);
            while high - low > f64::EPSILON * h {
                let middle = 0.5 * (low + high);
                if middle == low || middle == high {
                    break;
                }
                let positive = guard(t + middle, &rk4(t, y, middle, rate)) > 0.0;
                if positive { low = middle } else { high = middle }
            }
            return (t + high, rk4(t, y, high, rate));
        }
        armed |= after > 0.0;
        y = next;
    }
    panic!("no event");
}

/// Derivative of a vector function by central differences of fourth order with step h.
pub fn differences<const N: usize>(z: [f64; N], h: f64, f: &impl Fn([f64; N]) -> [f64; N]) -> [[f64; N]; N] {
    let mut jacobian = [[0.0; N]; N];
    for j in 0..N {
        let at = |d: f64| {
            let mut z = z;
            z[j] += d;
            f(z)
        };
        let [far_below, below, above, far_above] = [-2.0 * h, -h, h, 2.0 * h].map(at);
        for i in 0..N {
            jacobian[i][j] = (8.0 * (above[i] - below[i]) - (far_above[i] - far_below[i])) / (12.0 * h);
        }
    }
    jacobian
}
