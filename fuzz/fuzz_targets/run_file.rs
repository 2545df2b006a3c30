//! Any bytes as a result that carries its run.
#![no_main]

use gaitc::provenance::find;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Some(found) = find(bytes) {
        assert!(found.get("run").is_some());
    }
});
