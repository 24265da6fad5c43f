//! The rotation of a free body.

use std::sync::Arc;

use glam::{DQuat, DVec3, Vec4};

use super::{Body, facing, kernel, lightness, moving};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Problem};

/// A rotation about one principal axis by an angle, given by the tangent of its half: of the orientation, which is then not normalized, and
/// of the angular momentum along the principal axes.
fn about(axis: DVec3, angle: f64, (q, momentum): (DQuat, DVec3)) -> (DQuat, DVec3) {
    let turn = DQuat::from_xyzw(0.5 * angle * axis.x, 0.5 * angle * axis.y, 0.5 * angle * axis.z, 1.0);
    (q * turn, turn.normalize().inverse() * momentum)
}

/// The kernel, for a part of the step: rotates the body, and its angular velocity with it, so that R I Rᵀ ω is constant.
///
/// # Errors
/// When a shader does not compile.
pub fn drift(body: &Body, factor: f64, problem: &Problem) -> Result<Kernel, Error> {
    let (names, all) = (body.clone(), problem.clone());
    let reference = move |host: &Host| {
        let (moving, dt) = (moving(&all, host)?, factor * host.world().dt);
        let inertia = host.reading::<Vec4>(&names.inertia)?;
        let mut orientation = host.writing::<Vec4>(&names.orientation)?;
        let mut spin = host.writing::<Vec4>(&names.angular_velocity)?;
        for i in (0..orientation.len()).filter(moving) {
            let (q, moments) = (facing(orientation[i]), inertia[i].truncate());
            let rates = dt * lightness(moments);
            let own = q.inverse() * spin[i].truncate();
            let mut body = (q, moments * own);
            for (axis, part) in [(DVec3::X, 0.5), (DVec3::Y, 0.5), (DVec3::Z, 1.0), (DVec3::Y, 0.5), (DVec3::X, 0.5)] {
                let angle = part * axis.dot(rates * body.1);
                body = about(axis, angle, body);
            }
            // About an axis without a moment it has no angular momentum, and keeps its angular velocity.
            let spun = own + lightness(moments) * (body.1 - moments * own);
            let q = body.0.normalize();
            orientation[i] = q.into();
            spin[i] = (q * spun).extend(spin[i].w);
        }
        Ok(())
    };
    kernel("drift", body, crate::shader!("rotation/drift.wgsl"), Some(factor), problem, Arc::new(reference))
}
