//! What is refused before anything is lost, and what is not taken for something else.

use std::path::Path;

use motes::run::Checkpoint;

use crate::checkpoints::faults::{KEEP, stopped};
use crate::checkpoints::{Place, SCENE, all, difference, motes, said};

/// A run that cannot have a checkpoint is not begun anew by a word that says that it continues.
#[test]
fn results_without_a_checkpoint_are_removed_only_with_a_word() {
    let scene = SCENE.replace("7 steps", "never");
    let place = Place::with(&[("a.toml", &scene)]);
    assert_eq!(place.run("a.toml", "out", &["--max-hours", "1e-9"]).0, 75);
    std::fs::remove_file(&place.checkpoints("out")[0]).expect("removed");
    let before = all(&place.at("out"));
    let (code, words) = place.run("a.toml", "out", &["--resume"]);
    assert!(code == 8 && words.contains("--overwrite") && words.contains("never"), "{code} {words}");
    assert!(all(&place.at("out")) == before, "a refusal changes nothing");
    assert_eq!(place.run("a.toml", "out", &["--overwrite"]).0, 0);
}

#[test]
fn a_comment_of_a_scene_makes_no_run_complete() {
    let place = Place::with(&[("a.toml", &format!("# Complete at step 7\n{SCENE}"))]);
    assert_eq!(place.run("a.toml", "whole", &KEEP).0, 0);
    stopped(&place, "out");
    let (code, words) = place.resume("out", &[]);
    assert!(code == 0 && words.contains("resumes from"), "{code} {words}");
    assert_eq!(difference(&place.at("out"), &place.at("whole")), None);
    let (code, words) = place.resume("out", &[]);
    assert!(code == 0 && words.contains("is complete, with step 40"), "{code} {words}");
}

/// Names that other systems take for ways through folders; and the scene that is left names files that are there.
#[cfg(unix)]
#[test]
fn files_of_any_name_are_packed_and_the_scene_stays_as_it_was_signed() {
    let scene = SCENE.replace("bodies = [", "file = 'a:b\\c.csv' # ");
    let place = Place::with(&[("a.toml", &scene), ("a:b\\c.csv", "x,y,z\n1,2,3\n2,1,0\n")]);
    assert_eq!(place.run("a.toml", "whole", &KEEP).0, 0);
    stopped(&place, "out");
    let (code, words) = place.resume("out", &[]);
    assert_eq!(code, 0, "{words}");
    assert_eq!(difference(&place.at("out"), &place.at("whole")), None);
    let (code, words) = place.run("a.toml", "out", &[&["--resume"], &KEEP[..]].concat());
    assert!(code == 0 && words.contains("is complete, with step 40"), "{code} {words}");
}

/// A fault of the machine says nothing of a checkpoint.
#[cfg(unix)]
#[test]
fn what_cannot_be_read_is_not_taken_for_damage() {
    let place = Place::with(&[("a.toml", SCENE)]);
    stopped(&place, "out");
    let before = all(&place.at("out"));
    let mut command = motes(&["resume", &place.path("out"), "--backend", "cpu"]);
    let (code, words) = said(command.env("TMPDIR", place.at("nowhere")));
    assert!(code == 4 && words.contains("temporary folder") && !words.contains("is intact"), "{code} {words}");
    assert!(all(&place.at("out")) == before);
    let newer = place.at("out").join("checkpoint_0000000039.npz");
    std::os::unix::fs::symlink(place.at("nowhere"), &newer).expect("a link");
    let (code, words) = place.resume("out", &[]);
    assert!(code == 4 && words.contains("0000000039") && words.contains("cannot be read"), "{code} {words}");
    std::fs::remove_file(&newer).expect("still there");
    assert!(all(&place.at("out")) == before);
}

/// A damaged checkpoint stays until the run is complete, and crowds out none that is whole.
#[test]
fn a_checkpoint_that_was_passed_over_stays() {
    let place = Place::with(&[("a.toml", SCENE)]);
    stopped(&place, "out");
    let newer = place.at("out").join("checkpoint_0000000039.npz");
    std::fs::write(&newer, "torn").expect("written");
    for _ in 0..2 {
        let (code, words) = place.resume("out", &["--max-hours", "1e-9"]);
        assert!(code == 75 && words.contains("is damaged"), "{code} {words}");
        assert!(newer.exists() && place.checkpoints("out").len() == 2);
    }
    assert_eq!(place.resume("out", &[]).0, 0);
    assert!(place.checkpoints("out").is_empty());
}

