//! Accelerations by pressure and viscosity.

use glam::DVec3;

use super::medium::FLOWING;
use super::{FLOW, Medium};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Problem, Scalar, World};
use crate::visit::{Law, Outcome, Particle};

/// The viscosities of a fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// α of the artificial viscosity (Monaghan 1992).
    pub alpha: f64,
    /// The kinematic viscosity ν (Morris, Fox & Zhu 1997) \[length² / time\].
    pub viscosity: f64,
    /// The part of both that acts at walls: 0 for free slip.
    pub wall: f64,
}

/// The pressure of walls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Walls {
    /// That of the fluid particle at the wall (Akinci et al. 2012).
    Mirror,
    /// That of the fluid around them, and the hydrostatic pressure in between (Adami, Hu & Adams 2012).
    Extrapolate {
        /// The gravity of the fluid \[length / time²\].
        weight: DVec3,
    },
}

/// The law of accelerations, with the internal energy as the potential.
///
/// # Errors
/// When the range is invalid.
pub fn pressure(medium: &Medium, friction: Friction, walls: Walls, problem: &Problem) -> Result<Law, Error> {
    let search = medium.search(FLOWING, &[FLOW], problem)?;
    let params = vec![
        ("alpha", Scalar::Float(friction.alpha)),
        ("viscosity", Scalar::Float(friction.viscosity)),
        ("wall", Scalar::Float(friction.wall)),
        ("mirror", Scalar::Uint(u32::from(walls == Walls::Mirror))),
    ];
    let (medium, smoothed) = (*medium, medium.smoothed());
    let gather = move |me: &Particle, you: &Particle, r, _: &World, sum: &mut DVec3| {
        let push = push(&medium, friction, walls, [me, you], [flow(me), flow(you)], r);
        *sum += you.mass * smoothed.gradient(r) * push;
    };
    let finish = |me: &Particle, sum: &DVec3, _: &World, outcome: &mut Outcome| {
        if flow(me).x > 0.0 {
            // Twice of what is all its own: of each pair's energy a visit leaves half.
            outcome.accelerate(sum.extend(2.0 * flow(me).z));
        }
    };
    let wgsl = crate::shader!("sph/pressure.wgsl");
    let law = Law::searching("fluid pressure", search, wgsl, params, &[ACCELERATION.name], gather, finish);
    // Walls are not pushed, and laminar friction does not act along the line between two.
    Ok(Law { reciprocal: problem.held.is_empty() && friction.viscosity <= 0.0, ..law })
}

/// The flow variables of a particle: density, p / ρ² and energy; 0 for walls.
pub(super) fn flow(of: &Particle) -> DVec3 {
    of.vector(FLOW).unwrap_or_default().truncate()
}

/// The factor of a mass and of the kernel's slope in the acceleration by that mass, with r from the accelerated particle to the mass;
/// states are density, p / ρ² and energy.
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
    (mine.y + pressure - share * artificial) * r - share * laminar * v
}
