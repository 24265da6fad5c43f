//! The drive of pedestrians to the exits of a plan.

use super::{Component, EACH, Properties, SPECIES, Stage, evaluate};
use crate::crowds;
use crate::error::Error;
use crate::floor_plan::FloorPlan;
use crate::kernel::{Bounds, Column, Plan, Problem};
use crate::settings::{Key, Settings};

/// The keys in a scene.
pub const KEYS: &[Key] = &[crowds::RELAXATION_TIME, SPECIES, EACH];

/// `navigate`: a = (v₀ e − v) / τ (Helbing & Molnár, Phys. Rev. E 51, 4282, 1995), with v₀ the `desired_speed` of each pedestrian, and e along the shortest
/// way to an exit of the scene's plan: down the distance round walls, which the eikonal equation |∇T| = 1 gives on the cells of the plan
/// (Rouy & Tourin, SIAM J. Numer. Anal. 29, 867, 1992). Distances are found once, before the first step. The column `time_inside`
/// has the time at which each pedestrian left.
#[derive(Clone)]
pub struct Navigate(Settings);

impl Navigate {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for Navigate {
    fn columns(&self) -> Vec<Column> {
        vec![crowds::desired_speed(), crowds::time_inside()]
    }
    fn plan_columns(&self, plan: &FloorPlan) -> Vec<Column> {
        vec![crowds::exit_distance(plan)]
    }
    fn check(&self, bounds: &Bounds) -> Result<(), Error> {
        if bounds.dimensions == 2 {
            return Ok(());
        }
        Err(Error::Scene("navigate: a plan is flat: say dimensions = 2 in [box]".to_owned()))
    }
    fn properties(&self) -> Properties {
        Properties {
            constrains: true,
            dissipates: vec!["walking"],
            navigates: true,
            leads: true,
            fixed_step: Some("navigate counts the time of each pedestrian in steps"),
            ..Properties::default()
        }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        let floor = crowds::plan_of(problem, "navigate")?;
        match stage {
            Stage::Start => crowds::kernels(floor, plan),
            Stage::Evaluate { earlier } => {
                let (time, species) = (self.0.number("relaxation_time"), self.0.species("species"));
                let law = crowds::drive(floor, crate::shader!("interactions/navigate.wgsl"), (time, species), crowds::is_followed(problem));
                evaluate(vec![law], earlier, plan, problem)
            }
            Stage::EndOfStep => {
                plan.add(crowds::inside(problem)?);
                Ok(())
            }
            _ => Ok(()),
        }
    }
}
