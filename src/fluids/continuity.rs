//! Density by the continuity equation: a state that goes along with positions (Monaghan 1994).

use std::sync::Arc;

use glam::DVec3;

use super::{DENSITY, DENSITY_RATE, Medium};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Pass, Problem, Scalar, Shader};
use crate::visit::{Candidate, Sweep, block, gathered};

/// How the density of a fluid follows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Continuity {
    /// δ of the diffusion (Molteni & Colagrossi 2009).
    pub diffusion: f64,
    /// What the diffusion leaves alone: the density of a fluid at rest in this weight \[length / time²\].
    pub weight: DVec3,
}

/// The kernel that sets everybody's density to that of rest.
///
/// # Errors
/// When a shader does not compile.
pub fn rest(medium: &Medium, problem: &Problem) -> Result<Kernel, Error> {
    let (me, who) = (*medium, problem.clone());
    let source =
        [medium.smoothing.source(), crate::shader!("fluids/medium.wgsl"), crate::shader!("fluids/density_rest.wgsl")];
    alone("fluid rest", &source, &[], &medium.constants(), problem, move |host| {
        let mut density = host.write(DENSITY)?;
        density.iter_mut().enumerate().filter(|(i, _)| !who.is_held(*i)).for_each(|(_, rho)| *rho = me.density);
        Ok(())
    })
}

/// The kernel that finds how fast density changes, after a drift by `factor` of the step.
///
/// # Errors
/// When the range is none, or a shader does not compile.
pub fn rate(medium: &Medium, continuity: Continuity, factor: f64, problem: &Problem) -> Result<Kernel, Error> {
    let (holding, tables) = problem.holding();
    let files = medium.files(&[holding, crate::shader!("fluids/density_rate.wgsl")]);
    let candidate = Candidate {
        particle: crate::shader!("fluids/dense.wgsl"),
        broadcast: crate::shader!("fluids/flowing_broadcast.wgsl"),
    };
    let diffusion = 2.0 * continuity.diffusion * 0.5 * medium.range() * medium.sound;
    let params = vec![
        ("factor", Scalar::Float(factor)),
        ("diffusion", Scalar::Float(diffusion)),
        ("weight", Scalar::Vector(continuity.weight)),
    ];
    let (me, who) = (*medium, problem.clone());
    let twin = move |host: &Host| {
        let (density, half) = (host.read(DENSITY)?, 0.5 * factor * host.world().dt);
        let smoothing = 0.5 * me.range();
        let rates = gathered(
            host,
            me.range(),
            |body| !who.is_held(body.index),
            |a, b, r, rate: &mut f64| {
                let v = b.velocity - a.velocity;
                let middle = r - half * v;
                // Beyond the range the kernel has no slope.
                *rate += b.mass * me.gradient(middle) * middle.dot(v);
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

/// The kernel that advances density by `factor` of the step.
///
/// # Errors
/// When a shader does not compile.
pub fn advance(factor: f64, problem: &Problem) -> Result<Kernel, Error> {
    let who = problem.clone();
    let (files, params) = ([crate::shader!("fluids/density_advance.wgsl")], [("factor", Scalar::Float(factor))]);
    alone("fluid density advance", &files, &params, &[], problem, move |host| {
        let (mut density, rate) = (host.write(DENSITY)?, host.read(DENSITY_RATE)?);
        let each = density.iter_mut().zip(rate.iter()).enumerate();
        each.filter(|(i, _)| !who.is_held(*i)).for_each(|(_, (rho, rate))| *rho += factor * host.world().dt * rate);
        Ok(())
    })
}

/// A kernel for each particle alone, who knows whether it is held, with such parameters and constants.
fn alone(
    name: &str,
    files: &[crate::kernel::Source],
    params: &[(&'static str, Scalar)],
    constants: &[(&'static str, f64)],
    problem: &Problem,
    twin: impl Fn(&Host) -> Result<(), Error> + Send + Sync + 'static,
) -> Result<Kernel, Error> {
    let (holding, tables) = problem.holding();
    let mut sources = vec![holding, crate::shader!("world.wgsl"), crate::shader!("fields.wgsl")];
    sources.extend_from_slice(files);
    let shader = Shader::join(&sources)?;
    let uniforms = block(name, &shader, "params", params)?;
    let constants = shader.reflection().known(constants);
    Ok(Kernel {
        name: name.to_owned(),
        passes: vec![Pass { constants, uniforms, ..Pass::new(shader, problem.count) }],
        twin: Some(Arc::new(twin)),
        sizes: Vec::new(),
        scratch: Vec::new(),
        tables,
    })
}
