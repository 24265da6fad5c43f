//! Files with compressed numbers: the same numbers in fewer bytes, blocks of VTK, and what is wrong with them.

use std::fs;
use std::io::Write as _;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use glam::DVec3;
use motes::State;
use motes::formats::{FORMATS, Options, atomically};

use super::{bits, folder, put, read, refused};

/// Particles on a lattice, which compress well: positions alone take more than one block of VTK.
fn lattice(count: u32) -> State {
    let mut state = State::default();
    for i in 0..count {
        let place = DVec3::new(f64::from(i % 100), f64::from(i / 100 % 100), f64::from(i / 10_000));
        state.push(place, DVec3::X, 2.0, 0.0);
    }
    (state.time, state.step) = (1.5, 3);
    state
}

#[test]
fn compressed_files_are_smaller_and_hold_the_same() {
    let (folder, state) = (folder(), lattice(200_000));
    for format in FORMATS.iter().filter(|format| format.compresses) {
        let sizes = [false, true].map(|compress| {
            let path = folder.path().join(format!("a.{}", format.name));
            let options = Options { compress, ..Options::default() };
            atomically(&path, |out| format.write.expect("a writer")(out, &state, &options)).expect(format.name);
            let back = read(&path).expect(format.name);
            assert!(bits(&back) == bits(&state) && (back.time, back.step) == (1.5, 3), "{} {compress}", format.name);
            fs::metadata(&path).expect("a file").len()
        });
        assert!(sizes[1] * 4 < sizes[0], "{}: {sizes:?} bytes", format.name);
    }
}

fn zlib(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).expect("memory");
    encoder.finish().expect("memory")
}

/// Two points in blocks of 16 bytes, as VTK writes them, with some of the counts changed.
fn vtp(change: impl Fn(&mut Vec<u32>), encode: bool) -> Vec<u8> {
    let floats: Vec<u8> = [1.0_f32, 2.0, 3.0, -4.0, 0.5, 6.0].into_iter().flat_map(f32::to_be_bytes).collect();
    let blocks = [zlib(&floats[..16]), zlib(&floats[16..])];
    let mut counts = vec![2, 16, 8];
    counts.extend(blocks.iter().map(|block| u32::try_from(block.len()).expect("short")));
    change(&mut counts);
    let counts: Vec<u8> = counts.into_iter().flat_map(u32::to_be_bytes).collect();
    let head = |format: &str| {
        format!(
            "<VTKFile type=\"PolyData\" byte_order=\"BigEndian\" compressor=\"vtkZLibDataCompressor\"><PolyData><Piece \
             NumberOfPoints=\"2\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" {format}"
        )
    };
    let end = "</Points></Piece></PolyData>";
    if encode {
        let text = format!("{}{}", base64(&counts), base64(&blocks.concat()));
        return format!("{}format=\"binary\">\n  {text}\n</DataArray>{end}</VTKFile>", head("")).into();
    }
    let before = format!("{}/>{end}<AppendedData encoding=\"raw\">_", head("format=\"appended\" offset=\"0\""));
    [before.as_bytes(), &counts, &blocks.concat(), b"</AppendedData></VTKFile>"].concat()
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for three in bytes.chunks(3) {
        let word = three.iter().chain([0, 0].iter()).take(3).fold(0_u32, |word, byte| word << 8 | u32::from(*byte));
        for place in 0..4 {
            let letter = char::from(LETTERS[(word >> (18 - 6 * place) & 63) as usize]);
            text.push(if place > three.len() { '=' } else { letter });
        }
    }
    text
}

#[test]
fn blocks_of_other_programs_are_read_and_their_counts_distrusted() {
    let folder = folder();
    for encode in [false, true] {
        let state = read(&put(&folder, "a.vtp", vtp(|_| {}, encode))).expect("blocks");
        assert_eq!(state.position(), [DVec3::new(1.0, 2.0, 3.0), DVec3::new(-4.0, 0.5, 6.0)], "{encode}");
        let lie = |place: usize, number: u32| vtp(move |counts| counts[place] = number, encode);
        refused("b.vtp", lie(0, u32::MAX), &["announces 4294967295 blocks"]);
        refused("b.vtp", lie(0, 1), &["announces 1 blocks"]);
        refused("b.vtp", lie(1, 15), &["announces 2 blocks of 15 bytes"]);
        refused("b.vtp", lie(2, 0), &["announces 2 blocks of 16 bytes and a last one of 0, and needs 24 bytes"]);
        refused("b.vtp", lie(3, u32::MAX), &["is cut within its blocks"]);
        refused("b.vtp", lie(3, 3), &["block 0"]);
        // 8 and 16 bytes, where 16 and 8 are announced.
        let swapped = vtp(|counts| (counts[1], counts[2]) = (20, 4), encode);
        refused("b.vtp", swapped, &["a block 0 of 16 bytes or more, not 20"]);
    }
}
