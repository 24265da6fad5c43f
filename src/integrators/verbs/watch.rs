//! Raises the alarm when a number is no number any more.

use std::sync::Arc;

use crate::error::Error;
use crate::kernel::{ALARM, Kernel, POSITION, Shader, VELOCITY};

/// The kernel.
pub fn kernel(count: u32) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/watch.wgsl")])?;
    let twin = |host: &crate::kernel::Host| {
        let step = host.clock().step;
        let (position, velocity) = (host.read(POSITION)?, host.read(VELOCITY)?);
        let broken = position.iter().zip(velocity.iter()).position(|(x, v)| !x.is_finite() || !v.is_finite());
        let mut alarm = host.write(ALARM)?;
        if let (Some(id), [first, lowest, ..]) = (broken, &mut alarm[..]) {
            let id = u32::try_from(id).unwrap_or(u32::MAX);
            if *first >= step {
                (*first, *lowest) = (step, id.min(*lowest));
            }
        }
        Ok(())
    };
    let kernel = Kernel::new("watch", shader, Vec::new(), count, Arc::new(twin));
    Ok(Kernel { sizes: vec![(ALARM.name, 2)], ..kernel })
}
