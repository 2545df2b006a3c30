//! The gaitc command.

fn main() -> std::process::ExitCode {
    gaitc::cli::main()
}
