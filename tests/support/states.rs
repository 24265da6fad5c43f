//! Simulations to test with, and forces looked at alone.

use glam::{DVec3, DVec4};
use motes::forces::{self, Component, Stage};
use motes::integrators::{self, Integrator, Step};
use motes::kernel::{ACCELERATION, Array, Backend, Column, Columns, POSITION, Role, SPECIES, Shape, VELOCITY, World};
use motes::settings::{Settings, Value};
use motes::{Bounds, Cpu, Setup, Simulation, State};

/// A force by its name, its defaults changed by some settings.
pub fn force(name: &str, settings: &[(&'static str, Value)]) -> Box<dyn Component> {
    let entry = forces::entry(name).unwrap_or_else(|| panic!("no force is called {name}"));
    let known = |key: &str| entry.keys.iter().any(|k| k.name == key);
    assert!(settings.iter().all(|(key, _)| known(key)), "{name} has not all of these keys: {settings:?}");
    let defaults = Settings::defaults(entry.keys);
    (entry.build)(&settings.iter().fold(defaults, |s, (key, value)| s.with(key, value.clone())))
}

/// A word as a value.
pub fn word(text: &'static str) -> Value {
    Value::Text(text.into())
}

/// Three numbers as a value.
pub fn vector(x: f64, y: f64, z: f64) -> Value {
    Value::Vector(DVec3::new(x, y, z))
}

/// An integrator by its name.
pub fn integrator(name: &str) -> Box<dyn Integrator> {
    integrators::entry(name).unwrap_or_else(|| panic!("no integrator is called {name}")).by_default()
}

/// One particle of mass 1.
pub fn one(position: DVec3, velocity: DVec3) -> State {
    let mut particles = State::default();
    particles.push(position, velocity, 1.0, 0.0);
    particles
}

/// A simulation by the references.
pub fn cpu(particles: &State, forces: Vec<Box<dyn Component>>, name: &str, dt: f64) -> Simulation<Cpu> {
    cpu_in(&Bounds::default(), particles, forces, name, dt)
}

/// The same in a box.
pub fn cpu_in(
    bounds: &Bounds,
    particles: &State,
    forces: Vec<Box<dyn Component>>,
    name: &str,
    dt: f64,
) -> Simulation<Cpu> {
    let count = u32::try_from(particles.len()).expect("few");
    let setup = Setup {
        state: particles.clone(),
        forces,
        integrator: integrator(name),
        dt,
        bounds: *bounds,
        solver: motes::Solver::default(),
    };
    Simulation::on(Cpu::new(count).expect("some"), &setup).expect("a simulation")
}

/// Position and velocity of the particles as the references hold them, in f64.
pub fn phase(simulation: &mut Simulation<Cpu>) -> (Vec<DVec4>, Vec<DVec4>) {
    let host = simulation.backend().host();
    match (host.get(POSITION.name), host.get(VELOCITY.name)) {
        (Some(Array::Vec4(x)), Some(Array::Vec4(v))) => (x, v),
        _ => panic!("a simulation has position and velocity"),
    }
}

/// What the references of some forces say at a state: acceleration, and potential per unit mass.
pub fn accelerations(forces: &[Box<dyn Component>], particles: &State, time: f64) -> Vec<DVec4> {
    accelerations_in(&Bounds::default(), forces, particles, time)
}

/// The same in a box.
pub fn accelerations_in(bounds: &Bounds, forces: &[Box<dyn Component>], particles: &State, time: f64) -> Vec<DVec4> {
    evaluated(forces, particles, World { time, dt: 0.01, bounds: *bounds, ..World::default() }).0
}

/// The same with all that is to be known of the world; the velocities and places that the forces
/// then allow; and what is left of the links.
pub fn evaluated(
    forces: &[Box<dyn Component>],
    particles: &State,
    world: World,
) -> (Vec<DVec4>, [Vec<DVec4>; 2], Option<Array>) {
    evaluated_after(forces, particles, world, &vec![DVec4::ZERO; particles.len()])
}

/// The same where the particles have accelerations of an evaluation before.
pub fn evaluated_after(
    forces: &[Box<dyn Component>],
    particles: &State,
    world: World,
    before: &[DVec4],
) -> (Vec<DVec4>, [Vec<DVec4>; 2], Option<Array>) {
    let cpu = run(forces, particles, world, before);
    match [ACCELERATION, VELOCITY, POSITION].map(|field| cpu.host().get(field.name)) {
        [Some(Array::Vec4(a)), Some(Array::Vec4(v)), Some(Array::Vec4(x))] => (a, [v, x], cpu.host().get("link")),
        _ => panic!("forces give accelerations"),
    }
}

/// The torques that the references of some forces say, in the same state; nothing where there are none.
pub fn torques(forces: &[Box<dyn Component>], particles: &State, time: f64) -> Vec<DVec3> {
    let before = vec![DVec4::ZERO; particles.len()];
    let cpu = run(forces, particles, World { time, dt: 0.01, ..World::default() }, &before);
    match cpu.host().get("torque") {
        Some(Array::Vec4(torques)) => torques.iter().map(|torque| torque.truncate()).collect(),
        _ => Vec::new(),
    }
}

/// The references of some forces, run once.
fn run(forces: &[Box<dyn Component>], particles: &State, world: World, before: &[DVec4]) -> Cpu {
    let count = u32::try_from(particles.len()).expect("few");
    let mut cpu = Cpu::new(count).expect("some");
    let problem = motes::forces::Problem::new(count, cpu.machine())
        .at(particles.position(), world.bounds)
        .tied(&particles.links, &particles.held)
        .moved(&[super::choices::swing()], world.dt)
        .of_columns(Columns::with(forces.iter().flat_map(|force| force.columns())).expect("columns"));
    let mut step = Step::new(forces, problem.clone());
    step.evaluate();
    let mut plan = step.finished().expect("a plan");
    for force in forces {
        force.stage(Stage::AfterKick, &mut plan, &problem).expect("a limit");
        force.stage(Stage::AfterDrift { factor: 0.8 }, &mut plan, &problem).expect("a place");
        force.stage(Stage::EndOfStep, &mut plan, &problem).expect("an end");
    }
    let program = cpu.compile(&plan).expect("references");
    let join = |v: &[DVec3], w: &[f64]| Array::Vec4(v.iter().zip(w).map(|(v, w)| v.extend(*w)).collect());
    cpu.write(POSITION.name, &join(particles.position(), particles.mass())).expect("position");
    cpu.write(VELOCITY.name, &join(particles.velocity(), particles.size())).expect("velocity");
    cpu.write(ACCELERATION.name, &Array::Vec4(before.to_vec())).expect("acceleration");
    if cpu.host().contains(SPECIES.name) {
        cpu.write(SPECIES.name, &Array::Uint(particles.species().to_vec())).expect("species");
    }
    let declared: Vec<Column> = forces.iter().flat_map(|force| force.columns()).collect();
    let kept = |(column, _): &(&Column, u64)| column.role == Role::State && column.shape == Shape::Particle;
    for (column, seed) in declared.iter().zip(41..).filter(kept) {
        if cpu.host().contains(&column.name) {
            let given = particles.get(&column.name).cloned();
            let values = given.unwrap_or_else(|| super::columns::numbers(column, particles.len(), seed));
            cpu.write(&column.name, &values).expect("a column");
        }
    }
    cpu.set_world(World { count, ..world }).expect("clock");
    cpu.run(&program, 1).expect("references run");
    cpu
}
