//! A disk galaxy: an exponential disk, sech² across, in a Hernquist halo, around a Hernquist bulge, near equilibrium
//! (Hernquist 1993).

use std::borrow::Cow;
use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use super::build::{CENTER, COUNT, G, PARTICLE_SIZE, Reader, SEED, VELOCITY};
use super::halo::Round;
use super::random::Random;
use super::rotation::{Galaxy, Rotation, Sphere};
use super::{Amount, Resolution, Shape};
use crate::error::Error;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `disk`.
pub const DISK: Shape = Shape {
    name: "disk",
    about: "a disk galaxy in a halo, with a bulge or without, near equilibrium: the disk's particles first, then the halo's, then the bulge's (Hernquist 1993)",
    keys: KEYS,
    build,
    amount: Amount::counted,
    parts,
    resolution: Resolution::Count { key: "count", least: 1 },
};

const NONE: Value = Value::Text(Cow::Borrowed(""));
const KEYS: &[Key] = &[
    COUNT,
    SEED,
    Key::new("disk_mass", Kind::Positive, Value::Number(1.0), "mass of the disk [mass]"),
    Key::new("disk_scale", Kind::Positive, Value::Number(1.0), "R_d of its surface density exp(-R / R_d) [length]"),
    Key::new("disk_height", Kind::Positive, Value::Number(0.2), "z₀ of its profile sech²(z / z₀) [length]"),
    Key::new("halo_mass", Kind::NotNegative, Value::Number(6.0), "mass of the halo [mass]; 0 leaves it out"),
    Key::new(
        "halo_scale",
        Kind::Positive,
        Value::Number(3.0),
        "a of the halo's density 1 / (r (r + a)³), which is cut at 10 a [length]",
    ),
    Key::new(
        "halo_fraction",
        Kind::NotNegative,
        Value::Number(0.75),
        "share of the particles that are halo (below 1); their ids follow the disk's",
    ),
    Key::new("halo_color", Kind::Color, NONE, "the halo in pictures; \"black\" hides it; left out: as the disk"),
    Key::new("bulge_mass", Kind::NotNegative, Value::Number(0.0), "mass of the bulge [mass]; 0 leaves it out"),
    Key::new("bulge_scale", Kind::Positive, Value::Number(0.2), "a of the bulge's density, as of the halo's [length]"),
    Key::new(
        "bulge_fraction",
        Kind::NotNegative,
        Value::Number(0.1),
        "share of the particles that are bulge (below 1), where it has a mass; their ids follow the halo's",
    ),
    Key::new("bulge_color", Kind::Color, NONE, "the bulge in pictures; left out: as the disk"),
    Key::new(
        "toomre_q",
        Kind::NotNegative,
        Value::Number(1.2),
        "Toomre's Q at every radius: below 1 the disk breaks into clumps, above 2 it forms hardly any arms",
    ),
    Key::new(
        "softening",
        Kind::NotNegative,
        Value::Number(0.0),
        "the softening of the force `gravity` [length], so that the centre is in equilibrium too",
    ),
    Key::new("normal", Kind::Direction, Value::Vector(DVec3::Z), "the axis about which it turns, counter-clockwise"),
    G,
    CENTER,
    VELOCITY,
    PARTICLE_SIZE,
];

