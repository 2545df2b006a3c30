//! The crank-slider climber through both dead centres.

mod common;

use common::crank::{M_S, parameters};
use common::{completed, request};
use gaitc_runtime::orbit::{GaitRequest, GaitStatus, find_gait};
use gaitc_runtime::return_map::{Accuracy, Method, Sensitivity};

#[test]
fn speed() {
    for (gear, z) in [
        (56.57, [-0.35483045011757147, -0.22945737650612175]),
        (20.0, [-0.35072315146268473, -0.1356027431413089]),
        (100.0, [-0.36838388412811873, -0.4189017647826953]),
    ] {
        for relative in [1e-6, 1e-8, 1e-10, 1e-12] {
            let p = parameters(gear, 58.0, 20.0);
            let accuracy = Accuracy { relative, absolute: 0.1 * relative, ..Accuracy::default() };
            for (measures, s) in
                [(false, Sensitivity::Coordinates), (true, Sensitivity::CoordinatesAndParameters(&[7, 8, 9]))]
            {
                let mut r = request(&z, &p, s);
                r.accuracy = accuracy;
                r.measures = measures;
                let m = completed(&M_S, &r);
                let n = 200;
                let t = std::time::Instant::now();
                for _ in 0..n {
                    std::hint::black_box(completed(&M_S, &r));
                }
                let us = t.elapsed().as_secs_f64() / n as f64 * 1e6;
                println!(
                    "{gear} {relative:e} {measures} {us:.1} us, error {:e} {:e} {:?}",
                    m.coordinates[0] - z[0],
                    m.coordinates[1] - z[1],
                    m.statistics
                );
            }
        }
    }
}

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
                    println!(
                        "{gear} {relative:e} z {:?} T {} mult {:?} {:?}\n    m {:?}",
                        g2.coordinates.as_slice(),
                        g2.map.duration,
                        g2.multipliers,
                        g2.map.statistics,
                        g2.map.measures.as_slice()
                    );
                }
                s => println!("{gear} {relative:e} {s:?} {}", g.message),
            }
        }
    }
    let _ = (completed, request as fn(&'static [f64], &'static [f64], Sensitivity<'static>) -> _, Method::Radau5);
}
