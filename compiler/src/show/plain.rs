//! Formulas for a terminal: `m·p_θ²/r`, with as few parentheses as the precedence of operators allows.

use super::level::{Level, Piece, branches, derivative, negated};
use super::literal::literal;
use super::symbol::Symbols;
use crate::front::syntax::{Arithmetic, Call, Comparison, Expr, ExprKind, Logic};
use crate::source::SourceMap;

/// Prints expressions of one spec.
#[derive(Clone, Copy)]
pub(super) struct Plain<'a> {
    pub(super) symbols: &'a Symbols,
    pub(super) sources: &'a SourceMap,
}

impl Plain<'_> {
    /// A whole formula.
    pub(super) fn formula(self, expr: &Expr) -> String {
        self.piece(expr).0
    }

    /// A formula in a place that asks for a level.
    pub(super) fn at(self, expr: &Expr, least: Level) -> String {
        let (text, level) = self.piece(expr);
        if level < least { format!("({text})") } else { text }
    }

    /// One that follows an operator.
    fn behind(self, expr: &Expr, least: Level) -> String {
        following(self.piece(expr), least)
    }

    fn piece(self, expr: &Expr) -> Piece {
        match &expr.kind {
            ExprKind::Number(value, unit) => {
                let literal = literal(*value, *unit, expr.span, self.sources);
                match (literal.number, literal.unit) {
                    (Some(number), Some(unit)) if literal.brackets => (format!("{number} [{unit}]"), Level::Atom),
                    (Some(number), Some(unit)) => (format!("{number} {unit}"), Level::Product),
                    (number, unit) => (number.or(unit).unwrap_or_default(), Level::Atom),
                }
            }
            ExprKind::Name(name) => (self.symbols.get(name).text, Level::Atom),
            ExprKind::Neg(a) => {
                // Once: twice at each of many signs would never end.
                let piece = self.piece(a);
                let level = negated(piece.1);
                (format!("-{}", following(piece, Level::Differential)), level)
            }
            ExprKind::Not(a) => (format!("not {}", self.at(a, Level::Not)), Level::Not),
            ExprKind::Arithmetic(operator, a, b) => self.arithmetic(*operator, a, b),
            ExprKind::Compare(operator, a, b) => {
                let symbol = match operator {
                    Comparison::Less => "<",
                    Comparison::LessEqual => "≤",
                    Comparison::Greater => ">",
                    Comparison::GreaterEqual => "≥",
                };
                (format!("{} {symbol} {}", self.at(a, Level::Sum), self.at(b, Level::Sum)), Level::Compare)
            }
            ExprKind::Logic(Logic::And, a, b) => {
                (format!("{} and {}", self.at(a, Level::And), self.at(b, Level::And)), Level::And)
            }
            ExprKind::Logic(Logic::Or, a, b) => {
                (format!("{} or {}", self.at(a, Level::Or), self.at(b, Level::Or)), Level::Or)
            }
            ExprKind::Call(call) => self.call(expr, call),
        }
    }

    fn arithmetic(self, operator: Arithmetic, a: &Expr, b: &Expr) -> Piece {
        match operator {
            Arithmetic::Add => (format!("{} + {}", self.at(a, Level::Sum), self.behind(b, Level::Sum)), Level::Sum),
            Arithmetic::Sub => {
                (format!("{} - {}", self.at(a, Level::Sum), self.behind(b, Level::Differential)), Level::Sum)
            }
            Arithmetic::Mul => {
                let sign = if self.is_unit(b) { ' ' } else { '·' };
                let (left, right) = (self.at(a, Level::Product), self.behind(b, Level::Product));
                (format!("{left}{sign}{right}"), Level::Product)
            }
            Arithmetic::Div => {
                (format!("{}/{}", self.at(a, Level::Product), self.behind(b, Level::Power)), Level::Product)
            }
            Arithmetic::Pow => {
                let base = self.at(a, Level::Atom);
                let exponent = match &b.kind {
                    ExprKind::Number(value, None) => raised(*value),
                    _ => None,
                };
                (base + &exponent.unwrap_or_else(|| format!("^{}", self.behind(b, Level::Atom))), Level::Power)
            }
        }
    }

    fn is_unit(self, expr: &Expr) -> bool {
        match &expr.kind {
            ExprKind::Number(value, unit @ Some(_)) => literal(*value, *unit, expr.span, self.sources).number.is_none(),
            _ => false,
        }
    }

    fn call(self, expr: &Expr, call: &Call) -> Piece {
        let atom = |text: String| (text, Level::Atom);
        match (call.name.as_str(), call.arguments.as_slice()) {
            ("if", [..]) => {
                let Some((rows, otherwise)) = branches(expr) else { return atom(self.applied(call)) };
                let rows = rows.iter().map(|(condition, value)| {
                    format!("{} if {}, ", self.at(value, Level::Or), self.at(condition, Level::Or))
                });
                (rows.collect::<String>() + "else " + &self.at(otherwise, Level::Or), Level::If)
            }
            ("d", [of, by]) => {
                let (of, by, order) = derivative(of, by);
                let by = self.symbols.get(by).text;
                let power = if order == 1 { String::new() } else { raised(order as f64).unwrap_or_default() };
                (format!("∂{power}{}/∂{by}{power}", self.at(of, Level::Atom)), Level::Differential)
            }
            ("dot", [of]) => (format!("d{}/dt", self.at(of, Level::Atom)), Level::Differential),
            ("abs", [of]) => atom(format!("|{}|", self.at(of, Level::Or))),
            ("log", [_]) => atom(format!("ln{}", self.arguments(call))),
            ("sqrt", [_]) => atom(format!("√{}", self.arguments(call))),
            _ => atom(self.applied(call)),
        }
    }

    fn applied(self, call: &Call) -> String {
        self.symbols.get(&call.name).text + &self.arguments(call)
    }

    fn arguments(self, call: &Call) -> String {
        if let [argument] = call.arguments.as_slice() {
            return format!("({})", self.formula(argument));
        }
        let all: Vec<String> = call.arguments.iter().map(|argument| self.at(argument, Level::Or)).collect();
        format!("({})", all.join(", "))
    }
}

/// A piece that follows an operator: it cannot begin with a minus.
fn following((text, level): Piece, least: Level) -> String {
    if level < least || text.starts_with('-') { format!("({text})") } else { text }
}

/// A whole number as superscript.
fn raised(number: f64) -> Option<String> {
    if !(0.0..1000.0).contains(&number) || number.fract() != 0.0 {
        return None;
    }
    let digit = |c: char| c.to_digit(10).and_then(|d| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(d as usize));
    format!("{number}").chars().map(digit).collect()
}
