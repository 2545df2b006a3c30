//! `gaitc simulate` through the program: what it answers, files that it writes, runs that stop, and wrong input.

use crate::common::{gaitc, json, number, text};
use approx::assert_abs_diff_eq;
use serde_json::Value;
use std::fs;

fn list(value: &Value, path: &str) -> Vec<f64> {
    let all = value.pointer(path).and_then(Value::as_array).unwrap_or_else(|| panic!("no list at {path}"));
    all.iter().map(|v| v.as_f64().unwrap_or(f64::NAN)).collect()
}

/// Closed form of the ball: impacts at 2 v/g (1 + e + ...), parabolas between them.
#[test]
fn a_ball_bounces_as_it_should() {
    let run = [
        "simulate",
        "bouncing_ball",
        "--set",
        "e=0.8",
        "--set",
        "kick=0 m/s",
        "--from",
        "v=3 m/s",
        "--steps",
        "3",
        "--interval",
        "10ms",
    ];
    let (code, all) = json(&run);
    assert_eq!((code, all["status"].as_str()), (0, Some("completed")), "{:#}", all["message"]);
    let (g, e, v) = (9.81, 0.8, 3.0);
    let events = all["events"].as_array().unwrap();
    assert_eq!(events.len(), 3);
    let duration = 2.0 * v / g * (1.0 + e + e * e);
    assert_abs_diff_eq!(number(&all, "/duration"), duration, epsilon = 1e-12);
    assert_abs_diff_eq!(number(&events[0], "/time"), 2.0 * v / g, epsilon = 1e-13);
    assert_abs_diff_eq!(number(&events[0], "/state_before/v"), -v, epsilon = 1e-13);
    assert_abs_diff_eq!(number(&events[0], "/state_after/v"), e * v, epsilon = 1e-13);
    let (t, y, rate) = (list(&all, "/samples/t"), list(&all, "/samples/state/y"), list(&all, "/samples/rate/v"));
    assert_eq!((t.len(), y.len()), (rate.len(), list(&all, "/samples/tau").len()));
    for ((t, y), rate) in t.iter().zip(&y).zip(&rate).filter(|((t, _), _)| **t < 2.0 * v / g) {
        assert_abs_diff_eq!(*y, v * t - 0.5 * g * t * t, epsilon = 1e-13);
        assert_eq!(*rate, -g);
    }
    for key in ["model", "status", "message", "parameters", "start", "stopped", "method", "warnings", "gaitc"] {
        assert!(all.get(key).is_some(), "{key}");
    }
    assert_eq!(number(&all, "/start/section/v"), 3.0);
    assert_eq!(all["samples"]["mode"][0], all["start"]["mode"]);
    // The same from the state in the air that the section stands for.
    let state = [
        "simulate",
        "bouncing_ball",
        "--set",
        "e=0.8",
        "--set",
        "kick=0 m/s",
        "--state",
        "v=3 m/s",
        "--state",
        "y=0 m",
        "--steps",
        "3",
        "--samples",
        "1",
    ];
    assert_eq!(json(&state).1["events"], all["events"]);
}

/// On its gait the climber does every step alike, and rises in each by what the gait's measure says.
#[test]
fn a_gait_goes_on_and_on() {
    let (_, gait) = json(&["gait", "prescribed_length"]);
    let (code, all) = json(&["simulate", "prescribed_length", "--gait", "--steps", "4", "--samples", "800"]);
    assert_eq!(code, 0);
    let duration = number(&gait, "/duration");
    for (i, event) in all["events"].as_array().unwrap().iter().enumerate() {
        let sign = if i % 2 == 0 { -1.0 } else { 1.0 };
        assert_abs_diff_eq!(number(event, "/time"), (i + 1) as f64 * duration, epsilon = 1e-10);
        // No symmetry is applied: left and right alternate.
        let q = number(&gait, "/section/q_theta");
        assert_abs_diff_eq!(number(event, "/state_after/q_theta"), sign * q, epsilon = 1e-9);
        assert_eq!(number(event, "/memory/n"), (i + 1) as f64);
    }
    let height = *list(&all, "/path/y").last().unwrap();
    assert_abs_diff_eq!(height, 4.0 * number(&gait, "/measures/step_length"), epsilon = 1e-7);
    let (v_y, t) = (list(&all, "/samples/observed/v_y"), list(&all, "/samples/t"));
    assert_eq!(v_y.len(), t.len());
    let (_, one) =
        json(&["simulate", "prescribed_length", "--gait", "--steps", "1", "--show", "m*g", "--samples", "3"]);
    let shown = one["samples"]["observed"].as_object().unwrap();
    assert_eq!(shown.len(), 1);
    assert_abs_diff_eq!(shown["m*g"][1].as_f64().unwrap(), 2.6 * 9.81, epsilon = 1e-12);
}

