//! The sources that decide how generated code looks: when one of them changes, everything is generated again.

use super::stamp::normalised;
use crate::ir::canonical::hex_digest;

macro_rules! sources {
    ($($path:literal),* $(,)?) => { &[$(($path, include_str!(concat!("../", $path)))),*] };
}

/// Path below `src/` and text.
const SOURCES: &[(&str, &str)] = sources![
    "back/mod.rs",
    "back/rust/body.rs",
    "back/rust/clock.rs",
    "back/rust/derivatives.rs",
    "back/rust/dispatch.rs",
    "back/rust/info.rs",
    "back/rust/measured.rs",
    "back/rust/mod.rs",
    "back/rust/names.rs",
    "back/rust/registry.rs",
    "back/rust/tangent.rs",
    "back/rust/text.rs",
    "back/rust/values.rs",
    "casadi/derive.py",
    "casadi/exchange.rs",
    "casadi/functions.rs",
    "casadi/fuse.rs",
    "casadi/hoist.rs",
    "casadi/program.rs",
    "casadi/tape.rs",
    "valid/facts.rs",
];

/// Hash of all sources.
pub(super) fn hash() -> String {
    let text: String =
        SOURCES.iter().map(|(path, text)| format!("{path} {}\n", hex_digest(normalised(text).as_bytes()))).collect();
    hex_digest(text.as_bytes())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test says what went wrong by panicking
    use super::SOURCES;
    use std::collections::BTreeSet;
    use std::path::Path;

    /// Files below the folders of the emitter and of the CasADi step that do not decide how generated code looks.
    const WITHOUT_INFLUENCE: &[&str] = &[
        "casadi/environment.rs",
        "casadi/hoist_tests.rs",
        "casadi/mod.rs",
        "casadi/requirements.txt",
        "casadi/run.rs",
    ];

    fn files(root: &Path, folder: &str, found: &mut BTreeSet<String>) {
        for entry in std::fs::read_dir(root.join(folder)).unwrap() {
            let entry = entry.unwrap();
            let path = format!("{folder}/{}", entry.file_name().into_string().unwrap());
            if entry.file_type().unwrap().is_dir() {
                files(root, &path, found);
            } else {
                found.insert(path);
            }
        }
    }

    #[test]
    fn the_list_is_complete() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let mut found = BTreeSet::new();
        files(&root, "back", &mut found);
        files(&root, "casadi", &mut found);
        found.insert("valid/facts.rs".to_owned());
        let listed: BTreeSet<String> = SOURCES
            .iter()
            .map(|(path, _)| (*path).to_owned())
            .chain(WITHOUT_INFLUENCE.iter().map(|p| (*p).to_owned()))
            .collect();
        assert_eq!(found, listed);
    }
}
