//! What the parts of the work cost: one evaluation of a flow, and of a flow with its derivatives, for every model; the
//! problems of two models' specs, solved in process; and one spec on its way to Rust, with and without Python.
//! `cargo bench --bench parts`; words after `--` pick among `flows`, `optimize` and `compile`. Times are medians.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a bench may fail loudly
#![allow(clippy::print_stdout)] // its result

use gaitc::load::{Loaded, load};
use gaitc::models::generated;
use gaitc::problem::{Start, assemble};
use gaitc_compiler::back::rust::{Options, emit};
use gaitc_compiler::casadi::{derive, environment::Search};
use gaitc_compiler::front;
use gaitc_compiler::ir::canonical::fingerprint;
use gaitc_compiler::valid::{Validated, validate};
use gaitc_runtime::model::{Env, Model};
use gaitc_runtime::optimize::{Settings, solve};
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

/// How long a part is timed (s), ...
const SECONDS: f64 = 0.3;
/// ... and how often at least.
const TURNS: usize = 5;
/// Evaluations of a flow that are timed together: one is shorter than a look at the clock.
const TOGETHER: usize = 1000;

/// The median time of a call (s).
fn median(mut call: impl FnMut()) -> f64 {
    let start = Instant::now();
    let mut times = Vec::new();
    while start.elapsed().as_secs_f64() < SECONDS || times.len() < TURNS {
        let one = Instant::now();
        call();
        times.push(one.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// The flow of a model's first mode at the start of its spec, bare and with its Jacobians. Where there is a mass matrix it is
/// the residual of the equations, whose derivatives by the rates belong to it.
fn flow<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>() {
    let loaded = load(M::INFO.name, None).expect("a model of this program");
    let p: [f64; P] = loaded.parameters().try_into().expect("as many parameters as were compiled");
    let (memory, branch) = (loaded.memory(), vec![true; M::INFO.switches.len()]);
    let x = M::embed(&loaded.start(), &p);
    let env = Env { tau: 0.01, t: 0.01, p: &p, memory: &memory, branch: &branch };
    let each = |call: &dyn Fn()| {
        let time = median(|| {
            for _ in 0..TOGETHER {
                call();
            }
        });
        time * 1e9 / TOGETHER as f64
    };
    let (bare, whole) = if M::INFO.explicit {
        (
            each(&|| {
                black_box(M::flow(0, black_box(&x), black_box(&env)));
            }),
            each(&|| {
                black_box(M::flow_jacobian(0, black_box(&x), black_box(&env)));
            }),
        )
    } else {
        (
            each(&|| {
                black_box(M::residual(0, black_box(&x), black_box(&x), black_box(&env)));
            }),
            each(&|| {
                black_box(M::residual_jacobian(0, black_box(&x), black_box(&x), black_box(&env)));
            }),
        )
    };
    println!("| {} | {N} | {P} | {bare:.0} ns | {whole:.0} ns |", M::INFO.name);
}

macro_rules! flows {
    ($($module:ident :: $model:ident),* $(,)?) => {
        $(flow::<generated::$module::$model, { generated::$module::STATES }, { generated::$module::PARAMETERS }, { generated::$module::INTEGRALS }>();)*
    };
}

fn flows() {
    println!("| model | states | parameters | f | f and df |\n|---|---|---|---|---|");
    flows!(
        angle_switched::AngleSwitched,
        bouncing_ball::BouncingBall,
        compass_walker::CompassWalker,
        fg_template::FgTemplate,
        power_stroke::PowerStroke,
        power_stroke_crank::PowerStrokeCrank,
        power_stroke_muscle::PowerStrokeMuscle,
        prescribed_length::PrescribedLength,
        rimless_wheel::RimlessWheel,
        rotational::Rotational,
        self_exciting::SelfExciting,
        self_exciting_rack::SelfExcitingRack,
        self_exciting_rotor::SelfExcitingRotor,
        slip_runner::SlipRunner,
    );
}

fn optimize() {
    println!("\n| model | problem | status | optimum | steps | median |\n|---|---|---|---|---|---|");
    for name in ["prescribed_length", "self_exciting"] {
        let loaded = load(name, None).expect("a model of this program");
        for problem in &loaded.spec.problems {
            let start =
                || Start { parameters: loaded.parameters(), section: loaded.start(), settings: Settings::default() };
            let run =
                |loaded: &Loaded| solve(&assemble(loaded, &loaded.spec, problem, start())).expect("a sound problem");
            let solution = run(&loaded);
            let time = median(|| {
                black_box(run(black_box(&loaded)));
            });
            let (status, value, steps) = (solution.status, solution.objective, solution.iterations);
            println!("| {name} | {} | {status:?} | {value:.6} | {steps} | {:.1} ms |", problem.name, time * 1e3);
        }
    }
}

fn validated(path: &Path) -> Validated {
    let parsed = front::parse_file(path).expect("a file of this repository");
    validate(parsed.model.expect("a spec without errors")).expect("a valid model")
}

fn compile() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let python = Search::from_environment(Some(root.join("target/gaitc-python"))).find().expect("Python with CasADi");
    println!("\n| model | front end | CasADi, with the start of Python | emitter |\n|---|---|---|---|");
    for name in ["prescribed_length", "self_exciting"] {
        let path = root.join(format!("specs/{name}.toml"));
        let front = median(|| {
            black_box(validated(black_box(&path)));
        });
        let model = validated(&path);
        let derived = || derive(&python, &[&model]).expect("CasADi derives it").remove(0);
        let casadi = median(|| {
            black_box(derived());
        });
        let programs = derived();
        let options = Options { runtime_path: "::gaitc_runtime".into(), fingerprint: fingerprint(model.model()) };
        let back = median(|| {
            black_box(emit(black_box(&model), &programs, &options).expect("it is valid"));
        });
        println!("| {name} | {:.2} ms | {:.0} ms | {:.1} ms |", front * 1e3, casadi * 1e3, back * 1e3);
    }
}

fn main() {
    // cargo passes `--bench`.
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let parts: [(&str, fn()); 3] = [("flows", flows), ("optimize", optimize), ("compile", compile)];
    for (name, part) in parts {
        if words.is_empty() || words.iter().any(|word| word == name) {
            part();
        }
    }
}
