//! `copies` of particles and of their links, joints and dihedrals: molecules, and all that can be wrong with them.

use glam::DVec3;
use motes::links::{Dihedral, Joint};

use crate::scenes::{assert_report, load};

const TWO: &str = "[simulation]
dt = 0.1
steps = 10
[box]
size = [9, 9, 9]
[[particles]]
bodies = [{ position = [0, 0, 0], species = 3 }, { position = [1, 0, 0] }, { position = [1, 1, 0] }, { position = [2, 1, 1] }]
species = 2
copies = 5
separation = 0.5
";

#[test]
fn links_of_a_molecule_are_copied_with_it() {
    let text = TWO.to_owned()
        + "[[links]]\npairs = [[0, 1], [2, 3]]\ncopies = 5\n[[links]]\njoints = [[0, 1, 2]]\nangle = 120\nstiffness = 3\ncopies = 5\nstride = 4\n\
           [[links]]\ndihedrals = [[0, 1, 2, 3]]\nmultiplicity = 2\nphase = 90\nstiffness = 2\ncopies = 4\n";
    let scene = load(&text, &[]).unwrap_or_else(|faults| panic!("{faults}"));
    let (particles, links) = (&scene.particles, &scene.particles.links);
    assert_eq!((particles.len(), links.springs.len()), (20, 10));
    assert_eq!(&particles.species()[12..], &[3, 2, 2, 2, 3, 2, 2, 2]);
    for (n, spring) in (0..).zip(&links.springs) {
        let first = 4 * (n / 2) + 2 * (n % 2);
        assert_eq!((spring.ends, spring.stiffness), ([first, first + 1], 1000.0));
        // All to the same bits, so that there are two kinds.
        assert_eq!(spring.rest, links.springs[n as usize % 2].rest);
        let [a, b] = spring.ends.map(|id| particles.position()[id as usize]);
        assert!((scene.bounds.shortest(b - a).length() - spring.rest).abs() < 1e-12);
    }
    for (n, joint) in (0..).zip(&links.joints) {
        let rest = std::f64::consts::FRAC_PI_3;
        assert!(
            joint.ids == [4 * n, 4 * n + 1, 4 * n + 2] && joint.stiffness == 3.0 && (joint.rest - rest).abs() < 1e-15
        );
    }
    let phase = std::f64::consts::FRAC_PI_2;
    let of = |n: u32| Dihedral { ids: [0, 1, 2, 3].map(|k| 4 * n + k), stiffness: 2.0, multiplicity: 2, phase };
    assert_eq!(links.dihedrals, [0, 1, 2, 3].map(of));
    // The resolved scene gives the same.
    let again = load(&scene.resolved, &[]).unwrap_or_else(|faults| panic!("{faults}\n{}", scene.resolved));
    assert!(again.particles == scene.particles, "{}", scene.resolved);
    // A term may have either sign; a joint, and a spring, may not.
    let signed = |kind: &str| {
        load(&(TWO.to_owned() + "[[links]]\nstiffness = -4\n" + kind), &[]).map(|scene| scene.particles.links)
    };
    assert_eq!(signed("dihedrals = [[0, 1, 2, 3]]\n").expect("a scene").dihedrals[0].stiffness, -4.0);
    for kind in ["pairs = [[0, 1]]\n", "joints = [[0, 1, 2]]\n"] {
        let fault = signed(kind).expect_err("refused").to_string();
        assert!(fault.contains("`stiffness` must be a number, zero or above, not -4"), "{fault}");
    }
    // The same twice, from either end, are one with twice the stiffness.
    for (kind, what) in [
        ("joints = [[0, 1, 2], [2, 1, 0]]", "joint 1 bends"),
        ("dihedrals = [[0, 1, 2, 3], [3, 2, 1, 0]]", "dihedral 1 is the same term"),
    ] {
        let fault = load(&format!("{TWO}[[links]]\n{kind}\n"), &[]).err().expect("refused").to_string();
        assert!(fault.contains(what) && fault.contains("add up their stiffness"), "{fault}");
    }
    // A mean velocity stays, whatever the temperature.
    let moving = TWO.replace("copies = 5", "copies = 5\nvelocity = [0, 7, 0]\ntemperature = 2");
    let particles = load(&moving, &[]).unwrap_or_else(|faults| panic!("{faults}")).particles;
    let mean = particles.velocity().iter().sum::<DVec3>() / 20.0;
    assert!((mean - 7.0 * DVec3::Y).length() < 1e-12, "{mean}");
    // Straight where no angle is given.
    let straight = load(&(TWO.to_owned() + "[[links]]\njoints = [[0, 1, 2]]\n"), &[]).expect("a scene").particles.links;
    assert_eq!(straight.joints, [Joint { ids: [0, 1, 2], stiffness: 1000.0, rest: 0.0 }]);
}

