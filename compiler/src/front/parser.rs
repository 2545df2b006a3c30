//! Expressions: tokens to a syntax tree, by precedence climbing. From loosest to tightest: `or`, `and`, `not`,
//! comparison, `+ -`, `* /`, minus, `^` (from the right, so that `-x^2` is `-(x^2)` and `2^-1` is allowed).
//!
//! Length and nesting are bounded, so that no text can exhaust the stack here or in what walks the tree later.

use super::lexer::{Token, TokenKind, tokens};
use super::names::FUNCTIONALS;
use super::syntax::{Arithmetic, Call, Comparison, Expr, ExprKind, Expression, Logic, NameUse};
use super::text::Text;
use super::units::{Unit, UnitError, parse_unit};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use std::ops::Range;

/// Longest expression in bytes. It also bounds how long a chain such as `a + b + c + ...` can be.
const LENGTH_LIMIT: usize = 10_000;
/// Deepest nesting of parentheses, calls, signs and exponents.
pub(crate) const DEPTH_LIMIT: usize = 128;

/// Reads a whole expression or condition.
pub(crate) fn parse_expression(text: &Text) -> Result<Expression, Box<Diagnostic>> {
    let mut parser = Parser::new(text)?;
    let root = parser.expression(0)?;
    parser.end()?;
    Ok(Expression { root, names: parser.names, unit: None })
}

/// Reads a constant expression as far as it goes; the rest of the text, from the returned offset, is a unit.
pub(crate) fn parse_value(text: &Text) -> Result<(Expression, usize), Box<Diagnostic>> {
    let mut parser = Parser::new(text)?;
    let root = parser.expression(0)?;
    let rest = parser.peek();
    if let Some(error) = parser.decimal_comma(&rest) {
        return Err(error);
    }
    let rest = rest.range.start;
    Ok((Expression { root, names: parser.names, unit: None }, rest))
}

/// Reads an expression that may be a quantity where it is constant, as in `1250 rad/s`.
pub(crate) fn parse_expression_or_quantity(text: &Text) -> Result<Expression, Box<Diagnostic>> {
    let mut parser = Parser::new(text)?;
    let mut root = parser.expression(0)?;
    let unit = parser.unit_behind(&mut root)?;
    parser.end()?;
    Ok(Expression { root, names: parser.names, unit })
}

/// Reads a constraint: an expression whose right side, where it is constant, may be a quantity, as in
/// `peak_force <= 150 N`.
pub(crate) fn parse_constraint(text: &Text) -> Result<Expression, Box<Diagnostic>> {
    let mut parser = Parser::new(text)?;
    let mut root = parser.expression(0)?;
    let mut unit = None;
    if let ExprKind::Compare(_, _, right) = &mut root.kind {
        unit = parser.unit_behind(right)?;
        root.span = root.span.to(right.span);
    }
    parser.end()?;
    Ok(Expression { root, names: parser.names, unit })
}

/// A unit's complaint as a diagnostic; `offset` is where the unit starts in `text`.
pub(crate) fn unit_diagnostic(error: UnitError, text: &Text, offset: usize) -> Box<Diagnostic> {
    let span = text.at(error.range.start + offset..error.range.end + offset);
    let diagnostic = Diagnostic::error(Code::Unit, error.message).at(span, "");
    Box::new(match error.help {
        Some(help) => diagnostic.help(help),
        None => diagnostic,
    })
}

/// An operator between two operands.
#[derive(Clone, Copy)]
enum Infix {
    Arithmetic(Arithmetic),
    Compare(Comparison),
    Logic(Logic),
}

const OR: u8 = 1;
const AND: u8 = 2;
const NOT: u8 = 3;
const COMPARE: u8 = 4;
const SUM: u8 = 5;
const PRODUCT: u8 = 6;
const SIGN: u8 = 7;
const POWER: u8 = 8;

struct Parser<'a> {
    text: &'a Text,
    tokens: Vec<Token>,
    at: usize,
    depth: usize,
    functionals: usize,
    names: Vec<NameUse>,
}

