//! Density by summation: ρ = Σ m W, over the fluid and its walls (Gingold & Monaghan 1977; Akinci et al. 2012).

use glam::DVec3;

use super::{DENSITY, Medium};
use crate::error::Error;
use crate::kernel::{Problem, World};
use crate::visit::{Candidate, Law, Outcome, Particle};

/// The law that sums it, for all particles that are not fixed.
///
/// # Errors
/// When the range is invalid.
pub fn density(medium: &Medium, problem: &Problem) -> Result<Law, Error> {
    let search = medium.search(Candidate::STILL, &[], problem)?;
    let (smoothed, problem) = (medium.smoothed(), problem.clone());
    let gather = move |_: &Particle, you: &Particle, r, _: &World, sum: &mut f64| *sum += you.mass * smoothed.kernel(r);
    let finish = move |me: &Particle, sum: &f64, _: &World, outcome: &mut Outcome| {
        if !problem.is_held(me.index) {
            outcome.set(DENSITY.name, sum + me.mass * smoothed.kernel(DVec3::ZERO));
        }
    };
    let wgsl = crate::shader!("sph/density.wgsl");
    Ok(Law::searching("fluid density", search, wgsl, Vec::new(), &[DENSITY.name], gather, finish))
}
