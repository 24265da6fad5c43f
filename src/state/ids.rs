//! Ids of particles: names that stay the same, whatever row holds their values.

use std::borrow::Cow;
use std::collections::BTreeSet;

#[cfg(feature = "scene")]
use super::KEPT_NEXT;
use super::{NONE, State};
use crate::error::Error;
use crate::kernel::{Array, ID};

impl State {
    /// The ids of the particles, by index; 0, 1, 2, … where none are given.
    #[must_use]
    pub fn ids(&self) -> Cow<'_, [u32]> {
        let places = || (0..u32::try_from(self.len()).unwrap_or(u32::MAX)).collect();
        self.whole(ID.name).map_or_else(|| Cow::Owned(places()), Cow::Borrowed)
    }
    /// Whether ids are given, separate from indices. Links, fixed particles, births and motions refer to particles by index in any case.
    #[must_use]
    pub fn has_ids(&self) -> bool {
        self.whole(ID.name).is_some()
    }
    /// Whether ids equal indices: 0, 1, 2, … without gaps.
    #[must_use]
    pub fn ids_are_places(&self) -> bool {
        self.whole(ID.name).is_none_or(|ids| ids.iter().zip(0..).all(|(id, place)| *id == place))
    }
    /// The index of a particle.
    #[must_use]
    pub fn place_of(&self, id: u32) -> Option<usize> {
        match self.whole(ID.name) {
            Some(ids) => ids.iter().position(|known| *known == id),
            None => usize::try_from(id).ok().filter(|place| *place < self.len()),
        }
    }
    /// Sets the ids of particles, by index.
    ///
    /// # Errors
    /// [`Error::Scene`] when their number differs, two are the same, or one is 4294967295, which is reserved.
    pub fn set_ids(&mut self, ids: Vec<u32>) -> Result<(), Error> {
        distinct(&ids)?;
        self.set(ID.name, Array::Uint(ids))
    }
    /// The lowest id that no particle has had: spawned particles get ids from here on.
    #[must_use]
    pub fn next_id(&self) -> u32 {
        let beyond = match self.whole(ID.name) {
            Some(ids) => ids.iter().filter(|id| **id != NONE).max().map_or(0, |id| id.saturating_add(1)),
            None => u32::try_from(self.len()).unwrap_or(u32::MAX),
        };
        beyond.max(self.next)
    }
    /// Takes the id counter out of the restart data of a file.
    #[cfg(feature = "scene")]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
    pub(crate) fn take_next(&mut self) {
        self.next = self.kept.get(KEPT_NEXT).and_then(|list| list.first()).map_or(0, |next| *next as u32);
        self.kept.put(KEPT_NEXT, Vec::new());
    }
    /// Gives unused ids to the last `count` particles, where ids are given.
    pub(super) fn name_last(&mut self, count: usize, next: u32) {
        if let Some(Array::Uint(ids)) = self.get_mut(ID.name) {
            let first = ids.len().saturating_sub(count);
            ids[first..].iter_mut().zip(next..).for_each(|(to, id)| *to = id);
        }
    }
}

/// Refuses duplicate and reserved ids.
///
/// # Errors
/// [`Error::Scene`] that names the id.
pub(crate) fn distinct(ids: &[u32]) -> Result<(), Error> {
    let mut known = BTreeSet::new();
    match ids.iter().find(|id| **id == u32::MAX || !known.insert(**id)) {
        Some(id) if *id == u32::MAX => Err(Error::Scene(format!("a particle has id {id}: ids are below that"))),
        Some(id) => Err(Error::Scene(format!("two particles have id {id}: give each its own"))),
        None => Ok(()),
    }
}
