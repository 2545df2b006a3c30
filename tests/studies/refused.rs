//! What a study refuses, and that it harms nothing then.

use crate::common::gaitc;
use crate::sweep::GRID;
use crate::{at, done, refused};
use std::fs::{self, File};

#[test]
fn a_folder_that_is_in_use_or_holds_something_else_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let dir = at(folder.path(), "study");
    let study = [&GRID[..], &["--dir", &dir]].concat();
    done(&study);
    let before = fs::read(folder.path().join("study/sweep.csv")).unwrap();
    refused(&study, &["holds a study already", "--resume"]);
    let resume = [&study[..], &["--resume"]].concat();
    // Another process at work, as this test: the file says who, the lock is what counts.
    let lock = File::options().read(true).write(true).open(folder.path().join("study/lock")).unwrap();
    lock.try_lock().unwrap();
    refused(&resume, &["another run is at work", "process "]);
    refused(&study, &["another run is at work"]);
    drop(lock);
    done(&resume);
    let other = |flags: &[&str], expected: &[&str]| {
        let mut args = vec!["sweep", "prescribed_length", "--dir", &dir, "--resume"];
        args.extend(flags);
        refused(&args, &[&["another study"], expected].concat());
    };
    other(&["--over", "psi=5..40 deg:13", "--over", "omega=15, 20 rad/s"], &["`over`", "psi=5..40 deg:12"]);
    other(&[&GRID[2..], &["--set", "l_s=0.1 m"]].concat(), &["`set.l_s`", "13 cm", "10 cm"]);
    other(&[&GRID[2..], &["--tol", "1e-9"]].concat(), &["`tol` is nothing there", "1e-9"]);
    other(&[&GRID[2..], &["--chunk", "3"]].concat(), &["`chunk`", "100", "3"]);
    other(&[&GRID[2..], &["--shard", "1/2"]].concat(), &["shard 1/1 there, 1/2 here"]);
    assert!(before == fs::read(folder.path().join("study/sweep.csv")).unwrap());
    // Something else, in which nothing is made.
    let foreign = at(folder.path(), "foreign");
    fs::create_dir(&foreign).unwrap();
    fs::write(folder.path().join("foreign/thesis.tex"), "precious").unwrap();
    for flags in [&[][..], &["--resume"]] {
        refused(&[&GRID[..], &["--dir", &foreign], flags].concat(), &["not empty", "holds no study"]);
    }
    assert_eq!(fs::read_dir(&foreign).unwrap().count(), 1);
    // A manifest that somebody edited: what differs is said, not all that there is.
    let manifest = fs::read_to_string(folder.path().join("study/study.json")).unwrap();
    let edited = manifest.replace("\"name\": \"psi\"", "\"name\": \"chi\"");
    fs::write(folder.path().join("study/study.json"), edited).unwrap();
    refused(&resume, &["another study: `columns.chi.name` is \"chi\" there, \"psi\" here\n"]);
    fs::write(folder.path().join("study/study.json"), "{}").unwrap();
    refused(&resume, &["study.json", "damaged"]);
}

/// Links in the folder are neither followed nor replaced.
#[cfg(unix)]
#[test]
fn nothing_outside_the_folder_is_written() {
    use std::os::unix::fs::symlink;
    for (place, is_folder) in [
        ("sweep.csv", false),
        ("chunks/00000000.chunk", false),
        ("lock", false),
        ("study.json", false),
        ("chunks", true),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let (dir, outside) = (at(folder.path(), "study"), folder.path().join("outside"));
        done(&[&GRID[..], &["--dir", &dir]].concat());
        let inside = folder.path().join("study").join(place);
        if is_folder {
            fs::remove_dir_all(&inside).unwrap();
            fs::create_dir(&outside).unwrap();
        } else {
            fs::remove_file(&inside).unwrap();
            fs::write(&outside, "precious").unwrap();
        }
        symlink(&outside, &inside).unwrap();
        refused(&[&GRID[..], &["--resume", "--dir", &dir]].concat(), &["is a link or a folder", place]);
        assert!(fs::symlink_metadata(&inside).unwrap().is_symlink());
        if is_folder {
            assert_eq!(fs::read_dir(&outside).unwrap().count(), 0);
        } else {
            assert_eq!(fs::read_to_string(&outside).unwrap(), "precious");
        }
    }
}

