//! HDF5: sets of files, and what other programs write.

use std::fs;
use std::path::Path;

use hdf5_pure::{AttrValue, FileBuilder, GroupBuilder};
use motes::State;
use motes::formats::{self, FORMATS, Options};
use motes::kernel::{Array, Column, Columns, Kind};

use super::register::hdf5;
use super::{folder, put, read};

#[cfg(unix)]
#[test]
fn parts_of_a_set_lie_in_one_folder() {
    let (inside, outside) = (folder(), folder());
    let first = put(&inside, "set.0.hdf5", hdf5(3, 2, 0, false));
    let second = inside.path().join("set.1.hdf5");
    std::os::unix::fs::symlink(put(&outside, "other.hdf5", hdf5(3, 2, 1, false)), &second).expect("a link");
    let said = read(&first).expect_err("a link leads outside").to_string();
    assert!(said.contains("set.1.hdf5") && said.contains("outside of the set's folder"), "{said}");
    formats::contents(&first).expect_err("a link leads outside");
    // A set may be named by a link, and a part may be a link that stays.
    fs::remove_file(&second).expect("a link");
    fs::create_dir(inside.path().join("more")).expect("a folder");
    fs::write(inside.path().join("more/b.hdf5"), hdf5(3, 2, 1, false)).expect("a file");
    std::os::unix::fs::symlink("more/b.hdf5", &second).expect("a link");
    assert_eq!(read(&first).expect("both").len(), 6);
}

#[cfg(unix)]
#[test]
fn what_is_no_regular_file_is_refused_at_once() {
    let said = read(Path::new("/dev/zero")).expect_err("a device").to_string();
    assert!(said.contains("is not a regular file"), "{said}");
}

/// Two particles of a type, and what else is in its group.
fn two(types: &[usize], more: impl Fn(usize, &mut GroupBuilder)) -> Vec<u8> {
    let mut file = FileBuilder::new();
    let mut header = file.create_group("Header");
    header.set_attr("Time", AttrValue::F64(0.5));
    file.add_group(header.finish());
    for kind in types {
        let mut group = file.create_group(&format!("PartType{kind}"));
        group.create_dataset("Coordinates").with_f64_data(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]).with_shape(&[2, 3]);
        more(*kind, &mut group);
        file.add_group(group.finish());
    }
    file.finish().expect("a file")
}

fn dataset(group: &mut GroupBuilder, name: &str, numbers: &[f64]) {
    group.create_dataset(name).with_f64_data(numbers).with_shape(&[numbers.len() as u64]);
}

#[test]
fn masses_that_no_type_has_are_one() {
    let folder = folder();
    let state = read(&put(&folder, "a.hdf5", two(&[1, 2], |_, _| {}))).expect("no masses");
    assert_eq!(state.mass(), [1.0; 4]);
    let mixed = two(&[1, 2], |kind, group| {
        if kind == 1 {
            dataset(group, "Masses", &[3.0, 4.0]);
        }
    });
    let said = read(&put(&folder, "b.hdf5", mixed)).expect_err("some masses").to_string();
    assert!(said.contains("PartType2 has neither `Masses` nor a mass in MassTable"), "{said}");
    let none = two(&[1], |_, group| dataset(group, "Masses", &[0.0, 0.0]));
    assert_eq!(read(&put(&folder, "c.hdf5", none)).expect("masses of 0").mass(), [0.0; 2]);
}

#[test]
fn one_unusual_dataset_is_left_out() {
    let folder = folder();
    let odd = |_: usize, group: &mut GroupBuilder| {
        dataset(group, "Densities", &[0.5, 0.25]);
        dataset(group, "Density", &[7.0, 7.0]);
        dataset(group, "Spectrum", &[1.0, 2.0, 3.0, 4.0, 5.0]);
    };
    let path = put(&folder, "a.hdf5", two(&[0], odd));
    let contents = formats::contents(&path).expect("contents");
    assert_eq!(contents.left_out, ["PartType0/Density", "PartType0/Spectrum"]);
    let state = formats::read(&path, &formats::known(&contents)).expect("the others");
    assert_eq!(state.scalar("density"), Some(&[0.5, 0.25][..]));
    // What is asked for must have the right shape.
    let columns = Columns::with([Column::new("Spectrum", Kind::Scalar, "", "")]).expect("a column");
    let said = formats::read(&path, &columns).expect_err("a column that is asked for").to_string();
    assert!(said.contains("Spectrum: has the shape [5], and there are 2 particles"), "{said}");
    let short = put(&folder, "b.hdf5", two(&[0], |_, group| dataset(group, "Masses", &[1.0])));
    let said = read(&short).expect_err("a mass is missing").to_string();
    assert!(said.contains("Masses: has the shape [1]"), "{said}");
}

#[test]
fn ids_of_64_bits_are_refused_by_their_number() {
    let folder = folder();
    let ids = |_: usize, group: &mut GroupBuilder| {
        group.create_dataset("ParticleIDs").with_data(&[3_u64, (1 << 60) + 1]).with_shape(&[2]);
    };
    let said = read(&put(&folder, "a.hdf5", two(&[1], ids))).expect_err("a large id").to_string();
    assert!(said.contains("1152921504606846977; ids above 4294967294 are not supported: renumber"), "{said}");
}

#[test]
fn links_of_swift_are_passed_over() {
    // Written by h5py 3: beside PartType0 there is GasParticles, a soft link to it.
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/inputs/formats/soft_link.hdf5");
    let contents = formats::contents(&path).expect("contents");
    let state = formats::read(&path, &formats::known(&contents)).expect("two particles");
    assert_eq!((state.len(), state.time, state.ids().to_vec()), (2, 0.25, vec![1, 2]));
    assert_eq!(state.scalar("density"), Some(&[0.5, 0.25][..]));
}

#[test]
fn names_that_mean_something_else_in_a_format_are_refused() {
    for (format, name) in
        [("hdf5", "Coordinates"), ("hdf5", "Densities"), ("npz", "time"), ("npz", "kept_x"), ("csv", "m")]
    {
        let mut state = State::default();
        state.push(glam::DVec3::ONE, glam::DVec3::ZERO, 1.0, 0.0);
        state.declare(&Column::new(name, Kind::Scalar, "", "")).expect("a column");
        state.set(name, Array::Float(vec![2.0])).expect("a number");
        let folder = folder();
        let path = folder.path().join(format!("a.{format}"));
        let write = FORMATS.iter().find(|of| of.name == format).and_then(|of| of.write).expect("a writer");
        let said =
            formats::atomically(&path, |out| write(out, &state, &Options::default())).expect_err(name).to_string();
        assert!(said.contains(&format!("the column `{name}` has the name")) && !path.exists(), "{said}");
    }
}
