//! Turns every `specs/*.toml` into `generated/*.rs`; see `gaitc_compiler::build`.

fn main() -> std::process::ExitCode {
    match gaitc_compiler::build::Config::new().specs("specs").generated("generated").compile() {
        Ok(_report) => std::process::ExitCode::SUCCESS,
        Err(error) => {
            // The only way a build script can speak to the user.
            #[allow(clippy::print_stderr)]
            {
                eprintln!("{error}");
            }
            std::process::ExitCode::FAILURE
        }
    }
}
