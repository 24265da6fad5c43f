//! Each particle alone.

use super::Law;
use crate::error::Error;
use crate::kernel::{Kernel, Pass, Problem, Shader};

pub fn kernel(law: Law, problem: &Problem) -> Result<Kernel, Error> {
    law.requires(&[("force", "fn force(me: Particle) -> vec4f")])?;
    let mut files = vec![
        crate::shader!("world.wgsl"),
        crate::shader!("fields.wgsl"),
        crate::shader!("particle.wgsl"),
        crate::shader!("visit/each.wgsl"),
    ];
    files.extend(law.files());
    let shader = Shader::join(&files)?;
    let uniforms = law.uniforms(&shader)?;
    let constants = problem.constants(&shader);
    let pass = Pass { constants, uniforms, ..Pass::new(shader, problem.count) };
    Ok(Kernel {
        name: law.name,
        passes: vec![pass],
        twin: law.twin,
        sizes: Vec::new(),
        scratch: Vec::new(),
        tables: Vec::new(),
    })
}
