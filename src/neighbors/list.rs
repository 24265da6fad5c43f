//! The list of neighbours within range + skin: its fields, and its f64 reference.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DVec3, DVec4, Vec4};
use rayon::prelude::*;

use super::{Cells, Grid, checked};
use crate::error::Error;
use crate::kernel::{Bounds, Host, ListShape, POSITION, Problem, Side, Table, World};
use crate::links::Exclusions;

/// Rows of neighbours, four per element: see `shaders/neighbors/list_search.wgsl`.
pub const LIST: &str = "list";
/// Whether it must be rebuilt, the number of builds, the largest number of neighbours of a particle, and the complement of the lowest row
/// with more than there is room for: see `shaders/neighbors/list_state.wgsl`.
pub const LIST_STATE: &str = "list_state";
/// The words of that.
pub const LIST_STATE_WORDS: usize = 4;
/// The positions when it was built.
pub const LIST_ORIGIN: &str = "list_origin";
/// History of pairs, word by word: see `shaders/neighbors/history.wgsl`.
pub const HISTORY: &str = "history";
/// The start of the row of each particle in the table of those that the list leaves out.
pub const EXCLUDED_START: &str = "excluded_start";
/// That table.
pub const EXCLUDED: &str = "excluded";
/// No particle.
pub(crate) const NONE: u32 = u32::MAX;

/// A cell is wider than the reach by this part: then the search for neighbours misses none within the reach, measured between positions as
/// stored.
const WIDER: f64 = 1.0 / 256.0;
/// The part of the largest coordinate in a periodic box that its rounding may add to a distance: sixteen units in the last place.
const ROUNDING: f64 = 1.0 / 1_048_576.0;
/// The part of a range that rounding may add to it: its square is a sum of three, each rounded three times.
const SQUARE: f64 = 1.0 / 65_536.0;

/// The pairs that the list of a host leaves out: those of all laws over it.
///
/// # Errors
/// When a table is missing.
pub fn exclusions(host: &Host) -> Result<Exclusions, Error> {
    if !host.contains(EXCLUDED_START) {
        return Ok(Exclusions::default());
    }
    let [start, others] = [EXCLUDED_START, EXCLUDED].map(|name| host.reading::<u32>(name).map(|words| words.to_vec()));
    Ok(Exclusions { start: Arc::new(start?), others: Arc::new(others?) })
}

/// A list of neighbours in a problem.
pub struct List {
    /// Its reach, and its capacity.
    pub shape: ListShape,
    /// The grid with which it is built.
    pub grid: Grid,
    /// Pairs that it leaves out.
    pub exclusions: Option<Exclusions>,
}

/// A length in single precision, as on the device: what is computed from given numbers has more digits than they had.
fn shown(length: f64) -> String {
    #[expect(clippy::cast_possible_truncation, reason = "rounded to be read")]
    let single = length as f32;
    format!("{single:?}")
}

