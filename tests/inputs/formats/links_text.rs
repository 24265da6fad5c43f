//! Links as text: what was written reads back, what may be left out, and all that can be wrong with it.

use glam::DVec3;
use motes::error::Error;
use motes::formats::Input;
use motes::formats::links::{self, Tie, Usual};
use motes::links::{Dihedral, Joint, Link, Links, Rod};
use proptest::prelude::*;

use crate::formats::{folder, put};

/// Other values than those that tests write.
const USUAL: Usual =
    Usual { tie: Tie::Rope, rest: 0.5, stiffness: 30.0, damping: 0.7, angle: 120.0, multiplicity: 2, phase: 30.0 };

/// Nine in a row, 2 apart.
fn places() -> Vec<DVec3> {
    (0..9).map(|i| DVec3::X * 2.0 * f64::from(i)).collect()
}

fn read(text: impl AsRef<[u8]>) -> Result<Links, Error> {
    let folder = folder();
    links::read(&Input::disk(&put(&folder, "net.csv", text)), &places(), &motes::Bounds::default(), &USUAL)
}

fn written(links: &Links) -> Vec<u8> {
    let mut bytes = Vec::new();
    links::write(&mut bytes, links).expect("memory");
    bytes
}

/// The lines of the error that a text must give.
#[track_caller]
fn faults(text: impl AsRef<[u8]>) -> Vec<String> {
    match read(text) {
        Err(Error::Input { message, .. }) => message.trim_start().lines().map(|l| l.trim().to_owned()).collect(),
        other => panic!("{other:?} is no Error::Input"),
    }
}

fn some() -> Links {
    let spring = |ends, rest, damping, rope| Link { ends, rest, stiffness: 0.1, damping, rope };
    Links {
        springs: vec![spring([3, 0], 1.5, 0.0, false), spring([1, 8], 1.5e-37, 1e38, true)],
        rods: vec![Rod { ends: [0, 3], length: 1.0 / 3.0 }],
        ..Links::default()
    }
}

#[test]
fn the_text_itself() {
    let text = String::from_utf8(written(&some())).expect("text");
    let expected = "a,b,rest,stiffness,damping,tie\n3,0,1.5,0.1,0.0,spring\n1,8,1.5e-37,0.1,1e38,rope\n0,3,0.3333333333333333,,,rod\n";
    assert_eq!(text, expected);
    assert_eq!(read(text).expect("links"), some());
}

#[test]
fn what_may_be_left_out() {
    // Columns in any order, comments, blank lines and blank cells; a row may be shorter than its header.
    let links =
        read("# a net\n b , a,tie,rest\n1,0\n\n2,1,spring\n# more\n4,2,,3\n8,4,rod,\n5,8,rod,7\n").expect("links");
    let usual = |ends, rest, rope| Link { ends, rest, stiffness: 30.0, damping: 0.7, rope };
    // Half of the distances, which are 2 and 2.
    assert_eq!(links.springs, [usual([0, 1], 1.0, true), usual([1, 2], 1.0, false), usual([2, 4], 3.0, true)]);
    assert_eq!(links.rods, [Rod { ends: [4, 8], length: 4.0 }, Rod { ends: [8, 5], length: 7.0 }]);
    assert!(links.joints.is_empty() && links.triangles.is_empty());
    assert_eq!(read("a,b\n").expect("no links"), Links::default());
    // A spring and a rod may tie the same two.
    assert_eq!(read("a,b,tie\n0,1,rod\n1,0,spring\n").expect("links").rods.len(), 1);
}

