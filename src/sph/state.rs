//! The equation of state: pressure of density.

use std::sync::Arc;

use glam::{DVec4, Vec4};

use super::{DENSITY, FLOW, Medium};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Pass, Problem, Reference, Shader};
use crate::neighbors::{SORTED_ID, STARTS};
use crate::visit::{Over, placed};

/// The kernel that stores density, pressure and energy: in the order of the cell list, or by particle over a kept list; `over` is the visit,
/// settled.
///
/// # Errors
/// When the range is invalid, or a shader does not compile.
pub fn state(medium: &Medium, over: Over, problem: &Problem) -> Result<Kernel, Error> {
    let grid = medium.grid_over(over, problem)?;
    let (holding, tables) = problem.holding();
    let mut files = vec![holding, crate::shader!("world.wgsl"), crate::shader!("fields.wgsl")];
    match &grid {
        Some(grid) => files.extend([
            crate::shader!("neighbors/starts.wgsl"),
            grid.present(problem),
            crate::shader!("sph/by_slot.wgsl"),
        ]),
        None => files.extend([problem.active(), crate::shader!("sph/by_particle.wgsl")]),
    }
    files.extend([medium.smoothing.source(), crate::shader!("sph/medium.wgsl"), crate::shader!("sph/state.wgsl")]);
    let shader = Shader::join(&files)?;
    let mut constants = grid.as_ref().map_or_else(Vec::new, |grid| grid.constants(&shader));
    constants.extend(shader.reflection().known(&medium.constants()));
    let pass = Pass { constants, ..Pass::new(shader, problem.capacity) };
    let (_, states) = placed(grid.as_ref(), FLOW);
    let mut pass = pass.on(&[(FLOW, states.clone())]);
    let mut sizes = Vec::new();
    if let Some(grid) = &grid {
        pass = pass.on(&[SORTED_ID, STARTS].map(|name| grid.field(name)));
        sizes.push((grid.field(STARTS).1, u64::from(grid.bins())));
    }
    let (me, all) = (*medium, problem.clone());
    let reference = move |host: &Host| {
        let density = host.read(DENSITY)?;
        let (ids, is_active) = match &grid {
            Some(grid) => (grid.occupants(host)?, None),
            None => ((0..host.world().count).collect(), Some(host.is_active()?)),
        };
        let mut flow = host.writing::<Vec4>(&states)?;
        for (flow, id) in flow.iter_mut().zip(ids.iter().map(|id| *id as usize)) {
            let (pressure, energy) = me.state(density[id]);
            let without = all.is_held(id) || is_active.as_ref().is_some_and(|is_active| !is_active(id));
            *flow = if without { DVec4::ZERO } else { DVec4::new(density[id], pressure, energy, 0.0) };
        }
        Ok(())
    };
    let (name, reference) = ("fluid state".to_owned(), Some(Arc::new(reference) as Reference));
    Ok(Kernel { name, passes: vec![pass], reference, sizes, scratch: Vec::new(), tables })
}
