//! Each particle is evaluated with the particles that it is linked to: by springs, or as corners of joints, dihedrals and triangles.

use std::sync::Arc;

use super::{Law, Over, Tables};
use crate::error::Error;
use crate::kernel::{ALARM, ALARM_WORDS, Kernel, Name, Pass, Problem, Shader};
use crate::links::Network;

/// The start of each particle's links, and the links; for what has corners these names of the shader are bound to other tables.
pub const LINK_START: &str = "link_start";
/// See [`LINK_START`].
pub const LINK: &str = "link";

/// The tables that a visit may read: their names in shaders and in plans, and their words.
fn tables(over: Over, network: &Network) -> Vec<(&'static str, &'static str, &Arc<Vec<u32>>)> {
    match over {
        Over::Joints => {
            vec![("corner_start", "joint_start", &network.joint_start), ("corner", "joint", &network.joint)]
        }
        Over::Dihedrals => {
            vec![("corner_start", "dihedral_start", &network.dihedral_start), ("corner", "dihedral", &network.dihedral)]
        }
        Over::Triangles => {
            vec![("corner_start", "triangle_start", &network.triangle_start), ("corner", "triangle", &network.triangle)]
        }
        _ => vec![
            (LINK_START, LINK_START, &network.link_start),
            (LINK, LINK, &network.link),
            ("partner_start", "partner_start", &network.partner_start),
            ("partner", "partner", &network.partner),
            ("link_kind", "link_kind", &network.kind),
        ],
    }
}

/// Binds the tables that a visit reads to a kernel.
#[must_use]
pub fn bind(mut kernel: Kernel, over: Over, problem: &Problem) -> Kernel {
    for (inside, field, words) in tables(over, &problem.network) {
        let stride = kernel.passes.iter().flat_map(|pass| &pass.shader.reflection().bindings);
        let stride = stride.filter(|binding| binding.name == inside).map(|binding| binding.stride).max();
        // A law may not use a table.
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
    // The virial of a law has these functions in several files.
    if law.beside.is_empty() {
        law.requires(&[("gather", gather), law.finish()])?;
    }
    let mut files = vec![crate::shader!("world.wgsl"), crate::shader!("fields.wgsl"), problem.precision.particle()];
    let tables = Tables::of(problem);
    if corners {
        files.push(match law.over {
            Over::Dihedrals => crate::shader!("visit/corner_of_four.wgsl"),
            _ => crate::shader!("visit/corner_of_three.wgsl"),
        });
        files.push(crate::shader!("visit/corners.wgsl"));
    } else {
        files.extend([tables.file(), crate::shader!("visit/links.wgsl")]);
    }
    files.push(law.result());
    files.extend(law.alarm_file());
    files.extend(law.files(problem));
    let shader = Shader::join(&files)?;
    let (uniforms, mut constants) = (law.uniforms(&shader)?, problem.constants(&shader));
    constants.extend(law.mark());
    let has = |name: &str| shader.reflection().overrides.contains_key(name);
    if has("DAMPED") && !problem.network.damped() {
        constants.push(("DAMPED", 0.0));
    }
    let network = &problem.network;
    let elements = match law.over {
        Over::Joints => network.joint_start.last(),
        Over::Dihedrals => network.dihedral_start.last(),
        Over::Triangles => network.triangle_start.last(),
        _ => network.link_start.last(),
    };
    let work = u64::from(problem.capacity) + u64::from(elements.copied().unwrap_or(0));
    let alarms = shader.reflection().binding(ALARM.name).is_some();
    let sizes = if alarms { vec![(ALARM.name.into(), ALARM_WORDS as u64)] } else { Vec::new() };
    let pass = Pass { constants, uniforms, work, ..Pass::new(shader, problem.capacity) };
    let reference = match &law.tied {
        Some(reference) => Some(reference(tables)),
        None => law.reference,
    };
    let (name, over) = (law.name, law.over);
    let (scratch, tables) = (Vec::new(), Vec::new());
    Ok(bind(Kernel { name, passes: vec![pass], reference, sizes, scratch, tables }, over, problem))
}
