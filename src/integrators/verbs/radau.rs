//! The parts of a step along the nodes of Radau's quadrature.

pub mod part;
pub mod polynomial;

use std::sync::Arc;

use glam::{DVec3, DVec4, Vec4};

use self::part::{BEFORE, Part, SLOTS, START, START_ACCELERATION};
use self::polynomial::{NODE, NODES, difference, predicted};
use crate::error::Error;
use crate::kernel::{
    ACCELERATION, Field, Host, Kernel, LARGEST_CRITERION, Machine, Problem, Reason, STEP_CLOCK, STEP_CLOCK_WORDS,
    Shader, Source, World,
};
use crate::primitives::{Items, Operation, rows};

/// The divided differences of a particle's accelerations.
pub const DIFFERENCES: Field<Vec4> = Field::new("acceleration_differences");
/// The length of the last step, 1 if it was accepted, the number of steps in a longest one; the number of steps that did not settle, or
/// were tried again, and the first of them.
pub const STEP: Field<f32> = Field::new("radau_step");
/// The words of that.
pub const STEP_WORDS: u32 = 5;
/// The state of iterations: whether they have ended, how many there were, and the change by the last one.
pub const ITERATION: Field<f32> = Field::new("radau_iteration");
const SIZES: Field<Vec4> = Field::new("radau_sizes");
const LARGEST: Field<Vec4> = Field::new("radau_largest");

/// Beyond so many lengths of the last step its polynomial says nothing.
const FAR: f64 = 4.0;
/// A step that is so many times too long is tried again.
const TOO_LONG: f64 = 4.0;
/// The most by which an error lets steps grow.
const LONGER: f64 = 16.0;
/// How long a step is tried next whose iterations have not settled.
const UNSETTLED: f64 = 0.2;
/// The rounding error of accelerations, in the last places of a number, and what the last of seven divided differences makes of it:
/// Σₙ 1 / Πₖ |hₙ − hₖ|.
const PLACES: f64 = 3.0;
const AMPLIFIED: f64 = 11_525.0;

/// Half of the distance between 1 and the next number, in the arithmetic of a machine.
fn place(machine: &Machine) -> f64 {
    if *machine == Machine::HOST { 0.5 * f64::EPSILON } else { f64::from(0.5 * f32::EPSILON) }
}

/// What rounding of accelerations makes of the last difference, relative to the largest acceleration.
fn noise(machine: &Machine) -> f64 {
    PLACES * AMPLIFIED * place(machine)
}

fn sizes(problem: &Problem) -> Vec<(crate::kernel::Name, u64)> {
    let rows = u64::from(problem.capacity);
    vec![
        (DIFFERENCES.name.into(), rows * u64::from(NODES)),
        (START.name.into(), rows * SLOTS as u64),
        (STEP.name.into(), STEP_WORDS.into()),
        (ITERATION.name.into(), 1),
        (LARGEST.name.into(), 1),
        (STEP_CLOCK.name.into(), STEP_CLOCK_WORDS as u64),
    ]
}

