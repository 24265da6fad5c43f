//! Links as comma-separated text. Columns `a,b` (ids), and any of `c`, `d` (ids, too), `rest` \[length\], `stiffness` \[mass / time²; energy\],
//! `damping` \[mass / time\], `tie` (`spring`, `rope`, `rod`; `joint`, with `c`; `dihedral`, with `c` and `d`), `angle` and `phase`
//! \[degrees\] and `multiplicity`; lines that start with `#` are comments.

use std::collections::BTreeMap;
use std::io::{self, Write};

use ::csv::{ByteRecord, ReaderBuilder, Trim};
use glam::DVec3;

use super::line::Line;
use super::problems::Problems;
use super::{Input, input};
use crate::error::Error;
use crate::kernel::Bounds;
use crate::links::{Dihedral, Joint, Link, Links, Rod};

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
    /// A joint of three.
    Joint,
    /// A dihedral of four.
    Dihedral,
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
    /// The angle at rest between the two bonds of a joint \[degrees\].
    pub angle: f64,
    /// The number of maxima in a turn of a dihedral.
    pub multiplicity: u32,
    /// The phase of a dihedral \[degrees\].
    pub phase: f64,
}

impl Tie {
    /// The names of the kinds.
    pub const NAMES: &'static [&'static str] = &["spring", "rope", "rod", "joint", "dihedral"];
    const ALL: [Self; 5] = [Self::Spring, Self::Rope, Self::Rod, Self::Joint, Self::Dihedral];

    /// The kind of a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        let place = Self::NAMES.iter().position(|known| *known == name)?;
        Self::ALL.get(place).copied()
    }
    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::ALL
            .iter()
            .position(|tie| *tie == self)
            .and_then(|place| Self::NAMES.get(place))
            .copied()
            .unwrap_or("link")
    }
    /// The columns of numbers that it has not.
    pub(crate) fn lacks(self) -> &'static [&'static str] {
        match self {
            Self::Spring | Self::Rope | Self::Rod => &["angle", "multiplicity", "phase"],
            Self::Joint => &["rest", "damping", "multiplicity", "phase"],
            Self::Dihedral => &["rest", "damping", "angle"],
        }
    }
    /// The number of particles that it ties.
    #[must_use]
    pub fn ids(self) -> usize {
        match self {
            Self::Spring | Self::Rope | Self::Rod => 2,
            Self::Joint => 3,
            Self::Dihedral => 4,
        }
    }
}

impl Usual {
    /// Adds a link between particles, with the given rest length if there is one; `positions` are those of all particles.
    pub fn tie(&self, links: &mut Links, ids: &[u32], positions: &[DVec3], bounds: &Bounds, rest: Option<f64>) {
        let stiffness = self.stiffness;
        match *ids {
            [a, b] => {
                let at = |id: u32| positions.get(id as usize).copied().unwrap_or_default();
                let rest = rest.unwrap_or_else(|| self.rest * bounds.shortest(at(b) - at(a)).length());
                match self.tie {
                    Tie::Rod => links.rods.push(Rod { ends: [a, b], length: rest }),
                    tie => {
                        let (damping, rope) = (self.damping, tie == Tie::Rope);
                        links.springs.push(Link { ends: [a, b], rest, stiffness, damping, rope });
                    }
                }
            }
            [a, b, c] => {
                links.joints.push(Joint { ids: [a, b, c], stiffness, rest: (180.0 - self.angle).to_radians() });
            }
            [a, b, c, d] => {
                let (multiplicity, phase) = (self.multiplicity, self.phase.to_radians());
                links.dihedrals.push(Dihedral { ids: [a, b, c, d], stiffness, multiplicity, phase });
            }
            _ => {}
        }
    }
}

const COLUMNS: [&str; 11] =
    ["a", "b", "c", "d", "rest", "stiffness", "damping", "tie", "angle", "multiplicity", "phase"];

/// The place of a column.
fn column(title: &str) -> usize {
    COLUMNS.iter().position(|known| *known == title).unwrap_or(COLUMNS.len())
}

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
        let tie = row.tie(usual.tie, &mut problems);
        let ids = row.ids(tie, positions.len(), &mut problems);
        let signed = if tie == Tie::Dihedral { f64::NEG_INFINITY } else { 0.0 };
        let mut number = |title: &str, least: f64| row.number(title, least, &mut problems);
        let (rest, stiffness, damping) = (number("rest", 0.0), number("stiffness", signed), number("damping", 0.0));
        let (angle, multiplicity) = (number("angle", 0.0), number("multiplicity", 0.0));
        let phase = number("phase", f64::NEG_INFINITY);
        let Some(ids) = ids else { continue };
        if let Some((_, id)) = ids.iter().enumerate().find(|(place, id)| ids[..*place].contains(id)) {
            problems.note(|| format!("{line}: particle {id} is linked to itself"));
            continue;
        }
        let most = f64::from(Dihedral::MOST);
        let multiplicity = multiplicity.filter(|x| {
            let fits = x.fract() == 0.0 && (1.0..=most).contains(x);
            if !fits {
                problems.note(|| format!("{line}, column multiplicity: {x} is not a whole number from 1 to {most}"));
            }
            fits
        });
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, and below 13")]
        let multiplicity = multiplicity.map(|x| x as u32);
        let own = Usual {
            tie,
            rest: usual.rest,
            stiffness: stiffness.unwrap_or(usual.stiffness),
            damping: damping.unwrap_or(usual.damping),
            angle: angle.unwrap_or(usual.angle),
            multiplicity: multiplicity.unwrap_or(usual.multiplicity),
            phase: phase.unwrap_or(usual.phase),
        };
        let mut one = Links::default();
        own.tie(&mut one, &ids, positions, bounds, rest);
        let named: Vec<_> = ids.iter().map(u32::to_string).collect();
        let noun = if tie.ids() > 2 { tie.name() } else { "link" };
        let what = format!("{line}: the {noun} of {}", named.join(if tie.ids() > 2 { ", " } else { " and " }));
        faults(&one, &what).for_each(|fault| problems.note(|| fault.to_string()));
        links.append(&one, 0);
        let [a, b] = ids[..] else { continue };
        if let Some(before) = known.insert((a.min(b), a.max(b), tie == Tie::Rod), line) {
            problems.note(|| {
                format!("{line}: particles {a} and {b} are linked again, after {before}: remove one of the two")
            });
        }
    }
    problems.check(path)?;
    Ok(links)
}

