//! Validation of rods at the start.

use std::collections::HashSet;

use glam::DVec3;

use super::{Chains, Links};
use crate::error::Error;

/// Parts of its length by which a rod may be too long or too short at the start, and of the speeds of its ends by which
/// it may grow: what a file of six digits loses.
const SLACK: f64 = 1e-5;
/// Parts of its length to which positions must be held.
const FINE: f64 = 2e-4;

impl Links {
    /// Whether the rods make chains, and have their lengths where the particles are. Between fixed ones only `fixed` ones are
    /// known to rest at the start; `shortest` gives the displacement to the nearest image.
    ///
    /// # Errors
    /// [`Error::Scene`] with what [`Chains::new`] says, or with the first rod that is too long, too short, too small for
    /// single precision, or about to change its length.
    pub fn check_rods(
        &self,
        [position, velocity]: [&[DVec3]; 2],
        held: &[u32],
        fixed: &HashSet<u32>,
        shortest: impl Fn(DVec3) -> DVec3,
    ) -> Result<(), Error> {
        Chains::new(&self.rods, held)?;
        let held: HashSet<u32> = held.iter().copied().collect();
        for (n, rod) in self.rods.iter().enumerate() {
            let [a, b] = rod.ends.map(|id| id as usize);
            let (Some(from), Some(to)) = (position.get(a), position.get(b)) else { continue };
            let (r, length) = (shortest(*to - *from), rod.length);
            let away = from.abs().max(to.abs()).max_element();
            // Two places, each rounded by half a place.
            let rounding = away * f64::from(f32::EPSILON);
            if rounding > FINE * length {
                return Err(Error::Scene(format!(
                    "rod {n} has the length {length}, and is {away} from the origin, where single precision resolves positions \
                     to {rounding:e}: take an origin that is nearer, or longer rods"
                )));
            }
            if (r.length() - length).abs() > SLACK * length + rounding {
                return Err(Error::Scene(format!(
                    "rod {n} has the length {length}, and its particles {a} and {b} are {} apart: move one of them, or give \
                     the rod that length",
                    r.length()
                )));
            }
            // The first step determines the velocity of a kinematic particle.
            let led = |id: &u32| held.contains(id) && !fixed.contains(id);
            if rod.ends.iter().any(led) {
                continue;
            }
            let speed = |id: &u32| if fixed.contains(id) { None } else { velocity.get(*id as usize).copied() };
            let [u, v] = rod.ends.map(|id| speed(&id).unwrap_or_default());
            let growth = (v - u).dot(r) / length;
            if growth.abs() > SLACK * (u.length() + v.length()) {
                return Err(Error::Scene(format!(
                    "rod {n} between particles {a} and {b} would grow by {growth:e} in a unit of time: remove that from \
                     their velocities"
                )));
            }
        }
        Ok(())
    }
}
