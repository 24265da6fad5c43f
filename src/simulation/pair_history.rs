//! History of pairs in a state: reading and restoring it.
//!
//! A state holds the pairs that have history, by the rows of both. A simulation that begins with them gets a neighbour list that holds no
//! other pairs and is out of date: the first evaluation rebuilds it, and gives history to its pairs, as in every run.

use std::collections::BTreeMap;

use glam::DVec4;

use super::Simulation;
use crate::component::{earlier, numbered};
use crate::error::Error;
use crate::forces::{Component, Law};
use crate::kernel::{Array, Backend, Element, Kernel, ListShape, Plan};
use crate::neighbors::{HISTORY, LIST, LIST_ORIGIN, LIST_STATE, LIST_STATE_WORDS, List, NONE};
use crate::state::{KEPT_PAIR_WORDS, KEPT_PAIRS, State};

/// A position where no particle is: a list built there counts as out of date.
const ELSEWHERE: DVec4 = DVec4::new(1e30, 1e30, 1e30, 1.0);

/// The words of each pair of rows.
pub(super) type Pairs = BTreeMap<[u32; 2], Vec<f64>>;

/// Refuses a law with history of pairs where a step evaluates it more than once: the history of a pair advances by one step with each
/// evaluation, and only the last of these evaluations would count.
///
/// # Errors
/// [`Error::Scene`] with the number of evaluations.
pub(super) fn once(forces: &[Box<dyn Component>], step: &Plan) -> Result<(), Error> {
    let own = forces.iter().enumerate().filter(|(_, force)| force.properties().history);
    for (place, force) in own {
        let name = numbered(force.name(), earlier(forces, place));
        refuse(&name, step.steps().filter(|kernel| kernel.name == name).count())?;
    }
    for (place, force) in forces.iter().enumerate() {
        for law in force.laws().into_iter().filter(Law::remembers) {
            let law = law.after(earlier(forces, place));
            let evaluates = |kernel: &&Kernel| kernel.name == law.name && kernel.names(HISTORY);
            refuse(&law.name, step.steps().filter(evaluates).count())?;
        }
    }
    Ok(())
}

fn refuse(name: &str, evaluations: usize) -> Result<(), Error> {
    if evaluations <= 1 {
        return Ok(());
    }
    Err(Error::Scene(format!(
        "`{name}` keeps history of pairs (slots), and this integrator evaluates forces {evaluations} times in a step, of which only the \
         last would be saved: choose one that evaluates them once, such as leapfrog or symplectic_euler"
    )))
}

/// The largest number of pairs with history of any row of a state.
pub(super) fn longest(state: &State) -> usize {
    let mut rows: BTreeMap<u64, usize> = BTreeMap::new();
    for group in groups(state) {
        *rows.entry(group[0].to_bits()).or_default() += 1;
    }
    rows.into_values().max().unwrap_or(0)
}

/// The number of words of each pair of a state, if it has pairs with history.
pub(super) fn width(state: &State) -> Option<usize> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
    state
        .kept
        .get(KEPT_PAIR_WORDS)
        .and_then(|list| list.first())
        .filter(|words| words.fract() == 0.0)
        .map(|words| *words as usize)
}

/// Two rows and their words, one pair after another.
fn groups(state: &State) -> impl Iterator<Item = &[f64]> {
    let width = width(state).unwrap_or(0).saturating_add(2);
    state.kept.get(KEPT_PAIRS).unwrap_or_default().chunks_exact(width)
}

/// The pairs of a state, for a law with `words` words.
fn pairs(state: &State, words: u32) -> Result<Pairs, Error> {
    let Some(width) = width(state) else {
        return Err(Error::Scene(format!(
            "the state is at step {}, and a law keeps history of pairs (slots), which the state does not contain: continue from an NPZ archive or \
             a snapshot in memory, run it in one go, or use `state.begin_anew()`, which starts without history",
            state.step
        )));
    };
    if width != words as usize {
        return Err(Error::Scene(format!(
            "the state holds {width} numbers for each pair of particles, and the law keeps {words} (slots): take the law that the state was \
             made with, or `state.begin_anew()`"
        )));
    }
    let refuse = |what: &str| {
        let text =
            format!("the state's history of pairs {what}: take the state as it was written, or `state.begin_anew()`");
        Err(Error::Scene(text))
    };
    let count = state.len();
    if state.kept.get(KEPT_PAIRS).is_some_and(|list| list.len() % (width + 2) != 0) {
        return refuse(&format!("is no whole number of pairs of {} numbers each", width + 2));
    }
    let mut pairs = Pairs::new();
    for group in groups(state) {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, and is compared")]
        let rows = [group[0] as u32, group[1] as u32];
        let is_row =
            |(row, number): (&u32, &f64)| f64::from(*row).to_bits() == number.to_bits() && (*row as usize) < count;
        if !rows.iter().zip(group).all(is_row) || rows[0] == rows[1] {
            return refuse(&format!("names the particles {:?}, which are not two of its {count}", &group[..2]));
        }
        if pairs.insert(rows, group[2..].to_vec()).is_some() {
            return refuse(&format!("names the particles {rows:?} twice"));
        }
    }
    Ok(pairs)
}

