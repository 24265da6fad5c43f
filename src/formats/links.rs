//! Links as comma-separated text. Columns `a,b` (ids), and any of `rest` \[length\], `stiffness` \[mass / time²\], `damping`
//! \[mass / time\] and `tie` (`spring`, `rope` or `rod`); lines that start with `#` are comments.

use std::collections::BTreeMap;
use std::io::{self, Write};

use ::csv::{ByteRecord, ReaderBuilder, Trim};
use glam::DVec3;

use super::line::Line;
use super::problems::Problems;
use super::{Input, input};
use crate::error::Error;
use crate::kernel::Bounds;
use crate::links::{Link, Links, Rod};

/// The kind of a link, as scenes and files call it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Tie {
    /// A spring.
    #[default]
    Spring,
    /// A rope: it only pulls.
    Rope,
    /// A rigid rod.
    Rod,
}

/// The defaults for links where a row gives no value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Usual {
    /// The kind of the link.
    pub tie: Tie,
    /// Its rest length, as a part of the distance of its ends.
    pub rest: f64,
    /// Its stiffness \[mass / time²\].
    pub stiffness: f64,
    /// Its damping \[mass / time\].
    pub damping: f64,
}

impl Tie {
    /// The names of the kinds.
    pub const NAMES: &'static [&'static str] = &["spring", "rope", "rod"];

    /// The kind of a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        let place = Self::NAMES.iter().position(|known| *known == name)?;
        [Self::Spring, Self::Rope, Self::Rod].get(place).copied()
    }
}

impl Usual {
    /// Adds a link between two particles, with the given rest length if there is one.
    pub fn tie(&self, links: &mut Links, ends: [u32; 2], distance: f64, rest: Option<f64>) {
        let rest = rest.unwrap_or(self.rest * distance);
        let (stiffness, damping) = (self.stiffness, self.damping);
        match self.tie {
            Tie::Rod => links.rods.push(Rod { ends, length: rest }),
            tie => links.springs.push(Link { ends, rest, stiffness, damping, rope: tie == Tie::Rope }),
        }
    }
}

const COLUMNS: [&str; 6] = ["a", "b", "rest", "stiffness", "damping", "tie"];

/// Reads links between particles at these positions, in this box: in a periodic box the length of a link is the minimum-image distance.
///
/// # Errors
/// [`Error::Input`] that lists all faults with their lines: unknown columns, cells that are not numbers or are negative, unknown ids, links
/// of a particle with itself, and duplicate links.
pub fn read(path: &Input<'_>, positions: &[DVec3], bounds: &Bounds, usual: &Usual) -> Result<Links, Error> {
    let (file, _) = path.open()?;
    let mut rows =
        ReaderBuilder::new().comment(Some(b'#')).flexible(true).trim(Trim::All).has_headers(false).from_reader(file);
    let failed = |error: ::csv::Error| input(path, error.to_string());
    let mut record = ByteRecord::new();
    if !rows.read_byte_record(&mut record).map_err(failed)? {
        return Err(input(path, "is empty; its first line must name the columns, such as a,b,rest,stiffness,damping"));
    }
    let mut problems = Problems::default();
    let (places, width) = (columns(&record, &mut problems), record.len());
    let (mut links, mut known) = (Links::default(), BTreeMap::new());
    while rows.read_byte_record(&mut record).map_err(failed)? {
        let line = Line::of(path, &record);
        if record.len() > width {
            problems.note(|| format!("{line}: {} cells, but {width} columns", record.len()));
            continue;
        }
        let row = Row { record: &record, line: &line, places: &places };
        let ends = [row.id(0, positions.len(), &mut problems), row.id(1, positions.len(), &mut problems)];
        let numbers = [2, 3, 4].map(|column| row.number(column, &mut problems));
        let tie = row.tie(usual.tie, &mut problems);
        let [Some(a), Some(b)] = ends else { continue };
        if a == b {
            problems.note(|| format!("{line}: particle {a} is linked to itself"));
            continue;
        }
        let [rest, stiffness, damping] = numbers;
        let own = Usual {
            tie,
            stiffness: stiffness.unwrap_or(usual.stiffness),
            damping: damping.unwrap_or(usual.damping),
            ..*usual
        };
        let mut one = Links::default();
        own.tie(&mut one, [a, b], bounds.shortest(positions[b as usize] - positions[a as usize]).length(), rest);
        let what = format!("{line}: the link of {a} and {b}");
        let faults =
            one.springs.iter().map(|link| link.check(&what)).chain(one.rods.iter().map(|rod| rod.check(&what)));
        faults.filter_map(Result::err).for_each(|fault| problems.note(|| fault.to_string()));
        links.append(&one, 0);
        if let Some(before) = known.insert((a.min(b), a.max(b), tie == Tie::Rod), line) {
            problems.note(|| {
                format!("{line}: particles {a} and {b} are linked again, after {before}: remove one of the two")
            });
        }
    }
    problems.check(path)?;
    Ok(links)
}

