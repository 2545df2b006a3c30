//! Literals and units as the user wrote them.

use crate::front::format_si;
use crate::front::units::{Unit, parse_unit};
use crate::source::{SourceMap, Span};

/// A literal: its number (`None` for a unit that stands by itself, behind a product) and its unit.
pub(super) struct Literal {
    pub(super) number: Option<String>,
    pub(super) unit: Option<String>,
    /// Whether the unit stands in brackets.
    pub(super) brackets: bool,
}

/// Reads off how a literal was written; where that is not to be seen (escapes in a string), its value in SI units.
pub(super) fn literal(value: f64, unit: Option<Unit>, span: Span, sources: &SourceMap) -> Literal {
    let mut written = sources.slice(span).trim();
    // The place of an expression in parentheses is that of the parentheses.
    while let Some(inner) = written.strip_prefix('(').and_then(|rest| rest.strip_suffix(')')) {
        written = inner.trim();
    }
    let is = |text: &str| text.parse() == Ok(value);
    let same = |text: &str| parse_unit(text).ok() == unit;
    let Some(unit) = unit else {
        let number = if is(written) { written.to_owned() } else { number(value) };
        return Literal { number: Some(number), unit: None, brackets: false };
    };
    if value == 1.0 && same(written) {
        return Literal { number: None, unit: Some(written.trim().to_owned()), brackets: false };
    }
    let end = written.find(|c: char| c == '[' || c.is_whitespace()).unwrap_or(written.len());
    let (front, rest) = (written.get(..end).unwrap_or(""), written.get(end..).unwrap_or("").trim());
    let inner = rest.strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
    let text = inner.unwrap_or(rest).trim();
    if is(front) && same(text) {
        return Literal { number: Some(front.to_owned()), unit: Some(text.to_owned()), brackets: inner.is_some() };
    }
    let si = format_si(1.0, unit.dimension);
    let si = si.strip_prefix("1").unwrap_or("").trim();
    Literal { number: Some(number(unit.to_si(value))), unit: Some(si.to_owned()), brackets: true }
}

/// The shortest text of a number that reads back as it.
pub(super) fn number(value: f64) -> String {
    if value != 0.0 && !(1e-4..1e7).contains(&value.abs()) { format!("{value:e}") } else { format!("{value}") }
}

/// LaTeX of a number, powers of ten included.
pub(super) fn number_latex(number: &str) -> String {
    let lower = number.to_ascii_lowercase();
    match lower.split_once('e') {
        Some((mantissa, exponent)) => {
            format!("{mantissa} \\cdot 10^{{{}}}", exponent.strip_prefix('+').unwrap_or(exponent))
        }
        None => lower,
    }
}

/// LaTeX of a unit, upright; empty for a pure number.
pub(super) fn unit_latex(unit: &str) -> String {
    let mut out = String::new();
    let mut rest = unit.trim();
    if rest == "1" || rest.is_empty() {
        return out;
    }
    while let Some(c) = rest.chars().next() {
        let end = |belongs: fn(char) -> bool| rest.find(|c: char| !belongs(c)).unwrap_or(rest.len());
        let used = match c {
            c if c.is_ascii_alphabetic() => {
                let end = end(|c| c.is_ascii_alphabetic());
                out += &format!("\\mathrm{{{}}}", rest.get(..end).unwrap_or(""));
                end
            }
            '^' => {
                let power = rest.get(1..).unwrap_or("").trim_start();
                let skipped = rest.len() - power.len();
                let end = match power.chars().next() {
                    Some('(') => power.find(')').map_or(power.len(), |at| at + 1),
                    _ => power.find(|c: char| !(c.is_ascii_digit() || c == '-')).unwrap_or(power.len()),
                };
                let inner = power.get(..end).unwrap_or("").trim_matches(['(', ')']).trim();
                out += &format!("^{{{inner}}}");
                skipped + end
            }
            '%' => push(&mut out, "\\%", c),
            '°' => push(&mut out, "^{\\circ}", c),
            'Ω' => push(&mut out, "\\Omega ", c),
            'µ' | 'μ' => push(&mut out, "\\mu ", c),
            '*' | '·' | ' ' => {
                let end = end(|c| matches!(c, '*' | '·' | ' '));
                // Spaces around a `/` or a parenthesis mean nothing.
                let next = rest.get(end..).and_then(|rest| rest.chars().next());
                if !matches!(next, Some('/' | ')' | '^') | None) && !out.ends_with(['/', '(']) {
                    out.push_str("\\,");
                }
                end
            }
            c if c.is_ascii_digit() || matches!(c, '/' | '(' | ')' | '-') => push(&mut out, &c.to_string(), c),
            c => c.len_utf8(), // no unit has it
        };
        rest = rest.get(used..).unwrap_or("");
    }
    out
}

fn push(out: &mut String, latex: &str, c: char) -> usize {
    out.push_str(latex);
    c.len_utf8()
}

/// LaTeX of a printed quantity, e.g. `-20 deg` or `5%`.
pub(super) fn quantity_latex(shown: &str) -> String {
    let end = shown.find([' ', '%', '°']).unwrap_or(shown.len());
    let (number, unit) = (shown.get(..end).unwrap_or(""), unit_latex(shown.get(end..).unwrap_or("")));
    let number = number_latex(number);
    if unit.is_empty() { number } else { with_unit(&number, &unit) }
}

/// A number and its unit, both in LaTeX; of the unit `1/s` the 1 is not written.
pub(super) fn with_unit(number: &str, unit: &str) -> String {
    match unit.strip_prefix("1/") {
        Some(below) => format!("{number}/{below}"),
        None => format!("{number}\\,{unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_upright() {
        let rows = [
            ("m/s^2", "\\mathrm{m}/\\mathrm{s}^{2}"),
            ("N m", "\\mathrm{N}\\,\\mathrm{m}"),
            ("J/(kg K)", "\\mathrm{J}/(\\mathrm{kg}\\,\\mathrm{K})"),
            ("m^(1/2)", "\\mathrm{m}^{1/2}"),
            ("s^-1", "\\mathrm{s}^{-1}"),
            ("N * m / s", "\\mathrm{N}\\,\\mathrm{m}/\\mathrm{s}"),
            ("%", "\\%"),
            ("1", ""),
        ];
        for (unit, latex) in rows {
            assert_eq!(unit_latex(unit), latex, "{unit}");
        }
        assert_eq!(quantity_latex("-20 deg"), "-20\\,\\mathrm{deg}");
        assert_eq!(quantity_latex("1e-6 kg"), "1 \\cdot 10^{-6}\\,\\mathrm{kg}");
        assert_eq!(quantity_latex("0.95"), "0.95");
        assert_eq!(quantity_latex("2 1/s"), "2/\\mathrm{s}");
    }
}
