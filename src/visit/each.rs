//! Each particle alone.

use super::Law;
use crate::error::Error;
use crate::kernel::{Kernel, Pass, Problem, Shader};

pub fn kernel(law: Law, problem: &Problem) -> Result<Kernel, Error> {
    let (own, visit) = if law.accelerates() {
        (("force", "fn force(me: Particle) -> vec4f"), crate::shader!("visit/each.wgsl"))
    } else {
        (("update", "fn update(me: Particle)"), crate::shader!("visit/each_columns.wgsl"))
    };
    law.requires(&[own])?;
    let mut files =
        vec![crate::shader!("world.wgsl"), crate::shader!("fields.wgsl"), crate::shader!("particle.wgsl"), visit];
    files.extend(law.alarm_file());
    files.extend(law.files(problem));
    let shader = Shader::join(&files)?;
    let uniforms = law.uniforms(&shader)?;
    let mut constants = problem.constants(&shader);
    constants.extend(law.mark());
    let sizes = law.alarm();
    let pass = Pass { constants, uniforms, ..Pass::new(shader, problem.capacity) };
    Ok(Kernel {
        name: law.name,
        passes: vec![pass],
        reference: law.reference,
        sizes,
        scratch: Vec::new(),
        tables: Vec::new(),
    })
}
