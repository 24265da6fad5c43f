//! NPZ archives as other programs write them: other types, orders and packings; and archives that lie.

use std::io::{Cursor, Write};
use std::path::Path;

use glam::DVec3;
use motes::error::Error;
use motes::formats::{Input, npz};
use npyz::zip::write::FileOptions;
use npyz::zip::{CompressionMethod, ZipWriter};

/// An NPY array: its header's text and its data.
fn npy(descr: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let text = format!("{{'descr': {descr}, 'fortran_order': False, 'shape': {shape}, }}\n");
    let length = u16::try_from(text.len()).expect("short");
    [b"\x93NUMPY\x01\x00".as_slice(), &length.to_le_bytes(), text.as_bytes(), data].concat()
}

fn f4(values: &[f32]) -> Vec<u8> {
    let data: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
    npy("'<f4'", &format!("({},)", values.len()), &data)
}

fn archive(arrays: &[(&str, Vec<u8>)], method: CompressionMethod) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in arrays {
        zip.start_file(format!("{name}.npy"), FileOptions::default().compression_method(method)).expect("memory");
        zip.write_all(bytes).expect("memory");
    }
    zip.finish().expect("memory").into_inner()
}

fn read(bytes: &[u8]) -> Result<motes::State, Error> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.npz");
    std::fs::write(&path, bytes).expect("a file");
    npz::read(&Input::disk(Path::new(&path)), &motes::kernel::Columns::default())
}

/// x is the array given, y and z are fine.
#[track_caller]
fn refused(x: &[u8], words: &[&str]) {
    let good = f4(&[1.0, 2.0]);
    let arrays = [("x", x.to_vec()), ("y", good.clone()), ("z", good)];
    for method in [CompressionMethod::Stored, CompressionMethod::Deflated] {
        says(&read(&archive(&arrays, method)), words);
    }
}

#[track_caller]
fn says(result: &Result<motes::State, Error>, words: &[&str]) {
    let Err(Error::Input { message, .. }) = result else { panic!("{result:?}") };
    for word in words {
        assert!(message.contains(word), "`{message}` does not say `{word}`");
    }
}

#[test]
fn any_type_order_and_packing() {
    let big: Vec<u8> = [1.5_f64, -2.5].iter().flat_map(|x| x.to_be_bytes()).collect();
    let whole: Vec<u8> = [7_i64, -8].iter().flat_map(|x| x.to_le_bytes()).collect();
    let arrays = [
        ("x", npy("'>f8'", "(2,)", &big)),
        ("y", npy("'<i8'", "(2, )", &whole)),
        ("z", f4(&[0.25, 0.5])),
        ("id", npy("\"<i4\"", "(2,)", &[1, 0, 0, 0, 0, 0, 0, 0])),
        ("time", npy("'<f8'", "()", &9.5_f64.to_le_bytes())),
        ("step", npy("'<u4'", "(1,)", &[3, 0, 0, 0])),
        ("size", f4(&[0.0, 4.0])),
        ("species", npy("'<u4'", "(2,)", &[7, 0, 0, 0, 255, 255, 255, 255])),
    ];
    for method in [CompressionMethod::Stored, CompressionMethod::Deflated] {
        let got = read(&archive(&arrays, method)).expect("npz");
        assert_eq!(got.position(), [DVec3::new(-2.5, -8.0, 0.5), DVec3::new(1.5, 7.0, 0.25)]);
        assert_eq!((got.mass(), got.size()), (&[1.0; 2][..], &[4.0, 0.0][..]));
        assert_eq!(got.species(), [u32::MAX, 7]);
        assert_eq!((got.time, got.step, got.velocity()), (9.5, 3, &[DVec3::ZERO; 2][..]));
    }
}

