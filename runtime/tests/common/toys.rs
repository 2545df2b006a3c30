//! Small models with closed forms: bouncing ball, rimless wheel, oscillators, switched flows, degenerate guards.

use super::auto::{Auto, Equations, c};
use super::climbers::{BLANK, quantity};
use gaitc_runtime::hybrid::Hybrid;
use gaitc_runtime::model::{Direction, Env, Functional, ModeInfo, ModelInfo, Section, TransitionInfo};
use gaitc_runtime::scalar::Scalar;

const ONE_MODE: &[ModeInfo] = &[ModeInfo { name: "flow", switches: &[], measured_switches: &[] }];
const SWITCHED: &[ModeInfo] = &[ModeInfo { name: "flow", switches: &[0], measured_switches: &[0] }];

const fn self_transition(name: &'static str, direction: Direction) -> TransitionInfo {
    TransitionInfo { name, from: 0, to: 0, direction, also_zero: &[] }
}

macro_rules! toy {
    ($(#[$doc:meta])* $static:ident : $name:ident, $n:literal, $p:literal, $q:literal, $info:expr, { $($body:tt)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default)]
        pub struct $name;
        pub static $static: Hybrid<Auto<$name>, $n, $p, $q> = Hybrid::new();
        impl Equations<$n, $p, $q> for $name {
            const INFO: &'static ModelInfo = &$info;
            $($body)*
        }
    };
}

toy!(
    /// Ball on a floor: y' = v, v' = -g, at y = 0 v+ = -e v. Section: v just after the impact. Parameters g, e.
    BALL: Ball, 2, 2, 1,
    ModelInfo {
        name: "ball",
        parameters: &[quantity("g"), quantity("e")],
        states: &[quantity("y"), quantity("v")],
        modes: ONE_MODE,
        transitions: &[self_transition("impact", Direction::Falling)],
        coordinates: &[1],
        functionals: &[
            Functional::Maximum(0),
            Functional::Minimum(1),
            Functional::Mean(0),
            Functional::Integral(0),
            Functional::Start(1),
            Functional::End(1),
            Functional::Duration,
        ],
        measures: &[
            quantity("apex"),
            quantity("lowest"),
            quantity("mean"),
            quantity("integral"),
            quantity("start"),
            quantity("end"),
            quantity("duration"),
        ],
        ..BLANK
    },
    {
        fn flow<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 2>) -> [S; 2] {
            [x[1], -env.p[0]]
        }
        fn guard<S: Scalar>(_: usize, x: &[S; 2], _: &Env<'_, S, 2>) -> S {
            x[0]
        }
        fn reset<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 2>, _: &mut [S]) -> [S; 2] {
            [c(0.0), -(env.p[1] * x[1])]
        }
        fn embed<S: Scalar>(z: &[S], _: &[S; 2]) -> [S; 2] {
            [c(0.0), z[0]]
        }
        fn integrands<S: Scalar>(_: usize, x: &[S; 2], _: &Env<'_, S, 2>) -> [S; 1] {
            [x[0]]
        }
        fn observable<S: Scalar>(i: usize, _: usize, x: &[S; 2], _: &Env<'_, S, 2>) -> S {
            x[i]
        }
    }
);

toy!(
    /// The ball once more, with the section just before the impact; the impact also counts in memory, and a slow one
    /// loses nothing, by a switch. Parameters g, e.
    FALLING: Falling, 2, 2, 0,
    ModelInfo {
        name: "falling",
        parameters: &[quantity("g"), quantity("e")],
        states: &[quantity("y"), quantity("v")],
        memory: &["n"],
        modes: SWITCHED,
        transitions: &[self_transition("impact", Direction::Falling)],
        switches: &["v < -1"],
        coordinates: &[1],
        section: Some(Section::Before(0)),
        functionals: &[Functional::Start(1), Functional::End(1), Functional::Duration],
        measures: &[quantity("start"), quantity("end"), quantity("duration")],
        ..BLANK
    },
    {
        fn flow<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 2>) -> [S; 2] {
            [x[1], -env.p[0]]
        }
        fn switch<S: Scalar>(_: usize, x: &[S; 2], _: &Env<'_, S, 2>) -> S {
            c::<S>(-1.0) - x[1]
        }
        fn guard<S: Scalar>(_: usize, x: &[S; 2], _: &Env<'_, S, 2>) -> S {
            x[0]
        }
        fn reset<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 2>, memory: &mut [S]) -> [S; 2] {
            let first = memory[0] + c(1.0);
            memory[0] = first;
            // A fast impact leaves e, a slow one all of the speed; n is 1 in every map.
            [c(0.0), -(S::select(env.branch[0], env.p[1], c(1.0)) * x[1] * first)]
        }
        fn embed<S: Scalar>(z: &[S], _: &[S; 2]) -> [S; 2] {
            [c(0.0), z[0]]
        }
        fn observable<S: Scalar>(_: usize, _: usize, x: &[S; 2], _: &Env<'_, S, 2>) -> S {
            x[1]
        }
    }
);

