//! XSPH: velocities drawn towards those around.

use glam::DVec3;

use super::medium::FLOWING;
use super::pressure::flow;
use super::{Boxed, FLOW};
use crate::kernel::{ACCELERATION, Scalar, World};
use crate::visit::{Law, Outcome, Over, Particle};

/// The law that adds  ε / dt Σ m / ρ̄ (v' − v) W  to accelerations (Monaghan 1989; Schechter & Bridson 2012).
#[must_use]
pub fn xsph(of: &Boxed, over: Over, strength: f64) -> Law {
    let (of, wgsl) = (of.clone(), crate::shader!("sph/xsph.wgsl"));
    Law::outlined("fluid xsph", over, wgsl, &[ACCELERATION.name], move |law, problem| {
        let medium = of(&problem.bounds)?;
        let search = medium.search(law.over, FLOWING, &[FLOW], problem)?;
        let (smoothed, params) = (medium.smoothed(), vec![("xsph", Scalar::Float(strength))]);
        let gather = move |me: &Particle, you: &Particle, r, _: &World, sum: &mut DVec3| {
            let [mine, yours] = [me, you].map(|one| flow(one).x);
            if yours > 0.0 {
                *sum += you.mass / (0.5 * (mine + yours)) * smoothed.kernel(r) * (you.velocity - me.velocity);
            }
        };
        let finish = move |me: &Particle, sum: &DVec3, world: &World, outcome: &mut Outcome| {
            if flow(me).x > 0.0 {
                outcome.accelerate((strength / world.dt * *sum).extend(0.0));
            }
        };
        Ok(law.searched(search, params, gather, finish))
    })
}
