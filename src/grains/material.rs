//! The material of a contact, from settings, and that of two different materials.

use std::borrow::Cow;
use std::f64::consts::PI;

use crate::error::Error;
use crate::kernel::Scalar;
use crate::settings::{Key, Kind, Settings, Value};

pub(crate) const MODEL: Key = Key::new(
    "model",
    Kind::Choice(&["linear", "hertz"]),
    Value::Text(Cow::Borrowed("linear")),
    "the force of an overlap: proportional to it, or by Hertz and Mindlin",
);
pub(crate) const STIFFNESS: Key = Key::new(
    "stiffness",
    Kind::Positive,
    Value::Number(1000.0),
    "linear: k, the normal force per overlap [mass / time²]",
);
pub(crate) const YOUNG: Key = Key::new(
    "young_modulus",
    Kind::Positive,
    Value::Number(1e7),
    "hertz: Young's modulus of both bodies [mass / length / time²]",
);
pub(crate) const POISSON: Key = Key::new(
    "poisson_ratio",
    Kind::NotNegative,
    Value::Number(0.25),
    "hertz: Poisson's ratio of both bodies, 0.5 at most",
);
pub(crate) const RESTITUTION: Key = Key::new(
    "restitution",
    Kind::Fraction,
    Value::Number(0.8),
    "the coefficient of restitution: the speed after a head-on impact over that before",
);
pub(crate) const FRICTION: Key = Key::new(
    "friction",
    Kind::NotNegative,
    Value::Number(0.5),
    "the friction coefficient μ: a contact slides where the tangential force would exceed μ times the normal force",
);
pub(crate) const TANGENTIAL_STIFFNESS: Key = Key::new(
    "tangential_stiffness",
    Kind::NotNegative,
    Value::Number(2.0 / 7.0),
    "linear: the tangential stiffness, relative to the normal one",
);
pub(crate) const TANGENTIAL_DAMPING: Key = Key::new(
    "tangential_damping",
    Kind::NotNegative,
    Value::Number(0.5),
    "the tangential damping, relative to the normal one; hertz: also times the root of the ratio of stiffnesses",
);
pub(crate) const ROLLING: Key = Key::new(
    "rolling_friction",
    Kind::NotNegative,
    Value::Number(0.0),
    "the coefficient of rolling friction μᵣ: the largest torque against rolling, relative to the normal force times the reduced radius",
);
pub(crate) const ROLLING_MODEL: Key = Key::new(
    "rolling_model",
    Kind::Choice(&["elastic_plastic", "constant"]),
    Value::Text(Cow::Borrowed("elastic_plastic")),
    "rolling friction by a spring and a dashpot up to that torque, which piles at rest require, or always of that size",
);
pub(crate) const ROLLING_DAMPING: Key = Key::new(
    "rolling_damping",
    Kind::NotNegative,
    Value::Number(0.3),
    "elastic_plastic: the damping of rolling, relative to the critical one",
);
pub(crate) const TORSION: Key = Key::new(
    "torsional_friction",
    Kind::NotNegative,
    Value::Number(0.0),
    "the coefficient of torsional friction: the largest torque about the normal, relative to the normal force times the reduced radius",
);
pub(crate) const SURFACE_TENSION: Key = Key::new(
    "surface_tension",
    Kind::NotNegative,
    Value::Number(0.0),
    "the surface tension γ of liquid that bridges grains from where they touch until they are too far apart; 0: dry [mass / time²]",
);
pub(crate) const CONTACT_ANGLE: Key = Key::new(
    "contact_angle",
    Kind::NotNegative,
    Value::Number(0.0),
    "the angle θ at which liquid meets grains [radians]",
);
pub(crate) const BRIDGE_VOLUME: Key = Key::new(
    "bridge_volume",
    Kind::Positive,
    Value::Number(0.01),
    "the volume V of each bridge, relative to the cube of the smaller radius: a bridge breaks (1 + θ / 2) V^(1/3) apart",
);
pub(crate) const PAIRS: Key = Key::new(
    "pairs",
    Kind::Pairs(FACTORS),
    Value::Pairs(Vec::new()),
    "factors for pairs of species, as in [{ species = [0, 1], friction = 0.5 }], by which the values above are multiplied; of two species with values of their own, the pair has both as springs in series, and geometric means of all coefficients; none: all species are alike",
);

