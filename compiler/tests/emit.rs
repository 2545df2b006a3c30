//! Generated code: committed copies that are compiled here, fresh and deterministic.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // tests say what went wrong by panicking

mod common;

use common::{every_operation, generate, parse, python, test_file, validated, with_mass_matrix};
use gaitc_compiler::casadi::Python;
use gaitc_compiler::valid::Validated;

/// The specs of the golden files.
fn models() -> Vec<Validated> {
    let golden = |name: &str| parse(name, &std::fs::read_to_string(test_file(&format!("golden/{name}.toml"))).unwrap());
    [golden("prescribed_length"), golden("hopper"), every_operation(), with_mass_matrix()].map(validated).into()
}

/// Regenerates the golden files, writes those that differ, and still fails, so that somebody looks at the difference.
#[test]
fn golden_files_are_fresh() {
    let models = models();
    let mut stale = Vec::new();
    for (model, text) in models.iter().zip(generate(&python(), &models)) {
        let path = test_file(&format!("golden/{}.rs", model.model().name));
        if std::fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n") != text {
            std::fs::write(&path, text).unwrap();
            stale.push(path);
        }
    }
    assert!(stale.is_empty(), "these files were stale and have been written anew; look at them: {stale:?}");
}

#[test]
fn the_same_model_gives_the_same_bytes() {
    let python = python();
    let texts: Vec<Vec<String>> =
        ["0", "1", "4711"].iter().map(|seed| generate(&seeded(&python, seed), &models())).collect();
    assert_eq!(texts[0], texts[1]);
    assert_eq!(texts[0], texts[2]);
}

/// The same Python with another seed of its hashes, which decide the order of its sets.
fn seeded(python: &Python, seed: &str) -> Python {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let script = folder.join(format!("python-seed-{seed}"));
    let text = format!("#!/bin/sh\nPYTHONHASHSEED={seed} exec '{}' \"$@\"\n", python.command.display());
    std::fs::write(&script, text).unwrap();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        std::fs::set_permissions(&script, std::fs::Permissions::from_mode(0o755)).unwrap();
    }
    Python { command: script, ..python.clone() }
}

#[test]
fn generated_code_keeps_its_promises() {
    for model in models() {
        let text = std::fs::read_to_string(test_file(&format!("golden/{}.rs", model.model().name))).unwrap();
        let file = syn::parse_file(&text).unwrap();
        let tokens = quote::quote!(#file).to_string();
        for word in
            ["unsafe", "std ::", "alloc", "panic", "unwrap", "expect", "todo", "unreachable", "assert!", "assert_"]
        {
            assert!(!tokens.contains(word), "`{word}` in {}", model.model().name);
        }
        assert!(!indexes(&file), "indexing can panic");
    }
}

/// Whether any expression of a file is an index.
fn indexes(file: &syn::File) -> bool {
    struct Found(bool);
    impl<'a> syn::visit::Visit<'a> for Found {
        fn visit_expr_index(&mut self, _: &'a syn::ExprIndex) {
            self.0 = true;
        }
    }
    let mut found = Found(false);
    syn::visit::Visit::visit_file(&mut found, file);
    found.0
}
