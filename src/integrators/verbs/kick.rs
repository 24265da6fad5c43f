//! Kick: v ← v + c a dt.

use std::sync::Arc;

use crate::error::Error;
use crate::kernel::{ACCELERATION, Kernel, Shader, VELOCITY};

/// The kernel, for a part of the step.
pub fn kernel(count: u32, factor: f64) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/kick.wgsl")])?;
    let reference = move |host: &crate::kernel::Host| {
        let dt = factor * host.world().dt;
        let (mut velocity, acceleration) = (host.write(VELOCITY)?, host.read(ACCELERATION)?);
        for (v, a) in velocity.iter_mut().zip(acceleration.iter()) {
            *v += (a.truncate() * dt).extend(0.0);
        }
        Ok(())
    };
    Ok(Kernel::new("kick", shader, vec![("FACTOR", factor)], count, Arc::new(reference)).alone())
}
