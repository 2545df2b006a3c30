//! Studies on maps in closed form: points by number, gaits that have to be followed, basins of the logistic map.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed expectation is a failed test

use approx::assert_abs_diff_eq;
use gaitc_runtime::interrupt::Interrupt;
use gaitc_runtime::model::{ModelInfo, Quantity};
use gaitc_runtime::orbit::{GaitRequest, GaitStatus, find_gait};
use gaitc_runtime::return_map::{
    Accuracy, MapOutcome, MapRequest, MapResult, Method, RequestError, ReturnMap, Sensitivity, Statistics, Stop,
    StopReason,
};
use gaitc_runtime::study::basin::{Basin, End, Fate, Gaits as Numbered, Settings};
use gaitc_runtime::study::sweep::{Gaits, Reference, Route};
use gaitc_runtime::study::{Axis, Design, Pool};
use nalgebra::{DMatrix, DVector};
use std::sync::atomic::{AtomicUsize, Ordering};

/// A map of one coordinate and one parameter: value and slope, or `None` where it stops.
struct Scalar(fn(f64, f64) -> Option<(f64, f64)>);

static INFO: ModelInfo = ModelInfo {
    name: "scalar",
    fingerprint: "",
    parameters: &[Quantity { name: "p", si: "1" }],
    states: &[Quantity { name: "z", si: "1" }],
    memory: &[],
    modes: &[],
    transitions: &[],
    switches: &[],
    coordinates: &[0],
    section: None,
    returning: &[],
    symmetric: false,
    functionals: &[],
    measures: &[],
    uses_time: false,
    explicit: true,
};

impl ReturnMap for Scalar {
    fn info(&self) -> &'static ModelInfo {
        &INFO
    }

    fn evaluate(&self, request: &MapRequest<'_>) -> Result<MapOutcome, RequestError> {
        let (mut z, mut slope) = (request.coordinates[0], 1.0);
        for _ in 0..request.period {
            let Some((next, by)) = (self.0)(z, request.parameters[0]) else {
                return Ok(MapOutcome::Stopped(Stop { reason: StopReason::NoEvent, time: 1.0, state: vec![z] }));
            };
            (z, slope) = (next, slope * by);
        }
        let columns = if request.sensitivity == Sensitivity::None { 0 } else { 1 };
        Ok(MapOutcome::Completed(Box::new(MapResult {
            coordinates: DVector::from_element(1, z),
            jacobian: DMatrix::from_element(1, columns, slope),
            state: DVector::from_column_slice(request.coordinates),
            end: DVector::from_element(1, z),
            duration: 1.0,
            duration_gradient: DVector::zeros(columns),
            measures: DVector::zeros(0),
            measures_jacobian: DMatrix::zeros(0, 0),
            events: Vec::new(),
            also_zero: Vec::new(),
            statistics: Statistics::default(),
            method: Method::Explicit,
            warnings: Vec::new(),
        })))
    }
}

#[test]
fn points_of_a_grid_by_number() {
    let grid = Design::Grid(vec![
        Axis::Range { lower: 0.1, upper: 0.7, count: 4 },
        Axis::List(vec![5.0, 3.0]),
        Axis::Range { lower: -1.0, upper: -1.0, count: 1 },
    ]);
    assert_eq!(grid.count(), Some(8));
    let points: Vec<Vec<f64>> = (0..8).map(|number| grid.point(number)).collect();
    assert_eq!(
        (&points[0][..], &points[1][..], &points[7][..]),
        (&[0.1, 5.0, -1.0][..], &[0.1, 3.0, -1.0][..], &[0.7, 3.0, -1.0][..])
    );
    assert_abs_diff_eq!(points[2][0], 0.3, epsilon = 1e-15);
    let huge = Axis::Range { lower: 0.0, upper: 1.0, count: u64::MAX };
    assert_eq!(Design::Grid(vec![huge.clone(), huge]).count(), None);
}

#[test]
fn results_come_in_the_order_of_the_points_until_somebody_stops() {
    let never = Interrupt::default();
    for threads in [1, 3] {
        let pool = Pool::new(threads).unwrap();
        let squares = pool.map(5..300, &never, |number| Ok::<u64, ()>(number * number)).unwrap().unwrap();
        assert!(squares.iter().zip(5..300).all(|(square, number)| *square == number * number));
        assert_eq!(pool.map(0..9, &never, |number| if number == 7 { Err(number) } else { Ok(()) }), Err(7));
        let interrupt = Interrupt::new();
        let cut = pool.map(0..100, &interrupt, |number| {
            if number == 20 {
                interrupt.request();
            }
            Ok::<(), ()>(())
        });
        assert_eq!(cut, Ok(None));
    }
}

/// The map contracts to p, and is defined within 1 of it only: from the start at 0 a gait far away has to be followed.
#[test]
fn a_gait_that_is_far_away_is_followed() {
    let map = Scalar(|z, p| ((z - p).abs() < 1.0).then_some((p + 0.5 * (z - p), 0.5)));
    let reference = Reference {
        parameters: vec![0.2],
        memory: Vec::new(),
        start: vec![0.0],
        period: 1,
        accuracy: Accuracy::default(),
    };
    let gaits = Gaits::new(&map, reference.clone()).unwrap();
    for (p, route) in [(0.9, Route::Start), (7.0, Route::Followed), (-30.0, Route::Followed)] {
        let (outcome, by) = gaits.at(&[p]).unwrap();
        assert_eq!((by, &outcome.status), (route, &GaitStatus::Converged));
        assert_abs_diff_eq!(outcome.gait.unwrap().coordinates[0], p, epsilon = 1e-9);
    }
    let (outcome, _) = gaits.at(&[1e6]).unwrap();
    assert_eq!(outcome.status.name(), "no_event");
    // Without a gait to follow there is only the start.
    let lost = Gaits::new(&map, Reference { parameters: vec![5.0], ..reference }).unwrap();
    assert_eq!(lost.at(&[7.0]).unwrap().0.status.name(), "no_event");
    assert_eq!(lost.at(&[0.5]).unwrap().0.status, GaitStatus::Converged);
}

