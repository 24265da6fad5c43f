//! What a plan is written for.

use glam::DVec3;

use crate::kernel::{Bounds, Machine, Side};

/// The machine, the particles' number and place at the start, and their box. What a plan makes of the place are
/// guesses of speed alone: particles may go anywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Problem {
    /// How many particles.
    pub count: u32,
    /// What the plan will run on.
    pub machine: Machine,
    /// Where particles may be.
    pub bounds: Bounds,
    /// The lowest and the highest corner of where they are at the start \[length\].
    pub extent: (DVec3, DVec3),
}

impl Problem {
    /// So many particles in open space, somewhere in a cube of unit sides.
    #[must_use]
    pub fn new(count: u32, machine: Machine) -> Self {
        Self { count, machine, bounds: Bounds::default(), extent: (DVec3::ZERO, DVec3::ONE) }
    }
    /// The same with particles at these places, in this box.
    #[must_use]
    pub fn at(self, positions: &[DVec3], bounds: Bounds) -> Self {
        let low = positions.iter().copied().reduce(DVec3::min).unwrap_or_default();
        let high = positions.iter().copied().reduce(DVec3::max).unwrap_or_default();
        Self { bounds, extent: (low, high), ..self }
    }
    /// What `shaders/particle.wgsl` must be told.
    #[must_use]
    pub fn constants(&self) -> Vec<(&'static str, f64)> {
        vec![("PERIODIC", f64::from(u8::from(self.bounds.has(Side::Periodic))))]
    }
}
