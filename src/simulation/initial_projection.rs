//! The initial projection: the positions of particles that obstacles have moved out before the first step.

use glam::DVec3;

use super::Setup;
use crate::error::Error;
use crate::forces::Problem;

/// A particle counts as moved only if it moves by more than this part of the size of its coordinates: single precision resolves no less.
const ROUNDING: f64 = 1e-6;

/// The positions after the projection.
#[derive(Default)]
pub(super) struct Projected {
    /// All positions, by id \[length\].
    pub places: Vec<DVec3>,
    /// The particles that were moved, and their displacements \[length\].
    pub moved: Vec<(usize, f64)>,
}

/// Applies the projections of all forces.
pub(super) fn projected(setup: &Setup, problem: &Problem) -> Result<Projected, Error> {
    let mut kept = Projected { places: setup.state.position().to_vec(), moved: Vec::new() };
    let resolved = setup.forces.iter().map(|force| force.resolved(problem)).collect::<Result<Vec<_>, _>>()?;
    let initial_projection: Vec<_> = resolved.into_iter().filter_map(|resolved| resolved.initial_projection).collect();
    if initial_projection.is_empty() {
        return Ok(kept);
    }
    for id in (0..kept.places.len()).filter(|id| !problem.is_held(*id)) {
        let (before, species) = (kept.places[id], setup.state.species()[id]);
        let after = initial_projection.iter().fold(before, |x, keeper| keeper(species, x));
        let way = (after - before).length();
        if way > ROUNDING * before.abs().max_element() {
            kept.places[id] = after;
            kept.moved.push((id, way));
        }
    }
    Ok(kept)
}
