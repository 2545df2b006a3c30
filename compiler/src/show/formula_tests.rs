//! Formulas say what was written: by a table, and by reading back the text and the LaTeX of random expressions.
#![allow(clippy::unwrap_used, clippy::panic)] // a failed unwrap fails the test

use super::latex::Latex;
use super::plain::Plain;
use super::symbol::Symbols;
use crate::front::parser::parse_expression;
use crate::front::syntax::{Arithmetic, Expr, ExprKind};
use crate::front::text::Text;
use crate::source::SourceMap;
use proptest::prelude::*;

/// The tree, the text and the LaTeX of an expression.
fn set(source: &str) -> (Expr, String, String) {
    let mut sources = SourceMap::default();
    let file = sources.add("a.toml", source);
    let root = parse_expression(&Text::whole_file(file, source)).unwrap().root;
    let symbols = Symbols::default();
    let plain = Plain { symbols: &symbols, sources: &sources }.formula(&root);
    let latex = Latex { symbols: &symbols, sources: &sources, inline: false }.formula(&root);
    (root, plain, latex)
}

#[test]
fn formulas_are_typeset() {
    #[rustfmt::skip]
    let rows = [
        ("2*a*b", "2·a·b", r"2\,a\,b"),
        ("(a + b)*c", "(a + b)·c", r"(a + b)\,c"),
        ("a*(b + c)", "a·(b + c)", r"a \cdot (b + c)"),
        ("2*(b + c)*3", "2·(b + c)·3", r"2\,(b + c) \cdot 3"),
        ("a - (b - c)", "a - (b - c)", "a - (b - c)"),
        ("a + (b - c)", "a + b - c", "a + b - c"),
        ("a - -b", "a - (-b)", "a - (-b)"),
        ("a/(b*c)/d", "a/(b·c)/d", r"\frac{\frac{a}{b\,c}}{d}"),
        ("-a/b", "-a/b", r"-\frac{a}{b}"),
        ("(a/b)^2", "(a/b)²", r"\left( \frac{a}{b} \right)^{2}"),
        ("-a^2 + (-a)^2", "-a² + (-a)²", "-a^{2} + (-a)^{2}"),
        ("a^b^12", "a^(b¹²)", "a^{b^{12}}"),
        ("a^(1/2)", "a^(1/2)", "a^{1/2}"),
        ("sin(a)^2*cos(a)", "sin(a)²·cos(a)", r"\sin^{2}(a)\,\cos(a)"),
        ("sin(a)^-1", "sin(a)^(-1)", r"\sin(a)^{-1}"),
        ("sqrt(a/b)^2", "√(a/b)²", r"\left( \sqrt{\frac{a}{b}} \right)^{2}"),
        ("d(r, phi)*w", "(∂r/∂φ)·w", r"\left( \frac{\partial r}{\partial \varphi} \right)\,w"),
        ("-d(r, phi)", "-∂r/∂φ", r"-\frac{\partial r}{\partial \varphi}"),
        ("d(d(r, phi), phi)", "∂²r/∂φ²", r"\frac{\partial^{2} r}{\partial {\varphi}^{2}}"),
        ("d(a*b, b)", "∂(a·b)/∂b", r"\frac{\partial}{\partial b} (a\,b)"),
        ("dot(q_theta)*m", "(dq_θ/dt)·m", r"\dot{q}_{\theta}\,m"),
        ("dot(speed)", "dspeed/dt", r"\frac{\mathrm{d}}{\mathrm{d}t} \mathrm{speed}"),
        ("if(a < b, 1, if(a >= 2, c, 0))", "1 if a < b, c if a ≥ 2, else 0",
         r"\begin{cases} 1 & \text{if } a < b \\ c & \text{if } a \ge 2 \\ 0 & \text{otherwise} \end{cases}"),
        ("2*if(a < b, 1, 0)", "2·(1 if a < b, else 0)",
         r"2\,\left( \begin{cases} 1 & \text{if } a < b \\ 0 & \text{otherwise} \end{cases} \right)"),
        ("max(abs(a), sign(b))", "max(|a|, sign(b))", r"\max\left( \left\lvert a \right\rvert, \operatorname{sign}(b) \right)"),
        ("not a < b and (c > a or c > b)", "not a < b and (c > a or c > b)", r"\lnot (a < b) \land (c > a \lor c > b)"),
        ("3 [m/s]*a - 2 [1/s]", "3 [m/s]·a - 2 [1/s]", r"(3\,\mathrm{m}/\mathrm{s})\,a - 2/\mathrm{s}"),
        ("1e-3*a + 1.50", "1e-3·a + 1.50", r"1 \cdot 10^{-3}\,a + 1.50"),
        ("tau_stall*(1 - w/omega_nl)", "τ_stall·(1 - w/ω_nl)",
         r"\tau_{\mathrm{stall}} \cdot \left( 1 - \frac{w}{\omega_{\mathrm{nl}}} \right)"),
        ("mean(a) + cycle_max(a)", "mean(a) + cycle_max(a)", r"\operatorname{mean}(a) + \max_{\text{cycle}}(a)"),
        ("integral(a + b)/2", "integral(a + b)/2", r"\frac{\int (a + b)\,\mathrm{d}t}{2}"),
    ];
    for (source, plain, latex) in rows {
        let set = set(source);
        assert_eq!((set.1.as_str(), set.2.as_str()), (plain, latex), "{source}");
    }
}

