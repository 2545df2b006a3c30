//! Mutated specs through the whole front end, to the fingerprint and the validated model: no panic, no hang, no place that
//! does not exist, no error without a message.
//!
//! `GAITC_FUZZ=100000 cargo test -p gaitc-compiler --test front_fuzz` runs so many cases; `GAITC_FUZZ_FROM=N` begins at
//! case N. A case is made from its number alone. The number of a case that ends the process stands in
//! `target/tmp/front_fuzz.*.case`.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed unwrap fails the test
#![allow(clippy::print_stderr)] // what a long run found

mod fuzz;

use gaitc_compiler::diagnostic::{locate, render};
use gaitc_compiler::front::{Library, parse_with};
use gaitc_compiler::ir::canonical::fingerprint;
use gaitc_compiler::valid::validate;
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
const LIMIT: Duration = Duration::from_secs(10);
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

/// Right specs and the examples of the documentation, how many these are, then parts and wrong specs.
fn seeds() -> (Vec<(String, String)>, usize) {
    let mut seeds = files("../specs");
    seeds.extend(files("tests/golden"));
    let page = std::fs::read_to_string(folder("../docs/language.md")).unwrap();
    let blocks = |fence: &str| -> Vec<String> {
        page.split(fence).skip(1).map(|rest| rest.split("```").next().unwrap().to_owned()).collect()
    };
    seeds.push(("rimless_wheel.toml".to_owned(), blocks("```toml\n").concat()));
    for (name, fence) in
        [("sled.toml", "```toml spec\n"), ("bouncer.toml", "```toml using\n"), ("spring.toml", "```toml part\n")]
    {
        seeds.extend(blocks(fence).into_iter().map(|text| (name.to_owned(), text)));
    }
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
            if std::env::var_os("GAITC_FUZZ_SLOW").is_some() && began.elapsed() > Duration::from_millis(400) {
                self.failed(number, &name, &text, &format!("slow {:?}", began.elapsed()));
            }
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
