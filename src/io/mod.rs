//! Particles from and to files: CSV, Tipsy and NPZ, reader and writer of a format together; and pictures joined to films.
//!
//! Readers check every count against the size of the file before they reserve memory for it, and report all that is wrong
//! with a file at once. Writers go through [`atomically`], so that a file is either whole or not there.

#[cfg(feature = "scene")]
pub mod apng;
mod archive;
mod atomic;
pub mod csv;
#[cfg(feature = "scene")]
mod folder;
mod line;
pub mod links;
mod npy;
pub mod npz;
mod problems;
mod rows;
pub mod tipsy;
mod titles;

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

pub use self::atomic::atomically;
#[cfg(feature = "scene")]
pub use self::folder::Folder;
use crate::error::Error;
use crate::kernel::Columns;
use crate::state::State;

/// How many digits, or bytes, a number gets in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Precision {
    /// As an f32: what reads back to the same 32 bits. For state that is f32 anyway, as on the GPU.
    #[default]
    Single,
    /// As an f64: what reads back to the same 64 bits.
    Double,
}

/// Reads a state of these columns from a file of any known format: by its ending `.csv`, `.npz`, `.tipsy` (or `.bin`, `.std`,
/// `.tip`), and by what it starts with where the ending says nothing.
///
/// # Errors
/// [`Error::Input`], with the file and the line or byte offset of everything that is wrong with it.
pub fn read(path: &Path, columns: &Columns) -> Result<State, Error> {
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    match ending.as_str() {
        "csv" => csv::read(path, columns),
        "npz" => npz::read(path, columns),
        "bin" | "std" | "tip" | "tipsy" => tipsy::read(path),
        _ => {
            let mut start = Vec::new();
            let (file, _) = open(path)?;
            file.take(512).read_to_end(&mut start).map_err(|error| input(path, error.to_string()))?;
            if start.starts_with(b"\x89HDF\r\n\x1a\n") {
                Err(input(path, "is an HDF5 file, which motes does not read: make it a CSV or NPZ file"))
            } else if start.starts_with(b"PK\x03\x04") {
                npz::read(path, columns)
            } else if start.contains(&0) {
                // A Tipsy header holds small counts, so it holds zeros; text does not.
                tipsy::read(path)
            } else {
                csv::read(path, columns)
            }
        }
    }
}

/// An [`Error::Input`] about a whole file.
fn input(path: &Path, message: impl Into<String>) -> Error {
    Error::Input { file: path.to_owned(), message: message.into() }
}

/// A file, and its length in bytes.
fn open(path: &Path) -> Result<(BufReader<File>, u64), Error> {
    let file = File::open(path).map_err(|error| input(path, error.to_string()))?;
    let data = file.metadata().map_err(|error| input(path, error.to_string()))?;
    if data.is_dir() {
        return Err(input(path, "is a folder, not a file of particles"));
    }
    Ok((BufReader::with_capacity(1 << 16, file), data.len()))
}
