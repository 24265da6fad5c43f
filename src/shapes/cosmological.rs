//! Matter of an expanding universe at a redshift: a lattice displaced by a random field (Zel'dovich 1970; second order: Bouchet et al. 1995).

use std::borrow::Cow;

use glam::DVec3;

use super::build::{CENTER, PARTICLE_SIZE, Reader, SEED};
use super::random::Random;
use super::{Amount, Resolution, Shape, one_part};
use crate::cosmology::{Cosmology, Spectrum, displacements, scale_factor};
use crate::error::Error;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `cosmological`.
pub const COSMOLOGICAL: Shape = Shape {
    name: "cosmological",
    about: "the matter of an expanding universe at a redshift, a periodic cube of particles of one mass in comoving coordinates: a lattice displaced by a random field with the power spectrum of cold dark matter (Eisenstein & Hu 1998), to first or second order (Zel'dovich 1970; Bouchet et al. 1995)",
    keys: KEYS,
    build,
    amount: |settings| Amount::of(settings.number("count_per_side").powi(3)),
    parts: one_part,
    resolution: Resolution::Cube { key: "count_per_side", least: 3 },
};

const KEYS: &[Key] = &[
    Key::required(
        "count_per_side",
        Kind::Count,
        "particles along each side of the cube, 3 to 464; soonest made where it has small factors, such as 2, 3 and 5",
    ),
    Key::required("side", Kind::Positive, "the side of the cube, comoving [length]"),
    Key::new(
        "g",
        Kind::Number,
        Value::Number(1.0),
        "the gravitational constant; left out: that of the force [length³ / mass / time²]",
    )
    .shared(),
    Key::new(
        "hubble",
        Kind::NotNegative,
        Value::Number(0.0),
        "Hubble's constant of today; left out: that of the force [1 / time]",
    )
    .shared(),
    Key::new(
        "omega_matter",
        Kind::Positive,
        Value::Number(0.3),
        "the density of matter today, of the critical one; left out: that of the force",
    )
    .shared(),
    Key::new(
        "omega_lambda",
        Kind::NotNegative,
        Value::Number(0.7),
        "that of the cosmological constant; left out: that of the force",
    )
    .shared(),
    Key::new(
        "redshift",
        Kind::NotNegative,
        Value::Number(49.0),
        "the redshift of the particles; left out: that of the force",
    )
    .shared(),
    Key::new(
        "sigma_8",
        Kind::Positive,
        Value::Number(0.8),
        "the root mean square of the density contrast in balls of 8 Mpc/h today, in linear theory",
    ),
    Key::new(
        "spectral_index",
        Kind::Number,
        Value::Number(0.96),
        "the index of the primordial power spectrum, k to this power: above -3 and below 4",
    ),
    Key::new(
        "omega_baryon",
        Kind::NotNegative,
        Value::Number(0.045),
        "the part of omega_matter that is baryons, for the power spectrum",
    ),
    Key::new("h", Kind::Positive, Value::Number(0.7), "Hubble's constant in 100 km/s/Mpc, for the power spectrum"),
    Key::required(
        "megaparsec",
        Kind::Positive,
        "how long 1 Mpc/h is in the unit of the scene: 1, or 1000 where lengths are in kpc/h [length]",
    ),
    Key::new(
        "order",
        Kind::Choice(&["second", "first"]),
        Value::Text(Cow::Borrowed("second")),
        "the order of the displacements: \"first\" for those of Zel'dovich",
    ),
    SEED,
    CENTER,
    PARTICLE_SIZE,
];

/// Particles along a side: so many that a wave fits, and no more than 100 million in all, whose fields take some 20 GB.
const SIDES: std::ops::RangeInclusive<f64> = 3.0..=464.0;

/// `count_per_side`³ particles, the middle of the cube at `center`; x runs fastest. The first lattice point is the lowest corner, so that those of a coarser
/// lattice are among those of a finer one.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "cosmological", settings };
    let count = settings.number("count_per_side");
    if !SIDES.contains(&count) {
        let (least, most) = (SIDES.start(), SIDES.end());
        return Err(
            reader.error(&format!("count_per_side is {count}; it must be a whole number from {least} to {most}"))
        );
    }
    if settings.number("hubble") <= 0.0 {
        return Err(
            reader.error("hubble is 0: give it to the force gravity, whose space then expands, or to the shape")
        );
    }
    let (side, g) = (reader.positive("side")?, reader.positive("g")?);
    let [hubble, matter, megaparsec, sigma] =
        ["hubble", "omega_matter", "megaparsec", "sigma_8"].map(|key| reader.positive(key));
    let (hubble, matter, megaparsec, sigma) = (hubble?, matter?, megaparsec?, sigma?);
    let [index, baryons, h, lambda] =
        ["spectral_index", "omega_baryon", "h", "omega_lambda"].map(|key| reader.number(key, "finite", |_| true));
    let of_shape = |why: Error| reader.error(&why.to_string());
    let cosmology = Cosmology::new(hubble, matter, lambda?).map_err(of_shape)?;
    let spectrum = Spectrum::new(&cosmology, baryons?, h?, index?, sigma).map_err(of_shape)?;
    let a = scale_factor(reader.not_negative("redshift")?);
    let (center, radius) = (reader.vector("center")?, reader.not_negative("particle_size")?);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, and at most 464")]
    let points = count as usize;
    let (_, mut particles) = reader.room_for((points as u64).pow(3))?;
    // Lengths in Mpc/h, and the powers of today.
    let mut random = Random::new(settings.whole("seed"));
    let second = settings.text("order") == "second";
    let made = displacements((points, side / megaparsec), |k| spectrum.power(k), || random.normal(), second);
    // Displacements grow as D, velocities dx / dt = a² dx / dT as a² H f D.
    let today = cosmology.growth(1.0);
    let first = cosmology.growth(a) / today * megaparsec;
    let [second, second_rate] = cosmology.second_growth(a);
    let second = second / (today * today) * megaparsec;
    let speed = a * a * cosmology.rate(a);
    let rate = cosmology.growth_rate(a);
    let mass = cosmology.mean_density(g) * side * side * side / (count * count * count);
    let (spacing, middle) = (side / count, 0.5 * count);
    for (place, one) in made.first.iter().enumerate() {
        let at = [place % points, place / points % points, place / (points * points)];
        let lattice = DVec3::from_array(at.map(|n| n as f64 - middle)) * spacing;
        let two = made.second.get(place).copied().unwrap_or_default() * second;
        let one = *one * first;
        particles.push(center + lattice + one + two, speed * (rate * one + second_rate * two), mass, radius);
    }
    reader.finished(particles)
}
