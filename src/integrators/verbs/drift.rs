//! Drift: x ← x + c v dt.

use std::sync::Arc;

use crate::error::Error;
use crate::kernel::{Kernel, POSITION, Shader, VELOCITY};

/// The kernel, for a part of the step.
pub fn kernel(count: u32, factor: f64) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/drift.wgsl")])?;
    let reference = move |host: &crate::kernel::Host| {
        let dt = factor * host.world().dt;
        let (mut position, velocity) = (host.write(POSITION)?, host.read(VELOCITY)?);
        for (x, v) in position.iter_mut().zip(velocity.iter()) {
            *x += (v.truncate() * dt).extend(0.0);
        }
        Ok(())
    };
    Ok(Kernel::new("drift", shader, vec![("FACTOR", factor)], count, Arc::new(reference)).alone())
}
