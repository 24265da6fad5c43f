//! The parts of a step with block time steps.

use std::sync::Arc;

use glam::{DVec4, Vec4};

use crate::error::Error;
use crate::kernel::{
    ACCELERATION, BLOCK_CLOCK, BLOCK_CLOCK_START, BlockSteps, DUE, Field, Host, Kernel, POSITION, Problem, STEP_LEVEL,
    Shader, Source, VELOCITY, World,
};

/// The accelerations at the ends of particles' last steps.
const LAST: Field<Vec4> = Field::new("block_acceleration");
/// The largest level, the lowest id of those that require more than there are, the most that one requires, and
/// the number of those that are due.
const WANTED: Field<u32> = Field::new("block_wanted");
/// The column of softenings of particles.
const OWN_LENGTH: Field<f32> = Field::new("softening_length");
/// Above all levels that there are, as in the shader.
const TOO_MANY: u32 = 31;

/// A kernel of these parts.
fn kernel(
    name: &str,
    files: Vec<Source>,
    constants: Vec<(&'static str, f64)>,
    count: u32,
    reference: impl Fn(&Host) -> Result<(), Error> + Send + Sync + 'static,
) -> Result<Kernel, Error> {
    let mut all = vec![crate::shader!("world.wgsl"), crate::shader!("integrators/block_clock.wgsl")];
    all.extend(files);
    let kernel = Kernel::new(name, Shader::join(&all)?, constants, count, Arc::new(reference));
    let clock = (BLOCK_CLOCK.name.into(), 1);
    let tables = vec![(BLOCK_CLOCK.name.into(), Arc::new(BLOCK_CLOCK_START.to_vec()))];
    Ok(Kernel { name: name.to_owned(), sizes: vec![clock, (WANTED.name.into(), 4)], tables, ..kernel })
}

/// Every particle begins a step of its own.
pub fn begin(problem: &Problem) -> Result<Kernel, Error> {
    let reference = |host: &Host| {
        host.write(DUE)?.fill(1);
        host.write(BLOCK_CLOCK)?[1] = 0;
        host.write(WANTED)?.copy_from_slice(&[0, u32::MAX, 0, 0]);
        Ok(())
    };
    let files = vec![crate::shader!("integrators/block_begin.wgsl")];
    kernel("begin block steps", files, Vec::new(), problem.capacity, reference)
}

/// Particles that are due choose their next step.
pub fn level(steps: BlockSteps, problem: &Problem) -> Result<Kernel, Error> {
    let own = steps.length == 0.0;
    let (levels, demand) = (steps.levels, steps.demand(problem.dt, if own { 1.0 } else { steps.length }));
    let reference = move |host: &Host| {
        let (acceleration, due) = (host.read(ACCELERATION)?, host.read(DUE)?);
        let lengths = if own { Some(host.read(OWN_LENGTH)?) } else { None };
        let now = host.read(BLOCK_CLOCK)?[1];
        let (mut levels_of, mut last) = (host.write(STEP_LEVEL)?, host.write(LAST)?);
        let mut wanted = host.write(WANTED)?;
        for (i, level) in levels_of.iter_mut().enumerate() {
            if due[i] != 0 {
                last[i] = acceleration[i];
                let length = lengths.as_ref().map_or(1.0, |lengths| lengths[i]);
                let mut steps = demand * acceleration[i].truncate().length() / length;
                *level = 0;
                while steps > 1.0 && *level < TOO_MANY {
                    (steps, *level) = (steps * 0.25, *level + 1);
                }
                if *level > levels {
                    wanted[1] = wanted[1].min(u32::try_from(i).unwrap_or(u32::MAX));
                    wanted[2] = wanted[2].max(*level);
                    *level = levels;
                }
                while !now.is_multiple_of(1 << (levels - *level)) {
                    *level += 1;
                }
            }
            wanted[0] = wanted[0].max(*level);
            wanted[3] += u32::from(due[i] != 0);
        }
        Ok(())
    };
    let length = if own {
        crate::shader!("integrators/block_own_length.wgsl")
    } else {
        crate::shader!("integrators/block_length.wgsl")
    };
    let files = vec![crate::shader!("integrators/block_level.wgsl"), length];
    let constants = vec![("LEVELS", f64::from(levels)), ("DEMAND", demand)];
    kernel("choose block steps", files, constants, problem.capacity, reference)
}

/// The next part of the step.
pub fn advance(steps: BlockSteps, problem: &Problem) -> Result<Kernel, Error> {
    let unit = problem.dt;
    let reference = move |host: &Host| {
        let (mut clock, mut wanted, world) = (host.write(BLOCK_CLOCK)?, host.write(WANTED)?, host.world());
        if wanted[1] != u32::MAX && clock[4] == u32::MAX {
            clock[4..7].copy_from_slice(&[world.step, wanted[1], wanted[2]]);
        }
        let start = clock[1];
        let now = start + (1 << (steps.levels - wanted[0]));
        clock[..4].copy_from_slice(&[start, now, u32::from(now == steps.whole()), wanted[0]]);
        for (word, more) in [(7, 1), (9, wanted[3])] {
            let sum = (u64::from(clock[word + 1]) << 32 | u64::from(clock[word])).wrapping_add(more.into());
            #[expect(clippy::cast_possible_truncation, reason = "two words")]
            clock[word..word + 2].copy_from_slice(&[sum as u32, (sum >> 32) as u32]);
        }
        wanted.copy_from_slice(&[0, u32::MAX, 0, 0]);
        let part = |parts: u32| f64::from(parts) / f64::from(steps.whole());
        host.set_world(World {
            dt: part(now - start) * unit,
            time: (f64::from(world.step) + part(now)) * unit,
            ..world
        });
        Ok(())
    };
    let constants = vec![("LEVELS", f64::from(steps.levels)), ("UNIT", unit)];
    kernel("next part", vec![crate::shader!("integrators/block_advance.wgsl")], constants, 1, reference)
}

/// The part of dt in half of a particle's own step, in parts of a step and the lengths of parts.
fn own(steps: BlockSteps, clock: &[u32], level: u32, mass: f64) -> (u32, f64) {
    let shortest = steps.shared || mass > steps.mass;
    let own = 1 << (steps.levels - if shortest { clock[3] } else { level });
    (own, 0.5 * f64::from(own) / f64::from(clock[1] - clock[0]))
}

fn constants(steps: BlockSteps) -> Vec<(&'static str, f64)> {
    vec![("LEVELS", f64::from(steps.levels)), ("SHARED", f64::from(u8::from(steps.shared))), ("MASS", steps.mass)]
}

/// Half a kick of those that begin a step, and a drift of all.
pub fn kick_drift(steps: BlockSteps, problem: &Problem) -> Result<Kernel, Error> {
    let reference = move |host: &Host| {
        let (acceleration, level, clock) = (host.read(ACCELERATION)?, host.read(STEP_LEVEL)?, host.read(BLOCK_CLOCK)?);
        let (mut position, mut velocity) = (host.write(POSITION)?, host.write(VELOCITY)?);
        let (mut due, dt) = (host.write(DUE)?, host.world().dt);
        for i in 0..position.len() {
            let (own, half) = own(steps, &clock, level[i], position[i].w);
            if clock[0].is_multiple_of(own) {
                velocity[i] += (acceleration[i].truncate() * (half * dt)).extend(0.0);
            }
            position[i] += (velocity[i].truncate() * dt).extend(0.0);
            due[i] = u32::from(clock[1].is_multiple_of(own));
        }
        Ok(())
    };
    let files = vec![crate::shader!("integrators/block_kick_drift.wgsl")];
    kernel("block kick+drift", files, constants(steps), problem.capacity, reference)
}

/// Half a kick of those that are due.
pub fn kick(steps: BlockSteps, problem: &Problem) -> Result<Kernel, Error> {
    let reference = move |host: &Host| {
        let (level, clock, due) = (host.read(STEP_LEVEL)?, host.read(BLOCK_CLOCK)?, host.read(DUE)?);
        let (mut velocity, mut acceleration) = (host.write(VELOCITY)?, host.write(ACCELERATION)?);
        let (last, position, dt) = (host.read(LAST)?, host.read(POSITION)?, host.world().dt);
        for i in 0..velocity.len() {
            if due[i] == 0 {
                acceleration[i] = last[i];
            } else {
                let half: DVec4 =
                    (acceleration[i].truncate() * (own(steps, &clock, level[i], position[i].w).1 * dt)).extend(0.0);
                velocity[i] += half;
            }
        }
        Ok(())
    };
    let files = vec![crate::shader!("integrators/block_kick.wgsl")];
    kernel("block kick", files, constants(steps), problem.capacity, reference)
}

/// The end of the step.
pub fn end(problem: &Problem) -> Result<Kernel, Error> {
    let unit = problem.dt;
    let reference = move |host: &Host| {
        host.set_world(World { dt: unit, ..host.world() });
        Ok(())
    };
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/block_end.wgsl")])?;
    Ok(Kernel {
        name: "end block steps".to_owned(),
        ..Kernel::new("", shader, vec![("UNIT", unit)], 1, Arc::new(reference))
    })
}