#[test]
fn all_that_is_wrong_at_once() {
    let found = faults(
        "# a net\na,b,rest,wight,stiffness,damping,tie,rest\n0,1,1,,2,3,string\n\n9,1\n-1,x,1\n# more\n1,1,-1,,nan,inf\n\
         2,3,,,,,spring\n3,2,,,,,rope\n0,,4\n1,2,1e999,,five,-0.5\n4,5,,,,,,,6\n",
    );
    let expected = [
        "unknown column `wight`; known are a, b, c, d, rest, stiffness, damping, tie, angle, multiplicity, phase",
        "the column `rest` is there twice: remove one of them",
        "line 3, column tie: `string` is none of spring, rope, rod, joint, dihedral",
        "line 5, column a: there is no particle 9; there are 9, from 0 on",
        "line 6, column a: `-1` is not the id of a particle",
        "line 6, column b: `x` is not the id of a particle",
        "line 8, column rest: -1 is not a finite number, zero or above",
        "line 8, column stiffness: NaN is not a finite number, zero or above",
        "line 8, column damping: inf is not a finite number, zero or above",
        "line 8: particle 1 is linked to itself",
        "line 10: particles 3 and 2 are linked again, after line 9: remove one of the two",
        "line 11, column b: the cell is missing",
        "line 12, column rest: inf is not a finite number, zero or above",
        "line 12, column stiffness: `five` is not a number",
        "line 12, column damping: -0.5 is not a finite number, zero or above",
        "line 13: 9 cells, but 8 columns",
    ];
    assert_eq!(found, expected);
}

/// Numbers that a cell may have, and a link may not.
#[test]
fn links_that_make_no_sense_have_a_line() {
    let found = faults(
        "a,b,rest,stiffness,damping,tie\n0,1,1e300,,,spring\n1,2,,0,0,spring\n2,3,0,,,rope\n3,4,0,,,rod\n4,5,,1e-60,,spring\n",
    );
    let expected = [
        "line 2: the link of 0 and 1 has the rest length 1e300, not a finite number, zero or above",
        "line 3: the link of 1 and 2 has neither stiffness nor damping, and has no effect: remove it",
        "line 4: the link of 2 and 3 is a rope of length 0, which is never slack: make it a spring",
        "line 5: the link of 3 and 4 has length 0: merge its two particles",
        "line 6: the link of 4 and 5 has the stiffness 1e-60, which is 0 in single precision: give 0, or a larger number",
    ];
    assert_eq!(found, expected);
}

#[test]
fn headers_and_files_that_are_none() {
    assert_eq!(faults("")[0], "is empty; its first line must name the columns, such as a,b,rest,stiffness,damping");
    assert_eq!(faults("# nothing else\n").len(), 1);
    let missing = |column| format!("the column `{column}` is missing; the first line must name a and b");
    let unknown = |column| {
        format!(
            "unknown column `{column}`; known are a, b, c, d, rest, stiffness, damping, tie, angle, multiplicity, phase"
        )
    };
    assert_eq!(faults("rest\n1\n"), [missing("a"), missing("b")]);
    assert_eq!(faults("0,1\n1,2\n"), [unknown("0"), unknown("1"), missing("a"), missing("b")]);
    assert_eq!(faults(b"a,b\n0,\xff\xfe\n"), ["line 2, column b: `\u{fffd}\u{fffd}` is not the id of a particle"]);
    let many = faults("a,b\n".to_owned() + &"7,7\n".repeat(500));
    assert_eq!(
        (many.len(), many[19].as_str(), many[20].as_str()),
        (21, "line 21: particle 7 is linked to itself", "and 480 more")
    );
    let folder = folder();
    for path in [folder.path().join("nowhere.csv"), folder.path().to_owned()] {
        match links::read(&Input::disk(&path), &places(), &motes::Bounds::default(), &USUAL) {
            Err(Error::Input { file, .. }) => assert_eq!(file, path),
            other => panic!("{other:?}"),
        }
    }
}

prop_compose! {
    /// Zero and above, of every size that single precision holds, with all digits of double.
    fn not_negative()(mantissa in 1.0..2.0_f64, exponent in -126..127_i32, special in 0..9_usize) -> f64 {
        let specials = [0.0, f64::from(f32::MIN_POSITIVE), f64::from(f32::MAX), 0.1];
        specials.get(special).copied().unwrap_or(mantissa * 2f64.powi(exponent))
    }
}

/// All pairs of the nine.
fn pairs() -> Vec<[u32; 2]> {
    (0..9)
        .flat_map(|a| (0..9).filter(move |b| *b != a).map(move |b| [a, b]))
        .filter(|[a, b]| (a + b) % 2 == u32::from(a < b))
        .collect()
}

