//! Pieces of HTML. Text goes into a page only through `text`, which escapes it.

use super::{Figure, Table};
use crate::picture::{escape, inline_svg};

/// Escaped text.
pub(super) fn text(text: &str) -> String {
    escape(text)
}

/// Escaped text with what stands between backticks as code.
pub(super) fn coded(words: &str) -> String {
    let parts = words.split('`').collect::<Vec<_>>();
    // A backtick without its pair stays what it is.
    let pairs = parts.len() - 1 - (parts.len() - 1) % 2;
    let part = |(i, part): (usize, &&str)| match i {
        i if i % 2 == 1 && i < pairs => format!("<code>{}</code>", text(part)),
        i if i > pairs => format!("`{}", text(part)),
        _ => text(part),
    };
    parts.iter().enumerate().map(part).collect()
}

/// An element around what is HTML already.
pub(super) fn element(tag: &str, inner: &str) -> String {
    format!("<{tag}>{inner}</{tag}>\n")
}

/// A part of the page with its heading; nothing where it has no content.
pub(super) fn section(id: &str, heading: &str, inner: &str) -> String {
    match inner.trim() {
        "" => String::new(),
        inner => format!("<section id=\"{id}\">\n<h2>{}</h2>\n{inner}\n</section>\n", text(heading)),
    }
}

/// A table; it scrolls by itself where it is wider than the page.
pub(super) fn table(table: &Table) -> String {
    if table.rows.is_empty() {
        return String::new();
    }
    let head: String = table.header.iter().map(|name| format!("<th scope=\"col\">{}</th>", text(name))).collect();
    let row = |row: &Vec<String>| {
        let cells = row.iter().enumerate().map(|(i, cell)| match i {
            0 => format!("<th scope=\"row\">{}</th>", text(cell)),
            _ => format!("<td>{}</td>", text(cell)),
        });
        format!("<tr>{}</tr>\n", cells.collect::<String>())
    };
    let rows: String = table.rows.iter().map(row).collect();
    let caption = if table.caption.is_empty() { String::new() } else { element("caption", &text(&table.caption)) };
    let class = if table.names { " class=\"names\"" } else { "" };
    format!(
        "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"{}\"><table{class}>{caption}<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n",
        text(&table.caption)
    )
}

/// A picture within the page.
pub(super) fn figure(figure: &Figure) -> String {
    let caption = element("figcaption", &text(&figure.caption));
    format!("<figure>\n<div class=\"wide\">{}</div>{caption}</figure>\n", inline_svg(&*figure.picture))
}

#[cfg(test)]
mod tests {
    use super::coded;

    #[test]
    fn what_stands_between_backticks_is_code() {
        assert_eq!(coded("`a<b` and `c`"), "<code>a&lt;b</code> and <code>c</code>");
        assert_eq!(coded("no code & one ` left"), "no code &amp; one ` left");
        assert_eq!(coded("`a` and ` left"), "<code>a</code> and ` left");
    }
}
