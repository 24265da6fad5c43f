//! The order parameter of a flock, its neighbours and its clusters.

use std::borrow::Cow;

use glam::DVec3;
use rayon::prelude::*;

use super::series::number;
use super::{Measure, Moment, Row, Series, Times};
use crate::error::Error;
use crate::kernel::Bounds;
use crate::neighbors::Cells;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// `flock.csv`.
pub const MEASURE: Measure = Measure {
    name: "flock",
    about: "order, neighbours and clusters",
    keys: &[
        Key::required("range", Kind::Positive, "the radius within which particles are neighbours [length]"),
        Key::new("species", Kind::Species, Value::Text(Cow::Borrowed("all")), "the species that is measured, or \"all\""),
    ],
    cells: &[
        ("order", "|Σ v / |v|| / N over all that move (Vicsek et al. 1995)"),
        ("speed", "the mean speed [length / time]"),
        ("neighbors", "the mean number of neighbours within range"),
        ("most_neighbors", "the largest number"),
        ("clusters", "sets of particles that are joined by chains of neighbours (friends of friends; Davis et al. 1985)"),
        ("largest_cluster", "the part of all particles that is in the largest of them"),
    ],
    times: Times::Chosen,
    usual: |setup| {
        let radius = setup.forces.iter().find_map(|force| force.properties().statistics_radius);
        Ok(radius.map(|(range, species)| {
            let settings = Settings::defaults(MEASURE.keys).with("range", Value::Number(range));
            match species {
                Some(species) => settings.with("species", Value::Number(species.into())),
                None => settings,
            }
        }))
    },
    begin: |setup, settings| {
        let (range, species) = (settings.number("range"), settings.species("species"));
        Ok(Box::new(Flocks { range, species, bounds: setup.bounds, ends: None }))
    },
};

/// Order, neighbours and clusters of a state: a row of `flock.csv`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Flock {
    /// Steps done.
    pub step: u64,
    /// The time.
    pub time: f64,
    /// |Σ v / |v|| / N over all moving particles: 1 when all velocities are parallel, about 1 / √N for random directions (Vicsek et al.
    /// 1995). 0 when no particle moves.
    pub order: f64,
    /// The mean speed \[length / time\].
    pub speed: f64,
    /// The mean number of neighbours within range.
    pub neighbors: f64,
    /// The maximum number of neighbours within range.
    pub most_neighbors: u32,
    /// Sets of particles that are joined by chains of neighbours (friends of friends; Davis et al. 1985).
    pub clusters: u32,
    /// The fraction of all particles in the largest of them.
    pub largest: f64,
}

/// Particles whose neighbours are in memory at once.
const CHUNK: usize = 16_384;

impl Flock {
    /// Measures a state; its pairs within `range`, and only one species, if these are given.
    ///
    /// # Errors
    /// [`Error::Scene`] when the range is not a positive number.
    pub fn of(snapshot: &State, bounds: Bounds, range: Option<f64>, species: Option<u32>) -> Result<Self, Error> {
        let all = snapshot;
        let of = |list: &[DVec3]| -> Vec<DVec3> {
            let chosen =
                |i: &usize| all.is_active(*i) && species.is_none_or(|kind| all.species().get(*i) == Some(&kind));
            (0..list.len()).filter(chosen).map(|i| list[i]).collect()
        };
        let (positions, velocities) = (of(all.position()), of(all.velocity()));
        let headings: Vec<DVec3> = velocities.iter().map(|v| v.normalize_or_zero()).collect();
        let moving = headings.iter().filter(|h| **h != DVec3::ZERO).count();
        let count = velocities.len().max(1) as f64;
        let flock = Self {
            step: snapshot.step,
            time: snapshot.time,
            order: headings.iter().sum::<DVec3>().length() / moving.max(1) as f64,
            speed: velocities.iter().map(|v| v.length()).sum::<f64>() / count,
            ..Self::default()
        };
        let Some(range) = range else { return Ok(flock) };
        let cells = Cells::new(&positions, bounds, range)?;
        let mut sets = Sets::new(velocities.len());
        let (mut pairs, mut most_neighbors) = (0, 0);
        for first in (0..velocities.len()).step_by(CHUNK) {
            let last = velocities.len().min(first + CHUNK);
            let near: Vec<Vec<u32>> = (first..last).into_par_iter().map(|i| friends(&cells, i)).collect();
            for (i, friends) in (first..).zip(near) {
                pairs += friends.len();
                most_neighbors = most_neighbors.max(friends.len());
                friends.into_iter().filter(|j| (*j as usize) < i).for_each(|j| sets.join(i, j as usize));
            }
        }
        let sizes = sets.sizes();
        let whole = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        Ok(Self {
            neighbors: pairs as f64 / count,
            most_neighbors: whole(most_neighbors),
            clusters: whole(sizes.len()),
            largest: f64::from(sizes.iter().copied().max().unwrap_or(0)) / count,
            ..flock
        })
    }
}

fn friends(cells: &Cells, i: usize) -> Vec<u32> {
    let mut friends = Vec::new();
    cells.around(i, |j| friends.push(u32::try_from(j).unwrap_or(u32::MAX)));
    friends
}