#[test]
fn what_cannot_be_written_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let file = at(folder.path(), "file");
    fs::write(&file, "").unwrap();
    refused(&[&GRID[..], &["--dir", &(file.clone() + "/study")]].concat(), &["cannot write", "help:"]);
    refused(&[&GRID[..], &["--out", &(file + "/table.csv")]].concat(), &["--out: cannot write"]);
    #[cfg(target_os = "linux")]
    {
        // A full disk: said, with the summary all the same.
        let full = at(folder.path(), "full.csv");
        std::os::unix::fs::symlink("/dev/full", &full).unwrap();
        let output = gaitc(&[&GRID[..], &["--out", &full]].concat());
        let errors = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(1) && errors.contains("No space left"), "{errors}");
        assert!(String::from_utf8(output.stdout).unwrap().contains("24 with a gait"));
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        let dir = folder.path().join("readable");
        fs::create_dir(&dir).unwrap();
        fs::set_permissions(&dir, fs::Permissions::from_mode(0o500)).unwrap();
        // Whoever may do everything writes there, too.
        if File::create(dir.join("probe")).is_err() {
            refused(&[&GRID[..], &["--dir", dir.to_str().unwrap()]].concat(), &["cannot write", "Permission denied"]);
        }
        fs::set_permissions(&dir, fs::Permissions::from_mode(0o700)).unwrap();
    }
}

#[test]
fn wrong_input_is_explained() {
    let sweep =
        |flags: &[&str], expected: &[&str]| refused(&[&["sweep", "prescribed_length"], flags].concat(), expected);
    sweep(&["--over", "psi=1..45 deg"], &["how many values", ":11"]);
    sweep(&["--over", "psi=1..45 deg:"], &["this is no number of values"]);
    sweep(&["--over", "psi=1..45 deg:0"], &["this is no number of values"]);
    sweep(&["--over", "psi=1..45 deg:-3"], &["this is no number of values"]);
    sweep(&["--over", "psi=1..45 deg:1"], &["one value cannot cover a range"]);
    sweep(&["--over", "psi=5..5 deg:3"], &["both ends of the range are the same"]);
    sweep(&["--over", "psi=45..1 deg:3"], &["above the upper one"]);
    sweep(&["--over", "psi=1..45 kg:3"], &["kg"]);
    sweep(&["--over", "omega=15, 20 m"], &["not m"]);
    sweep(&["--over", "omega=15,, 20 rad/s"], &["missing"]);
    sweep(&["--over", "phi=1..45 deg:3"], &["no parameter is named `phi`"]);
    sweep(&["--over", "psi=1..45 deg:3", "--over", "psi=1, 2 deg"], &["given twice"]);
    sweep(&["--over", "psi=1..45 deg:3", "--sobol", "10"], &["leave away what stands behind `:`"]);
    sweep(&["--over", "psi=1, 2 deg", "--sobol", "10"], &["needs a range"]);
    sweep(&["--over", "psi=1..45 deg", "--sobol", "0"], &["--sobol 0"]);
    sweep(&["--over", "psi=1..45 deg:3", "--seed", "1"], &["--sobol"]);
    sweep(
        &["--over", "psi=1..45 deg:100000", "--over", "omega=15..25 rad/s:10000"],
        &["100000 x 10000", "278 hours", "8.00 GB"],
    );
    sweep(&["--over", "psi=1..45 deg:200000"], &["too many to lose", "--dir"]);
    sweep(&["--over", "psi=1..45 deg:18446744073709551615", "--over", "omega=1..2 rad/s:9"], &["too many"]);
    sweep(&["--over", "psi=1..45 deg:3", "--optimize", "nothing"], &["no problem is named `nothing`"]);
    sweep(&["--over", "psi=1..45 deg:3", "--out", "table.txt"], &["`.csv` or `.parquet`"]);
    sweep(&["--over", "psi=1..45 deg:3", "--resume"], &["--dir"]);
    sweep(&["--over", "psi=1..45 deg:3", "--dir", "x", "--shard", "3/2"], &["I from 1 to N"]);
    sweep(&["--over", "psi=1..45 deg:3", "--dir", "x", "--shard", "1/2", "--out", "a.csv"], &["--out"]);
    sweep(&["--over", "psi=1..45 deg:3", "--threads", "0"], &["--threads 0"]);
    sweep(&["--over", "psi=1..45 deg:3", "--dir", "x", "--chunk", "0"], &["--chunk 0"]);
    let basin =
        |flags: &[&str], expected: &[&str]| refused(&[&["basin", "prescribed_length"], flags].concat(), expected);
    basin(&["--over", "psi=1..45 deg:3"], &["no section coordinate is named `psi`", "q_theta"]);
    basin(&["--over", "q_theta=-1..0 m:3"], &["m"]);
    basin(&["--over", "q_theta=-1..0 rad:3", "--guess", "q_theta=1 deg"], &["takes the values of --over"]);
    basin(&["--over", "q_theta=-1..0 rad:3", "--steps", "0"], &["--steps 0"]);
    basin(&["--over", "q_theta=-1..0 rad:3", "--periods", "0"], &["--periods 0"]);
    assert!(!std::path::Path::new("x").exists());
}
