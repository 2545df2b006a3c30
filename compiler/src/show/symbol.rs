//! Names as symbols: `q_theta` is a q with a theta below it, `tau_stall` a tau with a word.
//!
//! A name whose first piece is one letter or the name of a Greek one is a letter with subscripts; any other name is a
//! word, set upright. Two names never give one symbol: the second one is set as a word.

use std::collections::{HashMap, HashSet};

/// Greek letters: name, LaTeX command, character.
#[rustfmt::skip]
const GREEK: &[(&str, &str, &str)] = &[
    ("alpha", "\\alpha", "α"), ("beta", "\\beta", "β"), ("gamma", "\\gamma", "γ"), ("delta", "\\delta", "δ"),
    ("epsilon", "\\varepsilon", "ε"), ("zeta", "\\zeta", "ζ"), ("eta", "\\eta", "η"), ("theta", "\\theta", "θ"),
    ("iota", "\\iota", "ι"), ("kappa", "\\kappa", "κ"), ("lambda", "\\lambda", "λ"), ("mu", "\\mu", "μ"),
    ("nu", "\\nu", "ν"), ("xi", "\\xi", "ξ"), ("pi", "\\pi", "π"), ("rho", "\\rho", "ρ"), ("sigma", "\\sigma", "σ"),
    ("tau", "\\tau", "τ"), ("upsilon", "\\upsilon", "υ"), ("phi", "\\varphi", "φ"), ("chi", "\\chi", "χ"),
    ("psi", "\\psi", "ψ"), ("omega", "\\omega", "ω"), ("Gamma", "\\Gamma", "Γ"), ("Delta", "\\Delta", "Δ"),
    ("Theta", "\\Theta", "Θ"), ("Lambda", "\\Lambda", "Λ"), ("Xi", "\\Xi", "Ξ"), ("Pi", "\\Pi", "Π"),
    ("Sigma", "\\Sigma", "Σ"), ("Upsilon", "\\Upsilon", "Υ"), ("Phi", "\\Phi", "Φ"), ("Psi", "\\Psi", "Ψ"),
    ("Omega", "\\Omega", "Ω"),
];

/// How a name is set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Symbol {
    /// LaTeX of the letter or the word.
    base: String,
    /// LaTeX of what stands below it; may be empty.
    below: String,
    /// Whether the base is one letter, on which an accent can stand.
    letter: bool,
    /// For a terminal.
    pub(super) text: String,
}

impl Symbol {
    /// LaTeX.
    pub(super) fn latex(&self) -> String {
        format!("{}{}", self.base, self.below)
    }

    /// LaTeX of the time derivative, where a dot can stand on the symbol.
    pub(super) fn dotted(&self) -> Option<String> {
        self.letter.then(|| format!("\\dot{{{}}}{}", self.base, self.below))
    }

    /// A word, set upright as it is written.
    fn word(name: &str) -> Self {
        let base = format!("\\mathrm{{{}}}", name.replace('_', "\\_"));
        Self { base, below: String::new(), letter: false, text: name.to_owned() }
    }

    /// A name by itself.
    fn of(name: &str) -> Self {
        let mut pieces = name.split('_');
        let first = pieces.next().unwrap_or("");
        let digits = first.trim_start_matches(|c: char| !c.is_ascii_digit());
        let head = first.strip_suffix(digits).unwrap_or(first);
        let Some((base, character)) = letter(head).filter(|_| digits.bytes().all(|b| b.is_ascii_digit())) else {
            return Self::word(name);
        };
        let pieces: Vec<&str> = Some(digits).filter(|digits| !digits.is_empty()).into_iter().chain(pieces).collect();
        if pieces.iter().any(|piece| piece.is_empty()) {
            return Self::word(name);
        }
        let below: Vec<String> = pieces.iter().map(|piece| subscript(piece)).collect();
        let mut text = character + digits;
        for piece in name.split('_').skip(1) {
            text = text + "_" + &letter(piece).map_or(piece.to_owned(), |(_, character)| character);
        }
        let below = if below.is_empty() { String::new() } else { format!("_{{{}}}", below.join(",")) };
        Self { base, below, letter: true, text }
    }
}

