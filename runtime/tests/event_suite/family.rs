//! All systems of the suite as one model: memory says which system it is, so that maps are compiled once.
//!
//! A system has three states, six parameters (the last is the time T at which most of them end), two modes, a few transitions that it may
//! give guards to, two switching functions, and its solution in closed form.

use crate::common::auto::{Equations, c};
use crate::common::climbers::{BLANK, quantity};
use core::any::Any;
use gaitc_runtime::model::{Direction, Env, ModeInfo, ModelInfo, TransitionInfo};
use gaitc_runtime::scalar::{Lanes, Real, Scalar};
use gaitc_runtime::sensitivity::Dual;

/// The section's transition, falling.
pub const END: usize = 0;
/// Falling.
pub const FALL: usize = 1;
/// Rising.
pub const RISE: usize = 2;
/// In either direction.
pub const EITHER: usize = 3;
/// Falling, after [`FALL`] in the order of the spec.
pub const SECOND: usize = 4;
/// Falling, after [`SECOND`].
pub const THIRD: usize = 5;
/// Falling, to the other mode.
pub const OUT: usize = 6;
/// Falling, from the other mode back.
pub const BACK: usize = 7;

/// Three states.
pub type X<S> = [S; 3];
/// What a system's functions depend on besides.
pub type E<'a, S> = Env<'a, S, 6>;

/// The solution in closed form.
#[derive(Clone, Debug)]
pub struct Exact<S> {
    /// Transitions and their times, in order; the last ends the map.
    pub events: Vec<(usize, S)>,
    /// The state after the last.
    pub end: X<S>,
}

