//! Trajectories of small models against closed forms and return maps; every way in which a run can end.

use super::common::auto::{Auto, Equations, c};
use super::common::climbers::{BLANK, quantity};
use super::common::toys::{BALL, CHATTER, DIP, DOMAIN, FALLING, FORCED, JUMP, PILING, TWINS, WHEEL};
use super::common::{completed, request, stopped};
use super::trajectory::{follow, from_section};
use approx::assert_abs_diff_eq;
use gaitc_runtime::hybrid::Hybrid;
use gaitc_runtime::model::{Direction, Env, ModeInfo, ModelInfo, TransitionInfo};
use gaitc_runtime::return_map::{
    Accuracy, MapRequest, Method, RequestError, ReturnMap, Sensitivity, StopReason, Warning,
};
use gaitc_runtime::scalar::Scalar;
use gaitc_runtime::trajectory::{FollowRequest, MOST_VALUES, Sampling, Start, Until};

#[test]
fn a_bouncing_ball_has_its_closed_form() {
    let (g, e, v) = (9.81, 0.8, 3.0);
    let (z, p) = ([v], [g, e]);
    let sampling = Sampling::Interval(0.01);
    let all = follow(&BALL, &FollowRequest { sampling, ..from_section(&z, &p, &[], 4) });
    assert_eq!((all.stop, all.method, all.events.len(), all.segments.len()), (None, Method::Explicit, 4, 4));
    let (mut start, mut speed) = (0.0, v);
    for (i, event) in all.events.iter().enumerate() {
        for sample in all.samples.iter().filter(|s| s.segment == i) {
            let s = sample.t - start;
            assert_abs_diff_eq!(sample.tau, s, epsilon = 1e-13);
            assert_abs_diff_eq!(sample.state[0], speed * s - 0.5 * g * s * s, epsilon = 1e-13);
            assert_abs_diff_eq!(sample.state[1], speed - g * s, epsilon = 1e-12);
            assert_eq!(sample.rate, [sample.state[1], -g]);
        }
        start += 2.0 * speed / g;
        assert_abs_diff_eq!(event.time, start, epsilon = 1e-13);
        assert_abs_diff_eq!(event.transversality, -speed, epsilon = 1e-13);
        assert_abs_diff_eq!(event.before[1], -speed, epsilon = 1e-13);
        speed *= e;
        assert_abs_diff_eq!(event.after[1], speed, epsilon = 1e-13);
        assert_eq!(event.after[0], 0.0);
    }
    assert_abs_diff_eq!(all.time, start, epsilon = 1e-13);
    assert_eq!(all.end, all.events[3].after);
    // The multiples of the interval, and both sides of every impact but the last, which the run ends with.
    let grid = (all.time / 0.01).floor() as usize;
    assert_eq!(all.samples.len(), 1 + grid + 3 * 2 + 1);
    for k in 1..=grid {
        let t = k as f64 * 0.01;
        assert!(all.samples.t.iter().any(|s| (s - t).abs() < 1e-15), "{t}");
    }
}

/// Where there is no symmetry, and the embedding loses nothing, following is the map over and over again.
#[test]
fn following_is_the_map_composed() {
    let ball = (&BALL as &dyn ReturnMap, &[3.0][..], &[9.81, 0.8][..], &[][..]);
    let wheel = (&WHEEL as &dyn ReturnMap, &[1.6][..], &[9.81, 0.3, 0.08, 0.7][..], &[][..]);
    let jump = (&JUMP as &dyn ReturnMap, &[0.05, 0.2][..], &[0.4, -0.7, 0.5][..], &[][..]);
    for (map, z, p, memory) in [ball, wheel, jump] {
        for method in [Method::Explicit, Method::Radau5] {
            let accuracy = Accuracy { method, ..Accuracy::default() };
            let maps = MapRequest { period: 5, memory, accuracy, ..request(z, p, Sensitivity::None) };
            let expected = completed(map, &maps);
            let all = follow(map, &FollowRequest { accuracy, ..from_section(z, p, memory, 5) });
            assert_eq!((all.stop, all.method), (None, method));
            for (a, b) in all.end.iter().zip(&expected.end) {
                assert_abs_diff_eq!(*a, *b, epsilon = 1e-12);
            }
            assert_abs_diff_eq!(all.time, expected.duration, epsilon = 1e-12);
            assert_eq!(all.start, expected.state.as_slice());
            for (event, known) in all.events.iter().zip(&expected.events) {
                assert_eq!(event.transition, known.transition);
                assert_abs_diff_eq!(event.time, known.time, epsilon = 1e-12);
                assert_abs_diff_eq!(event.transversality, known.transversality, epsilon = 1e-11);
            }
        }
    }
}

