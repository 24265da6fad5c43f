//! Extended XYZ: what other programs write, and what is wrong with a file.

use glam::DVec3;
use motes::formats::{self, Precision, read as read_state};
use motes::kernel::{Array, Column, Columns, Kind};

use crate::formats::{folder, put, read, some, xyz_bytes};

/// As ASE 3 writes two atoms, an open and a periodic one.
const ASE: &str = "2\nLattice=\"5.0 0.0 0.0 0.0 5.0 0.0 0.0 0.0 5.0\" Properties=species:S:1:pos:R:3:masses:R:1 pbc=\"T T T\"\n\
                   O        0.50000000       0.00000000      -1.25000000      15.99900000\n\
                   Ar       1.00000000       2.00000000       3.00000000      39.94800000\n";

#[test]
fn files_of_other_programs_are_read() {
    let folder = folder();
    let state = read(&put(&folder, "a.xyz", ASE)).expect("extended");
    assert_eq!(state.position(), [DVec3::new(0.5, 0.0, -1.25), DVec3::new(1.0, 2.0, 3.0)]);
    assert_eq!((state.mass(), state.species()), (&[15.999, 39.948][..], &[8, 18][..]));
    let plain = "3\nwater, no keys\nO 0 0 0\nH 0.96 0 0\nH -0.24 0.93 0\n";
    let state = read(&put(&folder, "b.xyz", plain)).expect("plain");
    assert_eq!((state.species(), state.position()[2]), (&[8, 1, 1][..], DVec3::new(-0.24, 0.93, 0.0)));
    // Rows in the order of ids, by the beginning of the file alone.
    let ordered = "2\nProperties=id:I:1:pos:R:3 Time=1.5\n1 7 0 0\n0 5 0 0\n";
    let state = read(&put(&folder, "c.data", ordered)).expect("ids");
    assert_eq!((state.position()[0].x, state.position()[1].x, state.time), (5.0, 7.0, 1.5));
}

#[test]
fn momenta_are_velocities_times_masses() {
    let folder = folder();
    let file = |body: &str| put(&folder, "a.xyz", format!("2\nProperties=species:S:1:pos:R:3:{body}"));
    let state = read(&file("momenta:R:3:masses:R:1\nO 0 0 0 8 -4 2 16\nH 1 0 0 0 3 0 1.5\n")).expect("momenta");
    assert_eq!(state.velocity(), [DVec3::new(0.5, -0.25, 0.125), DVec3::new(0.0, 2.0, 0.0)]);
    for (body, words) in [
        ("momenta:R:3\nO 0 0 0 8 -4 2\nH 1 0 0 0 3 0\n", "`masses:R:1`"),
        ("momenta:R:3:masses:R:1\nO 0 0 0 8 -4 2 16\nH 1 0 0 0 3 0 0\n", "line 4, momenta: 3"),
        ("momenta:R:3:velo:R:3:masses:R:1\nO 0 0 0 8 -4 2 1 1 1 16\nH 1 0 0 0 3 0 1 1 1 1\n", "there twice"),
    ] {
        let why = read(&file(body)).expect_err(words).to_string();
        assert!(why.contains(words), "{why}");
    }
}

#[test]
fn columns_go_there_and_back() {
    let columns = Columns::with(vec![
        Column::new("charge", Kind::Scalar, "", "a charge"),
        Column::new("spin", Kind::Vector, "", "a spin"),
        Column::new("bonds", Kind::Whole, "", "a count"),
        Column::new("radius", Kind::Scalar, "length", "what other programs call the size"),
        Column::new("pos", Kind::Scalar, "", "what they call positions"),
    ])
    .expect("columns");
    let mut state = some(3);
    for column in
        columns.iter().filter(|column| ["charge", "spin", "bonds", "radius", "pos"].contains(&column.name.as_ref()))
    {
        state.declare(column).expect("a column");
    }
    let spins = vec![DVec3::new(1.0, -2.0, 0.1), DVec3::ZERO, DVec3::new(1e-40, 3.0, 4.0)];
    state.set("charge", Array::Float(vec![0.1, -1.0, 7e300])).expect("charges");
    state.set("spin", Array::Vec3(spins)).expect("spins");
    state.set("bonds", Array::Uint(vec![0, 4_294_967_295, 7])).expect("counts");
    state.set("radius", Array::Float(vec![0.5, 0.25, 0.125])).expect("radii");
    state.set("pos", Array::Float(vec![3.0, 2.0, 1.0])).expect("numbers");
    state.size_mut().fill(7.0);
    let folder = folder();
    let path = put(&folder, "a.xyz", xyz_bytes(&state, Precision::Double));
    let back = read_state(&path, &columns).expect("the same columns");
    for name in ["charge", "spin", "bonds", "radius", "pos", "size", "position"] {
        assert_eq!(back.get(name), state.get(name), "{name}");
    }
    // And where nothing declares them.
    let all = formats::known(&formats::contents(&path).expect("headings"));
    let all = read_state(&path, &all).expect("all columns");
    assert_eq!(
        (all.get("pos"), all.get("radius"), all.get("size")),
        (state.get("pos"), state.get("radius"), state.get("size"))
    );
    let unknown = read(&path).expect_err("columns that nothing declares").to_string();
    assert!(unknown.contains("line 2: unknown property `charge`; known are id, "), "{unknown}");
}

#[test]
fn faults_are_reported_with_their_lines() {
    let folder = folder();
    let cases = [
        ("many\n\n", "line 1: `many` is no number of particles"),
        (
            "1152921504606846976\nProperties=pos:R:3\n0 0 0\n",
            "line 4: the file ends here; line 1 announces 1152921504606846976 particles, and there are 1",
        ),
        ("1\nProperties=pos:R:2\n0 0\n", "line 2: `pos` has 2 numbers for each particle; it has 3"),
        ("1\nProperties=pos:R\n0 0\n", "line 2: `pos:R` in Properties is no name:kind:width, as in pos:R:3"),
        ("1\nProperties=mass:R:1\n2\n", "line 2: Properties has no `pos:R:3`: positions are missing"),
        ("1\nProperties=pos:R:3:pos:R:3\n0 0 0 0 0 0\n", "line 2: `pos` is there twice"),
        ("1\nProperties=species:S:1:pos:R:3\nQq 0 0 0\n", "line 3, species: `Qq` is no number"),
        ("1\nProperties=pos:R:3\n0 nan 0\n", "line 3, pos: `nan` is not finite"),
        ("1\nProperties=pos:R:3:mass:R:1\n0 0 0 -1\n", "line 3, mass: `-1` is below 0"),
        ("2\nProperties=id:I:1:pos:R:3\n0 0 0 0\n0 1 1 1\n", "the id 0 is there already"),
        ("1\nProperties=id:I:1:pos:R:3\n-3 0 0 0\n", "line 3, id: `-3` is no id"),
        ("1\nProperties=id:I:1:id:I:1:pos:R:3\n0 0 0 0 0\n", "line 2: `id` is there twice"),
        ("1\nProperties=pos:R:3\n0 0 0\n1\nProperties=pos:R:3\n0 0 0\n", "line 4: a second frame begins"),
    ];
    for (text, want) in cases {
        let said = read(&put(&folder, "a.xyz", text)).expect_err(want).to_string();
        assert!(said.contains(want), "{text}\n{said}");
    }
    let mut state = some(1);
    state.species_mut()[0] = 119;
    let said = motes::formats::xyz::write_xyz(std::io::sink(), &state, &motes::formats::Options::default())
        .expect_err("no element")
        .to_string();
    assert!(said.contains("species 119"), "{said}");
}