/// What a scene may say of a pair of species.
const FACTORS: &[Key] = &[
    factor("stiffness", Kind::Positive),
    factor("young_modulus", Kind::Positive),
    factor("poisson_ratio", Kind::NotNegative),
    factor("restitution", Kind::Positive),
    factor("friction", Kind::NotNegative),
    factor("rolling_friction", Kind::NotNegative),
    factor("torsional_friction", Kind::NotNegative),
    factor("surface_tension", Kind::NotNegative),
];

const fn factor(name: &'static str, kind: Kind) -> Key {
    Key::new(name, kind, Value::Number(1.0), "that of the pair, in units of the value of all")
}

/// Values by pair of species, in the order of the factors of [`PAIRS`].
pub(crate) const NAMES: [&str; 8] = [
    "stiffness",
    "young_modulus",
    "poisson_ratio",
    "restitution",
    "friction",
    "rolling_friction",
    "torsional_friction",
    "surface_tension",
];

/// The law of the normal force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Model {
    /// N = k δ.
    Linear,
    /// N = 4/3 E √R δ^(3/2).
    Hertz,
}

/// The parameters of a contact: those of `Pair` in `shaders/grains/touch.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// The law of the normal force.
    pub model: Model,
    /// S over √(R δ) by Hertz, otherwise S: the slope of the normal force by the overlap.
    pub stiffness: f64,
    /// The normal damping over √(S m).
    pub damping: f64,
    /// μ.
    pub friction: f64,
    /// The tangential stiffness over S.
    pub shear: f64,
    /// The tangential damping over the normal one.
    pub drag: f64,
    /// μᵣ.
    pub rolling: f64,
    /// The damping of rolling, relative to the critical one.
    pub rolling_damping: f64,
    /// Whether a spring resists rolling, in place of a constant torque.
    pub elastic: bool,
    /// μₜ.
    pub torsion: f64,
    /// 2 π γ cos θ: the pull of a bridge of liquid over R \[mass / time²\].
    pub pull: f64,
    /// √V over r^(3/2), with the smaller radius r.
    pub spread: f64,
    /// The distance at which a bridge breaks over r; 0 where there is none.
    pub reach: f64,
}

/// The elastic constants (E, ν) of a body with which two like ones touch as these two do: 1 / E* = Σ (1 − ν²) / E and
/// 1 / G* = Σ 2 (2 − ν)(1 + ν) / E are the same.
fn joined([e, nu]: [f64; 2], [other_e, other_nu]: [f64; 2]) -> [f64; 2] {
    let normal = |e: f64, nu: f64| (1.0 - nu * nu) / e;
    let shear = |e: f64, nu: f64| 2.0 * (2.0 - nu) * (1.0 + nu) / e;
    let both = normal(e, nu) + normal(other_e, other_nu);
    let ratio = 0.5 * (shear(e, nu) + shear(other_e, other_nu)) / both;
    let nu = (ratio - 2.0) / (ratio - 1.0);
    [2.0 * (1.0 - nu * nu) / both, nu]
}

/// The values of an unlike pair, in the order of [`NAMES`].
pub(crate) fn mixed(a: &[f64], b: &[f64]) -> Vec<f64> {
    let [young, poisson] = joined([a[1], a[2]], [b[1], b[2]]);
    let series = 2.0 * a[0] * b[0] / (a[0] + b[0]);
    let means = a[3..].iter().zip(&b[3..]).map(|(a, b)| (a * b).sqrt());
    [series, young, poisson].into_iter().chain(means).collect()
}

