//! Particles in files, with the reader and the writer of a format together; and films of pictures.
//!
//! Readers check every count against the size of the file before they allocate memory for it, and report all faults of a file at once.
//! Writers use [`atomically`], so that a file is written completely or not at all.

#[cfg(feature = "images")]
pub mod apng;
mod archive;
mod atomic;
mod binary;
mod blocks;
mod bytes;
mod collection;
mod contents;
mod convert;
pub mod floor_plan;
mod line;
pub mod links;
mod npy;
mod problems;
mod rows;
mod set;
mod sheet;
mod tags;
mod titles;

use std::fs::File;
use std::io::{self, BufWriter, Read};
use std::path::Path;

pub use self::atomic::atomically;
use self::atomic::verified;
pub use self::bytes::Input;
pub use self::contents::{Contents, Heading, contents, known};
pub use self::convert::{Converted, convert};
use crate::error::Error;
use crate::kernel::{Array, Bounds, Columns};
use crate::state::State;

/// The precision of numbers in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Precision {
    /// As an f32: reads back to the same 32 bits. For states that are f32 anyway, as on the GPU.
    #[default]
    Single,
    /// As an f64: reads back to the same 64 bits.
    Double,
}

/// The options of a writer, and further data of a file.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// The precision of numbers.
    pub precision: Precision,
    /// The box, if there is one.
    pub bounds: Option<Bounds>,
    /// Whether numbers are compressed without loss, in formats that support it.
    pub compress: bool,
    /// The file of a set to be written, in formats that can be divided.
    pub part: Part,
}

/// One of several files that hold a state together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// Its number, counted from 0.
    pub number: u32,
    /// The number of files; at least one.
    pub of: u32,
}

impl Default for Part {
    fn default() -> Self {
        Self { number: 0, of: 1 }
    }
}

impl Part {
    /// The particles of this part, by index: all parts have the same number, give or take one.
    #[must_use]
    pub fn places(&self, particles: usize) -> std::ops::Range<usize> {
        let (of, number) = (u64::from(self.of.max(1)), u64::from(self.number));
        let from = |number: u64| (u128::from(number.min(of)) * particles as u128 / u128::from(of)) as usize;
        from(number)..from(number + 1)
    }
    /// The name of its file, from the stem: `snapshot_10.3.hdf5`, or `snapshot_10.hdf5` if there is only one part.
    #[must_use]
    pub fn name(&self, stem: &str, format: &Format) -> String {
        if self.of > 1 { format!("{stem}.{}.{}", self.number, format.name) } else { format!("{stem}.{}", format.name) }
    }
}

impl Options {
    /// The box, if it is closed along every axis.
    pub(crate) fn closed(&self) -> Option<&Bounds> {
        self.bounds.as_ref().filter(|bounds| !bounds.sides.contains(&crate::kernel::Side::Open))
    }
}

/// A format of files that hold a state. Its reader and its writer are in one module.
#[derive(Debug)]
pub struct Format {
    /// Its name in scenes, and the extension of files that are written.
    pub name: &'static str,
    /// One line for a list.
    pub about: &'static str,
    /// The extensions of its files, in lower case.
    pub endings: &'static [&'static str],
    /// Whether a file that begins with these bytes has this format, if the extension does not determine it.
    pub begins: fn(&[u8]) -> bool,
    /// The contents of a file, without its numbers.
    pub contents: fn(&Input<'_>) -> Result<Contents, Error>,
    /// Reads a state of these columns, if the format can be read.
    pub read: Option<Reader>,
    /// Writes a state, if the format can hold states without loss.
    pub write: Option<Writer>,
    /// Columns of a state that its files do not hold, although their values are not the initial ones; `None`: they hold all.
    pub left_out: Option<fn(&State) -> Vec<String>>,
    /// Whether its files can be compressed.
    pub compresses: bool,
    /// Whether a state can be divided among several of its files.
    pub divides: bool,
}

/// Reads a state of these columns from a file.
pub type Reader = fn(&Input<'_>, &Columns) -> Result<State, Error>;
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

/// The format of a name in scenes.
#[must_use]
pub fn format(name: &str) -> Option<&'static Format> {
    FORMATS.iter().find(|format| format.name == name)
}

/// Reads a state of these columns from a file of any known format: by its extension (see [`FORMATS`]), or by its first bytes if the
/// extension does not determine it.
///
/// # Errors
/// [`Error::Input`], with the file and the line or byte offset of all of its faults.
pub fn read(path: &Path, columns: &Columns) -> Result<State, Error> {
    read_from(&Input::disk(path), columns)
}

/// The same from a file that may be in memory.
///
/// # Errors
/// As for [`read`].
pub fn read_from(path: &Input<'_>, columns: &Columns) -> Result<State, Error> {
    let Some((format, read)) = kind_of(path)?.and_then(|format| Some((format, format.read?))) else {
        return Err(input(path, "is not of a known format"));
    };
    let mut state = read(path, columns)?;
    // Files that hold no columns of a system have the box that a barostat has changed in their headers.
    let corner = crate::component::barostat::corner();
    if columns.get(&corner.name) == Some(&corner)
        && state.get(&corner.name).is_none()
        && let Some(bounds) = (format.contents)(path)?.bounds
    {
        state.declare(&corner)?;
        state.set(&corner.name, Array::Vec3(vec![bounds.high]))?;
    }
    Ok(state)
}

/// The format of an existing file: by its extension, or by its first bytes if the extension does not determine it.
///
/// # Errors
/// [`Error::Input`] when the file cannot be read.
pub fn of(path: &Path) -> Result<Option<&'static Format>, Error> {
    kind_of(&Input::disk(path))
}

/// The same of a file that may be in memory.
fn kind_of(path: &Input<'_>) -> Result<Option<&'static Format>, Error> {
    let named = by_ending(path);
    if named.is_some() { Ok(named) } else { by_beginning(path) }
}

/// The format of files with this extension.
#[must_use]
pub fn by_ending(path: &Path) -> Option<&'static Format> {
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    FORMATS.iter().find(|format| format.endings.contains(&ending.as_str()))
}

/// The format of a file, by its first bytes.
fn by_beginning(path: &Input<'_>) -> Result<Option<&'static Format>, Error> {
    let mut start = Vec::new();
    let (file, _) = path.open()?;
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
