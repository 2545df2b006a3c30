//! Runs to follow and what is true of all of them. The tests stand with those of the same models, which are compiled once.

#![allow(dead_code, clippy::unwrap_used)] // each test file uses a part of this; a failed expectation is a failed test

use gaitc_runtime::return_map::{Accuracy, ReturnMap};
use gaitc_runtime::trajectory::{FollowRequest, Sample, Sampling, Start, Trajectory, Until};

/// From the section, through so many crossings, 50 samples.
pub(crate) fn from_section<'a>(z: &'a [f64], p: &'a [f64], memory: &'a [f64], crossings: usize) -> FollowRequest<'a> {
    FollowRequest {
        start: Start::Section(z),
        parameters: p,
        memory,
        until: Until::Crossings(crossings),
        sampling: Sampling::Count(50),
        accuracy: Accuracy::default(),
    }
}

/// The trajectory, whole in itself.
pub(crate) fn follow(map: &dyn ReturnMap, request: &FollowRequest<'_>) -> Trajectory {
    let all = map.follow(request).unwrap();
    let samples = &all.samples;
    assert!(samples.t.is_sorted(), "{:?}", samples.t);
    assert!(samples.segment.is_sorted());
    let starts = all.segments.iter().enumerate();
    for (i, segment) in starts {
        let first = samples.iter().find(|s| s.segment == i).unwrap();
        assert_eq!((first.t, first.tau), (segment.t, segment.tau), "segment {i}");
    }
    for (event, next) in all.events.iter().zip(all.segments.iter().skip(1)) {
        assert_eq!((event.time, &event.memory), (next.t, &next.memory));
    }
    all
}

/// Largest difference of states and of rates at the common times of two runs, each relative to the largest value of its component.
pub(crate) fn differences(a: &Trajectory, b: &Trajectory) -> (f64, f64) {
    let n = a.end.len();
    let mut common = 0;
    let (mut worst, mut size) = (vec![(0.0_f64, 0.0_f64); n], vec![(1.0_f64, 1.0_f64); n]);
    for x in a.samples.iter() {
        let near = |y: &Sample<'_>| (y.t - x.t).abs() < 1e-13 && y.segment == x.segment;
        let Some(y) = b.samples.iter().find(near) else {
            continue;
        };
        common += 1;
        for i in 0..n {
            worst[i].0 = worst[i].0.max((x.state[i] - y.state[i]).abs());
            worst[i].1 = worst[i].1.max((x.rate[i] - y.rate[i]).abs());
            size[i] = (size[i].0.max(x.state[i].abs()), size[i].1.max(x.rate[i].abs()));
        }
    }
    assert!(common > 50, "{common}");
    let largest =
        |pick: &dyn Fn(&(f64, f64)) -> f64| worst.iter().zip(&size).map(|(w, s)| pick(w) / pick(s)).fold(0.0, f64::max);
    (largest(&|v| v.0), largest(&|v| v.1))
}
