//! The problems of the reference suite, and the optima that brute force found for them.
//!
//! The numbers are those that `cargo bench --bench optima` prints in its column `optimum`.

/// A problem of a spec, or one made of flags.
pub struct Case {
    pub model: &'static str,
    pub problem: Asked,
    /// What brute force found, the best first: every local optimum that the search may end in. SI units.
    pub optima: &'static [f64],
}

/// What to solve.
pub enum Asked {
    /// By its name in the spec.
    Named(&'static str),
    /// As on the command line.
    Flags(Flags),
}

/// The texts of `--maximize` or `--minimize`, `--vary` and `--subject-to`.
pub struct Flags {
    pub name: &'static str,
    pub maximize: bool,
    pub objective: &'static str,
    pub vary: &'static [(&'static str, &'static str)],
    pub subject_to: &'static [&'static str],
}

impl Case {
    /// Model and problem, for people.
    pub fn title(&self) -> String {
        let problem = match &self.problem {
            Asked::Named(name) => name,
            Asked::Flags(flags) => flags.name,
        };
        format!("{} {problem}", self.model)
    }
}

const fn named(model: &'static str, problem: &'static str, optima: &'static [f64]) -> Case {
    Case { model, problem: Asked::Named(problem), optima }
}

const fn flags(model: &'static str, flags: Flags, optima: &'static [f64]) -> Case {
    Case { model, problem: Asked::Flags(flags), optima }
}

const GEAR_SPRAWL_SPRING: &[(&str, &str)] = &[("G", "15..120"), ("psi", "1..45 deg"), ("k", "0..200 N/m")];

/// All problems.
pub const CASES: &[Case] = &[
    named("angle_switched", "least_unstable", &[1.1270874574]),
    named("bouncing_ball", "highest", &[0.8154943936]),
    named("compass_walker", "fastest", &[]),
    flags(
        "compass_walker",
        Flags {
            name: "from flags: most stable",
            maximize: false,
            objective: "spectral_radius",
            vary: &[("gamma", "1..4 deg"), ("m", "2..8 kg")],
            subject_to: &["mean_speed >= 0.6 m/s"],
        },
        &[],
    ),
    named("fg_template", "fastest_stable", &[0.5013072109, 0.2836563917]),
    named("power_stroke", "fastest_stable", &[0.8856187983]),
    named("power_stroke_crank", "fastest", &[1.2390573710]),
    named("power_stroke_muscle", "fastest_stable", &[0.9049191845]),
    named("prescribed_length", "fastest_stable", &[0.6981704256]),
    named("prescribed_length", "fastest", &[1.0358846466]),
    flags(
        "prescribed_length",
        Flags {
            name: "from flags: most stable",
            maximize: false,
            objective: "spectral_radius",
            vary: &[("psi", "1..45 deg"), ("omega", "2*pi*2..2*pi*4 rad/s")],
            subject_to: &[],
        },
        &[0.3558670945],
    ),
    flags(
        "prescribed_length",
        Flags {
            name: "from flags: cheapest",
            maximize: false,
            objective: "cost_of_transport",
            vary: &[("psi", "5..45 deg"), ("omega", "2*pi*2..2*pi*4 rad/s"), ("l_s", "5..30 cm")],
            subject_to: &["climb_speed >= 0.6 m/s", "spectral_radius <= 0.95"],
        },
        &[],
    ),
    named("rimless_wheel", "fastest", &[1.7345792525]),
    named("rotational", "fastest", &[0.6678015832]),
    named("slip_runner", "smoothest", &[0.0542528399, 0.0550866627]),
    named("self_exciting", "fastest_stable", &[0.9231164541]),
    named("self_exciting", "fastest_unbounded", &[1.3651996864]),
    flags(
        "self_exciting",
        Flags {
            name: "from flags: fastest, stability bounded",
            maximize: true,
            objective: "climb_speed",
            vary: GEAR_SPRAWL_SPRING,
            subject_to: &["spectral_radius <= 0.95"],
        },
        &[],
    ),
    flags(
        "self_exciting",
        Flags {
            name: "from flags: most stable",
            maximize: false,
            objective: "spectral_radius",
            vary: &[("psi", "1..45 deg")],
            subject_to: &[],
        },
        &[0.5531509274],
    ),
    flags(
        "self_exciting",
        Flags {
            name: "from flags: cheapest",
            maximize: false,
            objective: "cost_of_transport",
            vary: &[("G", "30..120"), ("psi", "1..45 deg")],
            subject_to: &["climb_speed >= 0.7 m/s", "spectral_radius <= 0.95"],
        },
        &[1.1586065187],
    ),
    named("self_exciting_rack", "fastest_stable", &[3.3899209180]),
    named("self_exciting_rotor", "fastest_stable", &[]),
];
