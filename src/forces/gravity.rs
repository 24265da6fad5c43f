//! Newton's law of gravity, softened.

use std::borrow::Cow;

use glam::{DVec3, DVec4};

use super::{Force, Law, params};
use crate::settings::{Key, Kind, Settings, Value};

/// What a scene may say.
pub const KEYS: &[Key] = &[
    Key::new("g", Kind::Number, Value::Number(1.0), "the gravitational constant [length³ / mass / time²]"),
    Key::new("softening", Kind::NotNegative, Value::Number(0.0), "the Plummer softening ε; the spline ends at 2.8 ε, so for PKDGRAV's own ε (which ends at 2 ε) say 2/2.8 of it [length]"),
    Key::new("kernel", Kind::Choice(&["plummer", "spline"]), Value::Text(Cow::Borrowed("plummer")), "how close encounters are softened"),
    Key::new("over", Kind::Choice(&["pairs"]), Value::Text(Cow::Borrowed("pairs")), "who meets whom: everybody"),
];

/// `gravity`: a = G m r / (r² + ε²)^(3/2), or the spline of GADGET, which is exact beyond 2.8 ε
/// (PKDGRAV has the same spline, and calls half of its support ε).
pub struct Gravity(Settings);

impl Gravity {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Force for Gravity {
    fn laws(&self) -> Vec<Law> {
        let values = params(&self.0, &["g", "softening"]);
        let (g, softening) = (self.0.number("g"), self.0.number("softening"));
        vec![if self.0.text("kernel") == "spline" {
            let h = 2.8 * softening;
            Law::pairs("gravity_spline", crate::shader!("forces/gravity_spline.wgsl"), values, move |_, you, r| {
                spline(g * you.mass, h, r)
            })
        } else {
            Law::pairs("gravity", crate::shader!("forces/gravity.wgsl"), values, move |_, you, r| {
                plummer(g * you.mass, softening, r)
            })
        }]
    }
}

/// Plummer (1911).
fn plummer(gm: f64, softening: f64, r: DVec3) -> DVec4 {
    let inverse = 1.0 / (r.length_squared() + softening * softening).sqrt();
    let potential = gm * inverse;
    (r * (potential * inverse * inverse)).extend(-potential)
}

/// The potential of a cubic spline of support h (Monaghan & Lattanzio 1985; Springel, Yoshida & White 2001, appendix A).
fn spline(gm: f64, h: f64, r: DVec3) -> DVec4 {
    let distance = r.length();
    if distance >= h {
        return (r * (gm / distance.powi(3))).extend(-gm / distance);
    }
    let u = distance / h;
    let (force, potential) = if u < 0.5 {
        (
            32.0 / 3.0 + u * u * (32.0 * u - 38.4),
            -2.8 + u * u * (16.0 / 3.0 + u * u * (6.4 * u - 9.6)),
        )
    } else {
        (
            64.0 / 3.0 + u * (-48.0 + u * (38.4 - 32.0 / 3.0 * u)) - 1.0 / (15.0 * u.powi(3)),
            -3.2 + 1.0 / (15.0 * u) + u * u * (32.0 / 3.0 + u * (-16.0 + u * (9.6 - 32.0 / 15.0 * u))),
        )
    };
    (r * (gm * force / h.powi(3))).extend(gm * potential / h)
}