/// LaTeX and character of a piece that is one letter.
fn letter(piece: &str) -> Option<(String, String)> {
    if piece.len() == 1 && piece.bytes().all(|b| b.is_ascii_alphabetic()) {
        return Some((piece.to_owned(), piece.to_owned()));
    }
    let greek = GREEK.iter().find(|(name, ..)| *name == piece)?;
    Some((greek.1.to_owned(), greek.2.to_owned()))
}

fn subscript(piece: &str) -> String {
    let number = piece.bytes().all(|b| b.is_ascii_digit());
    letter(piece)
        .map_or_else(|| if number { piece.to_owned() } else { format!("\\mathrm{{{piece}}}") }, |(latex, _)| latex)
}

/// The symbols of all names of a spec.
#[derive(Clone, Debug, Default)]
pub(super) struct Symbols {
    known: HashMap<String, Symbol>,
}

impl Symbols {
    /// Symbols for these names, each another one.
    pub(super) fn new<'n>(names: impl IntoIterator<Item = &'n str>) -> Self {
        let (mut known, mut latex, mut text) = (HashMap::new(), HashSet::new(), HashSet::new());
        // Words of the language that are set as letters; a spec cannot define them.
        for word in ["pi", "tau", "t"] {
            latex.insert(Symbol::of(word).latex());
            text.insert(Symbol::of(word).text);
        }
        for name in names {
            let mut symbol = Symbol::of(name);
            if latex.contains(&symbol.latex()) || text.contains(&symbol.text) {
                symbol = Symbol::word(name);
            }
            latex.insert(symbol.latex());
            text.insert(symbol.text.clone());
            known.insert(name.to_owned(), symbol);
        }
        Self { known }
    }

    /// The symbol of a name; an argument of a function is one by itself.
    pub(super) fn get(&self, name: &str) -> Symbol {
        match name {
            "duration" | "spectral_radius" => Symbol::word(name),
            _ => self.known.get(name).cloned().unwrap_or_else(|| Symbol::of(name)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_letters_with_subscripts_or_words() {
        let rows = [
            ("g", "g", "g"),
            ("q_theta", "q_{\\theta}", "q_θ"),
            ("omega_nl", "\\omega_{\\mathrm{nl}}", "ω_nl"),
            ("tau_stall", "\\tau_{\\mathrm{stall}}", "τ_stall"),
            ("L0", "L_{0}", "L0"),
            ("r_1", "r_{1}", "r_1"),
            ("l_s_max", "l_{s,\\mathrm{max}}", "l_s_max"),
            ("idle_rate", "\\mathrm{idle\\_rate}", "idle_rate"),
            ("a__b", "\\mathrm{a\\_\\_b}", "a__b"),
            ("_x", "\\mathrm{\\_x}", "_x"),
            ("x2y", "\\mathrm{x2y}", "x2y"),
        ];
        for (name, latex, text) in rows {
            let symbol = Symbol::of(name);
            assert_eq!((symbol.latex().as_str(), symbol.text.as_str()), (latex, text), "{name}");
        }
        assert_eq!(Symbol::of("q_theta").dotted().as_deref(), Some("\\dot{q}_{\\theta}"));
        assert_eq!(Symbol::of("speed").dotted(), None);
    }

    #[test]
    fn no_two_names_share_a_symbol() {
        let symbols = Symbols::new(["l_0", "l0", "t", "phi"]);
        assert_eq!(symbols.get("l_0").latex(), "l_{0}");
        assert_eq!(symbols.get("l0").latex(), "\\mathrm{l0}");
        assert_eq!(symbols.get("phi").latex(), "\\varphi");
    }
}
