//! The skin of a neighbour list for which no law names one: a simulation chooses it by how often the list was built. Pairs in range are the
//! same by any skin, and so are the bits of all results.

use super::Simulation;
use crate::kernel::{Backend, Kernel, ListShape};
use crate::visit;

/// The time of a build, in evaluations of a law over all pairs within range and skin. On lavapipe it is 4 to 7 for a Lennard-Jones liquid.
const BUILD: f64 = 5.0;
/// Steps before the first choice; each further one has seen twice as many.
const FIRST: u64 = 256;
/// A skin is exchanged where another takes less than this part of the time: new kernels must be compiled for it.
const WORTH: f64 = 0.93;
/// The smallest skin, as a part of the range.
const SMALLEST: f64 = 0.02;

/// What is known of the list since it has had its skin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Watched {
    /// The step since which.
    since: u64,
    /// Steps before the next choice.
    wait: u64,
    /// Steps between two builds in the mean, as last seen; 0 where that is not known.
    every: f64,
}

impl Watched {
    /// Nothing yet.
    pub fn from(since: u64) -> Self {
        Self { since, wait: FIRST, every: 0.0 }
    }
    /// The same for buffers that are made anew at this step.
    pub fn after(self, since: u64) -> Self {
        Self { since, ..self }
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
        self.skin.wait = 2 * steps;
        let is_list = |kernel: &&Kernel| kernel.tables.iter().any(|(name, _)| name == visit::LIST_ALL);
        let evaluations = self.plans.step.steps().filter(is_list).count();
        best(shape, self.skin.every * evaluations as f64, f64::from(self.problem.bounds.dimensions))
    }
}

/// The skin for the least time of an evaluation, (R + s)ᵈ (1 + [`BUILD`] / n), if that is worth it. n is the number of evaluations between
/// builds, proportional to the skin s, and at least 1: where particles are so fast the smallest skin may be the best.
fn best(ListShape { range, skin, .. }: ListShape, evaluations: f64, dimensions: f64) -> Option<f64> {
    let (d, c) = (dimensions, BUILD * skin / evaluations);
    let low = SMALLEST * range;
    // Where the derivative is 0: d s² + (d − 1) c s − c R = 0.
    let b = (d - 1.0) * c;
    let root = (((b * b + 4.0 * d * c * range).sqrt() - b) / (2.0 * d)).max(low);
    let time = |skin: f64| (range + skin).powf(d) * (1.0 + (c / skin).min(BUILD));
    let chosen = if time(low) < time(root) { low } else { root };
    (time(chosen) < WORTH * time(skin)).then_some(chosen)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape(skin: f64) -> ListShape {
        ListShape { range: 2.5, skin, tuned: true, words: 0, capacity: 4 }
    }

    #[test]
    fn it_takes_the_least_time() {
        for dimensions in [2.0, 3.0] {
            for (skin, evaluations) in [(0.5, 200.0), (0.5, 3000.0), (0.1, 2.0), (0.05, 4.0), (1.0, 1.0)] {
                let chosen = best(shape(skin), evaluations, dimensions).expect("another skin");
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
        let chosen = best(shape(0.5), 200.0, 3.0).expect("another skin");
        for part in [0.8, 1.0, 1.25] {
            // As many evaluations as a skin of that size has.
            let evaluations = 200.0 * part * chosen / 0.5;
            assert_eq!(best(shape(part * chosen), evaluations, 3.0), None);
        }
    }
    #[test]
    fn what_stands_still_and_what_is_fast_have_the_smallest() {
        // The list is built almost never, or in each evaluation.
        for (evaluations, dimensions) in [(1e9, 3.0), (1e9, 2.0), (1.0, 3.0)] {
            assert_eq!(best(shape(0.5), evaluations, dimensions), Some(SMALLEST * 2.5));
        }
    }
}
