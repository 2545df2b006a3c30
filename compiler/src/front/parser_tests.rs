//! Tests of the expression grammar: precedence, and that no text can exhaust the stack.
#![allow(clippy::unwrap_used)] // a failed unwrap fails the test

use super::*;
use crate::source::SourceMap;

/// The tree as an S-expression.
fn shape(expr: &Expr) -> String {
    match &expr.kind {
        ExprKind::Number(value, None) => format!("{value}"),
        ExprKind::Number(value, Some(unit)) => format!("{value}[{}]", unit.dimension),
        ExprKind::Name(name) => name.clone(),
        ExprKind::Neg(a) => format!("(neg {})", shape(a)),
        ExprKind::Not(a) => format!("(not {})", shape(a)),
        ExprKind::Arithmetic(op, a, b) => format!("({} {} {})", op.symbol(), shape(a), shape(b)),
        ExprKind::Compare(op, a, b) => format!("({} {} {})", op.symbol(), shape(a), shape(b)),
        ExprKind::Logic(op, a, b) => format!("({op:?} {} {})", shape(a), shape(b)),
        ExprKind::Call(call) => {
            let arguments: Vec<_> = call.arguments.iter().map(shape).collect();
            format!("{}({})", call.name, arguments.join(", "))
        }
    }
}

fn parse(text: &str) -> Result<Expression, Box<Diagnostic>> {
    let file = SourceMap::default().add("test", text);
    parse_expression(&Text::whole_file(file, text))
}

#[test]
fn precedence_and_associativity() {
    let rows = [
        ("a - b - c", "(- (- a b) c)"),
        ("a + b*c", "(+ a (* b c))"),
        ("a/b/c", "(/ (/ a b) c)"),
        ("-x^2", "(neg (^ x 2))"),
        ("2^-1", "(^ 2 (neg 1))"),
        ("2^3^2", "(^ 2 (^ 3 2))"),
        ("2^-x^2", "(^ 2 (neg (^ x 2)))"),
        ("-a*b", "(* (neg a) b)"),
        ("a*-b + c", "(+ (* a (neg b)) c)"),
        ("--a", "(neg (neg a))"),
        ("+a", "a"),
        ("(-1)^n", "(^ (neg 1) n)"),
        ("3 [m/s]*t", "(* 3[m s^-1] t)"),
        ("atan2(y, x)", "atan2(y, x)"),
        ("f()", "f()"),
        ("a < b and c >= d or not e > f", "(Or (And (< a b) (>= c d)) (not (> e f)))"),
        ("if(not a < b and c < d, 1, 2)", "if((And (not (< a b)) (< c d)), 1, 2)"),
    ];
    for (text, expected) in rows {
        assert_eq!(shape(&parse(text).unwrap().root), expected, "{text}");
    }
}

#[test]
fn wrong_expressions_point_at_the_characters() {
    let rows = [
        ("a + ", Code::Syntax, 4..4),
        ("  ", Code::Syntax, 0..2),
        ("(a + b", Code::Syntax, 0..1),
        ("f(a, b", Code::Syntax, 1..2),
        ("f(a,)", Code::Syntax, 4..5),
        ("a b", Code::Syntax, 2..3),
        ("2 x", Code::Syntax, 2..3),
        ("a ** 2", Code::Syntax, 2..4),
        ("a <= b <= c", Code::Syntax, 7..9),
        ("x [m]", Code::Syntax, 2..5),
        ("3 [m", Code::Syntax, 2..3),
        ("3 [parsec]", Code::Unit, 3..9),
        ("1e999", Code::Number, 0..5),
        ("a + and", Code::Syntax, 4..7),
        ("a )", Code::Syntax, 2..3),
        ("a = b", Code::Syntax, 2..3),
    ];
    for (text, code, range) in rows {
        let error = parse(text).unwrap_err();
        let span = error.primary().unwrap();
        assert_eq!((error.code, span.start..span.end), (code, range), "{text}: {}", error.message);
    }
}

#[test]
fn no_text_exhausts_the_stack() {
    for piece in ["(", "-", "f(", "not ", "2^", "a+", "+", "a<b and ", "if(a<b,", "[", "-(2^"] {
        for count in [100, 5_000, 1_000_000] {
            drop(parse(&piece.repeat(count)));
        }
    }
    // The longest chain and the deepest tree that are accepted.
    assert!(parse(&format!("a{}", "+a".repeat(4_990))).is_ok());
    assert!(parse(&format!("{}a{}", "(".repeat(DEPTH_LIMIT - 1), ")".repeat(DEPTH_LIMIT - 1))).is_ok());
    let error = parse(&format!("{}a{}", "(".repeat(DEPTH_LIMIT), ")".repeat(DEPTH_LIMIT))).unwrap_err();
    assert_eq!(error.code, Code::TooComplex);
}

#[test]
fn names_remember_whether_they_are_inside_a_functional() {
    let names = parse("mean(abs(v)) + m").unwrap().names;
    let flat: Vec<_> = names.iter().map(|name| (name.name.as_str(), name.in_functional)).collect();
    assert_eq!(flat, [("mean", false), ("abs", true), ("v", true), ("m", false)]);
}
