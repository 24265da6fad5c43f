//! The columns of a simulation: which of them lie on the device, and the values of the others.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec4;

use super::{Plans, Setup, Simulation};
use crate::boundary;
use crate::error::Error;
use crate::kernel::{
    ACCELERATION, Array, Backend, Column, Columns, HOME, ID, Kind, LIFE, LOW_WORDS, Name, POSITION, Role, TARGET,
    VELOCITY, insert, joined, low_words, remainders,
};
use crate::motion::{Held, Hold};
use crate::state::State;

/// The columns that kinematic particles require: their target positions.
pub(super) fn of_held(held: &[Held]) -> Vec<Column> {
    let any = |of: fn(&Hold) -> bool| held.iter().any(|one| of(&one.by));
    let mut columns = Vec::new();
    if any(|by| *by == Hold::Target) {
        let about = "the target position of a kinematic particle; its initial position by default";
        columns.push(Column::new(TARGET.name, Kind::Vector, "length", about));
        let about = "the time at which it reaches the target";
        columns.push(Column::new("kinematic_time", Kind::Scalar, "time", about).within(TARGET.name, 3));
    }
    columns
}

/// The columns of a simulation.
pub(super) struct Store {
    columns: Columns,
    /// The buffers of columns that are on the device.
    bound: BTreeSet<Name>,
    /// The fields of low words that are on the device.
    low: BTreeSet<&'static str>,
    /// Columns that no plan binds: nothing changes them.
    idle: BTreeMap<Name, Array>,
}

impl Store {
    /// The columns of a setup, of which plans bind some.
    pub fn new(setup: &Setup, plans: &Plans, count: u32) -> Result<Self, Error> {
        let columns = setup.columns()?;
        let fields: BTreeSet<String> = plans.all().flat_map(|plan| plan.fields(count).into_keys()).collect();
        let bound = columns.iter().map(|column| column.place.buffer.clone());
        let bound = bound.filter(|buffer| fields.contains(buffer.as_ref())).collect();
        let low = LOW_WORDS.iter().map(|(_, low)| low.name).filter(|low| fields.contains(*low)).collect();
        let mut store = Self { columns, bound, low, idle: BTreeMap::new() };
        let given = setup.state.columns().filter(|(column, _)| store.is_state(column) && !store.lies_on_device(column));
        let idle = given.map(|(column, values)| (column.name.clone(), values.clone())).collect();
        store.idle = idle;
        Ok(store)
    }
    fn is_state(&self, column: &Column) -> bool {
        self.columns.get(&column.name).is_some_and(|known| known.role == Role::State)
    }
    pub(super) fn lies_on_device(&self, column: &Column) -> bool {
        self.bound.contains(&column.place.buffer)
    }
    /// Fills the buffers of the device; where a run continues, velocities are those of its last step.
    pub fn write<B: Backend>(&self, backend: &mut B, setup: &Setup, goes_on: bool) -> Result<(), Error> {
        let (state, count) = (&setup.state, setup.state.len());
        for buffer in &self.bound {
            if !self.columns.of_buffer(buffer).any(|column| column.role == Role::State) {
                continue;
            }
            let values = |column: &Column| state.get(&column.name).filter(|_| column.role == Role::State);
            let Some(mut elements) = self.columns.packed(buffer, count, values) else { continue };
            if let Array::Vec4(elements) = &mut elements {
                started(setup, buffer, elements, goes_on);
            }
            self.fill(backend, buffer, 0, &elements)?;
        }
        backend.write(ACCELERATION.name, &Array::Vec4(vec![DVec4::ZERO; count]))
    }
    /// Fills a buffer from one of its elements on, and its low words, if it has any. References keep all digits in the high words.
    pub fn fill<B: Backend>(&self, backend: &mut B, buffer: &str, first: usize, elements: &Array) -> Result<(), Error> {
        backend.write_at(buffer, first, elements)?;
        let Some(low) = self.low_of(buffer) else { return Ok(()) };
        let exact = backend.host().is_some();
        backend.write_at(low, first, &if exact { elements.zeros(elements.len()) } else { remainders(elements) })
    }
    /// The field of the low words of a buffer, if it has any.
    fn low_of(&self, buffer: &str) -> Option<&'static str> {
        low_words(buffer).filter(|low| self.low.contains(low))
    }
    /// Fills the positions of fixed particles at time 0, in their order, where a plan requires them, and returns their number.
    pub fn anchor<B: Backend>(backend: &mut B, setup: &Setup) -> Result<usize, Error> {
        let homes: Vec<_> = setup.homes().into_iter().map(|home| home.extend(0.0)).collect();
        let count = homes.len();
        backend.write(HOME.name, &Array::Vec4(homes))?;
        Ok(count)
    }
    /// Whether a buffer is on the device.
    pub fn is_bound(&self, buffer: &str) -> bool {
        self.bound.contains(buffer)
    }
    /// Sets the values of a column that no plan binds, at some rows; its initial value where none are given.
    pub fn put(&mut self, column: &Column, values: Option<&Array>, rows: &[u32], capacity: u32) {
        if values.is_none() && !self.idle.contains_key(&column.name) {
            return;
        }
        let each = column.shape.len(1);
        let all = self.idle.entry(column.name.clone()).or_insert_with(|| column.array(capacity as usize));
        all.resize(each * capacity as usize, column.initial.unwrap_or_default());
        let given = values.cloned().unwrap_or_else(|| column.array(rows.len()));
        for (n, row) in rows.iter().enumerate() {
            all.replace(each * *row as usize, &given.picked(&[n], each));
        }
    }
    /// All columns.
    pub fn columns(&self) -> &Columns {
        &self.columns
    }
    pub(super) fn named(&self, name: &str) -> Result<&Column, Error> {
        self.columns.get(name).ok_or_else(|| {
            let known: Vec<&str> = self.columns.iter().map(|column| column.name.as_ref()).collect();
            Error::Scene(format!("there is no column `{name}`; there are {}", known.join(", ")))
        })
    }
}

