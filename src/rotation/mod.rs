//! Rigid bodies: orientations advanced by angular velocities, and these by torques.
//!
//! A body has four columns. Its `orientation` is a unit quaternion q (x, y, z | w), which turns components along its principal
//! axes into space, v = R(q) vᵇ. Its `angular_velocity` ω \[1 / time\] and `torque` τ \[mass length² / time²\] are in space, so
//! that laws between bodies use them as they are: the surface of a ball moves by v + ω × r. Its `inertia` holds its principal
//! moments \[mass length²\], which are constant; about an axis whose moment is 0 it does not turn.
//!
//! With kicks and drifts it is advanced by the splitting of Dullweber, Leimkuhler & McLachlan (1997, J. Chem. Phys. 107, 5840),
//! written in quaternions as by Miller et al. (2002, J. Chem. Phys. 116, 8649): `kick` changes the angular momentum
//! L = R I Rᵀ ω by the torque, and `drift` turns the free body. It is of order 2 under every integrator of kicks and drifts,
//! symplectic, reversible, and keeps L but for rounding. Between the stages of a Runge–Kutta step `slopes` are q' = ω q / 2 and
//! Euler's equations (1765), and `unit` brings q back onto the units at its end; it has the order of the method.

mod drift;
mod kick;
mod slopes;

pub use drift::drift;
pub use kick::kick;
pub use slopes::{slopes, unit};

use std::sync::Arc;

use glam::{DQuat, DVec3, DVec4};

use crate::error::Error;
use crate::kernel::{Column, Host, Kernel, Kind, Name, Pass, Problem, Reference, Shader, Source};

/// The columns of rigid bodies, for a component to declare.
#[must_use]
pub fn columns() -> Vec<Column> {
    vec![
        Column::new(
            "orientation",
            Kind::Quaternion,
            "",
            "its orientation, a unit quaternion from its principal axes to space",
        )
        .turning("angular_velocity", "inertia"),
        Column::new("angular_velocity", Kind::Vector, "1 / time", "how it turns, in space").with_rate("torque"),
        Column::new("torque", Kind::Vector, "mass length² / time²", "what turns it, in space").summed(),
        Column::new("inertia", Kind::Vector, "mass length²", "its principal moments of inertia, along its own axes")
            .required(),
    ]
}

/// The names of the columns of bodies.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Body {
    /// Their orientations.
    pub orientation: Name,
    /// Their angular velocities, in space.
    pub angular_velocity: Name,
    /// Their torques, in space.
    pub torque: Name,
    /// Their principal moments of inertia.
    pub inertia: Name,
}

/// The angular momentum of a body \[mass length² / time\], in space.
#[must_use]
pub fn angular_momentum(orientation: DVec4, angular_velocity: DVec3, inertia: DVec3) -> DVec3 {
    let q = facing(orientation);
    q * (inertia * (q.inverse() * angular_velocity))
}

/// The kinetic energy of its turning \[mass length² / time²\].
#[must_use]
pub fn energy(orientation: DVec4, angular_velocity: DVec3, inertia: DVec3) -> f64 {
    0.5 * angular_velocity.dot(angular_momentum(orientation, angular_velocity, inertia))
}

/// The unit along a quaternion.
fn facing(orientation: DVec4) -> DQuat {
    DQuat::from_vec4(orientation).normalize()
}

/// 1 / I; a body does not rotate about an axis without a moment.
fn lightness(inertia: DVec3) -> DVec3 {
    let of = |moment: f64| if moment > 0.0 { moment.recip() } else { 0.0 };
    DVec3::new(of(inertia.x), of(inertia.y), of(inertia.z))
}

/// A kernel of one invocation for each body. Its shader has the files on fixed and inactive bodies if it needs them.
fn kernel(
    verb: &str,
    body: &Body,
    file: Source,
    factor: Option<f64>,
    problem: &Problem,
    reference: Reference,
) -> Result<Kernel, Error> {
    let (holding, tables) = problem.holding();
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        holding,
        problem.active(),
        crate::shader!("motion/turned.wgsl"),
        crate::shader!("rotation/quaternion.wgsl"),
        crate::shader!("rotation/body.wgsl"),
        file,
    ])?;
    let fields = [
        ("orientation", body.orientation.clone()),
        ("angular_velocity", body.angular_velocity.clone()),
        ("torque", body.torque.clone()),
        ("inertia", body.inertia.clone()),
        ("orientation_rate", body.rate()),
        ("angular_acceleration", body.acceleration()),
    ];
    let constants: Vec<_> = factor.map(|factor| ("FACTOR", factor)).into_iter().collect();
    let shown = factor
        .filter(|factor| (*factor - 1.0).abs() > 0.0)
        .map(|factor| format!(" FACTOR={}", crate::kernel::short(factor)));
    let pass = Pass { constants, alone: true, ..Pass::new(shader, problem.capacity) }.on(&fields);
    Ok(Kernel {
        name: format!("{verb} {}{}", body.orientation, shown.unwrap_or_default()),
        passes: vec![pass],
        reference: Some(reference),
        sizes: Vec::new(),
        scratch: Vec::new(),
        tables,
    })
}

/// The reference of a kernel that changes free and active bodies alone.
fn moving(problem: &Problem, host: &Host) -> Result<impl Fn(&usize) -> bool + use<>, Error> {
    let (is_active, mask): (_, Arc<Vec<u32>>) = (host.is_active()?, problem.mask.clone());
    Ok(move |id: &usize| is_active(*id) && mask.get(*id).is_none_or(|word| *word == 0))
}
