//! `gaitc schema`: the JSON Schema of the spec language, for editors.

use super::args::SchemaArgs;
use super::{InputError, Outcome, output};
use gaitc_compiler::schema;

pub(super) fn run(args: &SchemaArgs) -> Result<Outcome, InputError> {
    output::json(&if args.part { schema::part() } else { schema::spec() });
    Ok(Outcome::Done)
}
