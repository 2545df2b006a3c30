//! The example for Dask, where Dask is there: the merged table is that of one run. With GAITC_REQUIRE_DASK=1 it has to be there.

use crate::sweep::GRID;
use crate::{at, done};
use std::fs;
use std::process::Command;

#[test]
fn shards_on_a_local_cluster_give_the_table_of_one_run() {
    let python = std::env::var("GAITC_DASK_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let has_dask = Command::new(&python).args(["-c", "import dask.distributed"]).output();
    if !has_dask.is_ok_and(|output| output.status.success()) {
        let needed = std::env::var_os("GAITC_REQUIRE_DASK").is_some_and(|value| value == "1");
        assert!(
            !needed,
            "GAITC_REQUIRE_DASK=1, but `{python}` has no dask.distributed: run .ci/dask, or set GAITC_DASK_PYTHON"
        );
        println!("no dask.distributed here (`{python}`): this test was left out");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let [one, merged, shards] = ["one.csv", "merged.csv", "shards"].map(|name| at(folder.path(), name));
    done(&[&GRID[..], &["--out", &one]].concat());
    let mut script = Command::new(python);
    script.current_dir(env!("CARGO_MANIFEST_DIR")).arg("examples/dask/sweep.py");
    script.args(["--gaitc", env!("CARGO_BIN_EXE_gaitc"), "--shards", "3", "--workers", "2", "--dir", &shards]);
    let output = script.args(["--out", &merged, "--"]).args(GRID).args(["--chunk", "4"]).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(fs::read(&one).unwrap() == fs::read(&merged).unwrap());
}