/// z^2 = p has gaits for p > 0; elsewhere the search runs about, from the start and along the way there.
#[test]
fn the_work_for_a_point_without_a_gait_is_bounded() {
    static MAPS: AtomicUsize = AtomicUsize::new(0);
    let map = Scalar(|z, p| {
        MAPS.fetch_add(1, Ordering::Relaxed);
        (z.abs() < 1e6).then_some((z - (z * z - p), 1.0 - 2.0 * z))
    });
    let maps = || MAPS.swap(0, Ordering::Relaxed);
    let request = GaitRequest { measures: false, ..GaitRequest::new(&[-3.0], &[]) };
    let endless = find_gait(&map, &request, &[0.7]).unwrap();
    assert_eq!((endless.status.name(), maps()), ("not_converged", endless.maps));
    let short = find_gait(&map, &GaitRequest { map_limit: 7, ..request }, &[0.7]).unwrap();
    assert_eq!((short.status.name(), short.maps), ("map_limit", 7));
    assert!(short.message.contains("within 7 maps"), "{}", short.message);
    maps();
    let reference = Reference {
        parameters: vec![1.0],
        memory: Vec::new(),
        start: vec![0.7],
        period: 1,
        accuracy: Accuracy::default(),
    };
    let gaits = Gaits::new(&map, reference).unwrap();
    assert!(maps() < 12);
    for p in [1e-4, 4.0, 900.0] {
        let (outcome, _) = gaits.at(&[p]).unwrap();
        assert_eq!(outcome.status, GaitStatus::Converged, "{p}");
        assert_abs_diff_eq!(outcome.gait.unwrap().coordinates[0].abs(), p.sqrt(), epsilon = 1e-7);
    }
    for p in [-1e-3, -3.0, -1e3] {
        maps();
        let (outcome, _) = gaits.at(&[p]).unwrap();
        assert!(["map_limit", "not_converged"].contains(&outcome.status.name()), "{p}: {:?}", outcome.status);
        let maps = maps();
        assert!(maps < 400, "{p}: {maps}");
    }
}

/// z -> p z (1 - z) settles on a point, on two by turns, on four; outside [0, 1] it leaves for good.
#[test]
fn basins_of_the_logistic_map() {
    let map = Scalar(|z, p| (z.abs() < 1e6).then_some((p * z * (1.0 - z), p * (1.0 - 2.0 * z))));
    let fates = |p: f64, periods: usize, starts: &[f64]| -> Vec<Fate> {
        let parameters = [p];
        let settings = Settings {
            request: GaitRequest { measures: false, ..GaitRequest::new(&parameters, &[]) },
            steps: 2000,
            periods,
        };
        let starts: Vec<Vec<f64>> = starts.iter().map(|start| vec![*start]).collect();
        let basin = Basin::new(&map, settings, &[0.3]).unwrap();
        let together = basin.fates(&starts).unwrap();
        let alone: Vec<Fate> =
            starts.iter().flat_map(|start| basin.fates(std::slice::from_ref(start)).unwrap()).collect();
        assert_eq!(together, alone);
        together
    };
    for fate in fates(2.8, 8, &[0.1, 0.5, 0.99]) {
        assert_eq!(fate.end, End::Gait { period: 1 });
        assert_abs_diff_eq!(fate.coordinates[0], 1.0 - 1.0 / 2.8, epsilon = 1e-9);
    }
    let p: f64 = 3.2;
    let upper = (p + 1.0 + ((p - 3.0) * (p + 1.0)).sqrt()) / (2.0 * p);
    for fate in fates(p, 8, &[0.1, 0.4, 0.8]) {
        assert_eq!(fate.end, End::Gait { period: 2 });
        assert_abs_diff_eq!(fate.coordinates[0], upper, epsilon = 1e-9);
    }
    assert!(fates(3.5, 4, &[0.1, 0.7]).iter().all(|fate| fate.end == End::Gait { period: 4 }));
    // Too long a period to look for, chaos, a start on the unstable point itself, a start outside.
    assert_eq!(fates(3.5, 2, &[0.3])[0].end, End::Undecided);
    assert_eq!((fates(3.9, 8, &[0.3])[0].end.clone(), fates(3.9, 8, &[0.3])[0].steps), (End::Undecided, 2000));
    assert_eq!(fates(3.2, 8, &[0.0])[0].end, End::Undecided);
    let gone = &fates(3.2, 8, &[1.5])[0];
    assert_eq!(gone.end, End::Stopped(StopReason::NoEvent));
    assert!(gone.steps > 0 && gone.coordinates[0] < -1e6);
}

#[test]
fn gaits_are_numbered_as_they_are_met() {
    let mut gaits = Numbered::default();
    assert_eq!(gaits.number(1, &[0.5]), 1);
    assert_eq!(gaits.number(2, &[0.5]), 2);
    assert_eq!(gaits.number(1, &[0.5 + 1e-8]), 1);
    assert_eq!(gaits.number(1, &[0.5 + 1e-4]), 3);
    assert_eq!(gaits.all().len(), 3);
}
