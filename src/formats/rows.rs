//! The rows of a table of text: cells between commas, or between blanks.

use std::io::{self, BufRead, Seek, SeekFrom};

use ::csv::{ByteRecord, Position, Reader, ReaderBuilder, Trim};

/// The maximum number of bytes read to determine the separator of cells.
const START: u64 = 1 << 16;

/// A table, row by row. Empty lines and lines that start with `#` are no rows.
pub(super) enum Rows<R> {
    /// RFC 4180, with quotes.
    Commas(Box<Reader<R>>),
    /// Any number of blanks and tabs between two cells.
    Blanks {
        /// The lines.
        file: R,
        /// Bytes and lines read so far.
        byte: u64,
        line: u64,
    },
}

/// The properties of a table, by its beginning.
pub(super) struct Opened<R> {
    /// Its rows.
    pub(super) rows: Rows<R>,
    /// Names of columns from the last comment before a first row of numbers, if there are as many.
    pub(super) titles: Option<ByteRecord>,
    /// Whether the first row is all numbers.
    pub(super) bare: bool,
}

/// Opens a table. Cells are separated by commas where its first row has one, else by blanks.
pub(super) fn open<R: BufRead + Seek>(mut file: R) -> io::Result<Opened<R>> {
    let mut start = Vec::new();
    io::Read::read_to_end(&mut io::Read::take(&mut file, START), &mut start)?;
    let mark = if start.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
    let (mut comment, mut first): (&[u8], &[u8]) = (b"", b"");
    for line in start[mark..].split(|byte| matches!(byte, b'\n' | b'\r')) {
        match line.trim_ascii() {
            [] => {}
            [b'#', rest @ ..] => comment = rest,
            line => {
                first = line;
                break;
            }
        }
    }
    let commas = first.contains(&b',') || first.contains(&b'"') || cells(first, false).count() < 2;
    let bare = !first.is_empty() && cells(first, commas).all(is_number);
    let named =
        bare && !comment.trim_ascii().is_empty() && cells(comment, commas).count() == cells(first, commas).count();
    let titles = named.then(|| cells(comment, commas).collect());
    file.seek(SeekFrom::Start(if commas { 0 } else { mark as u64 }))?;
    let rows = if commas {
        let mut builder = ReaderBuilder::new();
        builder.comment(Some(b'#')).flexible(true).trim(Trim::All).has_headers(false);
        Rows::Commas(Box::new(builder.from_reader(file)))
    } else {
        Rows::Blanks { file, byte: mark as u64, line: 1 }
    };
    Ok(Opened { rows, titles, bare })
}

fn cells(line: &[u8], commas: bool) -> impl Iterator<Item = &[u8]> {
    let separates = move |byte: &u8| if commas { *byte == b',' } else { byte.is_ascii_whitespace() };
    line.split(separates).map(<[u8]>::trim_ascii).filter(move |cell| commas || !cell.is_empty())
}

fn is_number(cell: &[u8]) -> bool {
    std::str::from_utf8(cell).is_ok_and(|text| text.parse::<f64>().is_ok())
}

impl<R: BufRead> Rows<R> {
    /// Reads the next row; `false` after the last.
    pub(super) fn next(&mut self, record: &mut ByteRecord) -> io::Result<bool> {
        let (file, byte, line) = match self {
            Self::Commas(reader) => return Ok(reader.read_byte_record(record)?),
            Self::Blanks { file, byte, line } => (file, byte, line),
        };
        let mut text = Vec::new();
        loop {
            let mut position = Position::new();
            position.set_byte(*byte).set_line(*line);
            text.clear();
            let end = line_of(file, &mut text)?;
            *byte += text.len() as u64 + u64::from(end.is_some());
            // The two bytes of a line end count as one.
            let again = end == Some(b'\r') && file.fill_buf()?.first() == Some(&b'\n');
            *line += u64::from(end.is_some() && !again);
            let row = text.trim_ascii();
            if !(row.is_empty() || row.starts_with(b"#")) {
                record.clear();
                cells(row, false).for_each(|cell| record.push_field(cell));
                record.set_position(Some(position));
                return Ok(true);
            }
            if end.is_none() {
                return Ok(false);
            }
        }
    }
}

/// Appends a line without its end, and returns the byte that ended it; `None` at the end of the file.
fn line_of(file: &mut impl BufRead, text: &mut Vec<u8>) -> io::Result<Option<u8>> {
    loop {
        let some = file.fill_buf()?;
        if some.is_empty() {
            return Ok(None);
        }
        let end = some.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
        text.extend_from_slice(&some[..end.unwrap_or(some.len())]);
        let (byte, used) = (end.map(|place| some[place]), end.map_or(some.len(), |place| place + 1));
        file.consume(used);
        if byte.is_some() {
            return Ok(byte);
        }
    }
}
