//! Scenes: what is good loads, and what is not is reported well.

#![allow(clippy::float_cmp, reason = "the bits are meant")]

mod bounds;
mod builtin;
mod files;
mod fuzz;
mod held;
mod keys;
mod link_files;
mod links;
mod missing;
mod molecules;
mod numbers;
mod overrides;
mod particles;
mod resolved;
mod solver;
mod syntax;
mod trees;
mod words;

use std::path::PathBuf;

use motes::scene::{Diagnostics, Options, Scene, Source};

/// A scene with nothing but what must be there.
pub(crate) const SMALL: &str =
    "[simulation]\ndt = 0.1\nsteps = 10\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\n";

/// Loads a text as `a.toml`.
pub(crate) fn load(text: &str, overrides: &[&str]) -> Result<Scene, Diagnostics> {
    let source =
        Source::Text { name: "a.toml".to_owned(), text: text.to_owned(), folder: PathBuf::from("tests/inputs/scenes") };
    let overrides: Vec<_> = overrides.iter().map(|&o| o.to_owned()).collect();
    Scene::load(&source, &overrides, &Options::default())
}

/// The report on a scene that is not good.
pub(crate) fn report(text: &str, overrides: &[&str]) -> Diagnostics {
    load(text, overrides).err().expect("the scene is at fault")
}

/// The whole report, letter by letter; `{forces}`, `{shapes}` and `{integrators}` stand for the names in those registers.
pub(crate) fn assert_report(text: &str, overrides: &[&str], expected: &str) {
    let names = |list: Vec<&str>| list.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    let forces = names(motes::forces::entries().map(|entry| entry.name).collect());
    let integrators = names(motes::integrators::INTEGRATORS.iter().map(|entry| entry.name).collect());
    let shapes = names(motes::shapes::SHAPES.iter().map(|shape| shape.name).collect());
    let expected = expected.replace("{shapes}", &shapes);
    let expected = expected.replace("{forces}", &forces).replace("{integrators}", &integrators);
    let report = report(text, overrides).to_string();
    assert!(report == expected, "expected:\n{expected}\n\nfound:\n{report}");
}

#[test]
fn all_faults_come_at_once_and_in_order() {
    let text = r#"
[simulation]
dt = "0.1"
steps = 0
integrator = "leapfrg"
[[particles]]
shape = "plummer"
count = 10
sede = 1
[[particles]]
file = "nowhere.csv"
[[force]]
kind = "gravity"
softening = -0.1
[output]
formats = ["png", "gif"]
[camera]
zoom = 2
"#;
    let report = report(text, &["output.every=often"]);
    let found: Vec<_> = report
        .list
        .iter()
        .map(|d| format!("{} {}", d.excerpt.as_ref().and_then(|e| e.position).map_or(0, |p| p.0), d.message))
        .collect();
    let expected = [
        "3 `dt` must be a number above zero, not the text \"0.1\"",
        "4 `steps` must be a whole number, one or above, not 0",
        "5 unknown integrator \"leapfrg\"",
        "9 unknown key `sede` in [[particles]] plummer",
        "11 there is no file nowhere.csv",
        "14 `softening` must be a number, zero or above, not -0.1",
        "16 unknown format \"gif\"",
        "17 unknown section `camera`",
        "0 `every` is not a valid interval of outputs",
    ];
    assert_eq!(found, expected);
    assert_eq!((report.total, report.exit_code()), (9, 3));
    assert!(report.to_string().ends_with("\n\na.toml: 9 errors"));
}

#[test]
fn a_thousand_faults_are_counted_and_a_hundred_shown() {
    let text = format!("{SMALL}[output]\n{}", (0..1000).fold(String::new(), |all, i| all + &format!("key{i} = 1\n")));
    let report = report(&text, &[]);
    assert_eq!((report.total, report.list.len()), (1000, 100));
    assert!(report.to_string().ends_with("a.toml: 1000 errors, the first 100 are shown"));
}

#[test]
fn a_long_line_is_shown_in_part() {
    let zeros = "0.0, ".repeat(100_000);
    let text = SMALL.replace("[0, 0, 0]", &format!("[{zeros}1, 2, 3]"))
        + &format!("[output]\nevery = [{zeros}\"x\", {zeros}]\n");
    let report = report(&text, &[]);
    assert_eq!(report.total, 2);
    for excerpt in report.list.iter().filter_map(|d| d.excerpt.as_ref()) {
        assert!(excerpt.text.chars().count() < 600, "{}", excerpt.text);
        assert!(excerpt.before + excerpt.under <= excerpt.text.chars().count() + 1);
    }
}
