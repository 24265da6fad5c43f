//! Particles from and to files, reader and writer of a format together; and pictures joined to films.
//!
//! Readers check every count against the size of the file before they reserve memory for it, and report all that is wrong
//! with a file at once. Writers go through [`atomically`], so that a file is either whole or not there.

#[cfg(feature = "images")]
pub mod apng;
mod archive;
mod atomic;
mod binary;
mod blocks;
mod collection;
mod contents;
mod convert;
mod line;
pub mod links;
mod npy;
mod problems;
mod rows;
mod sheet;
mod tags;
mod titles;

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read};
use std::path::Path;

pub use self::atomic::atomically;
use self::atomic::verified;
pub use self::contents::{Contents, Heading, contents, known};
pub use self::convert::{Converted, convert};
use crate::error::Error;
use crate::kernel::{Bounds, Columns};
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

/// How a state is written, and what else a file says.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// The digits, or bytes, of numbers.
    pub precision: Precision,
    /// The box, if there is one.
    pub bounds: Option<Bounds>,
    /// Whether numbers are compressed without loss, in formats that can be.
    pub compress: bool,
    /// Which of the files of a set is written, in formats that are divided.
    pub part: Part,
}

/// One of several files that hold a state together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// Its number, counted from 0.
    pub number: u32,
    /// How many files there are; at least one.
    pub of: u32,
}

impl Default for Part {
    fn default() -> Self {
        Self { number: 0, of: 1 }
    }
}

impl Part {
    /// The particles of this part, by their places: all parts have as many, but for one more or less.
    #[must_use]
    pub fn places(&self, particles: usize) -> std::ops::Range<usize> {
        let (of, number) = (u64::from(self.of.max(1)), u64::from(self.number));
        let from = |number: u64| (u128::from(number.min(of)) * particles as u128 / u128::from(of)) as usize;
        from(number)..from(number + 1)
    }
    /// The name of its file, out of what stands before the extension: `snapshot_10.3.hdf5`, or `snapshot_10.hdf5` where there is one.
    #[must_use]
    pub fn name(&self, stem: &str, format: &Format) -> String {
        if self.of > 1 { format!("{stem}.{}.{}", self.number, format.name) } else { format!("{stem}.{}", format.name) }
    }
}

impl Options {
    /// Its corners, where it has sides along every axis.
    pub(crate) fn closed(&self) -> Option<&Bounds> {
        self.bounds.as_ref().filter(|bounds| !bounds.sides.contains(&crate::kernel::Side::Open))
    }
}

/// A format of files that hold a state. Its reader and its writer stand in one file.
#[derive(Debug)]
pub struct Format {
    /// The word of scenes, and the ending of files that are written.
    pub name: &'static str,
    /// One line for a list.
    pub about: &'static str,
    /// Endings by which files of it are known, in small letters.
    pub endings: &'static [&'static str],
    /// Whether a file that begins with these bytes is of it, where the ending says nothing.
    pub begins: fn(&[u8]) -> bool,
    /// What a file of it holds, without its numbers.
    pub contents: fn(&Path) -> Result<Contents, Error>,
    /// Reads a state of these columns, if it can be read.
    pub read: Option<Reader>,
    /// Writes a state, if states can be written in it without loss.
    pub write: Option<Writer>,
    /// Columns of a state that its files do not hold, though they say more than their initial values; `None`: they hold all.
    pub left_out: Option<fn(&State) -> Vec<String>>,
    /// Whether its files can be compressed.
    pub compresses: bool,
    /// Whether a state can be divided among several of its files.
    pub divides: bool,
}

/// Reads a state of these columns from a file.
pub type Reader = fn(&Path, &Columns) -> Result<State, Error>;
/// Writes a state into a file.
pub type Writer = fn(&mut BufWriter<File>, &State, &Options) -> io::Result<()>;

impl PartialEq for Format {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}
impl Eq for Format {}

macro_rules! register {
    ($($module:ident)*) => {
        $(pub mod $module;)*
        /// All formats, in the order in which the beginning of a file is compared with them.
        pub const FORMATS: &[Format] = &[$($module::FORMAT),*];
    };
}

register! {
    npz
    hdf5
    ply
    vtp
    gadget
    obj
    tipsy
    xyz
    csv
}

/// The format of a scene's word.
#[must_use]
pub fn format(name: &str) -> Option<&'static Format> {
    FORMATS.iter().find(|format| format.name == name)
}

/// Reads a state of these columns from a file of any known format: by its ending (see [`FORMATS`]), and by what it starts with where
/// that says nothing.
///
/// # Errors
/// [`Error::Input`], with the file and the line or byte offset of everything that is wrong with it.
pub fn read(path: &Path, columns: &Columns) -> Result<State, Error> {
    match of(path)?.and_then(|format| format.read) {
        Some(read) => read(path, columns),
        None => Err(input(path, "is not of a known format")),
    }
}

/// The format of a file that is there: by its ending, and by what it starts with where that says nothing.
///
/// # Errors
/// [`Error::Input`] when the file cannot be read.
pub fn of(path: &Path) -> Result<Option<&'static Format>, Error> {
    let named = by_ending(path);
    if named.is_some() { Ok(named) } else { by_beginning(path) }
}

/// The format of files of this ending.
#[must_use]
pub fn by_ending(path: &Path) -> Option<&'static Format> {
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    FORMATS.iter().find(|format| format.endings.contains(&ending.as_str()))
}

/// The format that a file begins like.
fn by_beginning(path: &Path) -> Result<Option<&'static Format>, Error> {
    let mut start = Vec::new();
    let (file, _) = open(path)?;
    file.take(512).read_to_end(&mut start).map_err(|error| input(path, error.to_string()))?;
    Ok(FORMATS.iter().find(|format| (format.begins)(&start)))
}

/// The first letters of a word of a file.
fn shortened(text: &str) -> String {
    const LONGEST: usize = 40;
    if text.chars().count() <= LONGEST { text.to_owned() } else { text.chars().take(LONGEST).chain(['…']).collect() }
}

/// An [`Error::Input`] about a whole file.
fn input(path: &Path, message: impl Into<String>) -> Error {
    Error::Input { file: path.to_owned(), message: message.into() }
}

/// A file, and its length in bytes.
fn open(path: &Path) -> Result<(BufReader<File>, u64), Error> {
    let failed = |error: io::Error| input(path, error.to_string());
    // Before it is opened: to open a pipe is to wait for its other end.
    let data = std::fs::metadata(path).map_err(failed)?;
    if data.is_dir() {
        return Err(input(path, "is a folder, not a file of particles"));
    }
    if !data.is_file() {
        return Err(input(path, "is not a regular file: files are read more than once, so copy it into one"));
    }
    let file = File::open(path).map_err(failed)?;
    Ok((BufReader::with_capacity(1 << 16, file), data.len()))
}
