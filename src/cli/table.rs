//! A table of numbers that grows while a run goes on: every row is with the system when it is written, and on the
//! disk with the next state.

use std::fs::{File, OpenOptions};
use std::io::{BufWriter, Write};
use std::path::PathBuf;

use motes::Error;

/// A file of comma-separated values.
pub struct Table {
    path: PathBuf,
    file: BufWriter<File>,
}

impl Table {
    /// A new file with these names in its first line. There is none of that name: no link is followed, and nothing replaced.
    pub fn new(path: PathBuf, header: &str) -> Result<Self, Error> {
        let failed = |error: &std::io::Error| Error::Output { file: path.clone(), message: error.to_string() };
        let made = OpenOptions::new().write(true).create_new(true).open(&path);
        let mut file = BufWriter::new(made.map_err(|e| failed(&e))?);
        writeln!(file, "{header}").map_err(|e| failed(&e))?;
        Ok(Self { path, file })
    }
    /// Puts the rows on the disk, where a crash of the system does not reach them.
    pub fn settle(&self) -> Result<(), Error> {
        let settled = self.file.get_ref().sync_data();
        settled.map_err(|e| Error::Output { file: self.path.clone(), message: e.to_string() })
    }
    /// Adds a row: the step, and what belongs to it.
    pub fn row(&mut self, step: u64, numbers: &[f64]) -> Result<(), Error> {
        let text: Vec<String> = numbers.iter().map(|x| format!("{x:?}")).collect();
        self.words(step, &text.join(","))
    }
    /// The same with what belongs to it in words.
    pub fn words(&mut self, step: u64, text: &str) -> Result<(), Error> {
        let written = writeln!(self.file, "{step},{text}").and_then(|()| self.file.flush());
        written.map_err(|e| Error::Output { file: self.path.clone(), message: e.to_string() })
    }
}
