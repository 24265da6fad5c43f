//! The drive of pedestrians along a direction, or to a target.

use std::borrow::Cow;

use glam::DVec3;

use super::{Component, EACH, Law, SPECIES, Stage, evaluate, params, species};
use crate::crowds::{self, Drive};
use crate::error::Error;
use crate::kernel::{Bounds, Column, Plan, Problem, Scalar};
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("to", Kind::Choice(&["direction", "target"]), Value::Text(Cow::Borrowed("direction")), "where pedestrians walk: along a direction, or to a target"),
    Key::new("direction", Kind::Direction, Value::Vector(DVec3::X), "to = \"direction\": the direction, of any length"),
    Key::new("target", Kind::Vector, Value::Vector(DVec3::ZERO), "to = \"target\": the point at which they stop [length]"),
    crowds::RELAXATION_TIME,
    SPECIES,
    EACH,
];

/// `walk`: a = (v₀ e − v) / τ (Helbing & Molnár, Phys. Rev. E 51, 4282, 1995), with v₀ the `desired_speed` of each pedestrian, and e a direction,
/// or the unit vector to a target.
#[derive(Clone)]
pub struct Walk(Settings);

impl Walk {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
    fn law(&self, is_followed: bool) -> Law {
        let (direction, target) = (self.0.vector("direction").normalize_or_zero(), self.0.vector("target"));
        let (time, to_target) = (self.0.number("relaxation_time"), self.0.text("to") == "target");
        let (kind, kind_value) = species(&self.0, "species");
        let mut values = params(&self.0, &["relaxation_time"]);
        values.extend([
            ("direction".to_owned(), Scalar::Vector(direction)),
            ("destination".to_owned(), Scalar::Vector(target)),
            ("to_target".to_owned(), Scalar::Uint(u32::from(to_target))),
            ("species".to_owned(), kind_value),
        ]);
        let wgsl = crate::shader!("interactions/walk.wgsl");
        let drive = Drive { name: "walk", wgsl, values, tables: Vec::new(), time, species: kind.0 };
        drive.law(is_followed, move |me, world| {
            if to_target { world.bounds.shortest(target - me.position).normalize_or_zero() } else { direction }
        })
    }
}

impl Component for Walk {
    fn columns(&self) -> Vec<Column> {
        vec![crowds::desired_speed()]
    }
    fn check(&self, bounds: &Bounds) -> Result<(), Error> {
        let leads_out = |key: &'static str| {
            let why = format!("`{key}` leads out of the plane of the scene: its third number must be 0");
            Err(Error::Setting { key, why })
        };
        match self.0.text("to") {
            "target" if bounds.dimensions == 2 && self.0.vector("target").z != 0.0 => leads_out("target"),
            "direction" if bounds.dimensions == 2 && self.0.vector("direction").z != 0.0 => leads_out("direction"),
            _ => Ok(()),
        }
    }
    fn properties(&self) -> super::Properties {
        super::Properties { leads: true, dissipates: vec!["walking"], ..super::Properties::default() }
    }
    fn laws(&self) -> Vec<Law> {
        vec![self.law(false)]
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        match stage {
            Stage::Evaluate { earlier } => {
                evaluate(vec![self.law(crowds::is_followed(problem))], earlier, plan, problem)
            }
            _ => Ok(()),
        }
    }
}
