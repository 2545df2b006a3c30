//! Printing a value in the unit that the user wrote: `20 deg`, `13 cm`, `18.85 rad/s`.

use super::si::si_unit;
use super::units::parse_unit;
use crate::dimension::Dimension;

/// How many significant digits people get to see.
const DIGITS: i32 = 4;

/// Below this magnitude a number is what was left of 0 by underflow, and prints as that.
const VANISHED: f64 = 1e-300;

/// The SI value `value_si` in the unit `unit_text` with that unit behind it. The unit is one that the compiler has
/// accepted; for any other text the value is printed in SI units and says so. An empty unit prints the bare number.
pub fn format_quantity(value_si: f64, unit_text: &str) -> String {
    let unit_text = unit_text.trim();
    match parse_unit(unit_text) {
        Ok(unit) => with_unit(unit.from_si(value_si), unit_text),
        Err(_) => format!("{} (SI)", format_number(value_si)),
    }
}

/// The SI value in the SI unit that people use, e.g. `9.81 m/s^2`, `3 N s/m`; a pure number without unit.
pub fn format_si(value: f64, dimension: Dimension) -> String {
    with_unit(value, &si_unit(dimension))
}

/// The SI value in that unit with all its digits: reading the text gives the same bits.
pub fn format_exact(value: f64, dimension: Dimension) -> String {
    match si_unit(dimension).as_str() {
        "" | "1" => format!("{value}"),
        unit => format!("{value} {unit}"),
    }
}

/// The SI value `value_si` as a number of `unit_text`; unchanged where that is no unit.
pub fn in_unit(value_si: f64, unit_text: &str) -> f64 {
    parse_unit(unit_text).map_or(value_si, |unit| unit.from_si(value_si))
}

fn with_unit(value: f64, unit: &str) -> String {
    match unit {
        "" | "1" => format_number(value),
        "%" | "°" => format!("{}{unit}", format_number(value)),
        _ => format!("{} {unit}", format_number(value)),
    }
}

/// A number with four significant digits, digits before the point never rounded away, no zeros at the end.
pub fn format_number(value: f64) -> String {
    if !value.is_finite() {
        return format!("{value}");
    }
    if value.abs() < VANISHED {
        return "0".to_owned();
    }
    let magnitude = value.abs().log10().floor();
    if !(-4.0..7.0).contains(&magnitude) {
        let text = format!("{value:.*e}", (DIGITS - 1) as usize);
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", trimmed(mantissa));
    }
    // The range check above makes this a small integer.
    let decimals = (DIGITS - 1 - magnitude as i32).max(0) as usize;
    trimmed(&format!("{value:.decimals$}")).to_owned()
}

fn trimmed(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_print_in_the_users_unit() {
        assert_eq!(format_quantity(20f64.to_radians(), "deg"), "20 deg");
        assert_eq!(format_quantity(0.13, "cm"), "13 cm");
        assert_eq!(format_quantity(std::f64::consts::TAU * 3.0, "rad/s"), "18.85 rad/s");
        assert_eq!(format_quantity(0.05, "%"), "5%");
        assert_eq!(format_quantity(0.95, ""), "0.95");
        assert_eq!(format_quantity(0.95, "1"), "0.95");
        assert_eq!(format_quantity(2.0, "no such unit"), "2 (SI)");
        assert_eq!(format_si(9.81, Dimension::base(0)), "9.81 m");
        assert_eq!(format_si(0.5, Dimension::NONE), "0.5");
        assert!((in_unit(0.13, "cm") - 13.0).abs() < 1e-12);
    }

    #[test]
    fn numbers_keep_four_digits_and_all_whole_ones() {
        let rows = [
            (0.0, "0"),
            (-0.0, "0"),
            (1250.0, "1250"),
            (123_456.0, "123456"),
            (0.123_456, "0.1235"),
            (-0.2, "-0.2"),
            (1e-9, "1e-9"),
            (1e-299, "1e-299"),
            (9e-301, "0"),
            (-5e-324, "0"),
            (6.022e23, "6.022e23"),
            (f64::NAN, "NaN"),
            (f64::INFINITY, "inf"),
        ];
        for (value, text) in rows {
            assert_eq!(format_number(value), text);
        }
    }
}
