//! What a run says of pedestrians that walls put back.

use crate::crowds::CORRECTIONS;
use crate::state::State;

/// How often the walls of a plan put pedestrians back, in a sentence, if they did.
pub(super) fn corrected(state: &State) -> Option<String> {
    let counts = state.scalar(CORRECTIONS).unwrap_or_default();
    let (worst, most) = counts.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).filter(|(_, most)| **most > 0.0)?;
    let (all, of): (f64, usize) = (counts.iter().sum(), counts.iter().filter(|count| **count > 0.0).count());
    let (id, at) = (state.ids().get(worst).copied().unwrap_or_default(), state.position()[worst]);
    Some(format!(
        "{of} pedestrians were put back in front of walls, {all} times in all, most often particle {id}, {most} times, which is at {:.3} {:.3}: \
         forces did not keep them off, and their times are not to be trusted; choose a smaller dt",
        at.x, at.y
    ))
}
