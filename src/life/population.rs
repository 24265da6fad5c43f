//! Counts of pending, active and removed particles.

use super::{Birth, Life};

/// Counts of pending, active and removed particles, which sum to all particles.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Population {
    /// Particles yet to be spawned.
    pub pending: u64,
    /// Particles in the simulation.
    pub active: u64,
    /// Removed particles.
    pub removed: u64,
}

impl Population {
    /// Counts `count` particles; those without an entry are active.
    #[must_use]
    pub fn of(life: &[Life], count: usize) -> Self {
        let number = |wanted: Life| life.iter().take(count).filter(|life| **life == wanted).count() as u64;
        let (pending, removed) = (number(Life::Pending), number(Life::Removed));
        Self { pending, active: (count as u64).saturating_sub(pending + removed), removed }
    }
}

/// The number, the first and the last time of each emitter's births, in the order of the emitters.
#[must_use]
pub fn schedule(births: &[Birth]) -> Vec<(u64, f64, f64)> {
    let emitters = births.iter().map(|birth| birth.emitter as usize + 1).max().unwrap_or(0);
    let mut list = vec![(0, f64::INFINITY, f64::NEG_INFINITY); emitters];
    for birth in births {
        let (number, first, last) = &mut list[birth.emitter as usize];
        (*number, *first, *last) = (*number + 1, first.min(birth.time), last.max(birth.time));
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_counted_once() {
        let life = [Life::Pending, Life::Removed, Life::Active, Life::Pending, Life::Pending];
        assert_eq!(Population::of(&life, 9), Population { pending: 3, active: 5, removed: 1 });
        assert_eq!(Population::of(&life, 2), Population { pending: 1, active: 0, removed: 1 });
        assert!([0, 1, 2].into_iter().all(|word| Life::of(word).is_some_and(|life| life.word() == word)));
        assert_eq!(Life::of(3), None);
    }
}
