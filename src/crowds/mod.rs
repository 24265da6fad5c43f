//! Crowds: pedestrians as discs in a plane, with the forces of Helbing, Farkas & Vicsek (Nature 407, 487, 2000), or velocities of the collision-free speed model
//! (Tordeux, Chraibi & Seyfried, arXiv 1512.05597).
//!
//! Where the paper on forces leaves a choice, here:
//! * friction between two pedestrians is κ g times the velocity of the other relative to the pedestrian, across the line between them; at a wall,
//!   which does not move, it is −κ g times the pedestrian's own velocity along the wall. Either way it takes energy;
//! * forces use the velocities of the evaluation, which are those of the half step under kicks and drifts;
//! * the anisotropy multiplies the exponential only, and not the forces of touch.

mod desire;
mod keep;
mod places;
mod press;
mod sight;
mod spacing;
mod walls;
mod ways;

pub(crate) use desire::{DIRECTION, Drive, desired_direction, is_followed};
#[cfg(feature = "scene")]
pub(crate) use keep::CORRECTIONS;
pub(crate) use keep::{allowed_columns, begin, keep};
pub(crate) use places::{have_ways, on_the_floor, reach_exits};
pub(crate) use press::{DECAY, FRICTION, REPULSION, STIFFNESS};
pub use press::{Press, STEEPEST};
pub(crate) use sight::Sight;
pub(crate) use spacing::{Repulsion, Spacing, columns as spacing_columns, set_off};

pub(crate) use walls::{pushed, rounded, table};
pub use ways::EXIT_DISTANCE;
pub(crate) use ways::{drive, exit_distance, inside, kernels, time_inside};

use crate::error::Error;
use crate::floor_plan::FloorPlan;
use crate::kernel::{Column, Kind as Element, Problem};
use crate::settings::{Key, Kind, Value};
use crate::visit::Particle;

/// The relaxation time of the drive.
pub(crate) const RELAXATION_TIME: Key = Key::new(
    "relaxation_time",
    Kind::Positive,
    Value::Number(0.5),
    "τ, the time in which a free pedestrian takes up the desired velocity [time]",
);

/// The radius of a pedestrian, a column that every one must have.
#[must_use]
pub fn radius() -> Column {
    Column::new("radius", Element::Scalar, "length", "of the disc that others touch").required()
}

/// The speed at which a pedestrian would walk alone, a column that every one must have.
#[must_use]
pub fn desired_speed() -> Column {
    Column::new("desired_speed", Element::Scalar, "length / time", "the speed of a pedestrian alone").required()
}

/// The floor plan of a problem, which a component needs.
pub(crate) fn plan_of<'a>(problem: &'a Problem, component: &str) -> Result<&'a FloorPlan, Error> {
    problem.floor_plan.as_deref().ok_or_else(|| {
        Error::Scene(format!("{component} needs a floor plan, and there is none: add [plan] with a `file` or `wkt`"))
    })
}

/// The radius in a reference; 0 where there is none.
pub(crate) fn radius_of(me: &Particle) -> f64 {
    me.scalar("radius").unwrap_or_default()
}

/// The desired speed in a reference; 0 where there is none.
pub(crate) fn desired_speed_of(me: &Particle) -> f64 {
    me.scalar("desired_speed").unwrap_or_default()
}
