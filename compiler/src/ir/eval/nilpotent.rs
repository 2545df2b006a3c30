//! Numbers with nilpotent parts: a + b e1 + c e2 + d e1 e2 + ..., with every ei^2 = 0.
//!
//! A function evaluated at x + e1 has its derivative in the coefficient of e1; a further derivative takes a further ei.
//! With n generators there are 2^n coefficients; coefficient number b belongs to the product of the ei with bit i of b
//! set. (For n = 1 these are dual numbers, for n = 2 hyper-dual numbers: Fike and Alonso, AIAA 2011-886.)

/// A number with nilpotent parts.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Nilpotent {
    coefficients: Vec<f64>,
}

impl Nilpotent {
    /// A real number.
    pub(super) fn real(value: f64) -> Self {
        Self { coefficients: vec![value] }
    }

    /// The real part.
    pub(super) fn value(&self) -> f64 {
        self.coefficients[0]
    }

    /// `self + e`, with `e` generator number `generator` (counted from 0).
    pub(super) fn perturbed(mut self, generator: usize) -> Self {
        self.grow(generator + 1);
        self.coefficients[1 << generator] += 1.0;
        self
    }

    /// The coefficient of generator number `generator`, a number in the generators below it.
    pub(super) fn coefficient(&self, generator: usize) -> Self {
        let half = 1 << generator;
        let mut high = self.coefficients.get(half..2 * half).map_or_else(|| vec![0.0], <[f64]>::to_vec);
        high.resize(half, 0.0);
        Self { coefficients: high }
    }

    fn generators(&self) -> usize {
        self.coefficients.len().trailing_zeros() as usize
    }

    fn grow(&mut self, generators: usize) {
        let length = self.coefficients.len().max(1 << generators);
        self.coefficients.resize(length, 0.0);
    }

    fn is_zero(&self) -> bool {
        self.coefficients.iter().all(|&c| c == 0.0)
    }

    /// Splits off the highest generator: `low + high e`.
    fn split(&self) -> (Self, Self) {
        let (low, high) = self.coefficients.split_at(self.coefficients.len() / 2);
        (Self { coefficients: low.to_vec() }, Self { coefficients: high.to_vec() })
    }

    fn join(mut low: Self, mut high: Self, generators: usize) -> Self {
        low.grow(generators - 1);
        high.grow(generators - 1);
        low.coefficients.extend(high.coefficients);
        low
    }

    /// Sum.
    pub(super) fn add(&self, other: &Self) -> Self {
        let mut sum = self.clone();
        sum.grow(other.generators());
        for (s, o) in sum.coefficients.iter_mut().zip(&other.coefficients) {
            *s += o;
        }
        sum
    }

    /// Product with a real number.
    pub(super) fn scale(&self, factor: f64) -> Self {
        Self { coefficients: self.coefficients.iter().map(|c| c * factor).collect() }
    }

    /// Product. A coefficient that is exactly zero contributes nothing, even beside an infinity.
    pub(super) fn mul(&self, other: &Self) -> Self {
        let length = self.coefficients.len().max(other.coefficients.len());
        let mut product = vec![0.0; length];
        product[0] = self.value() * other.value();
        for (i, a) in self.coefficients.iter().enumerate() {
            for (j, b) in other.coefficients.iter().enumerate() {
                if i & j == 0 && i + j > 0 && *a != 0.0 && *b != 0.0 {
                    product[i | j] += a * b;
                }
            }
        }
        Self { coefficients: product }
    }

    /// Quotient.
    pub(super) fn div(&self, other: &Self) -> Self {
        if other.coefficients.len() == 1 {
            return Self { coefficients: self.coefficients.iter().map(|c| c / other.value()).collect() };
        }
        self.mul(&other.map(|v| 1.0 / v, |u| Self::real(-1.0).div(&u.mul(u))))
    }

    /// A function of one argument from its real version and its derivative: f(u + v e) = f(u) + f'(u) v e.
    pub(super) fn map(&self, real: impl Fn(f64) -> f64 + Copy, derivative: impl Fn(&Self) -> Self + Copy) -> Self {
        if self.coefficients.len() == 1 {
            return Self::real(real(self.value()));
        }
        let (low, high) = self.split();
        let slope = if high.is_zero() { Self::real(0.0) } else { derivative(&low).mul(&high) };
        Self::join(low.map(real, derivative), slope, self.generators())
    }

