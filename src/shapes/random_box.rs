//! A box filled at random, at rest or warm.

use glam::DVec3;

use super::build::{CENTER, COUNT, PARTICLE_SIZE, Reader, SEED, VELOCITY};
use super::random::Random;
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `box`.
pub const RANDOM_BOX: Shape = Shape {
    name: "box",
    about: "a box filled uniformly at random, at rest or warm",
    keys: KEYS,
    build,
    amount: Amount::counted,
    parts: one_part,
    resolution: Resolution::Count { key: "count", least: 1 },
};

const KEYS: &[Key] = &[
    COUNT,
    SEED,
    Key::new(
        "size",
        Kind::Vector,
        Value::Vector(DVec3::ONE),
        "lengths of the sides [length], 0 or above: a zero makes it flat, and all that moves in it",
    ),
    Key::new("mass", Kind::NotNegative, Value::Number(1.0), "mass of each particle [mass]"),
    Key::new(
        "speed",
        Kind::NotNegative,
        Value::Number(0.0),
        "thermal speed: standard deviation of each velocity component, but across a flat box [length / time], √(k T / m) of a gas",
    ),
    CENTER,
    VELOCITY,
    PARTICLE_SIZE,
];

/// `count` particles. Their mean velocity is `velocity` exactly, so that a warm box does not drift.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "box", settings };
    let (count, mut particles) = reader.room()?;
    let mut random = Random::new(settings.whole("seed"));
    let size = reader.vector("size")?;
    if size.min_element() < 0.0 {
        return Err(reader.error(&format!("size is {size}; a side must be 0 or above")));
    }
    let mass = reader.not_negative("mass")?;
    let speed = reader.not_negative("speed")?;
    let center = reader.vector("center")?;
    let velocity = reader.vector("velocity")?;
    let radius = reader.not_negative("particle_size")?;
    // In a flat box they move in the plane.
    let free = DVec3::select(size.cmpgt(DVec3::ZERO), DVec3::ONE, DVec3::ZERO);
    for _ in 0..count {
        let x = random.between(-0.5, 0.5);
        let y = random.between(-0.5, 0.5);
        let z = random.between(-0.5, 0.5);
        let thermal = if speed > 0.0 { random.normals() * speed * free } else { DVec3::ZERO };
        particles.push(DVec3::new(x, y, z) * size + center, thermal, mass, radius);
    }
    let (_, drift) = particles.center();
    for v in particles.velocity_mut() {
        *v = *v - drift + velocity;
    }
    reader.finished(particles)
}
