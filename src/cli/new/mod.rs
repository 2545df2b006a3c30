//! `gaitc new DIR`: a cargo project of the user's own, with a model, a build script that compiles it and a program that
//! prints its gait. Nothing that is there is overwritten, and a project that cannot be made whole is not made at all.

mod crates;
mod files;
mod name;

use super::args::{Cli, NewArgs};
use super::{InputError, Outcome, output};
use crates::Crates;
use serde_json::json;
use std::path::Path;

/// The files of a project, with `{name}` for the model's name and `{version}` for that of the crates.
///
/// The endings keep cargo and rustfmt from taking the templates for files of this package.
const TEMPLATE: &[(&str, &str)] = &[
    ("Cargo.toml", include_str!("template/Cargo.toml.in")),
    (".cargo/config.toml", include_str!("template/config.toml.in")),
    ("build.rs", include_str!("template/build.rs.in")),
    ("specs/{name}.toml", include_str!("template/model.toml.in")),
    ("src/main.rs", include_str!("template/main.rs.in")),
    ("README.md", include_str!("template/README.md.in")),
    (".gitignore", include_str!("template/gitignore.in")),
];

pub(super) fn run(cli: &Cli, args: &NewArgs) -> Result<Outcome, InputError> {
    let folder = name::folder(&args.folder)?;
    let name = match &args.name {
        Some(name) => name::checked(name, "--name")?,
        None => name::of_folder(&folder)?,
    };
    let crates = Crates::find(args.crates.as_deref())?;
    let texts = texts(&name, crates.as_ref());
    let shown = args.folder.display().to_string();
    files::create(&folder, &shown, &texts)?;
    if cli.json {
        let paths: Vec<&str> = texts.iter().map(|(path, _)| path.as_str()).collect();
        output::json(&json!({ "folder": shown, "model": name, "files": paths, "crates": crates.map(Crates::json) }));
    } else {
        let last = folder.file_name().unwrap_or_default().to_string_lossy();
        let note = match args.name.is_none() && last != name {
            true => format!("{}: the model in `{}` is called `{name}`\n", name::RULE, last.escape_debug()),
            false => String::new(),
        };
        output::print(&(said(&args.folder, &name, crates.as_ref()) + &note));
    }
    Ok(Outcome::Done)
}

/// The files of a project: path and text.
fn texts(name: &str, crates: Option<&Crates>) -> Vec<(String, String)> {
    let filled = |text: &str| text.replace("{name}", name).replace("{version}", env!("CARGO_PKG_VERSION"));
    let mut texts: Vec<(String, String)> = TEMPLATE.iter().map(|(path, text)| (filled(path), filled(text))).collect();
    if let Some(((_, manifest), crates)) = texts.first_mut().zip(crates) {
        manifest.push_str(&crates.patch());
    }
    texts
}

fn said(folder: &Path, name: &str, crates: Option<&Crates>) -> String {
    let from = match crates {
        Some(crates) => format!("it is built with the sources of gaitc in `{}`", crates.compiler.display()),
        None => "it is built with the published crates of gaitc".to_owned(),
    };
    format!(
        "created `{}` with the model `{name}`: {from}\n\n  specs/{name}.toml  the model\n  src/main.rs  prints its \
         gait\n\nrun `cargo run` in that folder\n",
        folder.display()
    )
}
