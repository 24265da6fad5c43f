//! The columns that every state has.

use std::collections::TryReserveError;

use glam::DVec3;

use super::State;
use crate::error::Error;
use crate::kernel::Array;

/// Their names, in the order in which a state keeps them.
pub(super) const BASIC: [&str; 5] = ["position", "velocity", "mass", "size", "species"];

macro_rules! basic {
    ($place:literal, $name:ident, $name_mut:ident, $variant:ident, $element:ty, $about:literal) => {
        #[doc = $about]
        #[must_use]
        pub fn $name(&self) -> &[$element] {
            if let Some(Array::$variant(values)) = &self.columns[$place].values { values } else { &[] }
        }
        #[doc = $about]
        #[doc = "To change in place."]
        #[must_use]
        pub fn $name_mut(&mut self) -> &mut [$element] {
            self.kept.touched();
            if let Some(Array::$variant(values)) = &mut self.columns[$place].values { values } else { &mut [] }
        }
    };
}

impl State {
    basic!(0, position, position_mut, Vec3, DVec3, "Where particles are \\[length\\]. ");
    basic!(1, velocity, velocity_mut, Vec3, DVec3, "How they move \\[length / time\\]. ");
    basic!(2, mass, mass_mut, Float, f64, "How heavy they are \\[mass\\]; zero is a test particle. ");
    basic!(3, size, size_mut, Float, f64, "The radius that is drawn \\[length\\]; zero lets the picture choose. ");
    basic!(4, species, species_mut, Uint, u32, "Of which kind they are: numbers that laws may tell apart. ");

    /// Positions and velocities, to change both in place.
    #[must_use]
    pub fn phase_mut(&mut self) -> (&mut [DVec3], &mut [DVec3]) {
        self.kept.touched();
        let [position, velocity, ..] = self.columns.as_mut_slice() else { return (&mut [], &mut []) };
        match (&mut position.values, &mut velocity.values) {
            (Some(Array::Vec3(position)), Some(Array::Vec3(velocity))) => (position, velocity),
            _ => (&mut [], &mut []),
        }
    }
    /// Adds a particle of species 0. Other columns get their initial values.
    pub fn push(&mut self, position: DVec3, velocity: DVec3, mass: f64, size: f64) {
        let next = self.next_id();
        self.kept.clear();
        for (place, (column, values)) in self.particle_columns().enumerate() {
            match (place, values) {
                (0, Array::Vec3(list)) => list.push(position),
                (1, Array::Vec3(list)) => list.push(velocity),
                (2, Array::Float(list)) => list.push(mass),
                (3, Array::Float(list)) => list.push(size),
                (_, values) => values.resize(values.len() + column.shape.len(1), column.initial.unwrap_or_default()),
            }
        }
        self.name_last(1, next);
    }
    /// The same, all of one species.
    #[must_use]
    pub fn of_species(mut self, species: u32) -> Self {
        self.species_mut().fill(species);
        self
    }
    /// No particles, with memory for `count`.
    ///
    /// # Errors
    /// When there is not enough memory.
    pub(crate) fn with_room(count: usize) -> Result<Self, TryReserveError> {
        let mut state = Self::default();
        for (_, values) in state.particle_columns() {
            match values {
                Array::Vec4(list) => list.try_reserve_exact(count)?,
                Array::Vec3(list) => list.try_reserve_exact(count)?,
                Array::Float(list) => list.try_reserve_exact(count)?,
                Array::Uint(list) => list.try_reserve_exact(count)?,
            }
        }
        Ok(state)
    }
    /// The potential energy of each particle: its mass times the column `potential` \[mass length² / time²\].
    ///
    /// # Errors
    /// [`Error::Scene`] where the state has no such column: it was not taken from a simulation.
    pub fn energies(&self) -> Result<Vec<f64>, Error> {
        let potential = self.scalar("potential").ok_or_else(|| {
            Error::Scene("the state has no column `potential`: use a state that a simulation returned".to_owned())
        })?;
        Ok(self.mass().iter().zip(potential).map(|(m, w)| m * w).collect())
    }
}
