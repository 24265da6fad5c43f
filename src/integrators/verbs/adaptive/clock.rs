//! The time, by a clock that counts ticks.

use std::sync::Arc;

use crate::error::Error;
use crate::integrators::verbs::tick::{WINDOW, grown};
use crate::kernel::{
    ALARM, ALARM_WORDS, Host, Kernel, Problem, STEP_CLOCK, STEP_CLOCK_WORDS, Shader, TICKS, World, time,
};

/// The time after a part of the step.
pub fn at(factor: f64, problem: &Problem) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/at_adaptive.wgsl")])?;
    let all = problem.clone();
    let reference = move |host: &Host| {
        let time = time(host, &all, factor)?;
        host.set_world(World { time, ..host.world() });
        Ok(())
    };
    let kernel = Kernel::new("at", shader, vec![("FACTOR", factor), ("UNIT", problem.dt)], 1, Arc::new(reference));
    Ok(Kernel { sizes: vec![(STEP_CLOCK.name.into(), STEP_CLOCK_WORDS as u64)], ..kernel })
}

/// Counts a completed step.
pub fn tick(problem: &Problem) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/tick_adaptive.wgsl")])?;
    let (unit, watches) = (problem.dt, !problem.estimates_error);
    let window = if watches { WINDOW } else { u32::MAX };
    let reference = move |host: &Host| {
        let (clock, mut words) = (host.world(), host.write(STEP_CLOCK)?);
        let [whole, rest, ticks, ..] = &mut words[..] else { return Ok(()) };
        if *ticks > 0 {
            let all = *rest + *ticks;
            (*whole, *rest) = (*whole + all / TICKS, all % TICKS);
            let (step, time) = (clock.step + 1, (f64::from(*whole) + f64::from(*rest) / f64::from(TICKS)) * unit);
            host.set_world(World { time, step, ..clock });
            if watches {
                grown(&mut host.write(ALARM)?, step);
            }
        }
        Ok(())
    };
    let kernel =
        Kernel::new("tick", shader, vec![("UNIT", unit), ("WINDOW", f64::from(window))], 1, Arc::new(reference));
    let sizes = vec![(ALARM.name.into(), ALARM_WORDS as u64), (STEP_CLOCK.name.into(), STEP_CLOCK_WORDS as u64)];
    Ok(Kernel { sizes, ..kernel })
}
