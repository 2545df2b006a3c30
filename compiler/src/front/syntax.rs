//! The syntax tree of an expression: what was written, before names mean anything.

use super::units::Unit;
use crate::source::Span;

/// A whole expression.
#[derive(Clone, Debug)]
pub(crate) struct Expression {
    /// The tree.
    pub(crate) root: Expr,
    /// Every name in it, in the order of the text, called functions included.
    pub(crate) names: Vec<NameUse>,
    /// The unit behind a constraint's bound, as it was written.
    pub(crate) unit: Option<Box<str>>,
}

/// An occurrence of a name.
#[derive(Clone, Debug)]
pub(crate) struct NameUse {
    pub(crate) name: String,
    pub(crate) span: Span,
    /// Whether it is called as a function.
    pub(crate) called: bool,
    /// Whether it stands inside the argument of a functional such as `mean`.
    pub(crate) in_functional: bool,
}

/// A node of the tree and its place.
#[derive(Clone, Debug)]
pub(crate) struct Expr {
    pub(crate) kind: ExprKind,
    pub(crate) span: Span,
}

/// What a node is.
#[derive(Clone, Debug)]
pub(crate) enum ExprKind {
    /// A literal, with its unit if it has one.
    Number(f64, Option<Unit>),
    /// A name.
    Name(String),
    /// Minus.
    Neg(Box<Expr>),
    /// `+ - * / ^`.
    Arithmetic(Arithmetic, Box<Expr>, Box<Expr>),
    /// `< <= > >=`.
    Compare(Comparison, Box<Expr>, Box<Expr>),
    /// `and`, `or`.
    Logic(Logic, Box<Expr>, Box<Expr>),
    /// `not`.
    Not(Box<Expr>),
    /// A function and its arguments.
    Call(Call),
}

/// A function call.
#[derive(Clone, Debug)]
pub(crate) struct Call {
    pub(crate) name: String,
    pub(crate) name_span: Span,
    pub(crate) arguments: Vec<Expr>,
}

/// An operator on two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Arithmetic {
    Add,
    Sub,
    Mul,
    Div,
    Pow,
}

/// A comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Comparison {
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
}

/// An operator on two conditions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Logic {
    And,
    Or,
}

impl Arithmetic {
    pub(crate) const fn symbol(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Sub => "-",
            Self::Mul => "*",
            Self::Div => "/",
            Self::Pow => "^",
        }
    }
}

impl Comparison {
    pub(crate) const fn symbol(self) -> &'static str {
        match self {
            Self::Less => "<",
            Self::LessEqual => "<=",
            Self::Greater => ">",
            Self::GreaterEqual => ">=",
        }
    }

    /// Whether the left side has to be the smaller one.
    pub(crate) const fn is_less(self) -> bool {
        matches!(self, Self::Less | Self::LessEqual)
    }
}
