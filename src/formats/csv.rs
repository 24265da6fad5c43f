//! Text in columns that commas or blanks separate: a header of titles, then one row for each particle. Lines that start with `#` are
//! comments; the last one before a first row of numbers names the columns, where it has as many words.
//!
//! Titles are `x,y,z`, and any of `vx,vy,vz` (0 when left out), `mass` (1), `size` (0), `species` (0), `life` (1: it is active; 0: it
//! is pending; 2: it is removed), those of any other column (`charge`, or `spin_x,spin_y,spin_z`), `id` and `name`; `m` is `mass`. A table holds
//! neither the time nor the step, nor quantities of the system.

use std::fmt::Write as _;
use std::io::{self, Write};

use ::csv::ByteRecord;
use rayon::prelude::*;

use super::line::Line;
use super::problems::{Problems, order, ordered};
use super::rows::{self, Opened};
use super::titles::{self, Strip, Title};
use super::{Contents, Format, Heading, Input, Precision, input};
use crate::error::Error;
use crate::kernel::{Columns, Kind};
use crate::state::State;

/// Its entry in the register: files of no other format are read as text.
pub(super) const FORMAT: Format = Format {
    name: "csv",
    about: "text, one row for each particle, between commas or blanks",
    endings: &["csv"],
    begins: |_| true,
    contents,
    read: Some(read),
    write: Some(|out, state, options| write_csv(out, state, options.precision)),
    left_out: None,
    compresses: false,
    divides: false,
};

/// The short title of the mass.
const SHORT: &str = "m";
const ID: &str = "id";
const NAME: &str = "name";

/// Reads a state of these columns. With a column `id` the rows may come in any order; ids that are not 0, 1, 2, … stay with the particles.
///
/// # Errors
/// [`Error::Input`] that lists, with line and column, every cell that is missing, no number, not finite, or negative where
/// that makes no sense; every column that is unknown, missing or given twice; every id that is given twice.
pub fn read(path: &Input<'_>, columns: &Columns) -> Result<State, Error> {
    let (file, _) = path.open()?;
    let mut problems = Problems::default();
    let mut record = ByteRecord::new();
    let failed = |error: io::Error| input(path, error.to_string());
    let Opened { mut rows, titles: named, bare } = rows::open(file).map_err(failed)?;
    if named.is_none() && !rows.next(&mut record).map_err(failed)? {
        return Err(input(path, "is empty; its first line must name the columns, such as x,y,z,vx,vy,vz,mass"));
    }
    if named.is_none() && bare {
        return Err(input(path, unnamed(&record)));
    }
    let titles = titles::all(columns);
    let header = Header::read(named.as_ref().unwrap_or(&record), &titles, &mut problems);
    let mut given: Vec<Option<Vec<f64>>> = header.places.iter().map(|place| place.map(|_| Vec::new())).collect();
    let (mut count, mut ids, mut lines) = (0, Vec::new(), Vec::new());
    while rows.next(&mut record).map_err(failed)? {
        let line = Line::of(path, &record);
        if record.len() > header.width {
            problems.note(|| format!("{line}: {} cells, but {} columns", record.len(), header.width));
        }
        for ((title, list), place) in titles.iter().zip(&mut given).zip(&header.places) {
            let (Some(list), Some(place)) = (list, place) else { continue };
            let number = if title.column.kind == Kind::Whole {
                whole(&record, *place, &title.text, &line, &mut problems).map(f64::from)
            } else {
                real(&record, *place, &title.text, &line, &mut problems)
            };
            if let (Some(number), Some(fault)) = (number, number.and_then(|number| title.fault(number))) {
                problems.note(|| format!("{line}, column {}: {} {fault}", title.text, title.shown(number)));
            }
            list.push(number.unwrap_or(0.0));
        }
        count += 1;
        if let Some(id) = header.id.and_then(|place| whole(&record, place, ID, &line, &mut problems)) {
            ids.push(u64::from(id));
            lines.push(line);
        }
    }
    // Ids that could not be read have been noted; gaps would only repeat them.
    let order =
        (header.id.is_some() && ids.len() == count).then(|| order(&ids, |row| lines[row].to_string(), &mut problems));
    problems.check(path)?;
    let state = titles::state(columns, given, count);
    Ok(match order {
        Some(order) => ordered(&state, &ids, &order),
        None => state,
    })
}

fn contents(path: &Input<'_>) -> Result<Contents, Error> {
    let (file, _) = path.open()?;
    let mut record = ByteRecord::new();
    let failed = |error: io::Error| input(path, error.to_string());
    let Opened { mut rows, titles, .. } = rows::open(file).map_err(failed)?;
    if titles.is_none() {
        rows.next(&mut record).map_err(failed)?;
    }
    let names = titles.as_ref().unwrap_or(&record);
    let heading = |place| Heading { title: shown(names, place), whole: false };
    Ok(Contents { headings: (0..names.len()).map(heading).collect(), ..Contents::default() })
}

/// The message for a table with numbers in its first row.
fn unnamed(record: &ByteRecord) -> String {
    if record.len() == 1 {
        return "begins with a line of one number, as an XYZ file does: rename it to .xyz, or make it a table whose first line \
                names the columns, such as x,y,z,vx,vy,vz,mass"
            .to_owned();
    }
    format!(
        "its first line is {} numbers, and the columns have no names: put a line before it that names them, such as \
         mass x y z vx vy vz, with `#` or without",
        record.len()
    )
}

/// The position of each title.
struct Header {
    width: usize,
    /// In the order of the possible titles.
    places: Vec<Option<usize>>,
    id: Option<usize>,
}

