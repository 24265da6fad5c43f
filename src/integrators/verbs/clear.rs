//! Sets accelerations and potentials to zero before the first law.

use std::sync::Arc;

use glam::DVec4;

use crate::error::Error;
use crate::kernel::{ACCELERATION, Kernel, Reference, Shader};

/// The kernel.
pub fn kernel(count: u32) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/clear.wgsl")])?;
    let reference = |host: &crate::kernel::Host| {
        host.write(ACCELERATION)?.fill(DVec4::ZERO);
        Ok(())
    };
    Ok(Kernel::new("clear", shader, Vec::new(), count, Arc::new(reference)).alone())
}

/// Clears them in the first kernel that adds to them, if possible: it sets accelerations instead.
pub fn with(law: &mut Kernel) -> bool {
    const FIRST: &str = "FIRST";
    let can = law.passes.len() == 1 && law.passes[0].shader.reflection().overrides.contains_key(FIRST);
    if can {
        law.passes[0].constants.push((FIRST, 1.0));
        let adds = law.reference.take();
        law.reference = adds.map(|adds| -> Reference {
            Arc::new(move |host| {
                host.write(ACCELERATION)?.fill(DVec4::ZERO);
                adds(host)
            })
        });
    }
    can
}
