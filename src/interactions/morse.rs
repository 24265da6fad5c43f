//! Morse's energy of a bond.

use super::pair_potential::{Energy, ONSET, PAIRS, RANGE, TRUNCATION, factor, law, length, rows, tails};
use super::{Component, EXCLUDE, Law, SEE_NEAR, SKIN, check_exclude, excluding, over};
use crate::component::Tail;
use crate::error::Error;
use crate::kernel::Bounds;
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("depth", Kind::NotNegative, Value::Number(1.0), "D, the depth of the well [energy]"),
    Key::new("steepness", Kind::Positive, Value::Number(5.0), "α of exp(−α (r − r₀)) [1 / length]"),
    Key::new("distance", Kind::Positive, Value::Number(1.0), "r₀, where the energy is least [length]"),
    RANGE,
    TRUNCATION,
    ONSET,
    Key::new("pairs", Kind::Pairs(COEFFICIENTS), Value::Pairs(Vec::new()), PAIRS),
    SEE_NEAR,
    SKIN,
    EXCLUDE,
];

/// What a scene may say of a pair of species.
const COEFFICIENTS: &[Key] = &[
    factor("depth", "D of the pair, in units of `depth`"),
    length("steepness", "α of the pair, in units of `steepness`"),
    length("distance", "r₀ of the pair, in units of `distance`"),
];

/// The coefficients of the law.
const NAMES: [&str; 3] = ["depth", "steepness", "distance"];

/// `morse`: U = D [exp(−2 α (r − r₀)) − 2 exp(−α (r − r₀))] up to the range (Morse, Phys. Rev. 34, 57, 1929).
#[derive(Clone)]
pub struct Morse(Settings);

impl Morse {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

/// D (e² − 2 e), with e = exp(−α (r − r₀))
fn energy(coefficients: &[f64], r: f64) -> Energy {
    let [depth, steepness, distance] = [0, 1, 2].map(|k| coefficients[k]);
    let e = (-steepness * (r - distance)).exp();
    Energy { value: depth * e * (e - 2.0), slope: 2.0 * depth * steepness * e * (1.0 - e) }
}

impl Component for Morse {
    fn tails(&self) -> Vec<Tail> {
        tails(&self.0, &rows(&self.0, &NAMES, None), energy)
    }
    fn check(&self, _: &Bounds) -> Result<(), Error> {
        check_exclude(&self.0)
    }
    fn laws(&self) -> Vec<Law> {
        let file = ("morse", crate::shader!("interactions/morse.wgsl"));
        vec![excluding(&self.0, law(file, &self.0, over(&self.0, None), &NAMES, &rows(&self.0, &NAMES, None), energy))]
    }
}
