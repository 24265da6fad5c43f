//! The forces of contacts in a state, by the functions of the laws: for measures.
//!
//! They are those of the state: springs are as the last step left them, and dashpots have the velocities of the state, where a step has
//! those in the middle of its kicks.

use std::collections::BTreeMap;

use glam::DVec3;

use super::{Ball, Material, Meeting, Wound, near};
use crate::kernel::Bounds;
use crate::state::State;

/// A contact, and the force on a grain in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactForce {
    /// The row of the grain.
    pub grain: usize,
    /// The row of the other grain; `None`: a wall.
    pub other: Option<usize>,
    /// From the centre of the grain to that of the other; to the contact with a wall \[length\].
    pub way: DVec3,
    /// From the centre of the grain to the contact \[length\].
    pub arm: DVec3,
    /// The force on the grain \[mass length / time²\].
    pub force: DVec3,
}

/// The grains of a state, as contacts read them.
pub struct Balls<'a> {
    state: &'a State,
    radii: &'a [f64],
    spins: &'a [DVec3],
}

impl<'a> Balls<'a> {
    /// The grains of a state.
    #[must_use]
    pub fn of(state: &'a State) -> Self {
        let radii = state.scalar("radius").unwrap_or_default();
        Self { state, radii, spins: state.vector("angular_velocity").unwrap_or_default() }
    }
    /// The grain of a row; `None` where there is none, or it has no radius.
    #[must_use]
    pub fn ball(&self, row: usize) -> Option<Ball> {
        let radius = self.radii.get(row).copied().filter(|radius| *radius > 0.0 && self.state.is_active(row))?;
        let spin = self.spins.get(row).copied().unwrap_or_default();
        Some(Ball { velocity: self.state.velocity()[row], spin, radius, mass: self.state.mass()[row] })
    }
    /// The radii.
    #[must_use]
    pub fn radii(&self) -> &[f64] {
        self.radii
    }
}

/// The force of a contact, or of a bridge of liquid, on the sphere; `None` where there is neither.
pub(super) fn force(material: &Material, at: &Meeting, last: &Wound) -> Option<DVec3> {
    let bridge = material.bridge(at, last.is_wet, 0.0);
    let push = if at.overlap > 0.0 { material.touch(at, last, 0.0).push } else { DVec3::ZERO };
    (at.overlap > 0.0 || bridge.is_there).then(|| push + bridge.pull * at.n)
}

/// The forces between grains, each contact once; `material` is that of two species, and none reaches farther than `reach`, relative to the
/// smaller radius.
#[must_use]
pub fn between(
    state: &State,
    bounds: &Bounds,
    reach: f64,
    material: impl Fn([u32; 2]) -> Option<Material>,
) -> Vec<ContactForce> {
    let balls = Balls::of(state);
    let history: BTreeMap<[usize; 2], &[f64]> = state.pair_history().collect();
    let (places, species) = (state.position(), state.species());
    let pairs = near(places, balls.radii(), reach, bounds, |i| balls.ball(i).is_some());
    let contact = |[i, j]: [usize; 2]| {
        let way = bounds.shortest(places[j] - places[i]);
        let at = Meeting::between(&balls.ball(i)?, &balls.ball(j)?, way)?;
        let material = material([species[i], species[j]])?;
        let words = history.get(&[i, j]).copied().unwrap_or_default();
        let last = Wound::of(|word| words.get(word).copied().unwrap_or(0.0));
        let force = force(&material, &at, &last)?;
        Some(ContactForce { grain: i, other: Some(j), way, arm: at.arm * at.n, force })
    };
    pairs.into_iter().filter_map(|pair| contact(pair.grains)).collect()
}
