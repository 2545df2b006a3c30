//! From section to section on a fixed grid: stretches between transitions, each of so many equal steps, and events by
//! bracketing the size of the step in which a function changes its sign.

use super::gauss::Gauss;
use super::stages::Frame;
use crate::model::{Direction, Model, Section};

/// Steps beyond the expected end of a stretch, relative to those up to it.
const PATIENCE: usize = 2;
/// Values below this part of that at the end of the first step are zero: the function starts on its surface.
const ON_SURFACE: f64 = 1e-9;
/// Most bracketing steps to an event.
const BRACKETINGS: usize = 60;
/// An event is located to this part of a step.
const LOCATED: f64 = 1e-15;
/// Events closer together than this part of a step are at the same time; transitions then go first.
const TOGETHER: f64 = 1e-9;
/// Most stretches and switches of one map.
const MOST_EVENTS: usize = 200;

/// A function of the state whose zero is an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Surface {
    Guard(usize),
    Switch(usize),
}

/// An event within a step: what is passed, when after the step's start, and the state there.
struct Passed<const N: usize> {
    surface: Surface,
    at: f64,
    x: [f64; N],
}

/// A step that cannot be solved.
struct Unsolved;

struct Course<'p, M, const N: usize, const P: usize, const Q: usize> {
    gauss: Gauss,
    frame: Frame<'p, N, P>,
    model: core::marker::PhantomData<M>,
}

/// Section coordinates after `period` maps; `stretches` are the expected times between transitions, each cut into `steps`
/// steps. `None` where a step cannot be solved or an expected transition does not come.
pub(crate) fn image<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    section: Section,
    (coordinates, p): (&[f64], &[f64; P]),
    (memory, period): (&[f64], usize),
    (stretches, steps): (&[f64], usize),
) -> Option<Vec<f64>> {
    let mut z = coordinates.to_vec();
    let mut stretches = stretches.iter();
    let frame = Frame {
        p,
        mode: 0,
        memory: Vec::new(),
        branch: vec![false; M::INFO.switches.len()],
        start: 0.0,
        tau: 0.0,
        x: [0.0; N],
    };
    let mut course = Course::<M, N, P, Q> { gauss: Gauss::new(), frame, model: core::marker::PhantomData };
    for _ in 0..period {
        course.frame.x = M::embed(&z, p);
        course.frame.memory = memory.to_vec();
        course.frame.tau = 0.0;
        course.leave(section)?;
        let on_section = loop {
            let (transition, before) = course.stretch(&grid(*stretches.next()?, steps))?;
            if transition == section.transition() {
                break if matches!(section, Section::Before(_)) { before } else { course.frame.x };
            }
        };
        let x = M::symmetry(&on_section, p);
        z = M::INFO.coordinates.iter().filter_map(|i| x.get(*i).copied()).collect();
    }
    z.iter().all(|v| v.is_finite()).then_some(z)
}

/// Sizes of the steps of a stretch that takes about a given time: finer towards both ends, where mass matrices may be
/// singular. The last one goes beyond the expected end by as much again.
fn grid(time: f64, steps: usize) -> Vec<f64> {
    let at = |i: usize| 0.5 * time * (1.0 - (core::f64::consts::PI * i as f64 / steps as f64).cos());
    let size = |i: usize| (at(i + 1) - at(i)) * if i + 1 == steps { 2.0 } else { 1.0 };
    (0..steps).map(size).collect()
}

