//! `[box]`: what it may say, what it becomes, and all that can be wrong with it.

use glam::DVec3;
use motes::{Bounds, Side};

use crate::scenes::{SMALL, assert_report, load};

use Side::{Open, Periodic, Reflecting};

fn bounds(section: &str) -> Bounds {
    load(&format!("{SMALL}[box]\n{section}"), &[]).unwrap_or_else(|faults| panic!("{faults}")).bounds
}

#[test]
fn without_one_space_is_open() {
    let scene = load(SMALL, &[]).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(scene.bounds, Bounds::default());
    assert!(!scene.resolved.contains("[box]"));
}

#[test]
fn boxes() {
    let (size, low) = (DVec3::new(2.0, 3.0, 4.0), DVec3::new(-1.0, -2.5, 7.0));
    assert_eq!(bounds("size = [2, 3, 4]"), Bounds::new(DVec3::ZERO, size, Periodic));
    let reflecting = bounds("low = [-1, -2.5, 7]\nsize = [2, 3, 4]\nboundary = \"reflecting\"");
    assert_eq!(reflecting, Bounds::new(low, low + size, Reflecting));
    let flat = bounds("size = [2, 3, 0]");
    assert_eq!(flat, Bounds::new(DVec3::ZERO, size.with_z(0.0), Periodic));
    assert_eq!((flat.dimensions, flat.sides), (2, [Periodic, Periodic, Open]));
    let pipe = bounds("size = [2, 3, 0]\nx = \"open\"\ny = \"reflecting\"\ndimensions = 3");
    assert_eq!((pipe.dimensions, pipe.sides), (3, [Open, Reflecting, Open]));
    let sheet = bounds("size = [2, 3, 4]\nz = \"open\"\ndimensions = 2");
    assert_eq!((sheet.dimensions, sheet.sides), (2, [Periodic, Periodic, Open]));
    let one = bounds("size = [0, 0, 4]\nboundary = \"open\"\nz = \"periodic\"");
    assert_eq!((one.dimensions, one.sides), (3, [Open, Open, Periodic]));
}

#[test]
fn it_is_written_out_and_read_again() {
    let text = format!("{SMALL}[box]\nlow = [0.1, 0, 0]\nsize = [0.2, 3, 0]\ny = \"reflecting\"\n");
    let scene = load(&text, &["box.x=open"]).unwrap_or_else(|faults| panic!("{faults}"));
    let expected = "
[box]
size = [0.2, 3.0, 0.0]
low = [0.1, 0.0, 0.0]
boundary = \"periodic\"
x = \"open\"
y = \"reflecting\"
z = \"open\"
dimensions = 2
";
    assert!(scene.resolved.contains(expected), "{}", scene.resolved);
    let again = load(&scene.resolved, &[]).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(again.bounds, scene.bounds);
}

#[test]
fn no_size() {
    assert_report(
        &format!("{SMALL}[box]\nboundery = \"open\"\n"),
        &[],
        "error: [box] lacks `size`
  --> a.toml:6:1
   |
 6 | [box]
   | ^^^^^ add `size`, three numbers: the lengths of its sides [length]; the third may be 0: a flat box

error: unknown key `boundery` in [box]
  --> a.toml:7:1
   |
 7 | boundery = \"open\"
   | ^^^^^^^^ did you mean `boundary`?
   = known here: `x`, `y`, `z`, `dimensions`, `size`, `low`, `boundary`

a.toml: 2 errors",
    );
}

#[test]
fn sizes_that_are_none() {
    assert_report(
        &format!("{SMALL}[box]\nsize = [2, -3, 0]\nz = \"reflecting\"\n"),
        &[],
        "error: the box is -3 long along y, where it is periodic
  --> a.toml:7:12
   |
 7 | size = [2, -3, 0]
   |            ^^ a length above zero; or set y = \"open\"

error: the box is 0 long along z, where it is reflecting
  --> a.toml:7:16
   |
 7 | size = [2, -3, 0]
   |                ^ a length above zero; or set z = \"open\"

a.toml: 2 errors",
    );
    assert_report(
        &format!("{SMALL}[box]\nsize = [-2, 3, 4]\nx = \"open\"\n"),
        &[],
        "error: the box is -2 long along x, where it is open
  --> a.toml:7:9
   |
 7 | size = [-2, 3, 4]
   |         ^^ a length is zero or above

a.toml: 1 error",
    );
}

