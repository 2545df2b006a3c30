//! What equations of a spec become in the graph.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed unwrap fails the test

use gaitc_compiler::diagnostic::render;
use gaitc_compiler::front::parse_text;
use gaitc_compiler::ir::canonical::fingerprint;
use gaitc_compiler::ir::eval::{Environment, value};
use gaitc_compiler::ir::{Direction, FunctionalKind, Model, Node, NodeId, Sense, Symbol, Uncertain};
use std::path::Path;

/// A node as text.
fn show(model: &Model, id: NodeId) -> String {
    let of = |id| show(model, id);
    match model.graph.node(id) {
        Node::Constant(bits) => format!("{}", f64::from_bits(bits)),
        Node::Symbol(symbol) => match symbol {
            Symbol::State(i) => model.states[i].name.clone(),
            Symbol::Rate(i) => format!("dot {}", model.states[i].name),
            Symbol::Parameter(i) => model.parameters[i].name.clone(),
            Symbol::Memory(i) => model.memory[i].name.clone(),
            Symbol::Measure(i) => model.measures[i].name.clone(),
            Symbol::Functional(i) => {
                let functional = &model.functionals[i];
                format!("{:?}<{}>", functional.kind, of(functional.expr))
            }
            other => format!("{other:?}").to_lowercase(),
        },
        Node::Unary(op, a) => format!("{}({})", format!("{op:?}").to_lowercase(), of(a)),
        Node::Binary(op, a, b) => format!("{}({}, {})", format!("{op:?}").to_lowercase(), of(a), of(b)),
        Node::Select { switch, then, otherwise } => format!("select(s{switch}, {}, {})", of(then), of(otherwise)),
        Node::Choose { margin, then, otherwise } => {
            format!("choose({}, {}, {})", of(margin), of(then), of(otherwise))
        }
        Node::Partial(expr, symbol) => {
            let by = match symbol {
                Symbol::State(i) => model.states[i].name.clone(),
                other => format!("{other:?}").to_lowercase(),
            };
            format!("d({}, {by})", of(expr))
        }
    }
}

/// A model with states x [m] and v [m/s], parameters a [m] and k, memory n, and these tables.
fn model(tables: &str, flow_of_v: &str) -> Model {
    let text = format!(
        "spec = 1\nname = \"m\"\n[parameters]\na = \"2 m\"\nk = \"3\"\n[state]\nx = {{ unit = \"m\" }}\n\
         v = {{ unit = \"m/s\" }}\n[memory]\nn = {{ initial = 0 }}\n[modes.go.flow]\nx = \"v\"\nv = \"{flow_of_v}\"\n{tables}"
    );
    let parsed = parse_text(Path::new("m.toml"), &text);
    parsed.model.unwrap_or_else(|| panic!("{}", render(&parsed.diagnostics, &parsed.sources, false)))
}

/// The flow of v, times 1 m/s^2.
fn flow(expr: &str) -> (String, Model) {
    let model = model("", expr);
    (show(&model, model.modes[0].flow[1]), model)
}

#[test]
fn arithmetic_stays_recognisable() {
    let rows = [
        ("v*1*k/1 [s]", "mul(v, k)"),
        ("(v^2 + 0)/a", "div(pow(v, 2), a)"),
        ("-9.81 [m/s^2]*cos(x/a)", "mul(-9.81, cos(div(x, a)))"),
        ("2*3 [m/s^2] + 0", "6"),
        ("90 [deg]*1 [m/s^2]*k", "mul(1.5707963267948966, k)"),
        ("1 [m/s^2]*(-1)^n", "pow(-1, n)"),
        ("sqrt(a*x)/1 [s^2]", "sqrt(mul(a, x))"),
        ("0", "0"),
    ];
    for (expr, expected) in rows {
        assert_eq!(flow(expr).0, expected, "{expr}");
    }
}

#[test]
fn derivatives_are_partial_nodes_through_lets_and_functions() {
    let tables = "[let]\nr = \"f(x)\"\n[functions]\nf = { args = [\"y\"], expr = \"y^2/a\" }\n";
    let model = model(tables, "d(r, x)*d(a*sin(tau*1 [1/s]), tau)*1 [1/s]");
    let expected = "mul(d(div(pow(x, 2), a), x), d(mul(a, sin(tau)), tau))";
    assert_eq!(show(&model, model.modes[0].flow[1]), expected);
}

