//! Lennard-Jones atoms.

use std::borrow::Cow;

use super::pair_potential::{Energy, Mixing, ONSET, PAIRS, RANGE, TRUNCATION, factor, law, length, rows, tails};
use super::{Component, EXCLUDE, Law, SEE_NEAR, SKIN, check_exclude, excluding, over};
use crate::component::Tail;
use crate::error::Error;
use crate::kernel::Bounds;
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("epsilon", Kind::NotNegative, Value::Number(1.0), "ε, the depth of the well [energy]"),
    Key::new("sigma", Kind::Positive, Value::Number(1.0), "σ, the distance at which the energy is 0 [length]"),
    RANGE,
    TRUNCATION,
    ONSET,
    Key::new("pairs", Kind::Pairs(COEFFICIENTS), Value::Pairs(Vec::new()), PAIRS),
    MIXING,
    SEE_NEAR,
    SKIN,
    EXCLUDE,
];

/// The coefficients of pairs that are not given.
pub(super) const MIXING: Key = Key::new(
    "mixing",
    Kind::Choice(&["lorentz_berthelot", "geometric", "none"]),
    Value::Text(Cow::Borrowed("lorentz_berthelot")),
    "the coefficients of two species of which `pairs` has each, and not both together: ε = √(ε₁ ε₂) with σ = (σ₁ + σ₂) / 2 or √(σ₁ σ₂); none: all pairs are given",
);

/// What a scene may say of a pair of species.
const COEFFICIENTS: &[Key] =
    &[factor("epsilon", "ε of the pair, in units of `epsilon`"), length("sigma", "σ of the pair, in units of `sigma`")];

/// `lennard_jones`: U = 4 ε [(σ / r)¹² − (σ / r)⁶] up to the range (Lennard-Jones, Proc. Phys. Soc. 43, 461, 1931).
#[derive(Clone)]
pub struct LennardJones(Settings);

impl LennardJones {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

/// Lorentz, Ann. Phys. 248, 127, 1881; Berthelot, C. R. Acad. Sci. 126, 1703, 1898.
fn lorentz_berthelot(a: &[f64], b: &[f64]) -> Vec<f64> {
    vec![(a[0] * b[0]).sqrt(), 0.5 * (a[1] + b[1])]
}

fn geometric(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| (a * b).sqrt()).collect()
}

/// The rule that settings name.
pub(super) fn mixing(settings: &Settings) -> Option<Mixing> {
    match settings.text("mixing") {
        "lorentz_berthelot" => Some(lorentz_berthelot),
        "geometric" => Some(geometric),
        _ => None,
    }
}

/// 4 ε [(σ / r)¹² − (σ / r)⁶]
pub(super) fn energy(coefficients: &[f64], r: f64) -> Energy {
    let (epsilon, sixth) = (coefficients[0], (coefficients[1] / r).powi(6));
    Energy { value: 4.0 * epsilon * sixth * (sixth - 1.0), slope: 24.0 * epsilon * sixth * (1.0 - 2.0 * sixth) / r }
}

impl Component for LennardJones {
    fn tails(&self) -> Vec<Tail> {
        tails(&self.0, &rows(&self.0, &["epsilon", "sigma"], mixing(&self.0)), energy)
    }
    fn check(&self, _: &Bounds) -> Result<(), Error> {
        check_exclude(&self.0)
    }
    fn laws(&self) -> Vec<Law> {
        let names = ["epsilon", "sigma"];
        let file = ("lennard_jones", crate::shader!("interactions/lennard_jones.wgsl"));
        vec![excluding(&self.0, law(file, &self.0, over(&self.0, None), &names, &rows(&self.0, &names, mixing(&self.0)), energy))]
    }
}