impl Header {
    fn read(header: &ByteRecord, titles: &[Title<'_>], problems: &mut Problems) -> Self {
        let mut found = Self { width: header.len(), places: vec![None; titles.len()], id: None };
        let mut name = None;
        for place in 0..header.len() {
            let title = shown(header, place);
            let title = if title == SHORT { "mass".to_owned() } else { title };
            let slot = match titles.iter().position(|known| known.text == title) {
                Some(number) => &mut found.places[number],
                None if title == ID => &mut found.id,
                None if title == NAME => &mut name,
                None => {
                    problems.note(|| unknown("column", &title, titles, &[ID, NAME]));
                    continue;
                }
            };
            if slot.replace(place).is_some() {
                problems.note(|| format!("the column `{title}` is there twice: remove one of them"));
            }
        }
        for (title, place) in titles.iter().zip(&found.places) {
            if title.column.name == "position" && place.is_none() {
                problems
                    .note(|| format!("the column `{}` is missing; the first line must name x, y and z", title.text));
            }
        }
        found
    }
}

/// A finite number.
fn real(record: &ByteRecord, place: usize, title: &str, line: &Line, problems: &mut Problems) -> Option<f64> {
    let at = || format!("{line}, column {title}");
    if record.get(place).unwrap_or_default().is_empty() {
        problems.note(|| format!("{}: the cell is missing", at()));
        return None;
    }
    match cell(record, place).and_then(|text| text.parse::<f64>().ok()) {
        Some(number) if number.is_finite() => return Some(number),
        Some(_) => problems.note(|| format!("{}: `{}` is not finite", at(), shown(record, place))),
        None => problems.note(|| format!("{}: `{}` is not a number", at(), shown(record, place))),
    }
    None
}

/// An integer that fits 32 bits.
fn whole(record: &ByteRecord, place: usize, title: &str, line: &Line, problems: &mut Problems) -> Option<u32> {
    match cell(record, place).map(str::parse::<u32>) {
        Some(Ok(number)) => return Some(number),
        Some(Err(_)) => problems.note(|| {
            let most = u32::MAX;
            format!("{line}, column {title}: `{}` is not a whole number from 0 to {most}", shown(record, place))
        }),
        None => problems.note(|| format!("{line}, column {title}: the cell is missing")),
    }
    None
}

fn cell(record: &ByteRecord, place: usize) -> Option<&str> {
    record.get(place).and_then(|bytes| std::str::from_utf8(bytes).ok())
}

/// A cell for a message, shortened if necessary.
fn shown(record: &ByteRecord, place: usize) -> String {
    let text = String::from_utf8_lossy(record.get(place).unwrap_or_default());
    text.chars().take(40).collect()
}

/// The message for a name that is neither one of the titles nor of `others`.
pub(super) fn unknown(what: &str, title: &str, titles: &[Title<'_>], others: &[&'static str]) -> String {
    if title == "radius" {
        return format!("unknown {what} `radius`: the radius that is drawn is called `size`");
    }
    let known = || titles.iter().map(|known| known.text.as_str()).chain(others.iter().copied());
    let first = title.to_lowercase().chars().next();
    let like = known()
        .filter(|name| name.chars().next() == first)
        .map(|name| (strsim::damerau_levenshtein(&title.to_lowercase(), name), name))
        .min()
        .filter(|(distance, name)| *distance <= 1 + name.len() / 3);
    match like {
        Some((_, name)) => format!("unknown {what} `{title}`; did you mean `{name}`?"),
        None => format!("unknown {what} `{title}`; known are {}", known().collect::<Vec<_>>().join(", ")),
    }
}

/// Writes a header and one row per particle, in the order of the ids: `id,x,y,z,vx,vy,vz,mass`, `size` and `species` where any is not 0,
/// `life` where any is not active, and every other column of the state. Each number is the shortest decimal that reads back to the same
/// bits of the precision, even if it is read as f64 first.
///
/// # Errors
/// Those of `out`; a number that does not fit single precision, if that is requested.
pub fn write_csv(mut out: impl Write, state: &State, precision: Precision) -> io::Result<()> {
    /// Rows per piece of work, and pieces that are in memory at once: about 16 MB of text.
    const ROWS: usize = 4096;
    const PIECES: usize = 32;
    let (strips, ids) = (titles::strips(state), state.ids());
    titles::fit(&strips, state.len(), precision)?;
    let meant = |name: &str| match name {
        SHORT => Some("mass".to_owned()),
        NAME => Some("words that are passed over".to_owned()),
        _ => None,
    };
    titles::reserved(strips.iter().map(|strip| strip.text.as_str()), "CSV", meant)?;
    let header = strips.iter().fold(ID.to_owned(), |all, strip| all + "," + &strip.text);
    out.write_all(header.as_bytes())?;
    out.write_all(b"\n")?;
    let mut pieces: Vec<String> = vec![String::new(); PIECES];
    for start in (0..state.len()).step_by(ROWS * PIECES) {
        pieces.par_iter_mut().enumerate().for_each(|(piece, text)| {
            text.clear();
            let first = start + piece * ROWS;
            (first..state.len().min(first + ROWS)).for_each(|id| row(text, id, ids[id], &strips, precision));
        });
        for text in &pieces {
            out.write_all(text.as_bytes())?;
        }
    }
    Ok(())
}

fn row(text: &mut String, id: usize, name: u32, strips: &[Strip<'_>], precision: Precision) {
    // Writing into a String cannot fail.
    let _ = write!(text, "{name}");
    for strip in strips {
        text.push(',');
        strip.of(id).write(text, precision);
    }
    text.push('\n');
}