/// A section before its transition: that is made at once, in every map again, and memory goes on counting.
#[test]
fn a_run_may_begin_before_a_transition() {
    let (z, p, memory) = ([-3.0], [9.81, 0.8], [0.0]);
    let all = follow(&FALLING, &from_section(&z, &p, &memory, 2));
    assert_eq!(all.start, [0.0, -3.0]);
    assert_abs_diff_eq!(all.samples.get(0).unwrap().state[1], 2.4, epsilon = 1e-15);
    let map = completed(&FALLING, &MapRequest { memory: &memory, ..request(&z, &p, Sensitivity::None) });
    assert_abs_diff_eq!(all.events[0].before[1], map.coordinates[0], epsilon = 1e-13);
    // The second impact multiplies the speed with n = 2, which a map would have put back to 1.
    let memories: Vec<f64> = all.segments.iter().map(|s| s.memory[0]).collect();
    assert_eq!(memories, [1.0, 2.0]);
    assert_abs_diff_eq!(all.events[0].after[1], 2.0 * 0.8 * 2.4, epsilon = 1e-13);
}

/// Models whose equations use t have no gaits, but they move.
#[test]
fn explicit_time_goes_on() {
    let (z, p, memory) = ([0.35, 0.8], [0.5, 1.7, 0.3, 0.9], [0.0]);
    let map = completed(&FORCED, &MapRequest { memory: &memory, ..request(&z, &p, Sensitivity::None) });
    let all = follow(&FORCED, &from_section(&z, &p, &memory, 1));
    assert_eq!(all.events.len(), 2);
    for (a, b) in all.end.iter().zip(&map.end) {
        assert_abs_diff_eq!(*a, *b, epsilon = 1e-12);
    }
    for s in all.samples.iter() {
        let forced = p[0] * (p[1] * s.t).cos() - s.state[0];
        assert_eq!(s.rate[0], s.state[1]);
        assert_abs_diff_eq!(s.rate[1], forced, epsilon = 1e-14);
    }
    let dip = follow(&DIP, &FollowRequest { until: Until::Time(0.5), ..from_section(&[0.0], &[-0.1], &[], 1) });
    assert_eq!((dip.stop, dip.time), (None, 0.5));
    for s in dip.samples.iter() {
        assert_abs_diff_eq!(s.state[0], (s.t - 1.0).powi(2) + 0.1, epsilon = 1e-14);
    }
}

/// At a switch the rate jumps: there are samples on both of its sides.
#[test]
fn rates_jump_at_switches() {
    let all = follow(&JUMP, &from_section(&[0.05, 0.2], &[0.4, -0.7, 0.5], &[], 1));
    let at = (0.5 + 0.02 - 0.05) / (1.0 - 0.04);
    let sides: Vec<f64> = all.samples.iter().filter(|s| (s.t - at).abs() < 1e-12).map(|s| s.rate[1]).collect();
    assert_eq!(sides, [0.4, -0.7]);
    assert_eq!(all.segments.len(), 1);
}

/// Times end a run in the middle of a flight, at an impact, and after several.
#[test]
fn a_time_ends_a_run() {
    let (g, p) = (9.81, [9.81, 0.8]);
    for time in [0.1, 6.0 / g, 1.9] {
        let request = FollowRequest { until: Until::Time(time), ..from_section(&[3.0], &p, &[], 1) };
        let all = follow(&BALL, &request);
        assert_eq!((all.stop, all.time), (None, time));
        assert_eq!(all.samples.t.last(), Some(&time));
        let inside =
            all.samples.iter().filter(|s| (s.t * 50.0 / time - (s.t * 50.0 / time).round()).abs() < 1e-9).count();
        assert!(inside >= 50, "{inside}");
    }
}

