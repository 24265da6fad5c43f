//! Pedestrians that turn aside, and are as fast as there is room.

use super::{Component, Law, Properties, SEE_NEAR, SKIN, SPECIES, Stage, evaluate, over};
use crate::component::Largest;
use crate::crowds::{self, Repulsion, Spacing};
use crate::error::Error;
use crate::floor_plan::FloorPlan;
use crate::kernel::{Bounds, Column, Plan, Problem, Side};
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("range", Kind::Positive, Value::Number(3.0), "the distance of centres up to which pedestrians see each other [length]"),
    Key::new("time_gap", Kind::Positive, Value::Number(1.0), "T, the time in which a pedestrian would be where the one in front is [time]"),
    Key::new("repulsion", Kind::NotNegative, Value::Number(8.0), "a, what a pedestrian in touch adds to the desired direction, a unit vector"),
    Key::new("decay", Kind::Positive, Value::Number(0.1), "D, the distance over which that falls by e [length]"),
    Key::new("wall_repulsion", Kind::NotNegative, Value::Number(5.0), "what a wall of the plan in touch adds to the desired direction"),
    Key::new("wall_decay", Kind::Positive, Value::Number(0.02), "the distance over which that falls by e [length]"),
    SPECIES,
    SEE_NEAR,
    SKIN,
];

/// `collision_free_speed`: pedestrians turn aside from others and from walls of the scene's plan, and go as fast as the one in front leaves room, in velocities
/// that they take up at once (Tordeux, Chraibi & Seyfried, arXiv 1512.05597): V = min(v₀, max(0, s / T)) along e₀ + Σ a exp((R + R' − d) / D) n. e₀ is the direction that
/// `walk` or `navigate` desires, v₀ the `desired_speed`. What walls hide is not seen, and no step leads farther than to the touch of a wall. Defaults are those of JuPedSim.
/// Velocities are set after all forces: what others add is lost.
#[derive(Clone)]
pub struct CollisionFreeSpeed(Settings);

impl CollisionFreeSpeed {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
    fn on(&self, plan: Option<&FloorPlan>) -> Vec<Law> {
        let number = |name| self.0.number(name);
        let model = Spacing {
            time_gap: number("time_gap"),
            others: Repulsion { strength: number("repulsion"), decay: number("decay") },
            walls: Repulsion { strength: number("wall_repulsion"), decay: number("wall_decay") },
            species: self.0.species("species"),
        };
        model.laws(plan, over(&self.0, None), crate::shader!("interactions/collision_free_speed.wgsl"))
    }
    /// The longest step in which two that walk at each other do not overlap: each goes half of the spacing at most.
    fn check_step(&self, problem: &Problem) -> Result<(), Error> {
        let (dt, time) = (problem.dt, self.0.number("time_gap"));
        if dt <= 0.5 * time {
            return Ok(());
        }
        Err(Error::Scene(format!(
            "collision_free_speed: with time_gap = {time} two that walk at each other would overlap in steps of dt = {dt}: choose a dt up to {}, or a longer time_gap",
            0.5 * time
        )))
    }
}

impl Component for CollisionFreeSpeed {
    fn columns(&self) -> Vec<Column> {
        let mut all = vec![crowds::radius(), crowds::desired_speed(), crowds::desired_direction()];
        all.extend(crowds::spacing_columns());
        all
    }
    fn plan_columns(&self, _: &FloorPlan) -> Vec<Column> {
        crowds::allowed_columns()
    }
    fn check(&self, bounds: &Bounds) -> Result<(), Error> {
        if bounds.dimensions == 2 {
            return Ok(());
        }
        Err(Error::Scene("collision_free_speed: pedestrians walk in a plane: say dimensions = 2 in [box]".to_owned()))
    }
    fn properties(&self) -> Properties {
        let [range, time, decay, wall] = ["range", "time_gap", "decay", "wall_decay"].map(|name| self.0.number(name));
        let steep = "the repulsion grows by e for each `decay` of an overlap, and would exceed single precision";
        let steep_wall = "the repulsion of walls grows by e for each `wall_decay` of an overlap, and would exceed single precision";
        let limits = [
            ("radius", 0.5 * range, "its range is the largest sum of two radii"),
            ("radius", crowds::STEEPEST * decay, steep),
            ("radius", 2.0 * crowds::STEEPEST * wall, steep_wall),
            ("desired_speed", range / time, "a faster pedestrian would see others too late to slow down by its time_gap"),
        ];
        Properties {
            largest: limits.map(|(column, value, why)| Largest { column, value, why }).to_vec(),
            ignores_massless: true,
            constrains: true,
            keeps_in: true,
            evaluated_last: true,
            sets_velocities: true,
            fixed_step: Some("collision_free_speed sets velocities for whole steps"),
            integrators: &["symplectic_euler", "leapfrog"],
            dissipates: vec!["walking"],
            turns: vec!["walking"],
            ..Properties::default()
        }
    }
    fn laws(&self) -> Vec<Law> {
        self.on(None)
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        let floor = problem.floor_plan.as_deref();
        if floor.is_some() && problem.bounds.has(Side::Periodic) {
            let why = "collision_free_speed: a plan has no images: leave out the periodic boundary";
            return Err(Error::Scene(why.to_owned()));
        }
        match stage {
            Stage::Start if floor.is_some() => plan.add(crowds::begin(problem)?),
            Stage::Evaluate { earlier: 1.. } => {
                let why = "collision_free_speed is there twice, and each would set the velocities of the other's pedestrians: leave one out";
                return Err(Error::Scene(why.to_owned()));
            }
            Stage::Evaluate { earlier } => {
                self.check_step(problem)?;
                evaluate(self.on(floor), earlier, plan, problem)?;
            }
            Stage::AfterKick => plan.add(crowds::set_off(problem)?),
            Stage::AfterDrift { .. } | Stage::AfterAdvance { .. } => {
                if let Some(floor) = floor {
                    plan.add(crowds::keep(floor, self.0.species("species"), problem)?);
                }
            }
            _ => {}
        }
        Ok(())
    }
}
