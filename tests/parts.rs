//! Parts at run time: embedded with their spec, or read from the folder of specs, where their values are data.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

use gaitc::load::{LoadError, embedded, load};
use gaitc::models::MODELS;
use std::path::Path;

const PARTS: [&str; 4] = ["constant_voltage", "dc_motor", "dc_motor_planar", "crank_slider"];

fn copy(name: &str, to: &Path) {
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("specs").join(name);
    std::fs::copy(from, to.join(name)).unwrap();
}

#[test]
fn every_model_runs_without_its_files() {
    for entry in MODELS {
        let loaded = embedded(entry).unwrap();
        assert!(loaded.file.is_none() && !loaded.parameters().is_empty());
    }
}

#[test]
fn values_of_parts_are_read_from_the_folder_of_specs() {
    let folder = tempfile::tempdir().unwrap();
    copy("self_exciting.toml", folder.path());
    let missing = load("self_exciting", Some(folder.path())).err().unwrap();
    assert!(matches!(&missing, LoadError::Spec(text) if text.contains("error[E0010]")), "{missing}");
    std::fs::create_dir(folder.path().join("parts")).unwrap();
    PARTS.iter().for_each(|part| copy(&format!("parts/{part}.toml"), folder.path()));
    let motor = folder.path().join("parts/dc_motor.toml");
    let text = std::fs::read_to_string(&motor).unwrap();
    std::fs::write(&motor, text.replace("value = \"56.57\"", "value = \"40\"")).unwrap();
    let loaded = load("self_exciting", Some(folder.path())).unwrap();
    assert_eq!(loaded.parameters()[loaded.parameter("G").unwrap()], 40.0);
    // Its equations are those that were compiled in.
    std::fs::write(&motor, text.replace("G*tau_m(G*w)", "G*tau_m(G*w)/2")).unwrap();
    let stale = load("self_exciting", Some(folder.path())).err().unwrap();
    assert!(matches!(stale, LoadError::Stale(_)), "{stale}");
}
