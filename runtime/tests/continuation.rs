//! Continuation of maps with closed forms: where they turn, lose stability and branch.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use approx::assert_abs_diff_eq;
use common::formula::Formula;
use gaitc_runtime::orbit::GaitRequest;
use gaitc_runtime::return_map::{ReturnMap, StopReason};
use gaitc_runtime::study::continuation::{
    Bifurcation, Branch, ContinuationError, ContinuationOutcome, ContinuationRequest, Criticality, Diagram, EndReason,
    Interrupt, Kind, Settings, Side, follow,
};

fn run(map: &dyn ReturnMap, p: &[f64], range: (f64, f64), guess: &[f64], settings: Settings) -> Diagram {
    let request = ContinuationRequest { gait: GaitRequest::new(p, &[]), parameter: 0, range, settings };
    match follow(map, &request, guess).unwrap() {
        ContinuationOutcome::Diagram(diagram) => diagram,
        ContinuationOutcome::NoStart(outcome) => panic!("{}", outcome.message),
    }
}

fn kinds(branch: &Branch) -> Vec<Kind> {
    branch.bifurcations.iter().map(|b| b.kind).collect()
}

fn only(branch: &Branch, kind: Kind) -> &Bifurcation {
    let all: Vec<&Bifurcation> = branch.bifurcations.iter().filter(|b| b.kind == kind).collect();
    assert_eq!(all.len(), 1, "{kind:?} in {:?}", kinds(branch));
    all[0]
}

fn logistic() -> Formula<1, 1> {
    Formula::new(|&[x], &[r]| Some(([r * x * (1.0 - x)], [[r * (1.0 - 2.0 * x)]], [[x * (1.0 - x)]])))
}

/// Period doublings of x+ = r x (1 - x): at 3, 1 + sqrt 6 and 3.5440903596.
#[test]
fn the_logistic_map_doubles_its_period() {
    let settings = Settings { doublings: 2, ..Settings::default() };
    let all = run(&logistic(), &[2.5], (1.5, 3.55), &[0.6], settings);
    let values: Vec<f64> = all.branches.iter().map(|b| only(b, Kind::Flip).point.value).collect();
    for (value, expected) in values.iter().zip([3.0, 1.0 + 6.0_f64.sqrt(), 3.544_090_359_551_9]) {
        assert_abs_diff_eq!(*value, expected, epsilon = 1e-10);
    }
    assert_eq!(all.branches.iter().map(|b| b.period).collect::<Vec<_>>(), [1, 2, 4]);
    for branch in &all.branches {
        assert_eq!(only(branch, Kind::Flip).criticality, Some(Criticality::Supercritical));
        assert_eq!(branch.ends[1], EndReason::RangeEnd(Side::Upper));
        let last = branch.points.last().unwrap();
        assert_eq!(last.value, 3.55);
        for point in &branch.points {
            let (r, mut x) = (point.value, point.section[0]);
            for _ in 0..branch.period {
                x = r * x * (1.0 - x);
            }
            assert_abs_diff_eq!(x, point.section[0], epsilon = 1e-11);
        }
    }
    // x = 1 - 1/r with multiplier 2 - r, both ways.
    let first = &all.branches[0];
    assert_eq!((first.points[0].value, &first.ends[0]), (1.5, &EndReason::RangeEnd(Side::Lower)));
    for point in &first.points {
        assert_abs_diff_eq!(point.section[0], 1.0 - 1.0 / point.value, epsilon = 1e-11);
        assert_abs_diff_eq!(point.multipliers[0].re, 2.0 - point.value, epsilon = 1e-10);
        assert_eq!(point.stable(), point.value < 3.0);
        assert_abs_diff_eq!(point.measures[0], point.section[0], epsilon = 1e-10);
    }
    assert_eq!(all.branches[1].parent.map(|p| (p.branch, p.bifurcation)), Some((0, 0)));
}

/// x = 0 and x = 1 - 1/r meet at r = 1.
#[test]
fn the_other_branch_of_a_transcritical_crossing_is_entered() {
    let settings = Settings { branches: true, ..Settings::default() };
    let all = run(&logistic(), &[0.5], (0.4, 2.0), &[0.0], settings);
    assert_eq!((all.branches.len(), all.not_entered.len()), (2, 0));
    let at = only(&all.branches[0], Kind::Branch);
    assert_abs_diff_eq!(at.point.value, 1.0, epsilon = 1e-9);
    assert_eq!(at.criticality, Some(Criticality::Transcritical));
    let other = &all.branches[1];
    assert_eq!(kinds(other), []);
    assert_eq!((other.points[0].value, other.points.last().unwrap().value), (0.4, 2.0));
    for point in &other.points {
        assert_abs_diff_eq!(point.section[0], 1.0 - 1.0 / point.value, epsilon = 1e-9);
    }
}