#[test]
fn conditions_become_switches_and_share_them() {
    let expr = "1 [m/s^2]*(if(x < a, 1, 2) + if(x >= a, 3, 4) + if(a - x > 0, 5, 6) + if(x <= a, 7, 8))";
    let (text, model) = flow(expr);
    let sum = "add(add(add(select(s0, 1, 2), select(s0, 4, 3)), select(s0, 5, 6)), select(s0, 7, 8))";
    assert_eq!(text, sum);
    assert_eq!(model.switches.len(), 1);
    assert_eq!((show(&model, model.switches[0].expr).as_str(), &*model.switches[0].text), ("sub(a, x)", "x < a"));
}

#[test]
fn abs_sign_min_and_max_are_selections() {
    let rows = [
        ("abs(v)/1 [s]", "select(s0, v, neg(v))", "v", "abs(v)"),
        ("sign(v)*1 [m/s^2]", "select(s0, 1, -1)", "v", "sign(v)"),
        ("min(x, a)/1 [s^2]", "select(s0, x, a)", "sub(a, x)", "min(x, a)"),
        ("max(x, 0)/1 [s^2]", "select(s0, x, 0)", "x", "max(x, 0)"),
        ("(abs(v) + abs(-v))/1 [s]", "add(select(s0, v, neg(v)), select(s0, v, neg(v)))", "v", "abs(v)"),
    ];
    for (expr, expected, switch, text) in rows {
        let (shown, model) = flow(expr);
        assert_eq!(shown, expected, "{expr}");
        assert_eq!(show(&model, model.switches[0].expr), switch, "{expr}");
        assert_eq!(model.switches[0].text, text, "{expr}");
        assert_eq!(model.switches.len(), 1, "{expr}");
    }
}

#[test]
fn logic_is_nested_selection() {
    let (and, _) = flow("if(x > 0 and v > 0, 1, 2)*1 [m/s^2]");
    assert_eq!(and, "select(s1, select(s0, 1, 2), 2)");
    let (or, _) = flow("if(x > 0 or v > 0, 1, 2)*1 [m/s^2]");
    assert_eq!(or, "select(s1, 1, select(s0, 1, 2))");
    let (not, _) = flow("if(not (x > 0), 1, 2)*1 [m/s^2]");
    assert_eq!(not, "select(s0, 2, 1)");
    assert_eq!(flow("if(1 < 2, 3, 4)*1 [m/s^2]").0, "3");
}

#[test]
fn rates_follow_the_chain_rule() {
    let rows = [
        ("dot(x)", "m/s", "dot x"),
        ("dot(2*x)", "m/s", "mul(d(mul(2, x), x), dot x)"),
        ("dot(tau)", "1", "1"),
        ("dot(v*tau/a + t/1 [s])", "1/s", "add(add(mul(d(E, v), dot v), d(E, tau)), d(E, time))"),
        ("d(dot(x^2), x)", "m/s", "d(mul(d(pow(x, 2), x), dot x), x)"),
        ("dot(if(x < a, x, n*v*1 [s]))", "m/s", "add(mul(d(E, x), dot x), mul(d(E, v), dot v))"),
    ];
    for (expr, unit, expected) in rows {
        let model = model(&format!("[measures]\ny = {{ expr = \"end({expr})\", unit = \"{unit}\" }}\n"), "0");
        let inner = if expr.contains("if(") { "select(s0, x, mul(n, v))" } else { "add(div(mul(v, tau), a), time)" };
        assert_eq!(show(&model, model.functionals[0].expr), expected.replace('E', inner), "{expr}");
    }
}

