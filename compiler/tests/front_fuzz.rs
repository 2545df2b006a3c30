//! Mutated specs through the whole front end, to the fingerprint and the validated model: no panic, no hang, no place that
//! does not exist, no error without a message.
//!
//! `GAITC_FUZZ=100000 cargo test -p gaitc-compiler --test front_fuzz` runs so many cases; `GAITC_FUZZ_FROM=N` begins at
//! case N. A case is made from its number alone. The number of a case that ends the process stands in
//! `target/tmp/front_fuzz.*.case`.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed unwrap fails the test
#![allow(clippy::print_stderr)] // what a long run found

mod fuzz;
mod reference;

use gaitc_compiler::diagnostic::{locate, render};
use gaitc_compiler::front::{Library, parse_with};
use gaitc_compiler::ir::canonical::fingerprint;
use gaitc_compiler::valid::validate;
use reference::blocks;
use std::io::{Seek as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// The part in the documentation.
const SPRING: &str = "spring.toml";
/// Cases of a run that nobody asked for more of.
const CASES: u64 = 3000;
/// Longest time of one case. A sensible spec takes a millisecond.
const LIMIT: Duration = Duration::from_secs(5);
/// Most memory of the whole run.
const MEMORY_KB: u64 = 1 << 20;

fn folder(relative: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(relative)
}

/// The TOML files of a folder: name and text.
fn files(relative: &str) -> Vec<(String, String)> {
    let entries = std::fs::read_dir(folder(relative)).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<(String, String)> = entries
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), std::fs::read_to_string(path).unwrap()))
        .collect();
    files.sort();
    assert!(!files.is_empty(), "{relative}");
    files
}

/// The name of a spec's file.
fn file_name(spec: &str) -> String {
    let name = spec.lines().find_map(|line| line.strip_prefix("name = \"")?.split('"').next());
    format!("{}.toml", name.unwrap())
}

/// Right specs and the examples of the documentation, how many these are, then parts and wrong specs.
fn seeds() -> (Vec<(String, String)>, usize) {
    let mut seeds = files("../specs");
    seeds.extend(files("tests/golden"));
    let pages = reference::pages();
    seeds.push(("rimless_wheel.toml".to_owned(), blocks(&pages, "```toml\n").concat()));
    for fence in ["```toml spec\n", "```toml using\n"] {
        seeds.extend(blocks(&pages, fence).into_iter().map(|text| (file_name(&text), text)));
    }
    seeds.extend(blocks(&pages, "```toml part\n").into_iter().map(|text| (SPRING.to_owned(), text)));
    let right = seeds.len() - 1;
    for relative in ["../specs/parts", "tests/wrong", "tests/wrong/parts"] {
        seeds.extend(files(relative));
    }
    // Large tables are for the test of their limit: every mutation of one costs as much as a hundred others.
    seeds.retain(|(_, text)| text.len() < 8000);
    (seeds, right)
}

/// Everything that a spec can use.
fn parts() -> Vec<(String, String)> {
    let mut parts = files("../specs/parts");
    parts.extend(files("tests/wrong/parts"));
    parts.extend(seeds().0.into_iter().filter(|(name, _)| name == SPRING));
    parts.into_iter().map(|(name, text)| (format!("parts/{name}"), text)).collect()
}

