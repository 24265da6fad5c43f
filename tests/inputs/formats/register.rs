//! Every format of the register: what is written reads back to the same bits, and what is cut or promises too much is an error.

use std::fs;
use std::path::Path;

use glam::{DVec3, DVec4};
use hdf5_pure::{AttrValue, FileBuilder};
use motes::State;
use motes::formats::{self, FORMATS, Format, Options, Precision, atomically};
use motes::kernel::{Array, Bounds, Column, Columns, Kind, Shape, Side};

use super::{folder, put};

/// Columns of every kind and shape that a particle can have.
pub(super) fn columns() -> Columns {
    Columns::with([
        Column::new("charge", Kind::Scalar, "", ""),
        Column::new("density", Kind::Scalar, "", ""),
        Column::new("spin", Kind::Vector, "", ""),
        Column::new("bonds", Kind::Whole, "", ""),
        Column::new("orientation", Kind::Quaternion, "", ""),
        Column::new("history", Kind::Vector, "", "").shaped(Shape::Slots(2)),
    ])
    .expect("columns")
}

/// A state with all of them, of numbers that single precision holds.
#[expect(clippy::cast_possible_truncation, reason = "numbers of single precision are wanted")]
pub(super) fn rich(count: u32) -> State {
    let mut state = State::default();
    let number = |n: u32| f64::from((f64::from(n) * 0.37 - 5.0) as f32);
    for i in 0..count {
        let x = DVec3::new(number(7 * i), -number(3 * i), f64::from(1e-42_f32 * i as f32));
        state.push(x, DVec3::new(number(i), -0.0, 1e30_f32.into()), number(i).abs(), 0.25 * f64::from(i));
    }
    state.species_mut().iter_mut().zip(0..).for_each(|(of, row)| *of = [0, 2, 7, 1][row % 4]);
    for column in columns().iter().skip(Columns::default().iter().count()) {
        state.declare(column).expect("a column");
    }
    let three = |k: u32| (0..count * k).map(|i| DVec3::new(number(i), number(2 * i), -number(i))).collect();
    state.set("charge", Array::Float((0..count).map(|i| -number(i)).collect())).expect("charges");
    state.set("spin", Array::Vec3(three(1))).expect("spins");
    state.set("bonds", Array::Uint((0..count).map(|i| u32::MAX - i).collect())).expect("bonds");
    state.set("history", Array::Vec3(three(2))).expect("history");
    let four = (0..count).map(|i| DVec4::new(number(i), 0.5, -0.5, number(9 * i))).collect();
    state.set("orientation", Array::Vec4(four)).expect("orientations");
    state.set("density", Array::Float((0..count).map(|i| number(i + 3)).collect())).expect("densities");
    state.set_ids((0..count).map(|i| 3 * i + i % 2).collect()).expect("ids");
    (state.time, state.step) = (0.1 + 0.2, 77);
    state
}

/// The same without what Tipsy cannot hold.
fn plain(state: &State) -> State {
    let mut plain = State::default();
    for ((x, v), m) in state.position().iter().zip(state.velocity()).zip(state.mass()) {
        plain.push(*x, *v, *m, 0.0);
    }
    plain.time = state.time;
    plain
}

/// The same without what OBJ cannot hold.
fn places(state: &State) -> State {
    let mut places = State::default();
    state.position().iter().for_each(|x| places.push(*x, DVec3::ZERO, 1.0, 0.0));
    (places.time, places.step) = (state.time, state.step);
    places
}

/// Formats that states are written in, each with a state that it holds.
fn written(count: u32) -> Vec<(&'static Format, State)> {
    let state = rich(count);
    let writable = FORMATS.iter().filter(|format| format.write.is_some());
    let held = |format: &Format| match format.name {
        "tipsy" => plain(&state),
        "obj" => places(&state),
        _ => state.clone(),
    };
    writable.map(|format| (format, held(format))).collect()
}