impl<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize> Course<'_, M, N, P, Q> {
    /// The mode in which a map begins; a section before a transition begins with its reset.
    fn leave(&mut self, section: Section) -> Option<()> {
        let transition = M::INFO.transitions.get(section.transition())?;
        if let Section::Before(i) = section {
            self.frame.mode = transition.from;
            self.select(|course, x, i| course.switch(i, x, 0.0) >= 0.0);
            self.reset(i);
        }
        self.frame.mode = transition.to;
        Some(())
    }

    /// Makes a transition where the frame is.
    fn reset(&mut self, transition: usize) {
        let mut memory = self.frame.memory.clone();
        self.frame.x = M::reset(transition, &self.frame.x, &self.frame.env(0.0), &mut memory);
        self.frame.memory = memory;
    }

    /// Steps of these sizes, the last one repeated, up to the next transition, which is made; which it was, and the state before
    /// it.
    fn stretch(&mut self, sizes: &[f64]) -> Option<(usize, [f64; N])> {
        let size_of = |step: usize| sizes.get(step).or(sizes.last()).copied();
        self.choose_branch(size_of(0)?)?;
        let surfaces = self.surfaces();
        let mut signs: Vec<Option<bool>> = surfaces.iter().map(|_| None).collect();
        let (mut taken, mut events, mut size) = (0, 0, size_of(0)?);
        while taken < PATIENCE * sizes.len() && events < MOST_EVENTS {
            let end = self.frame.step::<M, Q>(&self.gauss, size)?;
            let Some(Passed { surface, at, x }) = self.first(&surfaces, &mut signs, size, &end).ok()? else {
                (self.frame.x, self.frame.tau) = (end, self.frame.tau + size);
                taken += 1;
                size = size_of(taken)?;
                continue;
            };
            events += 1;
            (self.frame.x, self.frame.tau) = (x, self.frame.tau + at);
            match surface {
                Surface::Guard(i) => {
                    self.reset(i);
                    self.frame.start += self.frame.tau;
                    self.frame.tau = 0.0;
                    self.frame.mode = M::INFO.transitions.get(i)?.to;
                    return Some((i, x));
                }
                // The rest of the step, under the other selector.
                Surface::Switch(i) => {
                    let branch = self.frame.branch.get_mut(i)?;
                    *branch = !*branch;
                    size -= at;
                    if size <= TOGETHER * size_of(taken)? {
                        taken += 1;
                        size = size_of(taken)?;
                    }
                }
            }
        }
        None
    }

    fn surfaces(&self) -> Vec<Surface> {
        let guards = M::INFO.transitions.iter().enumerate().filter(|(_, t)| t.from == self.frame.mode);
        guards.map(|(i, _)| Surface::Guard(i)).chain(self.switches().iter().map(|i| Surface::Switch(*i))).collect()
    }

    fn switches(&self) -> &'static [usize] {
        M::INFO.modes.get(self.frame.mode).map_or(&[], |mode| mode.switches)
    }

    fn switch(&self, i: usize, x: &[f64; N], h: f64) -> f64 {
        M::switch(i, x, &self.frame.env(h))
    }

    fn value(&self, surface: Surface, x: &[f64; N], h: f64) -> f64 {
        match surface {
            Surface::Guard(i) => M::guard(i, x, &self.frame.env(h)),
            Surface::Switch(i) => self.switch(i, x, h),
        }
    }

    /// Sets all selectors of the mode at the frame's state, as often as they may depend on each other.
    fn select(&mut self, selected: impl Fn(&Self, &[f64; N], usize) -> bool) {
        let x = self.frame.x;
        for _ in 0..=self.switches().len() {
            for &i in self.switches() {
                let value = selected(self, &x, i);
                if let Some(slot) = self.frame.branch.get_mut(i) {
                    *slot = value;
                }
            }
        }
    }

    /// The selectors at the start of a stretch: a function that is zero there takes the side to which a short step leads.
    fn choose_branch(&mut self, h: f64) -> Option<()> {
        self.select(|course, x, i| course.switch(i, x, 0.0) >= 0.0);
        for &i in self.switches() {
            let ahead = 0.01 * h;
            let x = self.frame.step::<M, Q>(&self.gauss, ahead)?;
            let (now, then) = (self.switch(i, &self.frame.x, 0.0), self.switch(i, &x, ahead));
            if now.abs() <= ON_SURFACE * then.abs()
                && let Some(slot) = self.frame.branch.get_mut(i)
            {
                *slot = then >= 0.0;
            }
        }
        Some(())
    }

    /// The first event within a step of size `h` that ends at `end`. `signs` are those at the start; without an event they
    /// become those at the end.
    fn first(
        &self,
        surfaces: &[Surface],
        signs: &mut [Option<bool>],
        h: f64,
        end: &[f64; N],
    ) -> Result<Option<Passed<N>>, Unsolved> {
        let mut found: Option<Passed<N>> = None;
        let mut after = signs.to_vec();
        for (k, &surface) in surfaces.iter().enumerate() {
            let (before, value) = (self.value(surface, &self.frame.x, 0.0), self.value(surface, end, h));
            let positive = match signs[k] {
                Some(positive) => positive,
                // On the surface: it leaves to the side on which the step ends.
                None if before.abs() <= ON_SURFACE * value.abs() => value >= 0.0,
                None => before >= 0.0,
            };
            after[k] = Some(if value == 0.0 { !positive } else { value > 0.0 });
            if after[k] == Some(positive) || !counts::<M, N, P, Q>(surface, positive) {
                continue;
            }
            let (at, x) = self.locate(surface, positive, h).ok_or(Unsolved)?;
            let enabled = match surface {
                Surface::Guard(i) => M::when(i, &x, &self.frame.env(at)) >= 0.0,
                Surface::Switch(_) => true,
            };
            if enabled && found.as_ref().is_none_or(|known| at < known.at - TOGETHER * h) {
                found = Some(Passed { surface, at, x });
            }
        }
        for (k, surface) in surfaces.iter().enumerate() {
            // What is passed later than the event is looked at again from there on.
            if found.as_ref().is_none_or(|found| found.surface == *surface) {
                signs[k] = after[k];
            }
        }
        Ok(found)
    }

    /// Where a function changes its sign within a step of size `h`, by the Illinois method on the size of the step.
    fn locate(&self, surface: Surface, positive: bool, h: f64) -> Option<(f64, [f64; N])> {
        let state = |at: f64| self.frame.step::<M, Q>(&self.gauss, at);
        let value = |at: f64, x: &[f64; N]| {
            let value = self.value(surface, x, at);
            if positive { value } else { -value }
        };
        let (mut a, mut b) = (0.0, h);
        let mut x = state(h)?;
        // A start on the surface counts as being on its side.
        let (mut at_a, mut at_b) = (value(0.0, &self.frame.x).max(f64::MIN_POSITIVE), value(h, &x));
        for _ in 0..BRACKETINGS {
            if (b - a).abs() <= LOCATED * h || at_b == 0.0 {
                break;
            }
            let secant = (a * at_b - b * at_a) / (at_b - at_a);
            let middle =
                if secant.is_finite() && secant > a.min(b) && secant < a.max(b) { secant } else { 0.5 * (a + b) };
            if middle == b || middle == a {
                break;
            }
            x = state(middle)?;
            let at_middle = value(middle, &x);
            // `b` is always the newest; the function has opposite signs at `a` and `b`.
            if (at_middle > 0.0) == (at_b > 0.0) {
                at_a *= 0.5;
            } else {
                (a, at_a) = (b, at_b);
            }
            (b, at_b) = (middle, at_middle);
        }
        Some((b, x))
    }
}

/// Whether passing a surface from this side is an event.
fn counts<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(surface: Surface, positive: bool) -> bool {
    match surface {
        Surface::Switch(_) => true,
        Surface::Guard(i) => M::INFO.transitions.get(i).is_some_and(|transition| match transition.direction {
            Direction::Falling => positive,
            Direction::Rising => !positive,
            Direction::Either => true,
        }),
    }
}
