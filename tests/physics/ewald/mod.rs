//! Gravity of all images: against published numbers, against the exact sum, and by what a periodic world must do.

mod accurate;
pub mod exact;
mod field;
mod refusals;
mod remarks;
mod universe;
mod worlds;

use crate::support::states::{force, word};
use glam::{DVec3, DVec4};
use motes::forces::Component;
use motes::settings::Value;
use motes::{Bounds, Side, State};

/// The splitting of exact sums; see `two_splittings_agree`.
const SPLITTING: f64 = 2.4;
/// What the force of a unit mass may be wrong by in a cube of side 1: waves beyond |k|² = 14, as the fit leaves them.
const MOST: f64 = 4.7e-4;

/// A cube about somewhere else than the origin.
fn cube(side: f64) -> Bounds {
    let low = DVec3::new(-0.25, 0.5, 1.0) * side;
    Bounds::new(low, low + DVec3::splat(side), Side::Periodic)
}

fn gravity(g: f64, softening: f64, over: &'static str) -> Vec<Box<dyn Component>> {
    let settings = [
        ("g", Value::Number(g)),
        ("softening", Value::Number(softening)),
        ("over", word(over)),
        ("images", word("ewald")),
    ];
    vec![force("gravity", &settings)]
}

/// The same to a root mean square error of the force of a unit mass.
fn accurate(g: f64, accuracy: f64, over: &'static str) -> Vec<Box<dyn Component>> {
    softened(g, accuracy, 0.0, over)
}

/// The same, softened.
fn softened(g: f64, accuracy: f64, softening: f64, over: &'static str) -> Vec<Box<dyn Component>> {
    let settings = [
        ("g", Value::Number(g)),
        ("softening", Value::Number(softening)),
        ("over", word(over)),
        ("images", word("ewald")),
        ("accuracy", Value::Number(accuracy)),
    ];
    vec![force("gravity", &settings)]
}

/// Some in a cube, of various masses.
fn scattered(count: usize, bounds: &Bounds, seed: u64) -> State {
    let mut cloud = crate::support::cloud(count, seed);
    for x in cloud.position_mut() {
        *x = (bounds.low + (*x * 0.5 + 0.5) * (bounds.high - bounds.low)).as_vec3().as_dvec3();
    }
    cloud
}

/// The accelerations of all by all others and their own images: the exact sum.
fn exact_sum(particles: &State, side: f64, g: f64) -> Vec<DVec4> {
    let alone = exact::alone(SPLITTING);
    let acceleration = |i: usize| {
        let others = (0..particles.len()).filter(|j| *j != i).map(|j| {
            let r = (particles.position()[i] - particles.position()[j]) / side;
            particles.mass()[j] * exact::field(r - r.round(), SPLITTING)
        });
        let sum = others.sum::<DVec4>() + DVec4::W * (particles.mass()[i] * alone);
        g * sum * DVec3::splat(1.0 / (side * side)).extend(0.5 / side)
    };
    (0..particles.len()).map(acceleration).collect()
}
