//! Lines and tables that fit a terminal.

/// Columns of a page.
const WIDTH: usize = 100;

/// Text broken at spaces, its further lines below column `hang`; `head` stands before it.
pub(super) fn wrapped(head: &str, text: &str, hang: usize) -> String {
    let mut out = String::new();
    let mut line = head.to_owned();
    let mut fresh = true;
    for word in text.split(' ').filter(|word| !word.is_empty()) {
        if !fresh && line.chars().count() + 1 + word.chars().count() > WIDTH {
            out += line.trim_end();
            out.push('\n');
            line = " ".repeat(hang);
            fresh = true;
        }
        if !fresh {
            line.push(' ');
        }
        line += word;
        fresh = false;
    }
    out += line.trim_end();
    out.push('\n');
    out
}

/// A formula broken before an operator or behind a comma, outside of parentheses as long as what is inside fits.
pub(super) fn formula(head: &str, text: &str, hang: usize) -> String {
    wrapped(head, &held_together(text), hang).replace(HOLD, " ")
}

/// Stands for a space at which a line is not to be broken.
const HOLD: char = '\u{1}';

/// Longest piece of a formula that is held together.
const PIECE: usize = 60;

fn held_together(text: &str) -> String {
    let (mut pieces, mut piece) = (Vec::new(), String::new());
    let mut depth = 0_usize;
    for word in text.split(' ') {
        let operator = matches!(word, "+" | "-" | "<" | ">" | "≤" | "≥" | "and" | "or" | "if" | "else");
        if depth == 0 && (operator || piece.ends_with(',')) && !piece.is_empty() {
            pieces.push(std::mem::take(&mut piece));
        }
        if !piece.is_empty() {
            piece.push(' ');
        }
        piece += word;
        let (opened, closed) = (word.matches(['(', '[']).count(), word.matches([')', ']']).count());
        depth = (depth + opened).saturating_sub(closed);
    }
    pieces.push(piece);
    let hold = |piece: String| if piece.chars().count() > PIECE { piece } else { piece.replace(' ', "\u{1}") };
    pieces.into_iter().map(hold).collect::<Vec<_>>().join(" ")
}

/// Rows in columns two spaces apart, indented by two; the last column is broken into lines.
pub(super) fn table(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let mut widths = vec![0; columns];
    for row in rows {
        for (width, cell) in widths.iter_mut().zip(row) {
            *width = (*width).max(cell.chars().count());
        }
    }
    let before: usize =
        2 + widths.iter().take(columns.saturating_sub(1)).map(|width| width + gap(*width)).sum::<usize>();
    let mut out = String::new();
    for row in rows {
        let mut head = "  ".to_owned();
        for (cell, width) in row.iter().zip(&widths).take(columns.saturating_sub(1)) {
            head += cell;
            head += &" ".repeat(width - cell.chars().count() + gap(*width));
        }
        // Where the other columns take it all, the last one goes below them.
        let last = row.get(columns.saturating_sub(1)).map_or("", String::as_str);
        if before > WIDTH - 30 && !last.is_empty() {
            out += head.trim_end();
            out += "\n";
            out += &wrapped("      ", last, 6);
        } else {
            out += &wrapped(&head, last, before);
        }
    }
    out
}

/// No space behind a column that is empty everywhere.
fn gap(width: usize) -> usize {
    if width == 0 { 0 } else { 2 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_break_before_operators_outside_of_parentheses() {
        assert_eq!(held_together("a + (b - c)·d - f(x, y)"), "a +\u{1}(b\u{1}-\u{1}c)·d -\u{1}f(x,\u{1}y)");
        assert_eq!(held_together("a if x < 0, else b"), "a if\u{1}x <\u{1}0, else\u{1}b");
        let long = format!("({})", ["a"; 40].join(" + "));
        assert_eq!(held_together(&long), long);
        assert_eq!(formula("x = ", &["(a + b)"; 30].join(" + "), 4).lines().count(), 4);
    }

    #[test]
    fn lines_fit_and_hang() {
        let text = wrapped("  x = ", &"word ".repeat(40), 6);
        assert!(text.lines().all(|line| line.chars().count() <= WIDTH), "{text}");
        assert!(text.starts_with("  x = word") && text.lines().nth(1).is_some_and(|l| l.starts_with("      word")));
        let rows = [vec!["a".to_owned(), String::new(), "long ".repeat(60)], vec!["bb".to_owned()]];
        let text = table(&rows);
        assert!(text.starts_with("  a   long") && text.ends_with("  bb\n"), "{text}");
        assert!(text.lines().all(|line| line.chars().count() <= WIDTH), "{text}");
    }
}
