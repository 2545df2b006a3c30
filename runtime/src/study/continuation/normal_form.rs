//! Which way a Neimark-Sacker bifurcation goes: the first Lyapunov coefficient of the map on its centre manifold.
//!
//! Where a pair exp(+-i theta) of multipliers is on the unit circle, the map in the plane of its eigenvectors is, in suitable
//! coordinates, w -> exp(i theta) w (1 + c |w|^2) + O(|w|^4). With a = Re c < 0 swings of some size attract beyond the bifurcation
//! (supercritical); with a > 0 they bound before it what the gait survives (subcritical). With J q = exp(i theta) q,
//! J^T p = exp(-i theta) p, p . q = 1 and the symmetric forms B, C of the second and third derivatives of the map
//!
//! ```text
//! a = 1/2 Re exp(-i theta) ( p . C(q, q, q*) + 2 p . B(q, (I - J)^-1 B(q, q*)) + p . B(q*, (exp(2 i theta) I - J)^-1 B(q, q)) ).
//! ```
//!
//! The first derivatives of the map are exact; B and C along real and imaginary part of q are their central differences.
//! Y. A. Kuznetsov, *Elements of Applied Bifurcation Theory*, section 5.4.

use super::Criticality;
use super::system::{Sample, System};
use crate::return_map::RequestError;
use nalgebra::{Complex, DMatrix, DVector};

/// Steps of the differences, in scaled unknowns; each is tried with its half.
const STEPS: [f64; 3] = [0.02, 0.01, 0.005];
/// Coefficients of a step and of its half that differ by more than this part say nothing.
const AGREE: f64 = 0.2;
/// A coefficient whose terms cancel down to this part of them is zero: as of a map that preserves areas, whose swings keep any size.
/// Rounding of the differences is a hundredth of that.
const CANCELS: f64 = 1e-4;
/// Multipliers whose first, second, third or fourth power is this near to 1 are in strong resonance: the normal form is another one.
const RESONANT: f64 = 0.05;
/// How far from the circle the pair may be.
const NEAR: f64 = 1e-4;

/// The coefficient a.
#[derive(Clone, Copy, Debug)]
struct Coefficient {
    value: f64,
    /// The sum of the magnitudes of its three terms, as complex numbers.
    terms: f64,
}

/// The pair on the circle with its eigenvectors.
struct Pair {
    multiplier: Complex<f64>,
    right: DVector<Complex<f64>>,
    /// Normalised so that its conjugate times `right` is 1.
    left: DVector<Complex<f64>>,
}

impl System<'_> {
    /// On which side of a Neimark-Sacker bifurcation there are lasting swings; `None` in strong resonance, where the
    /// coefficient is zero, and where two steps of the differences do not agree on it.
    pub(super) fn swing(&self, at: &Sample) -> Result<Option<Criticality>, RequestError> {
        let jacobian = self.scaled(at);
        let Some(pair) = Pair::of(&jacobian) else { return Ok(None) };
        let at_displaced = |by: &DVector<f64>| {
            let y = &at.y + by.clone().insert_row(at.coordinates(), 0.0);
            Ok::<_, RequestError>(self.evaluate(&y)?.ok().map(|sample| self.scaled(&sample)))
        };
        for step in STEPS {
            let large = pair.coefficient(&jacobian, &at_displaced, step)?;
            let small = pair.coefficient(&jacobian, &at_displaced, 0.5 * step)?;
            if let (Some(large), Some(small)) = (large, small)
                && (large.value - small.value).abs() <= AGREE * small.value.abs()
            {
                let zero = small.value.abs() <= CANCELS * small.terms;
                let side = if small.value < 0.0 { Criticality::Supercritical } else { Criticality::Subcritical };
                return Ok(Some(side).filter(|_| !zero));
            }
        }
        Ok(None)
    }

    /// dP/dz in scaled coordinates.
    fn scaled(&self, sample: &Sample) -> DMatrix<f64> {
        let d = sample.coordinates();
        DMatrix::from_fn(d, d, |i, j| sample.jacobian[(i, j)] * self.scale[j] / self.scale[i])
    }
}

