//! What a plan is written for.

use glam::DVec3;

use super::{Bounds, Machine, Shader, Side};

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
    /// The `override`s of a shader that the problem decides.
    #[must_use]
    pub fn constants(&self, shader: &Shader) -> Vec<(&'static str, f64)> {
        let periodic = shader.reflection().overrides.contains_key("PERIODIC") && self.bounds.has(Side::Periodic);
        if periodic { vec![("PERIODIC", 1.0)] } else { Vec::new() }
    }
}