/// An archive whose list has one entry again and again would be read so often.
#[test]
fn an_entry_that_is_listed_twice_is_damage() {
    let place = Place::with(&[("a.toml", SCENE)]);
    stopped(&place, "out");
    let file = place.checkpoints("out").remove(0);
    let good = std::fs::read(&file).expect("read");
    let end = good.len() - 22;
    let word = |at: usize| u32::from_le_bytes(good[at..at + 4].try_into().expect("four bytes")) as usize;
    let (count, list) = (good[end + 8], word(end + 16));
    let long = 46 + usize::from(good[list + 28]) + usize::from(good[list + 30]);
    let mut bad = [&good[..end], &good[list..list + long], &good[end..]].concat();
    bad[end + long + 8] = count + 1;
    bad[end + long + 10] = count + 1;
    let size = u32::try_from(end + long - list).expect("a small file").to_le_bytes();
    bad[end + long + 12..end + long + 16].copy_from_slice(&size);
    let torn = |bytes: &[u8]| {
        std::fs::write(&file, bytes).expect("written");
        Checkpoint::read(Path::new(&file)).err().map(|error| error.to_string())
    };
    assert_eq!(torn(&good), None);
    let why = torn(&bad).expect("an error");
    assert!(why.contains("is not an entry of a checkpoint"), "{why}");
}

/// The checksum of archives.
fn checksum(bytes: &[u8]) -> u32 {
    let turn = |sum: u32| if sum & 1 == 1 { sum >> 1 ^ 0xedb8_8320 } else { sum >> 1 };
    !bytes.iter().fold(u32::MAX, |sum, byte| (0..8).fold(sum ^ u32::from(*byte), |sum, _| turn(sum)))
}

/// The same archive with other words of the same length in `run.toml`, its last entry.
fn said_otherwise(good: &[u8], from: &str, to: &str) -> Vec<u8> {
    let (mut bytes, name) = (good.to_vec(), b"run/run.toml");
    let places: Vec<_> =
        good.windows(name.len()).enumerate().filter(|(_, part)| part == name).map(|(at, _)| at).collect();
    let [local, listed] = places[..] else { panic!("{places:?}") };
    let size = u32::from_le_bytes(good[listed - 22..listed - 18].try_into().expect("four bytes")) as usize;
    let begin = local + name.len() + usize::from(good[local - 2]);
    let text = std::str::from_utf8(&good[begin..begin + size]).expect("words");
    assert!(text.matches(from).count() == 1 && from.len() == to.len(), "{from} {to} {text}");
    let text = text.replace(from, to).into_bytes();
    for at in [local - 16, listed - 30] {
        assert_eq!(bytes[at..at + 4], checksum(&good[begin..begin + size]).to_le_bytes());
        bytes[at..at + 4].copy_from_slice(&checksum(&text).to_le_bytes());
    }
    bytes[begin..begin + size].copy_from_slice(&text);
    bytes
}

/// Numbers that do not fit are refused before a table is cut or a result removed.
#[test]
fn numbers_that_do_not_fit_are_refused_and_nothing_is_touched() {
    let place = Place::with(&[("a.toml", SCENE)]);
    stopped(&place, "out");
    let file = place.checkpoints("out").remove(0);
    let good = std::fs::read(&file).expect("read");
    let step: u64 = file.to_str().and_then(|name| name[name.len() - 14..name.len() - 4].parse().ok()).expect("a step");
    let done = format!("\ndone = {step}\n");
    let cases = [
        ("\nbegun = 0\n", "\nbegan = 0\n".to_owned(), "`begun` is missing"),
        (&*done, "\ndone = 40\n".to_owned(), "of 40"),
        (&*done, "\ndone = 99\n".to_owned(), "of 40"),
        (&*done, "\ndone = 39\n".to_owned(), "steps are done at step"),
        ("\nfilm_done = ", "\nfilm_done =9".to_owned(), "no part of a film of 6"),
    ];
    for (from, to, what) in cases {
        std::fs::write(&file, said_otherwise(&good, from, &to)).expect("written");
        let before = all(&place.at("out"));
        let (code, words) = place.resume("out", &[]);
        assert!(code == 4 && words.contains(what), "{to}: {code} {words}");
        assert!(all(&place.at("out")) == before, "{to}");
    }
}

#[test]
fn an_interval_far_below_a_step_is_a_fault() {
    let place = Place::with(&[("a.toml", &SCENE.replace("7 steps", "1e-300 time"))]);
    let (code, words) = place.run("a.toml", "out", &[]);
    assert!(code == 3 && words.contains("far below a step") && words.contains("every"), "{code} {words}");
}
