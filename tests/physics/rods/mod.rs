//! Rigid rods: pendulums and chains against exact solutions, their order, what they conserve, and what they refuse.
#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds, and ids are few")]

mod chains;
mod double;
mod lockstep;
mod long;
mod pendulum;
mod refusals;

use crate::support::Shared;
use crate::support::states::{cpu, force, integrator, phase};
use glam::{DVec3, DVec4};
use motes::forces::{Component, Law};
use motes::kernel::Source;
use motes::links::Rod;
use motes::motion::{Held, Hold};
use motes::{Bounds, Cpu, Gpu, Setup, Simulation, State, gpu};

const G: f64 = 9.81;
/// A fixed particle is so heavy that `Weight` leaves it alone.
const HELD: f64 = 4096.0;

/// Weight of all that is not held.
#[derive(Clone)]
struct Weight;

impl Component for Weight {
    fn laws(&self) -> Vec<Law> {
        let wgsl = "fn force(me: Particle) -> vec4f {
            return select(vec4f(), vec4f(0.0, 0.0, -9.81, 9.81 * me.position.z), me.mass < 4096.0);
        }";
        vec![Law::each("weight", Source::ours("weight", wgsl), Vec::new(), |me, _| {
            if me.mass < HELD { DVec4::new(0.0, 0.0, -G, G * me.position.z) } else { DVec4::ZERO }
        })]
    }
}

fn forces() -> Vec<Box<dyn Component>> {
    vec![Box::new(Weight), force("rod", &[])]
}

/// Adds a chain of particles of mass 1 at rest; those at the ends may be held.
fn chain(particles: &mut State, places: &[DVec3], held: [bool; 2]) {
    let first = u32::try_from(particles.len()).expect("few");
    let last = first + u32::try_from(places.len()).expect("few") - 1;
    for x in places {
        particles.push(*x, DVec3::ZERO, 1.0, 0.0);
    }
    for (id, held) in [(first, held[0]), (last, held[1])] {
        if held {
            particles.held.push(Held { id, by: Hold::Fixed });
            particles.mass_mut()[id as usize] = HELD;
        }
    }
    for (id, x) in (first..last).zip(places.windows(2)) {
        particles.links.rods.push(Rod { ends: [id, id + 1], length: x[0].distance(x[1]) });
    }
}

/// A direction by its angle from the downward vertical.
fn down(angle: f64) -> DVec3 {
    DVec3::new(angle.sin(), 0.0, -angle.cos())
}

/// Rods of length 1 that hang from the origin at these angles.
fn pendulum(angles: &[f64]) -> State {
    let mut particles = State::default();
    let mut places = vec![DVec3::ZERO];
    for angle in angles {
        places.push(*places.last().expect("a place") + down(*angle));
    }
    chain(&mut particles, &places, [true, false]);
    // As exact as they are meant.
    particles.links.rods.iter_mut().for_each(|rod| rod.length = 1.0);
    particles
}

/// Angles and their rates, of rods in a row from the origin.
fn angles(x: &[DVec4], v: &[DVec4]) -> Vec<[f64; 2]> {
    let rods = x.windows(2).zip(v.windows(2));
    let angle = |(x, v): (&[DVec4], &[DVec4])| {
        let (r, v) = ((x[1] - x[0]).truncate(), (v[1] - v[0]).truncate());
        [r.x.atan2(-r.z), (v.z * r.x - v.x * r.z) / r.length_squared()]
    };
    rods.map(angle).collect()
}

fn references(particles: &State, forces: Vec<Box<dyn Component>>, name: &str, dt: f64) -> Simulation<Cpu> {
    cpu(particles, forces, name, dt)
}

fn setup(particles: &State, forces: Vec<Box<dyn Component>>, name: &str, dt: f64) -> Setup {
    Setup {
        state: particles.clone(),
        forces,
        integrator: integrator(name),
        dt,
        bounds: Bounds::default(),
        solver: motes::Solver::default(),
    }
}

fn device(shared: &Shared, particles: &State, forces: Vec<Box<dyn Component>>, name: &str, dt: f64) -> Simulation<Gpu> {
    let gpu::Found { device, queue, .. } = &shared.found;
    Simulation::new(device, queue, &setup(particles, forces, name, dt)).expect("a simulation")
}

/// Position and velocity on the device.
fn read(simulation: &mut Simulation<Gpu>) -> (Vec<DVec4>, Vec<DVec4>) {
    let all = pollster::block_on(simulation.snapshot()).expect("a good state");
    let join = |v: &[DVec3], w: &[f64]| v.iter().zip(w).map(|(v, w)| v.extend(*w)).collect();
    (join(all.position(), all.mass()), join(all.velocity(), all.size()))
}

/// The largest |r| / L − 1 of some rods.
fn stretch(particles: &State, x: &[DVec4]) -> f64 {
    let one = |rod: &Rod| {
        let [a, b] = rod.ends.map(|id| x[id as usize].truncate());
        (a.distance(b) / rod.length - 1.0).abs()
    };
    particles.links.rods.iter().map(one).fold(0.0, f64::max)
}

/// Position and velocity.
type Phase = (Vec<DVec4>, Vec<DVec4>);

/// What the references have after a time in so many steps, all components of the state of the particles in a row.
fn state(particles: &State, name: &str, time: f64, steps: u32) -> Phase {
    let mut simulation = references(particles, forces(), name, time / f64::from(steps));
    simulation.step(steps).expect("steps");
    phase(&mut simulation)
}

/// The same by leapfrog at a step, a half and a quarter of it; its error is a series in h², of which two terms go.
fn extrapolated(particles: &State, time: f64, steps: u32) -> Phase {
    let rows: Vec<_> = [1, 2, 4].map(|k| state(particles, "leapfrog", time, k * steps)).into();
    let mix = |pick: fn(&Phase) -> &Vec<DVec4>| {
        let [a, b, c] = [0, 1, 2].map(|row| pick(&rows[row]));
        (0..a.len()).map(|i| a[i] / 45.0 - b[i] * (20.0 / 45.0) + c[i] * (64.0 / 45.0)).collect()
    };
    (mix(|row| &row.0), mix(|row| &row.1))
}
