//! Replays of plans, for every model in `specs/` that has them: against the adaptive run at the plan's own point and near it,
//! second derivatives against differences of exact first ones.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)] // a test may fail loudly

mod maps;

use gaitc::models::MODELS;
use gaitc_runtime::batch::{Batch, batch};
use gaitc_runtime::return_map::{
    Accuracy, Images, MapOutcome, MapRequest, MapResult, Plan, Points, SecondOrder, Sensitivity,
};
use maps::Machine;
use nalgebra::DMatrix;

/// A model at its gait, with a plan made there.
struct Planned {
    machine: Machine,
    z: Vec<f64>,
    plan: Plan,
}

fn request<'a>(machine: &'a Machine, z: &'a [f64], p: &'a [f64], memory: &'a [f64]) -> MapRequest<'a> {
    let _ = machine;
    let accuracy = Accuracy { relative: 1e-13, absolute: 1e-14, ..Accuracy::default() };
    MapRequest {
        coordinates: z,
        parameters: p,
        memory,
        period: 1,
        sensitivity: Sensitivity::Coordinates,
        measures: false,
        accuracy,
    }
}

impl Planned {
    /// All models whose maps have plans; those with a mass matrix have none yet.
    fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for entry in MODELS {
            let machine = Machine::new(entry.compiled.info().name, &[]);
            let z = machine.gait(None).coordinates.as_slice().to_vec();
            let memory = machine.model.memory();
            let (_, plan) = entry.compiled.plan(&request(&machine, &z, &machine.parameters, &memory)).unwrap();
            match plan {
                Some(plan) => all.push(Self { machine, z, plan }),
                None => println!("no plan: {}", entry.compiled.info().name),
            }
        }
        assert!(all.len() >= 9, "{}", all.len());
        all
    }

    fn name(&self) -> &'static str {
        self.machine.model.compiled.info().name
    }

    fn adaptive(&self, z: &[f64], p: &[f64]) -> MapResult {
        let memory = self.machine.model.memory();
        match self.machine.model.compiled.evaluate(&request(&self.machine, z, p, &memory)).unwrap() {
            MapOutcome::Completed(map) => *map,
            MapOutcome::Stopped(stop) => panic!("{}: {stop:?}", self.name()),
        }
    }

    fn replay(&self, z: &[f64], p: &[f64]) -> Images {
        let mut images = Images::default();
        let points = Points { coordinates: z, parameters: p };
        self.machine.model.compiled.replay(&self.plan, points, &mut images).unwrap();
        images
    }

    fn second(&self, chosen: &[usize]) -> SecondOrder {
        let points = Points { coordinates: &self.z, parameters: &self.machine.parameters };
        self.machine.model.compiled.second_order(&self.plan, points, chosen).unwrap().expect("the plan holds")
    }
}

impl Planned {
    /// By how much second derivatives along direction `j` are off central differences of order 4, with step `h` relative to the
    /// variable.
    fn off_differences(&self, exact: &SecondOrder, j: usize, h: f64) -> f64 {
        let d = self.z.len();
        let value = if j < d { self.z[j] } else { self.machine.parameters[j - d] };
        let h = h * value.abs().max(0.01);
        let at = |offset: f64| {
            let (mut z, mut p) = (self.z.clone(), self.machine.parameters.clone());
            *if j < d { &mut z[j] } else { &mut p[j - d] } += offset * h;
            let map = self.adaptive(&z, &p);
            let mut all = map.jacobian.clone().insert_row(d, 0.0);
            all.set_row(d, &map.duration_gradient.transpose());
            all
        };
        let [a, b, c, e] = [-2.0, -1.0, 1.0, 2.0].map(at);
        let slope = (a - b * 8.0 + c * 8.0 - e) / (12.0 * h);
        let mut second = exact.second[j].columns(0, d).clone_owned().insert_row(d, 0.0);
        second.set_row(d, &exact.duration_second.row(j).columns(0, d));
        let scale = 1.0 / value.abs().max(0.01);
        (&slope - &second).amax() / slope.amax().max(scale)
    }
}

/// The largest difference, relative to the largest entry or 1.
fn difference(a: &DMatrix<f64>, b: &DMatrix<f64>) -> f64 {
    (a - b).amax() / a.amax().max(b.amax()).max(1.0)
}

fn compare(name: &str, images: &Images, map: &MapResult, within: f64) {
    assert!(images.held[0], "{name}: declined");
    let d = map.coordinates.len();
    let image = DMatrix::from_column_slice(d, 1, &images.coordinates);
    let off = difference(&image, &DMatrix::from_column_slice(d, 1, map.coordinates.as_slice()));
    assert!(off <= within, "{name}: image off by {off:e}");
    let off = difference(&images.jacobian(0, d), &map.jacobian);
    assert!(off <= within, "{name}: Jacobian off by {off:e}");
    assert!((images.durations[0] - map.duration).abs() <= within * map.duration, "{name}: duration");
    for (a, b) in images.duration_gradients.iter().zip(map.duration_gradient.iter()) {
        assert!((a - b).abs() <= within * b.abs().max(1.0), "{name}: duration's derivative {a} {b}");
    }
}

