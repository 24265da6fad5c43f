//! The capacity of the neighbour list, and its growth.

use std::collections::BTreeSet;

use glam::DVec3;

use super::elastic::{Change, Fit};
use super::grow::Room;
use super::{Plans, Setup, Simulation, pair_history};
use crate::error::Error;
use crate::forces::{Law, Over, Problem};
use crate::kernel::{Array, Backend, Element, Kernel, ListShape, Neighbors};
use crate::life::Life;
use crate::neighbors::{Cells, LIST, LIST_STATE, LIST_STATE_WORDS};
use crate::state::{KEPT_NEIGHBORS, KEPT_ROOM, KEPT_SKIN, State};
use crate::visit;

/// The same problem with the neighbour counts that laws require, and with a list that has room for 1.5 times the largest count at the start.
///
/// # Errors
/// [`Error::Scene`] when a range or a skin is invalid.
pub(super) fn counted(setup: &Setup, problem: Problem) -> Result<Problem, Error> {
    let laws: Vec<Law> = setup.forces.iter().flat_map(|force| force.laws()).collect();
    let places = || -> Vec<DVec3> {
        let active = setup.state.position().iter().enumerate().filter(|(id, _)| setup.state.is_active(*id));
        active.map(|(_, x)| *x).collect()
    };
    let skin = setup.state.kept.get(KEPT_SKIN).and_then(|list| list.first().copied());
    let problem = Problem { neighbors: neighbors(setup, &laws, &places)?, skin, ..problem };
    let Some(shape) = visit::shared_list(&laws, &problem)? else { return Ok(problem) };
    let places = places();
    let most = Cells::new(&places, setup.bounds, shape.reach())?.most();
    let most = if has_pending(&setup.state) { most.max(expected(setup, shape.reach())) } else { most };
    let count = problem.capacity;
    let shape = shape.with_room(most, count);
    // A simulation that grows sets its capacity. A state holds no capacity: that depends on when the list was checked.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
    let made = setup.state.kept.get(KEPT_ROOM).and_then(|list| list.first()).map_or(0, |room| *room as u32).min(count);
    let made = if made == 0 || made < most { shape.capacity } else { made };
    let remembered = u32::try_from(pair_history::longest(&setup.state)).unwrap_or(u32::MAX);
    let capacity = made.max(remembered).div_ceil(4).saturating_mul(4);
    Ok(problem.listed(Some(ListShape { capacity, ..shape })))
}

/// The column by which grains touch.
const RADIUS: &str = "radius";

/// Whether particles may become active, which no count at the start contains.
fn has_pending(state: &State) -> bool {
    !state.births.is_empty() || state.capacity.is_some() || state.life().contains(&Life::Pending)
}

/// The part of space that spheres fill at most in a heap, and that disks fill in a plane.
const FILLED: [f64; 2] = [0.64, 0.84];

/// The number of neighbours within `reach` for which there is room although they are not counted: of grains as many of the smallest as fill
/// it, of others [`UNCOUNTED`](visit::UNCOUNTED).
fn expected(setup: &Setup, reach: f64) -> u32 {
    let touch = setup.forces.iter().any(|force| force.properties().largest.iter().any(|one| one.column == RADIUS));
    let radii = setup.state.scalar(RADIUS).filter(|_| touch).unwrap_or_default();
    let smallest = radii.iter().copied().filter(|radius| *radius > 0.0).fold(f64::INFINITY, f64::min);
    let ratio = reach / smallest;
    let fit = if setup.bounds.dimensions == 2 { FILLED[1] * ratio.powi(2) } else { FILLED[0] * ratio.powi(3) };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
    let fit = fit.ceil() as u32;
    if smallest.is_finite() { fit.min(visit::UNCOUNTED) } else { visit::UNCOUNTED }
}

/// The neighbour counts within the ranges of laws that choose their search by it. A run that continues uses the counts of its start, and
/// keeps its search.
fn neighbors(setup: &Setup, laws: &[Law], places: &dyn Fn() -> Vec<DVec3>) -> Result<Vec<Neighbors>, Error> {
    let mut all: Vec<Neighbors> = Vec::new();
    let kept = setup.state.kept.get(KEPT_NEIGHBORS).unwrap_or_default();
    let known: Vec<Neighbors> = kept.chunks_exact(2).map(|two| Neighbors { range: two[0], mean: two[1] }).collect();
    for law in laws {
        let Over::Auto { range, .. } = law.over else { continue };
        let same = |one: &&Neighbors| one.range.to_bits() == range.to_bits();
        if all.iter().find(same).is_some() {
            continue;
        }
        let counted = || Ok(Neighbors { range, mean: Cells::new(&places(), setup.bounds, range)?.mean() });
        all.push(known.iter().find(same).copied().map_or_else(counted, Ok::<_, Error>)?);
    }
    Ok(all)
}

