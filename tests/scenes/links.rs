//! `[[links]]`: what ties particles, and all that can be wrong with it.

use std::fs;

use motes::links::{Link, Rod};
use motes::scene::{Options, Scene, Source};

use crate::{assert_report, load};

/// Four particles: the first is 3 from the second, 4 from the third and 5 from the fourth; the links come behind line 9.
const FOUR: &str = "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [
  { position = [0, 0, 0] }, { position = [3, 0, 0] },
  { position = [0, 4, 0] }, { position = [0, 0, 5] },
]
[[links]]
";

fn tied(text: &str) -> motes::links::Links {
    load(&(FOUR.to_owned() + text), &[]).unwrap_or_else(|faults| panic!("{faults}")).particles.links
}

fn assert_faults(text: &str, expected: &str) {
    assert_report(&(FOUR.to_owned() + text), &[], expected);
}

#[test]
fn pairs_are_tied_at_their_distance() {
    let links = tied(
        "pairs = [[0, 1], [2, 0]]\nrest = 0.5\nstiffness = 7\ndamping = 0.25\n[[links]]\npairs = [[3, 0]]\ntie = \"rod\"\n",
    );
    let spring = |ends, rest| Link { ends, rest, stiffness: 7.0, damping: 0.25, rope: false };
    assert_eq!(links.springs, [spring([0, 1], 1.5), spring([2, 0], 2.0)]);
    assert_eq!(links.rods, [Rod { ends: [3, 0], length: 5.0 }]);
    let rope = tied("pairs = [[0, 1]]\ntie = \"rope\"\n").springs[0];
    assert_eq!(rope, Link { ends: [0, 1], rest: 3.0, stiffness: 1000.0, damping: 0.0, rope: true });
}

#[test]
fn pairs_that_are_none() {
    assert_faults("pairs = [[0, 4], [1, 1], [0, 1, 2], [2], 3, [-1, 2], [0.5, 1], [\"0\", 1]]\n", "");
    assert_faults("pairs = 3\n", "");
}

#[test]
fn pairs_twice() {
    assert_faults("pairs = [[0, 1], [1, 0]]\n", "");
    assert_faults("pairs = [[0, 1]]\n[[links]]\npairs = [[0, 1]]\n", "");
}

#[test]
fn a_spring_and_a_rod_may_share_their_ends() {
    let links = tied("pairs = [[0, 1]]\n[[links]]\npairs = [[0, 1]]\ntie = \"rod\"\n");
    assert_eq!((links.springs.len(), links.rods.len()), (1, 1));
}

#[test]
fn links_of_nothing_and_of_both() {
    assert_faults("stiffness = 3\n", "");
    assert_faults("file = \"a.csv\"\npairs = [[0, 1]]\n", "");
}

#[test]
fn values_that_make_no_sense() {
    assert_faults("pairs = [[0, 1]]\ntie = \"rood\"\nrest = -1\nstiffness = nan\nstifness = 4\n", "");
    assert_faults("pairs = [[0, 1]]\nstiffness = 0\n", "");
    assert_faults("pairs = [[0, 1]]\nrest = 0\ntie = \"rope\"\n", "");
}

/// A scene beside its file of links, loaded.
fn beside(csv: &str) -> Result<Scene, motes::scene::Diagnostics> {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("net.csv"), csv).expect("written");
    let text = FOUR.to_owned() + "file = \"net.csv\"\nstiffness = 30\n";
    let source = Source::Text { name: "scene.toml".to_owned(), text, folder: folder.path().to_owned() };
    Scene::load(&source, &[], &Options::default())
}

#[test]
fn a_file_says_what_it_wants_and_the_scene_the_rest() {
    let scene = beside("# a net\na,b,rest,tie,damping\n0,1,2.5,,\n1,2,,rope,0.5\n3,2,7,rod,\n")
        .unwrap_or_else(|f| panic!("{f}"));
    let links = scene.particles.links;
    let spring = Link { ends: [0, 1], rest: 2.5, stiffness: 30.0, damping: 0.0, rope: false };
    let rope = Link { ends: [1, 2], rest: 5.0, stiffness: 30.0, damping: 0.5, rope: true };
    assert_eq!(links.springs, [spring, rope]);
    assert_eq!(links.rods, [Rod { ends: [3, 2], length: 7.0 }]);
}

#[test]
fn a_bad_file_is_told_by_its_lines() {
    let faults = beside("a,b,rest\n0,1,1\n\n# a comment\n1,1,1\n0,9,1\n1,0,1\n2,x,-3\n").err().expect("faults");
    assert_eq!((faults.to_string().as_str(), faults.exit_code()), ("", 4));
    let faults = beside("").err().expect("faults");
    assert_eq!((faults.to_string().as_str(), faults.exit_code()), ("", 4));
}

#[test]
fn there_is_no_such_file() {
    assert_faults("file = \"nowhere.csv\"\n", "");
}

#[test]
fn the_resolved_scene_ties_the_same() {
    let text = "pairs = [[0, 1], [2, 0]]\nrest = 0.3\ntie = \"rope\"\ndamping = 0.1\n";
    let scene = load(&(FOUR.to_owned() + text), &[]).unwrap_or_else(|faults| panic!("{faults}"));
    let again = load(&scene.resolved, &[]).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(again.particles.links, scene.particles.links);
    assert!(!again.particles.links.springs.is_empty());
}
