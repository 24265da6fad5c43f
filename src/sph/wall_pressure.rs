//! The pressure of walls, where it is not that of the fluid particle.

use std::sync::Arc;

use glam::{DVec3, Vec4};

use super::medium::FLOWING;
use super::pressure::flow;
use super::{FLOW, Medium};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Pass, Problem, Scalar, Shader, World};
use crate::visit::{Law, Outcome, Particle, Search};

/// The pressure that walls find, over ρ₀², in the order of the cell list.
const WALL_PRESSURE: &str = "wall_pressure";

/// The kernels that find the pressure of walls (Adami, Hu & Adams 2012, eq. 27), and write it down beside that of the fluid. That
/// equation has g − a of the wall's own acceleration a, where this has g: a step knows a place and a velocity of a moving wall, and no
/// more. What is left out is ρ a times the half of a support, at a wall that accelerates.
///
/// # Errors
/// When the range is invalid, or a shader does not compile.
pub fn wall_pressure(medium: &Medium, weight: DVec3, problem: &Problem) -> Result<[Kernel; 2], Error> {
    let search = Search { fixed: true, ..medium.search(FLOWING, &[FLOW, WALL_PRESSURE], problem)? };
    let (medium, smoothed) = (*medium, medium.smoothed());
    let (fixed, grid) = (problem.clone(), search.grid.clone());
    let gather = move |_: &Particle, you: &Particle, r: DVec3, _: &World, sum: &mut [f64; 2]| {
        let state = flow(you);
        if state.x > 0.0 {
            sum[0] += (state.y * state.x - weight.dot(r)) * state.x * smoothed.kernel(r);
            sum[1] += smoothed.kernel(r);
        }
    };
    let finish = move |me: &Particle, [sum, number]: &[f64; 2], _: &World, outcome: &mut Outcome| {
        if fixed.is_held(me.index) {
            let p = if *number > 0.0 { sum / number } else { 0.0 };
            let p = if medium.negative { p } else { p.max(0.0) };
            outcome.set(WALL_PRESSURE, p / (medium.density * medium.density));
        }
    };
    let (wgsl, params) = (crate::shader!("sph/wall_pressure.wgsl"), vec![("weight", Scalar::Vector(weight))]);
    let find = Law::searching("fluid wall pressure", search, wgsl, params, &[WALL_PRESSURE], gather, finish);
    let fields = [WALL_PRESSURE, FLOW].map(|name| grid.field(name));
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("fields.wgsl"),
        crate::shader!("sph/wall_state.wgsl"),
    ])?;
    let reference = move |host: &Host| {
        let pressure = host.reading::<f32>(&grid.field(WALL_PRESSURE).1)?;
        let mut flow = host.writing::<Vec4>(&grid.field(FLOW).1)?;
        let walls = flow.iter_mut().zip(pressure.iter()).filter(|(flow, _)| flow.x <= 0.0);
        walls.for_each(|(flow, pressure)| flow.y = *pressure);
        Ok(())
    };
    let write = Kernel {
        name: "fluid wall state".to_owned(),
        passes: vec![Pass::new(shader, problem.capacity).on(&fields)],
        reference: Some(Arc::new(reference)),
        sizes: Vec::new(),
        scratch: Vec::new(),
        tables: Vec::new(),
    };
    Ok([find.kernel(problem)?, write])
}
