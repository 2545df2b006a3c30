//! Problems that are nonsense, infeasible, unbounded, or interrupted: each ends in the right message, through the program.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use common::{json, number, text};

/// Flags behind `optimize prescribed_length`, exit code, status in the JSON, and what the message has to say.
type Case = (&'static [&'static str], i32, &'static str, &'static [&'static str]);

const PSI: &str = "psi=5..45 deg";
const FAST: [&str; 4] = ["--maximize", "climb_speed", "--vary", PSI];

const CASES: &[Case] = &[
    // Wrong as stated.
    (
        &["--maximize", "3 [m]", "--vary", PSI],
        1,
        "error",
        &["`3 [m]` does not depend on anything that varies", "--vary"],
    ),
    (&["--maximize", "climb_speed", "--vary", "psi=45..5 deg"], 1, "error", &["lower bound", "exchange the bounds"]),
    (&["--maximize", "climb_speed", "--vary", "psi=5..45 kg"], 1, "error", &["must be dimensionless, not kg"]),
    (&["--maximize", "climb_speed", "--vary", "pis=5..45 deg"], 1, "error", &["`pis`", "did you mean `psi`?"]),
    (&["--maximize", "climb_sped", "--vary", PSI], 1, "error", &["`climb_sped`", "did you mean `climb_speed`?"]),
    (&["--maximize", "climb_speed + mean_power", "--vary", PSI], 1, "error", &["m/s", "W"]),
    (&[FAST[0], FAST[1], FAST[2], FAST[3], "--subject-to", "peak_force <= 2 m"], 1, "error", &["peak_force", "m"]),
    (&[FAST[0], FAST[1], FAST[2], FAST[3], "--subject-to", "spectral_radius <= 0"], 1, "error", &["above 0", "0.95"]),
    (
        &[FAST[0], FAST[1], FAST[2], FAST[3], "--subject-to", "spectral_radius <= l_s/l_b - 1"],
        1,
        "error",
        &["bound -0.74", "not positive"],
    ),
    (&[FAST[0], FAST[1], FAST[2], FAST[3], "--period", "0"], 1, "error", &["--period 0", "from 1 to 1000"]),
    (&[FAST[0], FAST[1], FAST[2], FAST[3], "--threads", "0"], 1, "error", &["--threads 0", "from 1 to 1024"]),
    (&[FAST[0], FAST[1], FAST[2], FAST[3], "--starts", "200000"], 1, "error", &["from 1 to 100000"]),
    // Constraints in which nothing varies.
    (
        &[FAST[0], FAST[1], FAST[2], FAST[3], "--subject-to", "omega <= 3 rad/s"],
        1,
        "error",
        &["`omega <= 3 rad/s` never holds: nothing in it varies, `omega` is 18.85 rad/s", "--vary"],
    ),
    (
        &["--maximize", "climb_speed", "--vary", "omega=15..20 rad/s", "--subject-to", "psi >= 3 rad"],
        1,
        "error",
        &["`psi >= 3 rad` never holds"],
    ),
    // Nothing to be gained.
    (
        &["--maximize", "stride_frequency", "--vary", PSI],
        0,
        "optimal",
        &["the objective does not change with `psi`: every gait that meets the constraints is as good"],
    ),
    (
        &["--maximize", "1 [m]/psi", "--vary", "psi=0..45 deg"],
        2,
        "unbounded",
        &["improves without limit", "constraint"],
    ),
    // No value.
    (&["--maximize", "sqrt(psi - 6)", "--vary", PSI], 2, "undefined", &["the objective is not defined", "narrow"]),
    // Infeasible, by one constraint and by two of three.
    (
        &[FAST[0], FAST[1], FAST[2], FAST[3], "--subject-to", "climb_speed >= 2 m/s"],
        2,
        "infeasible",
        &["`climb_speed >= 2 m/s` cannot hold for psi in 5 .. 45 deg", "`climb_speed` is at most 0.7768 m/s", "relax"],
    ),
    (
        &[FAST[0], FAST[1], FAST[2], FAST[3], "--subject-to", "spectral_radius <= 0.2"],
        2,
        "infeasible",
        &["`spectral_radius <= 0.2` cannot hold", "`spectral_radius` is at least 0.5077"],
    ),
    (
        &[
            FAST[0],
            FAST[1],
            FAST[2],
            FAST[3],
            "--subject-to",
            "climb_speed >= 0.75 m/s",
            "--subject-to",
            "mean_power <= 40 W",
            "--subject-to",
            "spectral_radius <= 0.9",
        ],
        2,
        "infeasible",
        &[
            "`climb_speed >= 0.75 m/s` and `spectral_radius <= 0.9` cannot hold together for psi in 5 .. 45 deg",
            "`climb_speed` is at most",
            "m/s where `spectral_radius <= 0.9` holds",
            "`spectral_radius` is at least",
        ],
    ),
];

#[test]
fn trouble_ends_in_the_right_message() {
    for (flags, code, status, parts) in CASES {
        let args = [&["optimize", "prescribed_length"][..], flags].concat();
        let (found, value) = json(&args);
        assert_eq!((found, value["status"].as_str()), (*code, Some(*status)), "{args:?}: {value:#}");
        let message = value["message"].as_str().unwrap();
        for part in *parts {
            assert!(message.contains(part), "{args:?} does not say {part:?}:\n{message}");
        }
    }
}

/// A parameter in GN/m beside one in mm changes nothing; a range in GN/m that hides the values that matter is said to be too wide.
#[test]
fn badly_scaled_ranges() {
    let asked = |flags: &[&str]| json(&[&["optimize", "power_stroke"], flags].concat());
    let (_, plain) = asked(&[]);
    let (code, scaled) = asked(&["--vary", "k=0..200e-9 GN/m", "--vary", "l_s=50..300 mm"]);
    assert_eq!(code, 0, "{scaled:#}");
    for path in ["/objective/value", "/parameters/k", "/parameters/l_s"] {
        approx::assert_relative_eq!(number(&scaled, path), number(&plain, path), max_relative = 1e-8);
    }
    let (code, wide) = asked(&["--vary", "k=0..1 GN/m", "--vary", "l_s=50..300 mm"]);
    assert_eq!((code, wide["status"].as_str()), (2, Some("unconfirmed")), "{wide:#}");
    let message = wide["message"].as_str().unwrap();
    assert!(
        message.contains("the range of `k` is too wide to tell ") && message.contains(" from its bound 0 "),
        "{message}"
    );
}

#[test]
fn a_constraint_that_always_holds_is_pointed_out() {
    let args = [&["optimize", "prescribed_length"][..], &FAST, &["--subject-to", "omega <= 30 rad/s"]].concat();
    let (code, out, _) = text(&args);
    assert_eq!(code, 0, "{out}");
    assert!(out.contains("note: `omega <= 30 rad/s` always holds: nothing in it varies"), "{out}");
}

#[test]
fn a_conflict_is_json_in_si_units() {
    let constraints = ["--subject-to", "climb_speed >= 75 cm/s", "--subject-to", "spectral_radius <= 0.9"];
    let (code, value) = json(&[&["optimize", "prescribed_length"][..], &FAST, &constraints].concat());
    assert_eq!(code, 2, "{value:#}");
    assert_eq!(value["conflict"].to_string(), r#"["climb_speed >= 75 cm/s","spectral_radius <= 0.9"]"#);
    // What is reached of the speed is the optimum of the problem that bounds stability alone.
    let (_, alone) = json(&[&["optimize", "prescribed_length"][..], &FAST, &constraints[2..]].concat());
    approx::assert_relative_eq!(
        number(&value, "/reached/0/value"),
        number(&alone, "/objective/value"),
        max_relative = 1e-7
    );
    approx::assert_relative_eq!(
        number(&value, "/reached/0/margin"),
        number(&alone, "/objective/value") - 0.75,
        max_relative = 1e-6
    );
    assert!(number(&value, "/reached/1/value") > 0.9);
    assert!(value["message"].as_str().unwrap().contains("`climb_speed` is at most 66.76 cm/s"), "{value:#}");
}

#[test]
fn no_gait_anywhere_in_the_ranges() {
    let flags = ["--maximize", "climb_speed", "--vary", "psi=30..45 deg"];
    let (code, value) = json(&[&["optimize", "angle_switched"][..], &flags].concat());
    assert_eq!((code, value["status"].as_str()), (2, Some("no_gait")), "{value:#}");
    assert!(value["message"].as_str().unwrap().contains("no periodic gait to start from"), "{value:#}");
    assert!(value["notes"].to_string().contains("other places in the ranges"), "{value:#}");
}

#[test]
fn starts_are_the_same_for_any_number_of_threads() {
    let run = |threads: &str| {
        let flags = ["--problem", "fastest", "--starts", "6", "--seed", "5", "--threads", threads];
        let output = common::gaitc(&[&["optimize", "prescribed_length", "--json"][..], &flags].concat());
        assert_eq!(output.status.code(), Some(0));
        output.stdout
    };
    let one = run("1");
    assert_eq!(one, run("3"));
    let value: serde_json::Value = serde_json::from_slice(&one).unwrap();
    let optima = value["optima"].as_array().unwrap();
    assert_eq!(optima.iter().map(|o| o["starts"].as_u64().unwrap()).sum::<u64>(), 6, "{value:#}");
    assert_eq!(optima[0]["objective"], value["objective"]["value"]);
}

#[test]
fn a_gait_of_two_steps() {
    let speed = |flags: &[&str]| {
        let (code, value) = json(&[&["optimize", "prescribed_length"][..], &FAST, flags].concat());
        assert_eq!(code, 0, "{value:#}");
        (number(&value, "/objective/value"), number(&value, "/spectral_radius"))
    };
    let (one, two) = (speed(&[]), speed(&["--period", "2"]));
    // Two maps of a gait of one: the same speed, the square of the multipliers.
    approx::assert_relative_eq!(one.0, two.0, max_relative = 1e-8);
    approx::assert_relative_eq!(one.1 * one.1, two.1, max_relative = 1e-6);
}

/// A run that would take hours, interrupted after a while: exit code, stdout, stderr.
#[cfg(unix)]
fn interrupted(flags: &[&str]) -> (Option<i32>, String, String) {
    use std::process::{Command, Stdio};
    let mut command = Command::new(env!("CARGO_BIN_EXE_gaitc"));
    command.current_dir(env!("CARGO_MANIFEST_DIR")).env("NO_COLOR", "1");
    command.args(["optimize", "prescribed_length", "--problem", "fastest", "--starts", "100000"]).args(flags);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_secs(4));
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
    let output = child.wait_with_output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[cfg(unix)]
#[test]
fn ctrl_c_prints_the_best_gait_so_far() {
    let (code, out, err) = interrupted(&[]);
    assert_eq!(code, Some(130), "{out}\n{err}");
    assert!(out.contains("interrupted: this is the best gait so far, not an optimum"), "{out}");
    assert!(out.contains("climb_speed = ") && out.contains("spectral_radius"), "{out}");
    let (code, out, err) = interrupted(&["--json"]);
    assert_eq!(code, Some(130), "{err}");
    let value: serde_json::Value = serde_json::from_str(&out).expect("one whole document");
    assert_eq!(value["status"].as_str(), Some("interrupted"), "{value:#}");
    // It meets the problem's constraint.
    assert!(number(&value, "/measures/peak_force") <= 150.0 * (1.0 + 1e-6), "{value:#}");
    assert!(number(&value, "/objective/value") > 0.5 && number(&value, "/starts/run") < 100_000.0, "{value:#}");
}

/// What is written almost right is told how to be written.
#[test]
fn slips_in_flags_are_explained() {
    let cases: [(&[&str], &str); 6] = [
        (&["--vary", "psi=5...45 deg"], "write `5..45 deg`"),
        (&["--starts", "1e3"], "write 1000"),
        (&["--starts", "a few"], "write one in digits"),
        (&["--vary", "psi=20..20 deg"], "nothing to vary: the range is a single value, `psi` = 20 deg"),
        (&["--vary", "psi=20..20 deg", "--vary", "omega=18..18 rad/s"], "every range is a single value"),
        (&["--work", "0"], "--work 0: give a number from 1"),
    ];
    for (flags, expected) in cases {
        let (code, _, errors) = common::text(&[&["optimize", "prescribed_length"], flags].concat());
        assert!(code != 0 && errors.contains(expected), "{flags:?}: {errors}");
    }
}

/// Too little work for an optimum ends with the best gait so far, and more starts are not tried.
#[test]
fn work_that_is_used_up_is_said() {
    let (code, value) = json(&["optimize", "prescribed_length", "--work", "3"]);
    assert_eq!((code, value["status"].as_str()), (2, Some("work_limit")), "{value:#}");
    assert_eq!(number(&value, "/starts/run"), 1.0);
    assert!(value["message"].as_str().unwrap().contains("no optimum within 3 maps"), "{value:#}");
    // A gait of fifty maps is one that a search can afford.
    let long = ["optimize", "prescribed_length", "--period", "50", "--vary", "psi=15..25 deg"];
    let (code, value) = json(&long);
    assert_eq!((code, value["status"].as_str()), (0, Some("optimal")), "{value:#}");
    assert_eq!(number(&value, "/confirmation/disturbed/maps"), 400.0, "{value:#}");
}

/// Where steps become too long for the time limit, that is what a stalled search says.
#[test]
fn a_step_beyond_the_time_limit_is_named() {
    let (_, value) = json(&["optimize", "bouncing_ball", "--vary", "kick=0.1..10000 m/s"]);
    assert_eq!(value["status"].as_str(), Some("stalled"), "{value:#}");
    assert!(value["message"].as_str().unwrap().contains("no step ends within the time limit"), "{value:#}");
}

/// What is in the way of a trade-off is said in units.
#[test]
fn conflicts_of_trade_offs_are_in_units() {
    let trade = ["--trade", "climb_speed:mean_power", "--points", "2", "--subject-to", "peak_force <= 20 N"];
    let (code, value) = json(&[&["optimize", "prescribed_length"], &trade[..]].concat());
    let message = value["message"].as_str().unwrap();
    assert!(code == 2 && message.contains("`peak_force` is at least ") && message.contains(" N "), "{value:#}");
}

/// The leg force is largest where a step begins or where it ends: the smallest of the larger one is where both are equal. Found again
/// by a golden section over gaits, which knows no derivative.
#[test]
fn an_extremum_whose_place_jumps_is_minimised() {
    let at_rate = ["--set", "omega=10 rad/s"];
    let flags = ["--minimize", "peak_force", "--vary", PSI];
    let (code, value) = json(&[&["optimize", "prescribed_length"], &at_rate[..], &flags].concat());
    assert_eq!((code, value["status"].as_str()), (0, Some("optimal")), "{value:#}");
    assert!(value["notes"].to_string().contains("several places at once"), "{value:#}");
    let force = |psi: f64| {
        let set = format!("psi={psi} deg");
        let (_, gait) = json(&[&["gait", "prescribed_length"], &at_rate[..], &["--set", &set]].concat());
        number(&gait, "/measures/peak_force")
    };
    let (mut a, mut b) = (39.5, 41.5);
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut c, mut d) = (b - ratio * (b - a), a + ratio * (b - a));
    let (mut at_c, mut at_d) = (force(c), force(d));
    while b - a > 1e-7 {
        if at_c < at_d {
            (b, d, at_d) = (d, c, at_c);
            c = b - ratio * (b - a);
            at_c = force(c);
        } else {
            (a, c, at_c) = (c, d, at_d);
            d = a + ratio * (b - a);
            at_d = force(d);
        }
    }
    approx::assert_relative_eq!(number(&value, "/objective/value"), f64::min(at_c, at_d), max_relative = 1e-8);
    approx::assert_abs_diff_eq!(number(&value, "/parameters/psi").to_degrees(), 0.5 * (a + b), epsilon = 1e-5);
}
