//! The list of neighbours: how much room it has, and whether that is enough.

use glam::DVec3;

use super::{Setup, Simulation, pair_history};
use crate::error::Error;
use crate::forces::{Law, Problem};
use crate::kernel::{Array, Backend, Element, ListShape};
use crate::neighbors::{Cells, LIST_STATE, LIST_STATE_WORDS};
use crate::state::KEPT_ROOM;
use crate::visit;

/// The same problem with a list that has room for half as many neighbours more than any particle has at the start.
///
/// # Errors
/// [`Error::Scene`] when a range or a skin is none.
pub(super) fn counted(setup: &Setup, problem: Problem) -> Result<Problem, Error> {
    let laws: Vec<Law> = setup.forces.iter().flat_map(|force| force.laws()).collect();
    let Some(shape) = visit::shared_list(&laws, &problem)? else { return Ok(problem) };
    let active = setup.state.position().iter().enumerate().filter(|(id, _)| setup.state.is_active(*id));
    let places: Vec<DVec3> = active.map(|(_, x)| *x).collect();
    let most = Cells::new(&places, setup.bounds, shape.reach())?.most();
    // Pending particles are not counted: there is as much room as where nothing is known, at least.
    let most = if problem.has_inactive { most.max(visit::UNCOUNTED) } else { most };
    let count = problem.capacity;
    let shape = shape.with_room(most, count);
    // A run that goes on, or has got more rows, keeps the room that it had.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
    let room = setup.state.kept.get(KEPT_ROOM).and_then(|list| list.first()).map_or(0, |room| *room as u32);
    let kept = room.min(count).max(u32::try_from(pair_history::longest(&setup.state)).unwrap_or(u32::MAX));
    let capacity = if kept == 0 || kept < most { shape.capacity } else { kept.div_ceil(4).saturating_mul(4) };
    Ok(problem.listed(Some(ListShape { capacity, ..shape })))
}

impl<B: Backend> Simulation<B> {
    /// Looks whether the list of neighbours had room for all.
    ///
    /// # Errors
    /// [`Error::ListFull`], or what reading says.
    pub(super) async fn check_list(&mut self) -> Result<(), Error> {
        let Some(shape) = self.list else { return Ok(()) };
        let state = self.backend.read(LIST_STATE, &Array::Uint(Vec::new()), LIST_STATE_WORDS).await?;
        match u32::view(&state).map(Vec::as_slice) {
            Some([_, _, longest, full]) if *full > 0 => {
                let (longest, capacity, reach) = (*longest, shape.capacity, shape.reach());
                Err(Error::ListFull { particle: self.named(!full), longest, capacity, reach })
            }
            _ => Ok(()),
        }
    }
}
