//! Gauss collocation on a fixed grid against the methods that it is there to confirm, and against itself.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failing test should say where

mod common;

use common::climbers::{M_A, M_L};
use common::crank::{M_S, parameters};
use common::toys::{BALL, FALLING};
use common::{climbers, completed, request};
use gaitc_runtime::return_map::{MapRequest, MapResult, ReturnMap, Sensitivity};

fn stretches(map: &MapResult) -> Vec<f64> {
    let times: Vec<f64> = map.events.iter().map(|event| event.time).collect();
    times.iter().enumerate().map(|(i, t)| t - if i == 0 { 0.0 } else { times[i - 1] }).collect()
}

/// By how much the two routes differ, for each number of steps; `None` where collocation finds nothing.
fn deviations(map: &dyn ReturnMap, ask: &MapRequest<'_>, steps: &[usize]) -> Vec<Option<f64>> {
    let reference = completed(map, ask);
    let stretches = stretches(&reference);
    let one = |steps: &usize| Some((map.collocate(ask, &stretches, *steps).unwrap()? - &reference.coordinates).amax());
    steps.iter().map(one).collect()
}

fn agree(map: &dyn ReturnMap, ask: &MapRequest<'_>) {
    let found = deviations(map, ask, &[24])[0].expect("collocation reaches the section");
    assert!(found <= 1e-11, "{}: {found:e}", map.info().name);
}

#[test]
fn smooth_switched_and_composed_maps_agree() {
    let (p, none) = (climbers::parameters(20.0), Sensitivity::None);
    // A switch of the flow at the same time as the guard, ...
    agree(&M_L, &MapRequest { memory: &[0.0], ..request(&[-0.35, -0.25], &p, none) });
    // ... a switch before it, and a guard that starts at zero, ...
    agree(&M_A, &request(&[0.8], &climbers::parameters(8.0), none));
    // ... several maps in a row, and a section before a transition.
    agree(&BALL, &MapRequest { period: 3, ..request(&[3.0], &[9.81, 0.8], none) });
    agree(&FALLING, &MapRequest { memory: &[0.0], period: 2, ..request(&[-3.0], &[9.81, 0.8], none) });
}

#[test]
fn it_passes_dead_centres_where_the_mass_matrix_vanishes() {
    for gear in [100.0, 56.57, 30.0] {
        let p = parameters(gear, 58.0, 20.0);
        let found = deviations(&M_S, &request(&[-0.35, -0.2], &p, Sensitivity::None), &[8, 36]);
        let (coarse, fine) = (found[0].unwrap(), found[1].unwrap());
        assert!(fine <= 1e-11, "{gear}: {fine:e}");
        // The difference is that of the grid, not of the equations.
        assert!(coarse >= fine || coarse <= 1e-11, "{gear}: {coarse:e} {fine:e}");
    }
}

#[test]
fn it_says_when_it_cannot() {
    // At this gear the crank is driven far beyond the motor's speed just before the dead centre.
    let p = parameters(15.0, 58.0, 20.0);
    assert_eq!(deviations(&M_S, &request(&[-0.35, -0.2], &p, Sensitivity::None), &[8]), [None]);
    // More transitions than were expected.
    let ask = MapRequest { period: 2, ..request(&[3.0], &[9.81, 0.8], Sensitivity::None) };
    assert_eq!(BALL.collocate(&ask, &[0.6], 24).unwrap(), None);
    // A stretch that lasts far longer.
    let ask = request(&[3.0], &[9.81, 0.8], Sensitivity::None);
    assert_eq!(BALL.collocate(&ask, &[0.001], 24).unwrap(), None);
    assert!(BALL.collocate(&MapRequest { parameters: &[1.0], ..ask }, &[0.6], 24).is_err());
}
