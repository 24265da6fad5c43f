//! Free lines from pedestrians to exits: drains at exits do not act through walls.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::walls::{rounded, table};
use crate::floor_plan::{AHEAD, FloorPlan, Segment};
use crate::kernel::{Problem, Source, Table};
use crate::life::Drain;
use crate::solids::Solid;

/// What a drain sees.
pub(crate) enum Sight {
    /// All of its region: it is no exit of a plan.
    Everywhere,
    /// What no wall of a plan is before.
    Free {
        /// The walls, as the device holds them.
        walls: Vec<Segment>,
        /// The table of them.
        table: Table,
    },
}

impl Sight {
    /// Of a drain of a problem: that of an exit of its plan, or another.
    pub fn of(drain: &Drain, problem: &Problem) -> Self {
        let is_exit = |plan: &&Arc<FloorPlan>| plan.drains().contains(drain);
        problem
            .floor_plan
            .as_ref()
            .filter(is_exit)
            .map_or(Self::Everywhere, |plan| Self::Free { walls: rounded(plan), table: table(plan) })
    }
    /// The files with `fn is_free(x: vec3f, r: vec3f) -> bool`.
    pub fn sources(&self) -> Vec<Source> {
        match self {
            Self::Everywhere => vec![crate::shader!("life/everywhere.wgsl")],
            Self::Free { .. } => vec![crate::shader!("crowds/crosses.wgsl"), crate::shader!("crowds/sight.wgsl")],
        }
    }
    /// Its constants.
    pub fn constants(&self) -> Vec<(&'static str, f64)> {
        match self {
            Self::Everywhere => Vec::new(),
            Self::Free { walls, .. } => vec![("COUNT", walls.len() as f64)],
        }
    }
    /// Its table, with the number of elements.
    pub fn table(&self) -> Option<(Table, u64)> {
        match self {
            Self::Everywhere => None,
            Self::Free { walls, table } => Some((table.clone(), walls.len() as u64)),
        }
    }
    /// Whether a drain at a position acts at another.
    pub fn is_free(&self, drain: &Drain, x: DVec3) -> bool {
        let (Self::Free { walls, .. }, Solid::Capsule(axis, _)) = (self, drain.solid) else { return true };
        let r = (x - drain.position).truncate();
        let axis = axis.truncate();
        let along = (r.dot(axis) / axis.length_squared()).clamp(-0.5, 0.5);
        let (away, x): (DVec2, DVec2) = (r - along * axis, x.truncate());
        !walls.iter().any(|wall| wall.crosses(x - (1.0 - AHEAD) * away, x))
    }
}