toy!(
    /// The ball again, but its section is a shelf that it never reaches: impacts pile up. Parameters g, e.
    PILING: Piling, 2, 2, 0,
    ModelInfo {
        name: "piling",
        parameters: &[quantity("g"), quantity("e")],
        states: &[quantity("y"), quantity("v")],
        modes: ONE_MODE,
        transitions: &[self_transition("shelf", Direction::Rising), self_transition("impact", Direction::Falling)],
        coordinates: &[1],
        ..BLANK
    },
    {
        fn flow<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 2>) -> [S; 2] {
            [x[1], -env.p[0]]
        }
        fn guard<S: Scalar>(i: usize, x: &[S; 2], _: &Env<'_, S, 2>) -> S {
            if i == 0 { x[0] - c(100.0) } else { x[0] }
        }
        fn reset<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 2>, _: &mut [S]) -> [S; 2] {
            [c(0.0), -(env.p[1] * x[1])]
        }
        fn embed<S: Scalar>(z: &[S], _: &[S; 2]) -> [S; 2] {
            [c(0.0), z[0]]
        }
    }
);

toy!(
    /// Rimless wheel: theta'' = (g/l) sin(theta), spokes 2 alpha apart, slope gamma; at theta = gamma + alpha the wheel
    /// rolls over and theta' is multiplied with mu. Section: theta'. Parameters g/l, alpha, gamma, mu.
    WHEEL: Wheel, 2, 4, 0,
    ModelInfo {
        name: "wheel",
        parameters: &[quantity("k"), quantity("alpha"), quantity("gamma"), quantity("mu")],
        states: &[quantity("theta"), quantity("rate")],
        modes: ONE_MODE,
        transitions: &[self_transition("roll", Direction::Rising)],
        coordinates: &[1],
        ..BLANK
    },
    {
        fn flow<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 4>) -> [S; 2] {
            [x[1], env.p[0] * x[0].sin()]
        }
        fn guard<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 4>) -> S {
            x[0] - env.p[2] - env.p[1]
        }
        fn reset<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 4>, _: &mut [S]) -> [S; 2] {
            [env.p[2] - env.p[1], env.p[3] * x[1]]
        }
        fn embed<S: Scalar>(z: &[S], p: &[S; 4]) -> [S; 2] {
            [p[2] - p[1], z[0]]
        }
    }
);

toy!(
    /// x' = v, v' = -x + a cos(b t): a forced oscillator that uses t; the section is x rising through d after the
    /// reset v+ = s v. All depend on when the run started. Parameters a, b, d, s.
    FORCED: Forced, 2, 4, 1,
    ModelInfo {
        name: "forced",
        parameters: &[quantity("a"), quantity("b"), quantity("d"), quantity("s")],
        states: &[quantity("x"), quantity("v")],
        memory: &["count"],
        modes: ONE_MODE,
        transitions: &[self_transition("section", Direction::Rising), self_transition("kick", Direction::Falling)],
        coordinates: &[0, 1],
        functionals: &[Functional::Integral(0), Functional::Maximum(0), Functional::End(0)],
        measures: &[quantity("integral"), quantity("largest"), quantity("end")],
        uses_time: true,
        ..BLANK
    },
    {
        fn flow<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 4>) -> [S; 2] {
            [x[1], env.p[0] * (env.p[1] * env.t).cos() - x[0]]
        }
        fn guard<S: Scalar>(i: usize, x: &[S; 2], env: &Env<'_, S, 4>) -> S {
            // The kick moves with t, too.
            if i == 0 { x[0] - env.p[2] } else { x[0] + c::<S>(0.2) * env.t.sin() + env.tau * c(0.01) }
        }
        fn when<S: Scalar>(i: usize, _: &[S; 2], env: &Env<'_, S, 4>) -> S {
            // The section needs one kick before it.
            if i == 0 { env.memory[0] - c(0.5) } else { c(1.0) }
        }
        fn reset<S: Scalar>(i: usize, x: &[S; 2], env: &Env<'_, S, 4>, memory: &mut [S]) -> [S; 2] {
            if i == 0 {
                [x[0] + env.tau * c(0.1), x[1] + c::<S>(0.1) * env.t]
            } else {
                memory[0] = env.memory[0] + c(1.0);
                [x[0], env.p[3] * x[1] + c::<S>(0.05) * env.t + c::<S>(0.1) * env.tau]
            }
        }
        fn embed<S: Scalar>(z: &[S], p: &[S; 4]) -> [S; 2] {
            [z[0] + p[3] * c(0.01), z[1]]
        }
        fn integrands<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 4>) -> [S; 1] {
            [x[0] * x[0] + env.t.sin()]
        }
        fn observable<S: Scalar>(_: usize, _: usize, x: &[S; 2], env: &Env<'_, S, 4>) -> S {
            x[0] + c::<S>(0.3) * (env.t * c(1.3)).sin()
        }
    }
);

