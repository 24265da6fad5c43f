//! Motions whose velocity jumps, and the rods that must follow at once.

use super::Remark;
use crate::motion::{Hold, Motion};
use crate::simulation::Setup;

/// By what part of a rod a jump may move its end in a step. Constraints are linearized about where they are: of hair that a
/// jump moved by 0.17 of a rod in a step numbers were lost, by 0.12 they were not.
const BEARS: f64 = 0.05;

/// A remark for each motion that is too fast for rods, in a run that ends at `end`.
pub fn remarks(setup: &Setup, end: f64) -> Vec<Remark> {
    let particles = &setup.state;
    let Some(shortest) = particles.links.rods.iter().map(|rod| rod.length).reduce(f64::min) else { return Vec::new() };
    let tied: std::collections::BTreeSet<u32> = particles.links.rods.iter().flat_map(|rod| rod.ends).collect();
    let remark = |(number, motion): (usize, &Motion)| {
        let led =
            particles.held.iter().filter(|held| held.by == Hold::Motion(u32::try_from(number).unwrap_or(u32::MAX)));
        let ends =
            led.filter(|held| tied.contains(&held.id)).filter_map(|held| particles.position().get(held.id as usize));
        // In a rotation the speed increases with the distance from the centre.
        let arm = ends.map(|x| (*x - motion.about).length()).reduce(f64::max)?;
        let (time, jump) = largest_jump(motion, arm, end)?;
        let part = jump * setup.dt / shortest;
        (part > BEARS).then(|| {
            let text = format!(
                "the motion \"{}\" jumps in velocity by {jump:.3e} at {time:.4}, and rods must follow within one step: by {part:.2} of \
                 the shortest rod ({shortest:.3e}); above {BEARS} their constraint solve may fail",
                motion.name
            );
            let largest = BEARS * shortest / jump;
            Remark::note("jumping-motion", text)
                .with("jump", jump)
                .with("time", time)
                .with("largest_dt", largest)
                .advice(format!("set smooth = true, or choose dt below {largest:.2e}"))
        })
    };
    particles.motions.iter().enumerate().filter_map(remark).collect()
}

/// The time at which the velocity of a motion jumps most at this distance from its centre of rotation, and the jump.
fn largest_jump(motion: &Motion, arm: f64, end: f64) -> Option<(f64, f64)> {
    if motion.smooth {
        return None;
    }
    let pieces = motion.keys.windows(2);
    let shortest = pieces.map(|keys| keys[1].time - keys[0].time).reduce(f64::min)?;
    let jump = |time: f64| {
        let [before, after] = [-1e-3, 1e-3].map(|part| motion.pose(time + part * shortest));
        (after.velocity - before.velocity).length() + (after.spin - before.spin).length() * arm
    };
    let times = motion.keys.iter().map(|key| key.time).filter(|time| (0.0..end).contains(time));
    times.map(|time| (time, jump(time))).max_by(|a, b| a.1.total_cmp(&b.1))
}
