//! Parts: what a spec takes from other files.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed unwrap fails the test

use gaitc_compiler::diagnostic::render;
use gaitc_compiler::front::{Library, Parsed, parse_file, parse_text, parse_with};
use gaitc_compiler::ir::Model;
use gaitc_compiler::ir::canonical::{canonical, fingerprint};
use std::path::{Path, PathBuf};

/// A falling ball; `{use}` and `{parameters}` and `{drag}` stand for what a test adds.
const SPEC: &str = r#"
spec = 1
name = "fall"
{use}
[parameters]
g = "9.81 m/s^2"
{parameters}
[state]
x = { unit = "m" }
v = { unit = "m/s" }
[modes.fall.flow]
x = "v"
v = "-g - ({drag})"
[transitions.bounce]
from = "fall"
to = "fall"
guard = "x"
direction = "falling"
reset = { x = "x", v = "-v" }
[section]
after = "bounce"
coordinates = ["v"]
embed = { x = "0" }
start = { v = "2 m/s" }
"#;

/// Its parameter is called as a unit.
const DRAG: &str = r#"
spec = 1
[parameters]
m = { value = "0.1 1/m", range = ["0 1/m", "1 1/m"], doc = "drag" }
[let]
drag = "square(v)*m"
[functions]
square = { args = ["m"], expr = "m*abs(m)" }
[measures]
peak = { expr = "cycle_max(drag)", unit = "m/s^2" }
[problems.gentle]
minimize = "peak"
vary = { m = ["0.1 1/m", "0.9 1/m"] }
subject_to = ["peak <= 5 [m/s^2]", "peak <= 9 m/s^2", "m <= 1 m^-1"]
"#;

fn spec(uses: &str, parameters: &str, drag: &str) -> String {
    SPEC.replace("{use}", uses).replace("{parameters}", parameters).replace("{drag}", drag)
}

fn parse(text: &str, parts: &[(&str, &str)]) -> Parsed {
    parse_with(Path::new("specs/fall.toml"), text, Library::Texts(parts))
}

fn accepted(parsed: Parsed) -> Model {
    assert_eq!(render(&parsed.diagnostics, &parsed.sources, false), "");
    parsed.model.unwrap()
}

fn names(model: &Model) -> Vec<&str> {
    model.parameters.iter().map(|parameter| parameter.name.as_str()).collect()
}

fn specs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs")
}

/// A spec with a part is the spec in which the part's tables stand behind its own.
#[test]
fn a_part_is_as_if_it_were_written_into_the_spec() {
    let parsed = parse(&spec("use = [\"drag.toml\"]", "", "drag"), &[("drag.toml", DRAG)]);
    assert_eq!(parsed.parts, ["drag.toml"]);
    let with = accepted(parsed);
    let (parameters, rest) = DRAG.split_once("[let]").unwrap();
    let parameters = parameters.split_once("[parameters]").unwrap().1;
    let text = format!("{}\n[let]{rest}", spec("", parameters, "drag"));
    let without = accepted(parse_text(Path::new("fall.toml"), &text));
    assert_eq!(canonical(&with), canonical(&without));
    assert_eq!(format!("{:?}", with.parameters), format!("{:?}", without.parameters));
    assert_eq!(format!("{:?}", with.problems), format!("{:?}", without.problems));
}

#[test]
fn equations_of_parts_count_in_the_fingerprint_and_values_do_not() {
    let print =
        |drag: &str| fingerprint(&accepted(parse(&spec("use = [\"drag.toml\"]", "", "drag"), &[("drag.toml", drag)])));
    assert_eq!(print(DRAG), print(&DRAG.replace("0.1 1/m", "0.2 1/m").replace("\"drag\"", "\"air\"")));
    assert_ne!(print(DRAG), print(&DRAG.replace("square(v)*m", "2*square(v)*m")));
}

#[test]
fn a_part_can_be_there_twice_under_other_names() {
    let uses = r#"
[use]
air = "drag.toml"
[use.water]
part = "drag.toml"
rename = { m = "c_w", drag = "drag_w", square = "square_w", peak = "peak_w", gentle = "gentle_w" }
"#;
    // A problem is not something that an expression can name.
    let parsed = parse(&spec(uses, "", "drag + drag_w"), &[("drag.toml", DRAG)]);
    let text = render(&parsed.diagnostics, &parsed.sources, false);
    assert!(text.contains("nothing in the part `drag.toml` is named `gentle`"), "{text}");
    let drag = DRAG.split_once("[problems").unwrap().0;
    let uses = uses.replace(", gentle = \"gentle_w\"", "");
    let model = accepted(parse(&spec(&uses, "", "drag + drag_w"), &[("drag.toml", drag)]));
    assert_eq!(names(&model), ["g", "m", "c_w"]);
    assert_eq!(model.measures.iter().map(|measure| measure.name.as_str()).collect::<Vec<_>>(), ["peak", "peak_w"]);
    assert_ne!(model.measures[0].expr, model.measures[1].expr);
}

