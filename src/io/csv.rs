//! Text in columns that commas or blanks separate. Columns `x,y,z`, and any of `vx,vy,vz` (0 when left out), `mass` (1), `radius` (0), `species` (0), `life`
//! (1: it lives; 0: it is yet to be born; 2: it is dead), `id` and `name`; `m` is `mass`. Lines that start with `#` are comments;
//! the last one before a first row of numbers names the columns, where it has as many words.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::path::Path;

use ::csv::ByteRecord;
use glam::DVec3;
use rayon::prelude::*;

use super::line::Line;
use super::problems::{Problems, order};
use super::rows::{self, Opened};
use super::{Precision, input, open};
use crate::error::Error;
use crate::life::Life;
use crate::state::State;

/// The columns with numbers, and what they are when left out.
pub(super) const NUMBERS: [(&str, f64); 8] =
    [("x", 0.0), ("y", 0.0), ("z", 0.0), ("vx", 0.0), ("vy", 0.0), ("vz", 0.0), ("mass", 1.0), ("radius", 0.0)];
/// What else a mass is called.
const SHORT: &str = "m";
const ID: &str = "id";
const SPECIES: &str = "species";
const LIFE: &str = "life";
const NAME: &str = "name";

/// Reads particles. With a column `id` the rows may come in any order; ids count from 0.
///
/// # Errors
/// [`Error::Input`] that lists, with line and column, every cell that is missing, no number, not finite, or negative where
/// that makes no sense; every column that is unknown, missing or given twice; every id that is missing or given twice.
pub fn read(path: &Path) -> Result<State, Error> {
    let (file, _) = open(path)?;
    let mut problems = Problems::default();
    let mut record = ByteRecord::new();
    let failed = |error: io::Error| input(path, error.to_string());
    let Opened { mut rows, titles, bare } = rows::open(file).map_err(failed)?;
    if titles.is_none() && !rows.next(&mut record).map_err(failed)? {
        return Err(input(path, "is empty; its first line must name the columns, such as x,y,z,vx,vy,vz,mass"));
    }
    if titles.is_none() && bare {
        return Err(input(path, unnamed(&record)));
    }
    let columns = Columns::named(titles.as_ref().unwrap_or(&record), &mut problems);
    let (mut particles, mut ids, mut lines) = (State::default(), Vec::new(), Vec::new());
    let (mut species, mut lives) = (Vec::new(), Vec::new());
    while rows.next(&mut record).map_err(failed)? {
        let line = Line::of(path, &record);
        if record.len() > columns.count {
            problems.note(|| format!("{line}: {} cells, but {} columns", record.len(), columns.count));
        }
        let [x, y, z, vx, vy, vz, mass, radius] = columns.numbers(&record, &line, &mut problems);
        particles.push(DVec3::new(x, y, z), DVec3::new(vx, vy, vz), mass, radius);
        let of = columns.species.and_then(|place| whole(&record, place, SPECIES, &line, &mut problems));
        species.push(of.unwrap_or_default());
        if let Some(place) = columns.life {
            let word = whole(&record, place, LIFE, &line, &mut problems);
            let life = word.and_then(Life::of);
            if let (Some(word), None) = (word, life) {
                problems
                    .note(|| format!("{line}, column {LIFE}: {word} is none of 0 (waits), 1 (lives) and 2 (is dead)"));
            }
            lives.push(life.unwrap_or_default());
        }
        if let Some(id) = columns.id.and_then(|place| whole(&record, place, ID, &line, &mut problems)) {
            ids.push(u64::from(id));
            lines.push(line);
        }
    }
    particles.species_mut().copy_from_slice(&species);
    if columns.life.is_some() {
        particles.set_lives(&lives)?;
    }
    if columns.id.is_none() {
        problems.check(path)?;
        return Ok(particles);
    }
    // Ids that could not be read have been noted; gaps would only repeat them.
    if ids.len() == particles.len() {
        let order = order(&ids, |row| lines[row].to_string(), &mut problems);
        problems.check(path)?;
        return Ok(particles.picked(&order));
    }
    problems.check(path)?;
    Ok(particles)
}

/// What to say of a table whose first row is numbers.
fn unnamed(record: &ByteRecord) -> String {
    if record.len() == 1 {
        return "begins with a line of one number, as an XYZ file does, which motes does not read: make it a table whose first line \
                names the columns, such as x,y,z,vx,vy,vz,mass"
            .to_owned();
    }
    format!(
        "its first line is {} numbers, and nothing tells what they are: put a line before it that names the columns, such as \
         mass x y z vx vy vz, with `#` or without",
        record.len()
    )
}

/// Where each column is.
struct Columns {
    count: usize,
    numbers: [Option<usize>; 8],
    id: Option<usize>,
    species: Option<usize>,
    life: Option<usize>,
}

