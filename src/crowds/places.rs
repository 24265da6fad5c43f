//! Places of pedestrians: on the floor of a plan, and with a way to an exit.

use glam::DVec3;

use crate::error::Error;
use crate::floor_plan::FloorPlan;
use crate::life::Life;
use crate::state::State;

/// Off the floor by this part of the largest coordinate is rounding: a pedestrian is put back to a wall in single precision. None begins so near to one,
/// where it has no direction from the wall.
const ROUNDING: f64 = 4.0 * f32::EPSILON as f64;

/// The particles that are on the floor, or will be, with their positions.
fn places(state: &State) -> impl Iterator<Item = (usize, &DVec3)> {
    let life = state.life();
    let takes_part = move |i: usize| life.get(i).is_none_or(|life| *life != Life::Removed);
    state.position().iter().enumerate().filter(move |(i, _)| takes_part(*i))
}

/// Refuses particles, those to be spawned among them, that are off the floor of a plan.
pub(crate) fn on_the_floor(plan: &FloorPlan, state: &State) -> Result<(), Error> {
    let (low, high) = plan.extent();
    let rounding = ROUNDING * low.abs().max(high.abs()).max_element();
    let (begins, is_on_a_wall) = (state.step == 0, |x: &DVec3| plan.distance(x.truncate()) <= rounding);
    let off = |x: &DVec3| if plan.holds(x.truncate()) { begins && is_on_a_wall(x) } else { begins || !is_on_a_wall(x) };
    let mut all = places(state).filter(|(_, x)| off(x));
    let Some((first, x)) = all.next() else { return Ok(()) };
    Err(Error::Scene(format!(
        "{} particles are on or in a wall, or off the floor of the plan, the first of them particle {first} at {} {}: move them into the POLYGON",
        1 + all.count(),
        x.x,
        x.y
    )))
}

/// Refuses particles, those to be spawned among them, that have no way to an exit.
pub(crate) fn have_ways(plan: &FloorPlan, state: &State) -> Result<(), Error> {
    let mut all = places(state).filter(|(_, x)| !plan.leads_out(x.truncate()));
    let Some((first, x)) = all.next() else { return Ok(()) };
    Err(Error::Scene(format!(
        "{} particles have no way to an exit, the first of them particle {first} at {} {}: open the wall that is between, or add an exit",
        1 + all.count(),
        x.x,
        x.y
    )))
}

/// Refuses exits of a plan to which no particle of a state has a way.
pub(crate) fn reach_exits(plan: &FloorPlan, state: &State) -> Result<(), Error> {
    let Some(exit) = plan.without_way(places(state).map(|(_, x)| x.truncate())) else { return Ok(()) };
    let at = exit.path.first().copied().unwrap_or_default();
    Err(Error::Scene(format!(
        "no way leads to the exit \"{}\" at {} {} from where any particle is: open the wall that is before it, or remove the exit",
        exit.name, at.x, at.y
    )))
}