/// All that is wrong with the numbers of links, each called `what`.
fn faults(links: &Links, what: &str) -> impl Iterator<Item = Error> {
    let springs = links.springs.iter().map(|link| link.check(what));
    let rods = links.rods.iter().map(|rod| rod.check(what));
    let joints = links.joints.iter().map(|joint| joint.check(what));
    let dihedrals = links.dihedrals.iter().map(|dihedral| dihedral.check(what));
    springs.chain(rods).chain(joints).chain(dihedrals).filter_map(Result::err)
}

fn columns(header: &ByteRecord, problems: &mut Problems) -> [Option<usize>; COLUMNS.len()] {
    let mut places = [None; COLUMNS.len()];
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
    places: &'a [Option<usize>; COLUMNS.len()],
}

impl Row<'_> {
    fn cell(&self, column: usize) -> Option<String> {
        let place = self.places[column]?;
        Some(text(self.record, place)).filter(|text| !text.is_empty())
    }
    /// The ids of a link of this kind; `None` where they are wrong.
    fn ids(&self, tie: Tie, count: usize, problems: &mut Problems) -> Option<Vec<u32>> {
        let ids: Vec<_> = (0..4).map(|column| (column < tie.ids()).then(|| self.id(column, count, problems))).collect();
        for (column, title) in COLUMNS.iter().enumerate().take(4).skip(tie.ids()) {
            if let (Some(cell), line) = (self.cell(column), self.line) {
                let (tie, number) = (tie.name(), tie.ids());
                problems.note(|| {
                    format!("{line}, column {title}: `{cell}` is too many: a {tie} has {number} particles, and this cell stays empty")
                });
            }
        }
        for title in tie.lacks() {
            if let (Some(cell), line) = (self.cell(column(title)), self.line) {
                let tie = tie.name();
                problems.note(|| format!("{line}, column {title}: `{cell}` has no effect on a {tie}: leave it empty"));
            }
        }
        ids.into_iter().flatten().collect()
    }
    fn id(&self, column: usize, count: usize, problems: &mut Problems) -> Option<u32> {
        if column < 2 {
            self.places[column]?;
        }
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
    fn number(&self, title: &str, least: f64, problems: &mut Problems) -> Option<f64> {
        let (line, cell) = (self.line, self.cell(column(title))?);
        let rule = if least == 0.0 { ", zero or above" } else { "" };
        match cell.parse::<f64>() {
            Ok(number) if number >= least && number.is_finite() => return Some(number),
            Ok(number) => {
                problems.note(|| format!("{line}, column {title}: {number} is not a finite number{rule}"));
            }
            Err(_) => problems.note(|| format!("{line}, column {title}: `{cell}` is not a number")),
        }
        None
    }
    fn tie(&self, usual: Tie, problems: &mut Problems) -> Tie {
        let Some(cell) = self.cell(column("tie")) else { return usual };
        Tie::from_name(&cell).unwrap_or_else(|| {
            let (line, known) = (self.line, Tie::NAMES.join(", "));
            problems.note(|| format!("{line}, column tie: `{cell}` is none of {known}"));
            usual
        })
    }
}

/// Writes springs, ropes, rods, joints and dihedrals: a header and one row for each, with the digits that read back to the same numbers,
/// angles to rounding. Triangles are not written.
///
/// # Errors
/// Those of `out`.
pub fn write(mut out: impl Write, links: &Links) -> io::Result<()> {
    // Files of springs alone have the columns that these need.
    let angles = !(links.joints.is_empty() && links.dihedrals.is_empty());
    let (more, last) = if angles { (",,", ",,,") } else { ("", "") };
    writeln!(out, "{}", if angles { COLUMNS.join(",") } else { "a,b,rest,stiffness,damping,tie".to_owned() })?;
    for Link { ends: [a, b], rest, stiffness, damping, rope } in &links.springs {
        let tie = if *rope { "rope" } else { "spring" };
        writeln!(out, "{a},{b}{more},{rest:?},{stiffness:?},{damping:?},{tie}{last}")?;
    }
    for Rod { ends: [a, b], length } in &links.rods {
        writeln!(out, "{a},{b}{more},{length:?},,,rod{last}")?;
    }
    for Joint { ids: [a, b, c], stiffness, rest } in &links.joints {
        writeln!(out, "{a},{b},{c},,,{stiffness:?},,joint,{:?},,", 180.0 - rest.to_degrees())?;
    }
    for Dihedral { ids: [a, b, c, d], stiffness, multiplicity, phase } in &links.dihedrals {
        writeln!(out, "{a},{b},{c},{d},,{stiffness:?},,dihedral,,{multiplicity},{:?}", phase.to_degrees())?;
    }
    Ok(())
}