impl List {
    /// The list of such a shape.
    ///
    /// # Errors
    /// [`Error::Scene`] when the range or the skin is invalid.
    pub fn new(shape: ListShape, problem: &Problem) -> Result<Self, Error> {
        checked(shape.range)?;
        if !(shape.skin >= 0.0 && shape.skin.is_finite()) {
            return Err(Error::Scene(format!(
                "a list of neighbours has a skin of {}: it must be 0 or above",
                shape.skin
            )));
        }
        checked(shape.reach())?;
        let rounding = ROUNDING * coordinate(&problem.bounds);
        let grid = Grid::new(shape.reach() * (1.0 + WIDER) + rounding, None, problem)?;
        let grid = Grid { name: format!("the list {}", shown(shape.reach())), ..grid };
        Ok(Self { shape, grid, exclusions: None })
    }
    /// The same without the pairs that bonds of a problem leave out.
    ///
    /// # Errors
    /// [`Error::Scene`] when they are too many.
    pub fn excluding(self, problem: &Problem) -> Result<Self, Error> {
        let all = || Exclusions::new(&problem.network, self.shape.exclude, problem.capacity);
        Ok(Self { exclusions: (self.shape.exclude > 0).then(all).transpose()?, ..self })
    }
    /// The tables of the pairs that it leaves out, which references of laws read, too.
    #[must_use]
    pub fn tables(&self) -> Vec<Table> {
        let all = self.exclusions.iter().flat_map(|all| [(EXCLUDED_START, &all.start), (EXCLUDED, &all.others)]);
        all.map(|(name, words)| (name.into(), words.clone())).collect()
    }
    /// Its name in a plan.
    #[must_use]
    pub fn title(&self) -> String {
        let ListShape { range, skin, words, capacity, exclude, .. } = self.shape;
        let (range, skin) = (shown(range), shown(skin));
        let words = if words > 0 { format!(" WORDS={words}") } else { String::new() };
        let excluded = if exclude > 0 { format!(" EXCLUDE={exclude}") } else { String::new() };
        format!("list RANGE={range} SKIN={skin} CAPACITY={capacity}{words}{excluded}")
    }
    /// The distance that a particle may move before the list must be rebuilt \[length\].
    #[must_use]
    pub fn limit(&self) -> f64 {
        (0.5 * self.shape.skin - SQUARE * self.shape.reach()).max(0.0)
    }
    /// Elements of four words for `count` particles: a head for each, and its neighbours.
    #[must_use]
    pub fn elements(&self, count: u32) -> u64 {
        u64::from(count) * (1 + u64::from(self.shape.capacity) / 4)
    }
    /// The index of the n-th neighbour in row k, in words.
    pub(crate) fn place(row: usize, n: usize, count: usize) -> usize {
        4 * ((1 + n / 4) * count + row) + n % 4
    }

    /// The index of a word of history: of the n-th neighbour in row k, in one of two halves.
    pub(crate) fn word([row, n, half, word]: [usize; 4], slots: usize, count: usize) -> usize {
        ((2 * n + half) * slots + word) * count + row
    }
    /// Words of history for `count` particles.
    #[must_use]
    pub fn words(&self, count: u32) -> u64 {
        2 * u64::from(count) * u64::from(self.shape.capacity) * u64::from(self.shape.words)
    }
    /// The history of pairs, by both rows, at the start of this step; a row that was reassigned to another particle has none.
    fn remembered(
        &self,
        list: &[u32],
        history: &[f64],
        world: &World,
        stayed: impl Fn(u32) -> bool,
    ) -> BTreeMap<[u32; 2], Vec<f64>> {
        let (count, slots, half) = (world.capacity() as usize, self.shape.words as usize, (world.step & 1) as usize);
        let mut pairs = BTreeMap::new();
        for (k, head) in list.chunks_exact(4).take(world.count as usize).enumerate() {
            for n in 0..head[0].min(self.shape.capacity) as usize {
                let word = |w: usize| history.get(Self::word([k, n, half, w], slots, count)).copied().unwrap_or(0.0);
                if let Some(other) =
                    list.get(Self::place(k, n, count)).filter(|other| stayed(head[1]) && stayed(**other))
                {
                    pairs.insert([head[1], *other], (0..slots).map(word).collect());
                }
            }
        }
        pairs
    }

