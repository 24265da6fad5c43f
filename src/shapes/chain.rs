//! A chain: pendulums, ropes, strings and beams.

use std::borrow::Cow;

use glam::DVec3;

use super::build::{MASS, PARTICLE_SIZE, Reader, VELOCITY, hold};
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::links::{Joint, Link, Rod};
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `chain`.
pub const CHAIN: Shape = Shape {
    name: "chain",
    about: "particles in a row, each connected to the next by springs, ropes or rods: pendulums, strings, beams",
    keys: KEYS,
    build,
    amount,
    parts: one_part,
    resolution: Resolution::Own,
};

const KEYS: &[Key] = &[
    Key::required("count", Kind::Count, "number of particles, 2 or above"),
    Key::new("from", Kind::Vector, Value::Vector(DVec3::ZERO), "where the first is [length]"),
    Key::new("to", Kind::Vector, Value::Vector(DVec3::X), "where the last is [length]"),
    MASS,
    Key::new("tie", Kind::Choice(&["spring", "rope", "rod"]), Value::Text(Cow::Borrowed("spring")), "the kind of link"),
    Key::new(
        "stiffness",
        Kind::NotNegative,
        Value::Number(1000.0),
        "springs, ropes: Hooke's constant of each [mass / time²]",
    ),
    Key::new(
        "damping",
        Kind::NotNegative,
        Value::Number(0.0),
        "springs, ropes: the damping of each, along its axis [mass / time]",
    ),
    Key::new(
        "rest",
        Kind::NotNegative,
        Value::Number(1.0),
        "springs, ropes: the rest length, relative to the distance; 0: equally stiff in all directions",
    ),
    Key::new(
        "bending",
        Kind::NotNegative,
        Value::Number(0.0),
        "the bending stiffness of joints, EI / ds [mass length² / time²]",
    ),
    Key::new(
        "pins",
        Kind::Choice(&["none", "first", "ends"]),
        Value::Text(Cow::Borrowed("none")),
        "which of the particles are fixed",
    ),
    VELOCITY,
    PARTICLE_SIZE,
];

fn amount(settings: &Settings) -> Amount {
    let count = settings.number("count");
    let ties = (count - 1.0).max(0.0);
    let (springs, rods) = if settings.text("tie") == "rod" { (0.0, ties) } else { (ties, 0.0) };
    let joints = if settings.number("bending") > 0.0 { (ties - 1.0).max(0.0) } else { 0.0 };
    Amount { springs, rods, joints, ..Amount::of(count) }
}

/// `count` particles from `from` to `to`, evenly, in that order.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "chain", settings };
    let (count, mut particles) = reader.room()?;
    if count < 2 {
        return Err(reader.error("count is 1; a chain has 2 particles or more"));
    }
    let (from, to) = (reader.vector("from")?, reader.vector("to")?);
    let mass = reader.positive("mass")?;
    let [stiffness, damping, rest, bending] =
        ["stiffness", "damping", "rest", "bending"].map(|key| reader.not_negative(key));
    let (stiffness, damping, rest, bending) = (stiffness?, damping?, rest?, bending?);
    let velocity = reader.vector("velocity")?;
    let radius = reader.not_negative("particle_size")?;
    let last = u32::try_from(count - 1).unwrap_or(u32::MAX);
    let distance = from.distance(to) / f64::from(last);
    if distance == 0.0 {
        return Err(reader.error("from and to are the same position: give two different ones"));
    }
    for i in 0..=last {
        particles.push(from.lerp(to, f64::from(i) / f64::from(last)), velocity, mass, radius);
    }
    for i in 0..last {
        let ends = [i, i + 1];
        match settings.text("tie") {
            "rod" => particles.links.rods.push(Rod { ends, length: distance }),
            tie => {
                let rope = tie == "rope";
                particles.links.springs.push(Link { ends, rest: rest * distance, stiffness, damping, rope });
            }
        }
        if bending > 0.0 && i > 0 {
            particles.links.joints.push(Joint { ids: [i - 1, i, i + 1], stiffness: bending, rest: 0.0 });
        }
    }
    match settings.text("pins") {
        "first" => hold(&mut particles, [0]),
        "ends" => hold(&mut particles, [0, last]),
        _ => {}
    }
    reader.finished(particles)
}
