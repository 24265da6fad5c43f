//! Fixed and kinematic particles: `lead` sets the velocities that bring them to their positions, `hold` sets their accelerations to zero.

use std::sync::Arc;

use glam::DVec3;

use crate::error::Error;
use crate::kernel::{
    ACCELERATION, HOME, Host, Kernel, POSITION, Pass, Problem, Shader, Source, TARGET, VELOCITY, time,
};
use crate::motion::{self, Held, Hold};

/// Before a step: v ← (position at its end − x) / dt, one kernel for each kind of hold.
pub fn lead(problem: &Problem) -> Result<Vec<Kernel>, Error> {
    let held = &problem.held;
    let fixed = held.partition_point(|one| one.by < Hold::Target);
    let aimed = held.partition_point(|one| one.by < Hold::Motion(0));
    let clock = problem.clock();
    let path = [
        clock.clone(),
        crate::shader!("motion/turned.wgsl"),
        crate::shader!("motion/pose.wgsl"),
        crate::shader!("motion/path.wgsl"),
    ];
    let kinds = [
        (0, fixed, "fixed", vec![crate::shader!("motion/fixed.wgsl")]),
        (fixed, aimed, "target", vec![clock, crate::shader!("motion/target.wgsl")]),
        (aimed, held.len(), "motion", path.to_vec()),
    ];
    let some = kinds.into_iter().filter(|(first, end, ..)| first < end);
    some.map(|(first, end, kind, files)| kernel(problem, first, end, kind, files)).collect()
}

fn kernel(problem: &Problem, first: usize, end: usize, kind: &str, files: Vec<Source>) -> Result<Kernel, Error> {
    let mut all =
        vec![crate::shader!("world.wgsl"), crate::shader!("nearest_image.wgsl"), crate::shader!("motion/lead.wgsl")];
    all.extend(files);
    let shader = Shader::join(&all)?;
    let mut constants = vec![("FIRST", first as f64), ("END", end as f64)];
    if shader.reflection().overrides.contains_key("UNIT") {
        constants.extend(problem.clock_constants());
    }
    let (held, motions, all) = (problem.held.clone(), problem.motions.clone(), problem.clone());
    let reference = move |host: &Host| {
        let (world, home) = (host.world(), host.read(HOME)?);
        let target = if host.contains(TARGET.name) { host.read(TARGET)?.to_vec() } else { Vec::new() };
        let (position, mut velocity) = (host.read(POSITION)?, host.write(VELOCITY)?);
        if world.dt <= 0.0 {
            return Ok(());
        }
        let needed = held.get(first).is_some_and(|one| one.by != Hold::Fixed);
        let [begun, ends] = if needed { [time(host, &all, 0.0)?, time(host, &all, 1.0)?] } else { [0.0; 2] };
        for (Held { id, by }, home) in held.iter().zip(home.iter()).take(end).skip(first) {
            let id = *id as usize;
            let (home, x) = (home.truncate(), position[id].truncate());
            let (way, length) = match by {
                Hold::Fixed => (home - x, world.dt),
                Hold::Target => {
                    let to = target.get(id).copied().unwrap_or_default();
                    (to.truncate() - x, (to.w - begun).max(world.dt))
                }
                Hold::Motion(number) => {
                    let motion = motions.get(*number as usize);
                    let there = motion.map_or(home, |motion| motion.place(home, ends));
                    (there - x, world.dt)
                }
            };
            let v: DVec3 = world.bounds.shortest(way) / length;
            velocity[id] = v.extend(velocity[id].w);
        }
        Ok(())
    };
    let pass = Pass { constants, ..Pass::new(shader, number(end - first)) };
    let (mut tables, of_tables) = problem.motion_tables();
    tables.push(("holds".into(), Arc::new(motion::list(&problem.held))));
    let count = problem.held.len() as u64;
    let mut sizes = vec![("holds".into(), count), (HOME.name.into(), count)];
    sizes.extend(of_tables);
    sizes.extend(problem.clock_sizes());
    Ok(Kernel {
        name: format!("lead {kind}"),
        passes: vec![pass],
        reference: Some(Arc::new(reference)),
        sizes,
        scratch: Vec::new(),
        tables,
    })
}

/// After each evaluation: a ← 0 for fixed particles.
pub fn hold(problem: &Problem) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("motion/hold.wgsl")])?;
    let (held, count) = (problem.held.clone(), problem.held.len());
    let reference = move |host: &Host| {
        let mut acceleration = host.write(ACCELERATION)?;
        for one in held.iter() {
            let a = &mut acceleration[one.id as usize];
            *a = DVec3::ZERO.extend(a.w);
        }
        Ok(())
    };
    let pass = Pass { constants: vec![("END", count as f64)], ..Pass::new(shader, number(count)) };
    Ok(Kernel {
        name: "hold".to_owned(),
        passes: vec![pass],
        reference: Some(Arc::new(reference)),
        sizes: vec![("holds".into(), count as u64)],
        scratch: Vec::new(),
        tables: vec![("holds".into(), Arc::new(motion::list(&problem.held)))],
    })
}

/// Fixed particles have distinct ids, so that there are fewer than 2³².
fn number(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}
