//! Fluids whose pressure is solved for: the kernels against their references, what a solve leaves, columns at rest, and odd states.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "numbers are rounded to what f32 holds, and ids and steps are few"
)]

mod lockstep;
mod odd;
mod reference;
mod rest;
mod solve;

use crate::support::states::{force, integrator, vector, word};
use crate::support::{Random, Shared};
use glam::DVec3;
use motes::forces::Component;
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::{Bounds, Gpu, Setup, Side, Simulation, State};

/// How far particles are apart.
const SPACING: f64 = 0.02;
const DENSITY: f64 = 1000.0;
const WEIGHT: f64 = 1.7;

/// A block of fluid above a floor, periodic to the sides: in two dimensions y is up, else z.
struct Tank {
    particles: State,
    bounds: Bounds,
    up: DVec3,
    /// How many layers there are.
    layers: usize,
}

impl Tank {
    fn new(numbers: [usize; 2], flat: bool, jitter: f64) -> Self {
        let [wide, layers] = numbers;
        let up = if flat { DVec3::Y } else { DVec3::Z };
        let deep = if flat { 1 } else { wide };
        // Where the density of the lowest layer is that at rest: a layer of walls is heavier than one of fluid.
        let gap = if flat { 1.114 } else { 1.098 };
        let mass = DENSITY * if flat { SPACING * SPACING } else { SPACING.powi(3) };
        let mut random = Random::new(3);
        let mut particles = State::default();
        let across = |i: usize, j: usize| {
            DVec3::X * (i as f64 + 0.5) + if flat { DVec3::ZERO } else { DVec3::Y * (j as f64 + 0.5) }
        };
        for i in 0..wide {
            for j in 0..deep {
                let place = SPACING * (across(i, j) - gap * up);
                particles.held.push(Held { id: particles.len() as u32, by: Hold::Fixed });
                particles.push(place.as_vec3().as_dvec3(), DVec3::ZERO, mass, 0.0);
            }
        }
        for k in 0..layers {
            for i in 0..wide {
                for j in 0..deep {
                    let mut off = jitter * random.vector();
                    if flat {
                        off.z = 0.0;
                    }
                    let place = SPACING * (across(i, j) + k as f64 * up + off);
                    particles.push(place.as_vec3().as_dvec3(), DVec3::ZERO, mass, 0.0);
                }
            }
        }
        let side = wide as f64 * SPACING;
        let mut bounds = Bounds::new(DVec3::splat(-0.1), DVec3::new(side - 0.1, side - 0.1, 2.0), Side::Periodic);
        bounds.dimensions = if flat { 2 } else { 3 };
        bounds.sides =
            if flat { [Side::Periodic, Side::Open, Side::Open] } else { [Side::Periodic, Side::Periodic, Side::Open] };
        Self { particles, bounds, up, layers }
    }
    /// How many are of the floor.
    fn walls(&self) -> usize {
        self.particles.held.len()
    }
    fn setup(&self, settings: &[(&'static str, Value)], dt: f64) -> Setup {
        let weight = -WEIGHT * self.up;
        let forces = vec![fluid(settings), force("uniform", &[("acceleration", vector(weight.x, weight.y, weight.z))])];
        setup(&self.particles, self.bounds, forces, dt)
    }
    fn simulation(&self, shared: &Shared, settings: &[(&'static str, Value)], dt: f64) -> Simulation<Gpu> {
        Simulation::new(&shared.found.device, &shared.found.queue, &self.setup(settings, dt)).expect("a simulation")
    }
}

fn fluid(settings: &[(&'static str, Value)]) -> Box<dyn Component> {
    let mut all = vec![("spacing", Value::Number(SPACING)), ("solver", word("dfsph"))];
    all.extend_from_slice(settings);
    force("fluid", &all)
}

fn setup(particles: &State, bounds: Bounds, forces: Vec<Box<dyn Component>>, dt: f64) -> Setup {
    let particles = particles.clone();
    Setup {
        state: particles,
        forces,
        integrator: integrator("symplectic_euler"),
        dt,
        bounds,
        solver: motes::Solver::default(),
    }
}
