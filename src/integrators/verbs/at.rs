//! The time at which forces are evaluated: (step + c) dt.

use std::sync::Arc;

use crate::error::Error;
use crate::kernel::{Kernel, Shader, World};

/// Its name in a plan, and in its shader.
pub const NAME: &str = "at";

/// The kernel, for a part of the step.
pub fn kernel(factor: f64) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/at.wgsl")])?;
    let reference = move |host: &crate::kernel::Host| {
        let clock = host.world();
        host.set_world(World { time: (f64::from(clock.step) + factor) * clock.dt, ..clock });
        Ok(())
    };
    Ok(Kernel::new(NAME, shader, vec![("FACTOR", factor)], 1, Arc::new(reference)))
}