#[test]
fn words_and_dimensions_that_are_none() {
    assert_report(
        &format!("{SMALL}[box]\nsize = [2, 3, 4]\nboundary = \"peridic\"\nx = \"reflective\"\ny = 7\ndimensions = 4\n"),
        &[],
        "error: unknown boundary \"peridic\"
  --> a.toml:8:12
   |
 8 | boundary = \"peridic\"
   |            ^^^^^^^^^ did you mean \"periodic\"?
   = known: `open`, `periodic`, `reflecting`

error: unknown boundary \"reflective\"
  --> a.toml:9:5
   |
 9 | x = \"reflective\"
   |     ^^^^^^^^^^^^ did you mean \"reflecting\"?
   = known: `open`, `periodic`, `reflecting`

error: `y` must be one of `open`, `periodic`, `reflecting`, not 7
  --> a.toml:10:5
   |
10 | y = 7
   |     ^

error: `dimensions` must be 2 or 3, not 4
  --> a.toml:11:14
   |
11 | dimensions = 4
   |              ^

a.toml: 4 errors",
    );
}

#[test]
fn a_plane_that_is_closed_along_z() {
    assert_report(
        &format!("{SMALL}[box]\nsize = [2, 3, 4]\ndimensions = 2\n"),
        &[],
        "error: in 2 dimensions the box cannot be periodic along z: make it open along z, or set dimensions = 3
  --> a.toml:8:14
   |
 8 | dimensions = 2
   |              ^

a.toml: 1 error",
    );
}

#[test]
fn a_box_too_far_out_for_single_precision() {
    assert_report(
        &format!("{SMALL}[box]\nlow = [1e9, 0, 0]\nsize = [2, 3, 4]\n"),
        &[],
        "error: the box reaches along x from 1000000000.0 to 1000000002.0, and is periodic there: it must end above where it \
         begins, in single precision; or make it open along x
  --> a.toml:8:8
   |
 8 | size = [2, 3, 4]
   |        ^^^^^^^^^

a.toml: 1 error",
    );
}

#[test]
fn species() {
    let two = "[simulation]\ndt = 0.1\nsteps = 10\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\nspecies = 7\n\
               [[particles]]\nshape = \"lattice\"\nsize = [2, 1, 1]\n";
    let scene = load(two, &["particles.1.species=4294967295"]).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(scene.particles.species(), [7, u32::MAX, u32::MAX]);
    assert!(scene.resolved.contains("\nspecies = 7\n") && scene.resolved.contains("\nspecies = 4294967295\n"));
    assert_report(
        &two.replace("species = 7", "species = 4294967296\ncolor = 3"),
        &["particles.1.species=-1"],
        "error: `species` is too large
  --> a.toml:6:11
   |
 6 | species = 4294967296
   |           ^^^^^^^^^^ it may be at most 4294967295

error: `color` must be a colour such as \"#ffcc88\" or \"gold\", not 3
  --> a.toml:7:9
   |
 7 | color = 3
   |         ^

error: `species` must be a whole number, zero or above, not -1
  --> the command line
   |
   | --set particles.1.species=-1
   |                           ^^

a.toml: 3 errors",
    );
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("a.csv"), "x,y,z,species\n1,2,3,5\n4,5,6,0\n").expect("a file");
    let file = |entry: &str| {
        let text = format!("[simulation]\ndt = 0.1\nsteps = 10\n[[particles]]\nfile = \"a.csv\"\n{entry}");
        let source = motes::scene::Source::Text { name: "a.toml".to_owned(), text, folder: folder.path().to_owned() };
        let options = motes::scene::Options { allow_outside: true, ..Default::default() };
        motes::scene::Scene::load(&source, &[], &options).unwrap_or_else(|faults| panic!("{faults}"))
    };
    for (entry, species) in [("", [5, 0]), ("species = 3", [3, 3]), ("species = 0", [0, 0])] {
        let scene = file(entry);
        assert_eq!(scene.particles.species(), species, "{entry}");
        assert_eq!(scene.resolved.contains("\nspecies = "), !entry.is_empty(), "{entry}");
    }
}