/// A room of its own about `center`, and the box where there is none.
#[test]
fn copies_lie_in_their_room() {
    let text = TWO
        .replace("copies = 5", "copies = 300\nroom = [2, 3, 0]\ncenter = [5, 1, 100]")
        .replace("separation = 0.5", "");
    let scene = load(&text, &[]).unwrap_or_else(|faults| panic!("{faults}"));
    let all = scene.particles.position().chunks(4);
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for middle in all.map(|x| x.iter().sum::<DVec3>() / 4.0) {
        (low, high) = (low.min(middle), high.max(middle));
    }
    // Without a room, the box is where they are, and has no other centre.
    let misplaced = TWO.replace("copies = 5", "copies = 5\ncenter = [5, 1, 100]");
    let fault = load(&misplaced, &[]).err().expect("refused").to_string();
    assert!(fault.contains("`center` has no effect on `copies` that fill the [box]"), "{fault}");
    // Of 300 the least is within 0.03 of the side, but for e⁻⁹.
    let (want_low, want_high) = (DVec3::new(4.0, -0.5, 0.0), DVec3::new(6.0, 2.5, 9.0));
    assert!(
        (low - want_low).min_element() >= 0.0 && ((low - want_low) / (want_high - want_low)).max_element() < 0.03,
        "{low}"
    );
    assert!(
        (want_high - high).min_element() >= 0.0 && ((want_high - high) / (want_high - want_low)).max_element() < 0.03,
        "{high}"
    );
}

#[test]
fn copies_that_are_wrong() {
    let with = |from: &str, to: &str| TWO.replace(from, to);
    assert_report(
        &with("copies = 5\n", ""),
        &[],
        r"error: `separation` has no effect without `copies`
  --> a.toml:9:1
   |
 9 | separation = 0.5
   | ^^^^^^^^^^ remove it, or add `copies`

a.toml: 1 error",
    );
    assert_report(
        &with("[box]\nsize = [9, 9, 9]\n", "").replace("copies = 5", "copies = 5\nroom = [1, 0, 1]"),
        &[],
        r"error: `copies` need `room`, and that along y is 0
  --> a.toml:8:8
   |
 8 | room = [1, 0, 1]
   |        ^^^^^^^^^ three edges above 0, as in [10, 10, 10], or a [box]

a.toml: 1 error",
    );
    assert_report(
        &with("separation = 0.5", "separation = 4"),
        &[],
        r#"error: copy 4 of 5 found no place with 4 to the particles of others, in 10000 attempts: choose fewer `copies`, a smaller `separation`, another `room`, or arrangement = "lattice"
  --> a.toml:9:10
   |
 9 | copies = 5
   |          ^

a.toml: 1 error"#,
    );
    assert_report(
        &(TWO.to_owned()
            + "[[links]]\npairs = [[0, 1]]\ncopies = 6\nstride = 4\nangle = 3\n[[links]]\njoints = [[0, 1], [0, 1, 0]]\ntie = \"rod\"\n[[links]]\npairs = [[0, 1]]\ntie = \"dihedral\"\n"),
        &[],
        r#"error: `angle` has no effect on `pairs`
  --> a.toml:15:1
   |
15 | angle = 3
   | ^^^^^ remove it

error: `joints` must be three ids, not a list of length 2
  --> a.toml:17:11
   |
17 | joints = [[0, 1], [0, 1, 0]]
   |           ^^^^^^

error: particle 0 is linked to itself
  --> a.toml:17:19
   |
17 | joints = [[0, 1], [0, 1, 0]]
   |                   ^^^^^^^^^

error: `tie` has no effect on `joints`
  --> a.toml:18:1
   |
18 | tie = "rod"
   | ^^^ remove it

error: a dihedral has 4 particles, and `pairs` have two
  --> a.toml:21:7
   |
21 | tie = "dihedral"
   |       ^^^^^^^^^^ list them in `dihedrals`, without `tie`

a.toml: 5 errors"#,
    );
    assert_report(
        &(TWO.to_owned()
            + "[[links]]\ndihedrals = [[0, 1, 2, 3]]\nmultiplicity = 13\n[[links]]\njoints = [[0, 1, 2]]\nangle = 181\n[[links]]\npairs = [[0, 1]]\ncopies = 6\nstride = 4\n"),
        &[],
        r"error: dihedral 0 has the multiplicity 13, and a turn has from 1 to 12 maxima
  --> a.toml:12:13
   |
12 | dihedrals = [[0, 1, 2, 3]]
   |             ^^^^^^^^^^^^^^

error: joint 0 has an angle of 181° at rest, and it is from 0° to 180° (straight)
  --> a.toml:15:10
   |
15 | joints = [[0, 1, 2]]
   |          ^^^^^^^^^^^

error: 6 copies, each 4 ids further, reach particle 21; there are 20, counted from 0
  --> a.toml:19:10
   |
19 | copies = 6
   |          ^ `copies` or `stride` is too large

a.toml: 3 errors",
    );
}

/// Particles that are wrong are reported, and not that their links have no ends.
#[test]
fn links_of_particles_that_are_wrong_are_not_reported() {
    assert_report(
        "[simulation]\ndt = 0.1\nsteps = 10\n[[particles]]\nbodies = [{ position = [0, 0] }]\n[[links]]\npairs = [[0, 1]]\n",
        &[],
        r"error: `position` must be three numbers, as in [0, 0, 1], not a list of length 2
  --> a.toml:5:24
   |
 5 | bodies = [{ position = [0, 0] }]
   |                        ^^^^^^

a.toml: 1 error",
    );
}
