//! The self-exciting climber with its crank-slider as formulas of the crank angle phi: kinematics, forces, motor.

/// Parameters, SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Machine {
    /// Half the sprawl (rad).
    pub psi: f64,
    /// Gear ratio.
    pub gear: f64,
    /// Stiffness of the spring along the leg (N/m).
    pub stiffness: f64,
    /// Rotor inertia (kg m^2); 0 is the climber whose crank speed is slaved at the dead centres.
    pub rotor: f64,
    /// Body mass (kg).
    pub mass: f64,
    /// Gravity (m/s^2).
    pub gravity: f64,
    /// Leg length at the end of a step (m).
    pub body: f64,
    /// Crank length (m).
    pub crank: f64,
    /// Coupler length (m).
    pub coupler: f64,
    /// Motor speed without load (rad/s).
    pub no_load: f64,
    /// Motor torque at standstill (N m).
    pub stall: f64,
}

impl Machine {
    /// The thesis's machine (table 6.2) with sprawl (deg), gear ratio and spring (N/m) as given.
    pub fn new(degrees: f64, gear: f64, stiffness: f64) -> Self {
        Self {
            psi: degrees.to_radians(),
            gear,
            stiffness,
            rotor: 0.0,
            mass: 2.6,
            gravity: 9.81,
            body: 0.5,
            crank: 0.065,
            coupler: 0.195,
            no_load: 1250.0,
            stall: 0.321,
        }
    }

    /// The thesis's machine: sprawl 20 deg, gear 56.57, spring 58 N/m.
    pub fn nominal() -> Self {
        Self::new(20.0, 56.57, 58.0)
    }

    /// Leg length r and its first two derivatives in phi.
    pub fn leg(&self, phi: f64) -> [f64; 3] {
        let (a, c) = (self.crank, self.coupler);
        let (sin, cos) = phi.sin_cos();
        let root = (c * c - a * a * sin * sin).sqrt();
        let slope = -a * a * sin * cos / root;
        let bend = (-a * a * (cos * cos - sin * sin) - slope * slope) / root;
        [self.body + a * cos + root - (c - a), -a * sin + slope, -a * cos + bend]
    }

    /// Crank speed at which the motor gives no torque (rad/s).
    pub fn free(&self) -> f64 {
        self.no_load / self.gear
    }

    /// Motor torque per crank speed, at the crank (N m s).
    pub fn damping(&self) -> f64 {
        self.gear * self.gear * self.stall / self.no_load
    }

    /// Torque of the motor at the crank (N m).
    pub fn torque(&self, omega: f64) -> f64 {
        self.damping() * (self.free() - omega)
    }

    /// Gravity, centrifugal force and spring along the leg, outwards (N).
    pub fn pull_out(&self, r: f64, [_, q, p]: [f64; 3]) -> f64 {
        self.mass * self.gravity * q.cos() + self.mass * p * p / r - self.stiffness * (r - self.body)
    }

    /// Actuation force rho_a along the leg (N), spring included, from the crank's acceleration (rad/s^2).
    pub fn actuation(&self, phi: f64, u: [f64; 3], acceleration: f64) -> f64 {
        let [r, slope, bend] = self.leg(phi);
        let radial = bend * u[0] * u[0] + slope * acceleration;
        self.pull_out(r, u) + self.stiffness * (r - self.body) - self.mass * radial
    }

    /// Residual of the equations with phi as independent variable, u = (Omega, q_theta, p_theta), u' = du/dphi:
    ///
    ///   (m r'^2 + I_r G^2) Omega Omega' = r' F + tau_crank - m r' r'' Omega^2
    ///   Omega q_theta' = p_theta/r
    ///   Omega p_theta' = -g sin(q_theta) - r' Omega p_theta/r
    ///
    /// The first is divided by the motor's damping, so that at the dead centres it reads Omega - omega_nl/G = 0.
    pub fn residual(&self, phi: f64, u: [f64; 3], du: [f64; 3]) -> [f64; 3] {
        let [r, slope, bend] = self.leg(phi);
        let [omega, q, p] = u;
        let inertia = self.mass * slope * slope + self.rotor * self.gear * self.gear;
        let forces = slope * self.pull_out(r, u) + self.torque(omega) - self.mass * slope * bend * omega * omega;
        [
            (inertia * omega * du[0] - forces) / self.damping(),
            omega * du[1] - p / r,
            omega * du[2] + self.gravity * q.sin() + slope * omega * p / r,
        ]
    }

    /// Derivatives of the residual: with respect to u (row i, column j) and, as it is diagonal there, to u'.
    pub fn linearised(&self, phi: f64, u: [f64; 3], du: [f64; 3]) -> ([[f64; 3]; 3], [f64; 3]) {
        let [r, slope, bend] = self.leg(phi);
        let [omega, q, p] = u;
        let (m, b) = (self.mass, self.damping());
        let inertia = m * slope * slope + self.rotor * self.gear * self.gear;
        let with_u = [
            [
                (inertia * du[0] + b + 2.0 * m * slope * bend * omega) / b,
                slope * m * self.gravity * q.sin() / b,
                -slope * 2.0 * m * p / r / b,
            ],
            [du[1], 0.0, -1.0 / r],
            [du[2] + slope * p / r, self.gravity * q.cos(), slope * omega / r],
        ];
        (with_u, [inertia * omega / b, omega, omega])
    }
}