#[test]
fn a_replay_is_what_the_adaptive_run_is() {
    for planned in Planned::all() {
        let (z, p) = (&planned.z, &planned.machine.parameters);
        compare(planned.name(), &planned.replay(z, p), &planned.adaptive(z, p), 1e-11);
        for size in [1e-7, 1e-5, 1e-3] {
            let near: Vec<f64> = z.iter().enumerate().map(|(i, z)| z * (1.0 + size * (1.0 + i as f64))).collect();
            let p: Vec<f64> = p.iter().enumerate().map(|(i, p)| p * (1.0 + size * (i as f64).sin())).collect();
            let images = planned.replay(&near, &p);
            if images.held[0] {
                compare(&format!("{} at {size:e}", planned.name()), &images, &planned.adaptive(&near, &p), 1e-11);
            } else {
                assert!(size > 1e-4, "{} declined at {size:e}", planned.name());
                println!("{} declined at {size:e}", planned.name());
            }
        }
    }
}

#[test]
fn second_derivatives_are_those_of_exact_first_ones() {
    for planned in Planned::all() {
        let (d, count) = (planned.z.len(), planned.machine.parameters.len());
        let chosen: Vec<usize> = (0..count).collect();
        let exact = planned.second(&chosen);
        let map = planned.adaptive(&planned.z, &planned.machine.parameters);
        assert!(difference(&exact.jacobian.columns(0, d).clone_owned(), &map.jacobian) < 1e-11, "{}", planned.name());
        for j in 0..d + count {
            // Differences have errors of their own, truncation and rounding: some step size has to agree.
            let off = [1e-3, 3e-4, 1e-4, 3e-5].map(|h| planned.off_differences(&exact, j, h));
            assert!(off.iter().any(|off| *off < 2e-8), "{} direction {j}: {off:?}", planned.name());
        }
    }
}

/// Points around a gait, some of them far off, with parameters of their own.
fn cloud(planned: &Planned, count: usize) -> (Vec<f64>, Vec<f64>) {
    let (mut z, mut p) = (Vec::new(), Vec::new());
    for i in 0..count {
        let size = if i % 7 == 3 { 0.3 } else { 1e-5 } * (i as f64).sin();
        z.extend(planned.z.iter().map(|z| z * (1.0 + size)));
        p.extend(planned.machine.parameters.iter().map(|p| p * (1.0 + 0.1 * size)));
    }
    (z, p)
}

fn in_pool(threads: usize, planned: &Planned, z: &[f64], p: &[f64]) -> Batch {
    let memory = planned.machine.model.memory();
    let request = request(&planned.machine, &planned.z, &planned.machine.parameters, &memory);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let points = Points { coordinates: z, parameters: p };
    pool.install(|| batch(planned.machine.model.compiled, Some(&planned.plan), &request, points).unwrap())
}

#[test]
fn a_batch_has_the_same_bits_however_it_is_split_and_is_what_full_runs_are() {
    for planned in Planned::all() {
        let (d, parameters) = (planned.z.len(), planned.machine.parameters.len());
        let (z, p) = cloud(&planned, 600);
        let whole = in_pool(1, &planned, &z, &p);
        // NaN marks what did not reach the section, and is not equal to itself.
        let text = |batch: &Batch| format!("{batch:?}");
        assert_eq!(text(&in_pool(3, &planned, &z, &p)), text(&whole), "{}", planned.name());
        // Without the first five, all others stand in other lanes.
        let rest = in_pool(2, &planned, &z[5 * d..], &p[5 * parameters..]);
        assert_eq!(rest.images.held, whole.images.held[5..], "{}", planned.name());
        let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&rest.images.coordinates), bits(&whole.images.coordinates[5 * d..]), "{}", planned.name());
        assert_eq!(bits(&rest.images.jacobians), bits(&whole.images.jacobians[5 * d * d..]), "{}", planned.name());
        assert!(whole.in_full < 300, "{}: {} of 600 in full", planned.name(), whole.in_full);
        for point in [0, 1, 3, 10, 599].into_iter().filter(|i| whole.images.held[*i]) {
            let map = planned.adaptive(&z[point * d..][..d], &p[point * parameters..][..parameters]);
            for (a, b) in whole.images.jacobian(point, d).iter().zip(map.jacobian.iter()) {
                assert!((a - b).abs() < 1e-10 * map.jacobian.amax().max(1.0), "{} {point}: {a} {b}", planned.name());
            }
        }
    }
}
