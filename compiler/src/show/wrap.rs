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
