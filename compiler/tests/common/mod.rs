//! Models for tests, built by hand with the graph API.
#![allow(dead_code, reason = "each test file uses some of it")]

use gaitc_compiler::dimension::Dimension;
use gaitc_compiler::ir::*;

/// Adds nodes with short names.
pub struct Maker {
    pub graph: Graph,
}

impl Maker {
    pub fn c(&mut self, value: f64) -> NodeId {
        self.graph.constant(value)
    }
    pub fn s(&mut self, symbol: Symbol) -> NodeId {
        self.graph.symbol(symbol)
    }
    pub fn x(&mut self, i: usize) -> NodeId {
        self.s(Symbol::State(i))
    }
    pub fn p(&mut self, i: usize) -> NodeId {
        self.s(Symbol::Parameter(i))
    }
    pub fn un(&mut self, op: Unary, a: NodeId) -> NodeId {
        self.graph.unary(op, a)
    }
    pub fn add(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.graph.binary(Binary::Add, a, b)
    }
    pub fn sub(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.graph.binary(Binary::Sub, a, b)
    }
    pub fn mul(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.graph.binary(Binary::Mul, a, b)
    }
    pub fn div(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.graph.binary(Binary::Div, a, b)
    }
    pub fn pow(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.graph.binary(Binary::Pow, a, b)
    }
    pub fn neg(&mut self, a: NodeId) -> NodeId {
        self.un(Unary::Neg, a)
    }
    pub fn sin(&mut self, a: NodeId) -> NodeId {
        self.un(Unary::Sin, a)
    }
    pub fn cos(&mut self, a: NodeId) -> NodeId {
        self.un(Unary::Cos, a)
    }
    pub fn d(&mut self, a: NodeId, symbol: Symbol) -> NodeId {
        self.graph.add(Node::Partial(a, symbol))
    }
    pub fn select(&mut self, switch: usize, then: NodeId, otherwise: NodeId) -> NodeId {
        self.graph.add(Node::Select { switch, then, otherwise })
    }
    pub fn choose(&mut self, margin: NodeId, then: NodeId, otherwise: NodeId) -> NodeId {
        self.graph.add(Node::Choose { margin, then, otherwise })
    }
}

fn parameter(name: &str, value: f64, dimension: Dimension) -> Parameter {
    Parameter { name: name.into(), dimension, value, unit: String::new(), range: None, doc: String::new() }
}

fn state(name: &str, dimension: Dimension) -> State {
    State { name: name.into(), dimension, unit: String::new(), doc: String::new() }
}

fn metre() -> Dimension {
    Dimension::base(0)
}

fn measure(name: &str, expr: NodeId, dimension: Dimension) -> Measure {
    Measure { name: name.into(), expr, dimension, unit: String::new(), doc: String::new() }
}

