//! A step is done.

use std::sync::Arc;

use crate::error::Error;
use crate::kernel::{Kernel, Shader, World};

/// What it is called in a plan, and in its shader.
pub const NAME: &str = "tick";

/// The kernel.
pub fn kernel() -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/tick.wgsl")])?;
    let twin = |host: &crate::kernel::Host| {
        let clock = host.world();
        let step = clock.step + 1;
        host.set_world(World { step, time: f64::from(step) * clock.dt, ..clock });
        Ok(())
    };
    Ok(Kernel::new(NAME, shader, Vec::new(), 1, Arc::new(twin)))
}
