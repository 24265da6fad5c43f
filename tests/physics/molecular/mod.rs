//! Molecular dynamics: pair laws against published energies, against LAMMPS, and every kernel against its reference.

#![allow(clippy::float_cmp, reason = "zeros beyond a cut-off are exact")]
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "numbers are rounded to what f32 holds, and counts are small"
)]

mod barostats;
mod baths;
mod bonded;
mod boxes;
mod butane;
mod charges;
mod heat;
mod images;
mod lammps;
mod laws;
mod liquid;
mod metal;
mod minimum;
mod nist;
mod polymer;
mod pressure;
mod structure;
mod water;
mod wire;

use glam::DVec3;
use motes::forces::Component;
use motes::settings::Value;
use motes::{Bounds, Setup, Side, Solver, State};

use crate::support::states::{force, integrator, word};

fn lennard_jones(more: &[(&'static str, Value)]) -> Box<dyn Component> {
    force("lennard_jones", more)
}

/// With this cut-off radius, and this end.
fn cut(range: f64, truncation: &'static str, over: &'static str) -> Box<dyn Component> {
    lennard_jones(&[("range", Value::Number(range)), ("truncation", word(truncation)), ("over", word(over))])
}

fn periodic(low: DVec3, high: DVec3) -> Bounds {
    Bounds::new(low, high, Side::Periodic)
}

fn setup(state: State, forces: Vec<Box<dyn Component>>, bounds: Bounds, dt: f64) -> Setup {
    Setup { state, forces, integrator: integrator("leapfrog"), dt, bounds, solver: Solver::default() }
}

/// Face-centred cubic cells along a side, from the origin on, of 4 atoms in a cube of this edge.
fn crystal(cells: u32, edge: f64) -> State {
    let mut state = State::default();
    for k in 0..cells {
        for j in 0..cells {
            for i in 0..cells {
                for b in [[0.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]] {
                    let cell = DVec3::new(f64::from(i), f64::from(j), f64::from(k));
                    state.push((cell + DVec3::from(b)) * edge, DVec3::ZERO, 1.0, 0.0);
                }
            }
        }
    }
    state
}
