//! A simple cubic lattice, straight, jittered or with waves in it.

use glam::DVec3;

use super::build::{CENTER, PARTICLE_SIZE, Reader, SEED, VELOCITY};
use super::random::Random;
use super::zeldovich::displacements;
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `lattice`.
pub const LATTICE: Shape = Shape {
    name: "lattice",
    about: "a simple cubic lattice, straight, jittered, or displaced by random waves that grow by gravity (Zel'dovich 1970)",
    keys: KEYS,
    build,
    amount,
    parts: one_part,
    resolution: Resolution::Cells { key: "size", least: 1, periodic: true },
};

const KEYS: &[Key] = &[
    Key::required("size", Kind::Vector, "particles along x, y and z: three whole numbers, 1 or above"),
    Key::new("spacing", Kind::Positive, Value::Number(1.0), "distance between neighbours along an axis [length]"),
    Key::new("mass", Kind::NotNegative, Value::Number(1.0), "mass of each particle [mass]"),
    Key::new(
        "jitter",
        Kind::NotNegative,
        Value::Number(0.0),
        "largest displacement along each axis, in spacings; 0.5 lets neighbours just touch",
    ),
    Key::new(
        "displacement",
        Kind::NotNegative,
        Value::Number(0.0),
        "random waves, periodic over the lattice: root mean square of their displacement along each axis, in spacings",
    ),
    Key::new(
        "spectrum",
        Kind::Number,
        Value::Number(-2.0),
        "n of the power k^n of the density in those waves: the lower it is, the more there is in long ones",
    ),
    Key::new(
        "growth",
        Kind::Number,
        Value::Number(0.0),
        "velocity of each particle over its displacement by waves [1 / time]; sqrt(4 pi g density) for the growing mode",
    ),
    SEED,
    CENTER,
    VELOCITY,
    PARTICLE_SIZE,
];

fn amount(settings: &Settings) -> Amount {
    Amount::of(settings.vector("size").element_product())
}

/// `size.x * size.y * size.z` particles, the middle of the lattice at `center`; x runs fastest, so particle (i, j, k) has
/// the id  i + size.x (j + size.y k).
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "lattice", settings };
    let size = reader.vector("size")?;
    if size.to_array().iter().any(|n| n.fract() != 0.0 || *n < 1.0) {
        return Err(reader.error(&format!("size is {size}; it must be three whole numbers, 1 or above")));
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole; beyond 2^64 it saturates, and is refused"
    )]
    let (_, mut particles) = reader.room_for((size.x * size.y * size.z) as u64)?;
    let mut random = Random::new(settings.whole("seed"));
    let spacing = reader.positive("spacing")?;
    let mass = reader.not_negative("mass")?;
    let jitter = reader.not_negative("jitter")?;
    let center = reader.vector("center")?;
    let velocity = reader.vector("velocity")?;
    let radius = reader.not_negative("particle_size")?;
    let displacement = reader.not_negative("displacement")?;
    let [spectrum, growth] = ["spectrum", "growth"].map(|key| reader.number(key, "finite", |_| true));
    let (spectrum, growth) = (spectrum?, growth?);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole, of a product that fits 32 bits"
    )]
    let sides = size.to_array().map(|n| n as usize);
    let waves = if displacement > 0.0 { displacements(sides, spectrum, &mut random) } else { Vec::new() };
    let middle = (size - DVec3::ONE) * 0.5;
    for k in steps(size.z) {
        for j in steps(size.y) {
            for i in steps(size.x) {
                let mut place = DVec3::new(i, j, k) - middle;
                if jitter > 0.0 {
                    let x = random.between(-jitter, jitter);
                    let y = random.between(-jitter, jitter);
                    let z = random.between(-jitter, jitter);
                    place += DVec3::new(x, y, z);
                }
                let wave = waves.get(particles.len()).map_or(DVec3::ZERO, |wave| *wave * displacement);
                particles.push((place + wave) * spacing + center, velocity + wave * spacing * growth, mass, radius);
            }
        }
    }
    reader.finished(particles)
}

/// 0, 1, … below an integer that `room_for` has found to fit 32 bits.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a factor of a product that fits 32 bits")]
fn steps(size: f64) -> impl Iterator<Item = f64> {
    (0..size as u32).map(f64::from)
}
