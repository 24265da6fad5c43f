//! `energy.csv` and `energy.svg`: energies and momenta.

use std::sync::Arc;

use glam::DVec3;

use super::images;
use super::table::{Lengths, Table};
use super::writer::{Moment, Writer};
use crate::error::Error;
use crate::formats::Folder;
use crate::measure::Measure;

const HEADER: &str = "step,time,kinetic,potential,total,momentum_x,momentum_y,momentum_z,angular_momentum_x,\
                      angular_momentum_y,angular_momentum_z";

/// What was measured of a run.
#[derive(Debug, Default)]
pub struct Energies {
    title: String,
    table: Option<(Table, Arc<Folder>)>,
    rows: Vec<Measure>,
}

impl Energies {
    /// None yet, of a run of this name.
    pub(super) fn new(title: &str) -> Self {
        Self { title: title.to_owned(), ..Self::default() }
    }
    /// All rows.
    #[must_use]
    pub fn rows(&self) -> &[Measure] {
        &self.rows
    }
    /// The first row, which energies are compared with.
    #[must_use]
    pub fn first(&self) -> Measure {
        self.rows.first().copied().unwrap_or_default()
    }
}

impl Writer for Energies {
    fn open(&mut self, folder: &Arc<Folder>, past: &Lengths) -> Result<(), Error> {
        let (table, rows) = Table::open(folder, "energy.csv", HEADER, past)?;
        let measured = |(step, n): (u64, Vec<f64>)| {
            let at = |k: usize| n.get(k).copied().unwrap_or(f64::NAN);
            let three = |k: usize| DVec3::new(at(k), at(k + 1), at(k + 2));
            let (momentum, angular_momentum) = (three(4), three(7));
            Measure {
                step,
                time: at(0),
                kinetic: at(1),
                potential: at(2),
                momentum,
                angular_momentum,
                ..Measure::default()
            }
        };
        self.rows = rows.numbers().map(measured).collect();
        self.table = Some((table, folder.clone()));
        Ok(())
    }
    fn measures(&self) -> bool {
        true
    }
    fn take(&mut self, moment: &Moment<'_>) -> Result<(), Error> {
        let row = Measure::of(moment.state)?;
        let (p, l) = (row.momentum, row.angular_momentum);
        let numbers = [row.time, row.kinetic, row.potential, row.total(), p.x, p.y, p.z, l.x, l.y, l.z];
        if let Some((table, _)) = &mut self.table {
            table.row(row.step, &numbers)?;
        }
        self.rows.push(row);
        Ok(())
    }
    fn tables(&self) -> Vec<&Table> {
        self.table.iter().map(|(table, _)| table).collect()
    }
    fn finish(&mut self) -> Result<(), Error> {
        let Some((_, folder)) = &self.table else { return Ok(()) };
        images::energy(&folder.file("energy.svg")?, &self.rows, &self.title)
    }
}