/// Runs a case; `Err` says what does not hold. True if it is a model.
fn run(name: &str, text: &str, library: Library<'_>) -> Result<bool, String> {
    let ensure = |holds: bool, what: &str| if holds { Ok(()) } else { Err(what.to_owned()) };
    let parsed = parse_with(Path::new(name), text, library);
    let errors = parsed.diagnostics.iter().filter(|d| d.is_error()).count();
    ensure(parsed.model.is_none() == (errors > 0), "a model if and only if there is no error")?;
    for diagnostic in &parsed.diagnostics {
        ensure(!diagnostic.labels.is_empty(), "a diagnostic has a place")?;
        ensure(!diagnostic.message.is_empty(), "a diagnostic says something")?;
        for span in diagnostic.labels.iter().map(|label| label.span) {
            let text = parsed.sources.text(span.file);
            ensure(span.start <= span.end && span.end <= text.len(), "places are in the file")?;
            ensure(text.is_char_boundary(span.start) && text.is_char_boundary(span.end), "places are between letters")?;
        }
        ensure(locate(diagnostic, &parsed.sources).is_some(), "a place has line and column")?;
    }
    let rendered = render(&parsed.diagnostics, &parsed.sources, false);
    ensure(rendered.is_empty() == parsed.diagnostics.is_empty(), "what is wrong is shown")?;
    let Some(model) = parsed.model else { return Ok(false) };
    let first = fingerprint(&model);
    match validate(model) {
        Ok(valid) => ensure(fingerprint(valid.model()) == first, "validation does not change the model")?,
        Err(defects) => ensure(!defects.is_empty() && defects.iter().all(|d| !d.is_empty()), "defects say something")?,
    }
    Ok(true)
}

/// Most memory that this process has had, in kB, where the system says so.
fn memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?.trim().strip_suffix(" kB")?.parse().ok()
}

/// What one thread is at: the case and since when, for the one that watches.
type Busy = Mutex<Option<(u64, Instant)>>;

struct Fuzz {
    seeds: Vec<(String, String)>,
    right: usize,
    parts: Vec<(String, String)>,
    next: AtomicU64,
    end: u64,
    models: AtomicU64,
    slowest: Mutex<(Duration, u64)>,
    failures: Mutex<Vec<String>>,
}

impl Fuzz {
    fn work(&self, thread: usize, busy: &Busy) {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
        let mut note = std::fs::File::create(folder.join(format!("front_fuzz.{thread}.case"))).unwrap();
        let parts: Vec<(&str, &str)> = self.parts.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
        loop {
            let number = self.next.fetch_add(1, Ordering::Relaxed);
            if number >= self.end {
                return;
            }
            note.rewind().unwrap();
            write!(note, "{number:20}").unwrap();
            let (name, text) = fuzz::case(&self.seeds, self.right, number);
            let began = Instant::now();
            *busy.lock().unwrap() = Some((number, began));
            let result = std::panic::catch_unwind(|| run(&name, &text, Library::Texts(&parts)));
            *busy.lock().unwrap() = None;
            let mut slowest = self.slowest.lock().unwrap();
            *slowest = (*slowest).max((began.elapsed(), number));
            drop(slowest);
            match result {
                Ok(Ok(model)) => drop(self.models.fetch_add(u64::from(model), Ordering::Relaxed)),
                Ok(Err(what)) => self.failed(number, &name, &text, &format!("does not hold: {what}")),
                Err(_) => self.failed(number, &name, &text, "panics"),
            }
        }
    }

    fn failed(&self, number: u64, name: &str, text: &str, what: &str) {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("front_fuzz.{number}.toml"));
        std::fs::write(&path, text).unwrap();
        self.failures.lock().unwrap().push(format!("case {number} ({name}, {}): {what}", path.display()));
    }

    /// Ends the process when a case takes too long; nothing else can end a thread.
    fn watch(&self, threads: &[Busy]) {
        while self.next.load(Ordering::Relaxed) < self.end || threads.iter().any(|busy| busy.lock().unwrap().is_some())
        {
            std::thread::sleep(Duration::from_millis(50));
            for busy in threads {
                let case = *busy.lock().unwrap();
                if let Some((number, _)) = case.filter(|(_, began)| began.elapsed() > LIMIT) {
                    let (name, text) = fuzz::case(&self.seeds, self.right, number);
                    self.failed(number, &name, &text, "takes too long");
                    eprintln!("{}", self.failures.lock().unwrap().join("\n"));
                    std::process::exit(101);
                }
            }
        }
    }
}

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| text.parse().unwrap_or_else(|_| panic!("{name}={text} is no number")))
}

