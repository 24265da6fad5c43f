//! Charges, with a dielectric continuum beyond the cut-off radius, or with all images of a periodic box.

use std::borrow::Cow;

use glam::{DVec3, DVec4};

use super::born_mayer::charge;
use super::{
    Component, EXCLUDE, Law, Over, Problem, Properties, SEE_NEAR, SKIN, Stage, check_exclude, evaluate, excluding, numbered, over, params,
};
use crate::error::Error;
use crate::ewald::Charges;
use crate::kernel::{Bounds, Column, Kind as Element, Plan, Scalar, Source, World};
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit::Particle;

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::required("range", Kind::Positive, "the cut-off radius R, where the energy ends [length]"),
    Key::new("coulomb", Kind::NotNegative, Value::Number(1.0), "Coulomb's constant k, 1 / 4π ε₀ [energy length / charge²]"),
    Key::new(
        "permittivity",
        Kind::NotNegative,
        Value::Number(0.0),
        "the relative permittivity ε of the continuum beyond R, such as 78.5 for water; 1: none, the energy is shifted only; 0: a conductor",
    ),
    Key::new(
        "images",
        Kind::Choice(&["nearest", "ewald"]),
        Value::Text(Cow::Borrowed("nearest")),
        "in a periodic box: nearest images up to `range`, or Ewald sums over all images, in a conductor, of which the law between two ends at `range` (Ewald 1921)",
    ),
    Key::new(
        "accuracy",
        Kind::Positive,
        Value::Number(1e-4),
        "with images = \"ewald\": the error of the force between two charges, root mean square over a cube of side 2 R, 1e-10 to 0.1; rounding on a device adds some 1e-6 [k q q' / R²]",
    ),
    SEE_NEAR,
    SKIN,
    EXCLUDE,
];

/// `coulomb`: U = k q q' (1 / r + A r² − B) up to the range R, by the reaction field of a continuum beyond it: A = (ε − 1) / ((2 ε + 1) R³),
/// B = 1 / R + A R², so that U ends at 0; in a conductor the force does, too (Barker & Watts, Mol. Phys. 26, 789, 1973; Tironi et al.,
/// J. Chem. Phys. 102, 5451, 1995); or by sums over all images of a periodic box (Ewald, Ann. Phys. 369, 253, 1921). Pairs that `exclude` leaves out have none of it, and charges no energy of their own.
#[derive(Clone)]
pub struct Coulomb(Settings);

impl Coulomb {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for Coulomb {
    fn columns(&self) -> Vec<Column> {
        vec![Column::new("charge", Element::Scalar, "charge", "its charge, with sign")]
    }
    fn properties(&self) -> Properties {
        let sums = self.sums().is_some();
        Properties { neutralized: sums.then_some("charge"), has_waves: sums, ..Properties::default() }
    }
    fn check(&self, bounds: &Bounds) -> Result<(), Error> {
        let permittivity = self.0.number("permittivity");
        if permittivity > 0.0 && permittivity < 1.0 {
            let why = format!("permittivity = {permittivity}: that of a vacuum is 1, and 0 stands for a conductor");
            return Err(Error::Setting { key: "permittivity", why });
        }
        if let Some(sums) = self.sums() {
            if permittivity > 0.0 {
                let why = format!("permittivity = {permittivity} beside images = \"ewald\": the sum is that in a conductor; leave it out");
                return Err(Error::Setting { key: "permittivity", why });
            }
            sums.check(self.0.number("accuracy"), bounds, None)?;
        }
        check_exclude(&self.0)
    }
    fn laws(&self) -> Vec<Law> {
        let law = match self.sums() {
            Some(sums) => ewald(&sums, over(&self.0, None)),
            None => self.reaction_field(),
        };
        vec![excluding(&self.0, Law { reciprocal: true, ..law })]
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        let (kernels, earlier) = match (stage, self.sums()) {
            (Stage::Evaluate { earlier }, sums) => {
                evaluate(self.laws(), earlier, plan, problem)?;
                let Some(sums) = sums else { return Ok(()) };
                sums.check(self.0.number("accuracy"), &problem.bounds, problem.elastic)?;
                (sums.kernels(&between(), problem, earlier)?, earlier)
            }
            (Stage::Virial { earlier }, Some(sums)) => (sums.virial(&between(), problem, earlier)?, earlier),
            _ => return Ok(()),
        };
        kernels.into_iter().try_for_each(|kernel| plan.push(&numbered(&kernel.name.clone(), earlier), || Ok(kernel)))
    }
}

impl Coulomb {
    /// The sums over all images, where there are any.
    fn sums(&self) -> Option<Charges> {
        let [range, constant, accuracy] = ["range", "coulomb", "accuracy"].map(|key| self.0.number(key));
        let exclude = u32::try_from(self.0.whole("exclude")).unwrap_or(u32::MAX);
        (self.0.text("images") == "ewald").then(|| Charges::new(constant, range, accuracy, exclude))
    }
    fn reaction_field(&self) -> Law {
        let [range, constant, permittivity] = ["range", "coulomb", "permittivity"].map(|key| self.0.number(key));
        let part = if permittivity > 0.0 { (permittivity - 1.0) / 2.0f64.mul_add(permittivity, 1.0) } else { 0.5 };
        let growth = part / range.powi(3);
        let shift = 1.0 / range + growth * range * range;
        let mut values = params(&self.0, &["coulomb"]);
        for (name, value) in [("growth", growth), ("shift", shift)] {
            values.push((name.to_owned(), Scalar::Float(value)));
        }
        let gather = move |me: &Particle, you: &Particle, r: DVec3, sum: &mut DVec4| {
            let (charges, distance) = (constant * charge(me) * charge(you), r.length());
            let slope = 2.0 * growth * distance - distance.powi(-2);
            let value = 1.0 / distance + growth * distance * distance - shift;
            *sum += charges * (r * (slope / distance)).extend(value);
        };
        let wgsl = crate::shader!("interactions/coulomb.wgsl");
        Law::gathering("coulomb", over(&self.0, None), wgsl, values, gather, per_mass)
    }
}

/// The law between two of sums over all images.
fn ewald(sums: &Charges, over: Over) -> Law {
    let pair = sums.clone();
    let gather = move |me: &Particle, you: &Particle, r: DVec3, sum: &mut DVec4| {
        let distance = r.length();
        let [value, slope] = pair.pair(distance).map(|x| pair.constant * charge(me) * charge(you) * x);
        *sum += (r * (slope / distance)).extend(value);
    };
    let law = Law::gathering("coulomb", over, between(), sums.params(), gather, per_mass);
    Law { constants: sums.constants(), ..law }
}

fn between() -> Source {
    crate::shader!("interactions/coulomb_ewald.wgsl")
}

/// A particle without mass is moved by nothing.
fn per_mass(me: &Particle, sum: &DVec4, _: &World) -> DVec4 {
    if me.mass > 0.0 { *sum / me.mass } else { DVec4::ZERO }
}