/// Order and clusters of a run.
#[derive(Debug)]
pub struct Flocks {
    range: f64,
    species: Option<u32>,
    bounds: Bounds,
    ends: Option<(Flock, Flock)>,
}

impl Flocks {
    /// The first and the last row.
    #[must_use]
    pub fn ends(&self) -> Option<(&Flock, &Flock)> {
        self.ends.as_ref().map(|(first, last)| (first, last))
    }
    fn add(&mut self, row: Flock) {
        let first = self.ends.map_or(row, |(first, _)| first);
        self.ends = Some((first, row));
    }
}

impl Series for Flocks {
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let f = Flock::of(moment.state, moment.bounds(&self.bounds), Some(self.range), self.species)?;
        self.add(f);
        let counts = [f.most_neighbors, f.clusters].map(f64::from);
        let row = [f.order, f.speed, f.neighbors, counts[0], counts[1], f.largest];
        Ok(vec![row.map(Into::into).to_vec()])
    }
    fn recall(&mut self, step: u64, cells: &[&str]) {
        let number = |k| number(cells, k);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts, or saturated")]
        let whole = |k| number(k) as u32;
        self.add(Flock {
            step,
            time: number(0),
            order: number(1),
            speed: number(2),
            neighbors: number(3),
            most_neighbors: whole(4),
            clusters: whole(5),
            largest: number(6),
        });
    }
    fn summary(&self) -> Option<String> {
        let (first, last) = self.ends()?;
        Some(format!(
            "order {:.3} → {:.3}, {:.1} → {:.1} neighbours each, {} → {} clusters, the largest {:.0} % of all",
            first.order,
            last.order,
            first.neighbors,
            last.neighbors,
            first.clusters,
            last.clusters,
            100.0 * last.largest
        ))
    }
}

/// Disjoint sets (Tarjan 1975), by size, with paths halved.
pub(super) struct Sets {
    parent: Vec<usize>,
    size: Vec<u32>,
}

impl Sets {
    /// Each of so many in a set of its own.
    pub(super) fn new(count: usize) -> Self {
        Self { parent: (0..count).collect(), size: vec![1; count] }
    }
    /// The one that stands for the set of another.
    pub(super) fn root(&mut self, mut i: usize) -> usize {
        while self.parent[i] != i {
            self.parent[i] = self.parent[self.parent[i]];
            i = self.parent[i];
        }
        i
    }
    /// Joins the sets of two.
    pub(super) fn join(&mut self, i: usize, j: usize) {
        let (i, j) = (self.root(i), self.root(j));
        if i == j {
            return;
        }
        let (large, small) = if self.size[i] < self.size[j] { (j, i) } else { (i, j) };
        self.parent[small] = large;
        self.size[large] += self.size[small];
    }
    /// The size of the set of one.
    pub(super) fn size(&mut self, i: usize) -> u32 {
        let root = self.root(i);
        self.size[root]
    }
    /// The size of each set.
    fn sizes(&self) -> Vec<u32> {
        (0..self.parent.len()).filter(|i| self.parent[*i] == *i).map(|i| self.size[i]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Side;
    use crate::state::State;

    fn snapshot(positions: &[DVec3], velocities: &[DVec3]) -> State {
        let mut particles = State::default();
        for (x, v) in positions.iter().zip(velocities) {
            particles.push(*x, *v, 1.0, 0.0);
        }
        particles
    }

    #[test]
    fn order_is_that_of_headings_not_of_speeds() {
        let right = DVec3::X;
        let state = snapshot(&[DVec3::ZERO; 4], &[right * 9.0, right * 0.1, -right, DVec3::ZERO]);
        let flock = Flock::of(&state, Bounds::default(), None, None).expect("a measurement");
        assert!((flock.order - 1.0 / 3.0).abs() < 1e-12 && (flock.speed - 10.1 / 4.0).abs() < 1e-12, "{flock:?}");
    }
    #[test]
    fn chains_of_friends_are_clusters_across_the_seam_too() {
        // 0–1 across the seam, 2–3–4 in a chain of which the ends are out of each other's range, 5 alone.
        let x = [0.1, 9.9, 3.0, 3.8, 4.6, 7.0].map(|x| DVec3::new(x, 5.0, 0.0));
        let bounds = Bounds::new(DVec3::ZERO, DVec3::new(10.0, 10.0, 0.0), Side::Periodic);
        let flock = Flock::of(&snapshot(&x, &[DVec3::X; 6]), bounds, Some(1.0), None).expect("a measurement");
        assert_eq!((flock.clusters, flock.most_neighbors), (3, 2));
        assert!((flock.largest - 0.5).abs() < 1e-12 && (flock.neighbors - 1.0).abs() < 1e-12, "{flock:?}");
        let open = Flock::of(&snapshot(&x, &[DVec3::X; 6]), Bounds::default(), Some(1.0), None).expect("a measurement");
        assert_eq!(open.clusters, 4);
        let mut two = snapshot(&x, &[DVec3::X; 6]);
        two.species_mut().copy_from_slice(&[0, 0, 5, 5, 0, 5]);
        let some = Flock::of(&two, bounds, Some(1.0), Some(5)).expect("a measurement");
        assert_eq!((some.clusters, some.most_neighbors), (2, 1));
    }
}
