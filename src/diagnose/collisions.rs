//! Collisions that a run would miss, and bounces that hold nothing up.

use super::Remark;
use crate::component::Collisions;
use crate::simulation::Setup;
use crate::updaters::collide::RADIUS;

/// Bodies that are too fast at the start for the search, and bodies that would rest on one another.
pub fn remarks(setup: &Setup) -> Vec<Remark> {
    let found = setup.forces.iter().find_map(|force| force.properties().collides);
    let (Some(collisions), Some(radius)) = (found, setup.state.scalar(RADIUS.name)) else { return Vec::new() };
    fast(setup, &collisions, radius).into_iter().chain(resting(setup, &collisions)).collect()
}

/// Bodies that move so far in a step that they may be on the other side of one that they should touch.
fn fast(setup: &Setup, collisions: &Collisions, radius: &[f64]) -> Option<Remark> {
    let state = &setup.state;
    let ways = state.velocity().iter().map(|v| v.length() * setup.dt);
    // Those that bounce are looked for where they are, and those that merge on their way, if they are in range at its end.
    let far = |row: usize, way: f64| match (collisions.restitution, collisions.range) {
        (Some(_), _) => way > 2.0 * radius[row],
        (None, Some(range)) => way + radius[row] > 0.5 * range,
        (None, None) => false,
    };
    let mut all = ways.enumerate().filter(|(row, way)| radius[*row] > 0.0 && state.is_active(*row) && far(*row, *way));
    let (row, way) = all.next()?;
    let (particles, id) = (1 + all.count(), state.ids().get(row).map_or(row as f64, |id| f64::from(*id)));
    let (what, way_out) = match collisions.restitution {
        Some(_) => ("more than the diameter", "choose a smaller dt"),
        None => {
            ("with its radius more than half of the range", "choose a smaller dt, a larger range, or over = \"pairs\"")
        }
    };
    let others = if particles > 1 { format!("it and {} more", particles - 1) } else { "it".to_owned() };
    let text = format!(
        "particle {id} of radius {} moves by {way:.3e} in the first step, {what}: {others} may pass through what should be touched",
        radius[row]
    );
    let remark = Remark::note("fast-collisions", text).with("particles", particles as f64).with("particle", id);
    Some(remark.with("moved", way).advice(way_out))
}

/// Bounces that take energy, beside what presses bodies together.
fn resting(setup: &Setup, collisions: &Collisions) -> Option<Remark> {
    let restitution = collisions.restitution.filter(|restitution| *restitution < 1.0)?;
    let presses =
        setup.forces.iter().find(|force| force.properties().collides.is_none() && !force.laws().is_empty())?;
    let text = format!(
        "bounces with restitution = {restitution} hold nothing up: bodies that {} presses together for long sink into each other",
        presses.name()
    );
    let remark = Remark::note("resting-collisions", text).with("restitution", restitution);
    Some(remark.advice("take `contact` for grains that rest on each other, or restitution = 1"))
}
