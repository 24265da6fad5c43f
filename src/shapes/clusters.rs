//! Clumps of clumps: the hierarchical model of Soneira & Peebles (1978), a fractal.
//!
//! A ball of radius R holds η smaller ones of radius R / λ, whose centres are drawn from all of it; each of these again
//! holds η, and so on down to single particles. The mean number of others within r of one grows as r^D, with the
//! correlation dimension  D = ln η / ln λ.

use glam::DVec3;

use super::build::{CENTER, COUNT, PARTICLE_SIZE, Reader, SEED, TOTAL_MASS, VELOCITY};
use super::random::Random;
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `clusters`.
pub const CLUSTERS: Shape = Shape {
    name: "clusters",
    about: "clumps of clumps, a fractal, cold or with Gaussian velocities (Soneira & Peebles 1978)",
    keys: KEYS,
    amount: Amount::counted,
    parts: one_part,
    build,
    resolution: Resolution::Count { key: "count", least: 1 },
};

const KEYS: &[Key] = &[
    COUNT,
    SEED,
    TOTAL_MASS,
    Key::new(
        "radius",
        Kind::Positive,
        Value::Number(1.0),
        "radius of the ball that the centres of the largest clumps lie in; what they hold lies up to λ / (λ - 1) as far out [length]",
    ),
    Key::new("children", Kind::Count, Value::Number(2.0), "η: how many clumps a clump holds (2 or above)"),
    Key::new(
        "dimension",
        Kind::Positive,
        Value::Number(1.23),
        "D = ln η / ln λ, at most 3: 3 is evenly filled; 1.23 is that of galaxies, λ = 1.76 for η = 2",
    ),
    Key::new(
        "dispersion",
        Kind::NotNegative,
        Value::Number(0.0),
        "standard deviation of each component of the velocities [length / time]",
    ),
    CENTER,
    VELOCITY,
    PARTICLE_SIZE,
];

/// `count` particles of equal mass, a clump's side by side; their centre of mass is at `center`, up to `velocity`.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "clusters", settings };
    let (count, mut particles) = reader.room()?;
    let total = reader.positive("mass")?;
    let radius = reader.positive("radius")?;
    let children = settings.whole("children");
    if children < 2 {
        return Err(reader.error(&format!("children is {children}; it must be 2 or above")));
    }
    let dimension = reader.number("dimension", "above 0 and at most 3", |x| x > 0.0 && x <= 3.0)?;
    let dispersion = reader.not_negative("dispersion")?;
    let size = reader.not_negative("particle_size")?;
    let count = u32::try_from(count).unwrap_or(u32::MAX);
    let mut random = Random::new(settings.whole("seed"));
    let shrink = libm::exp(-libm::log(children as f64) / dimension);
    let mut places = Vec::new();
    let clump = Clump { center: DVec3::ZERO, radius, count };
    clump.fill(u32::try_from(children).unwrap_or(u32::MAX), shrink, &mut random, &mut places);
    for position in places {
        particles.push(position, random.normals() * dispersion, total / f64::from(count), size);
    }
    reader.finished(particles.centered(reader.vector("center")?, reader.vector("velocity")?))
}

/// A ball with a number of particles.
struct Clump {
    center: DVec3,
    radius: f64,
    count: u32,
}

impl Clump {
    /// Fills it: as deep as there are particles to tell apart, which is ln N / ln η levels.
    fn fill(&self, children: u32, shrink: f64, random: &mut Random, places: &mut Vec<DVec3>) {
        if self.count == 1 {
            return places.push(self.center);
        }
        for child in 0..children.min(self.count) {
            // As evenly as possible; the first have one more.
            let count = self.count / children + u32::from(child < self.count % children);
            let center = self.center + random.ball() * self.radius;
            Self { center, radius: self.radius * shrink, count }.fill(children, shrink, random, places);
        }
    }
}