/// x+ = x + p x - x^3: the arms x = +-sqrt p of a pitchfork, from the stem and from an arm. (At p = 1 the arms flip.)
#[test]
fn a_pitchfork_is_one_branch_point_from_stem_and_arm() {
    let map = Formula::new(|&[x], &[p]| Some(([x + p * x - x * x * x], [[1.0 + p - 3.0 * x * x]], [[x]])));
    let settings = Settings { branches: true, ..Settings::default() };
    for (p, guess) in [(-0.5, 0.0), (0.25, 0.5)] {
        let all = run(&map, &[p], (-0.9, 0.9), &[guess], settings.clone());
        assert_eq!(all.branches.len(), 2, "from {guess}");
        let at = only(&all.branches[0], Kind::Branch);
        assert_abs_diff_eq!(at.point.value, 0.0, epsilon = 1e-8);
        assert_eq!(at.criticality, Some(Criticality::Supercritical), "from {guess}");
        for branch in &all.branches {
            assert!(kinds(branch).iter().all(|kind| *kind == Kind::Branch), "{:?}", kinds(branch));
            let stem = branch.points.iter().all(|p| p.section[0].abs() < 1e-6);
            for point in &branch.points {
                let x = point.section[0];
                assert!(stem || (x * x - point.value).abs() < 1e-9, "{point:?}");
            }
            let (first, last) = (&branch.points[0], branch.points.last().unwrap());
            let ends = if stem { [-0.9, 0.9] } else { [0.9, 0.9] };
            assert_eq!([first.value, last.value], ends);
        }
    }
}

/// x+ = x + p x + x^3: the arms x = +-sqrt -p are there where the stem is still stable.
#[test]
fn a_subcritical_pitchfork_is_told_from_both_of_its_branches() {
    let map = Formula::new(|&[x], &[p]| Some(([x + p * x + x * x * x], [[1.0 + p + 3.0 * x * x]], [[x]])));
    for (p, guess) in [(-0.5, 0.0), (-0.25, 0.5)] {
        let all = run(&map, &[p], (-0.9, 0.9), &[guess], Settings::default());
        let at = only(&all.branches[0], Kind::Branch);
        assert_eq!(at.criticality, Some(Criticality::Subcritical), "from {guess}");
    }
}

/// Henon's map x+ = 1 - a x^2 + y, y+ = b x: a fold at -(1-b)^2/4, a flip at 3 (1-b)^2/4.
#[test]
fn the_henon_map_turns_and_flips() {
    let map = Formula::<2, 2>::new(|&[x, y], &[a, b]| {
        Some(([1.0 - a * x * x + y, b * x], [[-2.0 * a * x, 1.0], [b, 0.0]], [[-x * x, 0.0], [0.0, x]]))
    });
    let all = run(&map, &[0.1, 0.3], (-0.3, 0.8), &[0.9, 0.3], Settings::default());
    let branch = &all.branches[0];
    assert_abs_diff_eq!(only(branch, Kind::Fold).point.value, -0.1225, epsilon = 1e-12);
    let flip = only(branch, Kind::Flip);
    assert_abs_diff_eq!(flip.point.value, 0.3675, epsilon = 1e-10);
    assert_eq!(flip.criticality, Some(Criticality::Supercritical));
    // The lower part goes to infinity at a = 0, where the map is linear.
    assert_eq!(branch.ends[0], EndReason::Unbounded);
    assert_eq!(branch.points.last().unwrap().value, 0.8);
}

/// x+ = r x (1 - y), y+ = x: a complex pair on the unit circle at r = 2, exp(+-i pi/3).
#[test]
fn the_delayed_logistic_map_begins_to_turn() {
    let map = Formula::new(|&[x, y], &[r]| {
        Some(([r * x * (1.0 - y), x], [[r * (1.0 - y), -r * x], [1.0, 0.0]], [[x * (1.0 - y)], [0.0]]))
    });
    let all = run(&map, &[1.5], (1.2, 2.3), &[0.3, 0.3], Settings::default());
    assert_eq!(kinds(&all.branches[0]), [Kind::NeimarkSacker]);
    // At r = 2.02 starts from inside and from outside settle on the closed curve whose x is from 0.3596 to 0.6405.
    assert_eq!(all.branches[0].bifurcations[0].criticality, Some(Criticality::Supercritical));
    let at = &all.branches[0].bifurcations[0].point;
    assert_abs_diff_eq!(at.value, 2.0, epsilon = 1e-10);
    assert_abs_diff_eq!(at.multipliers[0].re, 0.5, epsilon = 1e-10);
    assert_abs_diff_eq!(at.multipliers[0].norm(), 1.0, epsilon = 1e-10);
}

