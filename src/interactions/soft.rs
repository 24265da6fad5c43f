//! Soft spheres that may overlap.

use super::pair_potential::{Energy, PAIRS, RANGE, Row, central, factor, rows};
use super::{Component, EXCLUDE, Law, SEE_NEAR, SKIN, check_exclude, excluding, over, params};
use crate::error::Error;
use crate::kernel::{Bounds, Scalar};
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit::{PairRow, PairTable};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("strength", Kind::NotNegative, Value::Number(25.0), "a, the force at r = 0 [energy / length]"),
    RANGE,
    Key::new("pairs", Kind::Pairs(COEFFICIENTS), Value::Pairs(Vec::new()), PAIRS),
    SEE_NEAR,
    SKIN,
    EXCLUDE,
];

/// What a scene may say of a pair of species.
const COEFFICIENTS: &[Key] = &[factor("strength", "a of the pair, in units of `strength`")];

/// `soft`: U = a R (1 − r / R)² / 2 up to the range R, the conservative force of dissipative particle dynamics (Groot & Warren, J. Chem.
/// Phys. 107, 4423, 1997). Two at one place do not push each other.
#[derive(Clone)]
pub struct Soft(Settings);

impl Soft {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for Soft {
    fn check(&self, _: &Bounds) -> Result<(), Error> {
        check_exclude(&self.0)
    }
    fn laws(&self) -> Vec<Law> {
        let (rows, range) = (rows(&self.0, &["strength"], None), self.0.number("range"));
        let coefficients = |row: &Row| {
            let values = vec![("strength".to_owned(), Scalar::Float(row.values[0]))];
            PairRow { species: row.species, values }
        };
        let pairs = Some(PairTable { rows: rows.iter().map(coefficients).collect() });
        let file = ("soft", crate::shader!("interactions/soft.wgsl"));
        let law = central(file, over(&self.0, None), params(&self.0, &["range"]), &rows, move |row, r| {
            let (a, left) = (row.values[0], 1.0 - r / range);
            Energy { value: 0.5 * a * range * left * left, slope: -a * left }
        });
        vec![excluding(&self.0, Law { pairs, ..law })]
    }
}
