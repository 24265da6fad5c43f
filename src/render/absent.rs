//! Particles that do not live.

use std::sync::Arc;

use glam::DVec4;

use super::frame::PROJECTED;
use crate::error::Error;
use crate::kernel::{Host, Kernel, Shader};

/// The kernel that hides them, of so many particles.
///
/// # Errors
/// When the shader does not compile.
pub fn absent(count: u32) -> Result<Kernel, Error> {
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("life/active.wgsl"),
        crate::shader!("life/absent.wgsl"),
    ])?;
    let reference = |host: &Host| {
        let is_active = host.is_active()?;
        let mut projected = host.write(PROJECTED)?;
        let hidden = projected.iter_mut().enumerate().filter(|(id, _)| !is_active(*id));
        hidden.for_each(|(_, p)| *p = DVec4::new(0.0, 0.0, 0.0, -1.0));
        Ok(())
    };
    Ok(Kernel::new("absent", shader, Vec::new(), count, Arc::new(reference)))
}
