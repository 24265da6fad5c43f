//! Ions: repulsion and dispersion with coefficients per pair of species, and damped Coulomb forces.

use std::f64::consts::PI;

use glam::{DVec3, DVec4};

use super::{Component, Law, SEE_NEAR, SKIN, over, params};
use crate::kernel::{Column, Kind as Element, Scalar};
use crate::settings::{Key, Kind, Pair, Settings, Value};
use crate::visit::{PairTable, Particle};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::required("pairs", Kind::Pairs(COEFFICIENTS), "the coefficients of each pair of species, as in [{ species = [0, 1], repulsion = 1.0, decay = 0.3 }]"),
    Key::required("range", Kind::Positive, "the cut-off radius, where energy and force end [length]"),
    Key::new("coulomb", Kind::NotNegative, Value::Number(1.0), "Coulomb's constant, 1 / 4π ε₀ [energy length / charge²]"),
    Key::new("damping", Kind::NotNegative, Value::Number(0.2), "α: the Coulomb energy is erfc(α r) / r; 0: shifted only [1 / length]"),
    SEE_NEAR,
    SKIN,
];

/// The coefficients of a pair of species.
const COEFFICIENTS: &[Key] = &[
    Key::required("repulsion", Kind::NotNegative, "A of A exp(−r / ρ) [energy]"),
    Key::required("decay", Kind::Positive, "ρ of A exp(−r / ρ) [length]"),
    Key::new("dispersion", Kind::NotNegative, Value::Number(0.0), "C of −C / r⁶ [energy length⁶]"),
    Key::new("dispersion_8", Kind::NotNegative, Value::Number(0.0), "D of −D / r⁸ [energy length⁸]"),
];

/// `born_mayer`: U = A exp(−r / ρ) − C / r⁶ − D / r⁸ + k q q' erfc(α r) / r, shifted so that energy and force end at the range
/// (Born & Mayer, Z. Phys. 75, 1, 1932; Huggins & Mayer, J. Chem. Phys. 1, 643, 1933; Fennell & Gezelter, J. Chem. Phys. 124,
/// 234104, 2006). The potential energy holds the self-energy of each charge in the neutral sphere about it, so that a crystal has
/// its Madelung energy.
#[derive(Clone)]
pub struct BornMayer(Settings);

/// An energy, and its slope along the distance.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Energy {
    value: f64,
    slope: f64,
}

/// The coefficients of a pair of species.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Coefficients {
    repulsion: f64,
    decay: f64,
    dispersion: f64,
    dispersion_8: f64,
}

impl BornMayer {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Coefficients {
    fn of(pair: &Pair) -> Self {
        let [repulsion, decay, dispersion, dispersion_8] =
            ["repulsion", "decay", "dispersion", "dispersion_8"].map(|name| pair.number(name));
        Self { repulsion, decay, dispersion, dispersion_8 }
    }
    /// A exp(−r / ρ) − C / r⁶ − D / r⁸
    fn energy(&self, r: f64) -> Energy {
        let repulsion = self.repulsion * (-r / self.decay).exp();
        let (sixth, eighth) = (self.dispersion / r.powi(6), self.dispersion_8 / r.powi(8));
        Energy {
            value: repulsion - sixth - eighth,
            slope: (6.0 * sixth + 8.0 * eighth) / r - repulsion / self.decay,
        }
    }
}

/// erfc(α r) / r
fn coulomb(damping: f64, r: f64) -> Energy {
    let x = damping * r;
    let (value, width) = (erfc(x) / r, 2.0 * damping / PI.sqrt());
    Energy { value, slope: -(value + width * (-x * x).exp()) / r }
}

/// The complementary error function, to the last digits of 1: erf(x) = 2 / √π exp(−x²) Σ 2ⁿ x²ⁿ⁺¹ / (2n + 1)!!
fn erfc(x: f64) -> f64 {
    if x > 6.0 {
        return 0.0;
    }
    let (mut term, mut sum, mut odd) = (x, x, 1.0);
    while term > 1e-17 * sum {
        odd += 2.0;
        term *= 2.0 * x * x / odd;
        sum += term;
    }
    1.0 - 2.0 / PI.sqrt() * (-x * x).exp() * sum
}

impl Component for BornMayer {
    fn columns(&self) -> Vec<Column> {
        vec![Column::new("charge", Element::Scalar, "charge", "its charge, with sign")]
    }
    fn laws(&self) -> Vec<Law> {
        let [range, constant, damping] = ["range", "coulomb", "damping"].map(|name| self.0.number(name));
        let end = coulomb(damping, range);
        // The self-energy of a charge: the limit of the damped and shifted energy less 1 / r, for r → 0.
        let own = constant * (range * end.slope - end.value - 2.0 * damping / PI.sqrt());
        let mut values = params(&self.0, &["coulomb", "damping", "range"]);
        for (name, value) in [("end_value", end.value), ("end_slope", end.slope), ("own", own)] {
            values.push((name.to_owned(), Scalar::Float(value)));
        }
        // The values of each pair of species at the range.
        let pairs = self.0.pairs("pairs");
        let mut table = PairTable::from(pairs);
        for (row, pair) in table.rows.iter_mut().zip(pairs) {
            let end = Coefficients::of(pair).energy(range);
            row.values.push(("end_value".to_owned(), Scalar::Float(end.value)));
            row.values.push(("end_slope".to_owned(), Scalar::Float(end.slope)));
        }
        let coefficients: Vec<_> = pairs.iter().map(|pair| (pair.species, Coefficients::of(pair))).collect();
        let gather = move |me: &Particle, you: &Particle, r: DVec3, sum: &mut DVec4| {
            let pair = [me.species(), you.species()];
            let charges = constant * charge(me) * charge(you);
            let distance = r.length();
            let of = coefficients.iter().find(|(species, _)| *species == pair || *species == [pair[1], pair[0]]);
            let mut add = |strength: f64, here: Energy, end: Energy| {
                let value = here.value - end.value - (distance - range) * end.slope;
                *sum += strength * (r * ((here.slope - end.slope) / distance)).extend(value);
            };
            add(charges, coulomb(damping, distance), end);
            if let Some((_, of)) = of {
                add(1.0, of.energy(distance), of.energy(range));
            }
        };
        let finish = move |me: &Particle, sum: &DVec4, _: &crate::kernel::World| {
            let all = *sum + DVec4::W * (own * charge(me) * charge(me));
            if me.mass > 0.0 { all / me.mass } else { DVec4::ZERO }
        };
        let wgsl = crate::shader!("interactions/born_mayer.wgsl");
        let law = Law::gathering("born_mayer", over(&self.0, None), wgsl, values, gather, finish);
        vec![Law { pairs: Some(table), reciprocal: true, ..law }]
    }
}

/// Its charge; 0 where there is no such column.
pub(super) fn charge(particle: &Particle) -> f64 {
    particle.scalar("charge").unwrap_or(0.0)
}
