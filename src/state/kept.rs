//! Restart data that a step saves for the next one beside columns, so that a run continues from a state with the bits of one that was never
//! stopped: accelerations that the next kick uses, an adaptive clock, where kinematic particles began, springs that broke.

use std::borrow::Cow;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

use super::State;
use crate::kernel::{Array, LIFE, extent};
use crate::life::Life;
use crate::links::{Link, Links};
use crate::motion::Held;

/// The prefix of their names in files; no column name may begin with it.
pub(crate) const KEPT: &str = "kept_";

/// The lowest and the highest corner of the particles at the start of the run: it determines the cells, and so the order of sums.
pub(crate) const EXTENT: &str = "kept_extent";

/// A hash of the step that made a state, in two words.
pub(crate) const STEP: &str = "kept_step";

/// Restart data that stays valid when a caller changes positions or velocities.
const LASTING: [&str; 5] = [HOME, BROKEN, PAIRS, PAIR_WORDS, "kept_step_clock"];

/// The number of rows in use when the plan was written, which also determines the cells.
pub(crate) const ROWS: &str = "kept_rows";
/// The neighbour counts at the start of the run, which determine the searches: ranges and means.
pub(crate) const NEIGHBORS: &str = "kept_neighbors";
/// The number of neighbours per particle that a list has room for: set by a simulation that grows, never in a state that it returns.
pub(crate) const ROOM: &str = "kept_room";
/// The skin of its list, where a simulation has chosen it \[length\]: likewise.
pub(crate) const SKIN: &str = "kept_skin";
/// The part of the sides of a box for which cells are to be wide enough: likewise.
pub(crate) const PART: &str = "kept_part";
/// The multiple of its sides for which there are to be waves enough: likewise.
pub(crate) const MOST: &str = "kept_most";
/// The sides of a box at the start of the run, where a barostat changes it.
pub(crate) const SIDES: &str = "kept_sides";

/// The next unused id, in files.
#[cfg(feature = "scene")]
pub(crate) const NEXT: &str = "kept_next_id";

/// The history of pairs: the rows of both, and their words.
pub(crate) const PAIRS: &str = "kept_pairs";
/// The number of words of each pair.
pub(crate) const PAIR_WORDS: &str = "kept_pair_words";

/// The positions of fixed particles at time 0, in groups of seven numbers: the id, that position, and the present one.
pub(crate) const HOME: &str = "kept_home";
/// Springs that have broken, in groups of three numbers: the ids of the two, and the rest length, negative for a rope.
pub(crate) const BROKEN: &str = "kept_broken";

/// Lists of numbers by their names, each of which begins with [`KEPT`].
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Kept(BTreeMap<String, Vec<f64>>);

impl Kept {
    /// The numbers of a name.
    pub fn get(&self, name: &str) -> Option<&[f64]> {
        self.0.get(name).map(Vec::as_slice)
    }
    /// Stores numbers; an empty list is not stored.
    pub fn put(&mut self, name: impl Into<String>, numbers: Vec<f64>) {
        let name = name.into();
        if numbers.is_empty() {
            self.0.remove(&name);
        } else {
            self.0.insert(name, numbers);
        }
    }
    /// All of them, in the order of their names.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &[f64])> {
        self.0.iter().map(|(name, numbers)| (name.as_str(), numbers.as_slice()))
    }
    /// Removes all data.
    pub fn clear(&mut self) {
        self.0.clear();
    }
    /// Removes the data that depends on the earlier positions and velocities.
    pub fn touched(&mut self) {
        self.0.retain(|name, _| LASTING.contains(&name.as_str()));
    }
}

