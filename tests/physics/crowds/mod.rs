//! Crowds: closed forms of the social force, friction that takes energy, lockstep, plans, ways to exits, and flows through a door.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "numbers are rounded to what f32 holds, and counts are small"
)]

mod flows;
mod forces;
mod places;
mod plans;
mod spacing;
mod walls;

use glam::DVec3;
use motes::forces::Component;
use motes::kernel::Array;
use motes::{Bounds, Setup, Solver, State};

use crate::support::Random;
use crate::support::states::integrator;

/// One pedestrian.
#[derive(Clone, Copy)]
pub struct Person {
    pub position: DVec3,
    pub velocity: DVec3,
    pub mass: f64,
    pub radius: f64,
    pub speed: f64,
}

pub const PERSON: Person =
    Person { position: DVec3::ZERO, velocity: DVec3::ZERO, mass: 80.0, radius: 0.3, speed: 1.34 };

/// A state of pedestrians, with the columns of both components.
pub fn state(people: &[Person]) -> State {
    let mut state = State::default();
    people.iter().for_each(|one| state.push(one.position, one.velocity, one.mass, one.radius));
    for (column, of) in [
        (motes::crowds::radius(), (|one: &Person| one.radius) as fn(&Person) -> f64),
        (motes::crowds::desired_speed(), |one| one.speed),
    ] {
        state.declare(&column).expect("a column");
        state.set(&column.name, Array::Float(people.iter().map(of).collect())).expect("values");
    }
    state
}

/// Pedestrians at random in a square of this side, of three species, as f32 holds them.
pub fn crowd(count: usize, side: f64, seed: u64) -> State {
    let mut random = Random::new(seed);
    let mut person = |_| {
        let single = |v: DVec3| v.as_vec3().as_dvec3();
        let position = single(0.5 * side * random.vector().with_z(0.0));
        let velocity = single(1.3 * random.vector().with_z(0.0));
        let mut number = |middle: f64, half: f64| f64::from((middle + half * random.next()) as f32);
        Person { position, velocity, mass: number(80.0, 15.0), radius: number(0.3, 0.05), speed: number(1.34, 0.5) }
    };
    let people: Vec<Person> = (0..count).map(&mut person).collect();
    let mut state = state(&people);
    state.species_mut().copy_from_slice(&crate::support::species(count));
    state
}

/// A setup in the plane.
pub fn setup(state: State, forces: Vec<Box<dyn Component>>, dt: f64) -> Setup {
    let bounds = Bounds { dimensions: 2, ..Bounds::default() };
    Setup { state, forces, integrator: integrator("leapfrog"), dt, bounds, solver: Solver::default() }
}