impl Pair {
    /// The pair of a matrix that is nearest to the circle; `None` in strong resonance.
    fn of(jacobian: &DMatrix<f64>) -> Option<Self> {
        let all = crate::orbit::multipliers(jacobian);
        let distance = |m: &Complex<f64>| (m.norm() - 1.0).abs();
        let pair = all.into_iter().filter(|m| m.im > 0.0).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let resonant = (1..=4).any(|power| (pair.powi(power) - 1.0).norm() < RESONANT);
        if distance(&pair) > NEAR || resonant {
            return None;
        }
        let right = null_vector(jacobian, pair)?;
        let left = null_vector(&jacobian.transpose(), pair.conj())?;
        let product = left.dotc(&right);
        (product.norm() > 1e-8).then(|| Self { multiplier: pair, right, left: left / product.conj() })
    }

    /// The coefficient a, with differences of this step; `None` where the map has no value at a displaced point.
    fn coefficient<E>(
        &self,
        jacobian: &DMatrix<f64>,
        at: &impl Fn(&DVector<f64>) -> Result<Option<DMatrix<f64>>, E>,
        step: f64,
    ) -> Result<Option<Coefficient>, E> {
        let parts = [self.right.map(|v| v.re), self.right.map(|v| v.im)];
        let (mut second, mut third) = (Vec::new(), DMatrix::zeros(jacobian.nrows(), jacobian.ncols()));
        for part in &parts {
            let (Some(ahead), Some(behind)) = (at(&(part * step))?, at(&(part * -step))?) else { return Ok(None) };
            second.push((&ahead - &behind) / (2.0 * step));
            third += (ahead + behind - jacobian * 2.0) / (step * step);
        }
        let [b_re, b_im] = &second[..] else { return Ok(None) };
        let complex = |m: &DMatrix<f64>| m.map(|v| Complex::new(v, 0.0));
        let i = Complex::new(0.0, 1.0);
        // B(q, .) and B(q*, .); C(q, q, q*) is C(re, re, q) + C(im, im, q).
        let (b, b_conjugate) = (complex(b_re) + complex(b_im) * i, complex(b_re) - complex(b_im) * i);
        let (q, unit) = (&self.right, DMatrix::<Complex<f64>>::identity(jacobian.nrows(), jacobian.ncols()));
        let j = complex(jacobian);
        let solve = |m: DMatrix<Complex<f64>>, v: DVector<Complex<f64>>| m.lu().solve(&v);
        let still = solve(&unit - &j, &b * q.conjugate());
        let twice = solve(&unit * (self.multiplier * self.multiplier) - &j, &b * q);
        let (Some(still), Some(twice)) = (still, twice) else { return Ok(None) };
        let terms = [complex(&third) * q, &b * still * Complex::new(2.0, 0.0), b_conjugate * twice];
        let terms = terms.map(|term| self.multiplier.conj() * self.left.dotc(&term) * 0.5);
        let [value, terms] = [terms.iter().map(|t| t.re).sum(), terms.iter().map(|t| t.norm()).sum::<f64>()];
        Ok(terms.is_finite().then_some(Coefficient { value, terms }))
    }
}

/// A unit vector v with (m - eigenvalue) v = 0.
fn null_vector(matrix: &DMatrix<f64>, eigenvalue: Complex<f64>) -> Option<DVector<Complex<f64>>> {
    let n = matrix.nrows();
    let shifted = DMatrix::from_fn(n, n, |i, j| {
        Complex::new(matrix[(i, j)], 0.0) - if i == j { eigenvalue } else { Complex::new(0.0, 0.0) }
    });
    let svd = shifted.svd(false, true);
    let (smallest, _) = svd.singular_values.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
    Some(svd.v_t?.row(smallest).adjoint())
}

#[cfg(test)]
#[allow(clippy::panic)] // a test may fail loudly
mod tests {
    use super::{CANCELS, Coefficient, Pair};
    use nalgebra::{DMatrix, DVector, dmatrix};

