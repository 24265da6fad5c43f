//! `flock.csv`: order and clusters, where a statistics radius is set.

use std::sync::Arc;

use super::table::{Lengths, Table};
use super::writer::{Moment, Writer};
use crate::error::Error;
use crate::formats::Folder;
use crate::kernel::Bounds;
use crate::measure::Flock;

const HEADER: &str = "step,time,order,speed,neighbors,most_neighbors,clusters,largest_cluster";

/// What was measured of a flock.
#[derive(Debug)]
pub struct Flocks {
    radius: f64,
    species: Option<u32>,
    bounds: Bounds,
    table: Option<Table>,
    ends: Option<(Flock, Flock)>,
}

impl Flocks {
    /// None yet; of pairs within a radius, of one species if that is given.
    pub(super) fn new((radius, species): (f64, Option<u32>), bounds: Bounds) -> Self {
        Self { radius, species, bounds, table: None, ends: None }
    }
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

impl Writer for Flocks {
    fn open(&mut self, folder: &Arc<Folder>, past: &Lengths) -> Result<(), Error> {
        let (table, rows) = Table::open(folder, "flock.csv", HEADER, past)?;
        for (step, n) in rows.numbers() {
            let at = |k: usize| n.get(k).copied().unwrap_or(f64::NAN);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts, or saturated")]
            let whole = |k: usize| at(k) as u32;
            let (time, order, speed, neighbors, largest) = (at(0), at(1), at(2), at(3), at(6));
            self.add(Flock {
                step,
                time,
                order,
                speed,
                neighbors,
                most_neighbors: whole(4),
                clusters: whole(5),
                largest,
            });
        }
        self.table = Some(table);
        Ok(())
    }
    fn take(&mut self, moment: &Moment<'_>) -> Result<(), Error> {
        let f = Flock::of(moment.state, self.bounds, Some(self.radius), self.species)?;
        let numbers =
            [f.time, f.order, f.speed, f.neighbors, f64::from(f.most_neighbors), f64::from(f.clusters), f.largest];
        if let Some(table) = &mut self.table {
            table.row(f.step, &numbers)?;
        }
        self.add(f);
        Ok(())
    }
    fn tables(&self) -> Vec<&Table> {
        self.table.iter().collect()
    }
}
