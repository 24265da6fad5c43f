//! The clock of adaptive steps: the next time step, the limiting particle, and the time.

mod clock;

pub use clock::{at, tick};

use std::sync::Arc;

use glam::DVec4;

use crate::error::Error;
use crate::kernel::{
    AdaptiveStep, Host, Kernel, LARGEST_CRITERION, Pass, Problem, Reason, STEP_CLOCK, STEP_CLOCK_WORDS, STEP_CRITERIA,
    STOP, Shader, TICKS, Table, World, ticks,
};
use crate::primitives::{Items, Operation, reduce};

/// Binary digits of the ticks of a step, less one.
const DIGITS: u32 = 11;

/// The maximum of all dt criteria.
pub fn measure(problem: &Problem) -> Result<Kernel, Error> {
    let (all, most) = (STEP_CRITERIA.name.into(), LARGEST_CRITERION.name.into());
    let kernel = reduce(Operation::Max, Items::Vec4, &all, &most, problem.capacity, &problem.machine)?;
    Ok(Kernel { name: "largest criterion".to_owned(), ..kernel })
}

fn tables(adaptive_step: &AdaptiveStep, dt: f64) -> Vec<Table> {
    vec![(STEP_CLOCK.name.into(), Arc::new(adaptive_step.start(dt))), (STOP.name.into(), Arc::new(vec![u32::MAX, 0]))]
}

fn sizes() -> Vec<(crate::kernel::Name, u64)> {
    vec![(STEP_CLOCK.name.into(), STEP_CLOCK_WORDS as u64), (STOP.name.into(), 2), (LARGEST_CRITERION.name.into(), 1)]
}

/// Computes the time step; `viscous` is the number of steps per longest step that viscosity requires.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "as the device does it")]
pub fn next_dt(adaptive_step: &AdaptiveStep, viscous: f64, problem: &Problem) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/adaptive_dt.wgsl")])?;
    let (unit, least, viscous) = (problem.dt, ticks(adaptive_step.least, problem.dt).max(1), viscous as f32);
    let records = !problem.estimates_error;
    let reference = move |host: &Host| {
        let (world, largest_criterion, stop) = (host.world(), host.read(LARGEST_CRITERION)?, host.read(STOP)?);
        let mut words = host.write(STEP_CLOCK)?;
        let (Some(largest_criterion), [stop_whole, stop_rest]) = (largest_criterion.first(), &stop[..]) else {
            return Ok(());
        };
        let wants = [
            (largest_criterion.x as f32, Reason::Acceleration),
            (largest_criterion.y as f32, Reason::Signal),
            (viscous, Reason::Viscosity),
            (largest_criterion.z as f32, Reason::Speed),
            (largest_criterion.w as f32, Reason::Error),
        ];
        let (mut rate, mut reason) = (1.0f32, Reason::Longest as u32);
        for (want, why) in wants {
            if want > rate {
                (rate, reason) = (want, why as u32);
            }
        }
        let mut step = (TICKS as f32 / rate) as u32;
        let spare = (step | 1).ilog2().max(DIGITS) - DIGITS;
        step = step >> spare << spare;
        if step < least {
            if words[6] == u32::MAX {
                (words[6], words[7], words[9]) = (world.step, reason, rate.to_bits());
            }
            step = least;
        }
        let most = words[3] + words[3] / 5;
        if step > most {
            (step, reason) = (most, Reason::Growth as u32);
        }
        let free = step;
        let ticks = |whole: u32, rest: u32| i64::from(whole) * i64::from(TICKS) + i64::from(rest);
        let left = (ticks(*stop_whole, *stop_rest) - ticks(words[0], words[1])).max(0);
        let (left, long) = (u32::try_from(left).unwrap_or(u32::MAX), step);
        if left < long {
            (step, reason) = (left, Reason::Stop as u32);
        } else if left > long && left < 2 * long {
            (step, reason) = (left.div_ceil(2), Reason::Stop as u32);
        }
        (words[2], words[4], words[5]) = (step, reason, u32::MAX);
        if step > 0 {
            words[3] = free;
            if records {
                words[10] = words[10].min(step);
                words[11] = words[11].max(step);
            }
            words[12 + reason as usize] += 1;
        }
        host.set_world(World { dt: f64::from(step) / f64::from(TICKS) * unit, ..world });
        Ok(())
    };
    let constants = vec![
        ("UNIT", unit),
        ("LEAST", f64::from(least)),
        ("VISCOUS", f64::from(viscous)),
        ("RECORDS", f64::from(u8::from(records))),
    ];
    let pass = Pass { constants, ..Pass::new(shader, 1) };
    Ok(Kernel {
        name: "adaptive dt".to_owned(),
        passes: vec![pass],
        reference: Some(Arc::new(reference)),
        sizes: sizes(),
        scratch: Vec::new(),
        tables: tables(adaptive_step, unit),
    })
}

/// The limiting particle.
pub fn limiting_particle(adaptive_step: &AdaptiveStep, problem: &Problem) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/limiting_particle.wgsl")])?;
    let reference = |host: &Host| {
        let (world, step_criteria, largest_criterion) =
            (host.world(), host.read(STEP_CRITERIA)?, host.read(LARGEST_CRITERION)?);
        let most = largest_criterion.first().copied().unwrap_or_default();
        let first = |reason: u32| {
            let part: fn(&DVec4) -> f64 = match Reason::of(reason) {
                Reason::Acceleration => |v| v.x,
                Reason::Signal => |v| v.y,
                Reason::Speed => |v| v.z,
                _ => return u32::MAX,
            };
            let found = step_criteria.iter().position(|criterion| part(criterion).total_cmp(&part(&most)).is_eq());
            found.and_then(|id| u32::try_from(id).ok()).unwrap_or(u32::MAX)
        };
        let mut words = host.write(STEP_CLOCK)?;
        words[5] = words[5].min(first(words[4]));
        if words[6] == world.step {
            words[8] = words[8].min(first(words[7]));
        }
        Ok(())
    };
    let kernel = Kernel::new("limiting particle", shader, Vec::new(), problem.capacity, Arc::new(reference));
    Ok(Kernel { sizes: sizes(), tables: tables(adaptive_step, problem.dt), ..kernel })
}