impl Material {
    /// From settings, and the values of a pair in the order of [`NAMES`].
    pub(crate) fn new(settings: &Settings, values: &[f64]) -> Self {
        let value = |name: &str| NAMES.iter().zip(values).find(|(known, _)| **known == name).map_or(0.0, |(_, x)| *x);
        let loss = -value("restitution").ln();
        let zeta = loss / PI.hypot(loss);
        let (young, nu) = (value("young_modulus"), value("poisson_ratio"));
        let drag = settings.number("tangential_damping");
        let model = if settings.text("model") == "hertz" { Model::Hertz } else { Model::Linear };
        let (stiffness, damping, shear, drag) = match model {
            Model::Linear => (value("stiffness"), 2.0 * zeta, settings.number("tangential_stiffness"), drag),
            Model::Hertz => {
                // 4 G* / E* of two like bodies.
                let shear = 2.0 * (1.0 - nu) / (2.0 - nu);
                (young / (1.0 - nu * nu), 2.0 * (5.0_f64 / 6.0).sqrt() * zeta, shear, drag * shear.sqrt())
            }
        };
        let (angle, volume) = (settings.number("contact_angle"), settings.number("bridge_volume"));
        let pull = 2.0 * PI * value("surface_tension") * angle.cos();
        Self {
            model,
            stiffness,
            damping,
            friction: value("friction"),
            shear,
            drag,
            rolling: value("rolling_friction"),
            rolling_damping: settings.number("rolling_damping"),
            elastic: settings.text("rolling_model") == "elastic_plastic",
            torsion: value("torsional_friction"),
            pull,
            spread: volume.sqrt(),
            reach: if pull > 0.0 { (1.0 + 0.5 * angle) * volume.cbrt() } else { 0.0 },
        }
    }
    /// Of settings without pairs.
    pub(crate) fn of(settings: &Settings) -> Self {
        Self::new(settings, &NAMES.map(|name| settings.number(name)))
    }
    /// The members of `Pair`, by name.
    pub(crate) fn members(&self) -> Vec<(String, Scalar)> {
        let numbers = [
            ("stiffness", self.stiffness),
            ("damping", self.damping),
            ("friction", self.friction),
            ("shear", self.shear),
            ("drag", self.drag),
            ("rolling", self.rolling),
            ("rolling_damping", self.rolling_damping),
            ("torsion", self.torsion),
            ("pull", self.pull),
            ("spread", self.spread),
            ("reach", self.reach),
        ];
        let flags = [("hertz", self.model == Model::Hertz), ("elastic", self.elastic)];
        let numbers = numbers.map(|(name, x)| (name.to_owned(), Scalar::Float(x)));
        numbers.into_iter().chain(flags.map(|(name, on)| (name.to_owned(), Scalar::Uint(u32::from(on))))).collect()
    }
    /// The words of history that it needs of those of [`Wound`](super::Wound): its last ones may be left out.
    #[must_use]
    pub fn words(&self) -> u32 {
        match (self.pull > 0.0, self.torsion > 0.0, self.rolling > 0.0 && self.elastic) {
            (true, ..) => 8,
            (false, true, _) => 7,
            (false, false, true) => 6,
            (false, false, false) => 3,
        }
    }
}

/// Refuses values that no material has.
///
/// # Errors
/// [`Error::Setting`] with the key.
pub(crate) fn check(settings: &Settings, values: &[f64]) -> Result<(), Error> {
    let angle = settings.number("contact_angle");
    let refuse = |key: &'static str, why: String| Err(Error::Setting { key, why });
    let (poisson, restitution) = (values[2], values[3]);
    if poisson > 0.5 {
        return refuse("poisson_ratio", format!("poisson_ratio is {poisson}: no elastic body has one above 0.5"));
    }
    if restitution > 1.0 {
        return refuse("restitution", format!("restitution is {restitution} for a pair: it is above 0, and 1 at most"));
    }
    if angle >= 0.5 * PI {
        return refuse(
            "contact_angle",
            format!("contact_angle is {angle}: liquid pulls where it is below π / 2, in radians"),
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A steel ball and a soft one: 1 / E* and 1 / G* of the mixed values are the sums of theirs.
    #[test]
    fn two_materials_are_springs_in_series() {
        let (a, b) = ([2e11, 0.3], [5e6, 0.45]);
        let [e, nu] = joined(a, b);
        let compliances = |[e, nu]: [f64; 2]| [(1.0 - nu * nu) / e, (2.0 - nu) * (1.0 + nu) / e];
        let (sum, first, second) = (compliances([e, nu]), compliances(a), compliances(b));
        for k in 0..2 {
            assert!((2.0 * sum[k] / (first[k] + second[k]) - 1.0).abs() < 1e-12, "{e} {nu}");
        }
        let [e, nu] = joined(a, a);
        assert!((e / a[0] - 1.0).abs() < 1e-12 && (nu - a[1]).abs() < 1e-12, "{e} {nu}");
    }
}
