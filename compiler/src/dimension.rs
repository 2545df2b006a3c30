//! Physical dimensions: rational exponents of the seven SI base units.

use std::fmt;

/// A rational exponent in lowest terms, denominator positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Exponent {
    /// Numerator.
    pub numerator: i32,
    /// Denominator, at least 1.
    pub denominator: i32,
}

/// Exponents of m, kg, s, A, K, mol, cd. The radian is dimensionless.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dimension(pub [Exponent; 7]);

/// The base units, in the order of the exponents.
pub(crate) const SYMBOLS: [&str; 7] = ["m", "kg", "s", "A", "K", "mol", "cd"];

#[allow(clippy::should_implement_trait)] // these return None on overflow, the operators cannot
impl Exponent {
    /// Zero.
    pub const ZERO: Self = Self { numerator: 0, denominator: 1 };

    /// In lowest terms. A zero denominator or an overflow gives `None`.
    pub fn new(numerator: i32, denominator: i32) -> Option<Self> {
        if denominator == 0 {
            return None;
        }
        let (n, d) = (i64::from(numerator), i64::from(denominator));
        Self::reduced(n, d)
    }

    fn reduced(n: i64, d: i64) -> Option<Self> {
        let (mut a, mut b) = (n.abs(), d.abs());
        while b != 0 {
            (a, b) = (b, a % b);
        }
        let a = a.max(1) * d.signum();
        Some(Self { numerator: i32::try_from(n / a).ok()?, denominator: i32::try_from(d / a).ok()? })
    }

    /// Sum; `None` on overflow.
    pub fn add(self, other: Self) -> Option<Self> {
        let (a, b, c, d) = self.parts(other);
        Self::reduced(a * d + c * b, b * d)
    }

    /// Product; `None` on overflow.
    pub fn mul(self, other: Self) -> Option<Self> {
        let (a, b, c, d) = self.parts(other);
        Self::reduced(a * c, b * d)
    }

    fn parts(self, other: Self) -> (i64, i64, i64, i64) {
        (self.numerator.into(), self.denominator.into(), other.numerator.into(), other.denominator.into())
    }
}

#[allow(clippy::should_implement_trait)] // these return None on overflow, the operators cannot
impl Dimension {
    /// A pure number.
    pub const NONE: Self = Self([Exponent::ZERO; 7]);
    /// A time.
    pub const TIME: Self = Self::base(2);

    /// The dimension of base unit number `i` (m, kg, s, A, K, mol, cd).
    pub const fn base(i: usize) -> Self {
        let mut exponents = [Exponent::ZERO; 7];
        exponents[i] = Exponent { numerator: 1, denominator: 1 };
        Self(exponents)
    }

    /// Whether it is a pure number.
    pub fn is_none(self) -> bool {
        self == Self::NONE
    }

    /// Dimension of a product; `None` on overflow of an exponent.
    pub fn mul(self, other: Self) -> Option<Self> {
        let mut result = self;
        for (e, o) in result.0.iter_mut().zip(other.0) {
            *e = e.add(o)?;
        }
        Some(result)
    }

    /// Dimension of a power; `None` on overflow of an exponent.
    pub fn pow(self, power: Exponent) -> Option<Self> {
        let mut result = self;
        for e in &mut result.0 {
            *e = e.mul(power)?;
        }
        Some(result)
    }

    /// Dimension of a quotient; `None` on overflow of an exponent.
    pub fn div(self, other: Self) -> Option<Self> {
        self.mul(other.pow(Exponent { numerator: -1, denominator: 1 })?)
    }
}

impl fmt::Display for Dimension {
    /// As a product of base units, e.g. `kg m s^-2`; `1` for a pure number.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut first = true;
        for (symbol, e) in SYMBOLS.iter().zip(self.0) {
            if e.numerator == 0 {
                continue;
            }
            if !first {
                f.write_str(" ")?;
            }
            first = false;
            match (e.numerator, e.denominator) {
                (1, 1) => write!(f, "{symbol}")?,
                (n, 1) => write!(f, "{symbol}^{n}")?,
                (n, d) => write!(f, "{symbol}^({n}/{d})")?,
            }
        }
        if first { f.write_str("1") } else { Ok(()) }
    }
}
