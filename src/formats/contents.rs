//! The contents of a file besides positions, velocities and masses.

use std::collections::BTreeMap;
use std::path::Path;

use super::{Input, input, of};
use crate::error::Error;
use crate::kernel::{Bounds, Column, Columns, Kind};

use super::titles;

/// The contents of a file, without its numbers.
#[derive(Debug, Clone, Default)]
pub struct Contents {
    /// The number of particles, if the header gives it.
    pub rows: usize,
    /// Its lists of numbers, one for each component of a column.
    pub headings: Vec<Heading>,
    /// The box, if it has one.
    pub bounds: Option<Bounds>,
    /// Data that readers skip, in words: `97026 edges`.
    pub left_out: Vec<String>,
}

/// A list of numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Heading {
    /// Its title: `x`, `mass`, `spin_x`.
    pub title: String,
    /// Whether its numbers are integers, and none is negative.
    pub whole: bool,
}

/// The contents of a file, without its numbers.
///
/// # Errors
/// [`Error::Input`] as for [`read`](super::read).
pub fn contents(path: &Path) -> Result<Contents, Error> {
    match of(path)? {
        Some(format) => (format.contents)(&Input::disk(path)),
        None => Err(input(path, "is not of a known format")),
    }
}

/// A count with its noun, in the plural where necessary.
pub(super) fn counted(count: u64, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}

/// More columns than this are left out, as a file of another kind may seem to have them.
const MOST: usize = 1000;

/// The columns of all simulations, and those for which a file has lists: `spin_x`, `spin_y` and `spin_z` form one column of vectors. Titles
/// that are no valid column names are left out.
#[must_use]
pub fn known(contents: &Contents) -> Columns {
    let usual = Columns::default();
    let usual = titles::all(&usual);
    let own: BTreeMap<&str, bool> = contents
        .headings
        .iter()
        .map(|heading| (heading.title.as_str(), heading.whole))
        .filter(|(title, _)| !["id", "name", "m"].contains(title) && !usual.iter().any(|known| known.text == *title))
        .collect();
    let mut columns = Vec::new();
    for (title, whole) in &own {
        let stem = |suffix: &str| title.strip_suffix(suffix).filter(|stem| !stem.is_empty());
        let all =
            |stem: &str, kind: Kind| kind.suffixes().iter().all(|s| own.contains_key(format!("{stem}{s}").as_str()));
        let vector = ["_x", "_y", "_z", "_w"].into_iter().find_map(stem).filter(|stem| all(stem, Kind::Vector));
        columns.push(match vector {
            Some(stem) if all(stem, Kind::Quaternion) => (stem, Kind::Quaternion),
            Some(stem) if !title.ends_with("_w") => (stem, Kind::Vector),
            _ => (*title, if *whole { Kind::Whole } else { Kind::Scalar }),
        });
    }
    columns.sort_by_key(|(name, _)| *name);
    columns.dedup_by_key(|(name, _)| *name);
    columns.truncate(MOST);
    let mut known = Columns::default();
    for (name, kind) in columns {
        let column = Column::new(name.to_owned(), kind, "", "a column of a file");
        if let Ok(more) = Columns::with(known.iter().skip(Columns::default().iter().count()).cloned().chain([column])) {
            known = more;
        }
    }
    known
}
