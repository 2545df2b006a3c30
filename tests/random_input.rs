//! Random command lines, damaged run files and damaged study folders: the program answers, with an exit code that it documents.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use common::gaitc_in;
use std::fs;
use std::path::Path;

/// A generator after S. Vigna, "An experimental exploration of Marsaglia's xorshift generators", 2016.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33) as usize % bound
    }

    fn of<'a>(&mut self, all: &[&'a str]) -> &'a str {
        all[self.below(all.len())]
    }
}

/// Runs the program in a folder, since it may write what it is asked to. It has to come to an end that it documents; its exit code and
/// stdout.
fn answers(folder: &Path, arguments: &[&str]) -> (i32, String) {
    let output = gaitc_in(folder, arguments);
    let (out, errors) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    let code = output.status.code().unwrap_or(-1);
    assert!([0, 1, 2].contains(&code), "{arguments:?} ends with {code}\n{out}\n{errors}");
    assert!(!errors.contains("panicked"), "{arguments:?}\n{errors}");
    assert!(code != 1 || !errors.is_empty(), "{arguments:?} fails without a word\n{out}");
    (code, out.into_owned())
}

/// The commands, as the program's own help has them: a new one is covered by being there.
fn commands(folder: &Path) -> Vec<String> {
    let (_, help) = answers(folder, &["--help"]);
    let lines = help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    // What is further in goes on with the line before.
    let names = lines.filter(|line| !line.starts_with("    ")).filter_map(|line| line.split_whitespace().next());
    names.filter(|name| *name != "help").map(str::to_owned).collect()
}

/// Long names of the flags of a command.
fn flags(folder: &Path, command: &str) -> Vec<String> {
    let (_, help) = answers(folder, &[command, "--help"]);
    let options = help.lines().skip_while(|line| *line != "Options:").map(str::trim_start);
    let names = options.filter(|line| line.starts_with('-')).filter_map(|line| line.split_once("--"));
    let name = |(_, rest): (&str, &str)| rest.split([' ', ',', '=', '[']).next().map(|name| format!("--{name}"));
    let names = names.filter_map(name);
    names.filter(|name| !["--help", "--version"].contains(&name.as_str())).collect()
}

/// What a flag may be given: nothing that is both right and much work.
const VALUES: [&str; 31] = [
    "",
    "0",
    "-1",
    "3",
    "2.5",
    "NaN",
    "inf",
    "1e309",
    "1e-400",
    "-",
    "--",
    "=",
    "..",
    "0..1",
    "kick=",
    "=1",
    "kick=0.2 m/s",
    "kick=0.1..0.4 m/s",
    "kick=0.1..0.4 m/s:3",
    "kick=0.4..0.1 m/s:3",
    "v=1 m/s",
    "v=1..2 m/s:2",
    "e=0.5",
    "e=200 %",
    "g=0",
    "y > 0",
    "height:spectral_radius",
    "spectral_radius <= 0.9",
    "picture.svg",
    "\u{fc}\u{221a}\u{1f9d7}",
    "/proc/nowhere/at/all.csv",
];

/// What stands behind a command, besides the model that is right.
const OTHERS: [&str; 7] = ["bouncing_bal", "../specs/bouncing_ball.toml", "", "E0101", "bash", "a folder", "--"];

#[test]
fn random_command_lines_are_answered() {
    let folder = tempfile::tempdir().unwrap();
    // Two folders down: `..` is then one that may be written to.
    let place = folder.path().join("a/b");
    fs::create_dir_all(&place).unwrap();
    let commands = commands(&place);
    assert!(
        commands.iter().any(|name| name == "optimize") && commands.iter().any(|name| name == "man"),
        "{commands:?}"
    );
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for command in &commands {
        let flags = flags(&place, command);
        assert!(flags.iter().any(|flag| flag == "--json"), "{command}: {flags:?}");
        // More points than a test can wait for are not asked for: what is valid above is small.
        let given = |random: &mut Random, flag: Option<usize>| {
            let mut arguments = vec![command.as_str()];
            if random.below(8) > 0 {
                arguments.push(if random.below(3) > 0 { "bouncing_ball" } else { random.of(&OTHERS) });
            }
            let further: Vec<usize> = (0..random.below(3)).map(|_| random.below(flags.len())).collect();
            for flag in flag.into_iter().chain(further) {
                arguments.push(&flags[flag]);
                if random.below(4) > 0 {
                    arguments.push(random.of(&VALUES));
                }
            }
            answers(&place, &arguments);
        };
        (0..flags.len()).for_each(|flag| given(&mut random, Some(flag)));
        (0..2).for_each(|_| given(&mut random, None));
    }
}

const RUN: &str = "command = \"gait\"\nmodel = \"bouncing_ball\"\ntol = 1e-10\nperiod = 2\njson = true\nguess = [\"v=2 m/s\"]\n[set]\n\
                   kick = \"0.4 m/s\"\n";

/// Some bytes changed, left out or repeated.
fn damaged(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..=random.below(3) {
        let at = random.below(bytes.len().max(1));
        match random.below(4) {
            0 => bytes.truncate(at),
            1 if at < bytes.len() => bytes[at] = random.below(256) as u8,
            2 => bytes.insert(at, b"\"[]{}=,.#\n0\xff"[random.below(12)]),
            _ => bytes.extend_from_within(at..(at + random.below(9)).min(bytes.len())),
        }
    }
    bytes
}

#[test]
fn damaged_run_files_are_answered() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("run.toml");
    let path = file.to_str().unwrap();
    let (_, result) = answers(folder.path(), &["gait", "bouncing_ball", "--json"]);
    let mut random = Random(88_172_645_463_325_252);
    for turn in 0..60 {
        let whole = if turn % 3 == 0 { result.as_bytes() } else { RUN.as_bytes() };
        fs::write(&file, damaged(whole, &mut random)).unwrap();
        answers(folder.path(), &["run", path, "--quiet"]);
    }
}

const STUDY: [&str; 6] = ["sweep", "bouncing_ball", "--over", "kick=0.1..0.5 m/s:24", "--chunk", "4"];

/// What is damaged in a study's folder is refused or computed again: a table that is there in the end is the right one.
#[test]
fn damaged_studies_end_right_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let study = folder.path().join("study");
    let resumed = || answers(folder.path(), &[&STUDY[..], &["--resume", "--dir", "study"]].concat()).0;
    assert_eq!(resumed(), 0);
    let table = fs::read(study.join("sweep.csv")).unwrap();
    let mut places: Vec<_> = fs::read_dir(study.join("chunks")).unwrap().map(|entry| entry.unwrap().path()).collect();
    places.push(study.join("study.json"));
    places.sort();
    let (mut random, mut right) = (Random(1_234_567), 0);
    for turn in 0..40 {
        let place = &places[turn % places.len()];
        let whole = fs::read(place).unwrap();
        fs::write(place, damaged(&whole, &mut random)).unwrap();
        fs::remove_file(study.join("sweep.csv")).unwrap();
        if resumed() == 0 {
            right += 1;
            assert!(fs::read(study.join("sweep.csv")).unwrap() == table, "{}", place.display());
        } else {
            fs::write(place, &whole).unwrap();
            assert_eq!(resumed(), 0, "{} was put right again", place.display());
        }
    }
    assert!(right >= 30, "damaged chunks are computed again: {right} of 40 went on");
}
