//! Return map, gaits and multipliers of the climber.
//!
//! The map is mirror o S_S o (flow over one step). At both dead centres the leg's speed r' Omega is zero, so S_S turns the
//! tangential velocity alone: q_theta+ = q_theta + 2 psi, p_theta+ = cos(2 psi) p_theta; the mirror changes both signs. With
//! a rotor the crank speed is handed over as it is.
//!
//! Section coordinates: q_theta, p_theta, and with a rotor Omega.

use super::chebyshev::Basis;
use super::machine::Machine;
use super::step::{Mesh, Step, solve};
use nalgebra::{Complex, DMatrix, DVector};

/// Numerical parameters of the reference.
pub struct Method {
    /// Polynomials on an element.
    pub basis: Basis,
    /// Elements.
    pub mesh: Mesh,
}

impl Default for Method {
    fn default() -> Self {
        Self { basis: Basis::new(16), mesh: Mesh::Adaptive(1e-13) }
    }
}

/// The return map at a point.
pub struct Mapped {
    /// Image.
    pub image: DVector<f64>,
    /// Derivative of the image.
    pub jacobian: DMatrix<f64>,
    /// The motion.
    pub step: Step,
}

/// A fixed point of the return map.
pub struct Gait {
    /// Section coordinates.
    pub coordinates: DVector<f64>,
    /// The map there.
    pub map: Mapped,
    /// Eigenvalues of the map's derivative by falling magnitude, of a pair the one with positive imaginary part first.
    pub multipliers: Vec<Complex<f64>>,
}

impl Method {
    /// The map at section coordinates z; `None` where the step does not come to its end.
    pub fn map(&self, machine: &Machine, z: &DVector<f64>) -> Option<Mapped> {
        let d = z.len();
        let omega = if d == 3 { z[2] } else { machine.free() };
        let mut directions = DMatrix::zeros(3, d);
        for (column, row) in [1, 2, 0].into_iter().enumerate().take(d) {
            directions[(row, column)] = 1.0;
        }
        let step = solve(machine, &self.basis, &self.mesh, [omega, z[0], z[1]], &directions)?;
        let [omega, q, p] = step.end();
        let turn = 2.0 * machine.psi;
        let image = [-(q + turn), -turn.cos() * p, omega];
        let factors = [-1.0, -turn.cos(), 1.0];
        let last = step.elements.last()?.variations.last()?;
        let jacobian = DMatrix::from_fn(d, d, |i, j| factors[i] * last[([1, 2, 0][i], j)]);
        Some(Mapped { image: DVector::from_column_slice(&image[..d]), jacobian, step })
    }

    /// The gait that Newton's method finds from a guess.
    pub fn gait_from(&self, machine: &Machine, guess: &DVector<f64>) -> Option<Gait> {
        let mut z = guess.clone();
        let mut map = self.map(machine, &z)?;
        let mut residual = size(&(&map.image - &z));
        for _ in 0..40 {
            let change = (&map.jacobian - DMatrix::identity(z.len(), z.len())).lu().solve(&(&z - &map.image))?;
            let mut length = 1.0;
            let better = loop {
                let trial = &z + &change * length;
                if let Some(next) = self.map(machine, &trial) {
                    let after = size(&(&next.image - &trial));
                    if after < residual {
                        break Some((trial, next, after));
                    }
                }
                length *= 0.5;
                if length < 1e-4 || residual < 1e-11 {
                    break None;
                }
            };
            let Some((next, mapped, after)) = better else { break };
            (z, map, residual) = (next, mapped, after);
        }
        // What remains is rounding, amplified by the crank speed's size where that is a coordinate.
        (residual < 1e-11).then(|| {
            let multipliers = eigenvalues(&map.jacobian);
            Gait { coordinates: z, map, multipliers }
        })
    }

    /// The gait that continues, from the thesis's machine, along the straight line to other parameters.
    pub fn gait(&self, machine: &Machine) -> Option<Gait> {
        let home = Machine { rotor: machine.rotor, ..Machine::nominal() };
        let start = [-0.3, -0.4, home.free()];
        let guess = DVector::from_column_slice(if machine.rotor > 0.0 { &start } else { &start[..2] });
        let mut gait = self.gait_from(&home, &guess)?;
        let (mut at, mut stride) = (0.0, 1.0);
        while at < 1.0 {
            let next = f64::min(at + stride, 1.0);
            let mix = |a: f64, b: f64| if next == 1.0 { b } else { a + next * (b - a) };
            let between = Machine {
                psi: mix(home.psi, machine.psi),
                gear: mix(home.gear, machine.gear),
                stiffness: mix(home.stiffness, machine.stiffness),
                ..*machine
            };
            match self.gait_from(&between, &gait.coordinates) {
                Some(found) => (gait, at, stride) = (found, next, 2.0 * stride),
                None if stride > 1e-3 => stride *= 0.5,
                None => return None,
            }
        }
        Some(gait)
    }
}

fn size(v: &DVector<f64>) -> f64 {
    v.iter().map(|c| c.abs()).fold(0.0, f64::max)
}

/// Eigenvalues by falling magnitude; those of two rows by the quadratic formula.
fn eigenvalues(matrix: &DMatrix<f64>) -> Vec<Complex<f64>> {
    let mut values: Vec<Complex<f64>> = if matrix.nrows() == 2 {
        let half = 0.5 * matrix.trace();
        let root = Complex::new(half * half - matrix.determinant(), 0.0).sqrt();
        vec![root + half, -root + half]
    } else {
        matrix.complex_eigenvalues().iter().copied().collect()
    };
    values.sort_by(|a, b| b.norm().total_cmp(&a.norm()).then(b.im.total_cmp(&a.im)));
    values
}
