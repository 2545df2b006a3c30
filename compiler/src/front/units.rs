//! Units: the table, unit expressions such as `kg m/s^2`, and printing a value in the unit that the user wrote.

use crate::dimension::{Dimension, Exponent};
use std::ops::Range;

/// A unit: a value v in it is `v * factor / divisor` in SI units. Two numbers, so that `7 mm` is exactly 7/1000.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// What to multiply by.
    pub factor: f64,
    /// What to divide by.
    pub divisor: f64,
    /// Dimension.
    pub dimension: Dimension,
}

/// Why a unit cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitError {
    /// One lower-case sentence.
    pub message: String,
    /// Bytes of the unit's text that it is about.
    pub range: Range<usize>,
    /// What to write instead.
    pub help: Option<String>,
}

/// How deep parentheses may be nested.
const DEPTH_LIMIT: usize = 32;

/// Exponents of m, kg, s, A, K, mol, cd; factor and divisor; whether SI prefixes apply.
type Row = (&'static str, [i32; 7], f64, f64, bool);

const TAU: f64 = std::f64::consts::TAU;
const PI: f64 = std::f64::consts::PI;

/// Units by symbol. The gram is the one with a prefix in its SI unit.
#[rustfmt::skip]
const TABLE: &[Row] = &[
    ("m",    [1, 0, 0, 0, 0, 0, 0],   1.0, 1.0, true),
    ("g",    [0, 1, 0, 0, 0, 0, 0],   1.0, 1e3, true),
    ("s",    [0, 0, 1, 0, 0, 0, 0],   1.0, 1.0, true),
    ("A",    [0, 0, 0, 1, 0, 0, 0],   1.0, 1.0, true),
    ("K",    [0, 0, 0, 0, 1, 0, 0],   1.0, 1.0, true),
    ("mol",  [0, 0, 0, 0, 0, 1, 0],   1.0, 1.0, true),
    ("cd",   [0, 0, 0, 0, 0, 0, 1],   1.0, 1.0, true),
    ("Hz",   [0, 0, -1, 0, 0, 0, 0],  1.0, 1.0, true),
    ("N",    [1, 1, -2, 0, 0, 0, 0],  1.0, 1.0, true),
    ("Pa",   [-1, 1, -2, 0, 0, 0, 0], 1.0, 1.0, true),
    ("bar",  [-1, 1, -2, 0, 0, 0, 0], 1e5, 1.0, true),
    ("J",    [2, 1, -2, 0, 0, 0, 0],  1.0, 1.0, true),
    ("W",    [2, 1, -3, 0, 0, 0, 0],  1.0, 1.0, true),
    ("C",    [0, 0, 1, 1, 0, 0, 0],   1.0, 1.0, true),
    ("V",    [2, 1, -3, -1, 0, 0, 0], 1.0, 1.0, true),
    ("F",    [-2, -1, 4, 2, 0, 0, 0], 1.0, 1.0, true),
    ("ohm",  [2, 1, -3, -2, 0, 0, 0], 1.0, 1.0, true),
    ("Ω",    [2, 1, -3, -2, 0, 0, 0], 1.0, 1.0, true),
    ("S",    [-2, -1, 3, 2, 0, 0, 0], 1.0, 1.0, true),
    ("Wb",   [2, 1, -2, -1, 0, 0, 0], 1.0, 1.0, true),
    ("T",    [0, 1, -2, -1, 0, 0, 0], 1.0, 1.0, true),
    ("H",    [2, 1, -2, -2, 0, 0, 0], 1.0, 1.0, true),
    ("l",    [3, 0, 0, 0, 0, 0, 0],   1.0, 1e3, true),
    ("L",    [3, 0, 0, 0, 0, 0, 0],   1.0, 1e3, true),
    ("rad",  [0; 7],                  1.0, 1.0, true),
    ("deg",  [0; 7],                  PI, 180.0, false),
    ("°",    [0; 7],                  PI, 180.0, false),
    ("rev",  [0; 7],                  TAU, 1.0, false),
    ("rpm",  [0, 0, -1, 0, 0, 0, 0],  TAU, 60.0, false),
    ("min",  [0, 0, 1, 0, 0, 0, 0],   60.0, 1.0, false),
    ("h",    [0, 0, 1, 0, 0, 0, 0],   3600.0, 1.0, false),
    ("%",    [0; 7],                  1.0, 100.0, false),
];

/// Names of units that are not symbols, in the singular.
#[rustfmt::skip]
const SPELT_OUT: &[(&str, &str)] = &[
    ("meter", "m"), ("metre", "m"), ("gram", "g"), ("kilogram", "kg"), ("second", "s"), ("sec", "s"), ("minute", "min"),
    ("hour", "h"), ("hr", "h"), ("newton", "N"), ("joule", "J"), ("watt", "W"), ("volt", "V"), ("ampere", "A"),
    ("amp", "A"), ("hertz", "Hz"), ("radian", "rad"), ("degree", "deg"), ("pascal", "Pa"), ("kelvin", "K"),
];

/// SI prefixes: factor and divisor.
#[rustfmt::skip]
const PREFIXES: &[(&str, f64, f64)] = &[
    ("p", 1.0, 1e12), ("n", 1.0, 1e9), ("u", 1.0, 1e6), ("µ", 1.0, 1e6), ("μ", 1.0, 1e6), ("m", 1.0, 1e3),
    ("c", 1.0, 1e2), ("d", 1.0, 1e1), ("h", 1e2, 1.0), ("k", 1e3, 1.0), ("M", 1e6, 1.0), ("G", 1e9, 1.0), ("T", 1e12, 1.0),
];

impl Unit {
    /// The pure number 1.
    pub const ONE: Self = Self { factor: 1.0, divisor: 1.0, dimension: Dimension::NONE };

    /// The SI value of `value` of this unit.
    pub fn to_si(&self, value: f64) -> f64 {
        value * self.factor / self.divisor
    }

    /// The SI value `value` in this unit.
    pub fn from_si(&self, value: f64) -> f64 {
        value * self.divisor / self.factor
    }

    fn mul(self, other: Self) -> Option<Self> {
        Some(Self {
            factor: self.factor * other.factor,
            divisor: self.divisor * other.divisor,
            dimension: self.dimension.mul(other.dimension)?,
        })
    }

    fn pow(self, power: Exponent) -> Option<Self> {
        let p = f64::from(power.numerator) / f64::from(power.denominator);
        // Dividing by 10^3 is exact where multiplying by 10^-3 is not.
        let raise = |x: f64| {
            if power.denominator == 1 { x.powi(power.numerator.abs()) } else { x.powf(p.abs()) }
        };
        let (factor, divisor) = (raise(self.factor), raise(self.divisor));
        let (factor, divisor) = if power.numerator < 0 { (divisor, factor) } else { (factor, divisor) };
        let usable = |x: f64| x.is_finite() && x > 0.0;
        (usable(factor) && usable(divisor)).then_some(())?;
        Some(Self { factor, divisor, dimension: self.dimension.pow(power)? })
    }
}

/// The unit behind one symbol, prefix included.
fn symbol(name: &str) -> Option<Unit> {
    let find = |name: &str, prefixed: bool| {
        let row = TABLE.iter().find(|row| row.0 == name && (!prefixed || row.4))?;
        let dimension = Dimension(row.1.map(|numerator| Exponent { numerator, denominator: 1 }));
        Some(Unit { factor: row.2, divisor: row.3, dimension })
    };
    find(name, false).or_else(|| {
        PREFIXES.iter().find_map(|&(prefix, factor, divisor)| {
            let unit = find(name.strip_prefix(prefix)?, true)?;
            Some(Unit { factor: unit.factor * factor, divisor: unit.divisor * divisor, ..unit })
        })
    })
}

/// Reads a unit expression; an empty text is a pure number.
///
/// # Errors
/// A symbol that is not in the table, or something that is no unit expression.
pub fn parse_unit(text: &str) -> Result<Unit, UnitError> {
    let mut parser = Parser { text, at: 0, depth: 0 };
    parser.spaces();
    if parser.at == text.len() {
        return Ok(Unit::ONE);
    }
    let unit = parser.product()?;
    match parser.peek() {
        None => Ok(unit),
        Some(c) => Err(parser.error(parser.at..parser.at + c.len_utf8(), format!("unexpected `{c}` in a unit"), None)),
    }
}

struct Parser<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
}

