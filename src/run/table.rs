//! A table of numbers that grows during a run: every row is passed to the system when it is written, and is on the disk with the next
//! state. A run that continues truncates it to the length in its checkpoint, and reads the remaining rows.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::Folder;
use super::stream::Stream;
use crate::error::Error;

/// The lengths of the tables of a folder at a checkpoint \[bytes\], by name; empty at the start of a run.
pub type Lengths = BTreeMap<String, u64>;

/// A file of comma-separated values.
#[derive(Debug)]
pub struct Table {
    name: String,
    path: PathBuf,
    file: BufWriter<Arc<File>>,
    length: u64,
}

impl Table {
    /// A table with these names in its first line: a new one, or, if `past` has its length, the existing one, truncated to that. Also
    /// returns the rows that it has. Symbolic links are not followed, and no file is replaced.
    ///
    /// # Errors
    /// [`Error::Output`] when the file cannot be created, exists already, or differs from the one in `past`.
    pub fn open(folder: &Folder, name: &str, header: &str, past: &Lengths) -> Result<(Self, Rows), Error> {
        let path = folder.file(name)?;
        let failed = |error: std::io::Error| failure(&path, &error.to_string());
        let (file, length, text) = match past.get(name) {
            None => {
                let mut file = OpenOptions::new().write(true).create_new(true).open(&path).map_err(failed)?;
                let line = format!("{header}\n");
                file.write_all(line.as_bytes()).map_err(failed)?;
                (file, line.len() as u64, String::new())
            }
            Some(length) => {
                let (file, text) = cut(&path, header, *length)?;
                (file, *length, text)
            }
        };
        let table = Self { name: name.to_owned(), file: BufWriter::new(Arc::new(file)), length, path };
        Ok((table, Rows(text)))
    }
    /// Its name in the folder.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }
    /// Its length \[bytes\].
    #[must_use]
    pub fn length(&self) -> u64 {
        self.length
    }
    /// Flushes the rows to the disk, so that they survive a crash of the system.
    ///
    /// # Errors
    /// [`Error::Output`] when the disk fails.
    pub fn settle(&self) -> Result<(), Error> {
        synced(self.file.get_ref(), &self.path)
    }
    /// The same, after all files queued so far, without waiting.
    pub(super) fn settle_later(&self, stream: &Stream) -> Result<(), Error> {
        let (file, path) = (self.file.get_ref().clone(), self.path.clone());
        stream.write(&self.path, 0, move || synced(&file, &path))
    }
    /// Adds a row: the step, and its numbers.
    ///
    /// # Errors
    /// [`Error::Output`] when the disk fails.
    pub fn row(&mut self, step: u64, numbers: &[f64]) -> Result<(), Error> {
        let text: Vec<String> = numbers.iter().map(|x| format!("{x:?}")).collect();
        self.words(step, &text.join(","))
    }
    /// The same with text in place of numbers.
    ///
    /// # Errors
    /// [`Error::Output`] when the disk fails.
    pub fn words(&mut self, step: u64, text: &str) -> Result<(), Error> {
        let line = format!("{step},{text}\n");
        let written = self.file.write_all(line.as_bytes()).and_then(|()| self.file.flush());
        self.length += line.len() as u64;
        written.map_err(|error| failure(&self.path, &error.to_string()))
    }
}

/// The rows that a table had when a run continued.
#[derive(Debug, Default)]
pub struct Rows(String);

impl Rows {
    /// The words of each row: the step first.
    pub fn iter(&self) -> impl Iterator<Item = Vec<&str>> {
        self.0.lines().skip(1).map(|line| line.split(',').collect())
    }
    /// The numbers of each row; NaN stays NaN.
    pub fn numbers(&self) -> impl Iterator<Item = (u64, Vec<f64>)> {
        self.iter().map(|words| {
            let step = words.first().and_then(|word| word.parse().ok()).unwrap_or(0);
            (step, words.iter().skip(1).map(|word| word.parse().unwrap_or(f64::NAN)).collect())
        })
    }
}

fn synced(file: &File, path: &Path) -> Result<(), Error> {
    file.sync_data().map_err(|error| failure(path, &error.to_string()))
}

fn failure(path: &Path, message: &str) -> Error {
    Error::Output { file: path.to_owned(), message: message.to_owned() }
}

/// Opens a table of at least this length.
///
/// # Errors
/// [`Error::Output`] where there is no such table.
pub(super) fn holds(path: &Path, length: u64) -> Result<File, Error> {
    let failed = |error: std::io::Error| failure(path, &error.to_string());
    if !fs::symlink_metadata(path).map_err(failed)?.is_file() {
        return Err(failure(path, "it is no ordinary file, as the table of a run that goes on must be"));
    }
    let file = OpenOptions::new().read(true).write(true).open(path).map_err(failed)?;
    let there = file.metadata().map_err(failed)?.len();
    if there < length {
        let text = format!(
            "it has {there} bytes, and the checkpoint was written when it had {length}: rows are lost, and the run cannot go on; put the \
             table back, or begin anew with --overwrite"
        );
        return Err(failure(path, &text));
    }
    Ok(file)
}

/// Truncates a table, and returns its remaining rows.
fn cut(path: &Path, header: &str, length: u64) -> Result<(File, String), Error> {
    let failed = |error: std::io::Error| failure(path, &error.to_string());
    let (mut file, mut text) = (holds(path, length)?, String::new());
    (&mut file).take(length).read_to_string(&mut text).map_err(failed)?;
    if text.lines().next() != Some(header) || !text.ends_with('\n') {
        return Err(failure(
            path,
            "it is not the table that the checkpoint was written beside: put that back, or begin anew",
        ));
    }
    file.set_len(length).map_err(failed)?;
    file.seek(SeekFrom::Start(length)).map_err(failed)?;
    Ok((file, text))
}