    /// Power. The exponent's own variation is followed only where it has one, so that negative bases with constant
    /// integer exponents stay finite.
    pub(super) fn pow(&self, exponent: &Self) -> Self {
        let generators = self.generators().max(exponent.generators());
        if generators == 0 {
            return Self::real(self.value().powf(exponent.value()));
        }
        let (mut base, mut power) = (self.clone(), exponent.clone());
        base.grow(generators);
        power.grow(generators);
        let ((a, da), (b, db)) = (base.split(), power.split());
        let mut slope = Self::real(0.0);
        if !da.is_zero() && !b.is_zero() {
            slope = slope.add(&b.mul(&a.pow(&b.add(&Self::real(-1.0)))).mul(&da));
        }
        if !db.is_zero() {
            slope = slope.add(&a.pow(&b).mul(&a.log()).mul(&db));
        }
        Self::join(a.pow(&b), slope, generators)
    }

    /// Natural logarithm.
    pub(super) fn log(&self) -> Self {
        self.map(f64::ln, |u| Self::real(1.0).div(u))
    }

    /// Sine.
    pub(super) fn sin(&self) -> Self {
        self.map(f64::sin, Self::cos)
    }

    /// Cosine.
    pub(super) fn cos(&self) -> Self {
        self.map(f64::cos, |u| u.sin().scale(-1.0))
    }

    /// Square root.
    pub(super) fn sqrt(&self) -> Self {
        self.map(f64::sqrt, |u| Self::real(0.5).div(&u.sqrt()))
    }

    /// Exponential.
    pub(super) fn exp(&self) -> Self {
        self.map(f64::exp, Self::exp)
    }

    /// Hyperbolic sine.
    pub(super) fn sinh(&self) -> Self {
        self.map(f64::sinh, Self::cosh)
    }

    /// Hyperbolic cosine.
    pub(super) fn cosh(&self) -> Self {
        self.map(f64::cosh, Self::sinh)
    }

    /// Angle of the point (`x`, `self`).
    pub(super) fn atan2(&self, x: &Self) -> Self {
        let generators = self.generators().max(x.generators());
        if generators == 0 {
            return Self::real(self.value().atan2(x.value()));
        }
        let (mut y, mut x) = (self.clone(), x.clone());
        y.grow(generators);
        x.grow(generators);
        let ((y, dy), (x, dx)) = (y.split(), x.split());
        let slope = x.mul(&dy).add(&y.mul(&dx).scale(-1.0)).div(&x.mul(&x).add(&y.mul(&y)));
        Self::join(y.atan2(&x), slope, generators)
    }

    /// `1 + sign self^2`, which the derivatives of the inverse functions need.
    pub(super) fn one_plus_square(&self, sign: f64) -> Self {
        self.mul(self).scale(sign).add(&Self::real(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::Nilpotent;
    use approx::assert_relative_eq;

    fn derivatives(f: impl Fn(&Nilpotent) -> Nilpotent, x: f64) -> [f64; 3] {
        let y = f(&Nilpotent::real(x).perturbed(0).perturbed(1));
        [y.value(), y.coefficients[1], y.coefficients[3]]
    }

    #[test]
    fn second_derivatives_of_the_elementary_functions() {
        let x: f64 = 0.7;
        let cases: [([f64; 3], [f64; 3]); 5] = [
            (derivatives(Nilpotent::sin, x), [x.sin(), x.cos(), -x.sin()]),
            (derivatives(Nilpotent::sqrt, x), [x.sqrt(), 0.5 / x.sqrt(), -0.25 / x.powf(1.5)]),
            (derivatives(Nilpotent::log, x), [x.ln(), 1.0 / x, -1.0 / x / x]),
            (derivatives(|u| u.pow(u), x), {
                let (p, l) = (x.powf(x), x.ln() + 1.0);
                [p, p * l, p * l * l + p / x]
            }),
            (derivatives(|u| Nilpotent::real(1.0).div(u), x), [1.0 / x, -1.0 / (x * x), 2.0 / (x * x * x)]),
        ];
        for (got, want) in cases {
            for i in 0..3 {
                assert_relative_eq!(got[i], want[i], max_relative = 1e-14);
            }
        }
    }

    #[test]
    fn negative_base_with_integer_exponent_has_a_derivative() {
        let cube = |u: &Nilpotent| u.pow(&Nilpotent::real(3.0));
        assert_eq!(derivatives(cube, -2.0), [-8.0, 12.0, -12.0]);
    }
}
