//! What is read: a file on a disk, or one in memory.

use std::fs::File;
use std::io::{self, BufReader, Cursor, Read, Seek, SeekFrom};
use std::ops::Deref;
use std::path::Path;

use super::input;
use crate::error::Error;

/// A file to be read, with its name in messages. It is a path where only that matters.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    path: &'a Path,
    /// Its bytes, where it is in memory.
    bytes: Option<&'a [u8]>,
}

/// Bytes that are read in their order, or from some place on.
pub(super) enum Bytes<'a> {
    Disk(File),
    Memory(Cursor<&'a [u8]>),
}

impl<'a> Input<'a> {
    /// A file of the disk.
    #[must_use]
    pub fn disk(path: &'a Path) -> Self {
        Self { path, bytes: None }
    }
    /// A file in memory: of a browser, or of a program that has made it.
    #[must_use]
    pub fn memory(name: &'a Path, bytes: &'a [u8]) -> Self {
        Self { path: name, bytes: Some(bytes) }
    }
    /// Its bytes, where it is in memory.
    pub(super) fn bytes(&self) -> Option<&'a [u8]> {
        self.bytes
    }
    /// Its bytes from the first on, and how many there are.
    pub(super) fn open(&self) -> Result<(BufReader<Bytes<'a>>, u64), Error> {
        let buffered = |bytes, length| (BufReader::with_capacity(1 << 16, bytes), length);
        if let Some(bytes) = self.bytes {
            return Ok(buffered(Bytes::Memory(Cursor::new(bytes)), bytes.len() as u64));
        }
        let failed = |error: io::Error| input(self.path, error.to_string());
        // Before it is opened: opening a pipe waits for its other end.
        let data = std::fs::metadata(self.path).map_err(failed)?;
        if data.is_dir() {
            return Err(input(self.path, "is a folder, not a file of particles"));
        }
        if !data.is_file() {
            return Err(input(self.path, "is not a regular file: files are read more than once, so copy it into one"));
        }
        Ok(buffered(Bytes::Disk(File::open(self.path).map_err(failed)?), data.len()))
    }
}

impl Deref for Input<'_> {
    type Target = Path;
    fn deref(&self) -> &Path {
        self.path
    }
}

impl Read for Bytes<'_> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        match self {
            Self::Disk(file) => file.read(into),
            Self::Memory(bytes) => bytes.read(into),
        }
    }
}

impl Seek for Bytes<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match self {
            Self::Disk(file) => file.seek(to),
            Self::Memory(bytes) => bytes.seek(to),
        }
    }
}