/// z+ = exp(i) z (1 + p + c |z|^2): swings of the size sqrt(-p/c), which attract where c < 0.
#[test]
fn the_side_of_lasting_swings_is_told() {
    let map = Formula::new(|&[x, y], &[p, c]| {
        let (s, k) = 1.0_f64.sin_cos();
        let (turned, square) = ([k * x - s * y, s * x + k * y], x * x + y * y);
        let grow = 1.0 + p + c * square;
        let slope = |i: usize, z: f64, by: f64| by * grow + turned[i] * 2.0 * c * z;
        let rows = [[slope(0, x, k), slope(0, y, -s)], [slope(1, x, s), slope(1, y, k)]];
        let by_parameters = turned.map(|turned| [turned, turned * square]);
        Some((turned.map(|turned| turned * grow), rows, by_parameters))
    });
    for (c, side) in [(-1.0, Criticality::Supercritical), (0.5, Criticality::Subcritical)] {
        let all = run(&map, &[-0.1, c], (-0.2, 0.2), &[0.0, 0.0], Settings::default());
        let at = only(&all.branches[0], Kind::NeimarkSacker);
        assert_abs_diff_eq!(at.point.value, 0.0, epsilon = 1e-10);
        assert_eq!(at.criticality, Some(side));
    }
}

/// Two real multipliers whose product goes through 1 are no bifurcation.
#[test]
fn a_neutral_saddle_is_not_reported() {
    let map = Formula::new(|&[x, y], &[p]| Some(([p * x, 0.5 * y], [[p, 0.0], [0.0, 0.5]], [[x], [0.0]])));
    let all = run(&map, &[1.5], (1.2, 2.8), &[0.0, 0.0], Settings::default());
    assert_eq!(kinds(&all.branches[0]), []);
}

/// Multipliers that are always on the circle are no bifurcation either.
#[test]
fn neutral_directions_are_not_reported() {
    // A rotation by an angle, and a multiplier of -1.
    let map = Formula::new(|&[x, y, z], &[p]| {
        let (s, c) = p.sin_cos();
        let rows = [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, -1.0]];
        Some(([c * x - s * y, s * x + c * y, -z], rows, [[-s * x - c * y], [c * x - s * y], [0.0]]))
    });
    let all = run(&map, &[1.0], (0.5, 2.5), &[0.0, 0.0, 0.0], Settings::default());
    assert_eq!(kinds(&all.branches[0]), []);
}

/// Fixed points p = x^3 - x: folds at x = +-1/sqrt 3, p = -+2/(3 sqrt 3).
#[test]
fn an_s_curve_is_followed_around_both_folds() {
    let map = Formula::new(|&[x], &[p]| Some(([x + 0.1 * (p + x - x * x * x)], [[1.1 - 0.3 * x * x]], [[0.1]])));
    let all = run(&map, &[-1.0], (-1.0, 1.0), &[-1.3], Settings::default());
    let branch = &all.branches[0];
    assert_eq!(kinds(branch), [Kind::Fold, Kind::Fold]);
    let turn = 2.0 / (3.0 * 3.0_f64.sqrt());
    for (fold, sign) in branch.bifurcations.iter().zip([1.0, -1.0]) {
        assert_abs_diff_eq!(fold.point.value, sign * turn, epsilon = 1e-12);
        assert_abs_diff_eq!(fold.point.section[0], -sign / 3.0_f64.sqrt(), epsilon = 1e-9);
    }
    assert_eq!(branch.ends, [EndReason::RangeEnd(Side::Lower), EndReason::RangeEnd(Side::Upper)]);
    assert_eq!((branch.points[0].value, branch.points.last().unwrap().value), (-1.0, 1.0));
    let stable = |point: &gaitc_runtime::study::continuation::Point| point.stable();
    assert!(stable(&branch.points[0]) && stable(branch.points.last().unwrap()));
    assert!(branch.points.iter().any(|point| !stable(point)));
}

