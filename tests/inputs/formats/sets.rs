//! Sets of HDF5 files: what is divided comes back whole, and what is no set is refused.

use std::fs;
use std::path::{Path, PathBuf};

use motes::State;
use motes::formats::{self, Options, Part, Precision, atomically};

use super::folder;
use super::register::{columns, rich};

fn write(folder: &Path, stem: &str, state: &State, of: u32, compress: bool) -> Vec<PathBuf> {
    let format = formats::format("hdf5").expect("HDF5");
    let one = |number| {
        let part = Part { number, of };
        let path = folder.join(part.name(stem, format));
        let options = Options { precision: Precision::Double, part, compress, ..Options::default() };
        atomically(&path, |out| format.write.expect("a writer")(out, state, &options)).expect("a file");
        path
    };
    (0..of).map(one).collect()
}

#[test]
fn a_set_is_read_by_the_name_of_any_of_its_files() {
    // 40 files of 23 particles: some are empty.
    for (of, compress) in [(1, false), (2, true), (3, false), (7, false), (40, true)] {
        let (folder, state) = (folder(), rich(23));
        let files = write(folder.path(), "snapshot_77", &state, of, compress);
        let first = if of > 1 { "snapshot_77.0.hdf5" } else { "snapshot_77.hdf5" };
        assert_eq!((files.len(), files[0].file_name().and_then(|name| name.to_str())), (of as usize, Some(first)));
        for file in [files.first(), files.last()].into_iter().flatten() {
            let back = formats::read(file, &columns()).expect("a set");
            assert_eq!((back.ids(), back.time.to_bits(), back.step), (state.ids(), state.time.to_bits(), 77), "{of}");
            for (column, values) in state.columns() {
                assert_eq!(back.get(&column.name), Some(values), "{of}: {}", column.name);
            }
            assert_eq!(formats::contents(file).expect("contents").rows, 23);
        }
    }
}

#[test]
fn every_particle_is_in_one_part() {
    for (of, particles) in [(1, 0), (3, 0), (3, 10), (7, 5), (4096, 1_000_003)] {
        let ranges: Vec<_> = (0..of).map(|number| Part { number, of }.places(particles)).collect();
        assert_eq!((ranges[0].start, ranges[ranges.len() - 1].end), (0, particles));
        assert!(ranges.windows(2).all(|pair| pair[0].end == pair[1].start), "{of} {particles}");
        let sizes = || ranges.iter().map(ExactSizeIterator::len);
        assert!(sizes().max().unwrap_or(0) - sizes().min().unwrap_or(0) <= 1, "{of} {particles}");
    }
}

#[test]
fn parts_that_do_not_belong_together_are_refused() {
    let said = |file: &Path| formats::read(file, &columns()).expect_err("no set").to_string();
    let (here, there) = (folder(), folder());
    let (state, other) = (rich(12), rich(15));
    let files = write(here.path(), "a", &state, 3, false);
    // One of another state with as many parts: 5 particles where 4 were.
    let others = write(there.path(), "a", &other, 3, false);
    let own = fs::read(&files[1]).expect("a part");
    fs::copy(&others[1], &files[1]).expect("a copy");
    let why = said(&files[0]);
    assert!(why.contains("the set announces") && why.contains("and its files hold"), "{why}");
    // One of another time.
    let mut later = state.clone();
    later.time += 1.0;
    let others = write(there.path(), "a", &later, 3, false);
    fs::copy(&others[2], &files[1]).expect("a copy");
    let why = said(&files[2]);
    assert!(why.contains("a.1.hdf5") && why.contains("is of another time or step than"), "{why}");
    // One of a set of another size.
    let others = write(there.path(), "b", &state, 2, false);
    fs::copy(&others[1], &files[1]).expect("a copy");
    let why = said(&files[0]);
    assert!(why.contains("is one of 2 files, and") && why.contains("of 3"), "{why}");
    // Twice the same part.
    fs::copy(&files[2], &files[1]).expect("a copy");
    let why = said(&files[0]);
    assert!(why.contains("is there already, at") || why.contains("the set announces"), "{why}");
    fs::remove_file(&files[1]).expect("a part");
    assert!(said(&files[0]).contains("a.1.hdf5"));
    fs::write(&files[1], &own).expect("a part");
    formats::read(&files[0], &columns()).expect("whole again");
}
