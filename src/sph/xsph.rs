//! XSPH: velocities drawn towards those around.

use glam::DVec3;

use super::medium::FLOWING;
use super::pressure::flow;
use super::{FLOW, Medium};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Problem, Scalar, World};
use crate::visit::{Law, Outcome, Particle};

/// The law that adds  ε / dt Σ m / ρ̄ (v' − v) W  to accelerations (Monaghan 1989; Schechter & Bridson 2012).
///
/// # Errors
/// When the range is invalid.
pub fn xsph(medium: &Medium, strength: f64, problem: &Problem) -> Result<Law, Error> {
    let search = medium.search(FLOWING, &[FLOW], problem)?;
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
    let wgsl = crate::shader!("sph/xsph.wgsl");
    Ok(Law::searching("fluid xsph", search, wgsl, params, &[ACCELERATION.name], gather, finish))
}
