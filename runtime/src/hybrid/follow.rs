//! Follows a run of the real machine: see [`crate::trajectory`].
//!
//! The runs are those of the return map, with a trace: the explicit method without columns; an implicit one as it runs where
//! measures take rates, on steps that are short enough for rates, its columns unused. Nothing else is compiled.

use super::functionals::Functionals;
use super::map::Coordinates;
use super::request::{accuracy, values};
use super::run::Run;
use crate::event::{Reading, Side, Surface, Watched};
use crate::integrate::{self, Bare, Carried, Explicit, Radau, Whole};
use crate::model::{Direction, Model, ModelInfo};
use crate::return_map::{Method, RequestError, StopReason};
use crate::trajectory::trace::Trace;
use crate::trajectory::{Beyond, FollowRequest, MOST_VALUES, Sampling, Start, Trajectory, Until};

/// How a pass ended.
enum Followed {
    /// With a trajectory; whether its run is stiff.
    Run(Box<Trajectory>, bool),
    /// At this time, with more values than there is room for.
    Full(f64),
}

/// Follows the run of a request.
pub(super) fn follow<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    request: &FollowRequest<'_>,
) -> Result<Trajectory, RequestError> {
    check(M::INFO, request)?;
    let mut p = [0.0; P];
    p.copy_from_slice(request.parameters);
    let mut method = match request.accuracy.method {
        Method::Automatic if M::INFO.explicit => Method::Explicit,
        Method::Automatic => Method::Radau5,
        method => method,
    };
    let interval = match (request.sampling, request.until) {
        (Sampling::Interval(interval), _) => interval,
        (Sampling::Count(count), Until::Time(time)) => time / count as f64,
        // How long it takes is known when it has been there once.
        (Sampling::Count(count), Until::Crossings(_)) => {
            let first = run_by::<M, N, P, Q>(request, &p, f64::INFINITY, &mut method)?;
            if first.time > 0.0 { first.time / count as f64 } else { f64::INFINITY }
        }
    };
    run_by::<M, N, P, Q>(request, &p, interval, &mut method)
}

/// One pass by `method`, or by the implicit one where it turns out to be stiff.
fn run_by<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    request: &FollowRequest<'_>,
    p: &[f64; P],
    interval: f64,
    method: &mut Method,
) -> Result<Trajectory, RequestError> {
    let pass = |method| match method {
        Method::Explicit | Method::Automatic => {
            explicit::<M, N, P, Q>(request, p, interval).ok_or(RequestError::NoExplicitFlow(M::INFO.name))
        }
        Method::Radau5 => Ok(run::<Radau<5>, M, Whole, N, P, Q, Q, 8>(request, p, interval)),
        Method::Radau3 => radau3::<M, N, P, Q>(request, p, interval).ok_or(RequestError::NoMassMatrix(M::INFO.name)),
    };
    let mut followed = pass(*method)?;
    if request.accuracy.method == Method::Automatic
        && let Followed::Run(_, true) = followed
    {
        *method = Method::Radau5;
        followed = pass(*method)?;
    }
    match followed {
        Followed::Run(trajectory, _) => Ok(*trajectory),
        Followed::Full(time) => Err(RequestError::TooManyValues { limit: MOST_VALUES, time }),
    }
}

fn explicit<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    request: &FollowRequest<'_>,
    p: &[f64; P],
    interval: f64,
) -> Option<Followed> {
    if const { M::INFO.explicit } { Some(run::<Explicit, M, Bare, N, P, Q, 0, 0>(request, p, interval)) } else { None }
}

fn radau3<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    request: &FollowRequest<'_>,
    p: &[f64; P],
    interval: f64,
) -> Option<Followed> {
    if const { M::INFO.explicit } { None } else { Some(run::<Radau<3>, M, Whole, N, P, Q, Q, 8>(request, p, interval)) }
}

/// One pass, whatever it ends with.
fn run<X, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>(
    request: &FollowRequest<'_>,
    p: &[f64; P],
    interval: f64,
) -> Followed
where
    X: integrate::Method,
    M: Model<N, P, Q>,
    R: Carried<M, N, P, Q, W, C>,
{
    let mut accuracy = request.accuracy;
    if let Until::Time(time) = request.until {
        accuracy.time_limit = time;
    }
    let functionals = Functionals::new(M::INFO, false);
    let mut run = Run::<X, M, R, N, P, Q, W, C>::new(accuracy, p, ([[0.0; P]; C], 0), functionals);
    run.trace = Some(Box::new(Trace::new(N, interval)));
    let start = run.put_at_start(request);
    let ended = run.go(request.until);
    run.into_followed(start, ended)
}

impl<X, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>
    Run<'_, X, M, R, N, P, Q, W, C>
