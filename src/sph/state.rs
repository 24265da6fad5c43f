//! The equation of state: pressure of density.

use std::sync::Arc;

use glam::{DVec4, Vec4};

use super::{DENSITY, FLOW, Medium};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Pass, Problem, Shader};
use crate::neighbors::{SORTED_ID, STARTS};

/// The kernel that stores density, pressure and energy in the order of the cell list.
///
/// # Errors
/// When the range is invalid, or a shader does not compile.
pub fn state(medium: &Medium, problem: &Problem) -> Result<Kernel, Error> {
    let grid = medium.grid(problem)?;
    let (holding, tables) = problem.holding();
    let shader = Shader::join(&[
        holding,
        crate::shader!("world.wgsl"),
        crate::shader!("fields.wgsl"),
        crate::shader!("neighbors/starts.wgsl"),
        grid.present(problem),
        medium.smoothing.source(),
        crate::shader!("sph/medium.wgsl"),
        crate::shader!("sph/state.wgsl"),
    ])?;
    let mut constants = grid.constants(&shader);
    constants.extend(shader.reflection().known(&medium.constants()));
    let fields = [SORTED_ID, FLOW, STARTS].map(|name| grid.field(name));
    let pass = Pass { constants, ..Pass::new(shader, problem.capacity) }.on(&fields);
    let (starts, cells) = (grid.field(STARTS).1, u64::from(grid.bins()));
    let (me, all) = (*medium, problem.clone());
    let reference = move |host: &Host| {
        let (ids, density) = (grid.occupants(host)?, host.read(DENSITY)?);
        let mut flow = host.writing::<Vec4>(&grid.field(FLOW).1)?;
        for (flow, id) in flow.iter_mut().zip(ids.iter().map(|id| *id as usize)) {
            let (pressure, energy) = me.state(density[id]);
            *flow = if all.is_held(id) { DVec4::ZERO } else { DVec4::new(density[id], pressure, energy, 0.0) };
        }
        Ok(())
    };
    Ok(Kernel {
        name: "fluid state".to_owned(),
        passes: vec![pass],
        reference: Some(Arc::new(reference)),
        sizes: vec![(starts, cells)],
        scratch: Vec::new(),
        tables,
    })
}
