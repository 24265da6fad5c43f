//! Files of particles: what was written reads back to the same bits, and what is broken is an error that says where.

#![cfg(feature = "scene")]

mod blank_tables;
mod csv_text;
mod hdf5_files;
mod layouts;
mod links_text;
mod npz_archives;
mod obj_files;
mod others;
mod packed;
mod readers;
mod register;
mod round_trips;
mod sets;
mod tipsy_files;
mod whole_files;
mod xyz_files;

use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use glam::DVec3;
use motes::State;
use motes::error::Error;
use motes::formats::{Options, Precision, csv, npz, tipsy, xyz};
use motes::kernel::Columns;
use tempfile::TempDir;

fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// Reads what every simulation has.
fn read(path: &Path) -> Result<State, Error> {
    motes::formats::read(path, &Columns::default())
}

fn put(folder: &TempDir, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.path().join(name);
    fs::write(&path, bytes).expect("a file");
    path
}

/// The message of the error that reading a file must give.
#[track_caller]
fn refusal(path: &Path) -> String {
    match read(path) {
        Err(Error::Input { file, message }) => {
            assert_eq!(file, path);
            message
        }
        other => panic!("{}: {other:?} is no Error::Input", path.display()),
    }
}

#[track_caller]
fn refused(name: &str, bytes: impl AsRef<[u8]>, words: &[&str]) {
    let folder = folder();
    let message = refusal(&put(&folder, name, bytes));
    for word in words {
        assert!(message.contains(word), "`{message}` does not say `{word}`");
    }
}

fn bits(p: &State) -> Vec<u64> {
    let vectors = p.position().iter().chain(p.velocity()).flat_map(DVec3::to_array);
    let numbers = vectors.chain(p.mass().iter().copied()).chain(p.size().iter().copied());
    numbers.chain(p.species().iter().map(|of| f64::from(*of))).map(f64::to_bits).collect()
}

fn some(count: u32) -> State {
    let mut particles = State::default();
    for i in 0..count {
        let x = f64::from(i) + 1.0 / 3.0;
        particles.push(DVec3::new(x, -x * 1e-3, 1e5 / x), DVec3::new(x.sqrt(), -0.0, 0.7 * x), 0.1 * x, 0.0);
    }
    particles
}

fn csv_bytes(particles: &State, precision: Precision) -> Vec<u8> {
    let mut bytes = Vec::new();
    csv::write_csv(&mut bytes, particles, precision).expect("memory");
    bytes
}

fn npz_bytes(particles: &State, precision: Precision) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let mut state = particles.clone();
    (state.time, state.step) = (2.5, 77);
    npz::write_npz(&mut bytes, &state, precision).expect("memory");
    bytes.into_inner()
}

fn xyz_bytes(particles: &State, precision: Precision) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut state = particles.clone();
    (state.time, state.step) = (2.5, 77);
    xyz::write_xyz(&mut bytes, &state, &Options { precision, ..Options::default() }).expect("memory");
    bytes
}

fn tipsy_bytes(particles: &State) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut state = particles.clone();
    state.time = 2.5;
    tipsy::write_tipsy(&mut bytes, &state, 0.125).expect("memory");
    bytes
}
