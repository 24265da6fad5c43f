//! Raises the alarm when a number is not finite, and for runaway speeds.

use std::sync::Arc;

use crate::error::Error;
use crate::kernel::{ACCELERATION, ALARM, ALARM_WORDS, Kernel, POSITION, Problem, Shader, VELOCITY};

/// The number of consecutive doublings of the maximum speed after which another one is a runaway: in a fall from rest the speed doubles
/// once, whatever the step, and then grows ever more slowly.
const OFTEN: u32 = 7;

/// The kernel; it may run before the last steps, `ahead`, are counted.
pub fn kernel(problem: &Problem, ahead: u32) -> Result<Kernel, Error> {
    let visit = if problem.machine.software {
        crate::shader!("integrators/watch_each.wgsl")
    } else {
        crate::shader!("integrators/watch_workgroup.wgsl")
    };
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("broken.wgsl"),
        crate::shader!("integrators/watch.wgsl"),
        visit,
    ])?;
    let reference = move |host: &crate::kernel::Host| {
        let done = host.world().step + ahead;
        let (position, velocity, acceleration) = (host.read(POSITION)?, host.read(VELOCITY)?, host.read(ACCELERATION)?);
        // Numbers beyond single precision end a run on every backend.
        let fits = |v: glam::DVec4| v.as_vec4().is_finite();
        let well = |i: &usize| fits(position[*i]) && fits(velocity[*i]) && fits(acceleration[*i]);
        // The largest component, in single precision as on the device.
        #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
        let speed = |i: usize| velocity[i].truncate().abs().max_element() as f32;
        let all = || 0..position.len();
        let mut alarm = host.write(ALARM)?;
        let [broken, broken_id, _, fast, fast_id, now, before, doubled, ..] = &mut alarm[..] else { return Ok(()) };
        let raise = |first: &mut u32, lowest: &mut u32, id: Option<usize>| {
            if let Some(id) = id.filter(|_| *first >= done) {
                (*first, *lowest) = (done, u32::try_from(id).unwrap_or(u32::MAX).min(*lowest));
            }
        };
        raise(broken, broken_id, all().find(|i| !well(i)));
        *now = all().filter(well).map(|i| speed(i).to_bits()).fold(*now, u32::max);
        if *doubled >= OFTEN {
            let bar = 2.0 * f32::from_bits(*before);
            raise(fast, fast_id, all().find(|i| well(i) && speed(*i) > bar));
        }
        Ok(())
    };
    let constants = vec![("AHEAD", f64::from(ahead))];
    let kernel = Kernel::new("watch", shader, constants, problem.capacity, Arc::new(reference)).alone();
    Ok(Kernel { name: "watch".to_owned(), sizes: vec![(ALARM.name.into(), ALARM_WORDS as u64)], ..kernel })
}