#[test]
fn archives_that_lie_are_refused() {
    let two = [0; 8];
    refused(&npy("'|O'", "(2,)", &two), &["the array `x` holds Python objects"]);
    refused(&npy("[('a', '<f4')]", "(2,)", &two), &["the array `x` holds records"]);
    refused(&npy("'<c8'", "(1,)", &two), &["the array `x` holds `<c8`"]);
    refused(&npy("'<f4'", "(1, 2)", &two), &["has the shape [1, 2]; it must have one axis"]);
    refused(
        &npy("'<f4'", "(1000000000000,)", &two),
        &["announces 1000000000000 numbers of 4 bytes", "the archive holds"],
    );
    refused(&npy("'<f4'", "(18446744073709551615,)", &two), &["announces 18446744073709551615 numbers"]);
    refused(&npy("'<f4'", "(99999999999999999999,)", &two), &["the length `99999999999999999999`"]);
    refused(&npy("'<f4'", "(-1,)", &two), &["the length `-1`"]);
    refused(&npy("'<f4'", "((((((", &two), &["without a tuple"]);
    refused(b"\x93NUMPY\x02\x00\xff\xff\xff\xff", &["announces a header of 4294967295 bytes"]);
    refused(b"\x93NUMPY\x01\x00\xff\x00{", &["ends within its header"]);
    refused(b"\x93NUMPY\x09\x00", &["version 9"]);
    refused(b"PK", &["the array `x`", "header"]);
    refused(&f4(&[1.0]), &["the array `y` holds 2 numbers, but `x` holds 1"]);
    refused(&f4(&[1.0, f32::NAN]), &["x[1] is NaN"]);
    let two = f4(&[1.0, 2.0]);
    let stored = |arrays: &[(&str, Vec<u8>)]| read(&archive(arrays, CompressionMethod::Stored));
    says(&stored(&[("x", two.clone()), ("z", two.clone())]), &["the array `y` is missing"]);
    let (x, y, z) = (("x", two.clone()), ("y", two.clone()), ("z", two.clone()));
    let with = |name, bytes| stored(&[x.clone(), y.clone(), z.clone(), (name, bytes)]);
    says(&with("mas", two.clone()), &["unknown array `mas`; did you mean `mass`?"]);
    says(&with("mass", f4(&[1.0, -1.0])), &["mass[1] is -1.0, which is below 0"]);
    says(&with("id", f4(&[0.0, 2.5])), &["id[1] is 2.5, which is not a whole number"]);
    says(&with("species", f4(&[0.0, 2.5])), &["species[1] is 2.5, which is not a whole number"]);
    says(&with("species", f4(&[-1.0, 2.0])), &["species[0] is -1.0, which is not a whole number"]);
    says(&with("species", f4(&[1.0])), &["the array `species` holds 1 numbers"]);
    says(&with("id", f4(&[2.0, 2.0])), &["id[1]: the id 2 is there already, at id[0]"]);
    says(&with("time", two.clone()), &["`time` holds 2 numbers"]);

    // One bit of the data changed: the archive's checksum notices.
    let mut bytes = archive(&[x.clone(), y.clone(), z.clone()], CompressionMethod::Stored);
    // Of both numbers: the bytes of one also stand in heads of files, at some times of the day.
    let data = [1.0_f32.to_le_bytes(), 2.0_f32.to_le_bytes()].concat();
    let place = bytes.windows(8).position(|w| w == data).expect("the numbers 1 and 2");
    bytes[place] ^= 1;
    says(&read(&bytes), &["the array `x` is damaged"]);
    says(&read(b"PK\x03\x04 and no more"), &[""]);
}

#[test]
fn sizes_that_lie_cost_no_memory() {
    // A thousand million numbers, announced alike by the array's header and by the archive's directory, and two that are there.
    let lie = npy("'<f4'", "(1000000000,)", &[0; 8]);
    let announced = u32::try_from(lie.len() - 8 + 4_000_000_000_usize).expect("32 bits");
    let good = f4(&[1.0, 2.0]);
    for (method, words) in [
        (CompressionMethod::Stored, "ends after 0 of 1000000000 numbers"),
        (CompressionMethod::Deflated, "the archive holds 4000000"),
    ] {
        let mut bytes = archive(&[("x", lie.clone()), ("y", good.clone()), ("z", good.clone())], method);
        let entry = bytes.windows(4).position(|w| w == b"PK\x01\x02").expect("the directory");
        bytes[entry + 24..entry + 28].copy_from_slice(&announced.to_le_bytes());
        if method == CompressionMethod::Stored {
            bytes[entry + 20..entry + 24].copy_from_slice(&announced.to_le_bytes());
        }
        says(&read(&bytes), &["the array `x`", words]);
    }
}
