//! The return map as a loop: embed, flow and transitions until the section's transition, symmetry, coordinates.
//!
//! P = symmetry o R o embed, composed `period` times; derivatives are carried through all of it as columns.

use super::functionals::{Variation, Varied, along, observe};
use super::passing::Place;
use super::run::Run;
use crate::event::{Found, Side, Watched, read, selectors};
use crate::integrate::{Carried, Method};
use crate::model::{Model, Section};
use crate::return_map::{MapRequest, StopReason};
use crate::scalar::filled;
use crate::sensitivity::through;

/// Section coordinates, the first d of N, and their variations.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coordinates<const N: usize, const C: usize> {
    /// Values.
    pub(crate) z: [f64; N],
    /// Variations, one array a column.
    pub(crate) dz: [[f64; N]; C],
}

/// Where a map has led.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reached<const N: usize, const C: usize> {
    /// The coordinates.
    pub(crate) at: Coordinates<N, C>,
    /// The full state at its start ...
    pub(crate) first: [f64; N],
    /// ... and at its end, symmetry applied.
    pub(crate) end: [f64; N],
}

impl<X, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>
    Run<'_, X, M, R, N, P, Q, W, C>
where
    X: Method,
    M: Model<N, P, Q>,
    R: Carried<M, N, P, Q, W, C>,
{
    /// Runs the whole map from the section coordinates `at`; returns where it ends.
    pub(crate) fn map(
        &mut self,
        request: &MapRequest<'_>,
        section: Section,
        mut at: Coordinates<N, C>,
    ) -> Result<Reached<N, C>, StopReason> {
        let (mut first, mut end) = ([0.0; N], [0.0; N]);
        for turn in 0..request.period {
            self.embed(&at);
            if turn == 0 {
                first = self.step.start.x;
            }
            self.segment.memory.clear();
            self.segment.memory.extend_from_slice(request.memory);
            self.step.tau = 0.0;
            self.fired.clear();
            self.leave(section);
            self.deadline = self.segment.start + self.accuracy.time_limit;
            self.check_finite()?;
            if let Some(record) = &mut self.record {
                record.turn();
            }
            self.begin(turn == 0 && request.measures)?;
            self.note_leg();
            self.run_to_section(section.transition(), turn + 1 == request.period && request.measures)?;
            (at, end) = self.project();
        }
        Ok(Reached { at, first, end })
    }

    /// Enters the mode in which the map begins; from a section before a transition by that transition's reset.
    pub(crate) fn leave(&mut self, section: Section) {
        let Some(transition) = M::INFO.transitions.get(section.transition()) else {
            self.segment.mode = usize::MAX;
            return;
        };
        if let Section::Before(i) = section {
            self.ahead = Some(i);
            self.segment.mode = transition.from;
            self.reset_at_once(i);
        }
        self.segment.mode = transition.to;
    }

    /// Makes a transition where the run is, at its beginning. Such a reset does not depend on tau (the front end sees to
    /// that), and the section does not move in time.
    fn reset_at_once(&mut self, i: usize) {
        let x = self.step.start.x;
        let switches = M::INFO.modes.get(self.segment.mode).map_or(&[][..], |mode| mode.switches);
        if !switches.is_empty() {
            self.segment.branch = selectors::by_sign::<M, N, P, Q>(self.segment.frame(), switches, 0.0, &x);
        }
        let reset = M::reset_jacobian(i, &x, &self.segment.env(0.0));
        let mut memory = self.segment.memory.clone();
        M::reset(i, &x, &self.segment.env(0.0), &mut memory);
        for c in 0..C {
            let dx = self.step.start.dx[c];
            self.step.start.dx[c] = through(&reset, &dx, &self.segment.dp[c], self.segment.dstart[c], 0.0);
        }
        self.step.start.x = reset.value;
        self.segment.memory = memory;
    }

    /// Starts the segment that follows the start of a map or a transition.
    pub(crate) fn begin(&mut self, record: bool) -> Result<(), StopReason> {
        self.enter(None)?;
        self.note_begin();
        let place =
            Place { dx: self.step.start.dx, dk: self.step.start_rates.dx, dtau: [0.0; C], dt: self.segment.dstart };
        self.observe_boundary(&place);
        if record {
            let (segment, x) = (&self.segment, (&self.step.start.x, &self.step.start_rates.x));
            self.functionals.record_start(M::INFO, |o| {
                observe::<M, N, P, Q, C>(o, segment.mode, x, &segment.env(0.0), |g, c| {
                    along(
                        g,
                        Variation {
                            dx: &place.dx[c],
                            dk: &place.dk[c],
                            dp: &segment.dp[c],
                            dtau: 0.0,
                            dt: place.dt[c],
                        },
                    )
                })
            });
        }
        Ok(())
    }

    pub(crate) fn run_to_section(&mut self, section: usize, record: bool) -> Result<(), StopReason> {
        loop {
            self.advance()?;
            let found = self.first_events();
            let Some(first) = found.first() else {
                self.complete_step()?;
                if let Some(record) = &mut self.record {
                    record.step(self.step.h, self.error, &self.watched);
                }
                self.move_on();
                continue;
            };
            self.land(first)?;
            self.note_end(first.h, &found);
            self.note_arrival();
            let last = record && self.fires(first.watched, section);
            let passed = self.pass(&found, last)?;
            self.note_passed(passed.is_some());
            match passed {
                Some(transition) if transition == section => return Ok(()),
                Some(_) => self.begin(false)?,
                None => {}
            }
            self.note_leg();
        }
    }

    fn note_leg(&mut self) {
        if let Some(record) = &mut self.record {
            record.leg(self.segment.mode, self.step.tau, &self.segment.memory, &self.segment.branch, &self.watched);
        }
    }

    fn note_end(&mut self, h: f64, found: &[Found]) {
        let Some(record) = &mut self.record else {
            return;
        };
        let (x, k, env) = (&self.step.end.x, &self.step.end_rates.x, self.segment.env(self.step.tau + self.step.h));
        let side = |w: &Watched| {
            let reading = read::<M, N, P, Q>(w.surface, x, k, &env);
            if reading.value.abs() > reading.rounding { Side::of(reading.value) } else { Side::Unknown }
        };
        let sides: Vec<Side> = self.watched.iter().map(side).collect();
        let passed: Vec<usize> = found.iter().map(|f| f.watched).collect();
        record.end(h, &self.watched, &sides, &passed);
    }

    fn fires(&self, watched: usize, section: usize) -> bool {
        self.watched.get(watched).is_some_and(|w| w.surface == crate::event::Surface::Transition(section))
    }

    pub(crate) fn embed(&mut self, at: &Coordinates<N, C>) {
        let z = at.z.get(..M::INFO.coordinates.len()).unwrap_or(&[]);
        let y = &mut self.step.start;
        y.x = M::embed(z, self.segment.p);
        if C == 0 {
            return;
        }
        let mut by_z = [[0.0; N]; N];
        let by_p = M::embed_jacobian(z, self.segment.p, by_z.get_mut(..z.len()).unwrap_or(&mut []));
        for c in 0..C {
            for i in 0..N {
                let mut sum = 0.0;
                for j in 0..z.len() {
                    sum += by_z[j][i] * at.dz[c][j];
                }
                for j in 0..P {
                    sum += by_p[j][i] * self.segment.dp[c][j];
                }
                y.dx[c][i] = sum;
            }
        }
    }

    /// Applies the symmetry to the state on the section and takes its coordinates; that state, too.
    fn project(&self) -> (Coordinates<N, C>, [f64; N]) {
        let (mut x, mut dx) = match self.ahead {
            Some(_) => self.on_section,
            None => (self.step.start.x, self.step.start.dx),
        };
        if M::INFO.symmetric {
            let s = M::symmetry_jacobian(&x, self.segment.p);
            let before = dx;
            x = s.value;
            for c in 0..C {
                for i in 0..N {
                    let mut sum = 0.0;
                    for j in 0..N {
                        sum += s.dx[j][i] * before[c][j];
                    }
                    for j in 0..P {
                        sum += s.dp[j][i] * self.segment.dp[c][j];
                    }
                    dx[c][i] = sum;
                }
            }
        }
        let mut result = Coordinates { z: [0.0; N], dz: [[0.0; N]; C] };
        for (k, &i) in M::INFO.coordinates.iter().enumerate().filter(|(k, i)| *k < N && **i < N) {
            result.z[k] = x[i];
            for c in 0..C {
                result.dz[c][k] = dx[c][i];
            }
        }
        (result, x)
    }

    /// All functionals, at the end of the map.
    pub(crate) fn functionals(&self) -> Vec<Varied<C>> {
        let y = &self.step.start;
        let integral = |k: usize| {
            let value = y.q.get(k).copied().unwrap_or(f64::NAN);
            Varied { value, gradient: filled(0.0, |c| y.dq[c].get(k).copied().unwrap_or(f64::NAN)) }
        };
        self.functionals.finish(M::INFO, integral, self.duration())
    }

    /// Duration of the map so far, at an event.
    pub(crate) fn duration(&self) -> Varied<C> {
        Varied { value: self.segment.start, gradient: self.segment.dstart }
    }
}
