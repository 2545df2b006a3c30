//! The crank-slider climber through both dead centres.

mod common;

use common::crank::{M_S, parameters};
use common::{completed, request};
use gaitc_runtime::orbit::{GaitRequest, GaitStatus, find_gait};
use gaitc_runtime::return_map::{Accuracy, Method, Sensitivity};

#[test]
fn look() {
    for gear in [100.0, 56.57, 30.0, 20.0, 15.0] {
        for relative in [1e-8, 1e-10, 1e-12, 1e-14] {
            let p = parameters(gear, 58.0, 20.0);
            let accuracy = Accuracy { relative, absolute: 0.1 * relative, ..Accuracy::default() };
            let mut r = GaitRequest::new(&p, &[]);
            r.accuracy = accuracy;
            r.tolerance = 1e-7;
            let g = find_gait(&M_S, &r, &[-0.35, -0.2]).unwrap();
            match g.status {
                GaitStatus::Converged => {
                    let g2 = g.gait.unwrap();
                    println!("{gear} {relative:e} z {:?} T {} mult {:?} {:?}\n    m {:?}", g2.coordinates.as_slice(), g2.map.duration, g2.multipliers, g2.map.statistics, g2.map.measures.as_slice());
                }
                s => println!("{gear} {relative:e} {s:?} {}", g.message),
            }
        }
    }
    let _ = (completed, request as fn(&'static [f64], &'static [f64], Sensitivity<'static>) -> _, Method::Radau5);
}