fn write(folder: &Path, format: &Format, state: &State, options: &Options) -> std::path::PathBuf {
    let path = folder.join(format!("a.{}", format.name));
    let writer = format.write.expect("a writer");
    atomically(&path, |out| writer(out, state, options)).expect(format.name);
    path
}

fn words(values: &Array) -> Vec<u64> {
    match values {
        Array::Float(list) => list.iter().map(|x| x.to_bits()).collect(),
        Array::Vec3(list) => list.iter().flat_map(|v| v.to_array().map(f64::to_bits)).collect(),
        Array::Vec4(list) => list.iter().flat_map(|v| v.to_array().map(f64::to_bits)).collect(),
        Array::Uint(list) => list.iter().map(|n| u64::from(*n)).collect(),
    }
}

#[expect(clippy::cast_possible_truncation, reason = "they are compared in single precision")]
fn narrowed(values: &Array) -> Vec<u64> {
    let narrow = |bits: u64| u64::from((f64::from_bits(bits) as f32).to_bits());
    if let Array::Uint(_) = values { words(values) } else { words(values).into_iter().map(narrow).collect() }
}

#[test]
fn every_format_reads_back_what_it_writes_to_the_bit() {
    let sides = [Side::Periodic, Side::Reflecting, Side::Periodic];
    let bounds = Bounds { low: DVec3::new(-1.0, 0.0, 0.1), high: DVec3::new(3.0, 4.0, 5.0), sides, dimensions: 3 };
    for (precision, compress) in
        [(Precision::Single, false), (Precision::Double, false), (Precision::Single, true), (Precision::Double, true)]
    {
        for (format, state) in written(23).into_iter().filter(|(format, _)| format.compresses || !compress) {
            let folder = folder();
            let options = Options { precision, bounds: Some(bounds), compress, ..Options::default() };
            let path = write(folder.path(), format, &state, &options);
            let back = formats::read(&path, &columns()).expect(format.name);
            assert_eq!(back.len(), 23, "{}", format.name);
            for (column, values) in state.columns() {
                let found = back.get(&column.name).unwrap_or_else(|| panic!("{}: no {}", format.name, column.name));
                // Decimals of single precision are the same when they are narrowed.
                let same = match (precision, format.name) {
                    (Precision::Single, "csv" | "xyz" | "obj") => narrowed(found) == narrowed(values),
                    _ => words(found) == words(values),
                };
                assert!(same, "{} {precision:?}: {} is {found:?}, was {values:?}", format.name, column.name);
            }
            assert_eq!(back.ids(), state.ids(), "{}", format.name);
            if format.name != "csv" {
                assert_eq!(back.time.to_bits(), state.time.to_bits(), "{}", format.name);
            }
            if !["csv", "tipsy"].contains(&format.name) {
                assert_eq!(back.step, 77, "{}", format.name);
            }
            // All columns are found by their titles.
            let contents = formats::contents(&path).expect(format.name);
            let all = formats::read(&path, &formats::known(&contents)).expect(format.name);
            if !["tipsy", "obj"].contains(&format.name) {
                for name in ["charge", "spin", "bonds", "orientation"] {
                    let (all, back) = (all.get(name).expect(name), back.get(name).expect(name));
                    let numbers = |values: &Array| match values {
                        Array::Uint(list) => list.iter().map(|n| f64::from(*n).to_bits()).collect(),
                        other => words(other),
                    };
                    assert_eq!(numbers(all), numbers(back), "{}: {name}", format.name);
                }
            }
            if let Some(found) = contents.bounds {
                assert_eq!((found.low, found.high), (bounds.low, bounds.high), "{}", format.name);
            }
            assert_eq!(
                contents.bounds.is_some(),
                ["hdf5", "ply", "vtp", "xyz"].contains(&format.name),
                "{}",
                format.name
            );
        }
    }
}

