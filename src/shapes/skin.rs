//! Keys that all walls of a fluid share, and the positions of their layers.

use std::borrow::Cow;

use glam::DVec3;

use super::build::{PARTICLE_SIZE, Reader, hold};
use crate::error::Error;
use crate::settings::{Key, Kind, Value};
use crate::sph::{Smoothing, gap};
use crate::state::State;

pub(super) const SPACING: Key =
    Key::required("spacing", Kind::Positive, "the particle spacing; left out: that of the force `fluid` [length]")
        .shared();
pub(super) const DENSITY: Key = Key::new(
    "density",
    Kind::Positive,
    Value::Number(1000.0),
    "the density at rest of the fluid, as in the force [mass / length³, or mass / length²]",
)
.shared();
pub(super) const SUPPORT: Key = Key::new(
    "support",
    Kind::Positive,
    Value::Number(2.0),
    "the support radius of the fluid's kernel, as in the force [spacings]",
)
.shared();
pub(super) const KERNEL: Key = Key::new(
    "kernel",
    Kind::Choice(Smoothing::NAMES),
    Value::Text(Cow::Borrowed("cubic")),
    "the smoothing kernel of the fluid, as in the force",
)
.shared();
pub(super) const WALL_MASS: Key = Key::new(
    "wall_mass",
    Kind::Choice(&["sampled", "lattice"]),
    Value::Text(Cow::Borrowed("sampled")),
    "the mass of wall particles, as in the force: sampled walls stand at the gap that keeps the fluid at rest, lattice walls continue its lattice",
).shared();
pub(super) const LAYERS: Key = Key::new(
    "layers",
    Kind::Whole,
    Value::Number(0.0),
    "the layers of particles in a wall; 0: one where it is sampled, on a lattice as many as the support has spacings",
);
/// The same for all walls.
pub(super) const RADIUS: Key = PARTICLE_SIZE;

/// The maximum number of layers: supports end at 6 spacings, and particles beyond that have no effect.
const MOST: u64 = 64;

/// The layers of a wall.
pub(super) struct Skin {
    pub spacing: f64,
    /// The depth of the first layer behind the face \[length\].
    pub depth: f64,
    pub layers: u32,
    mass: f64,
    radius: f64,
}

impl Skin {
    pub fn of(reader: &Reader<'_>, flat: bool) -> Result<Self, Error> {
        let (spacing, density) = (reader.positive("spacing")?, reader.positive("density")?);
        let support = reader.number("support", "1.5 to 6 spacings", |x| (1.5..=6.0).contains(&x))?;
        let layers = reader.settings.whole("layers");
        if layers > MOST {
            return Err(reader.error(&format!("layers is {layers}; choose {MOST} at most")));
        }
        let lattice = reader.settings.text("wall_mass") == "lattice";
        let enough = if lattice { (1..6).find(|n| f64::from(*n) >= support).unwrap_or(6) } else { 1 };
        let layers = u32::try_from(layers).ok().filter(|n| *n > 0).unwrap_or(enough);
        let dimensions = if flat { 2 } else { 3 };
        let smoothing = Smoothing::named(reader.settings.text("kernel"));
        let gap = if lattice { 1.0 } else { gap(smoothing, support, layers, dimensions) };
        let mass = density * if flat { spacing * spacing } else { spacing.powi(3) };
        // The fluid's first layer is half a spacing in front of the face.
        let depth = (gap - 0.5) * spacing;
        Ok(Self { spacing, depth, layers, mass, radius: reader.not_negative("particle_size")? })
    }
    /// The depths of the layers behind the face \[length\].
    pub fn depths(&self) -> impl Iterator<Item = f64> {
        (0..self.layers).map(|k| self.depth + f64::from(k) * self.spacing)
    }
    /// Fixed particles at these positions. The force computes their masses.
    pub fn filled(&self, reader: &Reader<'_>, places: Vec<DVec3>) -> Result<State, Error> {
        let (_, mut particles) = reader.room_for(places.len() as u64)?;
        for place in places {
            particles.push(place, DVec3::ZERO, self.mass, self.radius);
        }
        let count = u32::try_from(particles.len()).unwrap_or(u32::MAX);
        hold(&mut particles, 0..count);
        reader.finished(particles)
    }
}

/// The number of lattice cells along each side; 1 along z in two dimensions.
pub(super) fn cells(reader: &Reader<'_>, size: DVec3, spacing: f64) -> Result<DVec3, Error> {
    if size.x <= 0.0 || size.y <= 0.0 || size.z < 0.0 {
        return Err(reader.error(&format!("size is {size}; sides must be above 0, that along z 0 or above")));
    }
    Ok((size / spacing).round().max(DVec3::ONE))
}

/// 0, 1, … below an integer that `room_for` has found to fit 32 bits.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a factor of a product that fits 32 bits")]
pub(super) fn steps(size: f64) -> impl Iterator<Item = f64> {
    (0..size as u32).map(f64::from)
}
