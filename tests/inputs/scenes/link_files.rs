//! `[[links]]` from files: what they may leave to the scene, and the lines of all that is wrong with them.

use std::fs;

use motes::links::{Link, Rod};
use motes::scene::{Diagnostics, Options, Scene, Source};

use crate::scenes::links::FOUR;

/// A scene beside its file of links, loaded; or its faults, without the folder's name, and their exit code.
fn beside(csv: &str) -> Result<Scene, (u8, String)> {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("net.csv"), csv).expect("written");
    let text = FOUR.to_owned() + "file = \"net.csv\"\nstiffness = 30\n";
    let source = Source::Text { name: "scene.toml".to_owned(), text, folder: folder.path().to_owned() };
    let text = |faults: Diagnostics| faults.to_string().replace(folder.path().to_str().expect("a path of words"), "");
    Scene::load(&source, &[], &Options::default()).map_err(|faults| (faults.exit_code(), text(faults)))
}

#[test]
fn a_file_says_what_it_wants_and_the_scene_the_rest() {
    let scene = beside("# a net\na,b,rest,tie,damping\n0,1,2.5,,\n1,2,,rope,0.5\n3,2,7,rod,\n")
        .unwrap_or_else(|(_, f)| panic!("{f}"));
    let links = scene.particles.links;
    let spring = Link { ends: [0, 1], rest: 2.5, stiffness: 30.0, damping: 0.0, rope: false };
    let rope = Link { ends: [1, 2], rest: 5.0, stiffness: 30.0, damping: 0.5, rope: true };
    assert_eq!(links.springs, [spring, rope]);
    assert_eq!(links.rods, [Rod { ends: [3, 2], length: 7.0 }]);
}

#[track_caller]
fn assert_reports(csv: &str, expected: &str) {
    let (code, found) = beside(csv).err().expect("faults");
    assert!(code == 4 && found == expected, "expected:\n{expected}\n\nfound:\n{found}");
}

#[test]
fn faults_of_a_file_name_its_lines() {
    assert_reports(
        "a,b,rest\n0,1,1\n\n# a comment\n1,1,1\n0,9,1\n1,0,1\n2,x,-3\n0,3,1,5\n",
        r#"error: /net.csv: 
  line 5: particle 1 is linked to itself
  line 6, column b: there is no particle 9; there are 4, from 0 on
  line 7: particles 1 and 0 are linked again, after line 2: remove one of the two
  line 8, column b: `x` is not the id of a particle
  line 8, column rest: -3 is not a finite number, zero or above
  line 9: 4 cells, but 3 columns
  --> scene.toml:10:8
   |
10 | file = "net.csv"
   |        ^^^^^^^^^

scene.toml: 1 error"#,
    );
    assert_reports(
        "",
        r#"error: /net.csv: is empty; its first line must name the columns, such as a,b,rest,stiffness,damping
  --> scene.toml:10:8
   |
10 | file = "net.csv"
   |        ^^^^^^^^^

scene.toml: 1 error"#,
    );
    assert_reports(
        "a,rest,wight\n0,1,2\n",
        r#"error: /net.csv: 
  unknown column `wight`; known are a, b, c, d, rest, stiffness, damping, tie, angle, multiplicity, phase
  the column `b` is missing; the first line must name a and b
  --> scene.toml:10:8
   |
10 | file = "net.csv"
   |        ^^^^^^^^^

scene.toml: 1 error"#,
    );
    assert_reports(
        "a,b\n0\n",
        r#"error: /net.csv: line 2, column b: the cell is missing
  --> scene.toml:10:8
   |
10 | file = "net.csv"
   |        ^^^^^^^^^

scene.toml: 1 error"#,
    );
}