/// Rates of a model whose mass matrix vanishes at dead centres are numbers, also there.
#[test]
fn rates_are_finite_at_dead_centres() {
    let (code, all) = json(&["simulate", "self_exciting", "--gait", "--steps", "2", "--samples", "100"]);
    assert_eq!((code, all["method"].as_str()), (0, Some("radau5")));
    for rates in all["samples"]["rate"].as_object().unwrap().values() {
        assert!(rates.as_array().unwrap().iter().all(Value::is_number), "{rates}");
    }
}

/// This one swings too far in its second step to get back to the angle where the next one would begin.
const FALLS: [&str; 4] = ["simulate", "angle_switched", "--from", "p_theta=3 m/s"];

#[test]
fn a_run_that_stops_says_so() {
    let (code, all) = json(&[&FALLS[..], &["--samples", "20"]].concat());
    assert_eq!((code, all["status"].as_str()), (2, Some("no_event")), "{:#}", all["message"]);
    assert_eq!((&all["stopped"]["reason"], all["events"].as_array().unwrap().len()), (&all["status"], 2));
    assert_eq!(number(&all, "/stopped/time"), number(&all, "/duration"));
    assert_abs_diff_eq!(number(&all, "/duration"), number(&all, "/events/1/time") + 100.0, epsilon = 1e-9);
    assert!(list(&all, "/samples/t").len() >= 20);
    let (code, out, _) = text(&[&FALLS[..], &["--samples", "20"]].concat());
    assert!(code == 2 && out.contains("after 2 of 10 steps") && out.contains("help: see it fall: --time 4s"), "{out}");
    // A time that is asked for ends the same run as it should.
    let (code, seen) = json(&[&FALLS[..], &["--time", "4s"]].concat());
    assert_eq!((code, number(&seen, "/duration"), &seen["stopped"]), (0, 4.0, &Value::Null));
    assert_eq!(seen["events"], all["events"]);
    // The ball comes to rest after 2 v/g/(1 - e).
    let rest =
        ["simulate", "bouncing_ball", "--set", "kick=0 m/s", "--set", "e=0.8", "--from", "v=3 m/s", "--steps", "1000"];
    let (code, all) = json(&rest);
    assert_eq!((code, all["status"].as_str()), (2, Some("zeno")));
    assert_abs_diff_eq!(number(&all, "/stopped/time"), 2.0 * 3.0 / 9.81 / 0.2, epsilon = 1e-7);
}

