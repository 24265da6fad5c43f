//! The method of Gauß and Radau of order 15 (Everhart 1985; IAS15 of Rein & Spiegel 2015 is a variant of it): the acceleration along a step
//! is a polynomial through its values at eight times, the start and the seven nodes h of Radau's quadrature,
//!
//! a(h) = a₀ + h (g₁ + (h − h₁) (g₂ + (h − h₂) (g₃ + …))),
//!
//! whose divided differences g follow from the accelerations at the nodes, where positions follow from the polynomial. This is iterated until
//! g₇ settles; the first guess is the polynomial of the step before it. Two integrals give the end of the step. In adaptive steps the length is
//! such that |g₇| / |a| is ε, each the largest of any particle; a step that is four times too long is tried again.
//!
//! Differences from IAS15: divided differences are kept in place of powers, prediction is the polynomial alone, ε is 1e-5 where it has 1e-9
//! (the last term enters velocities by 1 / 4032, and the error of the method is that of the next ones), and what rounding of accelerations
//! makes of g₇ is no error.

use super::verbs::radau;
use super::{Integrator, Step};
use crate::kernel::{Column, Kind, Shape};
use crate::settings::{Key, Kind as Value, Settings, Value as Default};

/// The keys in a scene.
pub const KEYS: &[Key] = &[Key::new(
    "tolerance",
    Value::Fraction,
    Default::Number(1e-5),
    "ε of adaptive steps by gauss_radau: the last coefficient of the accelerations over the largest one",
)];

/// `gauss_radau`
#[derive(Clone)]
pub struct GaussRadau(f64);

impl GaussRadau {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.number("tolerance"))
    }
}

impl Integrator for GaussRadau {
    fn name(&self) -> &'static str {
        "gauss_radau"
    }
    fn order(&self) -> u32 {
        15
    }
    fn order_with_velocity(&self) -> u32 {
        15
    }
    fn estimates_error(&self) -> bool {
        true
    }
    fn advances_columns(&self) -> bool {
        false
    }
    fn columns(&self) -> Vec<Column> {
        let differences = "the divided differences of the accelerations along the last step";
        let step = "the length of the last step, 1 if it was accepted, the number of steps in a longest one; how many steps did not settle or were tried again, and the first";
        vec![
            Column::new(radau::DIFFERENCES.name, Kind::Vector, "length / time²", differences)
                .shaped(Shape::Slots(radau::polynomial::NODES)),
            Column::new(radau::STEP.name, Kind::Scalar, "", step).shaped(Shape::System(radau::STEP_WORDS)),
        ]
    }
    fn step(&self, s: &mut Step) {
        s.evaluate();
        s.along_nodes();
        s.accept(self.0);
    }
}
