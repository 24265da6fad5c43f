//! Births and drains: `spawn` and `drain` spawn and remove particles at the end of a step; `rest` clears the accelerations of
//! particles that are not active, and `guide` those of particles just spawned.

use std::sync::Arc;

use glam::DVec4;

use crate::crowds::Sight;
use crate::error::Error;
use crate::kernel::{
    ACCELERATION, Host, Kernel, LIFE, POSITION, Pass, Problem, Reference, Scalar, Shader, VELOCITY, World,
};
use crate::life::{self, Drain, Life};
use crate::solids::Solid;

/// The name of a spawn's shader.
pub const SPAWN: &str = "spawn";
/// Particles count as due up to this part of a step before their time, so that rounding of times does not matter.
const SOON: f64 = 1.0 / 64.0;

/// At the end of a step, and before the first one: due particles are spawned, and particles in drains are removed.
pub fn kernels(problem: &Problem) -> Result<Vec<Kernel>, Error> {
    let births = (!problem.births.is_empty()).then(|| spawn(problem));
    let drains = problem.drains.iter().zip(1..).map(|(drain, number)| self::drain(problem, *drain, number));
    births.into_iter().chain(drains).collect()
}

fn spawn(problem: &Problem) -> Result<Kernel, Error> {
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("life/birth.wgsl"),
        crate::shader!("life/spawn.wgsl"),
    ])?;
    let births = problem.births.clone();
    let reference = move |host: &Host| {
        let world = host.world();
        let mut life = host.write(LIFE)?;
        let (mut position, mut velocity) = (host.write(POSITION)?, host.write(VELOCITY)?);
        for birth in births.iter() {
            let id = birth.id as usize;
            if life[id] == Life::Pending.word() && birth.time <= world.time + SOON * world.dt {
                life[id] = Life::Active.word();
                let x = position[id].truncate() + (world.time - birth.time) * birth.velocity;
                position[id] = x.extend(birth.mass);
                velocity[id] = birth.velocity.extend(velocity[id].w);
            }
        }
        Ok(())
    };
    Ok(of_births(SPAWN, shader, problem, Arc::new(reference)))
}

/// A kernel of one invocation for each birth.
fn of_births(name: &str, shader: Arc<Shader>, problem: &Problem, reference: Reference) -> Kernel {
    let count = problem.births.len();
    let number = u32::try_from(count).unwrap_or(u32::MAX);
    let pass = Pass { constants: vec![("END", count as f64)], ..Pass::new(shader, number) };
    Kernel {
        name: name.to_owned(),
        passes: vec![pass],
        reference: Some(reference),
        sizes: vec![("births".into(), count as u64)],
        scratch: Vec::new(),
        tables: vec![("births".into(), Arc::new(life::table(&problem.births)))],
    }
}

fn drain(problem: &Problem, drain: Drain, number: u32) -> Result<Kernel, Error> {
    let (holding, mut tables) = problem.holding();
    let sight = Sight::of(&drain, problem);
    let own = [
        holding,
        crate::shader!("world.wgsl"),
        crate::shader!("nearest_image.wgsl"),
        crate::shader!("law/species.wgsl"),
        crate::shader!("solids/distance.wgsl"),
        crate::shader!("life/drain.wgsl"),
    ];
    let shader = Shader::join(&own.into_iter().chain(sight.sources()).collect::<Vec<_>>())?;
    let (radius, size, axis) = drain.solid.parts();
    let values = [
        ("position", Scalar::Vector(drain.position)),
        ("radius", Scalar::Float(radius)),
        ("size", Scalar::Vector(size)),
        ("shape", Scalar::Uint(drain.solid.number())),
        ("axis", Scalar::Vector(axis)),
        ("side", Scalar::Float(if drain.outside { -1.0 } else { 1.0 })),
        ("species", Scalar::Uint(drain.species.unwrap_or(u32::MAX))),
    ];
    let params = shader.reflection().binding("params");
    let params = params.map_or(Ok(Vec::new()), |binding| binding.packed.pack("a drain", &values))?;
    let all = problem.clone();
    let mut sizes = Vec::new();
    if let Some((table, count)) = sight.table() {
        sizes.push((table.0.clone(), count));
        tables.push(table);
    }
    let constants = sight.constants();
    let reference = move |host: &Host| {
        let view = crate::visit::View::of(host)?;
        let (bodies, world) = (view.particles(), host.world());
        let mut life = host.write(LIFE)?;
        let (mut position, mut velocity) = (host.write(POSITION)?, host.write(VELOCITY)?);
        let mut acceleration = host.write(ACCELERATION)?;
        let free = bodies.iter().filter(|body| body.is_active() && !all.is_held(body.index));
        for body in free.filter(|body| drain.species.is_none_or(|kind| kind == body.species())) {
            if takes(&drain, body.position, &world) && sight.is_free(&drain, body.position) {
                let id = body.index;
                life[id] = Life::Removed.word();
                position[id].w = 0.0;
                velocity[id] = DVec4::ZERO.with_w(velocity[id].w);
                acceleration[id] = DVec4::ZERO;
            }
        }
        Ok(())
    };
    let pass =
        Pass { constants, uniforms: vec![("params", params)], alone: true, ..Pass::new(shader, problem.capacity) };
    Ok(Kernel {
        name: format!("drain {number}"),
        passes: vec![pass],
        reference: Some(Arc::new(reference)),
        sizes,
        scratch: Vec::new(),
        tables,
    })
}

/// Whether a drain removes a particle at a position.
fn takes(drain: &Drain, x: glam::DVec3, world: &World) -> bool {
    let r = x - drain.position;
    let r = if matches!(drain.solid, Solid::Plane(_)) { r } else { world.bounds.shortest(r) };
    let distance = drain.solid.distance(r, world.bounds.dimensions).1;
    if drain.outside { distance > 0.0 } else { distance < 0.0 }
}

/// After each evaluation: a ← 0 for inactive particles and for particles that move at constant velocity after they are spawned.
pub fn still(problem: &Problem) -> Result<Vec<Kernel>, Error> {
    let guided = problem.births.iter().any(|birth| birth.guided > 0.0).then(|| guide(problem));
    std::iter::once(rest(problem)).chain(guided).collect()
}

fn guide(problem: &Problem) -> Result<Kernel, Error> {
    let shader = Shader::join(&[
        problem.active(),
        crate::shader!("world.wgsl"),
        crate::shader!("life/birth.wgsl"),
        crate::shader!("life/guide.wgsl"),
    ])?;
    let births = problem.births.clone();
    let reference = move |host: &Host| {
        let (is_active, time) = (host.is_active()?, host.world().time);
        let mut acceleration = host.write(ACCELERATION)?;
        for birth in births.iter().filter(|birth| is_active(birth.id as usize) && time < birth.time + birth.guided) {
            let a = &mut acceleration[birth.id as usize];
            *a = DVec4::ZERO.with_w(a.w);
        }
        Ok(())
    };
    Ok(of_births("guide", shader, problem, Arc::new(reference)))
}

fn rest(problem: &Problem) -> Result<Kernel, Error> {
    let shader = Shader::join(&[problem.active(), crate::shader!("world.wgsl"), crate::shader!("life/rest.wgsl")])?;
    let reference = |host: &Host| {
        let is_active = host.is_active()?;
        let mut acceleration = host.write(ACCELERATION)?;
        acceleration.iter_mut().enumerate().filter(|(id, _)| !is_active(*id)).for_each(|(_, a)| *a = DVec4::ZERO);
        Ok(())
    };
    Ok(Kernel::new("rest", shader, Vec::new(), problem.capacity, Arc::new(reference)).alone())
}