    /// The reference: checks whether a particle has moved too far, and if so, finds the neighbours of each by brute force.
    ///
    /// # Errors
    /// When a field is missing.
    pub fn update(&self, host: &Host) -> Result<bool, Error> {
        let (position, is_active, bounds) = (host.read(POSITION)?, host.is_active()?, host.world().bounds);
        let count = (host.world().count as usize).min(position.len());
        let places: Vec<DVec3> = position[..count].iter().map(|x| x.truncate()).collect();
        let mut origin = host.writing::<Vec4>(LIST_ORIGIN)?;
        let mut state = host.writing::<u32>(LIST_STATE)?;
        let [_, builds, longest, full] = &mut state[..] else { return Ok(false) };
        let moved = |i: usize| {
            let from = origin[i];
            is_active(i) != (from.w > 0.0) || is_active(i) && self.has_moved(places[i], from, &bounds)
        };
        if *builds > 0 && !(0..count).any(moved) {
            return Ok(false);
        }
        *builds = builds.wrapping_add(1);
        let order = Cells::sort(&self.grid, bounds, places.iter().copied(), &is_active, |_| false).ids;
        let reach = self.shape.reach();
        let around = |id: &u32| -> Vec<u32> {
            let i = *id as usize;
            let near = |j: &u32| {
                let other = *j as usize;
                other != i && is_active(other) && bounds.within(places[other] - places[i], reach)
            };
            (0..u32::try_from(count).unwrap_or(u32::MAX)).filter(near).collect()
        };
        let rows: Vec<Vec<u32>> = order.par_iter().map(around).collect();
        let mut list = host.writing::<u32>(LIST)?;
        let slots = self.shape.words as usize;
        let mut history = (slots > 0).then(|| host.writing::<f32>(HISTORY)).transpose()?;
        // There is no list before the first.
        let before = history.as_ref().filter(|_| *builds > 1);
        let stayed = |row: u32| origin.get(row as usize).is_some_and(|from| from.w > 0.0);
        let known = before.map(|history| self.remembered(&list, history, &host.world(), stayed)).unwrap_or_default();
        let stride = host.world().capacity() as usize;
        let half = (host.world().step & 1) as usize;
        for k in 0..count {
            let (id, row) = order.get(k).zip(rows.get(k)).map_or((NONE, &[][..]), |(id, row)| (*id, row));
            // A row without enough room is empty: the run ends with an error that names its particle.
            let fits = row.len() <= self.shape.capacity as usize;
            let excluded =
                |other: u32| self.exclusions.as_ref().is_some_and(|all| all.has(id as usize, other as usize));
            let listed = |other: &&u32| fits && !excluded(**other);
            let kept: Vec<u32> = row.iter().filter(listed).copied().collect();
            let number = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
            list[4 * k..4 * k + 4].copy_from_slice(&[number(kept.len()), id, 0, 0]);
            // On the device those that leave the row have stood in it, too, and what is behind its end stays.
            for (n, other) in row.iter().enumerate().filter(|_| fits) {
                list[Self::place(k, n, stride)] = *other;
            }
            for (n, other) in kept.iter().enumerate() {
                list[Self::place(k, n, stride)] = *other;
                let pair = known.get(&[id, *other]);
                for w in 0..slots {
                    let value = pair.map_or(0.0, |words| words[w]);
                    history.iter_mut().for_each(|all| all[Self::word([k, n, half, w], slots, stride)] = value);
                }
            }
            *longest = number(row.len()).max(*longest);
            if !fits {
                *full = (!id).max(*full);
            }
            let side = if self.grid.elastic { bounds.period().x } else { 1.0 };
            origin[k] = places[k].extend(side * f64::from(u8::from(is_active(k))));
        }
        Ok(true)
    }
    /// Whether a displacement exceeds the limit of the list, by the device's own arithmetic.
    #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
    fn has_moved(&self, x: DVec3, origin: DVec4, bounds: &Bounds) -> bool {
        let mut limit = self.limit() as f32;
        let mut from = origin.truncate();
        if self.grid.elastic {
            let (low, part) = (bounds.low.as_vec3(), bounds.period().x as f32 / origin.w as f32);
            let with_box = (low + part * (from.as_vec3() - low)).as_dvec3();
            from = DVec3::select(bounds.period().cmpgt(DVec3::ZERO), with_box, from);
            limit += 0.5 * (part - 1.0) * self.shape.reach() as f32;
            if limit <= 0.0 {
                return true;
            }
        }
        if bounds.has(Side::Periodic) {
            limit -= ROUNDING as f32 * x.as_vec3().abs().max(from.as_vec3().abs()).max_element();
        }
        let limit = limit.max(0.0);
        let way = bounds.shortest_single(x - from);
        let square = way.x * way.x + way.y * way.y + way.z * way.z;
        !(x.as_vec3() == from.as_vec3() || square < limit * limit)
    }
}

/// The largest coordinate along a periodic axis; 0 where there is none.
fn coordinate(bounds: &Bounds) -> f64 {
    let size = bounds.low.abs().max(bounds.high.abs()).max(bounds.period());
    (size * bounds.axes(Side::Periodic)).max_element()
}