#[test]
fn mass_matrices_have_rows_of_the_identity_where_none_is_given() {
    let tables = format!(
        "[modes.go.mass]\nv = {{ v = \"x^2\", x = \"d(a*sin(x/a), x)*v*a\" }}\n{STEP}[section]\nafter = \"step\"\n\
         coordinates = [\"v\"]\n[section.embed]\nx = \"a\"\n[section.start]\nv = \"1 m/s\"\n\
         [measures]\ntop = {{ expr = \"end(x*v)\", unit = \"m^2/s\" }}\n"
    );
    let tables = tables.replace("when =", "also_zero = [\"a - x\", \" x*v \"]\nwhen =");
    let model = model(&tables, "-k*x^2*v/1 [s]");
    let mass = model.modes[0].mass.as_ref().unwrap();
    let shown: Vec<Vec<String>> = mass.iter().map(|row| row.iter().map(|&e| show(&model, e)).collect()).collect();
    assert_eq!(shown, [["1", "0"], ["mul(mul(d(mul(a, sin(div(x, a))), x), v), a)", "pow(x, 2)"]]);
    // The functionals of `also_zero` come after those of measures, and share them.
    let show = |i: usize| format!("{:?} {}", model.functionals[i].kind, show(&model, model.functionals[i].expr));
    let also_zero = &model.transitions[0].also_zero;
    let all: Vec<_> = also_zero.iter().map(|z| (&*z.text, [z.start, z.end, z.rate].map(show))).collect();
    let expected = [
        ("a - x", ["Start sub(a, x)", "End sub(a, x)", "End mul(d(sub(a, x), x), dot x)"]),
        (
            "x*v",
            ["Start mul(x, v)", "End mul(x, v)", "End add(mul(d(mul(x, v), x), dot x), mul(d(mul(x, v), v), dot v))"],
        ),
    ];
    assert_eq!(all, expected.map(|(text, shown)| (text, shown.map(str::to_owned))));
    assert_eq!((also_zero[1].end, also_zero[1].dimension.to_string().as_str()), (0, "m^2 s^-1"));
}

#[test]
fn also_zero_belongs_to_the_equations() {
    let tables = format!(
        "{STEP}[section]\nafter = \"step\"\ncoordinates = [\"v\"]\n[section.embed]\nx = \"a\"\n\
         [section.start]\nv = \"1 m/s\"\n"
    );
    let print = |also_zero: &str| fingerprint(&model(&tables.replace("when =", &format!("{also_zero}when =")), "0"));
    let prints = ["", "also_zero = [\"a - x\"]\n", "also_zero = [\"v\"]\n", "also_zero = [ \"a -  x\"]\n"].map(print);
    assert!(prints[0] != prints[1] && prints[1] != prints[2] && prints[1] == prints[3]);
}

const STEP: &str = "[transitions.step]\nfrom = \"go\"\nto = \"go\"\nguard = \"x - a\"\ndirection = \"rising\"\n\
                    when = \"v > 0 and not (x < 0 or k > 2)\"\n[transitions.step.reset]\nx = \"min(x, a)\"\nv = \"x/1 [s]\"\n";

#[test]
fn transitions_reset_from_pre_values_and_keep_memory() {
    let model = model(STEP, "0");
    let step = &model.transitions[0];
    assert_eq!(show(&model, step.guard), "sub(x, a)");
    assert_eq!((step.guard_text.as_str(), step.guard_dimension.to_string().as_str()), ("x - a", "m"));
    // In `when` nothing is frozen: and is the smaller, or the larger margin.
    let or = "choose(sub(neg(x), sub(k, 2)), neg(x), sub(k, 2))";
    let when = format!("choose(sub(neg({or}), v), v, neg({or}))");
    assert_eq!(show(&model, step.when.unwrap()), when);
    let reset: Vec<_> = step.reset.iter().map(|&node| show(&model, node)).collect();
    assert_eq!(reset, ["select(s0, x, a)", "x"]);
    assert_eq!(show(&model, step.memory_reset[0]), "n");
}

#[test]
fn sections_embed_and_mirror() {
    let tables = format!(
        "{STEP}n = \"if(v > 0, 2*n + 1, -n)\"\n[section]\nafter = \"step\"\ncoordinates = [\"v\"]\n[section.embed]\n\
         x = \"max(a, 1 [m])\"\n[section.start]\nv = \"36 km/h\"\n[section.symmetry]\nv = \"-v\"\n"
    );
    let model = model(&tables, "0");
    assert_eq!(show(&model, model.transitions[0].memory_reset[0]), "select(s1, add(mul(2, n), 1), neg(n))");
    let section = model.section.as_ref().unwrap();
    assert_eq!(
        (section.transition, section.before, &*section.coordinates, &*section.start),
        (0, false, &[1][..], &[10.0][..])
    );
    let embed: Vec<_> = section.embed.iter().map(|&node| show(&model, node)).collect();
    assert_eq!(embed, ["choose(sub(a, 1), a, 1)", "v"]);
    let symmetry: Vec<_> = section.symmetry.as_ref().unwrap().iter().map(|&node| show(&model, node)).collect();
    assert_eq!(symmetry, ["x", "neg(v)"]);
}

