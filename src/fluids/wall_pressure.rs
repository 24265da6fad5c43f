//! The pressure of walls, where it is not that of whoever asks.

use std::sync::Arc;

use glam::{DVec3, Vec4};

use super::medium::FLOWING;
use super::pressure::states;
use super::{FLOW, Medium};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Pass, Problem, Scalar, Shader};
use crate::visit::{Sweep, gathered};

/// The pressure that walls find, over ρ₀², in the order of the grid.
const WALL_PRESSURE: &str = "wall_pressure";

/// The kernels that find the pressure of walls (Adami, Hu & Adams 2012, eq. 27), and write it down beside that of the fluid. That
/// equation has g − a of the wall's own acceleration a, where this has g: a step knows a place and a velocity of who is led, and no
/// more. What is left out is ρ a times the half of a support, at a wall that is led and speeds up.
///
/// # Errors
/// When the range is none, or a shader does not compile.
pub fn wall_pressure(medium: &Medium, weight: DVec3, problem: &Problem) -> Result<[Kernel; 2], Error> {
    let grid = medium.grid(problem)?;
    let files = medium.files(&[crate::shader!("fluids/wall_pressure.wgsl")]);
    let (me, slots, who) = (*medium, grid.clone(), problem.clone());
    let twin = move |host: &Host| {
        let states = states(host, &slots)?;
        let found = gathered(
            host,
            me.range(),
            |body| who.is_held(body.index),
            |_, b, r, sum: &mut [f64; 2]| {
                let state = states[b.index];
                if state.x > 0.0 {
                    sum[0] += (state.y * state.x - weight.dot(r)) * state.x * me.kernel(r);
                    sum[1] += me.kernel(r);
                }
            },
        )?;
        let ids = slots.occupants(host)?;
        let mut pressure = host.writing::<f32>(&slots.field(WALL_PRESSURE).1)?;
        for (pressure, id) in pressure.iter_mut().zip(ids.iter()) {
            if let Some([sum, number]) = found[*id as usize] {
                let p = if number > 0.0 { sum / number } else { 0.0 };
                *pressure = if me.negative { p } else { p.max(0.0) } / (me.density * me.density);
            }
        }
        Ok(())
    };
    let (params, constants) = (vec![("weight", Scalar::Vector(weight))], medium.constants());
    let name = "fluid wall pressure".to_owned();
    let sweep = Sweep { name, candidate: FLOWING, files, params, constants, twin: Arc::new(twin), grid: grid.clone() };
    let mut find = sweep.kernel_of_all(problem)?;
    let fields = [WALL_PRESSURE, FLOW].map(|name| grid.field(name));
    find.passes.iter_mut().for_each(|pass| pass.fields.extend_from_slice(&fields));
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("fields.wgsl"),
        crate::shader!("fluids/wall_state.wgsl"),
    ])?;
    let twin = move |host: &Host| {
        let pressure = host.reading::<f32>(&grid.field(WALL_PRESSURE).1)?;
        let mut flow = host.writing::<Vec4>(&grid.field(FLOW).1)?;
        let walls = flow.iter_mut().zip(pressure.iter()).filter(|(flow, _)| flow.x <= 0.0);
        walls.for_each(|(flow, pressure)| flow.y = *pressure);
        Ok(())
    };
    let write = Kernel {
        name: "fluid wall state".to_owned(),
        passes: vec![Pass::new(shader, problem.count).on(&fields)],
        twin: Some(Arc::new(twin)),
        sizes: Vec::new(),
        scratch: Vec::new(),
        tables: Vec::new(),
    };
    Ok([find, write])
}
