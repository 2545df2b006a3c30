//! Units for print where the user wrote none: a named SI unit, or a quotient of base units.

use super::units::parse_unit;
use crate::dimension::{Dimension, SYMBOLS};

/// Units of SI value 1 that have a name, alone or over another one.
const NAMED: &[&str] =
    &["N", "J", "W", "Pa", "V", "C", "F", "ohm", "S", "Wb", "T", "H", "N/m", "N s/m", "W/m", "W/s", "N/s"];

/// A unit of SI value 1: one that has a name, else a quotient of base units such as `kg m^2/s`; `1` for a pure number.
pub fn si_unit(dimension: Dimension) -> String {
    named(dimension).map_or_else(|| quotient(dimension), str::to_owned)
}

/// The SI unit of a quantity that is written in `unit`: of an angle, and of how fast it changes, radians, which the dimension alone does
/// not tell.
pub fn si_unit_like(dimension: Dimension, unit: &str) -> String {
    let angle = ["deg", "rad", "\u{b0}"].iter().any(|angle| unit.contains(angle));
    match si_unit(dimension).as_str() {
        "1" if angle => "rad".to_owned(),
        "s^-1" if angle => "rad/s".to_owned(),
        si => si.to_owned(),
    }
}

/// The unit in words: `dimensionless`, `m/s`, and for one that has a name what it is made of, `N (kg m/s^2)`.
pub(crate) fn dimension_text(dimension: Dimension) -> String {
    match named(dimension) {
        _ if dimension.is_none() => "dimensionless".to_owned(),
        Some(named) => format!("{named} ({})", quotient(dimension)),
        None => quotient(dimension),
    }
}

fn named(dimension: Dimension) -> Option<&'static str> {
    NAMED.iter().copied().find(|text| parse_unit(text).is_ok_and(|unit| unit.dimension == dimension))
}

fn quotient(dimension: Dimension) -> String {
    // Mass first, as people write it.
    let order = [1, 0, 2, 3, 4, 5, 6].map(|i| (SYMBOLS[i], dimension.0[i]));
    let power = |symbol: &str, n: i32, d: i32| match (n, d) {
        (1, 1) => symbol.to_owned(),
        (n, 1) => format!("{symbol}^{n}"),
        (n, d) => format!("{symbol}^({n}/{d})"),
    };
    let some = || order.into_iter().filter(|(_, e)| e.numerator != 0);
    if some().all(|(_, e)| e.numerator < 0) {
        // Behind a number `s^-1` reads better than `1/s`.
        let powers: Vec<String> = some().map(|(symbol, e)| power(symbol, e.numerator, e.denominator)).collect();
        return if powers.is_empty() { "1".to_owned() } else { powers.join(" ") };
    }
    let side = |sign: i32| -> Vec<String> {
        let of_side = some().filter(|(_, e)| e.numerator.signum() == sign);
        of_side.map(|(symbol, e)| power(symbol, e.numerator.abs(), e.denominator)).collect()
    };
    let (over, under) = (side(1).join(" "), side(-1));
    match under.as_slice() {
        [] => over,
        [one] => format!("{over}/{one}"),
        several => format!("{over}/({})", several.join(" ")),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a failed unwrap fails the test
    use super::*;

    #[test]
    fn units_have_names_or_are_quotients_that_can_be_read_again() {
        for (text, printed) in [
            ("kg m s^-2", "N"),
            ("N m", "J"),
            ("J/s", "W"),
            ("kg/s^2", "N/m"),
            ("m/s^2", "m/s^2"),
            ("rad/s", "s^-1"),
            ("kg m^2", "kg m^2"),
            ("J/(kg K)", "m^2/(s^2 K)"),
            ("m^(1/2)", "m^(1/2)"),
            ("1/(m^(3/2) s)", "m^(-3/2) s^-1"),
            ("%", "1"),
        ] {
            let dimension = parse_unit(text).unwrap().dimension;
            assert_eq!(si_unit(dimension), printed, "{text}");
            let again = parse_unit(printed).unwrap();
            assert_eq!((again.dimension, again.to_si(1.0)), (dimension, 1.0), "{printed}");
        }
        // A named unit is the coherent one.
        for named in NAMED {
            assert_eq!(parse_unit(named).unwrap().to_si(1.0), 1.0, "{named}");
        }
        assert_eq!(dimension_text(parse_unit("N").unwrap().dimension), "N (kg m/s^2)");
    }
}