toy!(
    /// Moves right with speed 1, in the other direction y with speed a before and b after x passes w: the flow jumps.
    /// The section is x = 1 from y = z. Parameters a, b, w.
    JUMP: Jump, 2, 3, 1,
    ModelInfo {
        name: "jump",
        parameters: &[quantity("a"), quantity("b"), quantity("w")],
        states: &[quantity("x"), quantity("y")],
        modes: SWITCHED,
        transitions: &[self_transition("section", Direction::Falling)],
        switches: &["x < w + y/10"],
        coordinates: &[0, 1],
        functionals: &[Functional::Integral(0), Functional::Maximum(0), Functional::Minimum(0)],
        measures: &[quantity("integral"), quantity("largest"), quantity("smallest")],
        ..BLANK
    },
    {
        fn flow<S: Scalar>(_: usize, _: &[S; 2], env: &Env<'_, S, 3>) -> [S; 2] {
            [c(1.0), S::select(env.branch[0], env.p[0], env.p[1])]
        }
        fn switch<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 3>) -> S {
            env.p[2] + x[1] * c(0.1) - x[0]
        }
        fn guard<S: Scalar>(_: usize, x: &[S; 2], _: &Env<'_, S, 3>) -> S {
            c::<S>(1.0) - x[0]
        }
        fn reset<S: Scalar>(_: usize, x: &[S; 2], _: &Env<'_, S, 3>, _: &mut [S]) -> [S; 2] {
            [x[0] - c(1.0), x[1]]
        }
        fn embed<S: Scalar>(z: &[S], _: &[S; 3]) -> [S; 2] {
            [z[0], z[1]]
        }
        fn integrands<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 3>) -> [S; 1] {
            [S::select(env.branch[0], x[1], c(2.0))]
        }
        fn observable<S: Scalar>(_: usize, _: usize, x: &[S; 2], _: &Env<'_, S, 3>) -> S {
            x[1]
        }
    }
);

toy!(
    /// A parabola y = (tau - 1)^2 - dip under a guard y falling: crossed twice within one step when dip is small and
    /// positive, touched at 0, missed when negative. The section is tau = 3. Parameter dip.
    DIP: Dip, 2, 1, 0,
    ModelInfo {
        name: "dip",
        uses_time: true,
        parameters: &[quantity("dip")],
        states: &[quantity("y"), quantity("count")],
        modes: ONE_MODE,
        transitions: &[self_transition("section", Direction::Falling), self_transition("touch", Direction::Falling)],
        coordinates: &[1],
        ..BLANK
    },
    {
        fn flow<S: Scalar>(_: usize, _: &[S; 2], env: &Env<'_, S, 1>) -> [S; 2] {
            [c::<S>(2.0) * (env.t - c(1.0)), c(0.0)]
        }
        fn guard<S: Scalar>(i: usize, x: &[S; 2], env: &Env<'_, S, 1>) -> S {
            if i == 0 { c::<S>(3.0) - env.t } else { x[0] }
        }
        fn reset<S: Scalar>(i: usize, x: &[S; 2], _: &Env<'_, S, 1>, _: &mut [S]) -> [S; 2] {
            if i == 0 { [x[0], x[1]] } else { [c(1.0), x[1] + c(1.0)] }
        }
        fn embed<S: Scalar>(z: &[S], p: &[S; 1]) -> [S; 2] {
            [c::<S>(1.0) - p[0], z[0]]
        }
    }
);