impl Parser<'_> {
    fn peek(&self) -> Option<char> {
        self.text.get(self.at..).and_then(|rest| rest.chars().next())
    }

    fn spaces(&mut self) {
        while let Some(c) = self.peek().filter(|c| c.is_whitespace()) {
            self.at += c.len_utf8();
        }
    }

    fn error(&self, range: Range<usize>, message: String, help: Option<String>) -> UnitError {
        UnitError { message, range, help }
    }

    fn product(&mut self) -> Result<Unit, UnitError> {
        let start = self.at;
        let mut unit = self.power()?;
        let mut divided = false;
        loop {
            self.spaces();
            let at = self.at;
            let (divide, bare) = match self.peek() {
                None | Some(')') => return Ok(unit),
                Some('/') => (true, false),
                Some('*' | '·') => (false, false),
                Some(_) => (false, true),
            };
            if bare && divided {
                let help = "write parentheses, as in `J/(kg K)`, or `*`, as in `J/kg*K`".to_owned();
                let message = "a product by space after `/` can be read in two ways".to_owned();
                return Err(self.error(start..self.text.len(), message, Some(help)));
            }
            divided |= divide;
            if !bare {
                self.at += self.peek().map_or(0, char::len_utf8);
                self.spaces();
            }
            let next = self.power()?;
            let next = if divide { next.pow(Exponent { numerator: -1, denominator: 1 }) } else { Some(next) };
            let overflow = || self.error(at..self.at, "the exponent is out of range".to_owned(), None);
            unit = next.and_then(|next| unit.mul(next)).ok_or_else(overflow)?;
        }
    }

    fn power(&mut self) -> Result<Unit, UnitError> {
        let start = self.at;
        let unit = self.atom()?;
        let power = match self.peek() {
            Some('²') => Some((2, '²')),
            Some('³') => Some((3, '³')),
            _ => None,
        };
        let exponent = if let Some((numerator, c)) = power {
            self.at += c.len_utf8();
            Exponent { numerator, denominator: 1 }
        } else {
            self.spaces();
            if self.peek() != Some('^') {
                return Ok(unit);
            }
            self.at += 1;
            self.spaces();
            self.exponent()?
        };
        let range = start..self.at;
        unit.pow(exponent).ok_or_else(|| self.error(range, "the exponent is out of range".to_owned(), None))
    }

    /// `2`, `-2`, `(1/2)` or `(-1/2)`.
    fn exponent(&mut self) -> Result<Exponent, UnitError> {
        let start = self.at;
        let wrong = |this: &Self| {
            let help = "write a whole number, as in `m^2` or `s^-1`, or a fraction in parentheses, as in `m^(1/2)`";
            let end =
                this.at.max(start + this.text.get(start..).and_then(|t| t.chars().next()).map_or(0, char::len_utf8));
            this.error(start..end, "this is no exponent of a unit".to_owned(), Some(help.to_owned()))
        };
        if self.peek() != Some('(') {
            let numerator = self.integer().ok_or_else(|| wrong(self))?;
            return Ok(Exponent { numerator, denominator: 1 });
        }
        self.at += 1;
        let numerator = self.integer().ok_or_else(|| wrong(self))?;
        let denominator = if self.peek() == Some('/') {
            self.at += 1;
            self.integer().ok_or_else(|| wrong(self))?
        } else {
            1
        };
        if self.peek() != Some(')') {
            return Err(wrong(self));
        }
        self.at += 1;
        Exponent::new(numerator, denominator).ok_or_else(|| wrong(self))
    }

    fn integer(&mut self) -> Option<i32> {
        let rest = self.text.get(self.at..)?;
        let digits = rest.strip_prefix('-').unwrap_or(rest);
        let count = digits.bytes().take_while(u8::is_ascii_digit).count();
        let length = rest.len() - digits.len() + count;
        let value = rest.get(..length)?.parse().ok()?;
        self.at += length;
        Some(value)
    }

    fn atom(&mut self) -> Result<Unit, UnitError> {
        let start = self.at;
        match self.peek() {
            Some('(') if self.depth < DEPTH_LIMIT => {
                self.depth += 1;
                self.at += 1;
                self.spaces();
                let unit = self.product()?;
                self.depth -= 1;
                if self.peek() != Some(')') {
                    return Err(self.error(start..self.at, "this `(` of a unit is not closed".to_owned(), None));
                }
                self.at += 1;
                Ok(unit)
            }
            Some('(') => Err(self.error(start..start + 1, "too many parentheses in a unit".to_owned(), None)),
            Some(c) if c.is_ascii_digit() => self.one(start),
            Some(c) if is_symbol(c) => {
                while let Some(c) = self.peek().filter(|&c| is_symbol(c) || c.is_ascii_digit()) {
                    self.at += c.len_utf8();
                }
                let name = self.text.get(start..self.at).unwrap_or("");
                symbol(name).ok_or_else(|| self.unknown(name, start))
            }
            Some(c) => Err(self.error(start..start + c.len_utf8(), format!("unexpected `{c}` in a unit"), None)),
            None => Err(self.error(start..start, "the unit ends too early".to_owned(), None)),
        }
    }

    /// The number 1, the only one that a unit may hold.
    fn one(&mut self, start: usize) -> Result<Unit, UnitError> {
        while let Some(c) = self.peek().filter(|&c| c.is_ascii_digit() || c == '.') {
            self.at += c.len_utf8();
        }
        match self.text.get(start..self.at) {
            Some("1") => Ok(Unit::ONE),
            _ => {
                let help = "put the number into the value, before the unit".to_owned();
                Err(self.error(start..self.at, "a unit holds no number but 1".to_owned(), Some(help)))
            }
        }
    }

    fn unknown(&self, name: &str, start: usize) -> UnitError {
        let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
        let help = if name == "pi" {
            Some("multiply in the value, as in `2*pi rad`".to_owned())
        } else if let Some((_, short)) =
            SPELT_OUT.iter().find(|(long, _)| name.trim_end_matches('s').eq_ignore_ascii_case(long))
        {
            Some(format!("did you mean `{short}`?"))
        } else if stem != name && symbol(stem).is_some() {
            Some(format!("write a power as `{stem}^{}`", name.get(stem.len()..).unwrap_or("")))
        } else if symbol(&name.to_lowercase()).is_some() {
            Some(format!("did you mean `{}`?", name.to_lowercase()))
        } else {
            let known = ["m", "kg", "s", "N", "J", "W", "Hz", "rad", "deg", "rev", "rpm", "min", "h", "bar", "ohm"];
            super::names::suggest(name, known.iter().copied()).map(|near| format!("did you mean `{near}`?"))
        };
        self.error(start..self.at, format!("unknown unit `{name}`"), help)
    }
}

fn is_symbol(c: char) -> bool {
    c.is_alphabetic() || matches!(c, '%' | '°' | 'µ' | 'Ω')
}

#[cfg(test)]
#[path = "units_tests.rs"]
mod tests;