/// Everything in the part goes by the new name: expressions, a function's arguments left alone; what problems vary and
/// bound; and the texts that people see, units left alone.
#[test]
fn renaming_reaches_every_place() {
    let uses = "[use.air]\npart = \"drag.toml\"\nrename = { m = \"peak\", peak = \"m\" }";
    let model = accepted(parse(&spec(uses, "", "drag"), &[("drag.toml", DRAG)]));
    assert_eq!(names(&model), ["g", "peak"]);
    assert_eq!(model.measures[0].name, "m");
    let problem = &model.problems[0];
    assert_eq!((problem.objective_text.as_str(), problem.vary[0].parameter), ("m", 1));
    let texts: Vec<&str> = problem.constraints.iter().map(|constraint| constraint.text.as_str()).collect();
    assert_eq!(texts, ["m <= 5 [m/s^2]", "m <= 9 m/s^2", "peak <= 1 m^-1"]);
    // The equations are the same as those of the part as it is.
    let plain = accepted(parse(&spec("use = [\"drag.toml\"]", "", "drag"), &[("drag.toml", DRAG)]));
    assert_eq!((model.graph.nodes(), &model.modes[0].flow), (plain.graph.nodes(), &plain.modes[0].flow));
}

/// What a problem is robust over goes by the new name, also where nothing else names it.
#[test]
fn renaming_reaches_what_a_problem_is_robust_over() {
    let part = "spec = 1\n[measures]\npeak = { expr = \"cycle_max(v)\", unit = \"m/s\" }\n[problems.p]\nminimize = \"peak\"\n\
                vary = { g = [\"9 m/s^2\", \"10 m/s^2\"] }\nrobust = { load = [\"0.1 1/m\", \"0.9 1/m\"] }\n";
    let uses = "[use.air]\npart = \"part.toml\"\nrename = { load = \"k\" }";
    let model = accepted(parse(&spec(uses, "k = \"0.2 1/m\"", "k*v^2"), &[("part.toml", part)]));
    let robust = &model.problems[0].robust;
    assert_eq!(robust.iter().map(|u| model.parameters[u.parameter].name.as_str()).collect::<Vec<_>>(), ["k"]);
}

#[test]
fn names_that_a_part_takes_from_its_user_can_be_renamed() {
    let drag = "spec = 1\n[let]\ndrag = \"speed*abs(speed)*g/viscosity^2\"\n";
    let uses = "[use.air]\npart = \"drag.toml\"\nrename = { speed = \"v\", viscosity = \"nu\" }";
    let model = accepted(parse(&spec(uses, "nu = \"3 m/s\"", "drag"), &[("drag.toml", drag)]));
    assert_eq!(names(&model), ["g", "nu"]);
}

#[test]
fn a_parameter_of_a_part_is_set_or_fixed_by_its_user() {
    let uses = |what: &str| format!("[use.air]\npart = \"drag.toml\"\n{what}");
    let parts = [("drag.toml", DRAG.split_once("[measures]").unwrap().0)];
    let set = accepted(parse(&spec(&uses("set = { m = \"0.3 1/m\" }"), "", "drag"), &parts));
    let plain = accepted(parse(&spec(&uses(""), "", "drag"), &parts));
    assert_eq!(fingerprint(&set), fingerprint(&plain), "a value is data");
    assert_eq!((set.parameters[1].value, set.parameters[1].range), (0.3, plain.parameters[1].range));
    for (fix, parameters) in [("0.3 1/m", &["g"][..]), ("3/(10*l)", &["g", "l"]), ("0.3 [1/m]", &["g"])] {
        let uses = uses(&format!("fix = {{ m = \"{fix}\" }}"));
        let parameter = if fix.contains('l') { "l = \"1 m\"" } else { "" };
        let fixed = accepted(parse(&spec(&uses, parameter, "drag"), &parts));
        assert_eq!(names(&fixed), parameters);
    }
    // What takes the place is of the user's world: its names are not renamed.
    let both = uses("rename = { m = \"k\" }\nfix = { m = \"2*m\" }");
    let model = accepted(parse(&spec(&both, "m = \"1 1/m\"", "drag"), &parts));
    assert_eq!(names(&model), ["g", "m"]);
}

#[test]
fn parts_use_parts_and_what_two_need_is_taken_in_once() {
    let air = "spec = 1\n[parameters]\nrho = \"1 kg/m^3\"\n";
    let lift = "spec = 1\nuse = [\"sub/air.toml\"]\n[let]\nlift = \"rho*g/(1 [kg/m^3])\"\n";
    let drag = "spec = 1\nuse = [\"sub/air.toml\"]\n[let]\ndrag = \"rho*g/(2 [kg/m^3])\"\n";
    let parts = [("sub/lift.toml", lift), ("sub/drag.toml", drag), ("sub/air.toml", air)];
    let text = spec("use = [\"sub/lift.toml\", \"sub/drag.toml\"]", "", "drag - lift");
    let parsed = parse(&text, &parts);
    assert_eq!(parsed.parts, ["sub/lift.toml", "sub/air.toml", "sub/drag.toml"]);
    assert_eq!(names(&accepted(parsed)), ["g", "rho"]);
}