#[test]
fn no_particles_are_a_file_too() {
    for (format, _) in written(1) {
        let folder = folder();
        let path = write(folder.path(), format, &State::default(), &Options::default());
        assert_eq!(formats::read(&path, &Columns::default()).expect(format.name).len(), 0, "{}", format.name);
    }
}

#[test]
fn a_file_that_is_cut_is_an_error() {
    let both = [false, true].into_iter().flat_map(|compress| written(9).into_iter().map(move |it| (it, compress)));
    for ((format, state), compress) in both.filter(|((format, _), compress)| format.compresses || !compress) {
        let folder = folder();
        let path = write(folder.path(), format, &state, &Options { compress, ..Options::default() });
        let bytes = fs::read(&path).expect("a file");
        let step = (bytes.len() / 150).max(1);
        for length in (0..bytes.len()).step_by(step) {
            fs::write(&path, &bytes[..length]).expect("a file");
            let Ok(read) = formats::read(&path, &columns()) else { continue };
            // A table that ends with a row is whole, and so is a number of fewer digits.
            let text = ["csv", "xyz"].contains(&format.name);
            // Without the last line feed it is whole.
            if format.name == "obj" && length + 1 == bytes.len() {
                continue;
            }
            // Four bytes are the padding that not every header has: the format cannot tell.
            if format.name == "tipsy" && length + 4 == bytes.len() {
                continue;
            }
            assert!(text && read.len() <= state.len(), "{}: {length} of {} bytes are read", format.name, bytes.len());
            assert!(format.name == "csv" || length + 40 > bytes.len(), "{}: {length} bytes", format.name);
        }
    }
}

/// The bytes of a format of these particles, with a part replaced by another as long.
fn altered(format: &str, from: &[u8], to: &[u8]) -> Vec<u8> {
    let folder = folder();
    let (format, state) = written(5).into_iter().find(|(known, _)| known.name == format).expect("a format");
    let bytes = fs::read(write(folder.path(), format, &state, &Options::default())).expect("a file");
    if from.is_empty() {
        return bytes;
    }
    let place = bytes.windows(from.len()).position(|part| part == from).expect("the part");
    [&bytes[..place], to, &bytes[place + from.len()..]].concat()
}

#[track_caller]
pub(super) fn refused_as(name: &str, bytes: impl AsRef<[u8]>, want: &str) {
    let folder = folder();
    let path = put(&folder, name, bytes);
    let said = formats::read(&path, &columns()).expect_err(want).to_string();
    assert!(said.contains(want), "`{said}` does not say `{want}`");
}

#[test]
fn files_that_promise_too_much_are_refused_without_memory() {
    let many = "1152921504606846976";
    refused_as(
        "a.ply",
        altered("ply", b"element vertex 5", format!("element vertex {many}").as_bytes()),
        &format!("the header announces {many} of `vertex`, and 5 are there"),
    );
    refused_as(
        "a.ply",
        altered("ply", b"element vertex 5", b"element vertex 4"),
        "bytes follow what the header announces",
    );
    refused_as(
        "a.ply",
        format!("ply\nformat ascii 1.0\nelement vertex {many}\nend_header\n"),
        "and no properties of them",
    );
    refused_as(
        "a.vtp",
        altered("vtp", b"NumberOfPoints=\"5\"", format!("NumberOfPoints=\"{many}\"").as_bytes()),
        "needs 13835058055282163712 bytes",
    );
    refused_as(
        "a.vtp",
        altered("vtp", b"NumberOfPoints=\"5\"", b"NumberOfPoints=\"4\""),
        "needs 48 bytes, and its count announces 60",
    );
    refused_as("a.vtp", altered("vtp", b"offset=\"0\"", b"offset=\"99999999999999999999\""), "no offset");
    refused_as(
        "a.vtp",
        altered("vtp", b"offset=\"0\"", b"offset=\"9999999999\""),
        "needs 60 bytes, and the file has 0 for it",
    );
    for (name, counts) in [("a.tipsy", 2_000_000_000_i32), ("a.tipsy", -5)] {
        let mut bytes = altered("tipsy", b"", b"");
        bytes[8..12].copy_from_slice(&counts.to_be_bytes());
        bytes[20..24].copy_from_slice(&counts.to_be_bytes());
        refused_as(name, bytes, &format!("{counts}"));
    }
    refused_as(
        "a.hdf5",
        hdf5(1 << 60, 1, 0, false),
        "Header announces 1152921504606846976 particles of PartType1, and 3 are there",
    );
    refused_as("a.hdf5", altered("hdf5", b"Coordinates", b"Koordinates"), "cannot be read as HDF5");
    refused_as("a.hdf5", "\u{89}HDF\r\n", "cannot be read as HDF5");
}