/// Where samples are does not change the motion, and neither does where it is to end.
#[test]
fn sampling_changes_nothing() {
    for method in [Method::Explicit, Method::Radau5] {
        let accuracy = Accuracy { method, ..Accuracy::default() };
        let base = FollowRequest { accuracy, ..from_section(&[1.6], &[9.81, 0.3, 0.08, 0.7], &[], 3) };
        let few = follow(&WHEEL, &FollowRequest { sampling: Sampling::Count(1), ..base });
        let many = follow(&WHEEL, &FollowRequest { sampling: Sampling::Interval(1e-3), ..base });
        assert!(many.samples.len() > 10 * few.samples.len());
        assert_eq!((few.time, &few.end, few.statistics), (many.time, &many.end, many.statistics));
        assert_eq!(few.events, many.events);
    }
}

#[test]
fn a_run_that_stops_keeps_what_was_before() {
    let piling = from_section(&[3.0], &[9.81, 0.5], &[], 1);
    let zeno = follow(&PILING, &piling);
    let stop = stopped(&PILING, &request(&[3.0], &[9.81, 0.5], Sensitivity::None));
    assert_eq!((zeno.stop, stop.reason), (Some(StopReason::Zeno), StopReason::Zeno));
    assert_abs_diff_eq!(zeno.time, 6.0 / 9.81 / 0.5, epsilon = 1e-8);
    assert!(zeno.events.len() > 20);
    for (i, event) in zeno.events.iter().take(10).enumerate() {
        assert_abs_diff_eq!(event.after[1], 3.0 * 0.5_f64.powi(i as i32 + 1), epsilon = 1e-10);
    }

    let accuracy = Accuracy { time_limit: 5.0, ..Accuracy::default() };
    let slow = follow(&WHEEL, &FollowRequest { accuracy, ..from_section(&[0.2], &[9.81, 0.3, 0.08, 0.7], &[], 2) });
    assert_eq!((slow.stop, slow.samples.t.last()), (Some(StopReason::NoEvent), Some(&5.0)));
    assert!(slow.samples.len() >= 50);

    let accuracy = Accuracy { step_limit: 3, ..Accuracy::default() };
    let short = follow(&WHEEL, &FollowRequest { accuracy, ..from_section(&[1.6], &[9.81, 0.3, 0.08, 0.7], &[], 2) });
    assert_eq!((short.stop, short.statistics.steps + short.statistics.rejected), (Some(StopReason::StepLimit), 3));

    let edge = follow(&DOMAIN, &from_section(&[1.0], &[-1.0], &[], 1));
    assert_eq!(edge.stop, Some(StopReason::NotFinite));
    let last = edge.samples.get(edge.samples.len() - 1).unwrap();
    assert!(last.t == edge.time && last.state[0] < 1e-6 && last.state == edge.end, "{last:?}");

    let chatter = follow(&CHATTER, &from_section(&[1.0], &[], &[], 1));
    assert_eq!(chatter.stop, Some(StopReason::Zeno));
    assert_abs_diff_eq!(chatter.time, 1.0, epsilon = 1e-9);
}

#[test]
fn warnings_are_those_of_the_map() {
    let ties = follow(&TWINS, &from_section(&[0.1], &[0.0], &[], 1));
    assert!(matches!(ties.warnings[..], [Warning::Tie { taken: 1, other: 2, .. }]), "{:?}", ties.warnings);
    let touch = follow(&DIP, &from_section(&[0.0], &[0.0], &[], 1));
    assert!(matches!(touch.warnings[..], [Warning::Grazing { transition: 1, .. }]), "{:?}", touch.warnings);
}

/// Grows until it is 2 and then goes on in the other mode, at once below the square root's domain: x' = 1, x' = sqrt(-x).
#[derive(Clone, Copy, Debug, Default)]
struct Adrift;

static ADRIFT: Hybrid<Auto<Adrift>, 1, 0, 0> = Hybrid::new();

impl Equations<1, 0, 0> for Adrift {
    const INFO: &'static ModelInfo = &ModelInfo {
        name: "adrift",
        states: &[quantity("x")],
        modes: &[
            ModeInfo { name: "grows", switches: &[], measured_switches: &[] },
            ModeInfo { name: "undefined", switches: &[], measured_switches: &[] },
        ],
        transitions: &[TransitionInfo { name: "over", from: 0, to: 1, direction: Direction::Rising, also_zero: &[] }],
        section: None,
        ..BLANK
    };
    fn flow<S: Scalar>(mode: usize, x: &[S; 1], _: &Env<'_, S, 0>) -> [S; 1] {
        [if mode == 0 { c(1.0) } else { (-x[0]).sqrt() }]
    }
    fn guard<S: Scalar>(_: usize, x: &[S; 1], _: &Env<'_, S, 0>) -> S {
        x[0] - c(2.0)
    }
    fn reset<S: Scalar>(_: usize, x: &[S; 1], _: &Env<'_, S, 0>, _: &mut [S]) -> [S; 1] {
        *x
    }
    fn embed<S: Scalar>(_: &[S], _: &[S; 0]) -> [S; 1] {
        [c(f64::NAN)]
    }
}

