//! Where everybody is whom solids have put out before the first step.

use glam::DVec3;

use super::Setup;
use crate::error::Error;
use crate::forces::Problem;

/// Who is nearer to where he belongs than this part of the size of his place is there: single precision tells no more.
const ROUNDING: f64 = 1e-6;

/// All places, and who has been put there, by how much.
pub(super) fn kept(setup: &Setup, problem: &Problem) -> Result<(Vec<DVec3>, Vec<(usize, f64)>), Error> {
    let mut places = setup.particles.position.clone();
    let keepers = setup.forces.iter().filter_map(|force| force.keeper(problem).transpose());
    let keepers = keepers.collect::<Result<Vec<_>, _>>()?;
    let mut moved = Vec::new();
    if keepers.is_empty() {
        return Ok((places, moved));
    }
    for id in (0..places.len()).filter(|id| !problem.is_held(*id)) {
        let (before, species) = (places[id], setup.particles.species[id]);
        let after = keepers.iter().fold(before, |x, keeper| keeper(species, x));
        let way = (after - before).length();
        if way > ROUNDING * before.abs().max_element() {
            places[id] = after;
            moved.push((id, way));
        }
    }
    Ok((places, moved))
}
