//! Keys and checks that all shapes share.

use glam::DVec3;

use super::Amount;
use crate::error::Error;
use crate::motion::{Held, Hold};
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

pub(super) const COUNT: Key = Key::required("count", Kind::Count, "number of particles");
pub(super) const SEED: Key = Key::new("seed", Kind::Whole, Value::Number(1.0), "seed of the random numbers");
pub(super) const G: Key =
    Key::new("g", Kind::Positive, Value::Number(1.0), "constant of gravity [length³ / mass / time²]; as in the force");
pub(super) const CENTER: Key =
    Key::new("center", Kind::Vector, Value::Vector(DVec3::ZERO), "the position of the centre [length]");
pub(super) const VELOCITY: Key =
    Key::new("velocity", Kind::Vector, Value::Vector(DVec3::ZERO), "the velocity of the whole [length / time]");
pub(super) const MASS: Key = Key::new("mass", Kind::Positive, Value::Number(1.0), "mass of each particle [mass]");
pub(super) const TOTAL_MASS: Key =
    Key::new("mass", Kind::Positive, Value::Number(1.0), "mass of all particles together [mass]");
pub(super) const PARTICLE_SIZE: Key = Key::new(
    "particle_size",
    Kind::NotNegative,
    Value::Number(0.0),
    "the radius at which particles are drawn [length]; 0: chosen by the picture",
);

/// The most particles of what is sampled by a spacing, where a slip makes many.
const MOST: u32 = 100_000_000;

/// Holds particles of a shape where they are; the scene may lead them along a motion instead.
pub(super) fn hold(particles: &mut State, ids: impl IntoIterator<Item = u32>) {
    particles.held.extend(ids.into_iter().map(|id| Held { id, by: Hold::Fixed }));
}

/// The settings of one shape, read with checks, so that a caller that skips the scene's own checks gets an error, not NaN.
pub(super) struct Reader<'a> {
    pub shape: &'static str,
    pub settings: &'a Settings,
}

impl Reader<'_> {
    pub fn error(&self, message: &str) -> Error {
        Error::Scene(format!("shape `{}`: {message}", self.shape))
    }

    /// Whether the settings are those of the shape.
    fn named(&self) -> Result<(), Error> {
        let keys = super::shape(self.shape).map_or(super::emitter::KEYS, |shape| shape.keys);
        let fault = self.settings.misnamed(keys);
        fault.map_or(Ok(()), |fault| Err(Error::Scene(format!("shape `{}` {fault}", self.shape))))
    }

    /// A finite number above zero.
    pub fn positive(&self, key: &str) -> Result<f64, Error> {
        self.number(key, "above 0", |x| x > 0.0)
    }

    /// A finite number, zero or above.
    pub fn not_negative(&self, key: &str) -> Result<f64, Error> {
        self.number(key, "0 or above", |x| x >= 0.0)
    }

    /// A number of a range that `rule` spells out.
    pub fn number(&self, key: &str, rule: &str, holds: fn(f64) -> bool) -> Result<f64, Error> {
        self.named()?;
        let x = self.settings.number(key);
        if x.is_finite() && holds(x) { Ok(x) } else { Err(self.error(&format!("{key} is {x}; it must be {rule}"))) }
    }

    /// Three finite numbers.
    pub fn vector(&self, key: &str) -> Result<DVec3, Error> {
        self.named()?;
        let v = self.settings.vector(key);
        if v.is_finite() { Ok(v) } else { Err(self.error(&format!("{key} is {v}; it must be three finite numbers"))) }
    }

    /// The unit vector of a direction of any length.
    pub fn direction(&self, key: &str) -> Result<DVec3, Error> {
        let v = self.vector(key)?;
        // Scaled first, so that neither huge nor tiny numbers leave the range when squared.
        let scaled = v / v.abs().max_element();
        scaled.try_normalize().ok_or_else(|| self.error(&format!("{key} is {v}; a direction must not be zero")))
    }

    /// Room for the shape's `count` particles.
    pub fn room(&self) -> Result<(usize, State), Error> {
        let count = self.settings.whole("count");
        if count == 0 {
            return Err(self.error("count is 0; it must be 1 or above"));
        }
        self.room_for(count)
    }

    /// Room for `count` particles: ids are 32 bits, and memory that is not there is an error here, not an abort later.
    pub fn room_for(&self, count: u64) -> Result<(usize, State), Error> {
        let limit = |message: String| {
            Error::Limit(format!("shape `{}`: {count} particles {message}; ask for fewer", self.shape))
        };
        let count = u32::try_from(count)
            .ok()
            .and_then(|count| usize::try_from(count).ok())
            .ok_or_else(|| limit(format!("need ids beyond the {} that fit 32 bits", u32::MAX)))?;
        let ties = super::shape(self.shape).map(|shape| (shape.amount)(self.settings)).unwrap_or_default();
        let missing = |why: String| Error::Limit(format!("shape `{}`: {why}; ask for fewer", self.shape));
        Amount { particles: count as f64, ..ties }.fits().map_err(missing)?;
        Ok((count, State::with_room(count).map_err(|why| missing(why.to_string()))?))
    }

    /// Checks whether this many particles are allowed: used before memory is allocated for an unknown number.
    pub fn fits(&self, count: f64) -> Result<(), Error> {
        if count <= f64::from(MOST) {
            let missing = |why: String| Error::Limit(format!("shape `{}`: {why}; ask for fewer", self.shape));
            return Amount::of(count).fits().map_err(missing);
        }
        Err(Error::Limit(format!(
            "shape `{}`: that is {count:.0} particles, and the maximum is {MOST}: choose a larger spacing or a smaller size",
            self.shape
        )))
    }

    /// The same particles, if all numbers are finite, and the settings are those of the shape.
    pub fn finished(&self, particles: State) -> Result<State, Error> {
        self.named()?;
        let finite = particles.position().iter().chain(particles.velocity()).all(|v| v.is_finite())
            && particles.mass().iter().all(|m| m.is_finite());
        if finite {
            Ok(particles)
        } else {
            Err(self.error("these numbers are too far apart: a position or velocity leaves the range of f64"))
        }
    }
}

impl State {
    /// Mean position and velocity, weighted by mass; by number where all masses are zero.
    pub(super) fn center(&self) -> (DVec3, DVec3) {
        let total: f64 = self.mass().iter().sum();
        let massless = total <= 0.0;
        let (mut position, mut velocity, mut weight) = (DVec3::ZERO, DVec3::ZERO, 0.0);
        for ((x, v), m) in self.position().iter().zip(self.velocity()).zip(self.mass()) {
            let w = if massless { 1.0 } else { *m };
            position += *x * w;
            velocity += *v * w;
            weight += w;
        }
        if weight > 0.0 { (position / weight, velocity / weight) } else { (DVec3::ZERO, DVec3::ZERO) }
    }

    /// Moves all particles, so that the centre of mass is at `center` and has the velocity `velocity`.
    pub(super) fn centered(mut self, center: DVec3, velocity: DVec3) -> Self {
        let (x, v) = self.center();
        for position in self.position_mut() {
            *position = *position - x + center;
        }
        for speed in self.velocity_mut() {
            *speed = *speed - v + velocity;
        }
        self
    }
}