impl Columns {
    fn named(header: &ByteRecord, problems: &mut Problems) -> Self {
        let mut columns = Self { count: header.len(), numbers: [None; 8], id: None, species: None, life: None };
        let mut name = None;
        for place in 0..header.len() {
            let title = shown(header, place);
            let title = if title == SHORT { "mass".to_owned() } else { title };
            let slot = match NUMBERS.iter().position(|(known, _)| *known == title) {
                Some(number) => &mut columns.numbers[number],
                None if title == ID => &mut columns.id,
                None if title == SPECIES => &mut columns.species,
                None if title == LIFE => &mut columns.life,
                None if title == NAME => &mut name,
                None => {
                    problems.note(|| unknown("column", &title, &[SPECIES, LIFE, ID, NAME]));
                    continue;
                }
            };
            if slot.replace(place).is_some() {
                problems.note(|| format!("the column `{title}` is there twice"));
            }
        }
        for ((title, _), place) in NUMBERS.iter().zip(columns.numbers).take(3) {
            if place.is_none() {
                problems.note(|| format!("the column `{title}` is missing; the first line must name x, y and z"));
            }
        }
        columns
    }

    fn numbers(&self, record: &ByteRecord, line: &Line, problems: &mut Problems) -> [f64; 8] {
        let mut values = NUMBERS.map(|(_, default)| default);
        for ((value, (title, _)), place) in values.iter_mut().zip(NUMBERS).zip(self.numbers) {
            let Some(place) = place else { continue };
            let at = || format!("{line}, column {title}");
            let text = record.get(place).unwrap_or_default();
            if text.is_empty() {
                problems.note(|| format!("{}: the cell is missing", at()));
                continue;
            }
            match cell(record, place).and_then(|text| text.parse::<f64>().ok()) {
                Some(number) if number.is_finite() => {
                    *value = number;
                    if number < 0.0 && matches!(title, "mass" | "radius") {
                        problems.note(|| format!("{}: {number} is below 0", at()));
                    }
                }
                Some(_) => {
                    problems.note(|| format!("{}: `{}` is not finite", at(), shown(record, place)));
                }
                None => {
                    problems.note(|| format!("{}: `{}` is not a number", at(), shown(record, place)));
                }
            }
        }
        values
    }
}

/// A whole number that fits 32 bits.
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

/// A cell for a message: no longer than a message may be.
fn shown(record: &ByteRecord, place: usize) -> String {
    let text = String::from_utf8_lossy(record.get(place).unwrap_or_default());
    text.chars().take(40).collect()
}

/// What to say about a name that is neither one of [`NUMBERS`] nor of `others`.
pub(super) fn unknown(what: &str, title: &str, others: &[&'static str]) -> String {
    let known = || NUMBERS.iter().map(|(name, _)| *name).chain(others.iter().copied());
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

/// Writes a header and one row per particle, in the order of the ids: `id,x,y,z,vx,vy,vz,mass`, `species` where any is not 0, and
/// `life` where any does not live. Each number is the shortest decimal that reads back to the same bits of the precision, also where it is read as f64
/// first; radii are not written.
///
/// # Errors
/// Those of `out`.
pub fn write_csv(mut out: impl Write, particles: &State, precision: Precision) -> io::Result<()> {
    /// Rows per piece of work, and pieces that are in memory at once: about 16 MB of text.
    const ROWS: usize = 4096;
    const PIECES: usize = 32;
    let species = particles.species().iter().any(|species| *species != 0);
    out.write_all(b"id,x,y,z,vx,vy,vz,mass")?;
    let mortal = particles.life().iter().any(|life| *life != Life::Living);
    out.write_all(if species { b",species" } else { b"" })?;
    out.write_all(if mortal { b",life\n" } else { b"\n" })?;
    let mut pieces: Vec<String> = vec![String::new(); PIECES];
    for start in (0..particles.len()).step_by(ROWS * PIECES) {
        pieces.par_iter_mut().enumerate().for_each(|(piece, text)| {
            text.clear();
            let first = start + piece * ROWS;
            for id in first..particles.len().min(first + ROWS) {
                row(text, id, particles, precision);
                if species {
                    let _ = write!(text, ",{}", particles.species()[id]);
                }
                if mortal {
                    let _ = write!(text, ",{}", particles.life().get(id).copied().unwrap_or_default().word());
                }
                text.push('\n');
            }
        });
        for text in &pieces {
            out.write_all(text.as_bytes())?;
        }
    }
    Ok(())
}

fn row(text: &mut String, id: usize, particles: &State, precision: Precision) {
    let (x, v) = (particles.position()[id], particles.velocity()[id]);
    // Writing into a String cannot fail. `{:?}` is the shortest decimal that reads back, with an exponent where that is shorter.
    let _ = write!(text, "{id}");
    for number in [x.x, x.y, x.z, v.x, v.y, v.z, particles.mass()[id]] {
        let start = text.len();
        match precision {
            Precision::Single => {
                #[expect(clippy::cast_possible_truncation, reason = "single precision was asked for")]
                let single = number as f32;
                let _ = write!(text, ",{single:?}");
                if !reads_back(&text[start + 1..], single) {
                    text.truncate(start);
                    let _ = write!(text, ",{:?}", f64::from(single));
                }
            }
            Precision::Double => {
                let _ = write!(text, ",{number:?}");
            }
        }
    }
}

/// Whether a reader that knows only f64 finds the same f32 when it narrows: rounding twice is not always rounding once. Of all
/// f32 only ±7.038531e-26 is lost, half way between two of them for an f64.
fn reads_back(text: &str, single: f32) -> bool {
    #[expect(clippy::cast_possible_truncation, reason = "this is the question")]
    text.parse::<f64>().is_ok_and(|wide| (wide as f32).to_bits() == single.to_bits())
}
