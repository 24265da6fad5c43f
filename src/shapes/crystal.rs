//! Crystals by density, with velocities at a temperature.

use glam::DVec3;

use super::build::{CENTER, PARTICLE_SIZE, Reader, SEED, VELOCITY};
use super::random::Random;
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `crystal`.
pub const CRYSTAL: Shape = Shape {
    name: "crystal",
    about: "a crystal of a number density: cubic, body-centred, face-centred or diamond, with velocities at a temperature",
    keys: KEYS,
    build,
    amount,
    parts: one_part,
    resolution: Resolution::Own,
};

const KEYS: &[Key] = &[
    Key::required("cells", Kind::Vector, "unit cells along x, y and z: three whole numbers, 1 or above"),
    Key::required(
        "density",
        Kind::Positive,
        "particles per volume; with n particles in a cell its edge is (n / density)^(1/3) [1 / length³]",
    ),
    Key::new(
        "structure",
        Kind::Choice(&["fcc", "bcc", "sc", "diamond"]),
        Value::Text(std::borrow::Cow::Borrowed("fcc")),
        "the cubic cell: face-centred (4 particles), body-centred (2), simple (1) or diamond (8)",
    ),
    Key::new("mass", Kind::NotNegative, Value::Number(1.0), "mass of each particle [mass]"),
    Key::new(
        "temperature",
        Kind::NotNegative,
        Value::Number(0.0),
        "k T: velocities are Maxwellian, without total momentum, and have exactly 2 K / (3 N − 3) = k T [energy]",
    ),
    SEED,
    CENTER,
    VELOCITY,
    PARTICLE_SIZE,
];

/// Places in a cell, in edges.
fn basis(structure: &str) -> &'static [[f64; 3]] {
    const DIAMOND: [[f64; 3]; 8] = [
        [0.0, 0.0, 0.0],
        [0.5, 0.5, 0.0],
        [0.5, 0.0, 0.5],
        [0.0, 0.5, 0.5],
        [0.25, 0.25, 0.25],
        [0.75, 0.75, 0.25],
        [0.75, 0.25, 0.75],
        [0.25, 0.75, 0.75],
    ];
    const CENTRED: [[f64; 3]; 2] = [[0.0, 0.0, 0.0], [0.5, 0.5, 0.5]];
    match structure {
        "sc" => &CENTRED[..1],
        "bcc" => &CENTRED,
        "diamond" => &DIAMOND,
        _ => &DIAMOND[..4],
    }
}

fn amount(settings: &Settings) -> Amount {
    Amount::of(settings.vector("cells").element_product() * basis(settings.text("structure")).len() as f64)
}

/// The crystal about `center`; a cell's particles have ids in a row, and x runs fastest.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "crystal", settings };
    let cells = reader.vector("cells")?;
    if cells.to_array().iter().any(|n| n.fract() != 0.0 || *n < 1.0) {
        return Err(reader.error(&format!("cells is {cells}; it must be three whole numbers, 1 or above")));
    }
    let basis = basis(settings.text("structure"));
    let places: Vec<DVec3> = basis.iter().map(|place| DVec3::from(*place)).collect();
    let each = places.len() as f64;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole; beyond 2^64 it saturates, and is refused"
    )]
    let (_, mut particles) = reader.room_for((cells.element_product() * each) as u64)?;
    let edge = libm::cbrt(each / reader.positive("density")?);
    let mass = reader.not_negative("mass")?;
    let temperature = reader.not_negative("temperature")?;
    let (center, velocity) = (reader.vector("center")?, reader.vector("velocity")?);
    let radius = reader.not_negative("particle_size")?;
    if temperature > 0.0 && mass <= 0.0 {
        return Err(reader.error("particles without mass have no temperature: give them a mass, or no temperature"));
    }
    let middle = 0.5 * (cells - DVec3::ONE) + places.iter().sum::<DVec3>() / each;
    for k in steps(cells.z) {
        for j in steps(cells.y) {
            for i in steps(cells.x) {
                for place in &places {
                    let x = (DVec3::new(i, j, k) + *place - middle) * edge;
                    particles.push(x + center, DVec3::ZERO, mass, radius);
                }
            }
        }
    }
    let square = if mass > 0.0 { temperature / mass } else { 0.0 };
    heat(&mut particles, square, false, &mut Random::new(settings.whole("seed")));
    particles.velocity_mut().iter_mut().for_each(|v| *v += velocity);
    reader.finished(particles)
}

/// Normal velocities without their mean, scaled so that their squares add up to (3 N − 3) times a square, or in a plane to (2 N − 2) times it.
pub(super) fn heat(particles: &mut State, square: f64, flat: bool, random: &mut Random) {
    let count = particles.len() as f64;
    if count < 2.0 || square <= 0.0 {
        return;
    }
    let (axes, dimensions) = if flat { (DVec3::new(1.0, 1.0, 0.0), 2.0) } else { (DVec3::ONE, 3.0) };
    let drawn: Vec<DVec3> = particles.position().iter().map(|_| random.normals() * axes).collect();
    let mean = drawn.iter().sum::<DVec3>() / count;
    let sum: f64 = drawn.iter().map(|v| (*v - mean).length_squared()).sum();
    let factor = (square * (dimensions * (count - 1.0)) / sum).sqrt();
    particles.velocity_mut().iter_mut().zip(drawn).for_each(|(v, drawn)| *v = (drawn - mean) * factor);
}

/// 0, 1, … below an integer that `room_for` has found to fit 32 bits.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a factor of a product that fits 32 bits")]
fn steps(size: f64) -> impl Iterator<Item = f64> {
    (0..size as u32).map(f64::from)
}
