//! The skin of a neighbour list for which no law names one: a simulation chooses it by how often the list was built. Pairs in range are the
//! same by any skin, and so are the bits of all results.

use super::Simulation;
use crate::kernel::{Backend, ListShape};
use crate::neighbors::LIST;
use crate::visit;

/// The time of a build, in evaluations of a law over all pairs within range and skin: on lavapipe some 8 for a Lennard-Jones liquid of 32 000
/// atoms, and 16 for 2000.
const BUILD: f64 = 12.0;
/// Steps before a choice, and before it is judged; each further one has seen twice as many.
const FIRST: u64 = 256;
/// How much longer another choice waits after one that was wrong.
const PATIENCE: u64 = 8;
/// A skin is exchanged where another should take less than this part of the time: new kernels must be compiled for it.
const WORTH: f64 = 0.93;
/// The smallest skin, as a part of the range.
const SMALLEST: f64 = 0.02;

/// What is known of the list since it has had its skin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Watched {
    /// The step since which.
    since: u64,
    /// Steps before the next choice, and before that behind a wrong one.
    wait: u64,
    patience: u64,
    /// Steps between two builds in the mean, as last seen; 0 where that is not known.
    every: f64,
    /// The skin before, and the time that it took.
    before: Option<(f64, f64)>,
}

impl Watched {
    /// Nothing yet.
    pub fn from(since: u64) -> Self {
        Self { since, wait: FIRST, patience: FIRST, every: 0.0, before: None }
    }
    /// The same for buffers that are made anew at this step.
    pub fn after(self, since: u64) -> Self {
        Self { since, ..self }
    }
    /// Another skin after so many steps with this one, and how long to wait for the next choice.
    fn choose(&mut self, steps: u64, seen: Seen, shape: ListShape) -> Option<f64> {
        self.wait = steps.saturating_mul(2);
        let now = seen.time(shape, shape.skin);
        // What it was chosen for may not have come: what only trembles builds no list with a large skin, and many with a small one.
        if let Some((skin, _)) = self.before.take().filter(|(_, time)| *time < now) {
            self.patience = self.patience.saturating_mul(PATIENCE);
            self.wait = self.patience;
            return Some(skin);
        }
        let chosen = seen.best(shape)?;
        (self.before, self.wait) = (Some((shape.skin, now)), FIRST);
        Some(chosen)
    }
}

/// The list of a simulation, as a report names it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ListReport {
    /// The longest range of the laws over it \[length\].
    pub range: f64,
    /// The skin beyond the range \[length\].
    pub skin: f64,
    /// Whether the simulation has chosen the skin while it ran.
    pub chosen: bool,
    /// Steps between two builds in the mean; 0 where that is not known.
    pub every: f64,
}

impl<B: Backend> Simulation<B> {
    /// The skin of the neighbour list, and how often the list was built, as of the last check; `None` where no law is over one.
    #[doc(hidden)]
    #[must_use]
    pub fn neighbor_list(&self) -> Option<ListReport> {
        let chosen = self.problem.skin.is_some();
        self.list.map(|ListShape { range, skin, .. }| ListReport { range, skin, chosen, every: self.skin.every })
    }
    /// Another skin, where no law names one and steps are to be faster by it.
    pub(super) fn better_skin(&mut self, shape: ListShape, builds: u32) -> Option<f64> {
        let steps = self.steps.saturating_sub(self.skin.since);
        if steps == 0 || builds == 0 {
            return None;
        }
        self.skin.every = steps as f64 / f64::from(builds);
        if !shape.tuned || self.problem.elastic.is_some() || steps < self.skin.wait {
            return None;
        }
        let laws = self.plans.step.steps().filter(|kernel| !visit::is_list(kernel) && kernel.names(LIST)).count();
        let seen = Seen {
            evaluations: self.skin.every * laws.max(1) as f64,
            dimensions: f64::from(self.problem.bounds.dimensions),
        };
        self.skin.choose(steps, seen, shape)
    }
}

/// What a list was used for.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Seen {
    /// Evaluations of laws between two builds in the mean.
    evaluations: f64,
    dimensions: f64,
}

