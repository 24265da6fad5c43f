//! A drop of fluid.

use glam::DVec3;

use super::build::{CENTER, PARTICLE_SIZE, Reader, VELOCITY};
use super::skin::{DENSITY, SPACING, cells, steps};
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::settings::{Key, Kind, Settings};
use crate::state::State;

/// The shape `drop`.
pub const DROP: Shape = Shape {
    name: "drop",
    about: "a drop of fluid: a ball, an ellipsoid or a disk cut from a cubic lattice",
    keys: KEYS,
    build,
    amount,
    parts: one_part,
    resolution: Resolution::Spacing,
};

const KEYS: &[Key] = &[
    Key::required("size", Kind::Vector, "its diameters along x, y and z; 0 along z for a disk [length]"),
    SPACING,
    DENSITY,
    CENTER,
    VELOCITY,
    PARTICLE_SIZE,
];

/// The part of a box that an ellipsoid fills is π / 6.
fn amount(settings: &Settings) -> Amount {
    let sides = (settings.vector("size") / settings.number("spacing")).round();
    Amount::of((sides.max(DVec3::ONE).element_product() * 0.55).ceil())
}

/// All points of a lattice about its centre that are within the drop; each has the mass of the fluid in its share.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "drop", settings };
    let (size, spacing) = (reader.vector("size")?, reader.positive("spacing")?);
    let (flat, numbers) = (size.z == 0.0, cells(&reader, size, spacing)?);
    reader.fits(numbers.element_product())?;
    let mass = reader.positive("density")? * if flat { spacing * spacing } else { spacing.powi(3) };
    let (center, velocity) = (reader.vector("center")?, reader.vector("velocity")?);
    let radius = reader.not_negative("particle_size")?;
    let middle = (numbers - DVec3::ONE) * 0.5;
    let half = 0.5 * if flat { size.with_z(1.0) } else { size };
    let mut particles = State::default();
    for k in steps(numbers.z) {
        for j in steps(numbers.y) {
            for i in steps(numbers.x) {
                let place = (DVec3::new(i, j, k) - middle) * spacing;
                if (place / half).length_squared() <= 1.0 {
                    particles.push(place + center, velocity, mass, radius);
                }
            }
        }
    }
    reader.finished(particles)
}