toy!(
    /// Two guards that fall at the same time 1 (and a third disabled by its `when`). Parameter: a shift of the second.
    TWINS: Twins, 1, 1, 0,
    ModelInfo {
        name: "twins",
        parameters: &[quantity("shift")],
        states: &[quantity("x")],
        modes: ONE_MODE,
        transitions: &[
            self_transition("never", Direction::Falling),
            self_transition("first", Direction::Falling),
            self_transition("second", Direction::Rising),
        ],
        coordinates: &[0],
        section: Some(Section::After(1)),
        ..BLANK
    },
    {
        fn flow<S: Scalar>(_: usize, _: &[S; 1], _: &Env<'_, S, 1>) -> [S; 1] {
            [c(1.0)]
        }
        fn guard<S: Scalar>(i: usize, x: &[S; 1], env: &Env<'_, S, 1>) -> S {
            match i {
                0 => c::<S>(0.5) - x[0],
                1 => c::<S>(1.0) - x[0],
                _ => (x[0] - c(1.0)) * c(7.0) - env.p[0],
            }
        }
        fn when<S: Scalar>(i: usize, _: &[S; 1], _: &Env<'_, S, 1>) -> S {
            c(if i == 0 { -1.0 } else { 1.0 })
        }
        fn reset<S: Scalar>(i: usize, x: &[S; 1], _: &Env<'_, S, 1>, _: &mut [S]) -> [S; 1] {
            if i == 1 { [x[0] - c(1.0)] } else { [c(-5.0)] }
        }
        fn embed<S: Scalar>(z: &[S], _: &[S; 1]) -> [S; 1] {
            [z[0]]
        }
    }
);

toy!(
    /// x' = -sqrt(x) (leaves its domain at x = 0 when slope is -1; no event). Parameter: slope.
    DOMAIN: Domain, 1, 1, 0,
    ModelInfo {
        name: "domain",
        parameters: &[quantity("slope")],
        states: &[quantity("x")],
        modes: ONE_MODE,
        transitions: &[self_transition("never", Direction::Falling)],
        coordinates: &[0],
        ..BLANK
    },
    {
        fn flow<S: Scalar>(_: usize, x: &[S; 1], env: &Env<'_, S, 1>) -> [S; 1] {
            [env.p[0] * (c::<S>(0.1) + x[0].sqrt())]
        }
        fn guard<S: Scalar>(_: usize, x: &[S; 1], _: &Env<'_, S, 1>) -> S {
            x[0] + c(100.0)
        }
        fn reset<S: Scalar>(_: usize, x: &[S; 1], _: &Env<'_, S, 1>, _: &mut [S]) -> [S; 1] {
            *x
        }
        fn embed<S: Scalar>(z: &[S], _: &[S; 1]) -> [S; 1] {
            [z[0]]
        }
    }
);

toy!(
    /// x' = -sign(x): slides at 0, where the switch chatters. No parameters.
    CHATTER: Chatter, 1, 0, 0,
    ModelInfo {
        name: "chatter",
        states: &[quantity("x")],
        modes: SWITCHED,
        transitions: &[self_transition("late", Direction::Falling)],
        switches: &["sign(x)"],
        coordinates: &[0],
        ..BLANK
    },
    {
        fn flow<S: Scalar>(_: usize, _: &[S; 1], env: &Env<'_, S, 0>) -> [S; 1] {
            [S::select(env.branch[0], c(-1.0), c(1.0))]
        }
        fn switch<S: Scalar>(_: usize, x: &[S; 1], _: &Env<'_, S, 0>) -> S {
            x[0]
        }
        fn guard<S: Scalar>(_: usize, _: &[S; 1], env: &Env<'_, S, 0>) -> S {
            c::<S>(10.0) - env.tau
        }
        fn reset<S: Scalar>(_: usize, x: &[S; 1], _: &Env<'_, S, 0>, _: &mut [S]) -> [S; 1] {
            *x
        }
        fn embed<S: Scalar>(z: &[S], _: &[S; 0]) -> [S; 1] {
            [z[0]]
        }
    }
);

toy!(
    /// A damped mass that falls for a time T and is put back: a section without coordinates. Parameters g, T.
    PULSE: Pulse, 1, 2, 1,
    ModelInfo {
        name: "pulse",
        parameters: &[quantity("g"), quantity("T")],
        states: &[quantity("v")],
        modes: ONE_MODE,
        transitions: &[self_transition("reset", Direction::Falling)],
        functionals: &[Functional::Mean(0)],
        measures: &[quantity("mean")],
        ..BLANK
    },
    {
        fn flow<S: Scalar>(_: usize, x: &[S; 1], env: &Env<'_, S, 2>) -> [S; 1] {
            [env.p[0] - x[0]]
        }
        fn guard<S: Scalar>(_: usize, _: &[S; 1], env: &Env<'_, S, 2>) -> S {
            env.p[1] - env.tau
        }
        fn reset<S: Scalar>(_: usize, _: &[S; 1], _: &Env<'_, S, 2>, _: &mut [S]) -> [S; 1] {
            [c(0.0)]
        }
        fn embed<S: Scalar>(_: &[S], _: &[S; 2]) -> [S; 1] {
            [c(0.0)]
        }
        fn integrands<S: Scalar>(_: usize, x: &[S; 1], _: &Env<'_, S, 2>) -> [S; 1] {
            [x[0]]
        }
    }
);
