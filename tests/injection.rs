//! What is given on the command line is data: nothing of it is run, and none of it gets into another language.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use common::gaitc_in;
use std::fs;

/// What the values try to become: Python, Rust, a shell's command, TOML, another flag.
const VALUES: &[&str] = &[
    "__import__('os').system('touch owned')",
    "20 deg; import os; os.system('touch owned')",
    "exec(open('owned', 'w'))",
    "20 deg\"); std::fs::write(\"owned\", \"\"); (\"",
    "std::process::exit(0)",
    "{ panic!() }",
    "$(touch owned)",
    "`touch owned`",
    "20 deg | touch owned",
    "20 deg && touch owned",
    "@owned",
    "/dev/stdin",
    "20 deg\"\n[parameters]\nevil = \"1",
    "20 deg\nomega = 1",
    "{ value = \"20 deg\" }",
    "[20, 30]",
    "\"20 deg\"",
    "'20 deg'",
    "20 deg # comment",
    "20 deg --json",
    "${psi}",
    "{psi}",
    "%s%n",
    "\\u0032\\u0030 deg",
    "２０ deg",
    "20 d\u{0435}g",
    "20\u{200b} deg",
    "\u{202e}ged 02",
];

#[test]
fn quantities_on_the_command_line_are_data() {
    let folder = tempfile::tempdir().unwrap();
    let refuse = |args: &[&str]| {
        let output = gaitc_in(folder.path(), &[args, &["--json"]].concat());
        let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        assert_eq!(output.status.code(), Some(1), "{args:?}: {out}{err}");
        assert!(err.contains("error"), "{args:?}: {err}");
        let value: serde_json::Value = serde_json::from_str(&out).unwrap_or_else(|e| panic!("{args:?}: {e} in {out}"));
        assert_eq!(value["status"], "error", "{args:?}");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "{args:?} leaves a file");
    };
    for value in VALUES {
        let (psi, angle, range) = (format!("psi={value}"), format!("q_theta={value}"), format!("psi=1 deg..{value}"));
        refuse(&["gait", "prescribed_length", "--set", &psi]);
        refuse(&["gait", "prescribed_length", "--guess", &angle]);
        refuse(&["optimize", "prescribed_length", "--vary", &range]);
        refuse(&["optimize", "prescribed_length", "--maximize", value, "--vary", "psi=1..45 deg"]);
        refuse(&["optimize", "prescribed_length", "--subject-to", &format!("mean_power <= {value}")]);
        refuse(&["optimize", "prescribed_length", "--problem", value]);
        // As a name, and as a model.
        let name = format!("{value}=20 deg");
        refuse(&["gait", "prescribed_length", "--set", &name]);
        refuse(&["gait", value]);
    }
}
