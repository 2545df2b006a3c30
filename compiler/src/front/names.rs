//! Names: which are valid, which belong to the language, and what a misspelt one was meant to be.

/// Functions of the expression language and how many arguments they take.
pub(crate) const FUNCTIONS: &[(&str, usize)] = &[
    ("sin", 1),
    ("cos", 1),
    ("tan", 1),
    ("asin", 1),
    ("acos", 1),
    ("atan", 1),
    ("atan2", 2),
    ("sinh", 1),
    ("cosh", 1),
    ("tanh", 1),
    ("asinh", 1),
    ("acosh", 1),
    ("atanh", 1),
    ("exp", 1),
    ("log", 1),
    ("sqrt", 1),
    ("abs", 1),
    ("sign", 1),
    ("min", 2),
    ("max", 2),
    ("if", 3),
    ("d", 2),
    ("dot", 1),
];

/// Functionals of one map: functions that only measures may call.
pub(crate) const FUNCTIONALS: &[&str] = &["start", "end", "integral", "mean", "cycle_max", "cycle_min"];

/// Words that stand for a value or an operator.
pub(crate) const WORDS: &[(&str, &str)] = &[
    ("pi", "the number pi"),
    ("tau", "the time since the last transition"),
    ("t", "the time since the start of the run"),
    ("duration", "the duration of one map"),
    ("spectral_radius", "the largest magnitude of the multipliers"),
    ("and", "an operator"),
    ("or", "an operator"),
    ("not", "an operator"),
];

/// What a name means in the language; `None` if a spec may define it.
pub(crate) fn reserved(name: &str) -> Option<String> {
    if let Some((_, meaning)) = WORDS.iter().find(|(word, _)| *word == name) {
        return Some((*meaning).to_owned());
    }
    let function = FUNCTIONS.iter().any(|(word, _)| *word == name);
    (function || FUNCTIONALS.contains(&name)).then(|| format!("the function `{name}(...)`"))
}

/// All names that belong to the language.
pub(crate) fn reserved_words() -> Vec<&'static str> {
    let words = WORDS.iter().map(|(word, _)| *word);
    words.chain(FUNCTIONS.iter().map(|(word, _)| *word)).chain(FUNCTIONALS.iter().copied()).collect()
}

/// Whether expressions can refer to it: ASCII letters, digits and `_`, no digit first.
pub(crate) fn is_identifier(name: &str) -> bool {
    let mut bytes = name.bytes();
    bytes.next().is_some_and(|b| b.is_ascii_alphabetic() || b == b'_')
        && bytes.all(|b| b.is_ascii_alphanumeric() || b == b'_')
        && name != "_"
}

/// Whether it can name a model, whose generated code is a module of that name.
pub fn is_module_name(name: &str) -> bool {
    name.bytes().next().is_some_and(|b| b.is_ascii_lowercase())
        && name.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'_')
        && syn::parse_str::<syn::Ident>(name).is_ok()
        && name != "gen" // a keyword since edition 2024, which the parser does not know
}

/// The candidate that `name` was probably meant to be, if one is near enough. Of equally near ones the first.
pub fn suggest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // Longer words are not compared: the distance is quadratic in the length, and no name is that long.
    const LONGEST: usize = 64;
    if name.len() > LONGEST {
        return None;
    }
    let limit = if name.chars().count() <= 4 { 1 } else { 2 };
    let lower = name.to_lowercase();
    let mut best: Option<(usize, &str)> = None;
    let near_length =
        |candidate: &&str| candidate.len() <= LONGEST && candidate.len().abs_diff(name.len()) <= 4 * limit;
    for candidate in candidates.into_iter().filter(near_length) {
        let distance = strsim::damerau_levenshtein(&lower, &candidate.to_lowercase());
        if distance <= limit && distance < candidate.chars().count() && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suggestions_are_near_and_the_nearest() {
        assert_eq!(suggest("p_teta", ["q_theta", "p_theta"]), Some("p_theta"));
        assert_eq!(suggest("climb_sped", ["climb_speed", "m"]), Some("climb_speed"));
        assert_eq!(suggest("Omega", ["omega"]), Some("omega"));
        assert_eq!(suggest("x", ["m", "g"]), None);
        assert_eq!(suggest("sprawl", ["psi", "omega"]), None);
        assert_eq!(suggest(&"a".repeat(100_000), ["a"]), None);
    }

    #[test]
    fn names_of_models_are_rust_modules() {
        assert!(is_module_name("prescribed_length"));
        for wrong in ["", "Prescribed", "a-b", "fn", "gen", "1a", "self", "é", "_"] {
            assert!(!is_module_name(wrong), "{wrong}");
        }
        assert!(is_identifier("L0") && is_identifier("_x") && !is_identifier("0L") && !is_identifier("a.b"));
    }

    #[test]
    fn every_word_of_the_language_is_reserved() {
        for word in ["sin", "d", "dot", "mean", "cycle_max", "t", "tau", "pi", "spectral_radius", "and", "if"] {
            assert!(reserved(word).is_some(), "{word}");
        }
        assert_eq!(reserved("g"), None);
    }
}
