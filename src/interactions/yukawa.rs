//! Screened charges.

use super::pair_potential::{Energy, ONSET, PAIRS, RANGE, TRUNCATION, factor, law, rows, tails};
use super::{Component, EXCLUDE, Law, SEE_NEAR, SKIN, check_exclude, excluding, over};
use crate::component::Tail;
use crate::error::Error;
use crate::kernel::Bounds;
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("strength", Kind::Number, Value::Number(1.0), "A of A exp(−κ r) / r; below 0 particles attract each other [energy length]"),
    Key::new("screening", Kind::NotNegative, Value::Number(1.0), "κ, one over the screening length [1 / length]"),
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
    Key::new("strength", Kind::Number, Value::Number(1.0), "A of the pair, in units of `strength`"),
    factor("screening", "κ of the pair, in units of `screening`"),
];

/// The coefficients of the law.
const NAMES: [&str; 2] = ["strength", "screening"];

/// `yukawa`: U = A exp(−κ r) / r up to the range (Debye & Hückel, Phys. Z. 24, 185, 1923; Yukawa, Proc. Phys.-Math. Soc. Japan 17, 48,
/// 1935).
#[derive(Clone)]
pub struct Yukawa(Settings);

impl Yukawa {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

/// A exp(−κ r) / r
fn energy(coefficients: &[f64], r: f64) -> Energy {
    let value = coefficients[0] * (-coefficients[1] * r).exp() / r;
    Energy { value, slope: -value * (coefficients[1] + 1.0 / r) }
}

impl Component for Yukawa {
    fn tails(&self) -> Vec<Tail> {
        tails(&self.0, &rows(&self.0, &NAMES, None), energy)
    }
    fn check(&self, _: &Bounds) -> Result<(), Error> {
        check_exclude(&self.0)
    }
    fn laws(&self) -> Vec<Law> {
        let file = ("yukawa", crate::shader!("interactions/yukawa.wgsl"));
        vec![excluding(&self.0, law(file, &self.0, over(&self.0, None), &NAMES, &rows(&self.0, &NAMES, None), energy))]
    }
}
