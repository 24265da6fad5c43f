//! Emitters: pending particles at a nozzle, spawned layer by layer or one by one.

use std::borrow::Cow;

use glam::DVec3;

use super::build::{CENTER, PARTICLE_SIZE, Reader, SEED};
use super::random::Random;
use crate::error::Error;
use crate::life::{Birth, Life};
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The key that makes an emitter a spray: its other keys are then not those of a fluid.
pub const SPRAY: &str = "rate";

/// The keys of an emitter.
pub const KEYS: &[Key] = &[
    Key::new(
        "shape",
        Kind::Choice(&["disk", "rectangle", "point"]),
        Value::Text(Cow::Borrowed("disk")),
        "the shape of the nozzle; in 2 dimensions a disk and a rectangle are lines",
    ),
    CENTER,
    Key::new("direction", Kind::Direction, Value::Vector(DVec3::X), "the direction of emission, normal to the nozzle"),
    Key::new("radius", Kind::Positive, Value::Number(0.5), "disk: the radius of the nozzle [length]"),
    Key::new(
        "size",
        Kind::Vector,
        Value::Vector(DVec3::ONE),
        "rectangle: the sides of the nozzle, along `across` and perpendicular to it; the third number is ignored [length]",
    ),
    Key::new(
        "across",
        Kind::Vector,
        Value::Vector(DVec3::ZERO),
        "rectangle: the direction of its first side; zero: any",
    ),
    Key::required("speed", Kind::Positive, "the speed of emitted particles [length / time]"),
    Key::new(
        "spacing",
        Kind::NotNegative,
        Value::Number(0.0),
        "for a fluid: the spacing of the cubic lattice, of which a layer is emitted every spacing / speed [length]",
    )
    .shared(),
    Key::new(
        SPRAY,
        Kind::NotNegative,
        Value::Number(0.0),
        "for a spray: the number of particles per unit of time, at random positions in the nozzle [1 / time]",
    ),
    Key::new(
        "guide",
        Kind::NotNegative,
        Value::Number(3.0),
        "of a fluid: the number of newest layers that move at constant velocity without forces, so that the jet has pressure behind it",
    ),
    Key::new(
        "density",
        Kind::Positive,
        Value::Number(1000.0),
        "of a fluid at rest, as in the force [mass / length³, or mass / length²]",
    )
    .shared(),
    Key::new(
        "mass",
        Kind::NotNegative,
        Value::Number(1.0),
        "the mass of each particle of a spray; particles of a fluid have density times lattice cell [mass]",
    ),
    Key::new("start", Kind::Number, Value::Number(0.0), "when the first ones leave [time]"),
    Key::new("stop", Kind::Number, Value::Number(FOREVER), "when it ends [time]; left out: at the end of the run"),
    Key::new("count", Kind::Whole, Value::Number(0.0), "the maximum number of its particles; 0: no limit"),
    Key::new(
        "spread",
        Kind::NotNegative,
        Value::Number(0.0),
        "the largest angle between velocities and the direction, uniform in the cone [degrees], up to 90",
    ),
    SEED,
    PARTICLE_SIZE,
];

/// The largest number that single precision holds: no end.
const FOREVER: f64 = 3.402_823_466_385_288_6e38;
/// Room for rounding, in parts of a row: a particle that would leave just at the end does not.
const ROUNDING: f64 = 1e-9;