proptest! {
    #[test]
    fn links_come_back_bit_for_bit(
        numbers in prop::collection::vec((not_negative(), not_negative(), not_negative(), any::<bool>()), 0..36),
        rods in prop::collection::vec(not_negative(), 0..36),
    ) {
        let springs = numbers.iter().zip(pairs());
        let springs = springs.map(|((rest, stiffness, damping, rope), ends)| Link {
            ends, rest: *rest, stiffness: stiffness.max(0.1), damping: *damping, rope: *rope && *rest > 0.0,
        });
        let rods = rods.iter().zip(pairs()).map(|(length, ends)| Rod { ends, length: length.max(0.1) });
        let links = Links { springs: springs.collect(), rods: rods.collect(), ..Links::default() };
        prop_assert_eq!(read(written(&links)).expect("links"), links);
    }

    #[test]
    fn noise_is_an_error_or_links_but_never_a_panic(
        place in any::<prop::sample::Index>(), byte in any::<u8>(), twice in any::<prop::sample::Index>(),
    ) {
        let mut bytes = written(&some());
        let length = bytes.len();
        bytes[place.index(length)] = byte;
        bytes[twice.index(length)] ^= 1 << (byte % 8);
        let _ = read(bytes);
    }
}

/// Joints and dihedrals: columns that only they need, in any order, and numbers that read back, angles to rounding.
#[test]
fn joints_and_dihedrals() {
    let text = "a,b,c,d,tie,angle,multiplicity,phase,stiffness\n0,1,2,,joint,109.5,,,7\n2,1,0,3,dihedral,,3,-90,-2.5\n4,3,2,,joint,,,,\n5,6,,,,,,,\n0,1,2,3,dihedral,,,,\n";
    let links = read(text).expect("links");
    let joint = |ids, stiffness, angle: f64| Joint { ids, stiffness, rest: (180.0 - angle).to_radians() };
    assert_eq!(links.joints, [joint([0, 1, 2], 7.0, 109.5), joint([4, 3, 2], 30.0, 120.0)]);
    let of =
        |ids, stiffness, multiplicity, phase: f64| Dihedral { ids, stiffness, multiplicity, phase: phase.to_radians() };
    assert_eq!(links.dihedrals, [of([2, 1, 0, 3], -2.5, 3, -90.0), of([0, 1, 2, 3], 30.0, 2, 30.0)]);
    assert_eq!(links.springs.len(), 1);
    let again = read(written(&links)).expect("links");
    assert_eq!((&again.springs, again.joints.len(), again.dihedrals.len()), (&links.springs, 2, 2));
    for (a, b) in again.joints.iter().zip(&links.joints) {
        assert!(Joint { rest: b.rest, ..*a } == *b && (a.rest - b.rest).abs() < 1e-15);
    }
    for (a, b) in again.dihedrals.iter().zip(&links.dihedrals) {
        assert!(Dihedral { phase: b.phase, ..*a } == *b && (a.phase - b.phase).abs() < 1e-15);
    }
    let rods = Links { joints: links.joints.clone(), ..some() };
    assert_eq!(read(written(&rods)).expect("links").rods, some().rods);
    let wrong = faults(
        "a,b,c,d,tie,angle,multiplicity,phase\n0,1,2,3,joint\n0,1,,,joint\n0,1,2,0,dihedral\n0,1,2,3,dihedral,,1.5\n0,1,2,3,dihedral,,13\n0,1,2,,joint,181\n0,1,2,3,dihedral,,1,361\n0,1,2,,spring\n0,1,2,,joint,120,1,\n",
    );
    let expected = [
        "line 2, column d: `3` is too many: a joint has 3 particles, and this cell stays empty",
        "line 3, column c: the cell is missing",
        "line 4: particle 0 is linked to itself",
        "line 5, column multiplicity: 1.5 is not a whole number from 1 to 12",
        "line 6, column multiplicity: 13 is not a whole number from 1 to 12",
        "line 7: the joint of 0, 1, 2 has an angle of 181° at rest, and it is from 0° to 180° (straight)",
        "line 8: the dihedral of 0, 1, 2, 3 has the phase 361°, and phases are from −360° to 360°: leave out whole turns",
        "line 9, column c: `2` is too many: a spring has 2 particles, and this cell stays empty",
        "line 10, column multiplicity: `1` has no effect on a joint: leave it empty",
    ];
    assert_eq!(wrong, expected);
}
