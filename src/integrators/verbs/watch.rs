//! Raises the alarm when a number is no number any more.

use std::sync::Arc;

use crate::error::Error;
use crate::kernel::{ACCELERATION, ALARM, ALARM_WORDS, Kernel, POSITION, Shader, VELOCITY};

/// The kernel.
pub fn kernel(count: u32) -> Result<Kernel, Error> {
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("broken.wgsl"),
        crate::shader!("integrators/watch.wgsl"),
    ])?;
    let twin = |host: &crate::kernel::Host| {
        let done = host.world().step;
        let (position, velocity, acceleration) = (host.read(POSITION)?, host.read(VELOCITY)?, host.read(ACCELERATION)?);
        let well = |i: &usize| position[*i].is_finite() && velocity[*i].is_finite() && acceleration[*i].is_finite();
        let broken = (0..position.len()).find(|i| !well(i));
        let mut alarm = host.write(ALARM)?;
        if let (Some(id), [first, lowest, ..]) = (broken, &mut alarm[..]) {
            let id = u32::try_from(id).unwrap_or(u32::MAX);
            if *first >= done {
                (*first, *lowest) = (done, id.min(*lowest));
            }
        }
        Ok(())
    };
    let kernel = Kernel::new("watch", shader, Vec::new(), count, Arc::new(twin));
    Ok(Kernel { sizes: vec![(ALARM.name.into(), ALARM_WORDS as u64)], ..kernel })
}