/// Fixed points on the circle (x - 2)^2 + p^2 = 1/4.
#[test]
fn an_isola_closes() {
    let map = Formula::new(|&[x], &[p]| {
        let u = x - 2.0;
        Some(([x + 0.5 * (u * u + p * p - 0.25)], [[1.0 + u]], [[p]]))
    });
    let all = run(&map, &[0.1], (-1.0, 1.0), &[1.5], Settings::default());
    let branch = &all.branches[0];
    assert_eq!(branch.ends, [EndReason::Closed, EndReason::Closed]);
    assert_eq!(branch.points.first().unwrap().section, branch.points.last().unwrap().section);
    let folds: Vec<f64> = branch.bifurcations.iter().filter(|b| b.kind == Kind::Fold).map(|b| b.point.value).collect();
    assert_eq!(folds.len(), 2);
    assert_abs_diff_eq!(folds[0] + folds[1], 0.0, epsilon = 1e-12);
    assert_abs_diff_eq!(folds[0].abs(), 0.5, epsilon = 1e-12);
}

/// x+ = x/2 + p/2 has no next section crossing from p = 1 on.
#[test]
fn where_the_map_stops_is_located() {
    let map = Formula::new(|&[x], &[p]| (p < 1.0).then_some(([0.5 * x + 0.5 * p], [[0.5]], [[0.5]])));
    let all = run(&map, &[0.2], (0.0, 3.0), &[0.2], Settings::default());
    let branch = &all.branches[0];
    let EndReason::MapStops(stop) = &branch.ends[1] else { panic!("{:?}", branch.ends) };
    assert_eq!(stop.reason, StopReason::NoEvent);
    let last = branch.points.last().unwrap().value;
    assert!(last < 1.0 && last > 1.0 - 2e-6, "{last}");
    assert_eq!(branch.ends[0], EndReason::RangeEnd(Side::Lower));
}

/// A subcritical flip: x+ = -(1 + p) x - x^3 has gaits of period 2 at p < 0.
#[test]
fn the_side_of_a_flip_is_told() {
    let map = Formula::new(|&[x], &[p]| Some(([-(1.0 + p) * x - x * x * x], [[-(1.0 + p) - 3.0 * x * x]], [[-x]])));
    let settings = Settings { doublings: 1, ..Settings::default() };
    let all = run(&map, &[0.1], (-0.3, 0.3), &[0.0], settings);
    let flip = only(&all.branches[0], Kind::Flip);
    assert_abs_diff_eq!(flip.point.value, 0.0, epsilon = 1e-12);
    assert_eq!(flip.criticality, Some(Criticality::Subcritical));
    // x^2 = -p.
    for point in &all.branches[1].points {
        assert_abs_diff_eq!(point.section[0].powi(2), -point.value, epsilon = 1e-9);
    }
}

/// x+ = -x (1 + p (1 - p) - x^2): a bubble of period 2 between the flips at 0 and 1.
#[test]
fn a_bubble_of_period_two_is_followed_once() {
    let map = Formula::new(|&[x], &[p]| {
        let m = 1.0 + p * (1.0 - p);
        Some(([-m * x + x * x * x], [[-m + 3.0 * x * x]], [[-(1.0 - 2.0 * p) * x]]))
    });
    let settings = Settings { doublings: 1, ..Settings::default() };
    let all = run(&map, &[-0.2], (-0.3, 1.3), &[0.0], settings);
    assert_eq!((kinds(&all.branches[0]), all.branches.len()), (vec![Kind::Flip, Kind::Flip], 2));
    let bubble = &all.branches[1];
    assert_eq!(bubble.ends, [EndReason::Parent, EndReason::PeriodHalved]);
    assert_abs_diff_eq!(bubble.points.last().unwrap().value, 1.0, epsilon = 1e-6);
    for point in &bubble.points {
        let p = point.value;
        assert_abs_diff_eq!(point.section[0].powi(2), p * (1.0 - p), epsilon = 1e-6);
    }
}

/// Two multipliers through -1 within a step: the determinant does not change sign, the count does.
#[test]
fn two_flips_in_one_step_are_told_apart() {
    let map = Formula::new(|&[x, y], &[p]| {
        Some(([-p * x, -(p - 0.004) * y], [[-p, 0.0], [0.0, -(p - 0.004)]], [[-x], [-y]]))
    });
    let all = run(&map, &[0.8], (0.5, 1.5), &[0.0, 0.0], Settings::default());
    let flips: Vec<f64> = all.branches[0].bifurcations.iter().map(|b| b.point.value).collect();
    assert_eq!(kinds(&all.branches[0])[..2], [Kind::Flip, Kind::Flip]);
    assert_abs_diff_eq!(flips[0], 1.0, epsilon = 1e-12);
    assert_abs_diff_eq!(flips[1], 1.004, epsilon = 1e-12);
}

