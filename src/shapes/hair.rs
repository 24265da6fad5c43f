//! Hair on a head.

use glam::DVec3;

use super::build::{CENTER, PARTICLE_SIZE, Reader, SEED, hold};
use super::random::Random;
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::links::{Joint, Rod};
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `hair`.
pub const HAIR: Shape = Shape {
    name: "hair",
    about: "strands of rods and joints that stand on a head; the first two particles of each are fixed",
    keys: KEYS,
    build,
    amount,
    parts: one_part,
    resolution: Resolution::Count { key: "strands", least: 1 },
};

const KEYS: &[Key] = &[
    Key::required("strands", Kind::Count, "number of strands"),
    Key::new("points", Kind::Count, Value::Number(16.0), "particles of each strand, 3 or above"),
    Key::new("length", Kind::Positive, Value::Number(0.3), "the length of a strand [length]"),
    Key::new(
        "spread",
        Kind::NotNegative,
        Value::Number(0.1),
        "the variation of lengths, relative to the length; below 1",
    ),
    Key::new("head", Kind::Positive, Value::Number(0.1), "the radius of the head [length]"),
    Key::new(
        "cap",
        Kind::Positive,
        Value::Number(100.0),
        "how far down from the top of the head it grows [degrees], up to 180",
    ),
    Key::new("mass", Kind::Positive, Value::Number(1e-5), "mass of each particle [mass]"),
    Key::new(
        "bending",
        Kind::NotNegative,
        Value::Number(1e-6),
        "the bending stiffness EI of a strand [mass length³ / time²]",
    ),
    Key::new("up", Kind::Direction, Value::Vector(DVec3::Z), "the direction from the centre of the head to its top"),
    SEED,
    CENTER,
    PARTICLE_SIZE,
];

fn amount(settings: &Settings) -> Amount {
    let (strands, points) = (settings.number("strands"), settings.number("points"));
    let rods = strands * (points - 2.0).max(0.0);
    let joints = if settings.number("bending") > 0.0 { rods } else { 0.0 };
    Amount { rods, joints, ..Amount::of(strands * points) }
}

/// `strands * points` particles, strand by strand from its root on. Roots are distributed evenly on the cap (Fibonacci's lattice), and
/// strands are perpendicular to the head, whose centre is at `center`. Inner joints have EI / ds, the clamped one at the second particle 2
/// EI / ds: half of the piece before it does not bend.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "hair", settings };
    let (strands, points) = (settings.whole("strands"), settings.whole("points"));
    if strands < 1 || points < 3 {
        let text = format!("strands and points are {strands} and {points}; they must be 1 and 3, or above");
        return Err(reader.error(&text));
    }
    let (_, mut particles) = reader.room_for(strands.saturating_mul(points))?;
    let [strands, points] = [strands, points].map(|n| u32::try_from(n).unwrap_or(u32::MAX));
    let (length, head) = (reader.positive("length")?, reader.positive("head")?);
    let spread = reader.number("spread", "0 or above, and below 1", |x| (0.0..1.0).contains(&x))?;
    let cap = reader.number("cap", "above 0, and up to 180", |x| x > 0.0 && x <= 180.0)?;
    let (mass, bending) = (reader.positive("mass")?, reader.not_negative("bending")?);
    let (up, center) = (reader.direction("up")?, reader.vector("center")?);
    let radius = reader.not_negative("particle_size")?;
    let (across, along) = up.any_orthonormal_pair();
    let mut random = Random::new(settings.whole("seed"));
    let lowest = libm::cos(cap.to_radians());
    let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    for strand in 0..strands {
        let height = 1.0 - (1.0 - lowest) * (f64::from(strand) + 0.5) / f64::from(strands);
        let aside = (1.0 - height * height).max(0.0).sqrt();
        let angle = golden * f64::from(strand);
        let way = height * up + aside * (libm::cos(angle) * across + libm::sin(angle) * along);
        let ds = length * (1.0 + spread * random.between(-1.0, 1.0)) / f64::from(points - 1);
        let first = strand * points;
        for point in 0..points {
            particles.push(center + way * (head + ds * f64::from(point)), DVec3::ZERO, mass, radius);
            let id = first + point;
            if point > 1 {
                particles.links.rods.push(Rod { ends: [id - 1, id], length: ds });
                let stiffness = bending / ds * if point == 2 { 2.0 } else { 1.0 };
                if stiffness > 0.0 {
                    particles.links.joints.push(Joint { ids: [id - 2, id - 1, id], stiffness, rest: 0.0 });
                }
            }
        }
        hold(&mut particles, [first, first + 1]);
    }
    reader.finished(particles)
}
