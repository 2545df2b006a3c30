//! Tests of the table of units and of unit expressions.
#![allow(clippy::unwrap_used)] // a failed unwrap fails the test

use super::*;

/// SI value of one `unit`, and its dimension in SI base units.
fn one(unit: &str) -> (f64, String) {
    let unit = parse_unit(unit).unwrap();
    (unit.to_si(1.0), unit.dimension.to_string())
}

#[test]
fn the_table_against_the_definitions() {
    let rows = [
        ("kg", 1.0, "kg"),
        ("g", 1e-3, "kg"),
        ("mm", 1e-3, "m"),
        ("N", 1.0, "m kg s^-2"),
        ("J", 1.0, "m^2 kg s^-2"),
        ("N m", 1.0, "m^2 kg s^-2"),
        ("kW", 1e3, "m^2 kg s^-3"),
        ("V A", 1.0, "m^2 kg s^-3"),
        ("V/A", 1.0, "m^2 kg s^-3 A^-2"),
        ("ohm", 1.0, "m^2 kg s^-3 A^-2"),
        ("kΩ", 1e3, "m^2 kg s^-3 A^-2"),
        ("C", 1.0, "s A"),
        ("Hz", 1.0, "s^-1"),
        ("rpm", std::f64::consts::TAU / 60.0, "s^-1"),
        ("rev/min", std::f64::consts::TAU / 60.0, "s^-1"),
        ("km/h", 1.0 / 3.6, "m s^-1"),
        ("bar", 1e5, "m^-1 kg s^-2"),
        ("mbar", 100.0, "m^-1 kg s^-2"),
        ("ml", 1e-6, "m^3"),
        ("cm^3", 1e-6, "m^3"),
        ("%", 0.01, "1"),
        ("deg", std::f64::consts::PI / 180.0, "1"),
        ("°", std::f64::consts::PI / 180.0, "1"),
        ("1", 1.0, "1"),
        ("", 1.0, "1"),
        ("1/s", 1.0, "s^-1"),
        ("kg m^2", 1.0, "m^2 kg"),
        ("kg·m²", 1.0, "m^2 kg"),
        ("m/s^2", 1.0, "m s^-2"),
        ("N/(m/s)", 1.0, "kg s^-1"),
        ("N s/m", 1.0, "kg s^-1"),
        ("W/(m K)", 1.0, "m kg s^-3 K^-1"),
        ("m^(1/2)", 1.0, "m^(1/2)"),
        ("s^-1", 1.0, "s^-1"),
    ];
    for (unit, value, dimension) in rows {
        let (got, got_dimension) = one(unit);
        assert!((got - value).abs() <= 1e-15 * value, "{unit}: {got}");
        assert_eq!(got_dimension, dimension, "{unit}");
    }
}

#[test]
fn decimal_values_convert_without_rounding_twice() {
    for (value, unit, si) in [(13.0, "cm", 0.13), (7.0, "mm", 0.007), (6.5, "cm", 0.065), (3.0, "mm^2", 3e-6)] {
        assert_eq!(parse_unit(unit).unwrap().to_si(value), si);
    }
}

#[test]
fn exact_symbols_win_over_prefixes() {
    assert_eq!(one("min").1, "s"); // not milli-inch
    assert_eq!(one("cd").1, "cd");
    assert_eq!(one("Pa").1, "m^-1 kg s^-2");
    assert_eq!(one("h").0, 3600.0);
}

#[test]
fn wrong_units_say_where_and_what_to_write() {
    let rows = [
        ("m/s2", "unknown unit `s2`", Some("write a power as `s^2`"), 2..4),
        ("parsec", "unknown unit `parsec`", None, 0..6),
        ("Kg", "unknown unit `Kg`", Some("did you mean `kg`?"), 0..2),
        ("J/kg K", "a product by space after `/` can be read in two ways", Some("J/(kg K)"), 0..6),
        ("m^", "this is no exponent of a unit", Some("whole number"), 2..2),
        ("m^(1/0)", "this is no exponent of a unit", Some("fraction"), 2..7),
        ("(m", "this `(` of a unit is not closed", None, 0..2),
        ("2 m", "a unit holds no number but 1", Some("before the unit"), 0..1),
        ("m)", "unexpected `)` in a unit", None, 1..2),
        ("m/", "the unit ends too early", None, 2..2),
        ("m^99999999999", "this is no exponent of a unit", Some("whole number"), 2..3),
        ("km^2147483647", "the exponent is out of range", None, 0..13),
    ];
    for (text, message, help, range) in rows {
        let error = parse_unit(text).unwrap_err();
        assert_eq!(error.message, message, "{text}");
        assert_eq!(error.range, range, "{text}");
        match help {
            Some(part) => assert!(error.help.as_deref().unwrap().contains(part), "{text}: {:?}", error.help),
            None => assert_eq!(error.help, None, "{text}"),
        }
    }
}

#[test]
fn deep_parentheses_are_an_error_not_an_overflow() {
    assert!(parse_unit(&"(".repeat(100_000)).is_err());
}
