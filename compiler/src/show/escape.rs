//! Free text of a spec (titles, doc strings, paths) inside a page: none of it can become markup.

/// Plain text on one line, without control characters, which could move the cursor of a terminal.
pub(super) fn plain(text: &str) -> String {
    let shown = |c: char| if is_unseen(c) { char::REPLACEMENT_CHARACTER } else { c };
    text.split_whitespace().collect::<Vec<_>>().join(" ").chars().map(shown).collect()
}

/// Control characters, and those that change the direction of what follows.
fn is_unseen(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{2069}' | '\u{feff}')
}

/// LaTeX outside of formulas. Characters that pdfTeX does not know go through the macro `\gaitcchar` of the preamble.
pub(super) fn latex(text: &str) -> String {
    let mut out = String::new();
    for c in plain(text).chars() {
        match c {
            '\\' => out.push_str("\\textbackslash{}"),
            '^' => out.push_str("\\textasciicircum{}"),
            '~' => out.push_str("\\textasciitilde{}"),
            '{' | '}' | '$' | '&' | '#' | '%' | '_' => out.extend(['\\', c]),
            '|' => out.push_str("\\textbar{}"),
            '<' => out.push_str("\\textless{}"),
            '>' => out.push_str("\\textgreater{}"),
            '"' => out.push_str("\\textquotedbl{}"),
            '`' => out.push_str("\\textasciigrave{}"),
            // Ligatures would make other characters of these.
            '-' | '\'' | ',' | '?' | '!' => out.extend(['{', c, '}']),
            '[' | ']' => out.extend(['{', c, '}']),
            // Those of T1 and TS1.
            '\u{ad}' => {}
            c if c.is_ascii() || matches!(c, '¡'..='ÿ' | '–' | '—' | '‘' | '’' | '“' | '”' | '…') => {
                out.push(c)
            }
            c => out.push_str(&format!("\\gaitcchar{{{:04X}}}{{{c}}}", u32::from(c))),
        }
    }
    out
}

/// Markdown, also inside the cell of a table.
pub(super) fn markdown(text: &str) -> String {
    let mut out = String::new();
    for c in plain(text).chars() {
        if matches!(
            c,
            '\\' | '`' | '*' | '_' | '{' | '}' | '[' | ']' | '<' | '>' | '#' | '|' | '~' | '$' | '&' | '"' | '^' | '!'
        ) {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

/// Inside a quoted string of the DOT language.
pub(super) fn dot(text: &str) -> String {
    plain(text).replace('\\', "\\\\").replace('"', "\\\"")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_becomes_markup() {
        let hostile = "a\\b {c} $d$ & # % _e ^ ~ | <f> \"g\"\n\u{1b}[31m `h`";
        assert_eq!(plain(hostile), "a\\b {c} $d$ & # % _e ^ ~ | <f> \"g\" \u{fffd}[31m `h`");
        assert_eq!(dot("a\"b\\n\nc"), "a\\\"b\\\\n c");
        assert_eq!(markdown("<b>|*x*|</b>\n# $y$"), "\\<b\\>\\|\\*x\\*\\|\\</b\\> \\# \\$y\\$");
        assert_eq!(
            latex("50% of \\input{x} & $y^2$"),
            "50\\% of \\textbackslash{}input\\{x\\} \\& \\$y\\textasciicircum{}2\\$"
        );
        assert_eq!(latex("a--b π"), "a{-}{-}b \\gaitcchar{03C0}{π}");
    }
}
