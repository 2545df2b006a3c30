//! `gaitc new`: the project that it makes builds outside the repository, from the crates as they are packaged and without
//! a network, and prints the gait that the closed form of its model has. What cannot be made leaves nothing behind.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use common::gaitc_in;
use std::fs;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const REPOSITORY: &str = env!("CARGO_MANIFEST_DIR");

/// The profile of this workspace for all packages, so that its compiled dependencies serve the new project too.
const PROFILE: &str = r#"
[profile.dev]
debug = "line-tables-only"
[profile.dev.package."*"]
opt-level = 1
debug = false
[profile.dev.package.gaitc-compiler]
opt-level = 0
[profile.dev.package.gaitc-runtime]
opt-level = 0
"#;

fn target() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap().to_path_buf()
}

fn cargo(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(folder).arg("--offline").args(args).env("NO_COLOR", "1");
    command
}

fn succeeded(output: &Output) -> (String, String) {
    let [out, err] = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
    assert!(output.status.success(), "{out}\n{err}");
    (out, err)
}

/// A folder with the crates as they would be published, unpacked. Its name is that of their contents: cargo goes by
/// dates, and a package has none.
fn packaged() -> PathBuf {
    let work = Path::new(env!("CARGO_TARGET_TMPDIR")).join("packaged");
    let args =
        ["package", "-p", "gaitc-compiler", "-p", "gaitc-runtime", "--no-verify", "--allow-dirty", "--target-dir"];
    succeeded(&cargo(Path::new(REPOSITORY), &args).arg(&work).output().unwrap());
    let version = env!("CARGO_PKG_VERSION");
    let crates = ["compiler", "runtime"].map(|name| work.join(format!("package/gaitc-{name}-{version}.crate")));
    let mut hasher = DefaultHasher::new();
    crates.iter().for_each(|path| fs::read(path).unwrap().hash(&mut hasher));
    let folder = work.join("unpacked").join(format!("{:016x}", hasher.finish()));
    if !folder.is_dir() {
        let _ = fs::remove_dir_all(work.join("unpacked"));
        let partial = work.join("unpacking");
        let _ = fs::remove_dir_all(&partial);
        fs::create_dir_all(&partial).unwrap();
        for path in &crates {
            succeeded(&Command::new("tar").arg("xzf").arg(path).arg("-C").arg(&partial).output().unwrap());
        }
        fs::create_dir_all(work.join("unpacked")).unwrap();
        fs::rename(&partial, &folder).unwrap();
    }
    folder
}

/// The hopper's gait in closed form, for stiffness `k` and `k_push`, all in SI units: speed on the section, duration,
/// multiplier, height of a hop and compression. The energy at the lowest point, a depth q below, is that of the landing
/// and that of the push-off: c^2 v^2 = w1^2 q^2 - 2 g q and v^2 = w2^2 q^2 - 2 g q with w^2 = k/m.
fn closed_form(k: f64, k_push: f64) -> [f64; 5] {
    let (m, g, c) = (2.0, 9.81, 0.9_f64);
    let (w1, w2) = (f64::sqrt(k / m), f64::sqrt(k_push / m));
    let q = 2.0 * g * (1.0 - c * c) / (w1 * w1 - c * c * w2 * w2);
    let v = f64::sqrt(w2 * w2 * q * q - 2.0 * g * q);
    let multiplier = c * c * (w2 * w2 * q - g) / (w1 * w1 * q - g);
    // Half a swing about the height at which the leg carries the weight, less what would be above the ground.
    let phase = |w: f64| (std::f64::consts::PI - f64::acos((g / (w * w)) / (q - g / (w * w)))) / w;
    let duration = 2.0 * v / g + phase(w1) + phase(w2);
    [v, duration, multiplier, v * v / (2.0 * g), q]
}

/// The numbers that the project prints, in SI units.
fn printed(out: &str) -> [f64; 5] {
    [("v", 1.0), ("duration", 1.0), ("multiplier", 1.0), ("hop_height", 0.01), ("compression", 0.01)].map(
        |(name, unit)| {
            let line = out.lines().find_map(|line| line.strip_prefix(&format!("{name} = ")));
            let number = line.and_then(|line| line.split(' ').next()).unwrap_or_else(|| panic!("no {name} in {out}"));
            unit * number.parse::<f64>().unwrap()
        },
    )
}

