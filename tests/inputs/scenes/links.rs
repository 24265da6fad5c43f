//! `[[links]]`: links, and all that can be wrong with it.

use motes::links::{Link, Rod};

use crate::scenes::{assert_report, load};

/// Four particles: the first is 3 from the second, 4 from the third and 5 from the fourth; the links come behind line 9.
pub(crate) const FOUR: &str = "[simulation]
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
    assert_faults(
        "pairs = [[0, 4], [1, 1], [0, 1, 2], [2], 3, [-1, 2], [0.5, 1], [\"0\", 1]]\n",
        r#"error: there is no particle 4
  --> a.toml:10:14
   |
10 | pairs = [[0, 4], [1, 1], [0, 1, 2], [2], 3, [-1, 2], [0.5, 1], ["0", 1]]
   |              ^ there are 4, counted from 0

error: particle 1 is linked to itself
  --> a.toml:10:18
   |
10 | pairs = [[0, 4], [1, 1], [0, 1, 2], [2], 3, [-1, 2], [0.5, 1], ["0", 1]]
   |                  ^^^^^^

error: `pairs` must be two ids, not a list of length 3
  --> a.toml:10:26
   |
10 | pairs = [[0, 4], [1, 1], [0, 1, 2], [2], 3, [-1, 2], [0.5, 1], ["0", 1]]
   |                          ^^^^^^^^^

error: `pairs` must be two ids, not a list of length 1
  --> a.toml:10:37
   |
10 | pairs = [[0, 4], [1, 1], [0, 1, 2], [2], 3, [-1, 2], [0.5, 1], ["0", 1]]
   |                                     ^^^

error: `pairs` must be a list of pairs of ids, as in [[0, 1], [1, 2]], not 3
  --> a.toml:10:42
   |
10 | pairs = [[0, 4], [1, 1], [0, 1, 2], [2], 3, [-1, 2], [0.5, 1], ["0", 1]]
   |                                          ^

error: `pairs` must be the id of a particle, not -1
  --> a.toml:10:46
   |
10 | pairs = [[0, 4], [1, 1], [0, 1, 2], [2], 3, [-1, 2], [0.5, 1], ["0", 1]]
   |                                              ^^

error: `pairs` must be the id of a particle, not 0.5
  --> a.toml:10:55
   |
10 | …s = [[0, 4], [1, 1], [0, 1, 2], [2], 3, [-1, 2], [0.5, 1], ["0", 1]]
   |                                                    ^^^

error: `pairs` must be the id of a particle, not the text "0"
  --> a.toml:10:65
   |
10 | …], [1, 1], [0, 1, 2], [2], 3, [-1, 2], [0.5, 1], ["0", 1]]
   |                                                    ^^^

a.toml: 8 errors"#,
    );
    assert_faults(
        "pairs = 3\n",
        "error: `pairs` must be a list of pairs of ids, as in [[0, 1], [1, 2]], not 3
  --> a.toml:10:9
   |
10 | pairs = 3
   |         ^

a.toml: 1 error",
    );
}

#[test]
fn pairs_twice() {
    assert_faults(
        "pairs = [[0, 1], [1, 0]]\n",
        "error: spring 1 connects particles 1 and 0, which another link connects already: merge them
  --> a.toml:10:9
   |
10 | pairs = [[0, 1], [1, 0]]
   |         ^^^^^^^^^^^^^^^^

a.toml: 1 error",
    );
    assert_faults(
        "pairs = [[0, 1]]\n[[links]]\npairs = [[0, 1]]\n",
        "error: spring 1 connects particles 0 and 1, which another link connects already: merge them
  --> a.toml:12:9
   |
12 | pairs = [[0, 1]]
   |         ^^^^^^^^

a.toml: 1 error",
    );
}

#[test]
fn a_spring_and_a_rod_may_share_their_ends() {
    let links = tied("pairs = [[0, 1]]\n[[links]]\npairs = [[0, 1]]\ntie = \"rod\"\n");
    assert_eq!((links.springs.len(), links.rods.len()), (1, 1));
}

#[test]
fn links_of_nothing_and_of_both() {
    assert_faults(
        "stiffness = 3\n",
        "error: [[links]] needs one of `file`, `pairs`, `joints`, `dihedrals`
  --> a.toml:9:1
   |
 9 | [[links]]
   | ^^^^^^^^^

a.toml: 1 error",
    );
    assert_faults(
        "file = \"a.csv\"\npairs = [[0, 1]]\n",
        "error: [[links]] has both `file` and `pairs`
  --> a.toml:11:1
   |
11 | pairs = [[0, 1]]
   | ^^^^^ remove one of them

a.toml: 1 error",
    );
}

#[test]
fn values_that_make_no_sense() {
    assert_faults(
        "pairs = [[0, 1]]\ntie = \"rood\"\nrest = -1\nstiffness = nan\nstifness = 4\n",
        r#"error: unknown tie "rood"
  --> a.toml:11:7
   |
11 | tie = "rood"
   |       ^^^^^^ did you mean "rod"?
   = known: `spring`, `rope`, `rod`, `joint`, `dihedral`

error: `rest` must be a number, zero or above, not -1
  --> a.toml:12:8
   |
12 | rest = -1
   |        ^^

error: `stiffness` must be finite, not nan
  --> a.toml:13:13
   |
13 | stiffness = nan
   |             ^^^

error: unknown key `stifness` in [[links]]
  --> a.toml:14:1
   |
14 | stifness = 4
   | ^^^^^^^^ did you mean `stiffness`?
   = known here: `file`, `pairs`, `joints`, `dihedrals`, `tie`, `rest`, `stiffness`, `damping`, `angle`, `multiplicity`, `phase`, `copies`, `stride`

a.toml: 4 errors"#,
    );
    assert_faults(
        "pairs = [[0, 1]]\nstiffness = 0\n",
        "error: spring 0 has neither stiffness nor damping, and has no effect: remove it
  --> a.toml:10:9
   |
10 | pairs = [[0, 1]]
   |         ^^^^^^^^

a.toml: 1 error",
    );
    assert_faults(
        "pairs = [[0, 1]]\nrest = 0\ntie = \"rope\"\n",
        "error: spring 0 is a rope of length 0, which is never slack: make it a spring
  --> a.toml:10:9
   |
10 | pairs = [[0, 1]]
   |         ^^^^^^^^

a.toml: 1 error",
    );
}

#[test]
fn there_is_no_such_file() {
    assert_faults(
        "file = \"nowhere.csv\"\n",
        r#"error: there is no file nowhere.csv
  --> a.toml:10:8
   |
10 | file = "nowhere.csv"
   |        ^^^^^^^^^^^^^
   = it is sought at tests/inputs/scenes/nowhere.csv

a.toml: 1 error"#,
    );
}

#[test]
fn the_resolved_scene_ties_the_same() {
    let text = "pairs = [[0, 1], [2, 0]]\nrest = 0.3\ntie = \"rope\"\ndamping = 0.1\n";
    let scene = load(&(FOUR.to_owned() + text), &[]).unwrap_or_else(|faults| panic!("{faults}"));
    let again = load(&scene.resolved, &[]).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(again.particles.links, scene.particles.links);
    assert!(!again.particles.links.springs.is_empty());
}