impl<B: Backend> Simulation<B> {
    /// The list, if a law keeps history of pairs on it.
    pub(super) fn remembering(&self) -> Option<ListShape> {
        self.list.filter(|list| list.words > 0)
    }
    /// Adds the history of pairs to a state.
    pub(super) async fn keep_pairs(&mut self, state: &mut State) -> Result<(), Error> {
        let Some(shape) = self.remembering() else { return Ok(()) };
        let (capacity, rows, words) = (self.capacity() as usize, shape.capacity as usize, shape.words as usize);
        let whole = Array::Uint(Vec::new());
        let list = self.backend.read(LIST, &whole, 4 * capacity * (1 + rows / 4)).await?;
        let history = self.backend.read(HISTORY, &Array::Float(Vec::new()), 2 * capacity * rows * words).await?;
        let origin = self.backend.read(LIST_ORIGIN, &Array::Vec4(Vec::new()), capacity).await?;
        let (Array::Uint(list), Array::Float(history), Array::Vec4(origin)) = (list, history, origin) else {
            return Ok(());
        };
        // A row that has got another particle since has no history.
        let stayed = |row: u32| origin.get(row as usize).is_some_and(|from| from.w > 0.0);
        let half = usize::try_from(state.step & 1).unwrap_or(0);
        let mut pairs = Pairs::new();
        for k in 0..capacity {
            let [length, id] = [list[4 * k], list[4 * k + 1]];
            for n in 0..(length as usize).min(rows) {
                let other = list[List::place(k, n, capacity)];
                let values: Vec<f64> =
                    (0..words).map(|w| history[List::word([k, n, half, w], words, capacity)]).collect();
                if id != NONE && stayed(id) && stayed(other) && values.iter().any(|x| x.to_bits() != 0) {
                    pairs.insert([id, other], values);
                }
            }
        }
        let group = |(rows, values): (&[u32; 2], &Vec<f64>)| [&rows.map(f64::from)[..], values].concat();
        state.kept.put(KEPT_PAIR_WORDS, vec![f64::from(shape.words)]);
        state.kept.put(KEPT_PAIRS, pairs.iter().flat_map(group).collect());
        Ok(())
    }
    /// Restores the history of pairs from a state.
    ///
    /// # Errors
    /// [`Error::Scene`] when the state is not of step 0 and holds no history of pairs, or holds that of other particles.
    pub(super) fn recall_pairs(&mut self, state: &State) -> Result<(), Error> {
        let Some(shape) = self.remembering() else { return Ok(()) };
        if state.step == 0 && width(state).is_none() {
            return Ok(());
        }
        let pairs = pairs(state, shape.words)?;
        let (capacity, rows, words) = (self.capacity() as usize, shape.capacity as usize, shape.words as usize);
        let mut list = vec![0; 4 * capacity * (1 + rows / 4)];
        let mut history = vec![0.0; 2 * capacity * rows * words];
        let half = usize::try_from(state.step & 1).unwrap_or(0);
        for (k, id) in (0..capacity).zip(0..) {
            let mut row = pairs.range([id, 0]..=[id, NONE]).enumerate();
            list[4 * k + 1] = id;
            row.try_for_each(|(n, ([_, other], values))| {
                let last = list.get_mut(List::place(k, n, capacity)).filter(|_| n < rows)?;
                (*last, list[4 * k]) = (*other, u32::try_from(n + 1).unwrap_or(NONE));
                for (w, value) in values.iter().enumerate() {
                    history[List::word([k, n, half, w], words, capacity)] = *value;
                }
                Some(())
            });
        }
        // The list has been built once, and is out of date.
        let mut moved = vec![0; LIST_STATE_WORDS];
        (moved[0], moved[1]) = (1, 1);
        self.backend.write(LIST, &u32::array(list))?;
        self.backend.write(HISTORY, &Array::Float(history))?;
        self.backend.write(LIST_ORIGIN, &Array::Vec4(vec![ELSEWHERE; capacity]))?;
        self.backend.write(LIST_STATE, &Array::Uint(moved))
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn state(words: f64, numbers: &[f64]) -> State {
        let mut state = State::default();
        (0..3).for_each(|k| state.push(DVec3::splat(f64::from(k)), DVec3::ZERO, 1.0, 0.0));
        state.step = 7;
        state.kept.put(KEPT_PAIR_WORDS, vec![words]);
        state.kept.put(KEPT_PAIRS, numbers.to_vec());
        state
    }

    #[test]
    fn pairs_that_make_no_sense_are_refused() {
        let good = [0.0, 2.0, -0.0, f64::NAN, 2.0, 0.0, f64::INFINITY, 5.0];
        let known = pairs(&state(2.0, &good), 2).expect("two pairs");
        assert!(
            known[&[0, 2]][0].is_sign_negative()
                && known[&[0, 2]][1].is_nan()
                && known[&[2, 0]] == [f64::INFINITY, 5.0]
        );
        for (words, numbers, why) in [
            (2.0, &good[..7], "no whole number of pairs"),
            (2.0, &[0.0, 3.0, 1.0, 1.0], "[0.0, 3.0]"),
            (2.0, &[1.0, 1.0, 1.0, 1.0], "[1.0, 1.0]"),
            (2.0, &[0.5, 1.0, 1.0, 1.0], "[0.5, 1.0]"),
            (2.0, &[-0.0, 1.0, 1.0, 1.0], "[-0.0, 1.0]"),
            (2.0, &[0.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0], "[0, 1] twice"),
            (1.0, &[0.0, 1.0, 1.0], "1 numbers for each pair"),
            (1.9, &[0.0, 1.0, 1.0], "does not contain"),
        ] {
            match pairs(&state(words, numbers), 2) {
                Err(Error::Scene(text)) => assert!(text.contains(why), "{why}: {text}"),
                other => panic!("{numbers:?}: {other:?}"),
            }
        }
    }
}
