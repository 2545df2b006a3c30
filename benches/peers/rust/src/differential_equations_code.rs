//! The crate differential-equations: DOP853 on state and variations as one system of static size; implicit methods for unit c.
//!
//! Its events are roots of the interpolant, whose order does not match the method's. So unit b finds the event there and then takes
//! Newton's step on the solution itself: from the start of the step to the time found, and once more over what misses.

use crate::Failure;
use crate::climber::{Crank, Swing, landed};
use crate::measure::{Attempt, tolerances};
use crate::unit::Unit;
use differential_equations::control::ControlFlag;
use differential_equations::interpolate::Interpolation;
use differential_equations::linalg::Matrix;
use differential_equations::methods::{DiagonallyImplicitRungeKutta, ExplicitRungeKutta, ImplicitRungeKutta};
use differential_equations::ode::{ODE, OrdinaryNumericalMethod, solve_ode};
use differential_equations::solout::Solout;
use differential_equations::solution::Solution;
use std::f64::consts::PI;

/// Added to m r_1^2 (kg m^2), so that the equation can be divided by it; with more the methods miss the error.
const FLOOR: f64 = 1e-12;

pub fn attempts(unit: &Unit) -> Result<Vec<Attempt>, Failure> {
    let start = unit.start.clone();
    let attempt = |configuration: &str, build| {
        Ok(vec![Attempt { configuration: configuration.to_owned(), settings: tolerances(), units: 1, build }])
    };
    match &unit.key[..] {
        "a" => {
            let swing = Swing::of(unit)?;
            attempt(
                "DOP853, static size",
                Box::new(move |tolerance| {
                    let begin = [start[0], start[1], 1.0, 0.0, 0.0, 1.0];
                    let flow = Flow { swing, shortening: true };
                    Box::new(move || Ok(swing.landed(&run(&flow, tolerance, swing.shortened(), begin, None)?)))
                }),
            )
        }
        "b" => {
            let swing = Swing::of(unit)?;
            attempt(
                "DOP853, static size; event on the interpolant, Newton's step by hand",
                Box::new(move |tolerance| {
                    let begin = [swing.psi, start[0], 0.0, 1.0];
                    Box::new(move || switched(swing, tolerance, begin))
                }),
            )
        }
        _ => {
            let crank = Crank::of(unit)?;
            let begin = [crank.idle, start[0], start[1], 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
            let methods: [(&str, Cranked); 2] = [("Kvaerno 5(4)", by_kvaerno), ("Radau5", by_radau)];
            let attempts = methods.into_iter().map(|(name, work)| Attempt {
                configuration: format!("{name}, over the crank angle, analytic Jacobian"),
                settings: tolerances(),
                units: 1,
                build: Box::new(move |tolerance| Box::new(move || work(crank, tolerance, begin))),
            });
            Ok(attempts.collect())
        }
    }
}

/// Units a and b: the leg shortens, or is short.
struct Flow {
    swing: Swing,
    shortening: bool,
}

impl<const N: usize> ODE<f64, [f64; N]> for Flow {
    fn diff(&self, tau: f64, y: &[f64; N], dy: &mut [f64; N]) {
        let leg = if self.shortening { self.swing.leg(tau) } else { [self.swing.short, 0.0] };
        self.swing.field(leg, y, dy);
    }
}

/// Keeps the last state and nothing else.
struct Last<Y>(Y);

impl<Y: differential_equations::traits::State<f64>> Solout<f64, Y> for Last<Y> {
    fn solout<I: Interpolation<f64, Y> + ?Sized>(
        &mut self,
        _: f64,
        _: f64,
        now: &Y,
        _: &Y,
        _: &mut I,
        _: &mut Solution<f64, Y>,
    ) -> ControlFlag<f64, Y> {
        self.0 = now.clone();
        ControlFlag::Continue
    }
}

/// Stops after the step in which q falls through psi.
struct Crossing {
    psi: f64,
    /// Where that step begins: time and state.
    before: (f64, [f64; 4]),
    /// When q = psi on its interpolant.
    time: Option<f64>,
}

impl Solout<f64, [f64; 4]> for Crossing {
    fn solout<I: Interpolation<f64, [f64; 4]> + ?Sized>(
        &mut self,
        now: f64,
        before: f64,
        y: &[f64; 4],
        y_before: &[f64; 4],
        interpolant: &mut I,
        _: &mut Solution<f64, [f64; 4]>,
    ) -> ControlFlag<f64, [f64; 4]> {
        if y[0] > self.psi || y_before[0] <= self.psi {
            return ControlFlag::Continue;
        }
        // Secants, which converge since q is smooth and monotonic here.
        let (mut a, mut b) = ((before, y_before[0] - self.psi), (now, y[0] - self.psi));
        for _ in 0..8 {
            let time = b.0 - b.1 * (b.0 - a.0) / (b.1 - a.1);
            let Ok(between) = interpolant.interpolate(time) else { break };
            (a, b) = (b, (time, between[0] - self.psi));
            if (b.0 - a.0).abs() < 1e-7 {
                break;
            }
        }
        self.before = (before, *y_before);
        self.time = Some(b.0);
        ControlFlag::Terminate
    }
}

/// The state after a time; `first` is the first step's size, if not the method's own choice.
fn run<const N: usize>(
    flow: &Flow,
    tolerance: f64,
    time: f64,
    begin: [f64; N],
    first: Option<f64>,
) -> Result<[f64; N], String> {
    let mut method = ExplicitRungeKutta::dop853().rtol(tolerance).atol(0.1 * tolerance);
    if let Some(step) = first {
        method = method.h0(step);
    }
    let mut last = Last(begin);
    solve_ode(&mut method, flow, 0.0, time, &begin, &mut last).map_err(|error| format!("{error:?}"))?;
    Ok(last.0)
}

fn switched(swing: Swing, tolerance: f64, begin: [f64; 4]) -> Result<Vec<f64>, String> {
    let middle = run(&Flow { swing, shortening: true }, tolerance, swing.shortened(), begin, None)?;
    let flow = Flow { swing, shortening: false };
    let mut method = ExplicitRungeKutta::dop853().rtol(tolerance).atol(0.1 * tolerance);
    let mut crossing = Crossing { psi: swing.psi, before: (0.0, middle), time: None };
    solve_ode(&mut method, &flow, 0.0, 2.0, &middle, &mut crossing).map_err(|error| format!("{error:?}"))?;
    let time = crossing.time.ok_or("no event")?;
    let (from, state) = crossing.before;
    let mut state = run(&flow, tolerance, time - from, state, Some(time - from))?;
    let miss = (swing.psi - state[0]) * swing.short / state[1];
    if miss.abs() > 1e-14 {
        state = run(&flow, tolerance, miss, state, Some(miss))?;
    }
    Ok(swing.switched(&state))
}

/// Unit c, state and two variations.
impl ODE<f64, [f64; 9]> for Crank {
    fn diff(&self, phi: f64, y: &[f64; 9], dy: &mut [f64; 9]) {
        let r_1 = self.legs(phi)[1];
        let mass = self.mass * r_1 * r_1 + FLOOR;
        self.field(phi, &y[..3], &mut dy[..3]);
        self.variation(phi, &y[..3], &y[3..6], &mut dy[3..6]);
        self.variation(phi, &y[..3], &y[6..], &mut dy[6..]);
        for i in [0, 3, 6] {
            dy[i] /= mass;
        }
    }

    /// That of the state, repeated for the variations: what it lacks only slows Newton's method.
    fn jacobian(&self, phi: f64, y: &[f64; 9], matrix: &mut Matrix<f64>) {
        let r_1 = self.legs(phi)[1];
        let mass = self.mass * r_1 * r_1 + FLOOR;
        for j in 0..3 {
            let (mut direction, mut column) = ([0.0; 3], [0.0; 3]);
            direction[j] = 1.0;
            self.variation(phi, &y[..3], &direction, &mut column);
            column[0] /= mass;
            for block in [0, 3, 6] {
                for i in 0..3 {
                    matrix[(block + i, block + j)] = column[i];
                }
            }
        }
    }
}

/// Unit c by a method: from the machine, a tolerance and the start to the result.
type Cranked = fn(Crank, f64, [f64; 9]) -> Result<Vec<f64>, String>;

fn by_kvaerno(crank: Crank, tolerance: f64, begin: [f64; 9]) -> Result<Vec<f64>, String> {
    let method = DiagonallyImplicitRungeKutta::kvaerno745();
    cranked(crank, method.rtol(tolerance).atol(0.1 * tolerance).max_steps(100_000), begin)
}

fn by_radau(crank: Crank, tolerance: f64, begin: [f64; 9]) -> Result<Vec<f64>, String> {
    cranked(crank, ImplicitRungeKutta::radau5().rtol(tolerance).atol(0.1 * tolerance), begin)
}

fn cranked<M>(crank: Crank, mut method: M, begin: [f64; 9]) -> Result<Vec<f64>, String>
where
    M: OrdinaryNumericalMethod<f64, [f64; 9]> + Interpolation<f64, [f64; 9]>,
{
    let mut last = Last(begin);
    solve_ode(&mut method, &crank, 0.0, PI, &begin, &mut last).map_err(|error| format!("{error:?}"))?;
    let y = last.0;
    Ok(landed(crank.psi, &y[1..3], &y[4..6], &y[7..9]))
}