/// A file of three particles with this first id, as a part of a set.
pub(super) fn hdf5(announced: u64, parts: i32, first: u64, packed: bool) -> Vec<u8> {
    let mut file = FileBuilder::new();
    let mut header = file.create_group("Header");
    header.set_attr("NumPart_ThisFile", AttrValue::U64Array(vec![0, announced, 0, 0, 0, 0]));
    header.set_attr("MassTable", AttrValue::F64Array(vec![0.0, 2.5, 0.0, 0.0, 0.0, 0.0]));
    header.set_attr("NumFilesPerSnapshot", AttrValue::I32Array(vec![parts]));
    header.set_attr("Time", AttrValue::F64(0.5));
    header.set_attr("BoxSize", AttrValue::F64(8.0));
    file.add_group(header.finish());
    let mut group = file.create_group("PartType1");
    let places: Vec<f64> = (0..9).map(f64::from).map(|x| x + first as f64).collect();
    let dataset = group.create_dataset("Coordinates").with_f64_data(&places).with_shape(&[3, 3]);
    if packed {
        dataset.with_chunks(&[2, 3]).with_shuffle().with_deflate(6).with_fletcher32();
    }
    group.create_dataset("ParticleIDs").with_data(&[first, first + 2, first + 4]).with_shape(&[3]);
    group.create_dataset("Metallicity").with_data(&[0.1_f32; 3]).with_shape(&[3]);
    file.add_group(group.finish());
    file.finish().expect("a file")
}

#[test]
fn numbers_that_do_not_fit_are_refused_with_their_place() {
    let folder = folder();
    let mut state = State::default();
    state.push(DVec3::new(1e39, 0.0, 0.0), DVec3::ZERO, 1.0, 0.0);
    for format in FORMATS.iter().filter(|format| format.write.is_some()) {
        let path = folder.path().join(format!("a.{}", format.name));
        let said = atomically(&path, |out| format.write.expect("a writer")(out, &state, &Options::default()))
            .expect_err(format.name)
            .to_string();
        assert!(said.contains("1e39") || said.contains("f32"), "{}: {said}", format.name);
        assert!(!path.exists(), "{}", format.name);
    }
    let nan = f32::NAN.to_le_bytes();
    let mut ply = b"ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n\
                    end_header\n"
        .to_vec();
    let first = ply.len();
    ply.extend([0; 16]);
    ply.extend(nan);
    ply.extend([0; 4]);
    refused_as("a.ply", ply, &format!("byte {}: y is NaN, which is not finite", first + 16));
}

