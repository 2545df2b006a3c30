//! The equations of the three units; `peers/equations.py` says what they mean.

use crate::Failure;
use crate::unit::Unit;
use std::f64::consts::PI;

/// Units a and b: a leg of prescribed length.
#[derive(Clone, Copy, Debug)]
pub struct Swing {
    pub psi: f64,
    pub gravity: f64,
    /// Leg length once it is short (m).
    pub short: f64,
    half: f64,
    omega: f64,
}

impl Swing {
    pub fn of(unit: &Unit) -> Result<Self, Failure> {
        let value = |name| unit.parameter(name);
        Ok(Self {
            psi: value("psi")?,
            gravity: value("g")?,
            short: value("l_b")?,
            half: 0.5 * value("l_s")?,
            omega: value("omega")?,
        })
    }

    /// When the leg is short (s).
    pub fn shortened(&self) -> f64 {
        PI / self.omega
    }

    /// Length and speed of the leg while it shortens.
    pub fn leg(&self, tau: f64) -> [f64; 2] {
        let (sin, cos) = (self.omega * tau).sin_cos();
        [self.short + self.half * (1.0 + cos), -self.half * self.omega * sin]
    }

    /// (q', p') and the same for variations (dq, dp): y and dy hold q, p, then a pair for each variation.
    pub fn field(&self, [r, v]: [f64; 2], y: &[f64], dy: &mut [f64]) {
        let (sin, cos) = y[0].sin_cos();
        let inverse = 1.0 / r;
        let (stiffness, damping) = (self.gravity * cos, v * inverse);
        dy[0] = y[1] * inverse;
        dy[1] = -self.gravity * sin - damping * y[1];
        for (d, out) in y[2..].chunks_exact(2).zip(dy[2..].chunks_exact_mut(2)) {
            out[0] = d[1] * inverse;
            out[1] = -stiffness * d[0] - damping * d[1];
        }
    }

    /// Unit a: the result from q, p and two variations at the end.
    pub fn landed(&self, y: &[f64]) -> Vec<f64> {
        landed(self.psi, &y[..2], &y[2..4], &y[4..6])
    }

    /// Unit b: the result from q, p and one variation at the event.
    pub fn switched(&self, y: &[f64]) -> Vec<f64> {
        let factor = (2.0 * self.psi).cos();
        let rates = [y[1] / self.short, -self.gravity * y[0].sin()];
        vec![-factor * y[1], -factor * (y[3] - rates[1] * y[2] / rates[0])]
    }
}

/// Touch-down and mirror of (q, p) and of two variations.
pub fn landed(psi: f64, end: &[f64], first: &[f64], second: &[f64]) -> Vec<f64> {
    let factor = (2.0 * psi).cos();
    vec![-(end[0] + 2.0 * psi), -factor * end[1], -first[0], -second[0], -factor * first[1], -factor * second[1]]
}

/// Unit c over the crank angle; u = (Omega, q, p).
#[derive(Clone, Copy, Debug)]
pub struct Crank {
    pub psi: f64,
    pub mass: f64,
    gravity: f64,
    stiffness: f64,
    body: f64,
    crank: f64,
    coupler: f64,
    pub damping: f64,
    /// Crank speed at which the motor gives no torque (rad/s).
    pub idle: f64,
}

impl Crank {
    pub fn of(unit: &Unit) -> Result<Self, Failure> {
        let value = |name| unit.parameter(name);
        let gear = value("G")?;
        Ok(Self {
            psi: value("psi")?,
            mass: value("m")?,
            gravity: value("g")?,
            stiffness: value("k")?,
            body: value("l_b")?,
            crank: value("l_crank")?,
            coupler: value("l_coupler")?,
            damping: gear * gear * value("tau_stall")? / value("omega_nl")?,
            idle: value("command")? * value("omega_nl")? / gear,
        })
    }

    /// r, r_1, r_2.
    pub fn legs(&self, phi: f64) -> [f64; 3] {
        let (a, b) = (self.crank, self.coupler);
        let (s, c) = phi.sin_cos();
        let root = (b * b - a * a * s * s).sqrt();
        let slope = -a * a * s * c / root;
        let bend = (-a * a * (c * c - s * s) - slope * slope) / root;
        [self.body + a * c + root - (b - a), -a * s + slope, -a * c + bend]
    }

    /// (m r_1^2 dOmega/dphi, dq/dphi, dp/dphi).
    pub fn field(&self, phi: f64, u: &[f64], out: &mut [f64]) {
        let [r, r_1, r_2] = self.legs(phi);
        let [w, q, p] = [u[0], u[1], u[2]];
        out[0] = self.forces([r, r_1, r_2], [w, q, p]) / w;
        out[1] = p / (r * w);
        out[2] = -self.gravity * q.sin() / w - r_1 * p / r;
    }

    /// The derivative of `field` along d.
    pub fn variation(&self, phi: f64, u: &[f64], d: &[f64], out: &mut [f64]) {
        let [r, r_1, r_2] = self.legs(phi);
        let [w, q, p] = [u[0], u[1], u[2]];
        let pull = -self.mass * self.gravity * q.sin() * d[1] + 2.0 * self.mass * p / r * d[2];
        let forces = r_1 * pull - (self.damping + 2.0 * self.mass * r_1 * r_2 * w) * d[0];
        out[0] = (forces - self.forces([r, r_1, r_2], [w, q, p]) / w * d[0]) / w;
        out[1] = d[2] / (r * w) - p / (r * w * w) * d[0];
        out[2] = -self.gravity * q.cos() / w * d[1] + self.gravity * q.sin() / (w * w) * d[0] - r_1 * d[2] / r;
    }

    fn forces(&self, [r, r_1, r_2]: [f64; 3], [w, q, p]: [f64; 3]) -> f64 {
        let m = self.mass;
        let pull = m * self.gravity * q.cos() + m * p * p / r - self.stiffness * (r - self.body);
        r_1 * pull + self.damping * (self.idle - w) - m * r_1 * r_2 * w * w
    }
}