#[test]
fn a_new_project_builds_from_packaged_crates_and_prints_its_gait() {
    let outside = tempfile::tempdir().unwrap();
    let project = outside.path().join("it's my \"hopper\" ü");
    let crates = packaged();
    let output = gaitc_in(outside.path(), &["new", project.to_str().unwrap(), "--crates", crates.to_str().unwrap()]);
    succeeded(&output);

    fs::copy(Path::new(REPOSITORY).join("Cargo.lock"), project.join("Cargo.lock")).unwrap();
    fs::write(outside.path().join("profile.toml"), PROFILE).unwrap();
    let shared = ["--config", "../profile.toml", "--target-dir"];
    let run = || {
        let mut command = cargo(&project, &["run"]);
        command.args(shared).arg(target());
        command
    };
    let agree = |out: &str, expected: [f64; 5]| {
        for (got, expected) in printed(out).into_iter().zip(expected) {
            approx::assert_relative_eq!(got, expected, max_relative = 5e-4); // four digits are printed
        }
        assert!(out.contains("stable = true"), "{out}");
    };
    let (out, err) = succeeded(&run().output().unwrap());
    assert!(!err.contains("warning"), "{err}");
    agree(&out, closed_form(1000.0, 1100.0));

    // Another value of a parameter: nothing is derived anew, so no Python is needed.
    let spec = project.join("specs/it_s_my_hopper.toml");
    fs::write(&spec, fs::read_to_string(&spec).unwrap().replace("\"1.1 kN/m\"", "\"1.15 kN/m\"")).unwrap();
    let (out, _) = succeeded(&run().env("GAITC_PYTHON", "/no/such/python").output().unwrap());
    agree(&out, closed_form(1000.0, 1150.0));

    // Nothing is written beside the sources.
    let mut there: Vec<_> = fs::read_dir(&project).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    there.sort();
    assert_eq!(there, [".cargo", ".gitignore", "Cargo.lock", "Cargo.toml", "README.md", "build.rs", "specs", "src"]);
    let clean = cargo(&project, &["clean", "-p", "it_s_my_hopper", "--target-dir"]).arg(target()).output().unwrap();
    succeeded(&clean);
}

/// All paths below a folder.
fn below(folder: &Path) -> Vec<String> {
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        paths.push(path.file_name().unwrap().to_string_lossy().into_owned());
        if path.is_dir() {
            paths
                .extend(below(&path).into_iter().map(|name| format!("{}/{name}", path.file_name().unwrap().display())));
        }
    }
    paths.sort();
    paths
}

const FILES: [&str; 10] = [
    ".cargo",
    ".cargo/config.toml",
    ".gitignore",
    "Cargo.toml",
    "README.md",
    "build.rs",
    "specs",
    "specs/hopper.toml",
    "src",
    "src/main.rs",
];

#[test]
fn a_project_is_made_where_nothing_or_an_empty_folder_is() {
    let folder = tempfile::tempdir().unwrap();
    let at = |path: &str| folder.path().join(path);
    succeeded(&gaitc_in(folder.path(), &["new", "hopper"]));
    assert_eq!(below(&at("hopper")), FILES);
    succeeded(&gaitc_in(folder.path(), &["new", "a/b/../b/hopper"]));
    assert_eq!(below(&at("a/b/hopper")), FILES);
    // A folder that the path goes into and out of again is not made.
    succeeded(&gaitc_in(folder.path(), &["new", "no/such/../../there/hopper"]));
    assert!(at("there/hopper/Cargo.toml").is_file() && !at("no").exists());
    fs::create_dir(at("empty")).unwrap();
    succeeded(&gaitc_in(&at("empty"), &["new", ".", "--name", "hopper"]));
    assert_eq!(below(&at("empty")), FILES);
    let output = gaitc_in(folder.path(), &["new", "4 Hoppers!", "--json"]);
    let value: serde_json::Value = serde_json::from_str(&succeeded(&output).0).unwrap();
    assert_eq!(value["model"], "hoppers");
    assert_eq!(value["files"].as_array().unwrap().len(), 7);
    // This program's own sources are known to it.
    let manifest = fs::read_to_string(at("4 Hoppers!/Cargo.toml")).unwrap();
    let path = toml::from_str::<toml::Table>(&manifest).unwrap()["patch"]["crates-io"]["gaitc-runtime"]["path"].clone();
    assert_eq!(path.as_str(), Some(format!("{REPOSITORY}/runtime").as_str()));
}

#[test]
fn folders_name_models() {
    let folder = tempfile::tempdir().unwrap();
    for (made, name) in [
        ("My Hopper-2", "my_hopper_2"),
        ("3 legs", "legs"),
        ("it's \"it\"", "it_s_it"),
        ("Käfer", "k_fer"),
        ("{name}", "name"),
        ("a__b..c_", "a_b_c"),
    ] {
        let (out, _) = succeeded(&gaitc_in(folder.path(), &["new", made, "--json"]));
        assert_eq!(serde_json::from_str::<serde_json::Value>(&out).unwrap()["model"], name, "{made}");
    }
}