/// A snapshot of two gas particles and a dark one, of which the mass is in the header.
fn gadget(big: bool, named: bool, change: impl Fn(&mut Vec<u8>)) -> Vec<u8> {
    let word = |n: u32| if big { n.to_be_bytes() } else { n.to_le_bytes() };
    let single = |x: f32| if big { x.to_be_bytes() } else { x.to_le_bytes() };
    let double = |x: f64| if big { x.to_be_bytes() } else { x.to_le_bytes() };
    let mut header = vec![0; 256];
    header[0..4].copy_from_slice(&word(2));
    header[4..8].copy_from_slice(&word(1));
    header[32..40].copy_from_slice(&double(7.0));
    header[72..80].copy_from_slice(&double(0.75));
    header[124..128].copy_from_slice(&word(1));
    header[128..136].copy_from_slice(&double(10.0));
    change(&mut header);
    let floats = |list: &[f32]| list.iter().flat_map(|x| single(*x)).collect::<Vec<u8>>();
    let blocks: [(&str, Vec<u8>); 6] = [
        ("HEAD", header),
        ("POS ", floats(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0])),
        ("VEL ", floats(&[-1.0, 0.0, 0.0, -2.0, 0.0, 0.0, -3.0, 0.0, 0.0])),
        ("ID  ", [3, 1, 2].into_iter().flat_map(word).collect()),
        ("MASS", floats(&[0.5, 0.25])),
        ("U   ", floats(&[11.0, 12.0])),
    ];
    let mut bytes = Vec::new();
    for (name, block) in blocks {
        if named {
            bytes.extend(word(8));
            bytes.extend(name.as_bytes());
            bytes.extend(word(u32::try_from(block.len()).expect("short") + 8));
            bytes.extend(word(8));
        }
        let length = word(u32::try_from(block.len()).expect("short"));
        bytes.extend(length);
        bytes.extend(block);
        bytes.extend(length);
    }
    bytes
}

#[test]
fn snapshots_of_gadget_are_read_in_both_forms_and_byte_orders() {
    let columns = Columns::with([Column::new("internal_energy", Kind::Scalar, "", "")]).expect("a column");
    for (big, named) in [(false, false), (false, true), (true, false), (true, true)] {
        let folder = folder();
        // Its name says nothing.
        let path = put(&folder, "snapshot_007", gadget(big, named, |_| {}));
        let state = formats::read(&path, &columns).expect("a snapshot");
        let x: Vec<f64> = state.position().iter().map(|x| x.x).collect();
        assert_eq!((x, state.velocity()[0].x, state.time), (vec![4.0, 7.0, 1.0], -2.0, 0.75), "{big} {named}");
        assert_eq!((state.mass(), state.species()), (&[0.25, 7.0, 0.5][..], &[0, 1, 0][..]));
        assert_eq!(
            (state.ids().to_vec(), state.scalar("internal_energy")),
            (vec![1, 2, 3], Some(&[12.0, 0.0, 11.0][..]))
        );
        let bounds = formats::contents(&path).expect("a header").bounds.expect("a box");
        assert_eq!(bounds.high, DVec3::splat(10.0));
        let bytes = gadget(big, named, |_| {});
        for length in (0..bytes.len()).step_by(3) {
            let cut = put(&folder, "a.gadget", &bytes[..length]);
            // Without the block of energies it is whole, and so is one that ends behind it.
            let whole = formats::read(&cut, &columns).is_ok();
            assert!(!whole || bytes.len() - length >= 16, "{length} of {}", bytes.len());
            assert!(!whole || formats::read(&cut, &columns).expect("whole").len() == 3);
        }
    }
    let promise = gadget(false, false, |header| header[0..4].copy_from_slice(&[0xff; 4]));
    refused_as("b.gadget", promise, "the header announces 4294967296 particles, more than");
    let set = gadget(false, false, |header| header[124..128].copy_from_slice(&4_u32.to_le_bytes()));
    refused_as("c.gadget", set, "byte 128: is one of 4 files");
    let mut torn = gadget(true, false, |_| {});
    torn[260] = 9;
    refused_as("d.gadget", torn, "byte 0: a record of 256 bytes ends with the length");
}

#[test]
fn tipsy_of_either_byte_order_is_read() {
    let folder = folder();
    let mut little = 0.5_f64.to_le_bytes().to_vec();
    for word in [1, 3, 0, 1, 0, 0_i32] {
        little.extend(word.to_le_bytes());
    }
    for number in [2.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 0.1, 0.0_f32] {
        little.extend(number.to_le_bytes());
    }
    let state = super::read(&put(&folder, "a.tipsy", little)).expect("little-endian");
    assert_eq!((state.position()[0], state.mass(), state.time), (DVec3::new(1.0, 2.0, 3.0), &[2.0][..], 0.5));
}