#[test]
fn mutated_specs_neither_panic_nor_hang() {
    let from = setting("GAITC_FUZZ_FROM", 0);
    let count = setting("GAITC_FUZZ", CASES);
    let (seeds, right) = seeds();
    let fuzz = Fuzz {
        seeds,
        right,
        parts: parts(),
        next: AtomicU64::new(from),
        end: from + count,
        models: AtomicU64::new(0),
        slowest: Mutex::new((Duration::ZERO, 0)),
        failures: Mutex::new(Vec::new()),
    };
    let began = Instant::now();
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get().min(8));
    let busy: Vec<Busy> = (0..threads).map(|_| Mutex::new(None)).collect();
    std::thread::scope(|scope| {
        for (thread, busy) in busy.iter().enumerate() {
            let fuzz = &fuzz;
            scope.spawn(move || fuzz.work(thread, busy));
        }
        fuzz.watch(&busy);
    });
    let (slowest, models) = (fuzz.slowest.into_inner().unwrap(), fuzz.models.into_inner());
    eprintln!(
        "{count} cases from {from} on, of them {models} models, in {:.1?}; slowest: case {} in {:.1?}; {} MB",
        began.elapsed(),
        slowest.1,
        slowest.0,
        memory().unwrap_or(0) / 1024
    );
    let failures = fuzz.failures.into_inner().unwrap();
    assert!(failures.is_empty(), "{} cases fail:\n{}", failures.len(), failures.join("\n"));
    assert!(memory().is_none_or(|kb| kb < MEMORY_KB), "the run takes {} MB", memory().unwrap_or(0) / 1024);
    // Mutations that all end in the first error would test little.
    assert!(models * 50 > count, "{models} of {count} cases are models");
}

/// A hopping ball with further tables, and an expression in its flow.
fn ball(more: &str, flow: &str) -> String {
    format!(
        "spec = 1\nname = \"ball\"\n{more}\n[state]\nx = {{ unit = \"1\" }}\nv = {{ unit = \"1\" }}\n[modes.fly.flow]\n\
         x = \"({flow})*1 [1/s]\"\nv = \"-1 [1/s]\"\n[transitions.hit]\nfrom = \"fly\"\nto = \"fly\"\nguard = \"x\"\n\
         direction = \"falling\"\nreset = {{ x = \"0\", v = \"-v\" }}\n[section]\nafter = \"hit\"\ncoordinates = [\"v\"]\n\
         embed = {{ x = \"0\" }}\nstart = {{ v = \"1\" }}\n"
    )
}

/// `[let]` with a chain of names, each made of the one before.
fn chain(length: usize, next: impl Fn(&str) -> String) -> String {
    let line = |i: usize| format!("y{i} = \"{}\"\n", next(&format!("y{}", i - 1)));
    format!("[let]\ny0 = \"x + v\"\n{}", (1..=length).map(line).collect::<String>())
}

