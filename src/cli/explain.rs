//! `gaitc explain CODE`: what a diagnostic means. The text is that of `docs/errors.md`, embedded.

use super::args::{Cli, ExplainArgs};
use super::{InputError, Outcome, output};
use gaitc_compiler::diagnostic::Code;
use gaitc_compiler::front::suggest;
use serde_json::json;

/// The page that explains all codes.
const PAGE: &str = include_str!("../../docs/errors.md");

/// Columns of a paragraph.
const WIDTH: usize = 88;

pub(super) fn run(cli: &Cli, args: &ExplainArgs) -> Result<Outcome, InputError> {
    let Some(wanted) = &args.code else {
        list(cli);
        return Ok(Outcome::Done);
    };
    let wanted = wanted.trim();
    let code = Code::ALL.iter().find(|code| code.as_str().eq_ignore_ascii_case(wanted));
    let Some((code, text)) = code.and_then(|code| Some((code, entry(PAGE, *code)?))) else {
        return Err(InputError(unknown(wanted)));
    };
    if cli.json {
        output::json(&json!({ "code": code.as_str(), "title": code.title(), "text": text }));
    } else {
        output::print(&format!("{code}: {}\n\n{}", code.title(), terminal(text)));
    }
    Ok(Outcome::Done)
}

fn list(cli: &Cli) {
    if cli.json {
        let one = |code: &Code| json!({ "code": code.as_str(), "title": code.title() });
        output::json(&json!({ "codes": Code::ALL.iter().map(one).collect::<Vec<_>>() }));
    } else {
        let lines: String = Code::ALL.iter().map(|code| format!("{code}  {}\n", code.title())).collect();
        output::print(&(lines + "\nfor more about one: gaitc explain CODE\n"));
    }
}

fn unknown(wanted: &str) -> String {
    let upper = wanted.to_ascii_uppercase();
    let shown: String =
        wanted.chars().take(40).map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c }).collect();
    let help = match suggest(&upper, Code::ALL.iter().map(|code| code.as_str())) {
        Some(near) => format!("did you mean `{near}`? `gaitc explain` lists all codes"),
        None => "codes look like `E0107` or `W0001`; `gaitc explain` lists all".to_owned(),
    };
    format!("no diagnostic has the code `{shown}`\n  help: {help}")
}

/// The body of a code's entry, without its heading; `None` where the page has none.
fn entry(page: &'static str, code: Code) -> Option<&'static str> {
    let heading = format!("\n## {code}: {}\n", code.title());
    let start = page.find(&heading)? + heading.len();
    let rest = page.get(start..)?;
    let end = ["\n## ", "\n# "].iter().filter_map(|next| headings(rest, next)).min();
    rest.get(..end.unwrap_or(rest.len())).map(str::trim)
}

/// Where the next heading begins; a line of a fenced block is none.
fn headings(text: &str, marker: &str) -> Option<usize> {
    let fenced = |at: usize| text.get(..at).is_some_and(|before| before.matches("```").count() % 2 == 1);
    text.match_indices(marker).map(|(at, _)| at).find(|at| !fenced(*at))
}

/// Markdown for a terminal: paragraphs filled, blocks indented, links as the name of what they lead to.
fn terminal(markdown: &str) -> String {
    let mut out = String::new();
    let mut paragraph: Vec<&str> = Vec::new();
    let mut fenced = false;
    for line in markdown.lines() {
        if line.starts_with("```") {
            flush(&mut paragraph, &mut out);
            fenced = !fenced;
        } else if fenced {
            out += format!("    {line}").trim_end();
            out.push('\n');
        } else if line.trim().is_empty() {
            flush(&mut paragraph, &mut out);
            out.push('\n');
        } else {
            paragraph.push(line);
        }
    }
    flush(&mut paragraph, &mut out);
    out
}

fn flush(paragraph: &mut Vec<&str>, out: &mut String) {
    let text = without_links(&paragraph.join(" "));
    paragraph.clear();
    let mut used = 0;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if used > 0 && used + 1 + length > WIDTH {
            out.push('\n');
            used = 0;
        }
        if used > 0 {
            out.push(' ');
            used += 1;
        }
        *out += word;
        used += length;
    }
    if used > 0 {
        out.push('\n');
    }
}

/// `[text](page.md#place)` becomes `text`; a page of this folder is called by its path.
fn without_links(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, behind)) = rest.split_once("](") {
        let (Some(open), Some((target, after))) = (before.rfind('['), behind.split_once(')')) else {
            break;
        };
        let (head, label) = (before.get(..open).unwrap_or(""), before.get(open + 1..).unwrap_or(""));
        out += head;
        out += &if label == target { format!("docs/{label}") } else { label.to_owned() };
        rest = after;
    }
    out + rest
}