/// M_L: the equations of `specs/prescribed_length.toml`.
pub fn prescribed_length() -> Model {
    let mut m = Maker { graph: Graph::default() };
    let (l_s, l_b, mass, g, psi, omega) = (m.p(0), m.p(1), m.p(2), m.p(3), m.p(4), m.p(5));
    let (q, p, tau) = (m.x(0), m.x(1), m.s(Symbol::Tau));
    let (pi, one, two) = (m.c(std::f64::consts::PI), m.c(1.0), m.c(2.0));
    let step_end = m.div(pi, omega);
    let left = m.sub(step_end, tau);
    let r = {
        let half = m.div(l_s, two);
        let angle = m.mul(omega, tau);
        let cosine = m.cos(angle);
        let factor = m.add(one, cosine);
        let stroke = m.mul(half, factor);
        let long = m.add(l_b, stroke);
        m.select(0, long, l_b)
    };
    let v_r = m.d(r, Symbol::Tau);
    let (sin, cos) = (m.sin(q), m.cos(q));
    let minus_v_r = m.neg(v_r);
    let (a, b) = (m.mul(v_r, sin), m.mul(p, cos));
    let v_x = m.add(a, b);
    let (a, b) = (m.mul(minus_v_r, cos), m.mul(p, sin));
    let v_y = m.add(a, b);
    let rho_a = {
        let a_r = m.d(v_r, Symbol::Tau);
        let inertia = m.mul(mass, a_r);
        let mg = m.mul(mass, g);
        let weight = m.mul(mg, cos);
        let square = m.pow(p, two);
        let pull = m.mul(mass, square);
        let pull = m.div(pull, r);
        let sum = m.sub(weight, inertia);
        m.add(sum, pull)
    };
    let flow_q = m.div(p, r);
    let flow_p = {
        let gs = m.mul(g, sin);
        let gs = m.neg(gs);
        let vp = m.mul(v_r, p);
        let vp = m.div(vp, r);
        m.sub(gs, vp)
    };
    let delta = {
        let n = m.s(Symbol::Memory(0));
        let minus = m.c(-1.0);
        let sign = m.pow(minus, n);
        let angle = m.mul(two, psi);
        m.mul(angle, sign)
    };
    let reset_q = m.add(q, delta);
    let reset_p = {
        let angle = m.mul(two, psi);
        let c = m.cos(angle);
        m.mul(c, p)
    };
    let n = m.s(Symbol::Memory(0));
    let n_after = m.add(n, one);
    let (mirror_q, mirror_p) = (m.neg(q), m.neg(p));
    let (abs_x, abs_rho) = (m.neg(v_x), m.neg(rho_a));
    let (abs_x, abs_rho) = (m.select(1, v_x, abs_x), m.select(2, rho_a, abs_rho));
    let power = m.mul(rho_a, minus_v_r);
    let zero = m.c(0.0);
    let positive_power = m.select(3, power, zero);
    let functionals = vec![
        Functional { kind: FunctionalKind::Mean, expr: v_y },
        Functional { kind: FunctionalKind::Mean, expr: abs_x },
        Functional { kind: FunctionalKind::Duration, expr: one },
        Functional { kind: FunctionalKind::Integral, expr: v_y },
        Functional { kind: FunctionalKind::Maximum, expr: abs_rho },
        Functional { kind: FunctionalKind::Mean, expr: positive_power },
    ];
    let f: Vec<NodeId> = (0..6).map(|i| m.s(Symbol::Functional(i))).collect();
    let stride = m.mul(two, f[2]);
    let stride = m.div(one, stride);
    let transport = {
        let mg = m.mul(mass, g);
        let mgv = m.mul(mg, f[0]);
        m.div(f[5], mgv)
    };
    let speed = metre().div(Dimension::TIME).unwrap();
    let force = Dimension::base(1).mul(speed).unwrap().div(Dimension::TIME).unwrap();
    let switch = |expr, text: &str| Switch { expr, text: text.into() };
    Model {
        name: "prescribed_length".into(),
        title: "Prescribed-length planar climber".into(),
        source: String::new(),
        parameters: vec![
            parameter("l_s", 0.13, metre()),
            parameter("l_b", 0.5, metre()),
            parameter("m", 2.6, Dimension::base(1)),
            parameter("g", 9.81, speed.div(Dimension::TIME).unwrap()),
            parameter("psi", 0.349, Dimension::NONE),
            parameter("omega", 18.85, Dimension::NONE.div(Dimension::TIME).unwrap()),
        ],
        states: vec![state("q_theta", Dimension::NONE), state("p_theta", speed)],
        memory: vec![Memory { name: "n".into(), initial: 0, doc: String::new() }],
        switches: vec![
            switch(left, "tau <= pi/omega"),
            switch(v_x, "abs(v_x)"),
            switch(rho_a, "abs(rho_a)"),
            switch(power, "max(power, 0)"),
        ],
        modes: vec![Mode {
            name: "stance".into(),
            flow: vec![flow_q, flow_p],
            mass: None,
            has_state: vec![true, true],
        }],
        transitions: vec![Transition {
            name: "step".into(),
            from: 0,
            to: 0,
            guard: left,
            direction: Direction::Falling,
            when: None,
            reset: vec![reset_q, reset_p],
            memory_reset: vec![n_after],
        }],
        section: Some(Section {
            after: 0,
            coordinates: vec![0, 1],
            embed: vec![q, p],
            start: vec![-0.35, -0.2],
            symmetry: Some(vec![mirror_q, mirror_p]),
        }),
        functionals,
        measures: vec![
            measure("climb_speed", f[0], speed),
            measure("lateral_speed", f[1], speed),
            measure("stride_frequency", stride, Dimension::NONE.div(Dimension::TIME).unwrap()),
            measure("step_length", f[3], metre()),
            measure("peak_force", f[4], force),
            measure("mean_power", f[5], force.mul(speed).unwrap()),
            measure("cost_of_transport", transport, Dimension::NONE),
        ],
        problems: Vec::new(),
        graph: m.graph,
    }
}
