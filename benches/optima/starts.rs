//! The optimizer from random starts, each a gait of its own.

use super::instance::Instance;
use gaitc::problem::{Start, assemble};
use gaitc_runtime::optimize::{Settings, Solution, solve};
use std::time::{Duration, Instant};

/// Processor time that is counted well enough to be used.
const TICKS: Duration = Duration::from_millis(20);

/// Processor time of this thread where the system tells (Linux), else time: what others do on the machine does not count.
struct Clock {
    wall: Instant,
    cpu: Option<u64>,
}

impl Clock {
    fn start() -> Self {
        Self { wall: Instant::now(), cpu: Self::cpu() }
    }

    fn cpu() -> Option<u64> {
        let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
        text.split_whitespace().next()?.parse().ok()
    }

    fn elapsed(&self) -> Duration {
        let wall = self.wall.elapsed();
        let cpu = self.cpu.zip(Self::cpu()).map(|(before, now)| Duration::from_nanos(now.saturating_sub(before)));
        // The system counts in ticks of a few milliseconds.
        cpu.filter(|cpu| *cpu > TICKS).map_or(wall, |cpu| cpu.min(wall))
    }
}

/// A start that was solved.
pub struct Run {
    /// Where it began, in fractions of the ranges.
    pub from: Vec<f64>,
    pub solution: Solution,
    pub time: Duration,
}

/// Solves from `count` random starts. Points without a gait are drawn again; how many there were comes second.
pub fn run(instance: &Instance, count: usize, seed: u64) -> (Vec<Run>, usize) {
    run_with(instance, count, seed, &Settings::default())
}

/// The same with other settings, but for the number of starts.
pub fn run_with(instance: &Instance, count: usize, seed: u64, settings: &Settings) -> (Vec<Run>, usize) {
    let (home, mut state, mut without) = (instance.home(), seed, 0);
    let mut runs = Vec::new();
    while runs.len() < count && without < 100 * count {
        let from: Vec<f64> = (0..instance.len()).map(|_| uniform(&mut state)).collect();
        let parameters = instance.parameters(&from);
        let Some(section) = instance.follow(&home, &parameters) else {
            without += 1;
            continue;
        };
        let settings = Settings { starts: 1, ..settings.clone() };
        let start = Start { parameters, section, settings };
        let problem = assemble(&instance.loaded, &instance.spec, &instance.problem, start);
        let clock = Clock::start();
        let solution = solve(&problem).expect("the problem is well stated");
        runs.push(Run { from, solution, time: clock.elapsed() });
    }
    (runs, without)
}

/// Uniform in [0, 1): splitmix64 (Steele, Lea, Flood 2014).
fn uniform(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}
