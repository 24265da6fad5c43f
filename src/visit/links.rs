//! Everybody meets those that it is tied to: by springs, or as corners of joints and triangles.

use super::{Law, Over};
use crate::error::Error;
use crate::kernel::{Kernel, Name, Pass, Problem, Shader};

/// Where each particle's links begin, and the links; for joints and triangles the names in the shader stand for others.
pub const LINK_START: &str = "link_start";
/// See [`LINK_START`].
pub const LINK: &str = "link";

/// The tables that a visit reads, as shader and plan know them, with the words of an element.
fn tables(over: Over) -> [(&'static str, &'static str); 2] {
    match over {
        Over::Joints => [("corner_start", "joint_start"), ("corner", "joint")],
        Over::Triangles => [("corner_start", "triangle_start"), ("corner", "triangle")],
        _ => [(LINK_START, LINK_START), (LINK, LINK)],
    }
}

/// Binds the tables that a visit reads to a kernel.
pub fn bind(mut kernel: Kernel, over: Over, problem: &Problem) -> Kernel {
    let network = &problem.network;
    let words = match over {
        Over::Joints => [&network.joint_start, &network.joint],
        Over::Triangles => [&network.triangle_start, &network.triangle],
        _ => [&network.link_start, &network.link],
    };
    for ((inside, field), words) in tables(over).into_iter().zip(words) {
        let stride = kernel.passes.iter().flat_map(|pass| &pass.shader.reflection().bindings);
        let stride = stride.filter(|binding| binding.name == inside).map(|binding| binding.stride).max();
        // A law may have no use for a table.
        let Some(stride) = stride else { continue };
        kernel.sizes.push((field.into(), (4 * words.len() as u64) / stride.max(1)));
        kernel.tables.push((field.into(), words.clone()));
        if inside != field {
            let renamed: [(&'static str, Name); 1] = [(inside, field.into())];
            kernel.passes = kernel.passes.into_iter().map(|pass| pass.on(&renamed)).collect();
        }
    }
    kernel
}

pub fn kernel(law: Law, problem: &Problem) -> Result<Kernel, Error> {
    let corners = law.over != Over::Links;
    let gather = if corners {
        "fn gather(me: Particle, corner: Corner, sum: ptr<function, Sum>)"
    } else {
        "fn gather(me: Particle, you: Particle, r: vec3f, link: Link, sum: ptr<function, Sum>)"
    };
    law.requires(&[("gather", gather), ("finish", "fn finish(me: Particle, sum: Sum) -> vec4f")])?;
    let mut files = vec![crate::shader!("world.wgsl"), crate::shader!("fields.wgsl"), crate::shader!("particle.wgsl")];
    if corners {
        files.push(crate::shader!("visit/corners.wgsl"));
    } else {
        files.extend([crate::shader!("visit/link_table.wgsl"), crate::shader!("visit/links.wgsl")]);
    }
    files.extend(law.files().into_iter().filter(|file| file.file != "shaders/visit/everybody.wgsl"));
    let shader = Shader::join(&files)?;
    let (uniforms, constants) = (law.uniforms(&shader)?, problem.constants(&shader));
    let network = &problem.network;
    let elements = match law.over {
        Over::Joints => network.joint_start.last(),
        Over::Triangles => network.triangle_start.last(),
        _ => network.link_start.last(),
    };
    let work = u64::from(problem.count) + u64::from(elements.copied().unwrap_or(0));
    let pass = Pass { constants, uniforms, work, ..Pass::new(shader, problem.count) };
    let (name, twin, over) = (law.name, law.twin, law.over);
    let (sizes, scratch, tables) = (Vec::new(), Vec::new(), Vec::new());
    Ok(bind(Kernel { name, passes: vec![pass], twin, sizes, scratch, tables }, over, problem))
}
