//! Lists of numbers of a binary file, one for each title, before they become a state.

use super::problems::{Problems, order, ordered};
use super::{Contents, Heading, Input, titles};
use crate::error::Error;
use crate::kernel::{Column, Columns, Kind};
use crate::state::State;

/// The data of a file.
#[derive(Default)]
pub(super) struct Sheet {
    /// The contents, without the numbers.
    pub contents: Contents,
    /// The requested lists.
    pub lists: Vec<List>,
    /// The time of the state.
    pub time: f64,
    /// Its step.
    pub step: u64,
}

/// The numbers of one title.
pub(super) struct List {
    pub title: String,
    pub values: Vec<f64>,
    pub place: Place,
}

/// The positions of numbers in a file, for messages.
pub(super) enum Place {
    /// A number every `stride` bytes.
    Byte { first: u64, stride: u64 },
    /// An array of this name.
    Named(String),
}

impl Place {
    fn of(&self, row: usize) -> String {
        match self {
            Self::Byte { first, stride } => format!("byte {}", first + stride * row as u64),
            Self::Named(name) => format!("{name}[{row}]"),
        }
    }
}

/// The column of ids, under this title in every format.
pub(super) const ID: &str = "id";

/// Reads a state of these columns with a function that reads the requested lists. Lists without a column are skipped.
pub(super) fn read(
    path: &Input<'_>,
    columns: &Columns,
    sheet: impl FnOnce(&Input<'_>, &dyn Fn(&str) -> bool) -> Result<Sheet, Error>,
) -> Result<State, Error> {
    let known = titles::all(columns);
    let wanted = |title: &str| title == ID || known.iter().any(|known| known.text == title);
    let sheet = sheet(path, &wanted)?;
    let rows = sheet.contents.rows;
    let mut problems = Problems::default();
    let mut given: Vec<Option<Vec<f64>>> = known.iter().map(|_| None).collect();
    let mut ids: Option<(Vec<u64>, Place)> = None;
    let id = Column::new(ID, Kind::Whole, "", "");
    let id = titles::Title { text: ID.to_owned(), column: &id, place: 0 };
    for List { title, values, place } in sheet.lists {
        let slot = known.iter().position(|known| known.text == title);
        let about = slot.map_or(&id, |slot| &known[slot]);
        if values.len() != rows {
            problems.note(|| format!("`{title}` holds {} numbers for {rows} particles", values.len()));
        }
        for (row, value) in values.iter().enumerate() {
            if let Some(fault) = about.fault(*value) {
                problems.note(|| format!("{}: {title} is {value:?}, which {fault}", place.of(row)));
            }
        }
        let twice = match slot {
            Some(slot) => given[slot].replace(values).is_some(),
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "faults are noted")]
            None => ids.replace((values.iter().map(|id| *id as u64).collect(), place)).is_some(),
        };
        if twice {
            problems.note(|| format!("`{title}` is there twice"));
        }
    }
    for (title, list) in known.iter().zip(&given) {
        if title.column.name == "position" && list.is_none() {
            problems.note(|| format!("there is no `{}`: positions must be there", title.text));
        }
    }
    if !sheet.time.is_finite() {
        problems.note(|| format!("the time {} is not finite", sheet.time));
    }
    problems.stop(path)?;
    let mut state = titles::state(columns, given, rows);
    if let Some((ids, place)) = ids {
        let order = order(&ids, |row| place.of(row), &mut problems);
        problems.check(path)?;
        state = ordered(&state, &ids, &order);
    }
    (state.time, state.step) = (sheet.time, sheet.step);
    Ok(state)
}

/// Checks whether ids fit 32 bits.
///
/// # Errors
/// The first id that does not.
pub(super) fn narrow(ids: &[u64]) -> Result<(), String> {
    match ids.iter().enumerate().find(|(_, id)| **id >= u64::from(u32::MAX)) {
        Some((row, id)) => Err(format!("[{row}] is the id {id}; {}", titles::LARGE_ID)),
        None => Ok(()),
    }
}

/// The titles of an array of `components` numbers for each particle: those of the column of this name, if it has as many.
pub(super) fn titles_of(name: &str, components: usize) -> Vec<String> {
    let kind = match components {
        1 => Kind::Scalar,
        3 => Kind::Vector,
        4 => Kind::Quaternion,
        _ => return (0..components).map(|k| format!("{name}_{k}")).collect(),
    };
    let column = Column::new(name.to_owned(), kind, "", "");
    let titles: Vec<_> = titles::titles(&column).into_iter().map(|title| title.text).collect();
    // Positions and velocities have three.
    if titles.len() == components { titles } else { (0..components).map(|k| format!("{name}_{k}")).collect() }
}

impl Sheet {
    /// Adds a heading, and returns its numbers if they are wanted.
    pub fn enter(
        &mut self,
        title: &str,
        whole: bool,
        wanted: &dyn Fn(&str) -> bool,
        list: impl FnOnce() -> (Vec<f64>, Place),
    ) {
        if wanted(title) {
            let (values, place) = list();
            self.lists.push(List { title: title.to_owned(), values, place });
        }
        self.contents.headings.push(Heading { title: title.to_owned(), whole });
    }
}
