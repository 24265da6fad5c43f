//! A spray: particles thrown from a nozzle into a cone.

use glam::{DMat3, DVec3};

use super::build::{CENTER, COUNT, PARTICLE_SIZE, Reader, SEED, VELOCITY};
use super::random::Random;
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `spray`.
pub const SPRAY: Shape = Shape {
    name: "spray",
    about: "particles thrown from a nozzle into a cone: sparks, drops, a fountain",
    keys: KEYS,
    build,
    amount: Amount::counted,
    parts: one_part,
    resolution: Resolution::Count { key: "count", least: 1 },
};

const KEYS: &[Key] = &[
    COUNT,
    SEED,
    Key::new("direction", Kind::Direction, Value::Vector(DVec3::Z), "the axis of the cone"),
    Key::new(
        "angle",
        Kind::NotNegative,
        Value::Number(15.0),
        "from the axis to the edge of the cone [degrees], up to 180",
    ),
    Key::new("speed", Kind::NotNegative, Value::Number(1.0), "mean speed [length / time]"),
    Key::new(
        "speed_spread",
        Kind::NotNegative,
        Value::Number(0.1),
        "standard deviation of the speed, as a part of its mean",
    ),
    Key::new("nozzle", Kind::NotNegative, Value::Number(0.0), "radius of the disk from which they are thrown [length]"),
    Key::new("mass", Kind::NotNegative, Value::Number(1.0), "mass of each particle [mass]"),
    CENTER,
    VELOCITY,
    PARTICLE_SIZE,
];

/// `count` particles that leave the nozzle at `center` all at once, their directions uniform in the solid angle of the cone.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "spray", settings };
    let (count, mut particles) = reader.room()?;
    let mut random = Random::new(settings.whole("seed"));
    let axis = reader.direction("direction")?;
    let angle = reader.number("angle", "between 0 and 180", |x| (0.0..=180.0).contains(&x))?;
    let speed = reader.not_negative("speed")?;
    let spread = reader.not_negative("speed_spread")?;
    let nozzle = reader.not_negative("nozzle")?;
    let mass = reader.not_negative("mass")?;
    let center = reader.vector("center")?;
    let velocity = reader.vector("velocity")?;
    let radius = reader.not_negative("particle_size")?;
    let (across, along) = axis.any_orthonormal_pair();
    let tilt = DMat3::from_cols(across, along, axis);
    let lowest = libm::cos(angle.to_radians());
    for _ in 0..count {
        // Uniform in height on the sphere is uniform in solid angle (Archimedes).
        let up = random.between(lowest, 1.0);
        let aside = (1.0 - up * up).max(0.0).sqrt();
        let way = turn(&mut random) * aside + DVec3::Z * up;
        let start = turn(&mut random) * (nozzle * random.uniform().sqrt());
        let fast = (speed * (1.0 + spread * random.normal())).max(0.0);
        particles.push(tilt * start + center, tilt * way * fast + velocity, mass, radius);
    }
    reader.finished(particles)
}

/// A direction in the plane.
fn turn(random: &mut Random) -> DVec3 {
    let angle = std::f64::consts::TAU * random.uniform();
    DVec3::new(libm::cos(angle), libm::sin(angle), 0.0)
}

#[cfg(test)]
mod tests {
    use super::{DVec3, KEYS, Settings, Value, build};

    #[test]
    fn a_spray_fills_its_cone_evenly() {
        let axis = DVec3::new(1.0, 2.0, -2.0);
        let settings = Settings::defaults(KEYS)
            .with("count", Value::Number(20_000.0))
            .with("direction", Value::Vector(axis))
            .with("angle", Value::Number(60.0))
            .with("speed", Value::Number(3.0))
            .with("nozzle", Value::Number(0.5));
        let spray = build(&settings).expect("these settings are sound");
        let n = 20_000.0;
        let cosines: Vec<f64> = spray.velocity().iter().map(|v| v.normalize().dot(axis / 3.0)).collect();
        assert!(cosines.iter().all(|&c| c >= 0.5 - 1e-12));
        // Uniform on [1/2, 1]: mean 3/4, deviation 1/√48; five standard errors.
        let mean = cosines.iter().sum::<f64>() / n;
        assert!((mean - 0.75).abs() < 5.0 * (1.0_f64 / 48.0 / n).sqrt(), "{mean}");
        let speed = spray.velocity().iter().map(|v| v.length()).sum::<f64>() / n;
        assert!((speed - 3.0).abs() < 5.0 * 0.3 / n.sqrt(), "{speed}");
        // Mean square radius of a disk is R² / 2, with deviation R² / √12.
        let square = spray.position().iter().map(|x| x.length_squared()).sum::<f64>() / n;
        assert!((square - 0.125).abs() < 5.0 * 0.25 / 12f64.sqrt() / n.sqrt(), "{square}");
        assert!(spray.position().iter().all(|x| x.dot(axis).abs() < 1e-12), "the nozzle is flat");
    }
}
