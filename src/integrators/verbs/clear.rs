//! Before the first law: no acceleration, no potential.

use std::sync::Arc;

use glam::DVec4;

use crate::error::Error;
use crate::kernel::{ACCELERATION, Kernel, Shader};

/// The kernel.
pub fn kernel(count: u32) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/clear.wgsl")])?;
    let twin = |host: &crate::kernel::Host| {
        host.write(ACCELERATION)?.fill(DVec4::ZERO);
        Ok(())
    };
    Ok(Kernel::new("clear", shader, Vec::new(), count, Arc::new(twin)))
}