#[test]
fn sections_stand_before_transitions_and_on_surfaces() {
    let section = "coordinates = [\"v\"]\nembed = { x = \"a\" }\nstart = { v = \"1 m/s\" }\n";
    let before = model(&format!("{STEP}[section]\nbefore = \"step\"\n{section}"), "0");
    let at = before.section.as_ref().unwrap();
    assert_eq!((at.transition, at.before, at.mode(&before.transitions)), (0, true, Some(0)));
    let surface = "[surfaces.top]\nmode = \"go\"\nguard = \"x - a\"\ndirection = \"rising\"\n";
    let on = model(&format!("{STEP}{surface}[section]\nat = \"top\"\n{section}"), "0");
    let at = on.section.as_ref().unwrap();
    assert_eq!((at.transition, at.before), (1, false));
    let top = &on.transitions[1];
    assert_eq!((top.name.as_str(), top.surface, top.from, top.to, top.when), ("top", true, 0, 0, None));
    assert_eq!((show(&on, top.guard).as_str(), top.direction), ("sub(x, a)", Direction::Rising));
    let kept: Vec<_> = top.reset.iter().map(|&node| show(&on, node)).collect();
    assert_eq!(kept, ["x", "v"]);
}

#[test]
fn measures_share_functionals_and_use_each_other() {
    let tables = "[measures]\nratio = { expr = \"speed/top_speed\", unit = \"1\" }\n\
                  speed = { expr = \"mean(v)\", unit = \"km/h\" }\n\
                  top_speed = { expr = \"max(cycle_max(abs(v)), mean(v) + 0*(end(x) - start(x))/duration)\", unit = \"m/s\" }\n\
                  way = { expr = \"integral(v)\", unit = \"cm\" }\n";
    let model = model(tables, "0");
    let kinds: Vec<_> = model.functionals.iter().map(|functional| functional.kind).collect();
    use FunctionalKind::{Duration, End, Integral, Maximum, Mean, Start};
    assert_eq!(kinds, [Mean, Maximum, End, Start, Duration, Integral]);
    let names: Vec<_> = model.measures.iter().map(|measure| measure.name.as_str()).collect();
    assert_eq!(names, ["ratio", "speed", "top_speed", "way"]);
    assert_eq!(show(&model, model.measures[1].expr), "Mean<v>");
    assert!(
        show(&model, model.measures[0].expr).starts_with("div(Mean<v>, choose(sub(Maximum<select(s0, v, neg(v))>,")
    );
    assert_eq!(show(&model, model.measures[3].expr), "Integral<v>");
}

#[test]
fn problems_hold_bounds_in_si_and_margins() {
    let tables = format!(
        "{STEP}[measures]\ntop = {{ expr = \"cycle_max(x)\", unit = \"m\" }}\n[problems.p]\ndefault = true\nminimize = \"top*k\"\n\
         vary = {{ a = [\"10 cm\", \"2 m\"], k = [1, \"2\"] }}\n\
         subject_to = [\"spectral_radius <= k/10\", \"top >= 2*7 cm\", \"top <= 3 [m]\", \"0.5 >= spectral_radius\"]\n"
    );
    let model = model(&tables, "0");
    let problem = &model.problems[0];
    assert!(problem.default && problem.sense == Sense::Minimize && problem.objective_text == "top*k");
    assert_eq!(show(&model, problem.objective), "mul(top, k)");
    let vary: Vec<_> = problem.vary.iter().map(|vary| (vary.parameter, vary.lower, vary.upper)).collect();
    assert_eq!(vary, [(0, 0.1, 2.0), (1, 1.0, 2.0)]);
    let margins: Vec<_> = problem.constraints.iter().map(|constraint| show(&model, constraint.margin)).collect();
    let radius = "spectralradius";
    let expected =
        [&*format!("sub(div(k, 10), {radius})"), "sub(top, 0.14)", "sub(3, top)", &format!("sub(0.5, {radius})")];
    assert_eq!(margins, expected);
    let bounds: Vec<_> = problem
        .constraints
        .iter()
        .map(|constraint| constraint.stability_bound.map(|bound| show(&model, bound)))
        .collect();
    assert_eq!(bounds, [Some("div(k, 10)".to_owned()), None, None, Some("0.5".to_owned())]);
    assert_eq!(problem.constraints[1].text, "top >= 2*7 cm");
}

