//! Atoms that only repel each other.

use std::f64::consts::SQRT_2;

use super::pair_potential::{Energy, PAIRS, Row, central, factor, length, rows};
use super::{Component, EXCLUDE, Law, SEE_NEAR, SKIN, check_exclude, excluding, lennard_jones, over};
use crate::error::Error;
use crate::kernel::{Bounds, Scalar};
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit::{PairRow, PairTable};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("epsilon", Kind::NotNegative, Value::Number(1.0), "ε, the energy at r = σ [energy]"),
    Key::new("sigma", Kind::Positive, Value::Number(1.0), "σ: atoms repel each other up to 2^(1/6) σ [length]"),
    Key::new("pairs", Kind::Pairs(COEFFICIENTS), Value::Pairs(Vec::new()), PAIRS),
    lennard_jones::MIXING,
    SEE_NEAR,
    SKIN,
    EXCLUDE,
];

/// What a scene may say of a pair of species.
const COEFFICIENTS: &[Key] =
    &[factor("epsilon", "ε of the pair, in units of `epsilon`"), length("sigma", "σ of the pair, in units of `sigma`")];

/// `wca`: the repulsive part of the Lennard-Jones energy, U = 4 ε [(σ / r)¹² − (σ / r)⁶] + ε up to its minimum (Weeks, Chandler &
/// Andersen, J. Chem. Phys. 54, 5237, 1971).
#[derive(Clone)]
pub struct Wca(Settings);

impl Wca {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

/// The distance of the least energy.
fn minimum(row: &Row) -> f64 {
    SQRT_2.cbrt() * row.values[1]
}

impl Component for Wca {
    fn check(&self, _: &Bounds) -> Result<(), Error> {
        check_exclude(&self.0)
    }
    fn laws(&self) -> Vec<Law> {
        let rows = rows(&self.0, &["epsilon", "sigma"], lennard_jones::mixing(&self.0));
        let range = rows.iter().map(minimum).fold(0.0, f64::max);
        let coefficients = |row: &Row| {
            let all = [("epsilon", row.values[0]), ("sigma", row.values[1]), ("range", minimum(row))];
            let values = all.map(|(name, x)| (name.to_owned(), Scalar::Float(x))).to_vec();
            PairRow { species: row.species, values }
        };
        let pairs = Some(PairTable { rows: rows.iter().map(coefficients).collect() });
        let over = over(&self.0.clone().with("range", range.into()), None);
        let file = ("wca", crate::shader!("interactions/wca.wgsl"));
        let law = central(file, over, Vec::new(), &rows, |row, r| {
            if r >= minimum(row) {
                return Energy::default();
            }
            let Energy { value, slope } = lennard_jones::energy(&row.values, r);
            Energy { value: value + row.values[0], slope }
        });
        vec![excluding(&self.0, Law { pairs, ..law })]
    }
}