/// A ball below the floor, or on it and on its way down, falls on: which guard it has passed, and by how much, is said.
#[test]
fn a_start_beyond_a_guard_is_said() {
    let warned = |flags: &[&str]| {
        let (_, all) = json(&[&["simulate"], flags, &["--time", "1s", "--samples", "2"]].concat());
        all["warnings"].as_array().unwrap().iter().map(|w| w.as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    let below = warned(&["bouncing_ball", "--state", "y=-10 cm", "--state", "v=0 m/s"]);
    assert_eq!(below.len(), 1, "{below:?}");
    for part in ["beyond the guard of `impact`", "`y` is -0.1 m there", "start where it is positive"] {
        assert!(below[0].contains(part), "no {part} in {below:?}");
    }
    let through = warned(&["bouncing_ball", "--from", "v=-2 m/s"]);
    assert!(through.len() == 1 && through[0].contains("`y` is zero there and its rate is -2 m/s"), "{through:?}");
    // The runner's apex is behind it, too, but is a surface, where nothing changes.
    assert_eq!(warned(&["bouncing_ball", "--from", "v=2 m/s"]), Vec::<String>::new());
    assert_eq!(warned(&["slip_runner", "--from", "y=1 m"]), Vec::<String>::new());
    assert!(warned(&["slip_runner", "--from", "y=10 cm"])[0].contains("guard of `touch_down`"));
}

/// No gait, nothing to follow.
#[test]
fn a_gait_that_is_not_there_is_said() {
    let run = ["simulate", "angle_switched", "--gait", "--guess", "p_theta=-50 m/s"];
    let (code, all) = json(&run);
    assert_eq!(
        (code, all["status"].as_str(), &all["samples"]),
        (2, Some("no_gait"), &Value::Null),
        "{:#}",
        all["message"]
    );
    let (code, out, _) = text(&run);
    assert!(code == 2 && out.contains("help: start elsewhere"), "{out}");
}

#[test]
fn people_see_a_table_of_steps() {
    let (code, out, _) = text(&["simulate", "prescribed_length", "--gait", "--steps", "100", "--samples", "100"]);
    assert_eq!(code, 0);
    let rows: Vec<&str> = out.lines().filter(|line| line.contains(" step ")).collect();
    assert!(out.contains("completed: 100 steps in 16.67 s") && out.contains("...") && out.contains("q_theta"), "{out}");
    assert!(rows.len() < 60 && rows.iter().any(|row| row.contains(" 100 ")), "{out}");
}

#[test]
fn files_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (out, events, plot, way) = (path("run.csv"), path("steps.csv"), path("run.svg"), path("path.svg"));
    let run = ["simulate", "prescribed_length", "--gait", "--steps", "2", "--samples", "50"];
    let files = ["--out", &out, "--events", &events, "--plot", &plot, "--plot-path", &way];
    let (code, answer, errors) = text(&[&run[..], &files].concat());
    assert_eq!(code, 0, "{answer}{errors}");
    let samples = fs::read_to_string(&out).unwrap();
    let mut lines = samples.lines();
    assert!(lines.next().unwrap().starts_with("# {"));
    let header = lines.next().unwrap();
    for column in
        ["t [s]", "mode", "n", "q_theta [rad]", "dot(p_theta) [m/s^2]", "rho_a [N]", "v_y [m/s]", "body_y [m]"]
    {
        assert!(header.split(',').any(|name| name == column), "{column} is not in {header}");
    }
    let (_, all) = json(&run);
    assert_eq!(lines.count(), list(&all, "/samples/t").len());
    let steps = fs::read_to_string(&events).unwrap();
    assert_eq!(steps.lines().count(), 4);
    assert!(steps.contains("q_theta_after") && steps.contains("transversality"), "{steps}");
    assert_eq!(all["events"][0]["transversality_unit"], "1");
    let (plot, way) = (fs::read_to_string(&plot).unwrap(), fs::read_to_string(&way).unwrap());
    assert!(plot.starts_with("<svg") && plot.contains("rho_a") && way.contains("foot"));
    // Any of them does the run again.
    let again = gaitc(&["run", &events, "--json"]);
    assert_eq!(serde_json::from_slice::<Value>(&again.stdout).unwrap(), all);
}

/// Arguments after `simulate`, and what stderr has to contain.
const WRONG: &[(&[&str], &[&str])] = &[
    (&["bouncing_bal"], &["did you mean `bouncing_ball`?"]),
    (&["prescribed_length", "--from", "q_teta=1 deg"], &["no section coordinate is named `q_teta`", "`q_theta`"]),
    (&["prescribed_length", "--from", "q_theta=1 m"], &["1 m", "deg"]),
    (&["prescribed_length", "--from", "q_theta=0/0 deg"], &["0/0"]),
    (&["prescribed_length", "--from", "q_theta=nan"], &["nan"]),
    (&["prescribed_length", "--from", "q_theta=1 deg", "--from", "q_theta=2 deg"], &["given twice"]),
    (&["prescribed_length", "--from", "q_theta=1 deg", "--gait"], &["--gait"]),
    (&["prescribed_length", "--guess", "q_theta=1 deg"], &["--guess", "add --gait"]),
    (&["prescribed_length", "--state", "q_theta=1 deg"], &["`p_theta` missing", "--state 'p_theta=...'"]),
    (&["prescribed_length", "--state", "r=1 m"], &["no state is named `r`", "q_theta"]),
    (&["prescribed_length", "--mode", "stance"], &["--state"]),
    (
        &["prescribed_length", "--state", "q_theta=1 deg", "--state", "p_theta=0 m/s", "--mode", "stanse"],
        &["no mode is named `stanse`", "did you mean `stance`?"],
    ),
    (
        &["prescribed_length", "--state", "q_theta=1 deg", "--state", "p_theta=0 m/s", "--tau", "-1 s"],
        &["--tau", "not negative"],
    ),
    (&["slip_runner", "--mode", "flight", "--state", "x=1 m"], &["mode `flight` has no state `x`"]),
    (&["prescribed_length", "--memory", "n=1.5"], &["--memory n=1.5", "whole number"]),
    (&["prescribed_length", "--memory", "k=1"], &["no memory is named `k`", "choose from: n"]),
    (&["prescribed_length", "--gait", "--memory", "n=1"], &["--memory", "--gait"]),
    (&["prescribed_length", "--steps", "0"], &["--steps 0"]),
    (&["prescribed_length", "--steps", "-1"], &["--steps"]),
    (&["prescribed_length", "--steps", "1", "--time", "1 s"], &["--time"]),
    (&["prescribed_length", "--time", "1 m"], &["1 m", "s"]),
    (&["prescribed_length", "--time", "2"], &["2"]),
    (&["prescribed_length", "--time", "0 s"], &["--time 0 s", "positive"]),
    (&["prescribed_length", "--interval", "-1 ms"], &["--interval -1 ms", "positive"]),
    (&["prescribed_length", "--interval", "1e-12 s"], &["more than 10000000 values", "--interval 10ms"]),
    (&["prescribed_length", "--time", "1 s", "--interval", "1e-9 s"], &["more than 10000000 values"]),
    (&["prescribed_length", "--samples", "0"], &["--samples 0"]),
    (&["prescribed_length", "--samples", "1000000000"], &["more than 10000000 values"]),
    (&["prescribed_length", "--samples", "5", "--interval", "1 ms"], &["--interval"]),
    (&["prescribed_length", "--show", "v_z"], &["v_z"]),
    (&["prescribed_length", "--show", "v_x + r"], &["v_x + r"]),
    (&["prescribed_length", "--method", "radau3"], &["radau3"]),
    (&["self_exciting", "--method", "explicit"], &["mass matrix"]),
    (&["prescribed_length", "--out", "run.txt"], &["--out", ".csv"]),
    (&["prescribed_length", "--out", "/nonexistent/run.csv"], &["--out: cannot write `/nonexistent/run.csv`", "help"]),
    (&["prescribed_length", "--out", "a.csv", "--events", "a.csv"], &["name the same file"]),
    (&["prescribed_length", "--out", "a.csv", "--events", "./a.csv"], &["name the same file"]),
    (&["prescribed_length", "--plot", "run.gif"], &["--plot", ".svg"]),
];

#[test]
fn wrong_input_is_explained() {
    for (args, parts) in WRONG {
        let (code, _, stderr) = text(&[&["simulate"], *args].concat());
        assert_eq!(code, 1, "{args:?}: {stderr}");
        for part in *parts {
            assert!(stderr.contains(part), "{args:?} does not say {part:?}:\n{stderr}");
        }
        assert!(!stderr.contains("panicked"), "{args:?}:\n{stderr}");
    }
}
