//! Density by the continuity equation: a state that goes along with positions (Monaghan 1994).

use glam::DVec3;

use super::{Boxed, DENSITY, DENSITY_RATE};
use crate::kernel::{Column, Kind, Scalar, World};
use crate::visit::{Candidate, Law, Outcome, Over, Particle};

/// The data of a neighbour before its pressure is known.
const DENSE: Candidate = Candidate {
    particle: crate::shader!("sph/dense.wgsl"),
    broadcast: crate::shader!("sph/flowing_broadcast.wgsl"),
    listed: Some(crate::shader!("sph/dense_listed.wgsl")),
};

/// The options of a density that is a state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Continuity {
    /// δ of the diffusion (Molteni & Colagrossi 2009).
    pub diffusion: f64,
    /// The part that the diffusion leaves unchanged: the hydrostatic density of a fluid at rest under this acceleration \[length / time²\].
    pub weight: DVec3,
}

/// The columns of such a density, which starts as that of rest. It is carried along with positions: integrators compute its rate in
/// the middle of each drift.
#[must_use]
pub fn columns(rest: f64) -> Vec<Column> {
    vec![
        density().carried("density_rate").starting([rest, 0.0, 0.0, 0.0]),
        Column::new("density_rate", Kind::Scalar, "mass / (length^D time)", "how fast that changes").derived(),
    ]
}

/// The density: computed anew in each evaluation, unless integrators advance it.
fn density() -> Column {
    Column::new(
        "density",
        Kind::Scalar,
        "mass / length^D",
        "the density of the fluid in D dimensions; undefined for walls",
    )
}

/// The columns of a density that is a sum over neighbours.
#[must_use]
pub fn summed() -> Vec<Column> {
    vec![density().derived()]
}

/// The law that computes the rate of the density, at the current positions and velocities.
#[must_use]
pub fn rate(of: &Boxed, over: Over, continuity: Continuity) -> Law {
    let (of, wgsl) = (of.clone(), crate::shader!("sph/density_rate.wgsl"));
    Law::outlined("fluid density rate", over, wgsl, &[DENSITY_RATE.name], move |law, problem| {
        let medium = of(&problem.bounds)?;
        let search = medium.search(law.over, DENSE, &[], problem)?;
        let diffusion = 2.0 * continuity.diffusion * 0.5 * medium.range() * medium.sound;
        let params = vec![("diffusion", Scalar::Float(diffusion)), ("weight", Scalar::Vector(continuity.weight))];
        let smoothed = medium.smoothed();
        let (walls, fixed) = (problem.clone(), problem.clone());
        let gather = move |me: &Particle, you: &Particle, r: DVec3, _: &World, rate: &mut f64| {
            *rate += you.mass * smoothed.gradient(r) * r.dot(you.velocity - me.velocity);
            if !walls.is_held(you.index) {
                let [mine, yours] = [me, you].map(|one| one.scalar(DENSITY.name).unwrap_or(f64::NAN));
                let denser = 0.5 * (mine + yours) - medium.density;
                let give = medium.density - f64::from(medium.exponent - 2) * denser;
                let excess = yours - mine - give * continuity.weight.dot(r) / (medium.sound * medium.sound);
                let smoothing = 0.5 * medium.range();
                let near = r.length_squared() / (r.length_squared() + 0.01 * smoothing * smoothing);
                *rate -= diffusion * you.mass / yours * excess * smoothed.gradient(r) * near;
            }
        };
        let finish = move |me: &Particle, rate: &f64, _: &World, outcome: &mut Outcome| {
            if !fixed.is_held(me.index) {
                outcome.set(DENSITY_RATE.name, *rate);
            }
        };
        Ok(law.searched(search, params, gather, finish))
    })
}
