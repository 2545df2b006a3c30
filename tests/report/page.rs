//! The page of `gaitc report`: in a browser that is offline, without scripts, and with hostile text.

use crate::browser::Browser;
use crate::common::{json, text};
use serde_json::{Value, json as value};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn report(folder: &TempDir, args: &[&str]) -> PathBuf {
    let file = folder.path().join("page.html");
    let (code, _, errors) = text(&[&["report"], args, &["--out", file.to_str().unwrap()]].concat());
    assert_eq!(code, 0, "{errors}");
    file
}

const PLACE: &str = "document.querySelector('#stage circle[fill=\"var(--accent)\"]').getAttribute('cy')";
const TIME: &str = "document.getElementById('time').textContent";

fn seconds(shown: &Value) -> f64 {
    shown.as_str().unwrap().strip_suffix(" s").unwrap().parse().unwrap()
}

/// Two readings with some frames between them.
fn twice(browser: &mut Browser, expression: &str) -> (Value, Value) {
    let first = browser.value(expression);
    std::thread::sleep(std::time::Duration::from_millis(250));
    (first, browser.value(expression))
}

#[test]
fn the_animation_plays_stands_still_and_scrubs_offline() {
    let folder = tempfile::tempdir().unwrap();
    let file = report(&folder, &["prescribed_length"]);
    let Some(mut browser) = Browser::start() else { return };
    browser.open(&file, "");
    // It plays by itself.
    let first = browser.value(PLACE);
    browser.wait(&format!("{PLACE} !== {first}"));
    assert_eq!(browser.value("document.getElementById('play').textContent"), "Pause");
    browser.click("#play", 0.5);
    assert_eq!(browser.value("document.getElementById('play').textContent"), "Play");
    let (before, after) = twice(&mut browser, PLACE);
    assert_eq!(before, after, "it moves while it is paused");
    // A click into the middle of the slider goes to the middle of the run.
    browser.click("#scrub", 0.5);
    let end = browser.value("Number(document.getElementById('scrub').max)").as_f64().unwrap();
    let middle = seconds(&browser.value(TIME));
    assert!((middle - 0.5 * end).abs() < 0.1 * end, "{middle} of {end}");
    // By keyboard: on along the slider, then play with the space bar.
    browser.value("document.getElementById('scrub').focus()");
    browser.key("ArrowRight", 39);
    let later = seconds(&browser.value(TIME));
    assert!(later > middle, "{later} after {middle}");
    browser.value("document.getElementById('play').focus()");
    browser.key(" ", 32);
    let here = browser.value(TIME);
    browser.wait(&format!("{TIME} !== {here}"));
    assert_eq!(browser.complaints(), Vec::<Value>::new());
    assert_eq!(browser.requests(), [format!("file://{}", file.display())]);
}

#[test]
fn an_address_with_a_time_and_reduced_motion_open_it_paused() {
    let folder = tempfile::tempdir().unwrap();
    let file = report(&folder, &["prescribed_length", "--steps", "4"]);
    let Some(mut browser) = Browser::start() else { return };
    browser.open(&file, "#t=0.25");
    let (before, after) = twice(&mut browser, TIME);
    assert_eq!((before, after), (value!("0.250 s"), value!("0.250 s")));
    let reduced = value!({ "features": [{ "name": "prefers-reduced-motion", "value": "reduce" }] });
    browser.call("Emulation.setEmulatedMedia", reduced);
    browser.open(&file, "");
    let (before, after) = twice(&mut browser, TIME);
    assert_eq!((before, after), (value!("0.000 s"), value!("0.000 s")));
    // Nothing sticks out of a small screen.
    browser.size(390, 800);
    assert_eq!(browser.value("document.documentElement.scrollWidth"), 390);
    // Without scripts the tables, formulas and pictures are there, and the controls are not.
    browser.call("Emulation.setScriptExecutionDisabled", value!({ "value": true }));
    browser.open(&file, "");
    assert_eq!(browser.value("document.getElementById('player').hidden"), true);
    for (what, least) in [("table", 4), ("figure svg", 4), ("math", 10), ("noscript p", 1)] {
        let count = browser.value(&format!("document.querySelectorAll('{what}').length")).as_u64().unwrap();
        assert!(count >= least, "{count} of `{what}`");
    }
    assert_eq!(browser.complaints(), Vec::<Value>::new());
}

/// Without a gait the page says of each picture what it shows; without coordinates it has no multipliers.
#[test]
fn captions_say_what_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    let page = |args: &[&str], expected: i32| {
        let file = folder.path().join("captions.html");
        let (code, _, errors) = text(&[&["report"], args, &["--steps", "3", "--out", file.to_str().unwrap()]].concat());
        assert_eq!(code, expected, "{errors}");
        fs::read_to_string(file).unwrap()
    };
    let lost = page(&["angle_switched", "--set", "psi=18 deg"], 2);
    assert!(
        lost.contains("two steps from the first guess")
            && lost.contains("Path of the body over 3 steps from the first guess")
    );
    // It takes longer than any step may.
    let slow = page(&["prescribed_length", "--set", "omega=0.001 rad/s"], 2);
    assert!(slow.contains("the run from the first guess, which comes to no step"));
    let forgetful = page(&["power_stroke_crank"], 0);
    assert!(forgetful.contains("every step is the same") && !forgetful.contains("Multipliers: eigenvalues"));
    // Without gravity nothing is lifted: the cost of transport is no number.
    let weightless = page(&["power_stroke", "--set", "g=0 m/s^2"], 0);
    assert!(weightless.contains("<td>–</td>") && weightless.contains("is not a finite number"), "no dash");
}