/// The fraction of the capacity above which more is allocated in advance: steps that cannot be repeated, because a caller has encoded them,
/// then have enough room before they need it.
const AMPLE: f64 = 0.8;
/// Words of an element of the list.
const FOUR: u64 = 4;

/// The copy from which steps are repeated when the list had no room.
pub(super) struct Repeat {
    /// The fields that steps write: copies of these are a complete state.
    fields: Vec<String>,
    /// The state that was copied, if any.
    from: Option<Origin>,
    /// Whether the list had room in all steps so far.
    sufficed: bool,
}

/// The simulation at the time of the copy.
pub(super) struct Origin {
    pub steps: u64,
    pub begun: bool,
    /// The number of steps since, if any were run.
    pub since: Option<u64>,
}

/// The status of the list, as read back.
#[derive(Clone, Copy)]
struct Seen {
    /// How often it was built.
    builds: u32,
    /// The largest number of neighbours of any particle.
    longest: u32,
    /// The lowest row with more neighbours than there is room for.
    overflown: Option<u32>,
}

impl Repeat {
    /// The initial value for a simulation with these plans, before it has run.
    pub fn of(plans: &Plans, list: Option<ListShape>) -> Self {
        let kernels = || plans.all().flat_map(|plan| &plan.kernels);
        let mut fields: BTreeSet<String> = kernels().flat_map(Kernel::writes).collect();
        // A backend copies the clock by itself.
        fields.remove("world");
        // A list without history is rebuilt where there is more room.
        if list.is_none_or(|list| list.words == 0) {
            fields.remove(LIST);
        }
        Self { fields: fields.into_iter().collect(), from: None, sufficed: true }
    }
    /// The copy, which is then given up.
    pub fn take(&mut self) -> Option<Origin> {
        self.from.take()
    }
}