#[test]
fn robust_problems_hold_ranges_in_si_and_are_data() {
    let problem = |robust: &str| {
        let tables = format!(
            "{STEP}[measures]\ntop = {{ expr = \"cycle_max(x)\", unit = \"m\" }}\n[problems.p]\nminimize = \"top\"\n\
             vary = {{ a = [\"10 cm\", \"2 m\"] }}\n{robust}\nsubject_to = [\"spectral_radius <= 0.9\"]\n"
        );
        model(&tables, "0")
    };
    let model = problem("robust = { k = [1, \"2\"] }");
    let k = model.parameters.iter().position(|parameter| parameter.name == "k").unwrap();
    let robust = &model.problems[0].robust;
    assert_eq!(robust, &[Uncertain { parameter: k, lower: 1.0, upper: 2.0 }]);
    let without = problem("");
    assert!(without.problems[0].robust.is_empty());
    assert_eq!(fingerprint(&model), fingerprint(&without));
}

#[test]
fn parameters_keep_value_unit_and_range() {
    let text = "spec = 1\nname = \"m\"\n[parameters]\nb = \"2*pi*3 rad/s\"\na = { value = \"-20 deg\", range = [\"-45 deg\", 0] }\n\
                z = { value = 0, range = [\"0 N/m\", \"2 kN/m\"] }\nc = 1_000.5\n[state]\nx = { unit = \"1\" }\n\
                [modes.go.flow]\nx = \"b*a*c*z*1 [m/N]\"\n";
    let parsed = parse_text(Path::new("m.toml"), text);
    assert_eq!(render(&parsed.diagnostics, &parsed.sources, false), "");
    let parameters = parsed.model.unwrap().parameters;
    let names: Vec<_> = parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    assert_eq!(names, ["b", "a", "z", "c"]); // the order of the file
    assert_eq!(parameters[0].value, std::f64::consts::PI * 6.0);
    assert_eq!(parameters[1].range.unwrap(), (-45f64.to_radians(), 0.0));
    assert_eq!(parameters[1].unit, "deg");
    assert_eq!((parameters[2].value, parameters[2].range.unwrap(), &*parameters[2].unit), (0.0, (0.0, 2000.0), "N/m"));
    assert_eq!(parameters[3].value, 1000.5);
}

#[test]
fn modes_may_have_states_of_their_own() {
    let text = "spec = 1\nname = \"m\"\n[state]\nx = { unit = \"m\" }\nq = { unit = \"rad\", modes = [\"hang\"] }\n\
                [modes.fly.flow]\nx = \"1 [m/s]\"\n[modes.hang.flow]\nx = \"0\"\nq = \"1 [1/s]\"\n\
                [transitions.catch]\nfrom = \"fly\"\nto = \"hang\"\nguard = \"x\"\ndirection = \"either\"\n\
                [transitions.catch.reset]\nx = \"x\"\nq = \"0\"\n\
                [transitions.release]\nfrom = \"hang\"\nto = \"fly\"\nguard = \"q - 1\"\ndirection = \"rising\"\n\
                [transitions.release.reset]\nx = \"x\"\n";
    let parsed = parse_text(Path::new("m.toml"), text);
    assert_eq!(render(&parsed.diagnostics, &parsed.sources, false), "");
    let model = parsed.model.unwrap();
    assert_eq!(model.modes[0].has_state, [true, false]);
    assert_eq!(show(&model, model.modes[0].flow[1]), "0");
    assert_eq!((model.transitions[1].from, model.transitions[1].to), (1, 0));
}

