//! Formulas in LaTeX (amsmath): fractions, subscripts, partial derivatives, cases. No `|` and no `<` without a space
//! behind it, so that a formula may stand in a cell of a Markdown table.

use super::level::{Level, Piece, branches, derivative, negated, terms};
use super::literal::{literal, number_latex, unit_latex, with_unit};
use super::symbol::Symbols;
use crate::front::syntax::{Arithmetic, Call, Comparison, Expr, ExprKind, Logic};
use crate::source::SourceMap;

/// Prints expressions of one spec.
#[derive(Clone, Copy)]
pub(super) struct Latex<'a> {
    pub(super) symbols: &'a Symbols,
    pub(super) sources: &'a SourceMap,
    /// Whether fractions are written with a slash, as in exponents.
    pub(super) inline: bool,
}

impl Latex<'_> {
    /// A whole formula.
    pub(super) fn formula(self, expr: &Expr) -> String {
        self.piece(expr).0
    }

    /// The terms of a sum, each with its sign but the first, which has one only if it is a minus.
    pub(super) fn terms(self, expr: &Expr) -> Vec<String> {
        let term = |(i, (minus, term)): (usize, (bool, &Expr))| match (i, minus) {
            (0, _) => self.at(term, Level::Sum),
            (_, true) => format!("- {}", self.behind(term, Level::Differential)),
            (_, false) => format!("+ {}", self.behind(term, Level::Sum)),
        };
        let all = terms(expr);
        if let [(_, one)] = all.as_slice() {
            return vec![self.formula(one)];
        }
        all.into_iter().enumerate().map(term).collect()
    }

    /// A formula in a place that asks for a level.
    pub(super) fn at(self, expr: &Expr, least: Level) -> String {
        let (latex, level) = self.piece(expr);
        if level < least { parentheses(&latex) } else { latex }
    }

    /// One that follows an operator.
    fn behind(self, expr: &Expr, least: Level) -> String {
        following(self.piece(expr), least)
    }

    fn piece(self, expr: &Expr) -> Piece {
        match &expr.kind {
            ExprKind::Number(value, unit) => {
                let literal = literal(*value, *unit, expr.span, self.sources);
                let number = literal.number.map(|number| number_latex(&number));
                let unit = literal.unit.map(|unit| unit_latex(&unit)).filter(|unit| !unit.is_empty());
                match (number, unit) {
                    // Behind a unit with a slash a further factor would seem to stand below it.
                    (Some(number), Some(unit)) if unit.contains('/') => {
                        (with_unit(&number, &unit), Level::Differential)
                    }
                    (Some(number), Some(unit)) => (with_unit(&number, &unit), Level::Product),
                    (Some(number), None) if number.contains("\\cdot") => (number, Level::Product),
                    (number, unit) => (number.or(unit).unwrap_or_default(), Level::Atom),
                }
            }
            ExprKind::Name(name) => (self.symbols.get(name).latex(), Level::Atom),
            ExprKind::Neg(a) => {
                // Once: twice at each of many signs would never end.
                let piece = self.piece(a);
                let level = negated(piece.1);
                (format!("-{}", following(piece, Level::Differential)), level)
            }
            ExprKind::Not(a) => (format!("\\lnot {}", self.at(a, Level::Atom)), Level::Not),
            ExprKind::Arithmetic(operator, a, b) => self.arithmetic(*operator, a, b),
            ExprKind::Compare(operator, a, b) => {
                let symbol = match operator {
                    Comparison::Less => "<",
                    Comparison::LessEqual => "\\le",
                    Comparison::Greater => ">",
                    Comparison::GreaterEqual => "\\ge",
                };
                (format!("{} {symbol} {}", self.at(a, Level::Sum), self.at(b, Level::Sum)), Level::Compare)
            }
            ExprKind::Logic(Logic::And, a, b) => {
                (format!("{} \\land {}", self.at(a, Level::And), self.at(b, Level::And)), Level::And)
            }
            ExprKind::Logic(Logic::Or, a, b) => {
                (format!("{} \\lor {}", self.at(a, Level::Or), self.at(b, Level::Or)), Level::Or)
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
                let (left, right) = (self.at(a, Level::Product), self.behind(b, Level::Product));
                (format!("{left}{}{right}", times(a, &right)), Level::Product)
            }
            Arithmetic::Div if self.inline => {
                (format!("{}/{}", self.at(a, Level::Product), self.behind(b, Level::Power)), Level::Product)
            }
            Arithmetic::Div => {
                let (sign, a) = match &a.kind {
                    ExprKind::Neg(a) => ("-", a.as_ref()),
                    _ => ("", a),
                };
                (format!("{sign}\\frac{{{}}}{{{}}}", self.formula(a), self.formula(b)), Level::Product)
            }
            Arithmetic::Pow => {
                let exponent = Self { inline: true, ..self }.formula(b);
                let whole = exponent.bytes().all(|b| b.is_ascii_digit());
                let base = match &a.kind {
                    // sin(x)^2 is written sin^2(x); an exponent -1 would mean the inverse.
                    ExprKind::Call(call) if whole && is_trigonometric(&call.name) => {
                        let name = self.function_name(&call.name);
                        return (format!("{name}^{{{exponent}}}{}", self.arguments(call)), Level::Power);
                    }
                    ExprKind::Call(call) if call.name == "sqrt" => parentheses(&self.formula(a)),
                    _ => self.at(a, Level::Atom),
                };
                (format!("{base}^{{{exponent}}}"), Level::Power)
            }
        }
    }

    fn call(self, expr: &Expr, call: &Call) -> Piece {
        let atom = |latex: String| (latex, Level::Atom);
        let quotient = |latex: String| (latex, Level::Differential);
        match (call.name.as_str(), call.arguments.as_slice()) {
            ("if", [..]) => (self.cases(expr).unwrap_or_default(), Level::If),
            ("d", [of, by]) => {
                let (of, by, order) = derivative(of, by);
                let by = self.symbols.get(by).latex();
                let power = if order == 1 { String::new() } else { format!("^{{{order}}}") };
                let below = if order == 1 { by } else { format!("{{{by}}}{power}") };
                quotient(match &of.kind {
                    ExprKind::Name(name) => {
                        format!("\\frac{{\\partial{power} {}}}{{\\partial {below}}}", self.symbols.get(name).latex())
                    }
                    _ => {
                        let of = parentheses(&self.formula(of));
                        format!("\\frac{{\\partial{power}}}{{\\partial {below}}} {of}")
                    }
                })
            }
            ("dot", [of]) => match &of.kind {
                ExprKind::Name(name) => match self.symbols.get(name).dotted() {
                    Some(dotted) => atom(dotted),
                    None => quotient(rate(&self.symbols.get(name).latex())),
                },
                _ => quotient(rate(&parentheses(&self.formula(of)))),
            },
            ("abs", [of]) => atom(format!("\\left\\lvert {} \\right\\rvert", self.formula(of))),
            ("sqrt", [of]) => atom(format!("\\sqrt{{{}}}", self.formula(of))),
            ("integral", [of]) => quotient(format!("\\int {}\\,\\mathrm{{d}}t", self.at(of, Level::Product))),
            (name, _) => atom(self.function_name(name) + &self.arguments(call)),
        }
    }

    fn cases(self, expr: &Expr) -> Option<String> {
        let (rows, otherwise) = branches(expr)?;
        let row = |(condition, value): &(&Expr, &Expr)| {
            format!("{} & \\text{{if }} {} \\\\ ", self.formula(value), self.formula(condition))
        };
        let rows: String = rows.iter().map(row).collect();
        Some(format!("\\begin{{cases}} {rows}{} & \\text{{otherwise}} \\end{{cases}}", self.formula(otherwise)))
    }

    fn function_name(self, name: &str) -> String {
        match name {
            "sin" | "cos" | "tan" | "sinh" | "cosh" | "tanh" | "exp" | "min" | "max" => format!("\\{name}"),
            "log" => "\\ln".to_owned(),
            "asin" | "acos" | "atan" => format!("\\arc{}", name.strip_prefix('a').unwrap_or(name)),
            "asinh" | "acosh" | "atanh" => format!("\\operatorname{{ar{}}}", name.strip_prefix('a').unwrap_or(name)),
            "atan2" | "sign" | "mean" | "start" | "end" => format!("\\operatorname{{{name}}}"),
            "cycle_max" => "\\max_{\\text{cycle}}".to_owned(),
            "cycle_min" => "\\min_{\\text{cycle}}".to_owned(),
            _ => self.symbols.get(name).latex(),
        }
    }

    fn arguments(self, call: &Call) -> String {
        let all: Vec<String> = call.arguments.iter().map(|argument| self.formula(argument)).collect();
        parentheses(&all.join(", "))
    }
}

