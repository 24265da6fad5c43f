//! The life of the particles of a state.

use super::State;
use crate::error::Error;
use crate::kernel::{Array, LIFE};
use crate::life::{Life, Population};

impl State {
    /// The life of each particle; empty where it is not set, and all are active.
    #[must_use]
    pub fn life(&self) -> Vec<Life> {
        let words = self.whole(LIFE.name).unwrap_or_default();
        words.iter().map(|word| Life::of(*word).unwrap_or_default()).collect()
    }
    /// Sets the life of all particles.
    ///
    /// # Errors
    /// [`Error::Scene`] when the number of values is not that of the particles.
    pub fn set_lives(&mut self, life: &[Life]) -> Result<(), Error> {
        self.set(LIFE.name, Array::Uint(life.iter().map(|life| life.word()).collect()))
    }
    /// Sets the life of a particle.
    pub fn set_life(&mut self, id: usize, life: Life) {
        let mut list = self.life();
        list.resize(self.len(), Life::Active);
        if let Some(place) = list.get_mut(id) {
            *place = life;
        }
        // The number of values is that of the particles.
        let _ = self.set_lives(&list);
    }
    /// Whether a particle is active.
    #[must_use]
    pub fn is_active(&self, id: usize) -> bool {
        self.whole(LIFE.name).and_then(|words| words.get(id)).is_none_or(|word| *word == Life::Active.word())
    }
    /// Of each particle, whether it is fixed or kinematic.
    #[must_use]
    pub fn fixed(&self) -> Vec<bool> {
        let mut fixed = vec![false; self.len()];
        for one in &self.held {
            if let Some(fixed) = fixed.get_mut(one.id as usize) {
                *fixed = true;
            }
        }
        fixed
    }
    /// Whether some particles are inactive at some time.
    #[must_use]
    pub fn has_inactive(&self) -> bool {
        let idle = |word: &u32| *word != Life::Active.word();
        !self.births.is_empty()
            || !self.drains.is_empty()
            || self.capacity.is_some()
            || self.whole(LIFE.name).is_some_and(|words| words.iter().any(idle))
    }
    /// The numbers of pending, active and removed particles.
    #[must_use]
    pub fn population(&self) -> Population {
        Population::of(&self.life(), self.len())
    }
}