where
    X: integrate::Method,
    M: Model<N, P, Q>,
    R: Carried<M, N, P, Q, W, C>,
{
    /// Puts the run at its start; returns the state there.
    fn put_at_start(&mut self, request: &FollowRequest<'_>) -> [f64; N] {
        self.segment.memory.extend_from_slice(request.memory);
        match request.start {
            Start::Section(coordinates) => {
                let mut at = Coordinates { z: [0.0; N], dz: [[0.0; N]; C] };
                at.z[..coordinates.len()].copy_from_slice(coordinates);
                self.embed(&at);
                let start = self.step.start.x;
                if let Some(section) = M::INFO.section {
                    self.leave(section);
                }
                start
            }
            Start::State { mode, state, tau } => {
                self.segment.mode = mode;
                self.segment.start = -tau;
                self.step.tau = tau;
                self.step.start.x.copy_from_slice(state);
                self.step.start.x
            }
        }
    }

    /// Goes as far as asked, from crossing to crossing of the section, where there is one.
    fn go(&mut self, until: Until) -> Result<(), StopReason> {
        let section = M::INFO.section.map_or(usize::MAX, |section| section.transition());
        let (time_limit, step_limit) = (self.accuracy.time_limit, self.accuracy.step_limit);
        let mut crossings = 0;
        self.check_finite()?;
        self.begin(false)?;
        self.note_beyond();
        loop {
            if until == Until::Crossings(crossings) {
                return Ok(());
            }
            if crossings > 0 {
                self.begin(false)?;
            }
            self.deadline = match until {
                Until::Crossings(_) => self.segment.start + time_limit,
                Until::Time(time) => time,
            };
            self.accuracy.step_limit = (self.statistics.steps + self.statistics.rejected).saturating_add(step_limit);
            match self.run_to_section(section, false) {
                Ok(()) => crossings += 1,
                // The time that was asked for is over.
                Err(StopReason::NoEvent) if matches!(until, Until::Time(_)) => return Ok(()),
                Err(reason) => return Err(reason),
            }
        }
    }

    /// Notes the guards on whose far side the run starts.
    fn note_beyond(&mut self) {
        let far = |w: &Watched| match w.direction {
            Direction::Falling => w.side == Side::Negative,
            Direction::Rising => w.side == Side::Positive,
            Direction::Either => false,
        };
        let beyond = self.watched.iter().filter(|w| far(w)).filter_map(|w| {
            let Surface::Transition(transition) = w.surface else { return None };
            let Reading { value, rate, rounding, .. } = w.start;
            Some(Beyond { transition, value, rate, at_zero: value.abs() <= rounding })
        });
        if let Some(trace) = &mut self.trace {
            trace.beyond = beyond.collect();
        }
    }

    /// What the trace has become.
    fn into_followed(mut self, start: [f64; N], ended: Result<(), StopReason>) -> Followed {
        let (time, stiff) = (self.time(), self.stiff());
        self.note_end_of_run(ended.is_err());
        let Some(trace) = self.trace.take().filter(|trace| !trace.full) else {
            return Followed::Full(time);
        };
        let trajectory = Trajectory {
            start: start.to_vec(),
            segments: trace.segments,
            samples: trace.samples,
            events: trace.events,
            time,
            end: self.step.start.x.to_vec(),
            stop: ended.err(),
            statistics: self.statistics,
            method: X::KIND,
            warnings: self.warnings,
            beyond: trace.beyond,
        };
        Followed::Run(Box::new(trajectory), stiff)
    }
}

/// Whether the request fits the model and makes sense.
fn check(info: &'static ModelInfo, request: &FollowRequest<'_>) -> Result<(), RequestError> {
    values("parameters", request.parameters, info.parameters.len())?;
    values("memory", request.memory, info.memory.len())?;
    accuracy(&request.accuracy)?;
    let crossings = matches!(request.until, Until::Crossings(_));
    if info.section.is_none() && (crossings || matches!(request.start, Start::Section(_))) {
        return Err(RequestError::NoSection(info.name));
    }
    match request.start {
        Start::Section(coordinates) => values("section coordinates", coordinates, info.coordinates.len())?,
        Start::State { mode, .. } if mode >= info.modes.len() => {
            let what = "the mode of the start (counted from 0) is out of range: number of modes";
            return Err(RequestError::Length { what, expected: info.modes.len(), got: mode });
        }
        Start::State { state, tau, .. } => {
            values("states at the start", state, info.states.len())?;
            // Written so that NaN fails.
            if !(tau >= 0.0 && tau.is_finite()) {
                return Err(RequestError::Follow("`tau` at the start must be at least 0 and finite, e.g. 0 s"));
            }
        }
    }
    extent(info, request)
}

/// How far to go and how densely to sample.
fn extent(info: &'static ModelInfo, request: &FollowRequest<'_>) -> Result<(), RequestError> {
    match request.until {
        Until::Crossings(0) => return Err(RequestError::Follow("the number of section crossings must be at least 1")),
        Until::Time(time) if !(time > 0.0 && time.is_finite()) => {
            return Err(RequestError::Follow("the time to follow the run for must be positive and finite, e.g. 1 s"));
        }
        _ => {}
    }
    let (count, interval) = match (request.sampling, request.until) {
        (Sampling::Count(0), _) => return Err(RequestError::Follow("the number of samples must be at least 1")),
        (Sampling::Interval(interval), _) if !(interval > 0.0 && interval.is_finite()) => {
            return Err(RequestError::Follow("the time between samples must be positive and finite, e.g. 1 ms"));
        }
        (Sampling::Count(count), Until::Time(time)) => (count as f64, time / count as f64),
        (Sampling::Count(count), Until::Crossings(_)) => (count as f64, 0.0),
        (Sampling::Interval(interval), Until::Time(time)) => (time / interval, interval),
        // How long that takes is not known.
        (Sampling::Interval(_), Until::Crossings(_)) => return Ok(()),
    };
    let most = (MOST_VALUES / (2 * info.states.len() + 3)) as f64;
    if count > most {
        return Err(RequestError::TooManyValues { limit: MOST_VALUES, time: most * interval });
    }
    Ok(())
}