/// A piece that follows an operator: it cannot begin with a minus.
fn following((text, level): Piece, least: Level) -> String {
    if level < least || text.starts_with('-') { parentheses(&text) } else { text }
}

/// What stands between two factors: space, or a point where space would be misread as a call or as one number.
fn times(left: &Expr, right: &str) -> &'static str {
    let mut last = left;
    while let ExprKind::Arithmetic(Arithmetic::Mul, _, b) = &last.kind {
        last = b;
    }
    let number = matches!(&last.kind, ExprKind::Number(_, None));
    let opens = right.starts_with("(") || right.starts_with("\\left(");
    if right.starts_with(|c: char| c.is_ascii_digit()) || (opens && !number) { " \\cdot " } else { "\\," }
}

fn is_trigonometric(name: &str) -> bool {
    matches!(name, "sin" | "cos" | "tan" | "sinh" | "cosh" | "tanh")
}

/// The time derivative of what cannot carry a dot.
pub(super) fn rate(latex: &str) -> String {
    format!("\\frac{{\\mathrm{{d}}}}{{\\mathrm{{d}}t}} {latex}")
}

/// Parentheses as high as what they enclose.
pub(super) fn parentheses(latex: &str) -> String {
    let high = ["\\frac", "\\begin", "\\left", "\\int", "\\sqrt"].iter().any(|command| latex.contains(command));
    if high { format!("\\left( {latex} \\right)") } else { format!("({latex})") }
}
