//! The page itself.

use super::html::{coded, element, figure, section, table, text};
use super::{Comparison, Contents, equations};
use crate::provenance;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};

const STYLE: &str = include_str!("page.css");
const PLAYER: &str = include_str!("player.js");

/// The page as HTML.
#[must_use]
pub fn page(contents: &Contents) -> String {
    let title = text(&contents.title);
    // Only this script may run, whatever else should ever come into the page.
    let player = STANDARD.encode(Sha256::digest(PLAYER.as_bytes()));
    let policy = format!(
        "default-src 'none'; style-src 'unsafe-inline'; script-src 'sha256-{player}'; base-uri 'none'; form-action 'none'"
    );
    let head = format!(
        "<meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<meta name=\"generator\" content=\"gaitc {}\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n\
         <script type=\"application/json\" id=\"{}\">{}</script>\n",
        provenance::Provenance::VERSION,
        provenance::KEY,
        contents.provenance.line()
    );
    let body = header(contents)
        + "<main>\n"
        + &motion(contents)
        + &section("gait", "Gait", &contents.gait.iter().map(table).collect::<String>())
        + &section(
            "published",
            "Published beside computed",
            &contents.published.iter().map(comparison).collect::<String>(),
        )
        + &section("pictures", "Pictures", &contents.figures.iter().map(figure).collect::<String>())
        + &section("parameters", "Parameters", &table(&contents.parameters))
        + &section("equations", "Equations", &equations(&contents.equations))
        + &section("origin", "How this page was made", &origin(contents))
        + "</main>\n";
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n{head}</head>\n<body>\n{body}<script>{PLAYER}</script>\n</body>\n</html>\n"
    )
}

fn header(contents: &Contents) -> String {
    let source = if contents.source.is_empty() { String::new() } else { format!(" · {}", text(&contents.source)) };
    let summary: String = contents.summary.iter().map(|line| element("p", &coded(line))).collect();
    format!(
        "<header>\n<h1>{}</h1>\n<p class=\"source\">Model <code>{}</code>{source}</p>\n{summary}</header>\n",
        text(&contents.title),
        text(&contents.model)
    )
}

fn motion(contents: &Contents) -> String {
    let inner = match &contents.animation {
        Err(reason) => element("p", &text(reason)),
        Ok(animation) => format!(
            "<noscript><p>The animation needs JavaScript; the path of the body is among the pictures below.</p></noscript>\n\
             <div id=\"player\" hidden>\n<svg id=\"stage\" role=\"img\" aria-label=\"The machine in motion\"></svg>\n\
             <div class=\"controls\">\n<button id=\"play\" type=\"button\">Play</button>\n\
             <label class=\"scrub\"><span class=\"unseen\">Time</span><input id=\"scrub\" type=\"range\" min=\"0\" value=\"0\" step=\"any\"></label>\n\
             <output id=\"time\" for=\"scrub\">0.000 s</output>\n\
             <label>Speed <select id=\"speed\"><option value=\"0.05\">1/20</option><option value=\"0.1\">1/10</option>\
             <option value=\"0.25\" selected>1/4</option><option value=\"0.5\">1/2</option><option value=\"1\">1</option></select></label>\n\
             </div>\n</div>\n<script type=\"application/json\" id=\"motion-data\">{}</script>\n",
            animation.json()
        ),
    };
    section("motion", "Motion", &inner)
}

fn comparison(comparison: &Comparison) -> String {
    let about = if comparison.about.is_empty() { String::new() } else { element("p", &text(&comparison.about)) };
    let drawn = comparison.figure.as_ref().map(figure).unwrap_or_default();
    format!("<h3>{}</h3>\n{about}{}{drawn}", text(&comparison.name), table(&comparison.table))
}

fn origin(contents: &Contents) -> String {
    let made = &contents.provenance;
    let row = |name: &str, value: &str| format!("<dt>{}</dt><dd><code>{}</code></dd>\n", text(name), text(value));
    let rows = row("command", &contents.command)
        + &row("program", &format!("gaitc {}", provenance::Provenance::VERSION))
        + &row("equations", &made.fingerprint)
        + &row("spec", &made.spec);
    let run = toml::to_string(&made.run).unwrap_or_default();
    format!(
        "<dl>\n{rows}</dl>\n<p>The run, as a run file has it; <code>gaitc run</code> takes this page in its place:</p>\n<pre class=\"wide\" tabindex=\"0\">{}</pre>\n",
        text_lines(&run)
    )
}

/// Escaped text that keeps its lines.
fn text_lines(all: &str) -> String {
    all.lines().map(|line| text(line) + "\n").collect()
}
