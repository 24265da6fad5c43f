//! Spawning and removing particles: new ones are put into free rows, which the plan covers already, and removed ones leave theirs free.

use std::collections::BTreeSet;

use glam::DVec4;

use super::Simulation;
use super::grow::Room;
use crate::boundary;
use crate::crowds;
use crate::error::Error;
use crate::kernel::{ACCELERATION, Array, Backend, Column, ID, LIFE, Machine, POSITION, Role, Shape, VELOCITY};
use crate::life::Life;
use crate::neighbors::{LIST, LIST_ORIGIN};
use crate::state::{NONE, State, parked};

impl<B: Backend> Simulation<B> {
    /// Adds particles between two steps, and returns their ids in order. All their columns that the simulation has are copied;
    /// other columns have their initial values. Ids are never reused, and rows of removed particles are.
    ///
    /// Within [`Simulation::capacity`] nothing is compiled. Beyond it the simulation makes room for half as many rows more: its plan is
    /// recompiled and buffers of the device are others, as [`Simulation::generation`] shows. The next step begins with the
    /// accelerations of all particles that there are then.
    ///
    /// # Errors
    /// [`Error::Scene`] when particles are linked, fixed or yet to be spawned, lack a column without an initial value, have one that is
    /// unknown, or a number that is not finite; when a law does not serve removed particles. [`Error::Limit`] when a device does not hold so
    /// many rows. Nothing has changed then.
    pub async fn spawn(&mut self, new: &State) -> Result<Vec<u32>, Error> {
        self.welcome(new)?;
        let count = u32::try_from(new.len()).unwrap_or(u32::MAX);
        let next = self.rows.next();
        let Some(end) = next.checked_add(count).filter(|end| *end < NONE) else {
            return Err(Error::Scene(format!("{next} ids are given, and {count} more are none: ids end at {NONE}")));
        };
        if count == 0 {
            return Ok(Vec::new());
        }
        self.settle().await?;
        self.reclaim().await?;
        let short = count.saturating_sub(u32::try_from(self.rows.room()).unwrap_or(u32::MAX));
        if short > 0 || !self.rows.are_open() {
            let had = self.capacity();
            let more = if short > 0 { short.max(had / 2) } else { 0 };
            let Some(rows) = had.checked_add(more) else {
                return Err(Error::Limit(format!("{had} rows and {short} more are beyond {}", u32::MAX)));
            };
            self.grow(Room::Rows(rows)).await?;
        }
        self.unrepeatable();
        let ids: Vec<u32> = (next..end).collect();
        let rows = self.rows.lowest(new.len());
        let before = self.count();
        self.rows.fill(&rows, &ids);
        self.put(new, &rows, &ids)?;
        self.changed_hands(&rows, before)?;
        self.backend.set_rows(self.count(), self.capacity() - self.count())?;
        self.begun = false;
        self.largest = self.setup.with_state(new.clone()).largest(&self.largest);
        Ok(ids)
    }
    /// Removes particles between two steps. Their ids are not reused, and their rows are free.
    ///
    /// # Errors
    /// [`Error::Scene`] when an id is unknown, named twice, or that of a particle that has been removed or is linked, fixed or kinematic;
    /// when a law does not serve removed particles. Nothing has changed then.
    pub async fn remove(&mut self, ids: &[u32]) -> Result<(), Error> {
        let refuse = |text: String| Err(Error::Scene(text));
        self.settle().await?;
        let mut known = BTreeSet::new();
        let removed = if self.removes() { self.life().await? } else { Vec::new() };
        let bound = self.ties.bound();
        let mut rows = Vec::new();
        for id in ids {
            if !known.insert(*id) {
                return refuse(format!("particle {id} is to be removed twice: name it once"));
            }
            let gone = |row: &u32| removed.get(*row as usize).is_some_and(|life| *life == Life::Removed);
            match self.rows.row(*id).filter(|row| !gone(row)) {
                Some(row) if bound.contains(&row) => {
                    return refuse(format!(
                        "particle {id} is linked, fixed or kinematic, and cannot be removed: choose others"
                    ));
                }
                Some(row) => rows.push(row),
                None if *id < self.rows.next() => return refuse(format!("particle {id} has been removed already")),
                None => {
                    let last = self.rows.next().saturating_sub(1);
                    return refuse(format!("there is no particle {id}: ids go from 0 to {last}"));
                }
            }
        }
        if rows.is_empty() {
            return Ok(());
        }
        if !self.rows.are_open() {
            self.grow(Room::Rows(self.capacity())).await?;
        }
        self.unrepeatable();
        let four = |v: DVec4| Array::Vec4(vec![v]);
        for row in &rows {
            let place = *row as usize;
            self.store.fill(&mut self.backend, POSITION.name, place, &four(parked(self.extent, *row).extend(0.0)))?;
            self.store.fill(&mut self.backend, VELOCITY.name, place, &four(DVec4::ZERO))?;
            self.backend.write_at(ACCELERATION.name, place, &four(DVec4::ZERO))?;
            self.backend.write_at(LIFE.name, place, &Array::Uint(vec![Life::Removed.word()]))?;
        }
        // The neighbour list detects by itself that they are no longer active.
        self.rows.clear(&rows);
        // Where particles are accelerated independently, accelerations remain valid.
        self.begun &= self.setup.accelerates_each_alone();
        Ok(())
    }
    /// Refuses particles that cannot be added.
    fn welcome(&self, new: &State) -> Result<(), Error> {
        let refuse = |text: String| Err(Error::Scene(text));
        if !new.links.is_empty() || !new.held.is_empty() || !new.motions.is_empty() {
            return refuse(
                "particles that are spawned cannot be linked, fixed or kinematic: spawn free ones".to_owned(),
            );
        }
        if !new.births.is_empty() || !new.drains.is_empty() || (0..new.len()).any(|place| !new.is_active(place)) {
            return refuse(
                "particles that are spawned take part at once: give them no life, births or drains".to_owned(),
            );
        }
        if let Some(plan) = self.ties.floor_plan() {
            crowds::on_the_floor(plan, new)?;
            if self.setup.forces.iter().any(|force| force.properties().navigates) {
                crowds::have_ways(plan, new)?;
            }
        }
        if new.has_ids() {
            return refuse("particles that are spawned get ids of their own: take away the column `id`".to_owned());
        }
        for (column, _) in new.columns() {
            match self.columns().get(&column.name) {
                Some(known) if matches!(known.shape, Shape::System(_)) => {
                    return refuse(format!(
                        "the column `{}` is one of the system, not of particles: take it away",
                        column.name
                    ));
                }
                Some(known) if (known.kind, known.shape) != (column.kind, column.shape) => {
                    return refuse(format!(
                        "the column `{}` is {} here: give values of that",
                        column.name,
                        known.kind.name()
                    ));
                }
                Some(_) => {}
                None => return refuse(format!("the simulation has no column `{}`: take it away", column.name)),
            }
        }
        let setup = self.setup.with_state(new.clone());
        setup.particles()?;
        if !new.is_empty() && setup.forces.iter().any(|force| force.properties().makes_fluid) {
            setup.weighs(&setup.problem(Machine::HOST)?)?;
        }
        boundary::holds(&setup.bounds, new.position(), new.velocity())
    }
    /// Whether steps remove particles.
    fn removes(&self) -> bool {
        !self.ties.drains().is_empty() || self.setup.removes()
    }
    /// Frees the rows of particles that steps have removed, where there are not enough.
    async fn reclaim(&mut self) -> Result<(), Error> {
        if !self.removes() || !self.rows.are_open() {
            return Ok(());
        }
        let life = self.life().await?;
        // A particle that moves at constant velocity after its spawn is found by its row.
        let guided: BTreeSet<u32> = self.ties.guided().collect();
        let gone = (0..).zip(&life).filter(|(row, life)| **life == Life::Removed && !guided.contains(row));
        let rows: Vec<u32> = gone.map(|(row, _)| row).filter(|row| !self.rows.is_free(*row)).collect();
        self.rows.clear(&rows);
        Ok(())
    }
    /// Fills rows of all columns.
    fn put(&mut self, new: &State, rows: &[u32], ids: &[u32]) -> Result<(), Error> {
        let life = Array::Uint(vec![Life::Active.word(); rows.len()]);
        let ids = Array::Uint(ids.to_vec());
        let columns: Vec<Column> = self.columns().state().cloned().collect();
        let values = |column: &Column| match column.name.as_ref() {
            name if name == ID.name => Some(&ids),
            name if name == LIFE.name => Some(&life),
            name => new.get(name).filter(|_| column.role == Role::State),
        };
        let buffers: BTreeSet<_> = columns.iter().map(|column| column.place.buffer.clone()).collect();
        for buffer in buffers {
            let each = self.columns().len_of(&buffer, 1).unwrap_or(1);
            if !self.columns().of_buffer(&buffer).all(|column| !matches!(column.shape, Shape::System(_))) {
                continue;
            }
            if !self.store.is_bound(&buffer) {
                for column in columns.iter().filter(|column| column.place.buffer == buffer) {
                    self.store.put(column, values(column), rows, self.rows.capacity());
                }
                continue;
            }
            let Some(mut elements) = self.columns().packed(&buffer, rows.len(), values) else { continue };
            if let (Array::Vec4(list), true) = (&mut elements, buffer == POSITION.name) {
                let bounds = &self.setup.bounds;
                list.iter_mut().for_each(|x| *x = boundary::wrapped(bounds, x.truncate()).extend(x.w));
            }
            self.at_rows(&buffer, rows, &elements, each)?;
        }
        self.at_rows(ACCELERATION.name, rows, &Array::Vec4(vec![DVec4::ZERO; rows.len()]), 1)
    }
    /// Writes elements at rows, contiguous ones together.
    fn at_rows(&mut self, field: &str, rows: &[u32], elements: &Array, each: usize) -> Result<(), Error> {
        let mut first = 0;
        while first < rows.len() {
            let mut end = first + 1;
            while end < rows.len() && rows[end] == rows[end - 1] + 1 {
                end += 1;
            }
            let some: Vec<usize> = (first..end).collect();
            let elements = elements.picked(&some, each);
            self.store.fill(&mut self.backend, field, each * rows[first] as usize, &elements)?;
            first = end;
        }
        Ok(())
    }
    /// Marks rows in the neighbour list as reassigned to other particles: their pairs have no earlier history, and the list is rebuilt.
    /// Rows from `before` on have never been in it.
    fn changed_hands(&mut self, rows: &[u32], before: u32) -> Result<(), Error> {
        if self.list.is_none() {
            return Ok(());
        }
        self.at_rows(LIST_ORIGIN, rows, &Array::Vec4(vec![DVec4::ZERO; rows.len()]), 1)?;
        let new: Vec<u32> = rows.iter().copied().filter(|row| *row >= before).collect();
        let heads = new.iter().flat_map(|_| [0, NONE, 0, 0]).collect();
        self.at_rows(LIST, &new, &Array::Uint(heads), 4)
    }
}
