//! What pressure and friction do.

use std::sync::Arc;

use glam::{DVec3, Vec4};

use super::medium::FLOWING;
use super::{FLOW, Medium};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Host, Kernel, Problem, Scalar};
use crate::neighbors::Grid;
use crate::visit::{Particle, Sweep, gathered};

/// How a fluid rubs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// α of the artificial viscosity (Monaghan 1992).
    pub alpha: f64,
    /// The kinematic viscosity ν (Morris, Fox & Zhu 1997) \[length² / time\].
    pub viscosity: f64,
    /// How much of both walls have: 0 lets slip.
    pub wall: f64,
}

/// What pressure walls have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Walls {
    /// That of whoever asks (Akinci et al. 2012).
    Mirror,
    /// That of the fluid around them, and what weighs between (Adami, Hu & Adams 2012).
    Extrapolate {
        /// The weight of the fluid \[length / time²\].
        weight: DVec3,
    },
}

/// The kernel that adds accelerations, and the internal energy as the potential.
///
/// # Errors
/// When the range is none, or a shader does not compile.
pub fn pressure(medium: &Medium, friction: Friction, walls: Walls, problem: &Problem) -> Result<Kernel, Error> {
    let grid = medium.grid(problem)?;
    let files = medium.files(&[crate::shader!("fluids/pressure.wgsl")]);
    let params = vec![
        ("alpha", Scalar::Float(friction.alpha)),
        ("viscosity", Scalar::Float(friction.viscosity)),
        ("wall", Scalar::Float(friction.wall)),
        ("mirror", Scalar::Uint(u32::from(walls == Walls::Mirror))),
    ];
    let (me, slots) = (*medium, grid.clone());
    let twin = move |host: &Host| {
        let states = states(host, &slots)?;
        let flows = |body: &Particle| states[body.index].x > 0.0;
        let felt = gathered(host, me.range(), flows, |a, b, r, sum: &mut DVec3| {
            *sum += push(&me, friction, walls, [a, b], [states[a.index], states[b.index]], r);
        })?;
        let mut acceleration = host.write(ACCELERATION)?;
        for (i, felt) in felt.into_iter().enumerate() {
            if let Some(felt) = felt {
                acceleration[i] += felt.extend(states[i].z);
            }
        }
        Ok(())
    };
    let (name, constants) = ("fluid pressure".to_owned(), medium.constants());
    let sweep = Sweep { name, candidate: FLOWING, files, params, constants, twin: Arc::new(twin), grid };
    flowing(sweep, &[], problem)
}

/// The kernel of a search that asks for what flows, and for more that is in the order of the grid.
pub(super) fn flowing(sweep: Sweep, more: &[&'static str], problem: &Problem) -> Result<Kernel, Error> {
    let fields = [&[FLOW], more].concat().into_iter().map(|name| sweep.grid.field(name)).collect::<Vec<_>>();
    let mut kernel = sweep.kernel(problem)?;
    kernel.passes.iter_mut().for_each(|pass| pass.fields.extend_from_slice(&fields));
    Ok(kernel)
}

/// What flows, by id: density, p / ρ² and energy.
pub(super) fn states(host: &Host, grid: &Grid) -> Result<Vec<DVec3>, Error> {
    by_id(host, grid, FLOW)
}

/// What is in the order of the grid, by id; 0 of who is not in it, such as those who do not live.
pub(super) fn by_id(host: &Host, grid: &Grid, field: &'static str) -> Result<Vec<DVec3>, Error> {
    let (ids, slots) = (grid.occupants(host)?, host.reading::<Vec4>(&grid.field(field).1)?);
    let mut all = vec![DVec3::ZERO; host.world().count as usize];
    ids.iter().zip(slots.iter()).for_each(|(id, slot)| all[*id as usize] = slot.truncate());
    Ok(all)
}

/// What one does to another, with r from the latter to the former; states are density, p / ρ² and energy.
fn push(
    medium: &Medium,
    friction: Friction,
    walls: Walls,
    [me, you]: [&Particle; 2],
    [mine, yours]: [DVec3; 2],
    r: DVec3,
) -> DVec3 {
    let wall = yours.x == 0.0;
    let density = if wall { medium.density } else { yours.x };
    let mirrored = wall && walls == Walls::Mirror;
    let pressure = if mirrored { mine.y * (mine.x / medium.density).powi(2) } else { yours.y };
    let share = if wall { friction.wall } else { 1.0 };
    let (v, length) = (you.velocity - me.velocity, 0.5 * medium.range());
    let near = r.length_squared() + 0.01 * length * length;
    let closing = v.dot(r).min(0.0) * length / near;
    let artificial = friction.alpha * medium.sound * closing / (0.5 * (mine.x + density));
    let laminar = friction.viscosity * (1.0 / mine.x + 1.0 / density);
    you.mass * medium.gradient(r) * ((mine.y + pressure - share * artificial) * r - share * laminar * v)
}
