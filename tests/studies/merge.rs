//! Shards become a table or a folder; what does not make a whole is said, and nothing is written then.

use crate::sweep::GRID;
use crate::{at, done, refused};
use sha2::{Digest as _, Sha256};
use std::fs::{self, File};
use std::path::Path;
use std::process::Command;

/// Six chunks, cut into so many shards as there are names.
fn shards(folder: &Path, names: &[&str]) -> Vec<String> {
    let shard = |(i, name): (usize, &&str)| {
        let (dir, shard) = (at(folder, name), format!("{}/{}", i + 1, names.len()));
        done(&[&GRID[..], &["--chunk", "4", "--dir", &dir, "--shard", &shard]].concat());
        dir
    };
    names.iter().enumerate().map(shard).collect()
}

fn copied(from: &Path, to: &Path) {
    fs::create_dir_all(to.join("chunks")).unwrap();
    for entry in fs::read_dir(from.join("chunks")).unwrap().map(Result::unwrap) {
        fs::copy(entry.path(), to.join("chunks").join(entry.file_name())).unwrap();
    }
    fs::copy(from.join("study.json"), to.join("study.json")).unwrap();
}

/// The folder is that of a study that was computed there: it can be gone on with, and merged.
#[test]
fn shards_become_a_folder() {
    let folder = tempfile::tempdir().unwrap();
    let [alone, whole, again] = ["alone", "whole", "again.csv"].map(|name| at(folder.path(), name));
    done(&[&GRID[..], &["--chunk", "4", "--dir", &alone]].concat());
    let tables = |dir: &str| ["sweep.csv", "sweep.parquet"].map(|table| fs::read(Path::new(dir).join(table)).unwrap());
    let shards = shards(folder.path(), &["one", "two"]);
    let merge = ["merge", &shards[1], &shards[0], "--dir", &whole];
    let text = done(&merge);
    assert!(text.contains("24 points from 2 folders") && text.contains("whole/sweep.csv"), "{text}");
    assert!(tables(&whole) == tables(&alone));
    let manifest = |dir: &str| fs::read(Path::new(dir).join("study.json")).unwrap();
    assert!(manifest(&whole) == manifest(&alone));
    // A merge that was killed goes on; so does the study.
    fs::remove_file(folder.path().join("whole/chunks/00000004.chunk")).unwrap();
    fs::remove_file(folder.path().join("whole/sweep.csv")).unwrap();
    done(&merge);
    assert!(tables(&whole) == tables(&alone));
    fs::remove_file(folder.path().join("whole/chunks/00000002.chunk")).unwrap();
    done(&[&GRID[..], &["--resume", "--dir", &whole]].concat());
    let text = done(&["merge", &whole, "--out", &again]);
    assert!(text.contains("24 points from 1 folder\n"), "{text}");
    assert!(fs::read(&again).unwrap() == tables(&alone)[0]);
}

#[test]
fn what_is_no_whole_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let shards = shards(folder.path(), &["one", "two", "three"]);
    let [one, two, three] = [&shards[0], &shards[1], &shards[2]].map(String::as_str);
    let [other, out] = ["other", "all.csv"].map(|name| at(folder.path(), name));
    done(&[&GRID[..], &["--chunk", "4", "--dir", &other, "--shard", "2/3", "--set", "l_s=0.1 m"]].concat());
    let refused = |folders: &[&str], expected: &[&str]| {
        refused(&[&["merge"], folders, &["--out", &out]].concat(), expected);
        assert!(!Path::new(&out).exists());
    };
    let absent = "4 of 6 chunks are missing: points 4 to 11, 16 to 23\n  shards 2/3, 3/3 are in none of the folders\n  help: name";
    refused(&[one], &[absent]);
    refused(&[one, three], &["2 of 6 chunks", "shard 2/3 is in none of the folders", "--shard 2/3"]);
    refused(&[one, &other, three], &["another study", "`set.l_s`"]);
    refused(&[one, &at(folder.path(), "none")], &["cannot read", "study.json"]);
    refused(&[one, two, three, &(one.to_owned() + "/../one/")], &["one` is given twice", "name each folder once"]);
    fs::remove_file(Path::new(two).join("chunks/00000004.chunk")).unwrap();
    let unfinished = "two` (shard 2/3) is not finished: it lacks 1 of its 2 chunks";
    refused(&[one, two, three], &["1 of 6 chunks is missing: points 16 to 19", unfinished, "--resume"]);
    refused(&[two, one], &[unfinished, "shard 3/3 is in none of the folders", "--resume; name"]);
    let lock = File::open(Path::new(two).join("lock")).unwrap();
    lock.try_lock().unwrap();
    refused(&[one, two, three], &["lacks 1 of its 2 chunks; a run is at work in it"]);
}

/// A shard that was computed twice is no harm, as long as both are the same.
#[test]
fn a_shard_may_stand_in_two_folders_that_agree() {
    let folder = tempfile::tempdir().unwrap();
    let shards = shards(folder.path(), &["one", "two"]);
    let (copy, out) = (folder.path().join("copy"), at(folder.path(), "all.csv"));
    copied(Path::new(&shards[1]), &copy);
    // What one lacks the other has.
    fs::remove_file(Path::new(&shards[1]).join("chunks/00000003.chunk")).unwrap();
    fs::remove_file(copy.join("chunks/00000005.chunk")).unwrap();
    let merge = ["merge", &shards[0], &shards[1], copy.to_str().unwrap(), "--out", &out];
    let text = done(&merge);
    assert!(text.contains("warning: shard 2/2 is given twice"), "{text}");
    fs::remove_file(&out).unwrap();
    // Another last bit, with the checksum that belongs to it.
    let chunk = copy.join("chunks/00000001.chunk");
    let mut bytes = fs::read(&chunk).unwrap();
    let body = bytes.len() - 32;
    bytes[body - 8] ^= 1;
    let hash = Sha256::digest(&bytes[..body]);
    bytes[body..].copy_from_slice(&hash);
    fs::write(&chunk, bytes).unwrap();
    refused(&merge, &["two`", "copy` both have points 4 to 7, and do not agree", "name only one"]);
    assert!(!Path::new(&out).exists());
}

/// What is read is not written to.
#[test]
fn nothing_is_written_into_a_folder_that_is_merged() {
    let folder = tempfile::tempdir().unwrap();
    let dir = at(folder.path(), "one");
    done(&["sweep", "prescribed_length", "--over", "psi=20 deg", "--dir", &dir]);
    let files = || {
        let mut names: Vec<_> = fs::read_dir(&dir).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        names
    };
    let before = files();
    for place in [["--out", "one/all.csv"], ["--dir", "one"], ["--dir", "one/../one/whole"], ["--out", "one/sweep.csv"]]
    {
        let mut command = Command::new(env!("CARGO_BIN_EXE_gaitc"));
        let output = command.current_dir(&folder).args(["merge", "one"]).args(place).output().unwrap();
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{errors}");
        assert!(errors.contains("whose chunks are merged") && errors.contains("help: "), "{errors}");
        assert_eq!(files(), before);
    }
    refused(&["merge", &dir], &["--out"]);
    let text = done(&["merge", &dir, "--dir", &at(folder.path(), "whole")]);
    assert!(text.contains("1 point from 1 folder\n"), "{text}");
}
