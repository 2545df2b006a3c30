//! States that do not return on a gait are pointed out, unless nothing depends on them.

#![allow(clippy::unwrap_used)] // a test may fail loudly

use gaitc::closing::open_states;
use gaitc_compiler::front::parse_text;
use std::path::Path;

const SPEC: &str = "spec = 1\nname = \"m\"\n[parameters]\nk = \"3 1/s^2\"\n[state]\nway = { unit = \"m\" }\n\
    x = { unit = \"m\" }\nv = { unit = \"m/s\" }\n[modes.go.flow]\nway = \"v\"\nx = \"v\"\nv = \"-k*x\"\n\
    [transitions.step]\nfrom = \"go\"\nto = \"go\"\nguard = \"v\"\ndirection = \"falling\"\n\
    reset = { way = \"way\", x = \"-x\", v = \"v\" }\n\
    [section]\nafter = \"step\"\ncoordinates = [\"v\"]\nembed = { way = \"0\", x = \"0\" }\nstart = { v = \"1 m/s\" }\n";

#[test]
fn only_states_that_matter_and_are_not_coordinates_have_to_close() {
    let spec = parse_text(Path::new("m.toml"), SPEC).model.unwrap();
    assert!(open_states(&spec, &[0.0, 0.1, 1.0], &[0.5, 0.1, 1.5]).is_empty(), "`way` counts, `v` is a coordinate");
    let said = open_states(&spec, &[0.0, 0.1, 1.0], &[0.5, 0.2, 1.0]);
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].starts_with("`x` begins at 0.1 m and ends at 0.2 m"), "{said:?}");
    // Rounding of the integration is no difference.
    assert!(open_states(&spec, &[0.0, 0.1, 1.0], &[0.5, 0.1 + 1e-9, 1.0]).is_empty());
}