#[test]
fn lets_that_nothing_needs_leave_no_trace() {
    let without = model("", "0");
    let with = model("[let]\nunneeded = \"abs(x)*sin(x/a)\"\n", "0");
    assert_eq!(with.switches.len(), without.switches.len());
    assert_eq!(with.graph.nodes().len(), without.graph.nodes().len());
}

#[test]
fn lowering_is_linear_in_shared_definitions() {
    // Written out, this flow has 2^200 terms.
    let mut tables = "[let]\ny0 = \"v/1 [s]\"\n".to_owned();
    for i in 1..=200 {
        tables += &format!("y{i} = \"y{0}*x/a + y{0}\"\n", i - 1);
    }
    tables += "[functions]\nf0 = { args = [\"z\"], expr = \"z*x/a\" }\n";
    for i in 1..=60 {
        tables += &format!("f{i} = {{ args = [\"z\"], expr = \"f{0}(z) + f{0}(z)\" }}\n", i - 1);
    }
    let model = model(&tables, "y200 + f60(y3)");
    assert!(model.graph.nodes().len() < 2000);
}

/// Two whole numbers may be equal, where `<` and `<=` differ: both at once (`when`) and by selectors (resets).
#[test]
fn comparisons_of_memory_are_exact() {
    type Condition = (&'static str, fn(i64) -> bool);
    let conditions: [Condition; 9] = [
        ("n > 1", |n| n > 1),
        ("n >= 1", |n| n >= 1),
        ("n < 1", |n| n < 1),
        ("n <= 1", |n| n <= 1),
        ("1 > n", |n| 1 > n),
        ("not n > 1", |n| n <= 1),
        ("not (n >= 1 and n <= 1)", |n| n != 1),
        ("n >= 1 and n <= 1", |n| n == 1),
        ("2*n - n^2 >= 1 or 1 > 1", |n| n == 1),
    ];
    for (text, holds) in conditions {
        let text = format!(
            "spec = 1\nname = \"m\"\n[state]\nx = {{ unit = \"1\" }}\n[memory]\nn = {{ initial = 0 }}\n[modes.a.flow]\nx = \"1 [1/s]\"\n\
             [transitions.b]\nfrom = \"a\"\nto = \"a\"\nguard = \"x\"\ndirection = \"either\"\nwhen = \"{text}\"\n\
             reset = {{ x = \"if({text}, 1, 0)\", n = \"n + 1\" }}\n"
        );
        let parsed = parse_text(Path::new("m.toml"), &text);
        assert_eq!(render(&parsed.diagnostics, &parsed.sources, false), "");
        let model = parsed.model.unwrap();
        for n in -2..4 {
            let memory = [n as f64];
            let at = Environment { memory: &memory, ..Environment::default() };
            let branch: Vec<bool> = model.switches.iter().map(|s| value(&model.graph, s.expr, &at) >= 0.0).collect();
            let transition = &model.transitions[0];
            assert_eq!(value(&model.graph, transition.when.unwrap(), &at) >= 0.0, holds(n), "{text} at {n}");
            let reset = value(&model.graph, transition.reset[0], &Environment { branch: &branch, ..at });
            assert_eq!(reset, f64::from(u8::from(holds(n))), "{text} at {n}");
        }
    }
}

/// What a gait has to lead back: not its coordinates, and not what nothing depends on.
#[test]
fn states_that_something_depends_on_have_to_return() {
    let text = "spec = 1\nname = \"m\"\n[parameters]\nk = \"3 1/s^2\"\n[state]\nway = { unit = \"m\" }\nx = { unit = \"m\" }\n\
                v = { unit = \"m/s\" }\n[modes.go.flow]\nway = \"v\"\nx = \"v\"\nv = \"-k*x\"\n[transitions.step]\nfrom = \"go\"\n\
                to = \"go\"\nguard = \"v\"\ndirection = \"falling\"\nreset = { way = \"way\", x = \"-x\", v = \"1 [m/s]\" }\n\
                [section]\nafter = \"step\"\ncoordinates = [\"v\"]\nembed = { way = \"0\", x = \"0\" }\nstart = { v = \"1 m/s\" }\n";
    let model = parse_text(Path::new("m.toml"), text).model.unwrap();
    assert_eq!(gaitc_compiler::valid::validate(model).unwrap().facts().returning, [1]);
}
