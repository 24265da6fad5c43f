//! Appending a state, and selecting particles of a state.

use std::collections::BTreeSet;

use super::State;
use crate::error::Error;
use crate::kernel::{Array, ID, Shape};
use crate::life::Birth;
use crate::motion::{Held, Hold};

impl State {
    /// Adds all particles of another state; they keep their ids if none of these is taken, and otherwise get the next unused ones. Columns
    /// that only one of them gives have their initial values in the other. Time and step are unchanged.
    ///
    /// # Errors
    /// [`Error::Scene`] when both have a column of one name and different kinds, or one gives a column that every particle must
    /// be given, and the other does not; or when they have different floor plans.
    pub fn append(&mut self, other: &Self) -> Result<(), Error> {
        if self.floor_plan.is_some() && other.floor_plan.is_some() && self.floor_plan != other.floor_plan {
            return Err(Error::Scene(
                "both states have a floor plan, and there is one at most: join their polygons".to_owned(),
            ));
        }
        let (before, added, had_ids) = (self.len(), other.len(), self.has_ids());
        let first = u32::try_from(before).unwrap_or(u32::MAX);
        let next = self.next_id();
        let taken: BTreeSet<u32> = self.ids().iter().copied().collect();
        let keep = other.has_ids() && !other.ids().iter().any(|id| taken.contains(id));
        self.kept.clear();
        other.declared().try_for_each(|column| self.declare(column))?;
        for filled in self.columns.iter_mut().filter(|filled| !matches!(filled.column.shape, Shape::System(_))) {
            let column = &filled.column;
            let missing = |count: usize| match column.initial {
                None if count > 0 => Err(Error::Scene(format!(
                    "the column `{}` has no initial value, and {count} particles are not given one: give it to all",
                    column.name
                ))),
                _ => Ok(column.array(count)),
            };
            match (&mut filled.values, other.get(&column.name)) {
                (None, None) => {}
                (Some(values), Some(more)) => values.extend(more),
                (Some(values), None) => values.extend(&missing(added)?),
                (values @ None, Some(more)) => {
                    let mut all = missing(before)?;
                    all.extend(more);
                    *values = Some(all);
                }
            }
        }
        if let (Some(Array::Uint(ids)), false) = (self.get_mut(ID.name), had_ids) {
            ids[..before].iter_mut().zip(0..).for_each(|(to, id)| *to = id);
        }
        if keep {
            self.next = self.next.max(other.next);
        } else {
            self.name_last(added, next);
        }
        self.links.append(&other.links, first);
        let motions = u32::try_from(self.motions.len()).unwrap_or(u32::MAX);
        let by = |by| if let Hold::Motion(n) = by { Hold::Motion(n.saturating_add(motions)) } else { by };
        let held = |held: &Held| Held { id: held.id.saturating_add(first), by: by(held.by) };
        self.held.extend(other.held.iter().map(held));
        self.motions.extend_from_slice(&other.motions);
        let emitters = self.births.iter().map(|birth| birth.emitter.saturating_add(1)).max().unwrap_or(0);
        let later = |birth: &Birth| {
            let (id, emitter) = (birth.id.saturating_add(first), birth.emitter.saturating_add(emitters));
            Birth { id, emitter, ..*birth }
        };
        self.births.extend(other.births.iter().map(later));
        self.drains.extend_from_slice(&other.drains);
        if self.floor_plan.is_none() {
            self.floor_plan.clone_from(&other.floor_plan);
        }
        Ok(())
    }
    /// The particles at these indices, each given once, in this order, with their ids; and the links, births, and fixed and kinematic
    /// particles among these.
    #[must_use]
    pub fn picked(&self, order: &[usize]) -> Self {
        let mut picked = self.clone();
        picked.kept.clear();
        for (column, values) in picked.particle_columns() {
            *values = values.picked(order, column.shape.len(1));
        }
        let mut places = vec![u32::MAX; self.len()];
        order.iter().zip(0..).for_each(|(old, new)| places[*old] = new);
        let new = |id: u32| places.get(id as usize).copied().filter(|new| *new < u32::MAX);
        picked.links = self.links.renumbered(&new);
        picked.held = self.held.iter().filter_map(|one| Some(Held { id: new(one.id)?, ..*one })).collect();
        picked.births = self.births.iter().filter_map(|one| Some(Birth { id: new(one.id)?, ..*one })).collect();
        picked
    }
}
