//! A block of fluid at rest.

use std::f64::consts::TAU;

use glam::DVec3;

use super::build::{CENTER, PARTICLE_SIZE, Reader, SEED, VELOCITY};
use super::random::Random;
use super::skin::{DENSITY, SPACING, cells, steps};
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `block`.
pub const BLOCK: Shape = Shape {
    name: "block",
    about: "a block of fluid: a cubic lattice that fills a box, or a rectangle",
    keys: KEYS,
    build,
    amount,
    parts: one_part,
    resolution: Resolution::Spacing,
};

const KEYS: &[Key] = &[
    Key::required("size", Kind::Vector, "its sides; 0 along z for a rectangle [length]"),
    SPACING,
    DENSITY,
    Key::new("jitter", Kind::NotNegative, Value::Number(0.0), "largest displacement along each axis, in spacings"),
    Key::new(
        "vortices",
        Kind::Number,
        Value::Number(0.0),
        "the speed of vortices in it, one period along each of x and y (Taylor & Green 1937) [length / time]",
    ),
    Key::new(
        "strain",
        Kind::Number,
        Value::Number(0.0),
        "the rate of strain: stretched along y and compressed along x [1 / time]",
    ),
    SEED,
    CENTER,
    VELOCITY,
    PARTICLE_SIZE,
];

fn amount(settings: &Settings) -> Amount {
    let sides = (settings.vector("size") / settings.number("spacing")).round();
    Amount::of(sides.max(DVec3::ONE).element_product())
}

/// The best-fitting number of particles along each side, in the centres of their shares; each has the mass of the fluid in its share.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "block", settings };
    let (size, spacing) = (reader.vector("size")?, reader.positive("spacing")?);
    let (flat, numbers) = (size.z == 0.0, cells(&reader, size, spacing)?);
    reader.fits(numbers.element_product())?;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole; beyond 2^64 it saturates, and is refused"
    )]
    let (_, mut particles) = reader.room_for(numbers.element_product() as u64)?;
    let density = reader.positive("density")?;
    let mass = density * if flat { spacing * spacing } else { spacing.powi(3) };
    let jitter = reader.not_negative("jitter")?;
    let (center, velocity) = (reader.vector("center")?, reader.vector("velocity")?);
    let radius = reader.not_negative("particle_size")?;
    let [vortices, strain] = ["vortices", "strain"].map(|key| reader.number(key, "finite", |_| true));
    let (vortices, strain) = (vortices?, strain?);
    let flow = |x: DVec3| {
        let (x, angle) = (x * spacing, TAU * x / numbers);
        let whirl = DVec3::new(-libm::cos(angle.x) * libm::sin(angle.y), libm::sin(angle.x) * libm::cos(angle.y), 0.0);
        velocity + vortices * whirl + strain * DVec3::new(-x.x, x.y, 0.0)
    };
    let mut random = Random::new(settings.whole("seed"));
    let middle = (numbers - DVec3::ONE) * 0.5;
    for k in steps(numbers.z) {
        for j in steps(numbers.y) {
            for i in steps(numbers.x) {
                let mut place = DVec3::new(i, j, k) - middle;
                if jitter > 0.0 {
                    let x = random.between(-jitter, jitter);
                    let y = random.between(-jitter, jitter);
                    let z = if flat { 0.0 } else { random.between(-jitter, jitter) };
                    place += DVec3::new(x, y, z);
                }
                particles.push(place * spacing + center, flow(place), mass, radius);
            }
        }
    }
    reader.finished(particles)
}
