//! diffsol: an explicit method of order 5 on state and variations as one system for units a and b; BDF with forward sensitivities for
//! unit c, over the crank angle, with the mass matrix that is singular at both dead centres.
//!
//! Each problem is set up once; its interface makes a solver for every map.

use crate::Failure;
use crate::climber::{Crank, Swing, landed};
use crate::measure::{Attempt, Call, tolerances};
use crate::unit::Unit;
use diffsol::{
    NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations, OdeSolverMethod, OdeSolverStopReason, Vector,
};
use std::f64::consts::PI;

type Matrix = NalgebraMat<f64>;

pub fn attempts(unit: &Unit) -> Result<Vec<Attempt>, Failure> {
    let start = unit.start.clone();
    let (configuration, build): (&str, Box<dyn Fn(f64) -> Call>) = match &unit.key[..] {
        "a" => {
            let swing = Swing::of(unit)?;
            ("tsit45", Box::new(move |tolerance| prescribed(swing, tolerance, &start)))
        }
        "b" => {
            let swing = Swing::of(unit)?;
            ("tsit45, root function", Box::new(move |tolerance| switched(swing, tolerance, &start)))
        }
        _ => {
            let crank = Crank::of(unit)?;
            (
                "BDF, forward sensitivities, over the crank angle, singular mass matrix",
                Box::new(move |tolerance| cranked(crank, tolerance, &start)),
            )
        }
    };
    Ok(vec![Attempt { configuration: configuration.to_owned(), settings: tolerances(), units: 1, build }])
}

/// A call that only says why it cannot.
fn broken(error: diffsol::error::DiffsolError) -> Call {
    let message = error.to_string();
    Box::new(move || Err(message.clone()))
}

fn prescribed(swing: Swing, tolerance: f64, start: &[f64]) -> Call {
    let begin = [start[0], start[1], 1.0, 0.0, 0.0, 1.0];
    let built = OdeBuilder::<Matrix>::new()
        .rtol(tolerance)
        .atol([0.1 * tolerance; 6])
        .rhs(move |y, _p, tau, dy| swing.field(swing.leg(tau), y, dy))
        .init(move |_p, _tau, y| y.copy_from_slice(&begin), 6)
        .build();
    let problem = match built {
        Ok(problem) => problem,
        Err(error) => return broken(error),
    };
    Box::new(move || {
        let work = || {
            let mut solver = problem.tsit45()?;
            solver.set_stop_time(swing.shortened())?;
            while !matches!(solver.step()?, OdeSolverStopReason::TstopReached) {}
            Ok(swing.landed(solver.state().y.batch_as_slice(0)))
        };
        work().map_err(|error: diffsol::error::DiffsolError| error.to_string())
    })
}

fn switched(swing: Swing, tolerance: f64, start: &[f64]) -> Call {
    let begin = [swing.psi, start[0], 0.0, 1.0];
    let first = OdeBuilder::<Matrix>::new()
        .rtol(tolerance)
        .atol([0.1 * tolerance; 4])
        .rhs(move |y, _p, tau, dy| swing.field(swing.leg(tau), y, dy))
        .init(move |_p, _tau, y| y.copy_from_slice(&begin), 4)
        .build();
    // The second problem starts where the first one ended: its start is its parameters.
    let second = OdeBuilder::<Matrix>::new()
        .rtol(tolerance)
        .atol([0.1 * tolerance; 4])
        .p(begin)
        .rhs(move |y, _p, _tau, dy| swing.field([swing.short, 0.0], y, dy))
        .init(move |p, _tau, y| y.copy_from_slice(p), 4)
        .root(move |y, _p, _tau, out| out[0] = y[0] - swing.psi, 1)
        .build();
    let (first, mut second) = match (first, second) {
        (Ok(first), Ok(second)) => (first, second),
        (Err(error), _) | (_, Err(error)) => return broken(error),
    };
    Box::new(move || {
        let mut work = || {
            let mut solver = first.tsit45()?;
            solver.set_stop_time(swing.shortened())?;
            while !matches!(solver.step()?, OdeSolverStopReason::TstopReached) {}
            let context = *second.context();
            second.eqn_mut().set_params(&NalgebraVec::from_vec(solver.state().y.batch_as_slice(0).to_vec(), context));
            let mut solver = second.tsit45()?;
            loop {
                if let OdeSolverStopReason::RootFound(time, _) = solver.step()? {
                    return Ok(swing.switched(solver.interpolate(time)?.batch_as_slice(0)));
                }
            }
        };
        work().map_err(|error: diffsol::error::DiffsolError| error.to_string())
    })
}

fn cranked(crank: Crank, tolerance: f64, start: &[f64]) -> Call {
    let built = OdeBuilder::<Matrix>::new()
        .p([start[0], start[1]])
        .rtol(tolerance)
        .atol([0.1 * tolerance; 3])
        .rhs_sens_implicit(
            move |u, _p, phi, du| crank.field(phi, u, du),
            move |u, _p, phi, v, du| crank.variation(phi, u, v, du),
            |_u, _p, _phi, _v, du| du.fill(0.0),
        )
        .mass(move |v, _p, phi, beta, u| {
            let slope = crank.legs(phi)[1];
            for i in 0..3 {
                let mass = if i == 0 { crank.mass * slope * slope } else { 1.0 };
                u[i] = mass * v[i] + beta * u[i];
            }
        })
        .init_sens(
            move |p, _phi, u| u.copy_from_slice(&[crank.idle, p[0], p[1]]),
            |_p, _phi, v, u| u.copy_from_slice(&[0.0, v[0], v[1]]),
            3,
        )
        .build();
    let problem = match built {
        Ok(problem) => problem,
        Err(error) => return broken(error),
    };
    Box::new(move || {
        let work = || {
            let mut solver = problem.bdf_sens::<NalgebraLU<f64>>()?;
            solver.set_stop_time(PI)?;
            while !matches!(solver.step()?, OdeSolverStopReason::TstopReached) {}
            let state = solver.state();
            let (u, s) = (state.y.batch_as_slice(0), state.s.clone_as_vec());
            Ok(landed(crank.psi, &u[1..3], &s[1..3], &s[4..6]))
        };
        work().map_err(|error: diffsol::error::DiffsolError| error.to_string())
    })
}
