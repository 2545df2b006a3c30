//! What the thesis asks of an actuator so that the gaits of the vertical climber attract: its force is Lipschitz, at rest more than
//! the weight, and falls with the speed of shortening. The specs measure it along the gait; here it is also asked of the generated
//! flow over the whole stroke, up to the speed at which the motor idles.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod maps;

use approx::assert_relative_eq;
use gaitc_runtime::probe::{Function, Point, Variable};
use maps::Machine;

/// A model, the rate of the pinion at which its motor idles, and the force and the slopes that are known of it.
struct Case {
    name: &'static str,
    idle: f64,
    /// Force at rest with the spring at rest (N), from the motor's numbers.
    rest: f64,
    /// Steepest and flattest fall of the force with the speed up to idle (N s/m).
    falls: [f64; 2],
}

fn cases() -> [Case; 2] {
    let r_p = 0.13 / std::f64::consts::PI;
    let motor = 56.57 * 0.321 / r_p;
    // Hill's hyperbola falls with F_0 (1 + c)/(c v_max) at rest and F_0 c/((1 + c) v_max) at idle.
    let lever = 0.08 / r_p;
    let muscle = |at: f64| lever * lever * 200.0 / 2.0 * at;
    let damping = motor / (1250.0 / 56.57 * r_p);
    [
        Case { name: "power_stroke", idle: 1250.0 / 56.57, rest: motor, falls: [damping, damping] },
        Case {
            name: "power_stroke_muscle",
            idle: 2.0 / 0.08,
            rest: lever * 200.0,
            falls: [muscle(1.25 / 0.25), muscle(0.25 / 1.25)],
        },
    ]
}

/// rho_a at (y_1, y_2) and its derivatives, from the flow y_2' = rho_a/m - g.
fn force(machine: &Machine, y: [f64; 2]) -> [f64; 3] {
    let info = machine.model.compiled.info();
    let point = Point {
        x: &y,
        k: &[0.0; 2],
        p: &machine.parameters,
        memory: &[],
        functionals: &vec![0.0; info.functionals.len()],
        branch: &vec![false; info.switches.len()],
        tau: 0.0,
        t: 0.0,
    };
    let flow = machine.model.compiled.probe(Function::Flow(0), &point).unwrap();
    let columns = &flow.derivatives.iter().find(|(v, _)| *v == Variable::State).unwrap().1;
    let m = machine.value("m");
    [m * (flow.value[1] + machine.value("g")), m * columns[0][1], m * columns[1][1]]
}

#[test]
fn conditions_hold_over_the_stroke_up_to_idle() {
    for case in cases() {
        let machine = Machine::new(case.name, &[]);
        let weight = machine.value("m") * machine.value("g");
        let (stroke, fastest) = (machine.value("l_s"), case.idle * machine.value("r_p"));
        let (mut steepest, mut flattest) = (0.0_f64, f64::INFINITY);
        for i in 0..=200 {
            let y_1 = stroke * f64::from(i) / 200.0;
            let [rest, _, _] = force(&machine, [y_1, 0.0]);
            assert_relative_eq!(rest, case.rest + machine.value("k") * (stroke - y_1), max_relative = 1e-12);
            assert!(rest > weight, "{}: {rest} N at rest", case.name);
            for j in 0..=200 {
                let [_, along, fall] = force(&machine, [y_1, fastest * f64::from(j) / 200.0]);
                assert_relative_eq!(along, -machine.value("k"), max_relative = 1e-12);
                assert!(fall < 0.0, "{}: the force grows with the speed", case.name);
                steepest = steepest.max(-fall);
                flattest = flattest.min(-fall);
            }
            // Without load only the spring is left.
            let [idle, _, _] = force(&machine, [stroke, fastest]);
            assert!(idle.abs() < 1e-11 * case.rest);
        }
        // Lipschitz, with this constant.
        assert_relative_eq!(steepest, case.falls[0], max_relative = 1e-12);
        assert_relative_eq!(flattest, case.falls[1], max_relative = 1e-12);
    }
}

#[test]
fn specs_measure_the_conditions_along_the_gait() {
    for case in cases() {
        let machine = Machine::new(case.name, &[]);
        let gait = machine.gait(None);
        let measure = |name| machine.measure(&gait.map, name);
        assert_relative_eq!(measure("length_slope"), machine.value("k"), max_relative = 1e-12);
        // The spring is at rest at the end of the stroke, where the force is least.
        let weight = machine.value("m") * machine.value("g");
        assert_relative_eq!(measure("rest_margin"), case.rest - weight, max_relative = 1e-10);
        let (steep, flat) = (measure("speed_slope"), measure("falls_with_speed"));
        assert!(0.0 < flat && flat <= steep && steep <= case.falls[0] * (1.0 + 1e-12), "{flat} {steep}");
        assert!(flat >= case.falls[1] * (1.0 - 1e-12));
        assert!(gait.spectral_radius < 1.0);
    }
}
