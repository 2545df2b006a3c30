//! Drawings of specs: what stands still does so, by the equations of motion; parts bring drawings and published numbers.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed unwrap fails the test

use gaitc_compiler::diagnostic::render;
use gaitc_compiler::front::{Library, Observations, Parsed, parse_file, parse_with};
use gaitc_compiler::ir::eval::{Environment, value};
use gaitc_compiler::ir::{Drawing, Joint, Model, Node, Point, PublishedOf};
use std::path::{Path, PathBuf};

/// All specs of the project.
fn specs() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs");
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<_> =
        entries.filter(|path| path.extension().is_some_and(|extension| extension == "toml")).collect();
    paths.sort();
    paths
}

fn whole(parsed: Parsed) -> (Model, Observations) {
    assert_eq!(render(&parsed.diagnostics, &parsed.sources, false), "");
    (parsed.model.unwrap(), parsed.observations.unwrap())
}

/// A point of a run: any state, with the rates that the equations of motion give it there; where a row of the mass matrix
/// determines a rate, any number: no velocity may depend on it.
struct Sample {
    x: Vec<f64>,
    k: Vec<f64>,
    tau: f64,
    memory: Vec<f64>,
}

fn sample(model: &Model, mode: usize, n: u32) -> Sample {
    let number = |i: usize| 0.35 + 0.3 * (1.7 * i as f64 + 0.9 * f64::from(n)).sin();
    let mode = &model.modes[mode];
    let there = |i: usize, value: f64| if mode.has_state[i] { value } else { 0.0 };
    let x: Vec<f64> = (0..model.states.len()).map(|i| there(i, number(i))).collect();
    let memory: Vec<f64> = model.memory.iter().map(|_| f64::from(n % 2)).collect();
    let parameters: Vec<f64> = model.parameters.iter().map(|parameter| parameter.value).collect();
    let tau = 0.02 * f64::from(n);
    // Switches in order: each may need those before it.
    let mut branch = Vec::new();
    for switch in &model.switches {
        let at = environment(&x, &parameters, &memory, &branch, tau);
        let on = value(&model.graph, switch.expr, &at) >= 0.0;
        branch.push(on);
    }
    let at = environment(&x, &parameters, &memory, &branch, tau);
    let identity = |i: usize| {
        mode.mass.as_ref().is_none_or(|mass| {
            let one = |(j, &entry): (usize, _)| model.graph.constant_value(entry) == Some(f64::from(u8::from(i == j)));
            mass[i].iter().enumerate().all(one)
        })
    };
    let rate = |i: usize| if identity(i) { value(&model.graph, mode.flow[i], &at) } else { 7.0 * number(i + 3) };
    let k = (0..x.len()).map(|i| there(i, rate(i))).collect();
    Sample { x, k, tau, memory }
}

fn environment<'a>(
    states: &'a [f64],
    parameters: &'a [f64],
    memory: &'a [f64],
    branch: &'a [bool],
    tau: f64,
) -> Environment<'a> {
    Environment { states, parameters, memory, branch, tau, ..Environment::default() }
}

fn planar(observations: &Observations) -> &Drawing {
    observations.drawing().unwrap()
}

/// A point that is held has the velocity zero in the world: that of the body and its own, seen from the body, cancel. The first
/// is what the spec says its speeds are, the second follows from its equations of motion: a slip in either shows here.
#[test]
fn points_that_are_held_stand_still_at_any_state() {
    let (mut held, mut others) = (0, 0);
    for path in specs() {
        let (model, mut observations) = whole(parse_file(&path).unwrap());
        let drawing = planar(&observations).clone();
        let plane = drawing.plane.unwrap_or_else(|| panic!("{} is not drawn", path.display()));
        let parameters: Vec<f64> = model.parameters.iter().map(|parameter| parameter.value).collect();
        for point in &plane.points {
            let mut moves = 0;
            for axis in 0..2 {
                let (at, velocity) = (&point.at[axis].text, &plane.velocity[axis].text);
                let text = [format!("dot({at})"), velocity.clone(), format!("dot({at}) + ({velocity})")];
                let chosen = text.map(|text| observations.observe(&text).unwrap());
                let mut observer = observations.observer(&chosen, &parameters);
                for (mode, n) in (0..model.modes.len()).flat_map(|mode| (0..9).map(move |n| (mode, n))) {
                    let Sample { x, k, tau, memory } = sample(&model, mode, n);
                    let values = observer.at(&Point { x: &x, k: &k, tau, t: tau, memory: &memory });
                    let [own, body, sum] = values[..] else { panic!() };
                    let still = sum.abs() <= 1e-13 * (1.0 + own.abs() + body.abs());
                    moves += usize::from(point.modes[mode] && !still);
                    assert!(!point.held || !point.modes[mode] || still, "{}: {} {sum}", path.display(), point.name);
                }
            }
            assert!(point.held || moves > 0, "{}: {} could be held", path.display(), point.name);
            if point.held { held += 1 } else { others += 1 }
        }
    }
    assert_eq!((held, others), (14, 4));
}