impl<B: Backend> Simulation<B> {
    /// Records that fields are written, or steps run, in a way that cannot be repeated.
    pub(super) fn unrepeatable(&mut self) {
        (self.repeat.from, self.repeat.sufficed) = (None, false);
    }
    /// Copies the state before these steps, unless an earlier copy exists; does nothing where no list can overflow.
    pub(super) fn repeatable(&mut self, steps: Option<u32>) -> Result<(), Error> {
        if self.list.is_none() {
            return Ok(());
        }
        if self.repeat.from.is_none() {
            match self.backend.save(&self.repeat.fields) {
                Ok(()) => self.repeat.from = Some(Origin { steps: self.steps, begun: self.begun, since: None }),
                // The run continues without a copy; if the list overflows then, the run ends.
                Err(Error::OutOfMemory(_)) => {}
                Err(why) => return Err(why),
            }
        }
        if let (Some(from), Some(steps)) = (&mut self.repeat.from, steps) {
            from.since = Some(from.since.unwrap_or(0) + u64::from(steps));
        }
        self.repeat.sufficed = false;
        Ok(())
    }
    /// Checks whether the list had room for all neighbours. If not, it gets more, and the steps since the last check are repeated, so that
    /// bits are those of a run that had the room from the start. Returns whether anything has changed.
    ///
    /// # Errors
    /// [`Error::ListFull`] where the device has no room for more, or the steps cannot be repeated; or errors of reading and compiling.
    pub(super) async fn settle(&mut self) -> Result<bool, Error> {
        let mut changed = false;
        if self.list.is_none()
            && let Fit::Refused(why) = Box::pin(self.fit()).await?
        {
            return Err(Error::Scene(why));
        }
        while let Some(shape) = self.list.filter(|_| !self.repeat.sufficed) {
            let seen = self.seen().await?;
            let more = self.more(shape, seen.longest);
            // These are rare, and boxed because every read awaits them. What a repetition heals comes before what nothing heals.
            if let (Some(row), Some(more)) = (seen.overflown, more) {
                Box::pin(self.again(shape, row, seen.longest, more)).await?;
                changed = true;
                continue;
            }
            let fit = Box::pin(self.fit()).await?;
            if let Fit::Not(change) = fit {
                Box::pin(self.again_in_new_box(change)).await?;
                changed = true;
                continue;
            }
            if let Some(row) = seen.overflown {
                return Err(self.full(shape, row, seen.longest));
            }
            let ample = f64::from(seen.longest) <= AMPLE * f64::from(shape.capacity);
            let room = match fit {
                Fit::Refused(why) => return Err(Error::Scene(why)),
                Fit::Soon => Some(Room::Box(Change::default())),
                _ => more.filter(|_| !ample).map(Room::Neighbors),
            };
            let room = room.or_else(|| self.better_skin(shape, seen.builds).map(Room::Skin));
            // What still suffices ends no run: where the device has no room for more, or something else is wrong, it is left unchanged.
            match room {
                Some(room) if self.is_quiet().await? => {
                    self.repeat.from = None;
                    match Box::pin(self.grow(room)).await {
                        Ok(()) => changed = true,
                        // A skin was good enough that is kept.
                        Err(Error::Limit(_) | Error::OutOfMemory(_) | Error::Scene(_))
                            if matches!(room, Room::Skin(_)) =>
                        {
                            self.repeat.sufficed = true;
                            return Ok(changed);
                        }
                        Err(Error::Limit(_) | Error::OutOfMemory(_)) => {
                            self.repeat.sufficed = true;
                            return Ok(changed);
                        }
                        Err(why) => return Err(why),
                    }
                }
                _ => {
                    (self.repeat.from, self.repeat.sufficed) = (None, true);
                    return Ok(changed);
                }
            }
        }
        Ok(changed)
    }
    /// Whether the list had room for all neighbours.
    pub(super) async fn list_sufficed(&mut self) -> Result<bool, Error> {
        Ok(self.list.is_none() || self.seen().await?.overflown.is_none())
    }
    /// Restores the copy, makes room for `more` neighbours, and repeats the steps since.
    async fn again(&mut self, shape: ListShape, row: u32, longest: u32, more: u32) -> Result<(), Error> {
        let full = self.full(shape, row, longest);
        let Some(from) = self.repeat.from.take() else { return Err(full) };
        self.backend.restore()?;
        (self.steps, self.begun) = (from.steps, from.begun);
        // The copied state may itself have lacked neighbours.
        let before = self.seen().await?;
        let grown = if before.overflown.is_some() { Err(full) } else { self.grow(Room::Neighbors(more)).await };
        if let Err(why) = grown {
            // Each later check finds the overflow again.
            self.backend.write(LIST_STATE, &Array::Uint(vec![1, 1, longest, !row]))?;
            let lacks = matches!(why, Error::Limit(_) | Error::OutOfMemory(_));
            return Err(if lacks { self.full(shape, row, longest) } else { why });
        }
        self.repeat_steps(from.since)
    }
    /// Makes this many steps again.
    pub(super) fn repeat_steps(&mut self, steps: Option<u64>) -> Result<(), Error> {
        let mut left = steps;
        while let Some(steps) = left {
            let some = u32::try_from(steps).unwrap_or(u32::MAX);
            self.step(some)?;
            left = Some(steps - u64::from(some)).filter(|left| *left > 0);
        }
        Ok(())
    }
    /// Whether a check would report no failure.
    async fn is_quiet(&mut self) -> Result<bool, Error> {
        let alarm = self.alarm().await?;
        Ok(self.sound(&alarm).is_ok() && alarm[3] == u32::MAX)
    }
    async fn seen(&mut self) -> Result<Seen, Error> {
        let state = self.backend.read(LIST_STATE, &Array::Uint(Vec::new()), LIST_STATE_WORDS).await?;
        Ok(match u32::view(&state).map(Vec::as_slice) {
            Some([_, builds, longest, full]) => {
                Seen { builds: *builds, longest: *longest, overflown: (*full > 0).then_some(!full) }
            }
            _ => Seen { builds: 0, longest: 0, overflown: None },
        })
    }
    fn full(&self, shape: ListShape, row: u32, longest: u32) -> Error {
        Error::ListFull { particle: self.named(row), longest, capacity: shape.capacity, reach: shape.reach() }
    }
    /// A larger capacity for a list in which a particle had `longest` neighbours: 1.5 times that, but at most twice the previous capacity,
    /// since steps that lack neighbours drive particles together; `None` where the device cannot hold more.
    fn more(&self, shape: ListShape, longest: u32) -> Option<u32> {
        let rows = self.capacity();
        let machine = self.backend.machine();
        let wanted = shape.with_room(longest, rows).capacity.min(shape.capacity.saturating_mul(2));
        let others = rows.saturating_sub(1).max(1).div_ceil(4).saturating_mul(4);
        let turns = machine.turns / (2 + shape.words);
        let layers = machine.workgroups.saturating_mul(4);
        let most = others.min(turns).min(layers).min(bindable(shape, u64::from(rows), machine.bindable));
        let more = wanted.max(shape.capacity.saturating_add(4)).min(most / 4 * 4);
        (more > shape.capacity).then_some(more)
    }
}

/// The number of neighbours per row, with their history, that a list of `rows` rows holds in `bytes` bytes; 0 bytes: no limit.
fn bindable(shape: ListShape, rows: u64, bytes: u64) -> u32 {
    if bytes == 0 {
        return u32::MAX;
    }
    let words = bytes / 4;
    let listed = (words / rows.max(1)).saturating_sub(FOUR);
    let remembered = if shape.words == 0 { u64::MAX } else { words / (2 * rows * u64::from(shape.words)).max(1) };
    u32::try_from(listed.min(remembered)).unwrap_or(u32::MAX)
}
