//! Validation of rods at the start.

use std::collections::HashSet;

use glam::DVec3;

use super::{Chains, Links};
use crate::error::Error;

/// The relative error of a rod's length that is allowed at the start, and the part of the speeds of its ends by which it may change: the
/// rounding of a file with six digits.
const SLACK: f64 = 1e-5;
/// The precision that is required of positions, relative to a rod's length.
const FINE: f64 = 2e-4;

impl Links {
    /// Checks that the rods form chains, and that their lengths agree with the positions. Of two fixed ends only `fixed` ones are known to
    /// be at rest at the start; `shortest` returns the displacement to the nearest image.
    ///
    /// # Errors
    /// [`Error::Scene`] as for [`Chains::new`], or with the first rod that is too long, too short, too small for single precision, or whose
    /// length changes.
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
            // Two positions, each with a rounding error of half a unit in the last place.
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