/// A system of the suite. Guards that it has no use for stay positive, resets change nothing unless stated.
pub trait System {
    /// State derivative.
    fn flow<S: Scalar>(mode: usize, x: &X<S>, e: &E<'_, S>) -> X<S>;
    /// Guards; `None` for one that is not used.
    fn guard<S: Scalar>(transition: usize, x: &X<S>, e: &E<'_, S>) -> Option<S>;
    /// State after a transition.
    fn reset<S: Scalar>(_transition: usize, x: &X<S>, _e: &E<'_, S>) -> X<S> {
        *x
    }
    /// Margin of a `when`.
    fn when<S: Scalar>(_transition: usize, _x: &X<S>, _e: &E<'_, S>) -> S {
        c(1.0)
    }
    /// The two switching functions.
    fn switch<S: Scalar>(_index: usize, _x: &X<S>, _e: &E<'_, S>) -> S {
        c(1.0)
    }
    /// The solution from a start and parameters; `None` for systems that only stop.
    fn exact<S: Scalar>(_x: &X<S>, _p: &[S; 6]) -> Option<Exact<S>> {
        None
    }
}

/// The guard of a map that ends at the time T, the last parameter.
pub fn at_last<S: Scalar>(e: &E<'_, S>) -> Option<S> {
    Some(e.p[5] - e.t)
}

/// How many transitions were made.
pub fn count<S: Scalar>(e: &E<'_, S>) -> S {
    e.memory[1]
}

/// The value of a number, whatever is carried with it; of lanes, the first.
pub fn number<S: Scalar>(v: S) -> f64 {
    macro_rules! first_of {
        ($($kind:ty),+) => {
            $(if let Some(v) = (&v as &dyn Any).downcast_ref::<$kind>() {
                return v.value();
            })+
        };
    }
    first_of!(f64, Dual, Dual<Dual>, Lanes, Dual<Lanes>, Carried, Dual<Carried>, Second);
    f64::NAN
}

/// What second derivatives are carried with by replays.
type Carried = Dual<Dual<f64, 4>, 2>;
/// All second derivatives by the three states of the start and the six parameters.
pub type Second = Dual<Dual<f64, 9>, 9>;

/// Numbers that have a value.
trait Valued {
    fn value(&self) -> f64;
}

impl Valued for f64 {
    fn value(&self) -> f64 {
        *self
    }
}

impl Valued for Lanes {
    fn value(&self) -> f64 {
        self.lane(0)
    }
}

impl<S: Valued, const K: usize> Valued for Dual<S, K> {
    fn value(&self) -> f64 {
        self.value.value()
    }
}

const fn transition(name: &'static str, from: usize, to: usize, direction: Direction) -> TransitionInfo {
    TransitionInfo { name, from, to, direction, also_zero: &[] }
}

const fn mode(name: &'static str) -> ModeInfo {
    ModeInfo { name, switches: &[0, 1], measured_switches: &[0, 1] }
}

/// The model.
#[derive(Clone, Copy, Debug, Default)]
pub struct Family;

/// The systems and their numbers.
macro_rules! systems {
    ($($module:ident :: $name:ident),+ $(,)?) => {
        /// Which system.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Of { $($name),+ }

        /// Calls `f::<system>`.
        macro_rules! call {
            ($of:expr, $function:ident $arguments:tt, $otherwise:expr) => {
                $(if $of == Of::$name as usize {
                    <crate::$module::$name as System>::$function $arguments
                } else)+ { $otherwise }
            };
        }
    };
}

systems!(
    flights::Ball,
    flights::Drop,
    directions::Cubic,
    directions::Harmonic,
    directions::Spiral,
    starts::Polynomial,
    starts::Landing,
    clocks::Clocks,
    ties::Runner,
    whens::Gate,
    whens::GatedCubic,
    grazing::Parabola,
    grazing::Inflection,
    resets::TwoModes,
    resets::Counting,
    curved::Billiard,
    curved::Lens,
    curved::Product,
    curved::Exponential,
    curved::Logistic,
    switches::Jump,
    switches::Kink,
    switches::Pair,
    switches::Coincident,
    switches::Nested,
    switches::Timed,
    piling::Sliding,
    piling::Relay,
    piling::Walls,
    limits::Stiff,
    limits::Root,
    limits::Blowup,
);

/// The closed form of a system.
pub fn exact<S: Scalar>(of: Of, x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
    call!(of as usize, exact(x, p), None)
}

fn which<S: Scalar>(e: &E<'_, S>) -> usize {
    e.memory.first().map_or(usize::MAX, |of| number(*of) as usize)
}

impl Equations<3, 6, 0> for Family {
    const INFO: &'static ModelInfo = &ModelInfo {
        name: "family",
        uses_time: true,
        parameters: &[quantity("a"), quantity("b"), quantity("c"), quantity("d"), quantity("e"), quantity("T")],
        states: &[quantity("x"), quantity("y"), quantity("z")],
        memory: &["system", "count"],
        modes: &[mode("home"), mode("away")],
        transitions: &[
            transition("end", 0, 0, Direction::Falling),
            transition("fall", 0, 0, Direction::Falling),
            transition("rise", 0, 0, Direction::Rising),
            transition("either", 0, 0, Direction::Either),
            transition("second", 0, 0, Direction::Falling),
            transition("third", 0, 0, Direction::Falling),
            transition("out", 0, 1, Direction::Falling),
            transition("back", 1, 0, Direction::Falling),
        ],
        switches: &["first", "second"],
        coordinates: &[0, 1, 2],
        ..BLANK
    };
    #[inline(never)]
    fn flow<S: Scalar>(mode: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        call!(which(e), flow(mode, x, e), [c(f64::NAN); 3])
    }
    #[inline(never)]
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> S {
        call!(which(e), guard(i, x, e), None).unwrap_or(c(1.0))
    }
    #[inline(never)]
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>, memory: &mut [S]) -> X<S> {
        if let Some(count) = memory.get_mut(1) {
            *count = *count + c(1.0);
        }
        call!(which(e), reset(i, x, e), [c(f64::NAN); 3])
    }
    fn when<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> S {
        call!(which(e), when(i, x, e), c(f64::NAN))
    }
    #[inline(never)]
    fn switch<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> S {
        call!(which(e), switch(i, x, e), c(f64::NAN))
    }
    fn embed<S: Scalar>(z: &[S], _: &[S; 6]) -> X<S> {
        [z[0], z[1], z[2]]
    }
}
