//! Equations of a page, aligned at their signs, long sums broken before a term.

use super::sheet::Formula;

/// About how many characters fit on a line of a page.
const WIDTH: usize = 75;

/// An `aligned` environment of rows `left & = right`; empty without rows.
pub(super) fn aligned(rows: &[String]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    format!("\\begin{{aligned}}\n{}\n\\end{{aligned}}", rows.join(" \\\\\n"))
}

/// A row: `left = right`, broken where it is long.
pub(super) fn row(left: &str, formula: &Formula) -> String {
    let mut out = format!("{left} & = ");
    let mut used = width(left) + 3;
    for (i, term) in formula.terms.iter().enumerate() {
        let more = width(term);
        if i > 0 && used + more > WIDTH {
            out = format!("{} \\\\\n & \\qquad ", out.trim_end());
            used = 8;
        }
        out += term;
        out.push(' ');
        used += more + 1;
    }
    out.trim_end().to_owned()
}

/// About how wide a formula is: its characters without commands and braces; of a fraction that counts too much.
fn width(latex: &str) -> usize {
    let mut count = 0;
    let mut command = false;
    for c in latex.chars() {
        match c {
            '\\' => command = true,
            c if command && c.is_ascii_alphabetic() => {}
            _ => {
                // A command counts as one character, be it a letter or a sign.
                count += usize::from(command) + usize::from(!matches!(c, '{' | '}' | ' ' | '_' | '^'));
                command = false;
            }
        }
    }
    count + usize::from(command)
}
