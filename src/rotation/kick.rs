//! A torque acts on a body.

use std::sync::Arc;

use glam::Vec4;

use super::{Body, facing, kernel, lightness, moving};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Problem};

/// The kernel, for a part of the step: L ← L + c τ dt.
///
/// # Errors
/// When a shader does not compile.
pub fn kick(body: &Body, factor: f64, problem: &Problem) -> Result<Kernel, Error> {
    let (names, all) = (body.clone(), problem.clone());
    let reference = move |host: &Host| {
        let (moving, dt) = (moving(&all, host)?, factor * host.world().dt);
        let (inertia, torque) = (host.reading::<Vec4>(&names.inertia)?, host.reading::<Vec4>(&names.torque)?);
        let orientation = host.reading::<Vec4>(&names.orientation)?;
        let mut spin = host.writing::<Vec4>(&names.angular_velocity)?;
        for i in (0..spin.len()).filter(moving) {
            let q = facing(orientation[i]);
            let change = q * (lightness(inertia[i].truncate()) * (q.inverse() * torque[i].truncate()));
            spin[i] += (dt * change).extend(0.0);
        }
        Ok(())
    };
    kernel("kick", body, crate::shader!("rotation/kick.wgsl"), Some(factor), problem, Arc::new(reference))
}
