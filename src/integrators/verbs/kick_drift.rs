//! A kick and the drift after it in one dispatch.

use std::sync::Arc;

use crate::error::Error;
use crate::kernel::{ACCELERATION, Host, Kernel, POSITION, Shader, VELOCITY};

/// The kernel, for parts of the step.
pub fn kernel(count: u32, kick: f64, drift: f64) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/kick_drift.wgsl")])?;
    let reference = move |host: &Host| {
        let dt = host.world().dt;
        let (mut position, mut velocity) = (host.write(POSITION)?, host.write(VELOCITY)?);
        for ((x, v), a) in position.iter_mut().zip(velocity.iter_mut()).zip(host.read(ACCELERATION)?.iter()) {
            *v += (a.truncate() * (kick * dt)).extend(0.0);
            *x += (v.truncate() * (drift * dt)).extend(0.0);
        }
        Ok(())
    };
    Ok(Kernel::new("kick+drift", shader, vec![("KICK", kick), ("DRIFT", drift)], count, Arc::new(reference)).alone())
}