    /// The coefficient of a plane map by its derivative around 0.
    fn coefficient(jacobian: impl Fn(f64, f64) -> DMatrix<f64>, step: f64) -> Coefficient {
        let origin = jacobian(0.0, 0.0);
        let at = |by: &DVector<f64>| Ok::<_, ()>(Some(jacobian(by[0], by[1])));
        let pair = Pair::of(&origin).unwrap_or_else(|| panic!("no pair"));
        pair.coefficient(&origin, &at, step).ok().flatten().unwrap_or_else(|| panic!("no coefficient"))
    }

    /// z -> exp(i theta) z (1 + c |z|^2), whose plane has |q| = 1 at z = sqrt 2 w: a is 2 c.
    #[test]
    fn a_map_in_normal_form_has_its_own_coefficient() {
        let (sine, cosine) = 1.0_f64.sin_cos();
        for c in [-1.0, 0.3] {
            let map = |x: f64, y: f64| {
                let turn = dmatrix![cosine, -sine; sine, cosine];
                turn * dmatrix![1.0 + c * (3.0 * x * x + y * y), 2.0 * c * x * y; 2.0 * c * x * y, 1.0 + c * (x * x + 3.0 * y * y)]
            };
            approx::assert_abs_diff_eq!(coefficient(map, 0.01).value, 2.0 * c, epsilon = 1e-9);
        }
    }

    /// The same in other coordinates, u = z + terms of second order: B is no longer 0, and a is what it was.
    #[test]
    fn other_coordinates_do_not_change_it() {
        let (sine, cosine) = 1.0_f64.sin_cos();
        let c = -0.7;
        let turn = dmatrix![cosine, -sine; sine, cosine];
        let value = |x: f64, y: f64| {
            let grow = 1.0 + c * (x * x + y * y);
            ((cosine * x - sine * y) * grow, (sine * x + cosine * y) * grow)
        };
        let slope = |x: f64, y: f64| {
            &turn
                * dmatrix![1.0 + c * (3.0 * x * x + y * y), 2.0 * c * x * y; 2.0 * c * x * y, 1.0 + c * (x * x + 3.0 * y * y)]
        };
        // h(x, y) = (x + y^2, y), whose inverse is (x - y^2, y).
        let map = |u: f64, v: f64| {
            let (x, y) = (u - v * v, v);
            let (_, image) = value(x, y);
            dmatrix![1.0, 2.0 * image; 0.0, 1.0] * slope(x, y) * dmatrix![1.0, -2.0 * v; 0.0, 1.0]
        };
        approx::assert_abs_diff_eq!(coefficient(map, 0.001).value, 2.0 * c, epsilon = 1e-4);
    }

    /// Henon's map that preserves areas: x+ = x cos - (y - x^2) sin, y+ = x sin + (y - x^2) cos.
    #[test]
    fn where_areas_are_preserved_the_terms_cancel() {
        let (sine, cosine) = 1.0_f64.sin_cos();
        let map = |x: f64, _: f64| dmatrix![cosine + 2.0 * x * sine, -sine; sine - 2.0 * x * cosine, cosine];
        let Coefficient { value, terms } = coefficient(map, 0.01);
        assert!(terms > 0.1 && value.abs() < 1e-3 * CANCELS * terms, "{value} of {terms}");
    }

    #[test]
    fn strong_resonance_has_no_coefficient() {
        for angle in [std::f64::consts::FRAC_PI_2, 2.0 * std::f64::consts::FRAC_PI_3, 0.01, 3.13] {
            let (sine, cosine) = angle.sin_cos();
            assert!(Pair::of(&dmatrix![cosine, -sine; sine, cosine]).is_none(), "{angle}");
        }
        assert!(Pair::of(&dmatrix![0.5, 0.0; 0.0, 0.3]).is_none());
        assert!(Pair::of(&dmatrix![0.9, -0.9; 0.9, 0.9]).is_none());
    }
}