/// A panel has curves of one dimension, and no curve of a spec's own panels is constant.
#[test]
fn panels_show_what_changes() {
    for path in specs() {
        let (model, observations) = whole(parse_file(&path).unwrap());
        let panels = &planar(&observations).panels;
        assert!(!panels.is_empty(), "{}", path.display());
        for curve in panels.iter().flatten() {
            let changes = observations.graph().depends(&[curve.expr], |symbol| {
                use gaitc_compiler::ir::Symbol::{Rate, State, Tau};
                matches!(symbol, State(_) | Rate(_) | Tau)
            });
            assert!(changes, "{}: {}", model.name, curve.name);
        }
        for panel in panels {
            assert!(panel.iter().all(|curve| curve.dimension == panel[0].dimension), "{}", model.name);
        }
    }
}

const WALKER: &str = r#"
spec = 1
name = "walker"
use = [USE]
[parameters]
speed = "1 m/s"
[state]
s = { unit = "m" }
[modes.walk.flow]
s = "speed"
[transitions.step]
from = "walk"
to = "walk"
guard = "s - 1 [m]"
direction = "rising"
[transitions.step.reset]
s = "0"
[section]
after = "step"
coordinates = []
[section.embed]
s = "0"
[measures]
pace = { expr = "duration", unit = "s" }
OWN
"#;

fn walker(uses: &str, own: &str, parts: &[(&str, &str)]) -> Parsed {
    let text = WALKER.replace("USE", uses).replace("OWN", own);
    parse_with(Path::new("walker.toml"), &text, Library::Texts(parts))
}

const LEGS: (&str, &str) = (
    "parts/legs.toml",
    r#"
spec = 1
[drawing]
velocity = ["speed", "0"]
links = [["body", "foot"]]
panels = [["x"]]
[drawing.points]
foot = { at = ["-x", "-1 [m]"], held = true }
[published.book]
source = "a book"
set = { speed = "2 m/s" }
measures = { pace = "0.5 s" }
"#,
);

/// A walker that takes the legs, whose `x` is its `s`.
fn on_legs(own: &str) -> Parsed {
    let uses = "[use.legs]\npart = \"parts/legs.toml\"\nrename = { x = \"s\" }\n";
    let text = WALKER.replace("use = [USE]", "").replace("OWN", own) + uses;
    parse_with(Path::new("walker.toml"), &text, Library::Texts(&[LEGS]))
}

#[test]
fn a_part_brings_a_drawing_and_published_numbers() {
    let clash = on_legs("[drawing]\nvelocity = [\"speed\", 0]\n");
    let messages: Vec<_> = clash.diagnostics.iter().map(|d| d.message.as_str()).collect();
    assert_eq!(messages, ["two files say how the body moves in the drawing"]);
    let (model, observations) = whole(on_legs("[drawing]\npanels = [[\"speed\"]]\n"));
    let drawing = planar(&observations);
    let panels: Vec<&str> = drawing.panels.iter().flatten().map(|curve| curve.name.as_str()).collect();
    assert_eq!(panels, ["speed", "s"]);
    let plane = drawing.plane.as_ref().unwrap();
    assert_eq!(plane.links, [[Joint::Body, Joint::Point(0)]]);
    assert_eq!((plane.points[0].at[0].text.as_str(), plane.points[0].held), ("-s", true));
    let velocity = observations.graph().node(plane.velocity[0].expr);
    assert!(matches!(velocity, Node::Symbol(_)));
    let book = &model.published[0];
    assert_eq!((book.name.as_str(), book.source.as_str(), book.set.as_slice()), ("book", "a book", &[(0, 2.0)][..]));
    assert_eq!((book.numbers[0].of, book.numbers[0].value), (PublishedOf::Measure(0), 0.5));
}

#[test]
fn what_two_files_publish_under_one_name_clashes() {
    let own = "[published.book]\nsource = \"another book\"\nmeasures = { pace = \"1 s\" }";
    let parsed = walker("\"parts/legs.toml\"", &format!("[let]\nx = \"s\"\n{own}"), &[LEGS]);
    let messages: Vec<_> = parsed.diagnostics.iter().map(|d| d.message.as_str()).collect();
    assert_eq!(messages, ["two publications are named `book`"]);
}

#[test]
fn drawings_and_published_numbers_leave_no_trace_in_the_equations() {
    use gaitc_compiler::ir::canonical::canonical;
    let (plain, _) = whole(walker("", "", &[]));
    let (drawn, _) = whole(walker("\"parts/legs.toml\"", "[let]\nx = \"s\"", &[LEGS]));
    assert_eq!(canonical(&drawn), canonical(&plain));
    assert_eq!(drawn.graph.nodes(), plain.graph.nodes());
}
