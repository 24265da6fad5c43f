//! The pressure of walls, where it is not that of the fluid particle.

use std::sync::Arc;

use glam::{DVec3, Vec4};

use super::medium::FLOWING;
use super::pressure::flow;
use super::{Boxed, FLOW, Medium};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Pass, Problem, Scalar, Shader, World};
use crate::visit::{Law, Outcome, Over, Particle, Search, placed};

/// The pressure that walls find, over ρ₀², at their places in the search.
const WALL_PRESSURE: &str = "wall_pressure";

/// The law that finds the pressure of walls (Adami, Hu & Adams 2012, eq. 27). That equation has g − a of the wall's own acceleration a,
/// where this has g: a step knows a place and a velocity of a moving wall, and no more. What is left out is ρ a times the half of a
/// support, at a wall that accelerates.
#[must_use]
pub fn wall_pressure(of: &Boxed, over: Over, weight: DVec3) -> Law {
    let (of, wgsl) = (of.clone(), crate::shader!("sph/wall_pressure.wgsl"));
    Law::outlined("fluid wall pressure", over, wgsl, &[WALL_PRESSURE], move |law, problem| {
        let medium = of(&problem.bounds)?;
        let search = Search { fixed: true, ..medium.search(law.over, FLOWING, &[FLOW, WALL_PRESSURE], problem)? };
        let (smoothed, fixed) = (medium.smoothed(), problem.clone());
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
        Ok(law.searched(search, vec![("weight", Scalar::Vector(weight))], gather, finish))
    })
}

/// The kernel that stores it beside the pressure of the fluid; `over` is the visit, settled.
///
/// # Errors
/// When the range is invalid, or a shader does not compile.
pub fn wall_state(medium: &Medium, over: Over, problem: &Problem) -> Result<Kernel, Error> {
    let grid = medium.grid_over(over, problem)?;
    let fields = [WALL_PRESSURE, FLOW].map(|name| placed(grid.as_ref(), name));
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("fields.wgsl"),
        crate::shader!("sph/wall_state.wgsl"),
    ])?;
    let [found, states] = fields.clone().map(|(_, field)| field);
    let reference = move |host: &Host| {
        let pressure = host.reading::<f32>(&found)?;
        let mut flow = host.writing::<Vec4>(&states)?;
        let walls = flow.iter_mut().zip(pressure.iter()).filter(|(flow, _)| flow.x <= 0.0);
        walls.for_each(|(flow, pressure)| flow.y = *pressure);
        Ok(())
    };
    Ok(Kernel {
        name: "fluid wall state".to_owned(),
        passes: vec![Pass::new(shader, problem.capacity).on(&fields)],
        reference: Some(Arc::new(reference)),
        sizes: Vec::new(),
        scratch: Vec::new(),
        tables: Vec::new(),
    })
}
