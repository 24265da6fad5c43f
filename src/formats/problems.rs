//! All faults of a file, collected into one error.

use std::path::Path;

use super::titles;
use crate::error::Error;
use crate::kernel::{Array, Columns, ID};
use crate::state::State;

/// The number of faults that are shown.
const SHOWN: usize = 20;

/// A list of faults: the first are kept, the others counted.
#[derive(Debug, Default)]
pub(super) struct Problems {
    shown: Vec<String>,
    more: u64,
}

impl Problems {
    /// Records a fault. The text is only made if it will be shown.
    pub(super) fn note(&mut self, text: impl FnOnce() -> String) {
        if self.shown.len() < SHOWN {
            self.shown.push(text());
        } else {
            self.more += 1;
        }
    }

    /// Whether there are none.
    pub(super) fn none(&self) -> bool {
        self.shown.is_empty()
    }

    /// An error that lists them all so far, if there are any.
    pub(super) fn stop(&mut self, path: &Path) -> Result<(), Error> {
        if self.none() { Ok(()) } else { std::mem::take(self).check(path) }
    }

    /// An error that lists them all.
    pub(super) fn check(mut self, path: &Path) -> Result<(), Error> {
        if self.more > 0 {
            self.shown.push(format!("and {} more", self.more));
        }
        match self.shown.as_slice() {
            [] => Ok(()),
            [only] => Err(super::input(path, only)),
            all => Err(super::input(path, format!("\n  {}", all.join("\n  ")))),
        }
    }
}

/// The indices of rows in the order of their ids, each of which must occur once. `place` names a row.
pub(super) fn order(ids: &[u64], place: impl Fn(usize) -> String, problems: &mut Problems) -> Vec<usize> {
    let mut order: Vec<usize> = (0..ids.len()).collect();
    order.sort_by_key(|row| ids[*row]);
    let mut before = None;
    for row in &order {
        let id = ids[*row];
        match before {
            Some(other) if ids[other] == id => {
                problems.note(|| {
                    format!("{}: the id {id} is there already, at {}: ids must differ", place(*row), place(other))
                });
            }
            _ if id >= u64::from(u32::MAX) => {
                problems.note(|| format!("{}: the id {id} is too large: {}", place(*row), titles::LARGE_ID));
            }
            _ => {}
        }
        before = Some(*row);
    }
    order
}

/// The particles of a table in the order of their ids, with these ids unless they are 0, 1, 2, …
pub(super) fn ordered(state: &State, ids: &[u64], order: &[usize]) -> State {
    let mut state = state.picked(order);
    let ids: Vec<u32> = order.iter().filter_map(|row| u32::try_from(*ids.get(*row)?).ok()).collect();
    if ids.iter().zip(0..).any(|(id, place)| *id != place)
        && let Some(column) = Columns::default().get(ID.name)
    {
        state.put(column, Some(Array::Uint(ids)));
    }
    state
}