impl<'a> Parser<'a> {
    fn new(text: &'a Text) -> Result<Self, Box<Diagnostic>> {
        if text.value.len() > LENGTH_LIMIT {
            let message = format!("this expression is longer than {LENGTH_LIMIT} bytes");
            let diagnostic = Diagnostic::error(Code::TooComplex, message).at(text.span, "");
            return Err(Box::new(diagnostic.help("split it into several names of [let]")));
        }
        let tokens = tokens(&text.value);
        Ok(Self { text, tokens, at: 0, depth: 0, functionals: 0, names: Vec::new() })
    }

    /// Reads the unit to the end of the text that stands behind `number`, if that is constant and there is one.
    fn unit_behind(&mut self, number: &mut Expr) -> Result<Option<Box<str>>, Box<Diagnostic>> {
        let token = self.peek();
        let is_one = self.slice(token.range.clone()) == "1"; // as in `2 1/m`
        let starts_unit = is_one || matches!(token.kind, TokenKind::Name | TokenKind::Bad(_));
        let constant = |name: &NameUse| name.span.start < number.span.start || name.name == "pi";
        if !starts_unit || !self.names.iter().all(constant) {
            return Ok(None);
        }
        let offset = token.range.start;
        let written = self.slice(offset..self.text.value.len()).trim_end();
        let unit_span = self.text.at(offset..offset + written.len());
        let unit = parse_unit(written).map_err(|error| unit_diagnostic(error, self.text, offset))?;
        let span = number.span.to(unit_span);
        match &mut number.kind {
            ExprKind::Number(_, given @ None) => *given = Some(unit),
            _ => {
                let inner = std::mem::replace(&mut number.kind, ExprKind::Number(0.0, None));
                let inner = Box::new(Expr { kind: inner, span: number.span });
                let one = Box::new(Expr { kind: ExprKind::Number(1.0, Some(unit)), span: unit_span });
                number.kind = ExprKind::Arithmetic(Arithmetic::Mul, inner, one);
            }
        }
        number.span = span;
        self.at = self.tokens.len();
        Ok(Some(written.into()))
    }

    fn peek(&self) -> Token {
        let end = self.text.value.len();
        self.tokens.get(self.at).cloned().unwrap_or(Token { kind: TokenKind::End, range: end..end })
    }