#[test]
fn a_file_is_converted_and_losses_are_reported() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    let bounds = Bounds { low: DVec3::ZERO, high: DVec3::ONE, sides: [Side::Periodic; 3], dimensions: 3 };
    let state = rich(8);
    let npz = FORMATS.iter().find(|format| format.name == "npz").expect("npz");
    let from = write(
        folder.path(),
        npz,
        &state,
        &Options { precision: Precision::Double, bounds: Some(bounds), ..Options::default() },
    );
    let done = formats::convert(&from, &path("b.hdf5"), None).expect("hdf5");
    assert_eq!((done.count, done.precision, done.lost.as_slice()), (8, Precision::Single, &[][..]));
    let done = formats::convert(&path("b.hdf5"), &path("c.vtp"), None).expect("vtp");
    assert_eq!((done.from.name, done.to.name, done.lost.as_slice()), ("hdf5", "vtp", &[][..]));
    let done = formats::convert(&path("c.vtp"), &path("d.tipsy"), None).expect("tipsy");
    let lost = done.lost.join(", ");
    for word in ["the step (77)", "ids", "`species`", "`charge`", "`spin`"] {
        assert!(lost.contains(word), "{lost}");
    }
    let back = formats::read(&path("c.vtp"), &columns()).expect("vtp");
    assert_eq!((back.get("spin"), back.get("history")), (state.get("spin"), state.get("history")));
    // 0.1 needs 64 bits.
    let csv = put(&folder, "e.csv", "x,y,z\n0.1,0,0\n");
    let done = formats::convert(&csv, &path("f.ply"), None).expect("ply");
    assert_eq!((done.precision, done.lost.len()), (Precision::Double, 0));
    let done = formats::convert(&csv, &path("g.ply"), Some(Precision::Single)).expect("ply");
    assert!(done.lost.join("").contains("digits of `position`"), "{:?}", done.lost);
    for (name, want) in
        [("h.gadget", "are read, not written"), ("h.txt", "its extension names no format: use one of .npz")]
    {
        let said = formats::convert(&csv, &path(name), None).expect_err(want).to_string();
        assert!(said.contains(want) && !path(name).exists(), "{said}");
    }
}

#[test]
fn hdf5_of_other_programs_is_read_in_parts_and_packed() {
    let folder = folder();
    for packed in [false, true] {
        let state = super::read(&put(&folder, "one.hdf5", hdf5(3, 1, 1, packed))).expect("one");
        assert_eq!((state.ids().to_vec(), state.time), (vec![1, 3, 5], 0.5));
        assert_eq!(
            (state.mass(), state.species(), state.position()[1]),
            (&[2.5; 3][..], &[1; 3][..], DVec3::new(4.0, 5.0, 6.0))
        );
    }
    let contents = formats::contents(&folder.path().join("one.hdf5")).expect("contents");
    assert!(contents.headings.iter().any(|heading| heading.title == "Metallicity"), "{contents:?}");
    assert_eq!(contents.bounds.expect("a box").high, DVec3::splat(8.0));
    put(&folder, "set.0.hdf5", hdf5(3, 2, 0, false));
    let second = put(&folder, "set.1.hdf5", hdf5(3, 2, 1, true));
    let state = super::read(&second).expect("both");
    assert_eq!((state.len(), state.ids().to_vec()), (6, vec![0, 1, 2, 3, 4, 5]));
    assert_eq!(state.position()[5], DVec3::new(7.0, 8.0, 9.0));
    fs::remove_file(folder.path().join("set.0.hdf5")).expect("a file");
    super::read(&second).expect_err("a part is missing");
    refused_as("alone.hdf5", hdf5(3, 2, 0, false), "is one of 2 files, and its name has no number");
}