/// The value at a fixed point.
fn value(expr: &Expr) -> f64 {
    match &expr.kind {
        ExprKind::Number(value, _) => *value,
        ExprKind::Name(name) => match name.as_str() {
            "a" => 1.37,
            "b" => -0.61,
            _ => 2.23,
        },
        ExprKind::Neg(a) => -value(a),
        ExprKind::Arithmetic(operator, a, b) => {
            let (a, b) = (value(a), value(b));
            match operator {
                Arithmetic::Add => a + b,
                Arithmetic::Sub => a - b,
                Arithmetic::Mul => a * b,
                Arithmetic::Div => a / b,
                Arithmetic::Pow => a.powf(b),
            }
        }
        _ => panic!("no arithmetic"),
    }
}

/// The text in the language of specs.
fn from_text(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|other| other == c) {
            Some(digit) => out += &format!("^{digit}"),
            None => out.push(if c == '·' { '*' } else { c }),
        }
    }
    out
}

/// The LaTeX in the language of specs: fractions and exponents become parentheses.
fn from_latex(latex: &str) -> String {
    let latex = latex.replace("\\left(", "(").replace("\\right)", ")").replace("\\,", "*").replace("\\cdot", "*");
    let mut out = String::new();
    let mut rest = latex.as_str();
    while let Some(c) = rest.chars().next() {
        if let Some(behind) = rest.strip_prefix("\\frac") {
            let (above, behind) = group(behind);
            let (below, behind) = group(behind);
            out += &format!("(({})/({}))", from_latex(above), from_latex(below));
            rest = behind;
        } else if let Some(behind) = rest.strip_prefix('^') {
            let (exponent, behind) = group(behind);
            out += &format!("^({})", from_latex(exponent));
            rest = behind;
        } else {
            out.push(c);
            rest = &rest[c.len_utf8()..];
        }
    }
    out
}

/// What stands in the braces at the start, and what behind them.
fn group(text: &str) -> (&str, &str) {
    let mut depth = 0;
    for (i, c) in text.char_indices() {
        depth += i32::from(c == '{') - i32::from(c == '}');
        if depth == 0 {
            return (&text[1..i], &text[i + 1..]);
        }
    }
    panic!("braces are not balanced: {text}")
}

fn expression() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![Just("a".to_owned()), Just("b".to_owned()), Just("c".to_owned()), Just("2".to_owned())];
    leaf.prop_recursive(6, 40, 2, |inner| {
        let operator = prop_oneof![Just("+"), Just("-"), Just("*"), Just("/"), Just("^")];
        prop_oneof![
            6 => (inner.clone(), operator, inner.clone()).prop_map(|(a, o, b)| format!("({a}){o}({b})")),
            1 => inner.prop_map(|a| format!("-({a})")),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn formulas_mean_what_was_written(source in expression()) {
        let (tree, plain, latex) = set(&source);
        let wanted = value(&tree);
        for back in [from_text(&plain), from_latex(&latex)] {
            let got = value(&set(&back).0);
            // Sums and products are regrouped where that changes rounding only.
            let close = (got - wanted).abs() <= 1e-6 * wanted.abs() || got == wanted || got.is_nan() && wanted.is_nan();
            let cancels = wanted.abs() < 1e-9 && got.abs() < 1e-9;
            prop_assert!(close || cancels || !wanted.is_finite(), "{source}: {plain}, {latex}: {back} is {got}, not {wanted}");
        }
    }
}