    fn slice(&self, range: Range<usize>) -> &'a str {
        self.text.value.get(range).unwrap_or("")
    }

    fn next(&mut self) -> Token {
        let token = self.peek();
        self.at += 1;
        token
    }

    fn error(&self, code: Code, message: impl Into<String>, range: Range<usize>) -> Diagnostic {
        Diagnostic::error(code, message).at(self.text.at(range), "")
    }

    /// Everything at least as tight as `least`.
    fn expression(&mut self, least: u8) -> Result<Expr, Box<Diagnostic>> {
        if self.depth >= DEPTH_LIMIT {
            let message = format!("this expression is nested more than {DEPTH_LIMIT} levels deep");
            let error = self.error(Code::TooComplex, message, self.peek().range);
            return Err(Box::new(error.help("split it into several names of [let]")));
        }
        self.depth += 1;
        let mut left = self.prefix()?;
        while let Some((operator, strength)) = self.infix().filter(|(_, strength)| *strength >= least) {
            let token = self.next();
            let right = self.expression(if strength == POWER { SIGN } else { strength + 1 })?;
            if let (Infix::Compare(_), Some((Infix::Compare(_), _))) = (operator, self.infix()) {
                let error = self.error(Code::Syntax, "a comparison has two sides only", self.peek().range);
                return Err(Box::new(
                    error.see(self.text.at(token.range), "first comparison").help("write `a <= x and x <= b`"),
                ));
            }
            left = join(operator, left, right);
        }
        self.depth -= 1;
        Ok(left)
    }

    fn infix(&self) -> Option<(Infix, u8)> {
        let token = self.peek();
        Some(match token.kind {
            TokenKind::Plus => (Infix::Arithmetic(Arithmetic::Add), SUM),
            TokenKind::Minus => (Infix::Arithmetic(Arithmetic::Sub), SUM),
            TokenKind::Star => (Infix::Arithmetic(Arithmetic::Mul), PRODUCT),
            TokenKind::Slash => (Infix::Arithmetic(Arithmetic::Div), PRODUCT),
            TokenKind::Caret => (Infix::Arithmetic(Arithmetic::Pow), POWER),
            TokenKind::Less => (Infix::Compare(Comparison::Less), COMPARE),
            TokenKind::LessEqual => (Infix::Compare(Comparison::LessEqual), COMPARE),
            TokenKind::Greater => (Infix::Compare(Comparison::Greater), COMPARE),
            TokenKind::GreaterEqual => (Infix::Compare(Comparison::GreaterEqual), COMPARE),
            TokenKind::Name => match self.slice(token.range) {
                "and" => (Infix::Logic(Logic::And), AND),
                "or" => (Infix::Logic(Logic::Or), OR),
                _ => return None,
            },
            _ => return None,
        })
    }

    fn prefix(&mut self) -> Result<Expr, Box<Diagnostic>> {
        let token = self.next();
        let span = self.text.at(token.range.clone());
        match token.kind {
            TokenKind::Number(value) => self.literal(value, span),
            TokenKind::Minus => {
                let operand = self.expression(SIGN)?;
                Ok(Expr { span: span.to(operand.span), kind: ExprKind::Neg(Box::new(operand)) })
            }
            TokenKind::Plus => self.expression(SIGN),
            TokenKind::Open => {
                let inner = self.expression(0)?;
                let close = self.close(&token, "this `(` is not closed")?;
                Ok(Expr { kind: inner.kind, span: span.to(close) })
            }
            TokenKind::Name => self.name(&token, span),
            _ => Err(self.unexpected(&token)),
        }
    }

    /// A number and the unit in brackets behind it, if there is one.
    fn literal(&mut self, value: f64, span: Span) -> Result<Expr, Box<Diagnostic>> {
        let token = self.peek();
        if token.kind != TokenKind::Unit {
            return Ok(Expr { kind: ExprKind::Number(value, None), span });
        }
        self.at += 1;
        let unit = self.unit(&token.range)?;
        Ok(Expr { kind: ExprKind::Number(value, Some(unit)), span: span.to(self.text.at(token.range)) })
    }

    fn unit(&self, brackets: &Range<usize>) -> Result<Unit, Box<Diagnostic>> {
        let inner = brackets.start + 1..brackets.end - 1;
        parse_unit(self.slice(inner.clone())).map_err(|error| unit_diagnostic(error, self.text, inner.start))
    }

    fn name(&mut self, token: &Token, span: Span) -> Result<Expr, Box<Diagnostic>> {
        let name = self.slice(token.range.clone()).to_owned();
        match name.as_str() {
            "not" => {
                let operand = self.expression(NOT)?;
                return Ok(Expr { span: span.to(operand.span), kind: ExprKind::Not(Box::new(operand)) });
            }
            "and" | "or" => return Err(self.unexpected(token)),
            _ => {}
        }
        let called = self.peek().kind == TokenKind::Open;
        self.names.push(NameUse { name: name.clone(), span, called, in_functional: self.functionals > 0 });
        if !called {
            return Ok(Expr { kind: ExprKind::Name(name), span });
        }
        let open = self.next();
        let functional = usize::from(FUNCTIONALS.contains(&name.as_str()));
        self.functionals += functional;
        let mut arguments = Vec::new();
        while arguments.is_empty() || self.peek().kind == TokenKind::Comma {
            if arguments.is_empty() && self.peek().kind == TokenKind::Close {
                break;
            }
            self.at += usize::from(!arguments.is_empty());
            arguments.push(self.expression(0)?);
        }
        self.functionals -= functional;
        let close = self.close(&open, "the `(` of this call is not closed")?;
        Ok(Expr { kind: ExprKind::Call(Call { name, name_span: span, arguments }), span: span.to(close) })
    }

    fn close(&mut self, open: &Token, message: &str) -> Result<Span, Box<Diagnostic>> {
        let token = self.peek();
        if token.kind == TokenKind::Close {
            self.at += 1;
            return Ok(self.text.at(token.range));
        }
        if token.kind == TokenKind::End {
            let error = self.error(Code::Syntax, message, open.range.clone());
            return Err(Box::new(error.help("add the missing `)`")));
        }
        Err(self.unexpected(&token))
    }

    fn end(&self) -> Result<(), Box<Diagnostic>> {
        let token = self.peek();
        if token.kind == TokenKind::End { Ok(()) } else { Err(self.unexpected(&token)) }
    }

    /// What is to be said of a comma between the digits of a number.
    fn decimal_comma(&self, token: &Token) -> Option<Box<Diagnostic>> {
        let bytes = self.text.value.as_bytes();
        let is_digit = |at: Option<usize>| at.and_then(|at| bytes.get(at)).is_some_and(u8::is_ascii_digit);
        let Range { start, end } = token.range;
        if token.kind != TokenKind::Comma || !is_digit(start.checked_sub(1)) || !is_digit(Some(end)) {
            return None;
        }
        let error = self.error(Code::Number, "a comma stands between the digits of a number", start..end);
        Some(Box::new(error.help("the decimal mark is a point, as in `1.5`")))
    }

    /// Why a token cannot stand where it stands.
    fn unexpected(&self, token: &Token) -> Box<Diagnostic> {
        if let Some(error) = self.decimal_comma(token) {
            return error;
        }
        let text = self.slice(token.range.clone());
        let range = token.range.clone();
        Box::new(match token.kind {
            TokenKind::End if text.is_empty() && self.text.value.trim().is_empty() => {
                self.error(Code::Syntax, "an expression is missing here", 0..self.text.value.len())
            }
            TokenKind::End => self.error(Code::Syntax, "the expression ends too early", range),
            TokenKind::BadNumber => {
                let error = self.error(Code::Number, format!("`{}` is not a number", shortened(text)), range);
                error.help("numbers go up to about 1.8e308")
            }
            TokenKind::OpenUnit => {
                let error = self.error(Code::Syntax, "this `[` is not closed", range.start..range.start + 1);
                error.help("write a unit as `3 [m/s]`")
            }
            TokenKind::Unit => {
                let error = self.error(Code::Syntax, "a unit in brackets belongs behind a number", range);
                error.help("write `3 [m/s]`; names carry their own unit")
            }
            TokenKind::Bad(help) => {
                let error = self.error(Code::Syntax, format!("unexpected `{text}`"), range);
                help.map_or(error.clone(), |help| error.help(help))
            }
            TokenKind::Name if parse_unit(text).is_ok() => {
                let error = self.error(
                    Code::Syntax,
                    format!("unexpected name `{text}`, an operator is missing before it"),
                    range,
                );
                error.help(format!("write `*` to multiply; the unit of a literal stands in brackets: `3 [{text}]`"))
            }
            TokenKind::Name | TokenKind::Number(_) | TokenKind::Open => {
                let error =
                    self.error(Code::Syntax, format!("unexpected `{text}`, an operator is missing before it"), range);
                error.help("write `*` to multiply")
            }
            _ => self.error(Code::Syntax, format!("unexpected `{text}`"), range),
        })
    }
}

fn join(operator: Infix, left: Expr, right: Expr) -> Expr {
    let span = left.span.to(right.span);
    let (left, right) = (Box::new(left), Box::new(right));
    let kind = match operator {
        Infix::Arithmetic(operator) => ExprKind::Arithmetic(operator, left, right),
        Infix::Compare(operator) => ExprKind::Compare(operator, left, right),
        Infix::Logic(operator) => ExprKind::Logic(operator, left, right),
    };
    Expr { kind, span }
}

/// The first characters of a long text, control characters replaced: for names in messages.
pub fn shortened(text: &str) -> String {
    const LIMIT: usize = 40;
    // A name may hold what would break a line of a message.
    let shown = |c: char| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c };
    if text.chars().count() <= LIMIT {
        text.chars().map(shown).collect()
    } else {
        text.chars().take(LIMIT - 3).map(shown).chain("...".chars()).collect()
    }
}

#[cfg(test)]
#[path = "parser_tests.rs"]
mod tests;
