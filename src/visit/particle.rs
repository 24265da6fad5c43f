//! A particle as a law's reference sees it: like `Particle` in WGSL, and with every column by its name.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DVec3, DVec4, Vec4};

use crate::error::Error;
use crate::kernel::{Array, Element, Host, ID, LIFE, POSITION, SPECIES, VELOCITY};
use crate::life::Life;

/// A snapshot of all particles of a host: later writes do not change it.
pub struct View<'a> {
    arrays: BTreeMap<&'a str, Arc<Array>>,
    count: usize,
}

/// A particle as a law's reference sees it.
#[derive(Clone, Copy)]
pub struct Particle<'a> {
    /// Its index.
    pub index: usize,
    /// Its position \[length\].
    pub position: DVec3,
    /// Its velocity \[length / time\]; 0 where the host has no velocities.
    pub velocity: DVec3,
    /// Mass \[mass\].
    pub mass: f64,
    species: u32,
    is_active: bool,
    view: &'a View<'a>,
}

impl<'a> View<'a> {
    /// The particles of a host.
    ///
    /// # Errors
    /// When it lacks positions, or something is being written.
    pub fn of(host: &'a Host) -> Result<Self, Error> {
        let arrays = host.arrays()?;
        let count = host.read(POSITION)?.len().min(host.world().count as usize);
        Ok(Self { arrays, count })
    }
    /// Adds arrays by particle that the host stores in another order.
    pub(super) fn extend(&mut self, arrays: Vec<(&'static str, Array)>) {
        self.arrays.extend(arrays.into_iter().map(|(name, array)| (name, Arc::new(array))));
    }
    fn slice<T: Element>(&self, name: &str) -> &[T::Reference] {
        self.arrays.get(name).and_then(|array| T::view(array)).map_or(&[], Vec::as_slice)
    }
    /// The particles, by index.
    #[must_use]
    pub fn particles(&self) -> Vec<Particle<'_>> {
        let (position, velocity) = (self.slice::<Vec4>(POSITION.name), self.slice::<Vec4>(VELOCITY.name));
        let (species, life) = (self.slice::<u32>(SPECIES.name), self.slice::<u32>(LIFE.name));
        let particle = |index: usize| {
            let (x, v) = (position[index], velocity.get(index).copied().unwrap_or(DVec4::ZERO));
            Particle {
                index,
                position: x.truncate(),
                velocity: v.truncate(),
                mass: x.w,
                species: species.get(index).copied().unwrap_or(0),
                is_active: life.get(index).is_none_or(|word| *word == Life::Active.word()),
                view: self,
            }
        };
        (0..self.count).map(particle).collect()
    }
}

impl Particle<'_> {
    /// Its id; its index, where the host has no ids.
    #[must_use]
    pub fn id(&self) -> u32 {
        self.whole(ID.name).unwrap_or_else(|| u32::try_from(self.index).unwrap_or(u32::MAX))
    }
    /// Its species; 0 where the host has no species.
    #[must_use]
    pub fn species(&self) -> u32 {
        self.species
    }
    /// Whether it is active.
    #[must_use]
    pub fn is_active(&self) -> bool {
        self.is_active
    }
    /// Its value of a scalar column; `None` where the host has none of that name and kind.
    #[must_use]
    pub fn scalar(&self, column: &str) -> Option<f64> {
        self.view.slice::<f32>(column).get(self.index).copied()
    }
    /// Its value of a vector column, or all four numbers of a quaternion.
    #[must_use]
    pub fn vector(&self, column: &str) -> Option<DVec4> {
        self.view.slice::<Vec4>(column).get(self.index).copied()
    }
    /// Its numbers in a field of structs; empty where the host has none.
    #[must_use]
    pub fn numbers(&self, field: &str) -> &[f64] {
        let all = self.all(field);
        let width = all.len() / self.view.count.max(1);
        all.get(width * self.index..width * (self.index + 1)).unwrap_or_default()
    }
    /// All numbers of a field, such as one of the system; empty where the host has none.
    #[must_use]
    pub fn all(&self, field: &str) -> &[f64] {
        self.view.slice::<f32>(field)
    }
    /// Its value of a column of integers.
    #[must_use]
    pub fn whole(&self, column: &str) -> Option<u32> {
        self.view.slice::<u32>(column).get(self.index).copied()
    }
}
