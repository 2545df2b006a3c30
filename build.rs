//! Turns every `specs/*.toml` into `generated/*.rs` (see `gaitc_compiler::Config`).

fn main() {
    gaitc_compiler::build_script(gaitc_compiler::Config::new().specs("specs").generated("generated"));
}