impl Seen {
    /// The time of an evaluation with another skin s, (R + s)ᵈ (1 + [`BUILD`] / n): n is the number of evaluations between builds, proportional
    /// to the skin, and at least 1.
    fn time(self, ListShape { range, skin, .. }: ListShape, other: f64) -> f64 {
        let between = (self.evaluations * other / skin).max(1.0);
        (range + other).powf(self.dimensions) * (1.0 + BUILD / between)
    }
    /// The skin for the least of that, if it is worth it. Where particles are so fast that a list is built in each evaluation, that is the smallest.
    fn best(self, shape: ListShape) -> Option<f64> {
        let (d, c) = (self.dimensions, BUILD * shape.skin / self.evaluations);
        // Where the derivative is 0: d s² + (d − 1) c s − c R = 0.
        let b = (d - 1.0) * c;
        let smallest = SMALLEST * shape.range;
        let root = (((b * b + 4.0 * d * c * shape.range).sqrt() - b) / (2.0 * d)).max(smallest);
        let time = |skin: f64| self.time(shape, skin);
        let chosen = if time(smallest) < time(root) { smallest } else { root };
        (time(chosen) < WORTH * time(shape.skin)).then_some(chosen)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape(skin: f64) -> ListShape {
        ListShape { range: 2.5, skin, words: 0, exclude: 0, tuned: true, capacity: 4 }
    }
    fn best(skin: f64, evaluations: f64, dimensions: f64) -> Option<f64> {
        Seen { evaluations, dimensions }.best(shape(skin))
    }

    #[test]
    fn a_skin_that_is_worse_than_the_one_before_goes() {
        let seen = |evaluations| Seen { evaluations, dimensions: 3.0 };
        let mut watched = Watched::from(0);
        // Nothing has moved so far; then each list lasts for eight steps.
        let small = watched.choose(256, seen(256.0), shape(0.5)).expect("a smaller one");
        assert!(small < 0.25 && watched.wait == FIRST);
        assert_eq!(watched.choose(FIRST, seen(8.0), shape(small)), Some(0.5));
        assert_eq!(watched.wait, PATIENCE * FIRST);
        // Another try is judged soon, too, and the next one waits longer.
        assert_eq!(watched.choose(watched.wait, seen(2048.0), shape(0.5)).map(|skin| skin < small), Some(true));
        assert_eq!(watched.wait, FIRST);
        assert_eq!(watched.choose(FIRST, seen(2.0), shape(0.5 * small)), Some(0.5));
        assert_eq!(watched.wait, PATIENCE * PATIENCE * FIRST);
        // One that keeps its promise stays.
        let mut watched = Watched::from(0);
        let small = watched.choose(256, seen(256.0), shape(0.5)).expect("a smaller one");
        assert_eq!(watched.choose(FIRST, seen(256.0 * small / 0.5), shape(small)), None);
        assert_eq!(watched.wait, 2 * FIRST);
    }
    #[test]
    fn it_takes_the_least_time() {
        for dimensions in [2.0, 3.0] {
            for (skin, evaluations) in [(0.5, 200.0), (0.5, 3000.0), (0.1, 2.0), (0.05, 4.0), (1.0, 1.0)] {
                let chosen = best(skin, evaluations, dimensions).expect("another skin");
                let between = |s: f64| (evaluations * s / skin).max(1.0);
                let time = |s: f64| (2.5 + s).powf(dimensions) * (1.0 + BUILD / between(s));
                for other in (1..=200).map(|i| 0.05 + (1.5 - 0.05) * f64::from(i) / 200.0) {
                    assert!(time(chosen) <= time(other) * (1.0 + 1e-12), "{skin} {evaluations}: {chosen} and {other}");
                }
                assert!(time(chosen) < WORTH * time(skin));
            }
        }
    }
    #[test]
    fn a_skin_that_is_good_enough_stays() {
        // What it would choose, and what is close to that.
        let chosen = best(0.5, 500.0, 3.0).expect("another skin");
        for part in [0.8, 1.0, 1.25] {
            // As many evaluations as a skin of that size has.
            assert_eq!(best(part * chosen, 500.0 * part * chosen / 0.5, 3.0), None);
        }
    }
    #[test]
    fn what_stands_still_and_what_is_fast_have_the_smallest() {
        // The list is built almost never, or in each evaluation.
        for (evaluations, dimensions) in [(1e9, 3.0), (1e9, 2.0), (1.0, 3.0)] {
            assert_eq!(best(0.5, evaluations, dimensions), Some(SMALLEST * 2.5));
        }
    }
}
