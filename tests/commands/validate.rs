//! `motes validate`: every claim holds on this machine, none holds for its control, and what is written is what was measured.

use std::process::{Command, Stdio};

use serde_json::Value;

fn motes(args: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
    let output = command.arg("validate").args(args).stdin(Stdio::null()).output().expect("it starts");
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    (output.status.code().unwrap_or(-1), text(output.stdout), text(output.stderr))
}

/// The controls are the mutants of this test: a value of the scene is changed, and the number has to leave the limit.
#[test]
fn claims_hold_and_their_controls_do_not() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().to_str().expect("a path");
    let (code, out, err) = motes(&["--controls", "--json", "-o", path]);
    assert_eq!(code, 0, "{out}\n{err}");
    let value: Value = serde_json::from_str(&out).expect("a document");
    let claims = value["claims"].as_array().expect("a list");
    assert!(claims.len() >= 12 && value["good"] == true, "{out}");
    for claim in claims {
        let number = |key: &str| claim[key].as_f64().unwrap_or_else(|| panic!("{key}: {claim}"));
        let off = |key: &str| (number(key) - number("published")).abs() / number("tolerance");
        assert!(off("measured") <= 1.0 && off("control") > 1.0, "{claim}");
    }
    let file = std::fs::read_to_string(folder.path().join("validation.json")).expect("numbers");
    assert_eq!(serde_json::from_str::<Value>(&file).expect("a document"), value);
    let page = std::fs::read_to_string(folder.path().join("validation.md")).expect("a page");
    assert_eq!(page.lines().filter(|line| line.starts_with("| `")).count(), claims.len(), "{page}");
    // Results are not replaced without a word.
    let (code, _, err) = motes(&["ewald", "-o", path]);
    assert!(code == 8 && err.contains("--overwrite"), "{code}: {err}");
    let (code, _, err) = motes(&["ewald", "--overwrite", "-o", path]);
    assert_eq!(code, 0, "{err}");
}

/// Of the references, too: the exit code, and a claim by its family.
#[test]
fn claims_are_chosen_by_name_and_by_family() {
    let (code, out, err) = motes(&["grains", "ewald", "--backend", "cpu"]);
    assert!(code == 0 && out.contains("3 of 3 claims hold"), "{out}\n{err}");
    assert!(!out.contains("kepler") && out.contains("Tsuji"), "{out}");
    let (code, _, err) = motes(&["keplr"]);
    assert!(code == 3 && err.contains("no claim or family `keplr`") && err.contains("kepler"), "{code}: {err}");
    assert_eq!(motes(&["--list", "kepler"]).0, 2);
    let (code, list, _) = motes(&["--list"]);
    assert!(
        code == 0 && list.lines().count() >= 13 && list.contains("taylor_green") && list.contains("(with --all)"),
        "{list}"
    );
}