/// What doubles, or worse, with every line: it is either shared or refused, and neither takes long.
#[test]
fn growth_is_bounded() {
    let nested = |n: usize, inner: &str| (0..n).fold(inner.to_owned(), |e, _| format!("d({e}, x)"));
    let dots = |n: usize, inner: &str| (0..n).fold(inner.to_owned(), |e, _| format!("dot({e})"));
    let doubling = chain(60, |y| format!("{y}*sin({y}) + {y}^2"));
    let functions = |n: usize| {
        let line = |i: usize| format!("f{i} = {{ args = [\"z\"], expr = \"d(f{0}(z)*f{0}(z + 1), x)\" }}\n", i - 1);
        let lines: String = (1..=n).map(line).collect();
        format!("[functions]\nf0 = {{ args = [\"z\"], expr = \"sin(z*x)\" }}\n{lines}")
    };
    let switches = chain(60, |y| format!("if({y} < x and {y} > -1 or not {y} < v, max({y}, {y}*2), abs({y}))"));
    let powers = chain(60, |y| format!("{y}^{y}"));
    let towers = chain(60, |y| format!("({y})^99999999"));
    let quotients = chain(60, |y| format!("({y} + 1)/({y} - 1)"));
    for (what, text) in [
        ("doubling lets", ball(&doubling, "y60")),
        ("their derivative", ball(&doubling, "d(y60, x)")),
        ("their higher derivatives", ball(&doubling, &nested(12, "y60"))),
        ("many derivatives", ball("", &nested(100, "sin(x*v)*exp(x^3)/(1 + x^2)"))),
        ("derivatives of derivatives", ball(&chain(40, |y| format!("d({y}*sin({y}), x)")), "y40")),
        ("their rates", ball(&doubling, "x").replace("guard = \"x\"", &format!("guard = \"{}\"", dots(1, "y60")))),
        ("functions of derivatives", ball(&functions(40), "f40(v)")),
        ("functions that share", ball(&functions(12), "f12(v)")),
        ("switches", ball(&switches, "y60")),
        ("derivatives of switches", ball(&switches, "d(y60, x)")),
        ("powers", ball(&powers, "y60")),
        ("derivatives of powers", ball(&powers, &nested(6, "y60"))),
        ("towers", ball(&towers, &nested(6, "y60"))),
        ("quotients", ball(&quotients, &nested(8, "y60"))),
        ("constant towers", ball("", "9^9^9^9^9^9")),
        ("constants", ball(&chain(1000, |_| "2^0.5*3".to_owned()), "y1000")),
        ("units", ball("", &format!("x*(1 [m^999999999])^{}", "9".repeat(30)))),
    ] {
        let began = Instant::now();
        let result = run("ball.toml", &text, Library::Texts(&[]));
        assert!(result.is_ok(), "{what}: {result:?}");
        assert!(began.elapsed() < LIMIT, "{what} takes {:?}", began.elapsed());
        eprintln!("{what}: {:?}, model: {result:?}, {} MB", began.elapsed(), memory().unwrap_or(0) / 1024);
    }
    assert!(memory().is_none_or(|kb| kb < MEMORY_KB), "{} MB", memory().unwrap_or(0) / 1024);
}

/// What the cases have found.
#[test]
fn long_lines_are_refused() {
    // Thousands of errors, each of which showed the line: seconds.
    let key = format!("{}x = 1\n", "exp(".repeat(20_000));
    let dotted = format!("{}x = 1\n", "aé.".repeat(20_000));
    for text in [ball(&key, "x"), ball(&dotted, "x"), ball(&format!("[let]\ny = \"{}", "10^".repeat(20_000)), "x")] {
        let parsed = parse_with(Path::new("ball.toml"), &text, Library::Texts(&[]));
        let rendered = render(&parsed.diagnostics, &parsed.sources, false);
        assert!(parsed.diagnostics.len() == 1 && rendered.contains("a line has at most 20000"), "{rendered}");
        // The same in a part.
        let parts = [("parts/p.toml", text.as_str())];
        let user = ball("use = [\"parts/p.toml\"]", "x");
        let parsed = parse_with(Path::new("ball.toml"), &user, Library::Texts(&parts));
        let rendered = render(&parsed.diagnostics, &parsed.sources, false);
        assert!(rendered.contains("line 3: this line") || rendered.contains("line 4: this line"), "{rendered}");
    }
    // Broken TOML on many lines: the first mistakes are enough.
    let lines = "a b c d e\n".repeat(10_000);
    let parsed = parse_with(Path::new("ball.toml"), &ball(&lines, "x"), Library::Texts(&[]));
    assert!(parsed.diagnostics.len() <= 60, "{}", parsed.diagnostics.len());
}
