//! Counts a finished step, and records the growth of speeds at intervals.

use std::sync::Arc;

use crate::error::Error;
use crate::kernel::{ALARM, ALARM_WORDS, Kernel, Shader, World};

/// The number of steps between two checks of the growth of speeds.
pub const WINDOW: u32 = 16;

/// Its name in a plan, and in its shader.
pub const NAME: &str = "tick";

/// Records the growth of speeds, if the check is due.
pub fn grown(alarm: &mut [u32], step: u32) {
    if let ([_, _, _, _, _, now, before, doubled, ..], true) = (alarm, step.is_multiple_of(WINDOW)) {
        let faster = f32::from_bits(*now) > 2.0 * f32::from_bits(*before);
        *doubled = if faster { *doubled + 1 } else { 0 };
        (*before, *now) = (*now, 0);
    }
}

/// The kernel.
pub fn kernel() -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/tick.wgsl")])?;
    let reference = |host: &crate::kernel::Host| {
        let clock = host.world();
        let step = clock.step + 1;
        host.set_world(World { step, time: f64::from(step) * clock.dt, ..clock });
        grown(&mut host.write(ALARM)?, step);
        Ok(())
    };
    let kernel = Kernel::new(NAME, shader, Vec::new(), 1, Arc::new(reference));
    Ok(Kernel { sizes: vec![(ALARM.name.into(), ALARM_WORDS as u64)], ..kernel })
}
