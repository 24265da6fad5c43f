//! A uniform sphere, cold or warm: what the collapse tests of n-body codes start from (van Albada 1982).

use glam::DVec3;

use super::build::{CENTER, COUNT, G, PARTICLE_SIZE, Reader, SEED, TOTAL_MASS, VELOCITY};
use super::random::Random;
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `sphere`.
pub const SPHERE: Shape = Shape {
    name: "sphere",
    about: "a uniform sphere, cold or with Gaussian velocities (van Albada 1982)",
    keys: KEYS,
    build,
    amount: Amount::counted,
    parts: one_part,
    resolution: Resolution::Count { key: "count", least: 1 },
};

const KEYS: &[Key] = &[
    COUNT,
    SEED,
    TOTAL_MASS,
    Key::new("radius", Kind::Positive, Value::Number(1.0), "radius of the sphere [length]"),
    Key::new(
        "virial",
        Kind::NotNegative,
        Value::Number(0.0),
        "kinetic over potential energy, K / |W|, of the random velocities: 0 is cold, 0.5 is virial equilibrium",
    ),
    Key::new(
        "spin",
        Kind::Vector,
        Value::Vector(DVec3::ZERO),
        "turning as a whole, on top of the random velocities: angular velocity [1 / time] along its axis",
    ),
    G,
    CENTER,
    VELOCITY,
    PARTICLE_SIZE,
];

/// `count` particles of equal mass. With  |W| = 3 G M² / 5 R  the dispersion per axis is  σ² = 2/5 virial G M / R.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "sphere", settings };
    let (count, mut particles) = reader.room()?;
    let mut random = Random::new(settings.whole("seed"));
    let total = reader.positive("mass")?;
    let size = reader.positive("radius")?;
    let g = reader.positive("g")?;
    let virial = reader.not_negative("virial")?;
    let spin = reader.vector("spin")?;
    let radius = reader.not_negative("particle_size")?;
    let dispersion = (0.4 * virial * g * total / size).sqrt();
    let mass = total / f64::from(u32::try_from(count).unwrap_or(u32::MAX));
    for _ in 0..count {
        let position = random.ball() * size;
        let velocity = random.normals() * dispersion + spin.cross(position);
        particles.push(position, velocity, mass, radius);
    }
    reader.finished(particles.centered(reader.vector("center")?, reader.vector("velocity")?))
}
