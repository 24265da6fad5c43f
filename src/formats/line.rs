//! The numbers of lines for messages about CSV files.

use std::fmt;
use std::io::{self, BufRead, Seek, SeekFrom};

use ::csv::ByteRecord;

use super::Input;

/// The position of a row. Its line number is only counted when it is shown: `csv` provides the end of the previous row, but not the number
/// of blank lines and comments skipped since.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    path: &'a Input<'a>,
    byte: u64,
    before: u64,
}

impl<'a> Line<'a> {
    pub(super) fn of(path: &'a Input<'a>, record: &ByteRecord) -> Self {
        let (byte, before) = record.position().map_or((0, 1), |start| (start.byte(), start.line()));
        Self { path, byte, before }
    }

    /// Its number, counted from 1.
    fn number(&self) -> io::Result<u64> {
        let mut file = match self.path.open() {
            Ok((file, _)) => file,
            Err(why) => return Err(io::Error::other(why)),
        };
        file.seek(SeekFrom::Start(self.byte))?;
        let mut number = self.before;
        let mut line = Vec::new();
        while file.read_until(b'\n', &mut line)? > 0 && matches!(line[0], b'#' | b'\r' | b'\n') {
            number += 1;
            line.clear();
        }
        Ok(number)
    }
}

impl fmt::Display for Line<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "line {}", self.number().unwrap_or(self.before))
    }
}
