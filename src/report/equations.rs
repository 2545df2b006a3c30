//! The equations of a model as HTML: its Markdown page with the formulas as MathML, which browsers set without help.

use super::html;
use pulldown_cmark::{Event, HeadingLevel, Options, Parser, Tag, TagEnd};
use pulldown_latex::config::DisplayMode;
use pulldown_latex::{RenderConfig, Storage, push_mathml};

/// Beginnings of headings of parts of the Markdown page that a report shows in another place and way.
const ELSEWHERE: [&str; 3] = ["Parameters", "Drawing", "Published"];

/// The page without its title; headings are one level lower. Raw HTML in it is shown as text.
#[must_use]
pub fn equations(markdown: &str) -> String {
    let options = Options::ENABLE_TABLES | Options::ENABLE_MATH;
    let mut events = Vec::new();
    let mut kept = false;
    let mut all = Parser::new_ext(markdown, options).peekable();
    while let Some(event) = all.next() {
        if let Event::Start(Tag::Heading { level, .. }) = event {
            // What stands before the first part is the title, which the report has itself.
            kept = level != HeadingLevel::H1
                && !matches!(all.peek(), Some(Event::Text(name)) if ELSEWHERE.iter().any(|part| name.starts_with(part)));
        }
        if kept {
            events.push(lower(event));
        }
    }
    let mut page = String::new();
    pulldown_cmark::html::push_html(&mut page, events.into_iter());
    page.replace("<table>", "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"table\"><table>")
        .replace("</table>", "</table></div>")
}

fn lower(event: Event<'_>) -> Event<'_> {
    let down = |level| if level == HeadingLevel::H2 { HeadingLevel::H3 } else { HeadingLevel::H4 };
    match event {
        Event::Start(Tag::Heading { level, id, classes, attrs }) => {
            Event::Start(Tag::Heading { level: down(level), id, classes, attrs })
        }
        Event::End(TagEnd::Heading(level)) => Event::End(TagEnd::Heading(down(level))),
        Event::InlineMath(latex) => Event::InlineHtml(mathml(&latex, DisplayMode::Inline).into()),
        Event::DisplayMath(latex) => {
            let math = mathml(&latex, DisplayMode::Block);
            Event::InlineHtml(format!("<span class=\"wide formula\">{math}</span>").into())
        }
        Event::Html(raw) | Event::InlineHtml(raw) => Event::Text(raw),
        other => other,
    }
}

/// A formula; one that cannot be set is shown as it was written.
fn mathml(latex: &str, display_mode: DisplayMode) -> String {
    let latex = &grouped(latex);
    let storage = Storage::new();
    let mut math = String::new();
    let config = RenderConfig { display_mode, ..RenderConfig::default() };
    match push_mathml(&mut math, pulldown_latex::Parser::new(latex, &storage), config) {
        Ok(()) if !math.contains("<merror") => math.replace("<mo><</mo>", "<mo>&lt;</mo>"),
        _ => format!("<code>{}</code>", html::text(latex)),
    }
}

/// Functions with an exponent or an index in groups: else the space before a function would become its base.
fn grouped(latex: &str) -> String {
    const FUNCTIONS: [&str; 10] = ["sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "ln", "min", "max"];
    FUNCTIONS.iter().fold(latex.to_owned(), |latex, name| {
        ["^", "_"]
            .iter()
            .fold(latex, |latex, script| latex.replace(&format!("\\{name}{script}"), &format!("{{\\{name}}}{script}")))
    })
}
