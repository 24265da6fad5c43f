//! A soft wall round a box.

use glam::{DVec3, DVec4};

use super::{Component, EACH, Law, SPECIES, params, species};
use crate::error::Error;
use crate::kernel::Bounds;
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("low", Kind::Vector, Value::Vector(DVec3::splat(-1.0)), "the lowest corner of the box [length]"),
    Key::new("high", Kind::Vector, Value::Vector(DVec3::ONE), "the highest corner [length]"),
    Key::new("margin", Kind::NotNegative, Value::Number(0.25), "the depth of the wall inside of the box; outside it is unlimited [length]"),
    Key::new("acceleration", Kind::NotNegative, Value::Number(2.0), "the acceleration of each side's wall [length / time²]"),
    SPECIES,
    EACH,
];

/// `soft_turn`: a particle near a side of the box is turned back by a constant acceleration; energy is kept. A wall that is
/// to hold a particle of speed v wants an acceleration of v² / 2 margin.
#[derive(Clone)]
pub struct SoftTurn(Settings);

impl SoftTurn {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for SoftTurn {
    fn check(&self, _: &Bounds) -> Result<(), Error> {
        let (low, high) = (self.0.vector("low"), self.0.vector("high"));
        match (0..3).find(|axis| low[*axis] > high[*axis]) {
            None => Ok(()),
            Some(axis) => {
                let (name, least, most) = (["x", "y", "z"][axis], low[axis], high[axis]);
                let why = format!("soft_turn has high = {most} along {name}, below low = {least}: exchange them");
                Err(Error::Setting { key: "high", why })
            }
        }
    }
    fn laws(&self) -> Vec<Law> {
        let (low, high) = (self.0.vector("low"), self.0.vector("high"));
        let (margin, acceleration) = (self.0.number("margin"), self.0.number("acceleration"));
        let (kind, kind_value) = species(&self.0, "species");
        let mut values = params(&self.0, &["low", "high", "margin", "acceleration"]);
        values.push(("species".to_owned(), kind_value));
        vec![Law::each("soft_turn", crate::shader!("interactions/soft_turn.wgsl"), values, move |me, world| {
            if !kind.has(me) {
                return DVec4::ZERO;
            }
            let mut sum = DVec4::ZERO;
            for axis in 0..world.bounds.dimensions.min(3) as usize {
                let below = low[axis] + margin - me.position[axis];
                let above = me.position[axis] - (high[axis] - margin);
                if below > 0.0 {
                    sum[axis] += acceleration;
                    sum.w += acceleration * below;
                }
                if above > 0.0 {
                    sum[axis] -= acceleration;
                    sum.w += acceleration * above;
                }
            }
            sum
        })]
    }
}