/// The logistic map with x in a unit 1e5 times smaller, beside a coordinate 1e3 times smaller.
#[test]
fn units_do_not_matter() {
    let map = Formula::new(|&[x, y], &[r]| {
        let u = x * 1e-5;
        let (image, slope, by_r) = (r * u * (1.0 - u), r * (1.0 - 2.0 * u), u * (1.0 - u));
        let rows = [[slope, 0.0], [1e-8, 0.5]];
        Some(([image * 1e5, 0.5 * y + 1e-8 * x], rows, [[by_r * 1e5], [0.0]]))
    });
    let settings = Settings { doublings: 1, ..Settings::default() };
    let all = run(&map, &[2.5], (1.5, 3.5), &[0.6e5, 1e-3], settings);
    let one = run(&logistic(), &[2.5], (1.5, 3.5), &[0.6], Settings { doublings: 1, ..Settings::default() });
    for (scaled, plain) in all.branches.iter().zip(&one.branches) {
        assert_eq!(kinds(scaled), kinds(plain));
        let (scaled, plain) = (&only(scaled, Kind::Flip).point, &only(plain, Kind::Flip).point);
        assert_abs_diff_eq!(scaled.value, plain.value, epsilon = 1e-9);
    }
    assert_eq!(all.branches.len(), 2);
}

/// x+ = p + m (x - 1) with m = 1/2 below x = 1 and -3/2 above: at p = 1 the branch bends and its multiplier jumps over -1.
#[test]
fn a_corner_is_passed_and_is_no_flip() {
    let map = Formula::new(|&[x], &[p]| {
        let m = if x < 1.0 { 0.5 } else { -1.5 };
        Some(([p + m * (x - 1.0)], [[m]], [[1.0]]))
    });
    let all = run(&map, &[0.6], (0.2, 1.9), &[0.2], Settings::default());
    let branch = &all.branches[0];
    assert_eq!(kinds(branch), []);
    assert_eq!(branch.ends, [EndReason::RangeEnd(Side::Lower), EndReason::RangeEnd(Side::Upper)]);
    let change = branch.points.windows(2).find(|pair| pair[0].stable() && !pair[1].stable()).unwrap();
    assert!(change[0].value <= 1.0 && change[1].value >= 1.0 && change[1].value - change[0].value < 1e-5);
}

#[test]
fn what_cannot_be_followed_is_said() {
    let map = logistic();
    let none = |p: &[f64], range, guess: &[f64], parameter| {
        let request =
            ContinuationRequest { gait: GaitRequest::new(p, &[]), parameter, range, settings: Settings::default() };
        follow(&map, &request, guess)
    };
    assert_eq!(none(&[2.0], (1.0, 1.0), &[0.5], 0).unwrap_err().to_string().split(' ').next(), Some("the"));
    assert!(matches!(none(&[2.0], (2.5, 3.0), &[0.5], 0), Err(ContinuationError::Range { .. })));
    assert!(matches!(none(&[2.0], (f64::NAN, 3.0), &[0.5], 0), Err(ContinuationError::Range { .. })));
    assert!(matches!(none(&[2.0], (1.0, 3.0), &[0.5], 1), Err(ContinuationError::Parameter(1))));
    // x+ = x + 1 + p^2 has no fixed point.
    let map = Formula::new(|&[x], &[p]| Some(([x + 1.0 + p * p], [[1.0]], [[2.0 * p]])));
    let request = ContinuationRequest {
        gait: GaitRequest::new(&[0.5], &[]),
        parameter: 0,
        range: (0.0, 1.0),
        settings: Settings::default(),
    };
    assert!(matches!(follow(&map, &request, &[0.0]), Ok(ContinuationOutcome::NoStart(_))));
    // Every x is a fixed point: there is no direction to go.
    let map = Formula::new(|&[x], &[_]| Some(([x], [[1.0]], [[0.0]])));
    let all = run(&map, &[0.5], (0.0, 1.0), &[0.3], Settings::default());
    assert_eq!(all.branches[0].ends, [EndReason::NoDirection, EndReason::NoDirection]);
}

#[test]
fn limits_and_interrupts_end_a_branch() {
    let limited = run(&logistic(), &[2.5], (1.5, 3.5), &[0.6], Settings { point_limit: 4, ..Settings::default() });
    assert_eq!(limited.branches[0].ends, [EndReason::PointLimit, EndReason::PointLimit]);
    assert_eq!(limited.branches[0].points.len(), 7);
    let interrupt = Interrupt::new();
    interrupt.request();
    let stopped = run(&logistic(), &[2.5], (1.5, 3.5), &[0.6], Settings { interrupt, ..Settings::default() });
    assert_eq!(stopped.branches[0].ends, [EndReason::Interrupted, EndReason::Interrupted]);
    assert_eq!(stopped.branches[0].points.len(), 1);
}
