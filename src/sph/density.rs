//! Density by summation: ρ = Σ m W, over the fluid and its walls (Gingold & Monaghan 1977; Akinci et al. 2012).

use glam::DVec3;

use super::{Boxed, DENSITY};
use crate::kernel::World;
use crate::visit::{Candidate, Law, Outcome, Over, Particle};

/// The law that sums it, for all particles that are not fixed.
#[must_use]
pub fn density(of: &Boxed, over: Over) -> Law {
    let (of, wgsl) = (of.clone(), crate::shader!("sph/density.wgsl"));
    Law::outlined("fluid density", over, wgsl, &[DENSITY.name], move |law, problem| {
        let medium = of(&problem.bounds)?;
        let search = medium.search(law.over, Candidate::STILL, &[], problem)?;
        let (smoothed, problem) = (medium.smoothed(), problem.clone());
        let gather =
            move |_: &Particle, you: &Particle, r, _: &World, sum: &mut f64| *sum += you.mass * smoothed.kernel(r);
        let finish = move |me: &Particle, sum: &f64, _: &World, outcome: &mut Outcome| {
            if !problem.is_held(me.index) {
                outcome.set(DENSITY.name, sum + me.mass * smoothed.kernel(DVec3::ZERO));
            }
        };
        Ok(law.searched(search, Vec::new(), gather, finish))
    })
}
