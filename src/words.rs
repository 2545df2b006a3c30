//! Words that depend on a number.

/// A number of things, as in `1 point`, `2 points`, `3 branches`.
pub fn counted(count: u64, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        _ => format!("{count} {}", plural(what)),
    }
}

/// Several of a thing.
pub fn plural(what: &str) -> String {
    let ending = if ["ch", "sh", "s", "x"].iter().any(|end| what.ends_with(end)) { "es" } else { "s" };
    format!("{what}{ending}")
}