impl State {
    /// The same particles at time 0 and step 0, from which a simulation starts over: kinematic particles, births, random numbers and
    /// forces that depend on time begin again, and nothing is left of what the last step kept for the next one. Columns stay as they are,
    /// those of an integrator or a solver too.
    #[must_use]
    pub fn begin_anew(mut self) -> Self {
        (self.time, self.step) = (0.0, 0);
        self.kept.clear();
        self
    }
    /// Whether it holds the restart data of a step, as states do that simulations give, until they are changed, and as NPZ
    /// archives hold them; tables do not.
    #[must_use]
    pub fn keeps(&self) -> bool {
        self.kept.get(STEP).is_some()
    }
    /// Continues from another state of the same particles: takes its columns, its clock, and its restart data. Data that only this state
    /// has is kept: links, except broken springs, fixed particles, motions, births, drains, and columns that the other does not give.
    ///
    /// # Errors
    /// [`Error::Scene`](crate::Error::Scene) when the other has another number of particles, or a column of another kind.
    pub fn go_on_from(&mut self, other: &Self) -> Result<(), crate::Error> {
        if other.len() != self.len() {
            return Err(crate::Error::Scene(format!(
                "the state has {} particles, and the run that goes on from it {}: give the state of a run of the same scene, with \
                 the same values set",
                other.len(),
                self.len()
            )));
        }
        self.origin(other);
        let origin = std::mem::take(&mut self.kept);
        // Files hold no life column where all particles are active, and states of runs in which some come or go do.
        let has_life = self.get(LIFE.name).is_some() || !self.births.is_empty() || !self.drains.is_empty();
        if other.get(LIFE.name).is_none() && has_life {
            self.set(LIFE.name, Array::Uint(vec![Life::Active.word(); self.len()]))?;
        }
        for (column, values) in other.columns() {
            self.declare(column)?;
            self.set(&column.name, values.clone())?;
        }
        (self.time, self.step) = (other.time, other.step);
        self.kept = other.kept.clone();
        for (name, numbers) in origin.iter().filter(|(name, _)| other.kept.get(name).is_none()) {
            self.kept.put(name, numbers.to_vec());
        }
        let named = |link: &Link| (link.ends, link.rest.to_bits());
        let broken: BTreeSet<_> = self.broken().iter().map(named).collect();
        self.links.springs.retain(|link| !broken.contains(&named(link)));
        Ok(())
    }
    /// Stores the extent of the particles and the initial positions of fixed ones, for a run that continues from another state of them, if
    /// this state is at the start.
    fn origin(&mut self, other: &Self) {
        if self.step > 0 || self.time > 0.0 || self.kept.get(EXTENT).is_some() {
            return;
        }
        let places = self.position();
        let (low, high) = extent(places);
        let seven = |one: &Held| {
            let id = one.id as usize;
            let (home, here) = (places.get(id)?.to_array(), other.position().get(id)?.to_array());
            Some([&[f64::from(one.id)][..], &home, &here].concat())
        };
        let homes = self.held.iter().filter_map(seven).flatten().collect();
        self.kept.put(EXTENT, low.to_array().into_iter().chain(high.to_array()).collect());
        self.kept.put(HOME, homes);
    }
    /// The history of pairs, by the rows of both: the words of each. None where no law keeps any, and before the first step.
    pub fn pair_history(&self) -> impl Iterator<Item = ([usize; 2], &[f64])> {
        let width = self.kept.get(PAIR_WORDS).and_then(|list| list.first()).copied().unwrap_or(0.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let whole = |x: f64| x as usize;
        let groups = self.kept.get(PAIRS).unwrap_or_default().chunks_exact(whole(width).saturating_add(2));
        groups.map(move |group| ([whole(group[0]), whole(group[1])], &group[2..]))
    }
    /// The springs that have broken, without stiffness and damping.
    fn broken(&self) -> Vec<Link> {
        let ids = 0.0..self.len() as f64;
        let groups = self.kept.get(BROKEN).unwrap_or_default().chunks_exact(3);
        let groups = groups.filter(|group| ids.contains(&group[0]) && ids.contains(&group[1]) && group[2].is_finite());
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the ids")]
        let link = |group: &[f64]| Link {
            ends: [group[0] as u32, group[1] as u32],
            rest: group[2].abs(),
            stiffness: 0.0,
            damping: 0.0,
            rope: group[2].is_sign_negative(),
        };
        groups.map(link).collect()
    }
    /// The links including broken springs, which stay in the tables of kernels: the number of springs at an end matters.
    pub(crate) fn all_links(&self) -> Cow<'_, Links> {
        let broken = self.broken();
        if broken.is_empty() {
            return Cow::Borrowed(&self.links);
        }
        let mut links = self.links.clone();
        links.springs.extend(broken);
        Cow::Owned(links)
    }
    /// Stores the springs that have broken since.
    pub(crate) fn keep_broken(&mut self, all: &Links) {
        let mut intact = self.links.springs.iter().peekable();
        let mut broken: Vec<[f64; 3]> = Vec::new();
        for link in &all.springs {
            if intact.next_if(|kept| *kept == link).is_none() {
                let rest = if link.rope { -link.rest } else { link.rest };
                broken.push([f64::from(link.ends[0]), f64::from(link.ends[1]), rest]);
            }
        }
        // In a fixed order, however often the run has been stopped.
        broken.sort_by(|a, b| a.iter().zip(b).map(|(a, b)| a.total_cmp(b)).fold(Ordering::Equal, Ordering::then));
        self.kept.put(BROKEN, broken.concat());
    }
}