/// The particles of an emitter in `dimensions` dimensions, in the order of their births. They are placed in its mouth; they have no mass
/// and no velocity before they are spawned. Those that would leave after `end` are left out, and there are at most `room`.
///
/// # Errors
/// [`Error::Scene`] when a setting is invalid, or no particle would leave; [`Error::Limit`] when there would be more than `room`.
pub fn build(settings: &Settings, dimensions: u32, end: f64, room: u32) -> Result<State, Error> {
    let reader = Reader { shape: "emitter", settings };
    let refuse = |text: String| Err(Error::Scene(format!("an emitter {text}")));
    let (spacing, rate) = (reader.not_negative("spacing")?, reader.not_negative("rate")?);
    if (spacing > 0.0) == (rate > 0.0) {
        return refuse("requires either a `spacing`, for a fluid, or a `rate`, for a spray".to_owned());
    }
    let direction = reader.direction("direction")?;
    if dimensions == 2 && direction.z != 0.0 {
        return refuse(format!("emits along {direction}, out of the plane: in 2 dimensions the z component must be 0"));
    }
    let speed = reader.positive("speed")?;
    let spread = reader.number("spread", "between 0 and 90", |x| (0.0..=90.0).contains(&x))?;
    let (start, stop) = (reader.number("start", "finite", |_| true)?, reader.number("stop", "finite", |_| true)?);
    let mouth = Mouth::of(&reader, direction, dimensions)?;
    let sites = if spacing > 0.0 { mouth.lattice(spacing, room)? } else { vec![DVec3::ZERO] };
    let interval = if spacing > 0.0 { spacing / speed } else { 1.0 / rate };
    let last = stop.min(end);
    let rows = ((last - start) / interval - ROUNDING).ceil().max(0.0);
    let wanted = settings.whole("count");
    #[expect(clippy::cast_precision_loss, reason = "an estimate of what there is room for")]
    let most = if wanted > 0 { wanted as f64 } else { f64::INFINITY };
    let number = (rows * sites.len() as f64).min(most);
    if number < 1.0 {
        return refuse(format!(
            "starts at {start} and ends at {last}, its `stop` or the end of the run: no particle would be spawned"
        ));
    }
    if number > f64::from(room) {
        return Err(Error::Limit(format!(
            "an emitter would spawn {number} particles until {last}, and the maximum is {room}: give it a `count`, or \
             stop it earlier"
        )));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most `room`")]
    let (count, mut particles) = reader.room_for(number as u64)?;
    let mass = if spacing > 0.0 {
        reader.positive("density")? * if dimensions == 2 { spacing * spacing } else { spacing.powi(3) }
    } else {
        reader.not_negative("mass")?
    };
    let (center, radius) = (reader.vector("center")?, reader.not_negative("particle_size")?);
    let guided = if spacing > 0.0 { reader.not_negative("guide")? * interval } else { 0.0 };
    let mut random = Random::new(settings.whole("seed"));
    for (id, k) in (0..count).zip(0_u32..) {
        let (row, site) = (id / sites.len(), sites[id % sites.len()]);
        let place = if spacing > 0.0 { site } else { mouth.anywhere(&mut random) };
        let way = if spread > 0.0 { mouth.cone(spread.to_radians(), &mut random) } else { direction };
        particles.push(center + place, DVec3::ZERO, 0.0, radius);
        let time = row as f64 * interval + start;
        particles.births.push(Birth { id: k, time, velocity: speed * way, mass, guided, emitter: 0 });
    }
    particles.set_lives(&vec![Life::Pending; count])?;
    reader.finished(particles)
}

/// The mouth: half its sides along two axes, of which the second is nothing in the plane.
struct Mouth {
    half: [f64; 2],
    round: bool,
    axes: [DVec3; 2],
    direction: DVec3,
    flat: bool,
}

impl Mouth {
    fn of(reader: &Reader<'_>, direction: DVec3, dimensions: u32) -> Result<Self, Error> {
        let flat = dimensions == 2;
        let across = reader.vector("across")?;
        let aside = (across - across.dot(direction) * direction).try_normalize();
        let aside = match aside {
            _ if flat => DVec3::new(-direction.y, direction.x, 0.0),
            Some(aside) => aside,
            None if across == DVec3::ZERO => direction.any_orthonormal_vector(),
            None => {
                return Err(Error::Scene(format!(
                    "`across` of an emitter is parallel to its direction, {direction}: change one of them"
                )));
            }
        };
        let shape = reader.settings.text("shape");
        let half = match shape {
            "rectangle" => {
                let size = reader.vector("size")?;
                if size.x <= 0.0 || size.y <= 0.0 {
                    let text = format!(
                        "the nozzle of an emitter has the sides {} by {}: both must be above 0",
                        size.x, size.y
                    );
                    return Err(Error::Scene(text));
                }
                [0.5 * size.x, 0.5 * size.y]
            }
            "point" => [0.0; 2],
            _ => [reader.positive("radius")?; 2],
        };
        let half = if flat { [half[0], 0.0] } else { half };
        Ok(Self { half, round: shape == "disk" && !flat, axes: [aside, direction.cross(aside)], direction, flat })
    }
    /// The points of a lattice, each with its share of the mouth; at least one.
    fn lattice(&self, spacing: f64, room: u32) -> Result<Vec<DVec3>, Error> {
        // The best-fitting number, in the centres of their shares.
        let numbers = self.half.map(|half| (2.0 * half / spacing).round().max(1.0));
        if numbers[0] * numbers[1] > f64::from(room) {
            let text = format!(
                "a row of an emitter would have {} × {} particles, and the maximum is {room}: choose a larger spacing",
                numbers[0], numbers[1]
            );
            return Err(Error::Limit(text));
        }
        let place = |k: f64, number: f64| spacing * (k - 0.5 * (number - 1.0));
        let mut sites = Vec::new();
        for j in steps(numbers[1]) {
            for i in steps(numbers[0]) {
                let (x, y) = (place(i, numbers[0]), place(j, numbers[1]));
                if !self.round || x * x + y * y <= self.half[0] * self.half[0] {
                    sites.push(x * self.axes[0] + y * self.axes[1]);
                }
            }
        }
        Ok(if sites.is_empty() { vec![DVec3::ZERO] } else { sites })
    }
    /// A random position.
    fn anywhere(&self, random: &mut Random) -> DVec3 {
        let [x, y] = if self.round {
            let (r, angle) = (random.uniform().sqrt(), std::f64::consts::TAU * random.uniform());
            [r * libm::cos(angle), r * libm::sin(angle)]
        } else {
            [random.between(-1.0, 1.0), random.between(-1.0, 1.0)]
        };
        self.half[0] * x * self.axes[0] + self.half[1] * y * self.axes[1]
    }
    /// A random direction in a cone.
    fn cone(&self, angle: f64, random: &mut Random) -> DVec3 {
        if self.flat {
            let turn = random.between(-angle, angle);
            return libm::cos(turn) * self.direction + libm::sin(turn) * self.axes[0];
        }
        // Uniform in height on the sphere is uniform in solid angle (Archimedes).
        let up = random.between(libm::cos(angle), 1.0);
        let (aside, turn) = ((1.0 - up * up).max(0.0).sqrt(), std::f64::consts::TAU * random.uniform());
        up * self.direction + aside * (libm::cos(turn) * self.axes[0] + libm::sin(turn) * self.axes[1])
    }
}

/// 0, 1, … below an integer that fits 32 bits.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked to be at most `room`")]
fn steps(number: f64) -> impl Iterator<Item = f64> {
    (0..number as u32).map(f64::from)
}