#[test]
fn a_model_called_otherwise_than_its_folder_is_pointed_out() {
    let folder = tempfile::tempdir().unwrap();
    let (out, _) = succeeded(&gaitc_in(folder.path(), &["new", "My Hopper-2"]));
    assert!(out.contains("the model in `My Hopper-2` is called `my_hopper_2`"), "{out}");
    let (out, _) = succeeded(&gaitc_in(folder.path(), &["new", "hopper"]));
    assert!(!out.contains("is called"), "{out}");
}

#[test]
fn what_cannot_be_made_leaves_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("full")).unwrap();
    fs::write(folder.path().join("full/main.rs"), "mine").unwrap();
    fs::write(folder.path().join("file"), "mine").unwrap();
    let before = below(folder.path());
    let long = "long".repeat(100);
    for (args, said) in [
        (&["full"][..], "`full` is not empty, and nothing in it is overwritten"),
        (&["file"], "is not a folder"),
        (&["file/hopper"], "cannot be written"),
        (&["a/b/../../file/c/hopper"], "cannot be written"),
        (&[""], "a value is required"),
        (&["/"], "--name"),
        (&["a\nb"], "cannot build in"),
        (&["a:b"], "cannot build in"),
        (&["fn"], "--name"),
        (&["42"], "--name"),
        (&["test"], "--name"),
        (&[long.as_str()], "--name"),
        (&[long.as_str(), "--name", "hopper"], "cannot be written"),
        (&["x", "--name", ""], "cannot name a model"),
        (&["x", "--name", "Hopper"], "cannot name a model"),
        (&["x", "--name", "my-hopper"], "cannot name a model"),
        (&["x", "--name", "hüpfer"], "cannot name a model"),
        (&["x", "--name", "self"], "cannot name a model"),
        (&["x", "--name", "gaitc_runtime"], "choose another name"),
        (&["x", "--name", "nul"], "choose another name"),
        (&["x", "--name", &long], "at most 64"),
        // Attempts to get out of the name, into TOML, Rust, a path or the template.
        (&["x", "--name", "../x"], "cannot name a model"),
        (&["x", "--name", "a/b"], "cannot name a model"),
        (&["x", "--name", "x\"\n[dependencies]\nevil = \"1"], "cannot name a model"),
        (&["x", "--name", "x\"; fn main() { panic!() } //"], "cannot name a model"),
        (&["x", "--name", "{version}"], "cannot name a model"),
        (&["x", "--name", "--json"], "cannot name a model"),
        (&["x", "--name", "x\u{202e}lmot"], "cannot name a model"),
        (&["x", "--crates", "full"], "does not hold the crates of gaitc"),
        (&["x", "--crates", "/no/such/folder"], "gaitc-compiler-"),
    ] {
        let output = gaitc_in(folder.path(), &[&["new"], args].concat());
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{args:?}: {err}");
        assert!(err.contains(said), "{args:?} gives {err}");
        assert!(err.lines().count() <= 3 && !err.contains('\u{202e}'), "{args:?} gives {err}");
        assert_eq!(below(folder.path()), before, "{args:?}");
    }
}

/// Crates in a folder whose name tries to end the string that it stands in.
#[cfg(unix)]
#[test]
fn a_path_cannot_become_toml() {
    let folder = tempfile::tempdir().unwrap();
    let name = "c\" }\n[dependencies]\nevil = { path = \"/ \\ \u{7f}";
    fs::create_dir_all(folder.path().join(name).parent().unwrap()).unwrap();
    std::os::unix::fs::symlink(REPOSITORY, folder.path().join(name)).unwrap();
    succeeded(&gaitc_in(folder.path(), &["new", "x", "--crates", name]));
    let text = fs::read_to_string(folder.path().join("x/Cargo.toml")).unwrap();
    let manifest: toml::Table = toml::from_str(&text).unwrap();
    let path = manifest["patch"]["crates-io"]["gaitc-compiler"]["path"].as_str().unwrap().to_owned();
    assert_eq!(Path::new(&path), folder.path().join(name).join("compiler"));
    assert_eq!(manifest["dependencies"].as_table().unwrap().len(), 2);
}

/// The page shows each file of a project as it is.
#[test]
fn the_page_shows_the_files() {
    let page = fs::read_to_string(Path::new(REPOSITORY).join("docs/own_project.md")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    succeeded(&gaitc_in(folder.path(), &["new", "hopper"]));
    for file in ["Cargo.toml", ".cargo/config.toml", "build.rs", "specs/hopper.toml", "src/main.rs"] {
        let text = fs::read_to_string(folder.path().join("hopper").join(file)).unwrap();
        // Where the crates lie is another matter on every machine.
        let text = text.split("\n# The sources that gaitc").next().unwrap();
        assert!(
            page.contains(&format!("\n{text}```\n")),
            "docs/own_project.md does not show `{file}` as it is:\n{text}"
        );
    }
}
