//! Each particle alone.

use std::sync::Arc;

use glam::DVec4;
use rayon::prelude::*;

use super::{Body, Law, Problem, bodies};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Kernel, Pass, Shader, Twin, World};

pub fn kernel(law: Law, problem: &Problem) -> Result<Kernel, Error> {
    law.requires(&[("force", "fn force(me: Particle) -> vec4f")])?;
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("particle.wgsl"),
        crate::shader!("visit/each.wgsl"),
        law.wgsl.clone(),
    ])?;
    let uniforms = law.uniforms(&shader)?;
    let pass = Pass { constants: problem.constants(), uniforms, ..Pass::new(shader, problem.count) };
    Ok(Kernel { name: law.name, passes: vec![pass], twin: law.twin, sizes: Vec::new(), scratch: Vec::new() })
}

pub fn twin(rule: impl Fn(&Body, &World) -> DVec4 + Send + Sync + 'static) -> Twin {
    Arc::new(move |host| {
        let bodies = bodies(host)?;
        let world = host.world();
        let mut acceleration = host.write(ACCELERATION)?;
        acceleration.par_iter_mut().zip(&bodies).for_each(|(a, me)| *a += rule(me, &world));
        Ok(())
    })
}
