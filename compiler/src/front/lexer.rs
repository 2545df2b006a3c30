//! Characters of an expression to tokens. Never fails: what is no token becomes [`TokenKind::Bad`], reported by the
//! parser if it gets there (the unit behind a quantity is not made of these tokens).

use std::ops::Range;

/// A token and its bytes in the decoded text.
#[derive(Clone, Debug)]
pub(crate) struct Token {
    pub(crate) kind: TokenKind,
    pub(crate) range: Range<usize>,
}

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum TokenKind {
    /// A finite number.
    Number(f64),
    /// Digits that are no finite number.
    BadNumber,
    /// A name or a word of the language.
    Name,
    /// A unit in brackets; the range includes them.
    Unit,
    /// A `[` that is not closed.
    OpenUnit,
    Plus,
    Minus,
    Star,
    Slash,
    Caret,
    Open,
    Close,
    Comma,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    /// Something else, with what to write instead where that is known.
    Bad(Option<&'static str>),
    /// The end of the text.
    End,
}

/// Spellings of other languages and what to write instead, longest first.
const FOREIGN: &[(&str, &str)] = &[
    ("**", "write a power as `x^2`"),
    ("==", "two reals are hardly ever equal: write `<=` or `>=`"),
    ("!=", "two reals are hardly ever equal: write `<` or `>`"),
    ("&&", "write `and`"),
    ("||", "write `or`"),
    ("≤", "write `<=`"),
    ("≥", "write `>=`"),
    ("−", "write the minus of the keyboard, `-`"),
    ("·", "write `*`"),
    ("×", "write `*`"),
    ("÷", "write `/`"),
    ("π", "write `pi`"),
    ("&", "write `and`"),
    ("|", "write `or`, or `abs(x)` for a magnitude"),
    ("!", "write `not`"),
    ("=", "write `<=` or `>=` to compare"),
    ("%", "write a percentage as `5 [%]`"),
    ("°", "write an angle as `20 [deg]`"),
    ("{", "write `(` and `)`"),
    ("}", "write `(` and `)`"),
    ("'", "write a derivative as `d(expr, x)`"),
    (";", "write one expression only; use [let] for more"),
];

/// All tokens of `text`; the last one is [`TokenKind::End`].
pub(crate) fn tokens(text: &str) -> Vec<Token> {
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(c) = text.get(at..).and_then(|rest| rest.chars().next()) {
        if c.is_whitespace() {
            at += c.len_utf8();
            continue;
        }
        let (kind, length) = token(text.get(at..).unwrap_or(""), c);
        tokens.push(Token { kind, range: at..at + length });
        at += length;
    }
    tokens.push(Token { kind: TokenKind::End, range: text.len()..text.len() });
    tokens
}

/// The token at the start of `rest`, whose first character is `c`, and its length in bytes.
fn token(rest: &str, c: char) -> (TokenKind, usize) {
    let second = rest.as_bytes().get(1).copied();
    match c {
        '0'..='9' => number(rest),
        '.' if second.is_some_and(|b| b.is_ascii_digit()) => number(rest),
        'a'..='z' | 'A'..='Z' | '_' => {
            let length = rest.bytes().take_while(|b| b.is_ascii_alphanumeric() || *b == b'_').count();
            (TokenKind::Name, length)
        }
        '[' => rest.find(']').map_or((TokenKind::OpenUnit, rest.len()), |end| (TokenKind::Unit, end + 1)),
        '<' if second == Some(b'=') => (TokenKind::LessEqual, 2),
        '>' if second == Some(b'=') => (TokenKind::GreaterEqual, 2),
        '<' => (TokenKind::Less, 1),
        '>' => (TokenKind::Greater, 1),
        '*' if second == Some(b'*') => foreign(rest, c),
        '+' => (TokenKind::Plus, 1),
        '-' => (TokenKind::Minus, 1),
        '*' => (TokenKind::Star, 1),
        '/' => (TokenKind::Slash, 1),
        '^' => (TokenKind::Caret, 1),
        '(' => (TokenKind::Open, 1),
        ')' => (TokenKind::Close, 1),
        ',' => (TokenKind::Comma, 1),
        _ => foreign(rest, c),
    }
}

fn foreign(rest: &str, c: char) -> (TokenKind, usize) {
    match FOREIGN.iter().find(|(spelling, _)| rest.starts_with(spelling)) {
        Some((spelling, help)) => (TokenKind::Bad(Some(help)), spelling.len()),
        None => (TokenKind::Bad(None), c.len_utf8()),
    }
}

/// Digits, an optional fraction and an optional exponent.
fn number(rest: &str) -> (TokenKind, usize) {
    let bytes = rest.as_bytes();
    let digits = |from: usize| bytes.iter().skip(from).take_while(|b| b.is_ascii_digit()).count();
    let mut length = digits(0);
    if bytes.get(length) == Some(&b'.') {
        length += 1 + digits(length + 1);
    }
    if matches!(bytes.get(length), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
        let exponent = digits(length + 1 + sign);
        if exponent > 0 {
            length += 1 + sign + exponent;
        }
    }
    match rest.get(..length).and_then(|text| text.parse::<f64>().ok()).filter(|value| value.is_finite()) {
        Some(value) => (TokenKind::Number(value), length),
        None => (TokenKind::BadNumber, length),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kinds(text: &str) -> Vec<TokenKind> {
        tokens(text).into_iter().map(|token| token.kind).collect()
    }

    #[test]
    fn numbers_names_and_operators() {
        use TokenKind::{End, GreaterEqual, Minus, Name, Number, Star, Unit};
        assert_eq!(kinds("1.5e-3*q_r-.5"), [Number(1.5e-3), Star, Name, Minus, Number(0.5), End]);
        assert_eq!(kinds("x >= 3 [m/s]"), [Name, GreaterEqual, Number(3.0), Unit, End]);
        assert_eq!(kinds("2em"), [Number(2.0), Name, End]); // no exponent without digits
        assert_eq!(kinds("1."), [Number(1.0), End]);
    }

    #[test]
    fn what_is_no_token_is_bad_and_has_advice_where_known() {
        assert_eq!(kinds("1e999"), [TokenKind::BadNumber, TokenKind::End]);
        assert_eq!(kinds("3 [m"), [TokenKind::Number(3.0), TokenKind::OpenUnit, TokenKind::End]);
        assert!(matches!(kinds("x**2").as_slice(), [_, TokenKind::Bad(Some(_)), ..]));
        assert!(matches!(kinds("x @ 2").as_slice(), [_, TokenKind::Bad(None), ..]));
    }
}