/// `count` particles: first those of the disk, then those of the halo and of the bulge, equal masses within each. All have
/// their own centre of mass at rest at `center`, up to `velocity`, so that the disk starts in the middle of its halo.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "disk", settings };
    let (count, _) = reader.room()?;
    let mut random = Random::new(settings.whole("seed"));
    let galaxy = Galaxy {
        g: reader.positive("g")?,
        disk_mass: reader.positive("disk_mass")?,
        disk_scale: reader.positive("disk_scale")?,
        disk_height: reader.positive("disk_height")?,
        halo: Sphere { mass: reader.not_negative("halo_mass")?, scale: reader.positive("halo_scale")? },
        bulge: Sphere { mass: reader.not_negative("bulge_mass")?, scale: reader.positive("bulge_scale")? },
        softening: reader.not_negative("softening")?,
        toomre_q: reader.not_negative("toomre_q")?,
    };
    let normal = reader.direction("normal")?;
    let center = reader.vector("center")?;
    let velocity = reader.vector("velocity")?;
    let radius = reader.not_negative("particle_size")?;
    let [disk_count, halo_count, bulge_count] = split(&reader, count)?;

    let mut disk = State::default();
    let rotation = Rotation::new(&galaxy);
    let (across, along) = normal.any_orthonormal_pair();
    let tilt = DMat3::from_cols(across, along, normal);
    for _ in 0..disk_count {
        let (position, velocity) = star(&galaxy, &rotation, &mut random);
        disk.push(tilt * position, tilt * velocity, galaxy.disk_mass / f64::from(disk_count), radius);
    }
    let mut particles = disk.centered(center, velocity);
    for (Sphere { mass, scale }, count) in [(galaxy.halo, halo_count), (galaxy.bulge, bulge_count)] {
        if count > 0 {
            let mut part = State::default();
            let round = Round::new(&galaxy, scale);
            for _ in 0..count {
                let (position, velocity) = round.draw(&mut random);
                part.push(position, velocity, mass / f64::from(count), radius);
            }
            particles.append(&part.centered(center, velocity))?;
        }
    }
    reader.finished(particles)
}

/// The numbers of particles of disk, halo and bulge.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a share below 1 of a number that fits 32 bits"
)]
fn counts(settings: &Settings) -> [u32; 3] {
    let count = u32::try_from(settings.whole("count")).unwrap_or(u32::MAX);
    let share = |mass, fraction| {
        let wanted = settings.number(mass) > 0.0;
        if wanted { (f64::from(count) * settings.number(fraction)).round() as u32 } else { 0 }
    };
    let (halo, bulge) = (share("halo_mass", "halo_fraction"), share("bulge_mass", "bulge_fraction"));
    [count.saturating_sub(halo.saturating_add(bulge)), halo, bulge]
}

/// The same, checked.
fn split(reader: &Reader, count: usize) -> Result<[u32; 3], Error> {
    for fraction in ["halo_fraction", "bulge_fraction"] {
        reader.number(fraction, "0 or above and below 1", |x| (0.0..1.0).contains(&x))?;
    }
    let [disk, halo, bulge] = counts(reader.settings);
    let empty = |mass: &str, part: u32| part == 0 && reader.settings.number(mass) > 0.0;
    if empty("halo_mass", halo) {
        Err(reader.error("no particle is left for the halo: raise count or halo_fraction, or set halo_mass to 0"))
    } else if empty("bulge_mass", bulge) {
        Err(reader.error("no particle is left for the bulge: raise count or bulge_fraction, or set bulge_mass to 0"))
    } else if disk == 0 || [disk, halo, bulge].iter().map(|n| *n as usize).sum::<usize>() != count {
        Err(reader.error("no particle is left for the disk: raise count or lower halo_fraction or bulge_fraction"))
    } else {
        Ok([disk, halo, bulge])
    }
}

/// Halo and bulge.
fn parts(settings: &Settings) -> Vec<(&'static str, u32)> {
    let [_, halo, bulge] = counts(settings);
    vec![("halo_color", halo), ("bulge_color", bulge)]
}

/// One star of the disk, which rotates about z.
fn star(galaxy: &Galaxy, rotation: &Rotation, random: &mut Random) -> (DVec3, DVec3) {
    // R exp(-R) is the distribution of the sum of two exponential numbers.
    let radius = -galaxy.disk_scale * libm::log(random.uniform() * random.uniform());
    let angle = TAU * random.uniform();
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    let height = random.uniform();
    // z₀ artanh(2u - 1)
    let z = 0.5 * galaxy.disk_height * libm::log(height / (1.0 - height));
    let ring = rotation.at(radius);
    let outward = ring.radial.sqrt() * random.normal();
    let around = ring.mean.sqrt() + ring.azimuthal.sqrt() * random.normal();
    let up = ring.vertical.sqrt() * random.normal();
    (
        DVec3::new(radius * cos, radius * sin, z),
        DVec3::new(outward * cos - around * sin, outward * sin + around * cos, up),
    )
}
