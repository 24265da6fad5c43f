//! Accelerations by pressure and viscosity.

use glam::DVec3;

use super::medium::FLOWING;
use super::{Boxed, FLOW, Medium};
use crate::kernel::{ACCELERATION, Scalar, World};
use crate::visit::{Law, Outcome, Over, Particle};

/// The viscosities of a fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// α of the artificial viscosity (Monaghan 1992).
    pub alpha: f64,
    /// The kinematic viscosity ν \[length² / time\].
    pub viscosity: f64,
    /// Its form.
    pub form: Form,
    /// The part of both that acts at walls: 0 for free slip.
    pub wall: f64,
}

/// The form of laminar viscosity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Along the line between two particles (Monaghan & Gingold 1983; Cleary 1998; Monaghan 2005), which preserves the angular
    /// momentum: 2 (D + 2) ν Σ m / ρ̄ (v·r) / r² ∇W, with ρ̄ the mean density of the two.
    ///
    /// With v·r = r_b r_c ∂_b v_c + ½ r_b r_c r_e ∂_b ∂_e v_c and ∇W = g r, even moments remain: ½ ∂_b ∂_e v_c ∫ g r_a r_b r_c r_e / r² dr.
    /// The mean of r_a r_b r_c r_e over directions is r⁴ (δ_ab δ_ce + δ_ac δ_be + δ_ae δ_bc) / (D (D + 2)), and ∫ g r² dr = −D, so that the
    /// sum is −(∇²v + 2 ∇∇·v) / (2 (D + 2)): with the factor it is ν ∇²v where the flow is free of divergence (after Español & Revenga
    /// 2003). On a lattice its sums are far from the integrals where neighbours are few: see the guide.
    Central,
    /// Along the difference of the velocities (Morris, Fox & Zhu 1997): ν Σ m (1 / ρ + 1 / ρ') g v. It exerts a torque where neighbours are
    /// missing on one side, at free surfaces.
    Morris,
}

impl Friction {
    /// The factors of the central form and of Morris' in the law; the other one is 0.
    fn factors(&self, medium: &Medium) -> [f64; 2] {
        match self.form {
            Form::Central => [4.0 * f64::from(medium.dimensions + 2) * self.viscosity, 0.0],
            Form::Morris => [0.0, self.viscosity],
        }
    }
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
#[must_use]
pub fn pressure(of: &Boxed, over: Over, friction: Friction, walls: Walls) -> Law {
    let (of, wgsl) = (of.clone(), crate::shader!("sph/pressure.wgsl"));
    let law = Law::outlined("fluid pressure", over, wgsl, &[ACCELERATION.name], move |law, problem| {
        let medium = of(&problem.bounds)?;
        let search = medium.search(law.over, FLOWING, &[FLOW], problem)?;
        let [central, morris] = friction.factors(&medium);
        let params = vec![
            ("alpha", Scalar::Float(friction.alpha)),
            ("central", Scalar::Float(central)),
            ("morris", Scalar::Float(morris)),
            ("wall", Scalar::Float(friction.wall)),
            ("mirror", Scalar::Uint(u32::from(walls == Walls::Mirror))),
        ];
        let smoothed = medium.smoothed();
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
        Ok(law.searched(search, params, gather, finish))
    });
    // Morris' friction does not act along the line between two. Fixed particles take what they receive, as of all laws.
    let along = friction.viscosity == 0.0 || friction.form == Form::Central;
    Law { reciprocal: along, ..law }
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
    let (along, square) = (v.dot(r), r.length_squared());
    let closing = along.min(0.0) * length / near;
    let artificial = friction.alpha * medium.sound * closing / (0.5 * (mine.x + density));
    let [central, morris] = friction.factors(medium);
    let central = if square > 0.0 { central / (mine.x + density) * along / square } else { 0.0 };
    let morris = morris * (1.0 / mine.x + 1.0 / density);
    (mine.y + pressure - share * (artificial + central)) * r - share * morris * v
}
