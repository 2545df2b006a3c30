//! Any text as the manifest of a study.
#![no_main]

use gaitc::study::Manifest;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let Ok(manifest) = Manifest::read(text) else {
        return;
    };
    let _ = (manifest.provenance(), manifest.table(), manifest.hash());
    // What was read can be written and read again.
    assert_eq!(Manifest::read(&manifest.text()).map(|again| again.text()), Ok(manifest.text()));
    let chunks = manifest.chunks();
    assert!(chunks == 0 || manifest.rows(chunks - 1).end >= manifest.rows(0).start);
});
