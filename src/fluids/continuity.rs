//! Density by the continuity equation: a state that goes along with positions (Monaghan 1994).

use std::sync::Arc;

use glam::DVec3;

use super::{DENSITY, DENSITY_RATE, Medium};
use crate::error::Error;
use crate::kernel::{Column, Host, Kernel, Kind, Problem, Scalar};
use crate::visit::{Candidate, Sweep, gathered};

/// How the density of a fluid follows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Continuity {
    /// δ of the diffusion (Molteni & Colagrossi 2009).
    pub diffusion: f64,
    /// What the diffusion leaves alone: the density of a fluid at rest in this weight \[length / time²\].
    pub weight: DVec3,
}

/// The columns of such a density, which starts as that of rest. It is carried along with positions: integrators compute its rate in
/// the middle of each drift.
#[must_use]
pub fn columns(rest: f64) -> Vec<Column> {
    vec![
        Column::new(
            "density",
            Kind::Scalar,
            "mass / length³",
            "how dense the fluid is there; of walls it says nothing",
        )
        .carried("density_rate")
        .starting([rest, 0.0, 0.0, 0.0]),
        Column::new("density_rate", Kind::Scalar, "mass / (length³ time)", "how fast that changes").derived(),
    ]
}

/// The kernel that finds how fast density changes, where particles are and as they move.
///
/// # Errors
/// When the range is none, or a shader does not compile.
pub fn rate(medium: &Medium, continuity: Continuity, problem: &Problem) -> Result<Kernel, Error> {
    let (holding, tables) = problem.holding();
    let files = medium.files(&[holding, crate::shader!("fluids/density_rate.wgsl")]);
    let candidate = Candidate {
        particle: crate::shader!("fluids/dense.wgsl"),
        broadcast: crate::shader!("fluids/flowing_broadcast.wgsl"),
    };
    let diffusion = 2.0 * continuity.diffusion * 0.5 * medium.range() * medium.sound;
    let params = vec![("diffusion", Scalar::Float(diffusion)), ("weight", Scalar::Vector(continuity.weight))];
    let (me, who) = (*medium, problem.clone());
    let twin = move |host: &Host| {
        let density = host.read(DENSITY)?;
        let smoothing = 0.5 * me.range();
        let rates = gathered(
            host,
            me.range(),
            |body| !who.is_held(body.index),
            |a, b, r, rate: &mut f64| {
                *rate += b.mass * me.gradient(r) * r.dot(b.velocity - a.velocity);
                if !who.is_held(b.index) {
                    let (mine, yours) = (density[a.index], density[b.index]);
                    let denser = 0.5 * (mine + yours) - me.density;
                    let give = me.density - f64::from(me.exponent - 2) * denser;
                    let excess = yours - mine - give * continuity.weight.dot(r) / (me.sound * me.sound);
                    let near = r.length_squared() / (r.length_squared() + 0.01 * smoothing * smoothing);
                    *rate -= diffusion * b.mass / yours * excess * me.gradient(r) * near;
                }
            },
        )?;
        let mut rate = host.write(DENSITY_RATE)?;
        rate.iter_mut().zip(rates).for_each(|(rate, found)| *rate = found.unwrap_or(*rate));
        Ok(())
    };
    let sweep = Sweep {
        name: "fluid density rate".to_owned(),
        grid: medium.grid(problem)?,
        candidate,
        files,
        params,
        constants: medium.constants(),
        twin: Arc::new(twin),
    };
    Ok(Kernel { tables, ..sweep.kernel(problem)? })
}