fn columns(header: &ByteRecord, problems: &mut Problems) -> [Option<usize>; 6] {
    let mut places = [None; 6];
    for place in 0..header.len() {
        let title = text(header, place);
        match COLUMNS.iter().position(|known| *known == title) {
            Some(column) if places[column].is_none() => places[column] = Some(place),
            Some(_) => problems.note(|| format!("the column `{title}` is there twice: remove one of them")),
            None => problems.note(|| format!("unknown column `{title}`; known are {}", COLUMNS.join(", "))),
        }
    }
    for (title, _) in COLUMNS.iter().zip(&places).take(2).filter(|(_, place)| place.is_none()) {
        problems.note(|| format!("the column `{title}` is missing; the first line must name a and b"));
    }
    places
}

fn text(record: &ByteRecord, place: usize) -> String {
    String::from_utf8_lossy(record.get(place).unwrap_or_default()).chars().take(40).collect()
}

struct Row<'a> {
    record: &'a ByteRecord,
    line: &'a Line<'a>,
    places: &'a [Option<usize>; 6],
}

impl Row<'_> {
    fn cell(&self, column: usize) -> Option<String> {
        let place = self.places[column]?;
        Some(text(self.record, place)).filter(|text| !text.is_empty())
    }
    fn id(&self, column: usize, count: usize, problems: &mut Problems) -> Option<u32> {
        self.places[column]?;
        let (line, title) = (self.line, COLUMNS[column]);
        let Some(cell) = self.cell(column) else {
            problems.note(|| format!("{line}, column {title}: the cell is missing"));
            return None;
        };
        match cell.parse::<u32>() {
            Ok(id) if (id as usize) < count => return Some(id),
            Ok(id) => problems
                .note(|| format!("{line}, column {title}: there is no particle {id}; there are {count}, from 0 on")),
            Err(_) => problems.note(|| format!("{line}, column {title}: `{cell}` is not the id of a particle")),
        }
        None
    }
    fn number(&self, column: usize, problems: &mut Problems) -> Option<f64> {
        let (line, title, cell) = (self.line, COLUMNS[column], self.cell(column)?);
        match cell.parse::<f64>() {
            Ok(number) if number >= 0.0 && number.is_finite() => return Some(number),
            Ok(number) => {
                problems.note(|| format!("{line}, column {title}: {number} is not a finite number, zero or above"));
            }
            Err(_) => problems.note(|| format!("{line}, column {title}: `{cell}` is not a number")),
        }
        None
    }
    fn tie(&self, usual: Tie, problems: &mut Problems) -> Tie {
        let Some(cell) = self.cell(5) else { return usual };
        Tie::from_name(&cell).unwrap_or_else(|| {
            let (line, known) = (self.line, Tie::NAMES.join(", "));
            problems.note(|| format!("{line}, column tie: `{cell}` is none of {known}"));
            usual
        })
    }
}

/// Writes springs, ropes and rods: a header and one row for each, with the digits that read back to the same numbers.
/// Joints and triangles are not written.
///
/// # Errors
/// Those of `out`.
pub fn write(mut out: impl Write, links: &Links) -> io::Result<()> {
    writeln!(out, "{}", COLUMNS.join(","))?;
    for Link { ends: [a, b], rest, stiffness, damping, rope } in &links.springs {
        let tie = if *rope { "rope" } else { "spring" };
        writeln!(out, "{a},{b},{rest:?},{stiffness:?},{damping:?},{tie}")?;
    }
    for Rod { ends: [a, b], length } in &links.rods {
        writeln!(out, "{a},{b},{length:?},,,rod")?;
    }
    Ok(())
}