#[test]
fn a_part_brings_states_with_their_flow() {
    let lag =
        "spec = 1\n[parameters]\nT = \"1 s\"\n[state]\ny = { unit = \"m/s^2\" }\n[modes.fall.flow]\ny = \"-y/T\"\n";
    let text = spec("use = [\"lag.toml\"]", "", "y").replace("v = \"-v\"", "v = \"-v\", y = \"y\"");
    let text = text.replace("embed = { x = \"0\"", "embed = { x = \"0\", y = \"0\"");
    let model = accepted(parse(&text, &[("lag.toml", lag)]));
    assert_eq!(model.states.iter().map(|state| state.name.as_str()).collect::<Vec<_>>(), ["x", "v", "y"]);
}

#[test]
fn more_parts_than_can_be_are_refused_in_time() {
    // Each part takes in the next one twice under other names: 2^40 parts.
    let text = |i: usize| {
        let next = format!("part = \"p{}.toml\"\n", i + 1);
        format!("spec = 1\n[use.a]\n{next}set = {{ c = \"1\" }}\n[use.b]\n{next}rename = {{ c = \"c{i}\" }}\n")
    };
    let texts: Vec<(String, String)> = (0..40).map(|i| (format!("p{i}.toml"), text(i))).collect();
    let mut parts: Vec<(&str, &str)> = texts.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
    parts.push(("p40.toml", "spec = 1\n[parameters]\nc = \"1\"\n"));
    let parsed = parse(&spec("use = [\"p0.toml\"]", "", "0"), &parts);
    let text = render(&parsed.diagnostics, &parsed.sources, false);
    assert!(text.contains("error[E0009]: a spec can have 64 parts"), "{text}");
}

/// The motor is one line of the spec, and so is all that its numbers mean.
#[test]
fn swapping_the_actuator_is_a_change_of_one_line() {
    for (spec, suffix) in [("self_exciting", "_planar"), ("self_exciting_rack", "_planar"), ("power_stroke", "")] {
        let path = specs().join(format!("{spec}.toml"));
        let text = std::fs::read_to_string(&path).unwrap();
        let motor = accepted(parse_file(&path).unwrap());
        let (from, to) = (format!("parts/dc_motor{suffix}.toml"), format!("parts/hill_muscle{suffix}.toml"));
        assert_eq!(text.lines().filter(|line| !line.starts_with('#') && line.contains(&from)).count(), 1);
        let muscle = accepted(parse_with(&path, &text.replace(&from, &to), Library::Folder(&specs())));
        assert!(names(&motor).contains(&"tau_stall") && !names(&muscle).contains(&"tau_stall"));
        assert!(names(&muscle).contains(&"F_0"));
        assert_eq!(motor.problems[0].name, muscle.problems[0].name);
    }
}

/// The climber with a muscle is the one with a motor but for that line, its name and its title.
#[test]
fn exchanged_actuators_leave_the_climber_alone() {
    let text = |name: &str| std::fs::read_to_string(specs().join(name)).unwrap();
    let (motor, muscle) = (text("power_stroke.toml"), text("power_stroke_muscle.toml"));
    assert_eq!(motor.lines().count(), muscle.lines().count());
    let differ = motor.lines().zip(muscle.lines()).filter(|(a, b)| a != b).map(|(a, _)| a);
    let keys: Vec<&str> = differ.filter_map(|line| line.split_whitespace().next()).collect();
    assert_eq!(keys, ["name", "title", "motor"]);
}

/// The rack takes the leg's own coordinates, and wants no more of the climber than that.
#[test]
fn the_rack_takes_either_motor() {
    for motor in ["dc_motor", "hill_muscle"] {
        let text = r#"
spec = 1
name = "rack"
use = ["parts/constant_voltage.toml", "parts/MOTOR.toml", "parts/rack.toml"]
[parameters]
l_b = "50 cm"
l_s = "13 cm"
m   = "2.6 kg"
g   = "9.81 m/s^2"
[state]
q_r = { unit = "m" }
p_r = { unit = "m/s" }
[let]
rho_a = "actuator_force"
[modes.stance.flow]
q_r = "p_r"
p_r = "g - rho_a/m"
[transitions.step]
from = "stance"
to = "stance"
guard = "q_r - l_b"
direction = "falling"
reset = { q_r = "l_b + l_s", p_r = "p_r" }
[section]
after = "step"
coordinates = ["p_r"]
embed = { q_r = "l_b + l_s" }
start = { p_r = "-1 m/s" }
[measures]
climb_speed = { expr = "mean(-p_r)", unit = "m/s" }
"#;
        let text = text.replace("MOTOR", motor);
        accepted(parse_with(Path::new("rack.toml"), &text, Library::Folder(&specs())));
    }
}
