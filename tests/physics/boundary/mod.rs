//! The box: particles that leave it come back as they should, on the device and by the references, and forces see the nearest
//! images.

mod laws;
mod lockstep;
mod paths;
mod refusals;
mod species;

use glam::DVec3;
use motes::forces::Component;
use motes::{Bounds, Setup, Side, State};

use crate::support::Random;
use crate::support::states::integrator;

/// Everything but round numbers, and far from the origin along y.
fn odd(sides: [Side; 3]) -> Bounds {
    Bounds { low: DVec3::new(-0.7, 3.1, -2.3), high: DVec3::new(0.9, 3.7, 0.4), sides, dimensions: 3 }
}

/// Particles that are inside, or up to five lengths of the box away.
fn scattered(count: usize, bounds: &Bounds, seed: u64) -> State {
    let mut random = Random::new(seed);
    let mut particles = crate::support::cloud(count, seed);
    let (middle, size) = (0.5 * (bounds.low + bounds.high), bounds.high - bounds.low);
    for x in particles.position_mut() {
        let far = if random.next() > 0.0 { 0.49 } else { 5.0 };
        *x = (middle + far * size * random.vector()).as_vec3().as_dvec3();
    }
    particles
}

/// The same, all inside.
fn inside(count: usize, bounds: &Bounds, seed: u64) -> State {
    let mut random = Random::new(seed);
    let mut particles = crate::support::cloud(count, seed);
    let (middle, size) = (0.5 * (bounds.low + bounds.high), bounds.high - bounds.low);
    particles
        .position_mut()
        .iter_mut()
        .for_each(|x| *x = (middle + 0.49 * size * random.vector()).as_vec3().as_dvec3());
    particles
}

fn setup(particles: State, forces: Vec<Box<dyn Component>>, name: &str, dt: f64, bounds: Bounds) -> Setup {
    Setup { state: particles, forces, integrator: integrator(name), dt, bounds, solver: motes::Solver::default() }
}
