//! Hernquist's sphere in equilibrium, a galaxy or halo with a cusp:  ρ(r) = M a / (2π r (r + a)³)  (Hernquist 1990).
//!
//! Velocities are drawn from the model's own distribution function, his equation 17, by rejection without any table. The
//! model ends nowhere, so particles are drawn from its inner `cutoff` alone, and have just the mass of that: forces and
//! motions inside are those of the endless model, and only particles that leave the cut meet none on the way in.

use super::build::{CENTER, COUNT, G, PARTICLE_SIZE, Reader, SEED, TOTAL_MASS, VELOCITY};
use super::random::Random;
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `hernquist`.
pub const HERNQUIST: Shape = Shape {
    name: "hernquist",
    about: "Hernquist's sphere, a galaxy or halo with a cusp ρ ∝ 1/r, in equilibrium (Hernquist 1990)",
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
        "scale",
        Kind::Positive,
        Value::Number(1.0 / 3.0),
        "scale a [length]; half of the mass lies within 2.414 a; 1/3 gives the energy -1/4 for g = mass = 1",
    ),
    G,
    Key::new(
        "cutoff",
        Kind::Positive,
        Value::Number(0.99),
        "fraction of the mass of the infinite model that is sampled, from the centre outwards (below 1); 0.99 ends at 199 a",
    ),
    CENTER,
    VELOCITY,
    PARTICLE_SIZE,
];

/// `count` particles of equal mass; their centre of mass is at rest at `center`, up to `velocity`.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "hernquist", settings };
    let (count, mut particles) = reader.room()?;
    let mut random = Random::new(settings.whole("seed"));
    let total = reader.positive("mass")?;
    let scale = reader.positive("scale")?;
    let g = reader.positive("g")?;
    let cutoff = reader.number("cutoff", "above 0 and below 1", |x| x > 0.0 && x < 1.0)?;
    let radius = reader.not_negative("particle_size")?;
    let mass = total / f64::from(u32::try_from(count).unwrap_or(u32::MAX));
    for _ in 0..count {
        // M(r)/M = r² / (r + a)², turned round.
        let root = (cutoff * random.uniform()).sqrt();
        let r = root / (1.0 - root);
        let position = random.direction() * (scale * r);
        // The endless model is heavier than what is drawn of it.
        let escape = (2.0 * g * total / (cutoff * scale * (1.0 + r))).sqrt();
        let velocity = random.direction() * (escape * speed(r, &mut random));
        particles.push(position, velocity, mass, radius);
    }
    reader.finished(particles.centered(reader.vector("center")?, reader.vector("velocity")?))
}

/// A speed in units of the escape speed at a radius r in units of a.
///
/// With q² = a |E| / G M, the speeds x have the density  `x² h(q) q⁵ (1 - q²)^(-5/2)`.  For  q² = u / (r + u),  which is
/// x² = r (1 - u) / (r + u),  that is  `√(1 - u) h(q) q⁵`  for u between 0 and 1: bounded however near the centre is.
fn speed(r: f64, random: &mut Random) -> f64 {
    loop {
        let u = random.uniform();
        let height = H_0 * random.uniform();
        let square = u / (r + u);
        // 1 at most: q² is 1 / (1 + r) for a body at rest, and less for others.
        let part = square * (1.0 + r);
        if height < (1.0 - u).sqrt() * part * part * part.sqrt() * h(square) {
            return (r * (1.0 - u) / (r + u)).sqrt();
        }
    }
}

/// h(0), its largest value.
const H_0: f64 = 25.6;

/// h(q) = (3 arcsin q + q √(1 - q²) (1 - 2q²) (8q⁴ - 8q² - 3)) / q⁵, of q².
fn h(square: f64) -> f64 {
    if square < 0.01 {
        // The closed form loses its digits here; the next term of the series is 1e-11.
        let series = [25.6, -192.0 / 7.0, 16.0 / 3.0, 8.0 / 11.0, 3.0 / 13.0];
        return series.iter().rev().fold(0.0, |sum, c| sum * square + c);
    }
    let q = square.sqrt();
    let rest = q * (1.0 - square).sqrt() * (1.0 - 2.0 * square) * (8.0 * square * (square - 1.0) - 3.0);
    (3.0 * libm::asin(q) + rest) / (square * square * q)
}

#[cfg(test)]
mod tests {
    use super::h;

    #[test]
    fn the_series_meets_the_closed_form() {
        // Values in 30 digits; the closed form keeps 1e-13 of them at q = 0.1, where the two meet.
        for (q, wanted) in [(0.01, 25.597_257_196_2), (0.1, 25.326_248_348_6), (0.5, 19.088_567_921_2)] {
            assert!((h(q * q) / wanted - 1.0_f64).abs() < 1e-11, "{q}: {}", h(q * q));
        }
        let (below, above) = (h(0.01 - 1e-12), h(0.01 + 1e-12));
        assert!((below - above).abs() < 1e-9, "{below} {above}");
    }
}
