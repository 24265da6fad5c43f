//! Plummer's sphere in equilibrium:  ρ(r) = 3M / (4π a³) (1 + r²/a²)^(-5/2)  (Plummer 1911; sampled after Aarseth,
//! Hénon & Wielen 1974).

use std::f64::consts::PI;

use super::build::{CENTER, COUNT, G, PARTICLE_SIZE, Reader, SEED, TOTAL_MASS, VELOCITY};
use super::random::Random;
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `plummer`.
pub const PLUMMER: Shape = Shape {
    name: "plummer",
    about: "Plummer's sphere, a star cluster in equilibrium (Plummer 1911; Aarseth, Hénon & Wielen 1974)",
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
    Key::new(
        "scale",
        Kind::Positive,
        Value::Number(3.0 * PI / 16.0),
        "Plummer radius a [length]; half of the mass lies within 1.305 a; 3π/16 gives the energy -1/4 for g = mass = 1",
    ),
    G,
    Key::new(
        "cutoff",
        Kind::Positive,
        Value::Number(0.999),
        "fraction of the mass of the infinite model that is sampled, from the centre outwards (at most 1)",
    ),
    CENTER,
    VELOCITY,
    PARTICLE_SIZE,
];

/// `count` particles of equal mass; their centre of mass is at rest at `center`, up to `velocity`.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "plummer", settings };
    let (count, mut particles) = reader.room()?;
    let mut random = Random::new(settings.whole("seed"));
    let total = reader.positive("mass")?;
    let scale = reader.positive("scale")?;
    let g = reader.positive("g")?;
    let cutoff = reader.number("cutoff", "above 0 and at most 1", |x| x > 0.0 && x <= 1.0)?;
    let radius = reader.not_negative("particle_size")?;
    let mass = total / f64::from(u32::try_from(count).unwrap_or(u32::MAX));
    for _ in 0..count {
        // M(r)/M = (1 + a²/r²)^(-3/2), turned round.
        let root = libm::cbrt(cutoff * random.uniform());
        let r = scale * root / (1.0 - root * root).sqrt();
        let position = random.direction() * r;
        let escape = (2.0 * g * total / (scale * (1.0 + r * r / (scale * scale)).sqrt())).sqrt();
        let velocity = random.direction() * (escape * speed(&mut random));
        particles.push(position, velocity, mass, radius);
    }
    reader.finished(particles.centered(reader.vector("center")?, reader.vector("velocity")?))
}

/// A speed in units of the escape speed, from  q² (1 - q²)^(7/2)  by rejection below its bound 0.1.
fn speed(random: &mut Random) -> f64 {
    loop {
        let q = random.uniform();
        let height = 0.1 * random.uniform();
        let rest = 1.0 - q * q;
        if height < q * q * rest * rest * rest * rest.sqrt() {
            return q;
        }
    }
}