/// Every script and every fraction has its two parts, and no formula is left as LaTeX.
#[test]
fn formulas_are_whole() {
    let folder = tempfile::tempdir().unwrap();
    let file = report(&folder, &["self_exciting", "--steps", "1"]);
    let Some(mut browser) = Browser::start() else { return };
    browser.open(&file, "");
    for (tags, parts) in [("msup, msub, mfrac, mover", 2), ("msubsup", 3)] {
        let broken = format!(
            "[...document.querySelectorAll('{tags}')].filter(e => e.children.length !== {parts}).map(e => e.outerHTML)"
        );
        assert_eq!(browser.value(&broken), value!([]));
    }
    let left =
        "[...document.querySelectorAll('main code, main p')].map(e => e.textContent).filter(t => /\\\\|[$]/.test(t))";
    assert_eq!(browser.value(left), value!([]));
    assert!(browser.value("document.querySelectorAll('#published table').length").as_u64() >= Some(2));
    assert_eq!(browser.complaints(), Vec::<Value>::new());
}

/// Specs with the texts of one of them replaced.
fn specs(folder: &TempDir, model: &str, replace: &[(&str, &str)]) -> PathBuf {
    let specs = folder.path().join("specs");
    copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("specs"), &specs);
    let file = specs.join(format!("{model}.toml"));
    let mut spec = fs::read_to_string(&file).unwrap();
    for (old, new) in replace {
        assert!(spec.contains(old), "`{old}` is not in {spec}");
        spec = spec.replace(old, new);
    }
    fs::write(file, spec).unwrap();
    specs
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap().map(Result::unwrap) {
        match entry.file_type().unwrap().is_dir() {
            true => copy(&entry.path(), &to.join(entry.file_name())),
            false => {
                fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
            }
        }
    }
}

/// Text of a spec is text on the page, wherever it stands.
#[test]
fn hostile_text_does_not_run() {
    let folder = tempfile::tempdir().unwrap();
    let hostile =
        "</script></title></svg>--><script>window.ran = 1</script><img src=x onerror='window.ran = 2'> & $<b>$";
    let specs = specs(
        &folder,
        "bouncing_ball",
        &[("title = \"", &format!("title = \"{hostile} ")), ("doc = \"", &format!("doc = \"{hostile} "))],
    );
    let file = report(&folder, &["bouncing_ball", "--specs", specs.to_str().unwrap()]);
    let page = fs::read_to_string(&file).unwrap();
    assert!(!page.contains("<script>window") && !page.contains("<img"), "raw text of the spec");
    let Some(mut browser) = Browser::start() else { return };
    browser.open(&file, "");
    assert_eq!(browser.value("typeof window.ran"), "undefined");
    assert!(browser.value("document.title").as_str().unwrap().starts_with(hostile));
    assert!(browser.value("document.querySelector('h1').textContent").as_str().unwrap().starts_with(hostile));
    assert_eq!(browser.complaints(), Vec::<Value>::new());
}

/// A page is made again, to the byte, from what it carries; what it shows is what `gait` says.
#[test]
fn a_page_carries_its_run_and_the_values_of_the_gait() {
    let folder = tempfile::tempdir().unwrap();
    let file = report(&folder, &["prescribed_length", "--set", "psi=25 deg", "--steps", "2"]);
    let first = fs::read_to_string(&file).unwrap();
    let again = folder.path().join("again.html");
    let (code, _, errors) = text(&["run", file.to_str().unwrap(), "--out", again.to_str().unwrap()]);
    assert_eq!(code, 0, "{errors}");
    let second = fs::read_to_string(&again).unwrap();
    let values = |page: &str| page.split("<h2>Gait</h2>").nth(1).unwrap().split("</table>").next().unwrap().to_owned();
    assert_eq!(values(&first), values(&second));
    let (_, gait, _) = text(&["gait", "prescribed_length", "--set", "psi=25 deg"]);
    let line = gait.lines().find(|line| line.contains("climb_speed")).unwrap();
    let quantity = line.trim().strip_prefix("climb_speed").unwrap().trim();
    assert!(first.contains(&format!("<td>{quantity}</td>")), "`{quantity}` is not on the page");
    assert!(first.contains("in the spec: 20 deg"), "that psi was changed is not said");
}

#[test]
fn wrong_requests_are_refused_and_a_model_without_a_gait_gets_its_page() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    for (args, says) in [
        (&["report", "prescribed_length", "--out", &place("page.pdf")][..], ".html"),
        (&["report", "prescribed_length", "--out", &place("none/page.html")], "make the folder first"),
        (&["report", "prescribed_length", "--out", &place("page.html"), "--steps", "0"], "from 1 to"),
        (&["report", "prescribed_length", "--out", &place("page.html"), "--steps", "100000000"], "from 1 to"),
        (&["report", "prescribed_lenght", "--out", &place("page.html")], "did you mean `prescribed_length`"),
        (&["report", "prescribed_length", "--out", &place("page.html"), "--set", "psi=3 m"], "dimensionless"),
    ] {
        let (code, _, errors) = text(args);
        assert_eq!(code, 1, "{args:?}: {errors}");
        assert!(errors.contains(says), "{args:?}: {errors}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "a refused request leaves files");
    // Without a kick the ball comes to rest, and the page says so.
    let file = place("page.html");
    let (code, answer) = json(&["report", "bouncing_ball", "--set", "kick=0 m/s", "--out", &file]);
    assert_eq!((code, answer["gait"].as_bool()), (2, Some(false)), "{answer:#}");
    let page = fs::read_to_string(&file).unwrap();
    assert!(page.contains("No gait was found") && page.contains("<math"), "{}", &page[..2000]);
}
