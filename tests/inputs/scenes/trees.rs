//! Trees: angles, the laws they concern, and what is written back of them. Each text is what a user reads, whole.

use std::path::PathBuf;

use motes::forces::Over;
use motes::scene::{Options, Scene, Source};
use motes::tree::Opening;

use crate::scenes::resolved::assert_reloads;
use crate::scenes::{SMALL, assert_report, load};

/// A scene with gravity that says more.
fn gravity(more: &str) -> String {
    format!("{SMALL}[[force]]\nkind = \"gravity\"\n{more}\n")
}

/// A scene with a law of one's own, whose file is not looked for before its keys are.
fn own(over: &str, more: &str) -> String {
    format!("{SMALL}[[force]]\nover = \"{over}\"\n{more}wgsl = \"missing.rs\"\n")
}

#[test]
fn an_angle_beyond_one() {
    assert_report(
        &gravity("over = \"tree\"\ntheta = 1.5"),
        &[],
        "error: `theta` must be a number above zero, 1 at most, not 1.5
  --> a.toml:9:9
   |
 9 | theta = 1.5
   |         ^^^

a.toml: 1 error",
    );
}

#[test]
fn an_angle_of_zero() {
    assert_report(
        &gravity("over = \"tree\"\ntheta = 0"),
        &[],
        "error: `theta` must be a number above zero, 1 at most, not 0
  --> a.toml:9:9
   |
 9 | theta = 0
   |         ^

a.toml: 1 error",
    );
}

#[test]
fn angles_of_a_law_of_ones_own() {
    for (theta, carets) in [("1.5", "^^^"), ("0", "^"), ("-0.5", "^^^^")] {
        assert_report(
            &own("tree", &format!("theta = {theta}\n")),
            &[],
            &format!(
                "error: `theta` must be a number above zero, 1 at most, not {theta}\n  --> a.toml:8:9\n   |\n \
                 8 | theta = {theta}\n   |         {carets}\n\na.toml: 1 error"
            ),
        );
    }
}

/// One is the greatest there is, and the least is what single precision holds.
#[test]
fn the_angles_at_the_ends() {
    let theta = |text: &str| load(&gravity(&format!("over = \"tree\"\ntheta = {text}")), &[]);
    for (text, value) in [("1", 1.0), ("1e-3", 1e-3)] {
        let scene = theta(text).unwrap_or_else(|faults| panic!("{faults}"));
        let opening = Opening::Geometric { theta: value };
        assert_eq!(scene.forces[0].laws()[0].over, Over::Tree { opening, core: 0.0, auto: false });
    }
    assert!(theta("1.0000001").is_err() && theta("1e-60").is_err());
}

#[test]
fn a_law_over_a_tree_without_an_angle() {
    for over in ["tree", "auto"] {
        assert_report(
            &own(over, ""),
            &[],
            "error: [[force]] wgsl lacks `theta`
  --> a.toml:6:1
   |
 6 | [[force]]
   | ^^^^^^^^^ add `theta`, a number above zero, 1 at most: the opening angle, at most 1: a group of size l is approximated beyond the distance l / theta

a.toml: 1 error",
        );
    }
}

#[test]
fn an_angle_without_a_tree() {
    assert_report(
        &own("pairs", "theta = 0.5\n"),
        &[],
        "error: a law over \"pairs\" does not use `theta`
  --> a.toml:8:1
   |
 8 | theta = 0.5
   | ^^^^^ remove it, or change `over`

a.toml: 1 error",
    );
    assert_report(
        &own("auto", "theta = 0.5\nrange = 2\n"),
        &[],
        "error: a law over \"auto\" does not use `range`
  --> a.toml:9:1
   |
 9 | range = 2
   | ^^^^^ remove it, or change `over`

a.toml: 1 error",
    );
}

#[test]
fn trees_are_written_back() {
    let auto = |opening| Over::Tree { opening, core: 0.0, auto: true };
    let scene = load(&gravity("over = \"auto\"\ntheta = 0.3\nalpha = 0.005\ng = -2"), &[]);
    let scene = scene.unwrap_or_else(|faults| panic!("{faults}"));
    let relative = Opening::Relative { alpha: 0.005, g: 2.0, theta: 0.3 };
    assert_eq!(scene.forces[0].laws()[0].over, auto(relative));
    for line in ["over = \"auto\"", "theta = 0.3", "alpha = 0.005", "multipoles = \"quadrupole\""] {
        assert!(scene.resolved.contains(&format!("\n{line}\n")), "no {line} in\n{}", scene.resolved);
    }
    assert_reloads(&scene, ".");

    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("pull.wgsl"), "fn meet() {}").expect("a file");
    let text = own("auto", "theta = 0.4\n").replace("missing.rs", "pull.wgsl");
    let source = Source::Text { name: "a.toml".to_owned(), text, folder: PathBuf::from(folder.path()) };
    let scene = Scene::load(&source, &[], &Options::default()).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(scene.forces[0].laws()[0].over, auto(Opening::Geometric { theta: 0.4 }));
    assert!(scene.resolved.contains("\nover = \"auto\"\ntheta = 0.4\n"), "{}", scene.resolved);
    assert_reloads(&scene, &folder.path().to_string_lossy());
}
