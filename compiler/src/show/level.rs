//! How tightly a piece of a formula holds together: what is looser than its place asks for goes into parentheses.

use crate::front::syntax::{Arithmetic, Expr, ExprKind};

/// From loosest to tightest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Level {
    /// Cases.
    If,
    Or,
    And,
    Not,
    Compare,
    Sum,
    /// A differential quotient or an integral, which stands in sums as it is, in products in parentheses.
    Differential,
    Product,
    Power,
    Atom,
}

/// A piece and how tightly it holds together.
pub(super) type Piece = (String, Level);

/// The level of something behind a minus: what is looser than a product stands in parentheses already.
pub(super) fn negated(level: Level) -> Level {
    if level == Level::Differential { level } else { Level::Product }
}

/// The terms of a sum in their order, each with whether it is subtracted.
pub(super) fn terms(expr: &Expr) -> Vec<(bool, &Expr)> {
    let mut right = Vec::new();
    let mut rest = expr;
    while let ExprKind::Arithmetic(sign @ (Arithmetic::Add | Arithmetic::Sub), a, b) = &rest.kind {
        right.push((*sign == Arithmetic::Sub, b.as_ref()));
        rest = a;
    }
    right.push((false, rest));
    right.reverse();
    right
}

/// The branches of nested `if`s, each with its condition, and what holds otherwise.
pub(super) fn branches(expr: &Expr) -> Option<(Vec<(&Expr, &Expr)>, &Expr)> {
    let mut rows = Vec::new();
    let mut rest = expr;
    while let ExprKind::Call(call) = &rest.kind
        && let ("if", [condition, value, otherwise]) = (call.name.as_str(), call.arguments.as_slice())
    {
        rows.push((condition, value));
        rest = otherwise;
    }
    (!rows.is_empty()).then_some((rows, rest))
}

/// What `d(d(e, x), x)` differentiates, by what, and how many times.
pub(super) fn derivative<'e>(expr: &'e Expr, variable: &'e Expr) -> (&'e Expr, &'e str, usize) {
    let name = |expr: &'e Expr| if let ExprKind::Name(name) = &expr.kind { name.as_str() } else { "" };
    let (by, mut of, mut order) = (name(variable), expr, 1);
    while let ExprKind::Call(call) = &of.kind
        && let ("d", [inner, again]) = (call.name.as_str(), call.arguments.as_slice())
        && name(again) == by
    {
        of = inner;
        order += 1;
    }
    (of, by, order)
}