/// A kernel of one invocation.
fn single(
    name: &str,
    files: &[Source],
    constants: Vec<(&'static str, f64)>,
    problem: &Problem,
    reference: impl Fn(&Host) -> Result<(), Error> + Send + Sync + 'static,
) -> Result<Kernel, Error> {
    let shader = Shader::join(&[&[crate::shader!("world.wgsl")], files].concat())?;
    let kernel = Kernel::new(name, shader, constants, 1, Arc::new(reference));
    Ok(Kernel { name: name.to_owned(), sizes: sizes(problem), ..kernel })
}

/// Before the first iteration.
pub fn restart(problem: &Problem) -> Result<Kernel, Error> {
    let files = [crate::shader!("integrators/radau/iteration.wgsl"), crate::shader!("integrators/radau/restart.wgsl")];
    single("restart iterations", &files, Vec::new(), problem, |host| {
        host.write(ITERATION)?.fill(0.0);
        Ok(())
    })
}

/// The start of a step, with the first guess; then to the first node.
pub fn begin(problem: &Problem) -> Result<Kernel, Error> {
    let part = Part::new(NODE[1], problem);
    let own = part.clone();
    let reference = move |host: &Host| {
        own.save(host)?;
        {
            let (acceleration, step, dt) = (host.read(ACCELERATION)?, host.read(STEP)?, host.world().dt);
            let (mut start, mut differences) = (host.write(START)?, host.write(DIFFERENCES)?);
            let known = step[0] > 0.0 && dt <= FAR * step[0];
            for (i, its) in start.chunks_exact_mut(SLOTS).enumerate() {
                its[START_ACCELERATION] = acceleration[i];
                if dt > 0.0 {
                    let own = &mut differences[i * NODES as usize..][..NODES as usize];
                    let mut before = [DVec3::ZERO; NODES as usize];
                    before.iter_mut().zip(own.iter()).for_each(|(before, own)| *before = own.truncate());
                    let next =
                        if known { predicted(&before, step[1], dt / step[0]) } else { [DVec3::ZERO; NODES as usize] };
                    own.iter_mut().zip(next).for_each(|(own, next)| *own = next.extend(0.0));
                }
            }
        }
        own.go(host, false)
    };
    part.kernel("begin along nodes", crate::shader!("integrators/radau/begin.wgsl"), &[], problem, reference)
}

/// What the acceleration at a node says; then to the next.
pub fn node(at: usize, problem: &Problem) -> Result<Kernel, Error> {
    let part = Part::new(NODE[at % NODES as usize + 1], problem);
    let own = part.clone();
    let reference = move |host: &Host| {
        if host.world().dt > 0.0 {
            let (acceleration, mut start) = (host.read(ACCELERATION)?, host.write(START)?);
            let mut differences = host.write(DIFFERENCES)?;
            for (i, its) in start.chunks_exact_mut(SLOTS).enumerate() {
                let own = &mut differences[i * NODES as usize..][..NODES as usize];
                let found = difference((acceleration[i] - its[START_ACCELERATION]).truncate(), own, at);
                if at == NODES as usize {
                    its[BEFORE] = own[at - 1];
                }
                own[at - 1] = found.extend(0.0);
            }
        }
        own.go(host, false)
    };
    let name = format!("node {at}");
    part.kernel(&name, crate::shader!("integrators/radau/node.wgsl"), &[("AT", at as f64)], problem, reference)
}

/// What changed in the last iteration, and whether it was the last one.
pub fn settle(problem: &Problem) -> Result<[Kernel; 3], Error> {
    let largest = |v: DVec4| v.truncate().abs().max_element();
    let reference = move |host: &Host| {
        let (acceleration, start) = (host.read(ACCELERATION)?, host.read(START)?);
        let (differences, mut sizes) = (host.read(DIFFERENCES)?, host.write(SIZES)?);
        for (i, size) in sizes.iter_mut().enumerate() {
            let g = differences[(i + 1) * NODES as usize - 1];
            *size = DVec4::new(largest(g - start[i * SLOTS + BEFORE]), largest(acceleration[i]), largest(g), 0.0);
        }
        Ok(())
    };
    let files = [
        crate::shader!("world.wgsl"),
        crate::shader!("integrators/radau/differences.wgsl"),
        crate::shader!("integrators/radau/measure.wgsl"),
    ];
    let measure =
        Kernel::new("measure", Shader::join(&files)?, Vec::new(), problem.capacity, Arc::new(reference)).alone();
    let measure = Kernel { name: "measure differences".to_owned(), sizes: sizes(problem), ..measure };
    let (of, into) = (SIZES.name.into(), LARGEST.name.into());
    let reduced = rows(Operation::Max, Items::Vec4, &of, &into, problem.capacity, &problem.machine)?;
    let (rounding, noise) = (place(&problem.machine), noise(&problem.machine));
    let files = [crate::shader!("integrators/radau/iteration.wgsl"), crate::shader!("integrators/radau/settle.wgsl")];
    let constants = vec![("ROUNDING", rounding), ("NOISE", noise)];
    let settle = single("settle", &files, constants, problem, move |host| {
        let (all, mut iteration) = (host.read(LARGEST)?[0], host.write(ITERATION)?);
        let (change, count) = (all.x / all.y, iteration[1] + 1.0);
        let idle = count > 1.0 && change >= iteration[2] && change <= noise;
        let done = all.x <= rounding * all.y || idle || host.world().dt == 0.0;
        iteration.copy_from_slice(&[f64::from(u8::from(done)), count, change]);
        Ok(())
    })?;
    Ok([measure, Kernel { name: "largest difference".to_owned(), ..reduced }, settle])
}

/// The verdict on a step, by its error where steps are adaptive.
pub fn decide(tolerance: f64, problem: &Problem) -> Result<Kernel, Error> {
    if problem.adaptive_step.is_none() {
        let files =
            [crate::shader!("integrators/radau/iteration.wgsl"), crate::shader!("integrators/radau/accept.wgsl")];
        return single("accept", &files, Vec::new(), problem, |host| {
            let (iteration, world, mut step) = (host.read(ITERATION)?, host.world(), host.write(STEP)?);
            (step[0], step[1]) = (world.dt, 1.0);
            if iteration[0] == 0.0 {
                counted(&mut step, world.step);
            }
            Ok(())
        });
    }
    let (unit, noise) = (problem.dt, noise(&problem.machine));
    let files = [crate::shader!("integrators/radau/iteration.wgsl"), crate::shader!("integrators/radau/decide.wgsl")];
    let constants = vec![("UNIT", unit), ("TOLERANCE", tolerance), ("NOISE", noise)];
    single("decide", &files, constants, problem, move |host| {
        let world = host.world();
        if world.dt == 0.0 {
            return Ok(());
        }
        let (all, mut step, mut clock) = (host.read(LARGEST)?[0], host.write(STEP)?, host.write(STEP_CLOCK)?);
        let error = (all.z - noise * all.y).max(0.0);
        let mut longer =
            if error > 0.0 { (tolerance * all.y / error).powf(1.0 / f64::from(NODES)).min(LONGER) } else { LONGER };
        if host.read(ITERATION)?[0] == 0.0 {
            longer = longer.min(UNSETTLED);
        }
        let accepted = longer * TOO_LONG >= 1.0;
        let reason = clock[4];
        if !(accepted && reason == Reason::Stop as u32 && longer >= 1.0) {
            step[2] = unit / (longer * world.dt);
        }
        (step[0], step[1]) = (world.dt, f64::from(u8::from(accepted)));
        if accepted {
            clock[10] = clock[10].min(clock[2]);
            clock[11] = clock[11].max(clock[2]);
        } else {
            counted(&mut step, world.step);
            clock[12 + reason as usize] -= 1;
            clock[2] = 0;
            host.set_world(World { dt: 0.0, ..world });
        }
        Ok(())
    })
}

/// Counts a step that did not settle, or is tried again.
fn counted(words: &mut [f64], step: u32) {
    if words[3] == 0.0 {
        words[4] = step.into();
    }
    words[3] += 1.0;
}

/// The end of the step, or its start again.
pub fn finish(problem: &Problem) -> Result<Kernel, Error> {
    let part = Part::new(1.0, problem);
    let own = part.clone();
    let reference = move |host: &Host| {
        let accepted = host.read(STEP)?[1] > 0.0;
        own.go(host, !accepted)
    };
    part.kernel("end along nodes", crate::shader!("integrators/radau/finish.wgsl"), &[], problem, reference)
}

/// The limit of the next step.
pub fn criterion(problem: &Problem) -> Result<Kernel, Error> {
    let files = [crate::shader!("integrators/radau/criterion.wgsl")];
    let kernel = single("error criterion", &files, Vec::new(), problem, |host| {
        let rate = host.read(STEP)?[2];
        host.write(LARGEST_CRITERION)?[0] = DVec4::new(0.0, 0.0, 0.0, rate);
        Ok(())
    })?;
    Ok(Kernel { sizes: [kernel.sizes, vec![(LARGEST_CRITERION.name.into(), 1)]].concat(), ..kernel })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_is_amplified_by_what_is_said() {
        let one = |n: usize| (0..NODE.len()).filter(|k| *k != n).map(|k| NODE[n] - NODE[k]).product::<f64>();
        let sum: f64 = (0..NODE.len()).map(|n| 1.0 / one(n).abs()).sum();
        assert!((sum / AMPLIFIED - 1.0).abs() < 1e-3, "{sum}");
    }
}