/// The values of positions, velocities and targets with which a simulation starts.
fn started(setup: &Setup, buffer: &str, elements: &mut [DVec4], goes_on: bool) {
    let state = &setup.state;
    let inside = |x: DVec4| boundary::wrapped(&setup.bounds, x.truncate()).extend(x.w);
    if buffer == POSITION.name {
        elements.iter_mut().for_each(|x| *x = inside(*x));
        // Particles that are not active have no mass, and no velocity.
        elements.iter_mut().enumerate().filter(|(id, _)| !state.is_active(*id)).for_each(|(_, x)| x.w = 0.0);
    } else if buffer == VELOCITY.name && !goes_on {
        let rest = |v: &mut DVec4| *v = DVec4::ZERO.with_w(v.w);
        elements.iter_mut().enumerate().filter(|(id, _)| !state.is_active(*id)).for_each(|(_, v)| rest(v));
        state.held.iter().for_each(|one| rest(&mut elements[one.id as usize]));
    } else if buffer == TARGET.name && state.get(TARGET.name).is_none() {
        elements.iter_mut().zip(state.position()).for_each(|(to, x)| *to = inside(x.extend(0.0)));
    }
}

impl<B: Backend> Simulation<B> {
    /// The columns of the simulation.
    #[must_use]
    pub fn columns(&self) -> &Columns {
        &self.store.columns
    }
    /// Refuses fields that a caller cannot write, and numbers that are not finite.
    pub(super) fn may_write(&self, name: &str, values: &Array, first: usize) -> Result<(), Error> {
        if name == "world" {
            let text = "the field `world` holds the clock and the box, and cannot be written: start a simulation from a state with another time";
            return Err(Error::Scene(text.to_owned()));
        }
        if name == LIFE.name {
            let text = "the field `life` cannot be written: use spawn and remove";
            return Err(Error::Scene(text.to_owned()));
        }
        if name == ID.name {
            let text = "the field `id` cannot be written: the simulation assigns ids";
            return Err(Error::Scene(text.to_owned()));
        }
        if self.columns().get(name).is_none() {
            return Ok(());
        }
        values.unfit().map_or(Ok(()), |place| {
            let element = first + place;
            Err(Error::Scene(format!(
                "element {element} for the field `{name}` is NaN, infinite or beyond single precision: nothing was written"
            )))
        })
    }
    /// Reads a column by its name. One that is recomputed has the values of the last evaluation.
    ///
    /// # Errors
    /// [`Error::Scene`] when there is no such column, or nothing computes it; or what reading says.
    pub async fn read_column(&mut self, name: &str) -> Result<Array, Error> {
        self.settle().await?;
        self.column_now(name).await
    }
    /// Like [`Self::read_column`], whether or not the list had enough capacity.
    async fn column_now(&mut self, name: &str) -> Result<Array, Error> {
        let column = self.store.named(name)?.clone();
        if !self.store.lies_on_device(&column) {
            return match self.store.idle.get(&column.name) {
                Some(values) => Ok(self.of_rows(&column, values)),
                None if column.name == ID.name => Ok(Array::Uint((0..self.count()).collect())),
                None if column.role == Role::State => Ok(column.array(self.count() as usize)),
                None => Err(Error::Scene(format!(
                    "nothing computes the column `{name}`: add a force that writes it, or leave it out"
                ))),
            };
        }
        let elements = self.elements(&column.place.buffer).await?;
        Ok(Columns::unpacked(&column, &elements))
    }
    /// Writes a column by its name. Where positions, velocities or masses change, the next step begins with the accelerations
    /// there.
    ///
    /// # Errors
    /// [`Error::Scene`] when there is no such column, or the values are of another kind or number; or the device fails.
    pub async fn write_column(&mut self, name: &str, values: &Array) -> Result<(), Error> {
        let column = self.store.named(name)?.clone();
        let wanted = column.array(self.count() as usize);
        if std::mem::discriminant(&wanted) != std::mem::discriminant(values) || wanted.len() != values.len() {
            return Err(Error::Scene(format!(
                "the column `{name}` is {} and takes {} values: these are {}, {} of them",
                column.kind.name(),
                wanted.len(),
                crate::kernel::Kind::of(values).name(),
                values.len()
            )));
        }
        self.may_write(name, values, 0)?;
        self.settle().await?;
        self.unrepeatable();
        if !self.store.lies_on_device(&column) {
            let mut all = values.clone();
            all.resize(column.shape.len(self.capacity() as usize), column.initial.unwrap_or_default());
            self.store.idle.insert(column.name.clone(), all);
            return Ok(());
        }
        let buffer = column.place.buffer.clone();
        self.begun &= buffer != POSITION.name && buffer != VELOCITY.name;
        let elements = match self.elements(&buffer).await? {
            Array::Vec4(mut elements) => {
                insert(&mut elements, &column, values);
                Array::Vec4(elements)
            }
            _ => values.clone(),
        };
        self.store.fill(&mut self.backend, &buffer, 0, &elements)
    }
    /// The values of rows in use.
    fn of_rows(&self, column: &Column, values: &Array) -> Array {
        let mut values = values.clone();
        values.resize(column.shape.len(self.count() as usize), column.initial.unwrap_or_default());
        values
    }
    /// The elements of a buffer of columns.
    async fn elements(&mut self, buffer: &str) -> Result<Array, Error> {
        let missing = || Error::Device(format!("there is no field `{buffer}`"));
        let like = self.store.columns.element(buffer).ok_or_else(missing)?;
        let len = self.store.columns.len_of(buffer, self.count() as usize).ok_or_else(missing)?;
        let elements = self.backend.read(buffer, &like, len).await?;
        match self.store.low_of(buffer) {
            Some(low) => Ok(joined(elements, &self.backend.read(low, &like, len).await?)),
            None => Ok(elements),
        }
    }
    /// Reads all columns that a state keeps, and others of these names.
    pub(super) async fn gathered(&mut self, others: &[&str]) -> Result<State, Error> {
        others.iter().try_for_each(|name| self.store.named(name).map(drop))?;
        let wanted = |column: &&Column| column.role == Role::State || others.contains(&column.name.as_ref());
        let columns: Vec<Column> = self.store.columns.iter().filter(wanted).cloned().collect();
        let mut state = State::default();
        let mut buffers: BTreeMap<Name, Array> = BTreeMap::new();
        for column in &columns {
            let values = if self.store.lies_on_device(column) {
                let buffer = &column.place.buffer;
                if !buffers.contains_key(buffer) {
                    let elements = self.elements(buffer).await?;
                    buffers.insert(buffer.clone(), elements);
                }
                buffers.get(buffer).map(|elements| Columns::unpacked(column, elements))
            } else if column.role == Role::State {
                self.store.idle.get(&column.name).map(|values| self.of_rows(column, values))
            } else {
                Some(self.column_now(&column.name).await?)
            };
            // There is no such column where all particles are active, or where ids are rows.
            if values.is_some() || column.name != LIFE.name && column.name != ID.name {
                state.put(column, values);
            }
        }
        // Declarations continue, so that a setup of this state has the same columns.
        let base = Columns::default();
        let others = self.store.columns.iter().filter(|column| !wanted(column) && base.get(&column.name).is_none());
        others.cloned().collect::<Vec<_>>().iter().try_for_each(|column| state.declare(column))?;
        Ok(state)
    }
}
