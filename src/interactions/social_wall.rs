//! Walls of a plan, for pedestrians.

use super::{Component, EACH, Law, Properties, SPECIES, Stage, evaluate, params, species};
use crate::component::Largest;
use crate::crowds::{self, Press};
use crate::error::Error;
use crate::kernel::{Bounds, Column, Plan, Problem, Scalar, Side};
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("range", Kind::Positive, Value::Number(1.5), "the distance from a wall to centres up to which it acts [length]"),
    crowds::REPULSION,
    crowds::DECAY,
    crowds::STIFFNESS,
    crowds::FRICTION,
    SPECIES,
    EACH,
];

/// `social_wall`: the nearest point of each wall of the scene's plan in range repels a pedestrian on its free side as others do, pushes it back where
/// it touches, and slows it along the wall (Helbing, Farkas & Vicsek, Nature 407, 487, 2000). A wall goes from one corner of a room to the
/// next, round corners that stick out. No pedestrian passes a wall: one whose way crosses it is put back to its last position in
/// front of it, which is counted in the column `wall_corrections`.
#[derive(Clone)]
pub struct SocialWall(Settings);

impl SocialWall {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
    fn law(&self, problem: &Problem) -> Result<Law, Error> {
        let plan = crowds::plan_of(problem, "social_wall")?;
        let (press, range) = (Press::of(&self.0), self.0.number("range"));
        let (kind, kind_value) = species(&self.0, "species");
        let walls = crowds::rounded(plan);
        let mut values = params(&self.0, &["range", "repulsion", "decay", "stiffness", "friction"]);
        values.push(("count".to_owned(), Scalar::Uint(u32::try_from(walls.len()).unwrap_or(u32::MAX))));
        values.push(("species".to_owned(), kind_value));
        let law = Law::each("social_wall", crate::shader!("interactions/social_wall.wgsl"), values, move |me, _| {
            if me.mass <= 0.0 || !kind.has(me) {
                return glam::DVec4::ZERO;
            }
            let force = crowds::pushed(&walls, &press, range, (me.position, me.velocity, crowds::radius_of(me)));
            (force / me.mass).extend(0.0)
        });
        Ok(Law { tables: vec![crowds::table(plan)], ..law })
    }
}

impl Component for SocialWall {
    fn columns(&self) -> Vec<Column> {
        let mut all = crowds::allowed_columns();
        all.push(crowds::radius());
        all
    }
    fn check(&self, bounds: &Bounds) -> Result<(), Error> {
        let why = match bounds {
            bounds if bounds.dimensions != 2 => "a plan is flat: say dimensions = 2 in [box]",
            bounds if bounds.has(Side::Periodic) => "a plan has no images: leave out the periodic boundary",
            _ => return Ok(()),
        };
        Err(Error::Scene(format!("social_wall: {why}")))
    }
    fn properties(&self) -> Properties {
        let limits = [
            (self.0.number("range"), "beyond its range a wall does not act, not even where it is touched"),
            (2.0 * crowds::STEEPEST * self.0.number("decay"), "the repulsion grows by e for each `decay` of an overlap, and would exceed single precision"),
        ];
        Properties {
            largest: limits.map(|(value, why)| Largest { column: "radius", value, why }).to_vec(),
            constrains: true,
            keeps_in: true,
            dissipates: vec!["walls"],
            turns: vec!["walls"],
            presses: Some(Press::of(&self.0)),
            ..Properties::default()
        }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        match stage {
            Stage::Start => plan.add(crowds::begin(problem)?),
            Stage::Evaluate { earlier } => evaluate(vec![self.law(problem)?], earlier, plan, problem)?,
            Stage::AfterDrift { .. } | Stage::AfterAdvance { .. } => {
                let floor = crowds::plan_of(problem, "social_wall")?;
                plan.add(crowds::keep(floor, self.0.species("species"), problem)?);
            }
            _ => {}
        }
        Ok(())
    }
}