/// Without a section, from a state in a mode; it stops where a segment is to begin.
#[test]
fn a_model_without_a_section_can_be_followed() {
    let start = Start::State { mode: 0, state: &[0.5], tau: 0.0 };
    let base = FollowRequest { start, until: Until::Time(1.0), ..from_section(&[], &[], &[], 1) };
    let all = follow(&ADRIFT, &base);
    assert_eq!((all.stop, all.time), (None, 1.0));
    assert_abs_diff_eq!(all.end[0], 1.5, epsilon = 1e-14);
    let all = follow(&ADRIFT, &FollowRequest { until: Until::Time(4.0), ..base });
    assert_eq!((all.stop, all.events.len(), all.segments.len()), (Some(StopReason::NotFinite), 1, 2));
    let last = all.samples.get(all.samples.len() - 1).unwrap();
    assert_eq!((last.segment, last.tau, last.t), (1, 0.0, all.time));
    assert!(last.rate[0].is_nan());
    let crossings = FollowRequest { until: Until::Crossings(1), ..base };
    assert_eq!(ADRIFT.follow(&crossings).unwrap_err(), RequestError::NoSection("adrift"));
    let section = FollowRequest { start: Start::Section(&[]), ..base };
    assert_eq!(ADRIFT.follow(&section).unwrap_err(), RequestError::NoSection("adrift"));
}

#[test]
fn wrong_requests_are_errors() {
    let (z, p) = ([3.0], [9.81, 0.8]);
    let base = from_section(&z, &p, &[], 2);
    let state = |state, mode, tau| FollowRequest { start: Start::State { mode, state, tau }, ..base };
    let until = |until| FollowRequest { until, ..base };
    let sampling = |sampling| FollowRequest { sampling, ..base };
    let accuracy = Accuracy { relative: f64::NAN, ..Accuracy::default() };
    let wrong = [
        from_section(&[], &p, &[], 1),
        from_section(&[f64::NAN], &p, &[], 1),
        from_section(&z, &p[..1], &[], 1),
        from_section(&z, &p, &[1.0], 1),
        state(&[0.0], 0, 0.0),
        state(&[0.0, f64::INFINITY], 0, 0.0),
        state(&[0.0, 1.0], 1, 0.0),
        state(&[0.0, 1.0], 0, f64::NAN),
        state(&[0.0, 1.0], 0, -1.0),
        until(Until::Crossings(0)),
        until(Until::Time(0.0)),
        until(Until::Time(f64::NAN)),
        until(Until::Time(f64::INFINITY)),
        sampling(Sampling::Count(0)),
        sampling(Sampling::Interval(0.0)),
        sampling(Sampling::Interval(f64::NAN)),
        sampling(Sampling::Interval(-1.0)),
        FollowRequest { accuracy, ..base },
    ];
    for request in wrong {
        BALL.follow(&request).unwrap_err();
    }
    let radau3 = Accuracy { method: Method::Radau3, ..Accuracy::default() };
    let error = BALL.follow(&FollowRequest { accuracy: radau3, ..base }).unwrap_err();
    assert_eq!(error, RequestError::NoMassMatrix("ball"));
}

/// Too much is refused: before the run where that can be known, else when there is no more room.
#[test]
fn a_trajectory_has_a_largest_size() {
    let base = from_section(&[3.0], &[9.81, 0.8], &[], 2);
    let refused = |request: FollowRequest<'_>| match BALL.follow(&request).unwrap_err() {
        RequestError::TooManyValues { limit: MOST_VALUES, time } => time,
        other => panic!("{other:?}"),
    };
    refused(FollowRequest { sampling: Sampling::Count(usize::MAX), ..base });
    let until = Until::Time(1.0);
    let time = refused(FollowRequest { sampling: Sampling::Interval(1e-7), until, ..base });
    assert_abs_diff_eq!(time, MOST_VALUES as f64 / 7.0 * 1e-7, epsilon = 1e-6);
    let time = refused(FollowRequest { sampling: Sampling::Interval(1e-300), ..base });
    assert!(time < 0.7, "{time}");
}
