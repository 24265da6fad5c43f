//! `fluid.csv`: the ledger of a fluid.

use std::sync::Arc;

use glam::DVec3;

use super::progress::plain;
use super::table::{Lengths, Table};
use super::writer::{Moment, Writer};
use crate::error::Error;
use crate::formats::Folder;
use crate::kernel::{Bounds, Machine, Reason};
use crate::measure::Ledger;
use crate::simulation::Setup;
use crate::sph::Medium;

const HEADER: &str = "step,time,dt,dt_free,limit,limited_by,mass,momentum_x,momentum_y,momentum_z,kinetic,potential,internal,total,\
                      largest_density_error,densest_particle,mean_density_error,outside,broken";

/// The book, of a run that has a fluid.
#[derive(Debug)]
pub struct Book {
    medium: Medium,
    bounds: Bounds,
    held: Vec<bool>,
    dt: f64,
    table: Option<Table>,
    first: Option<Ledger>,
    last: Ledger,
    worst: Ledger,
    /// The largest of the mean density errors.
    mean: f64,
    /// What is to be said, and was not yet.
    warning: Option<String>,
}

impl Book {
    /// The book of a setup; none where nothing flows.
    pub(super) fn of(setup: &Setup) -> Result<Option<Self>, Error> {
        let problem = setup.problem(Machine::HOST)?;
        for force in &setup.forces {
            if let Some(fluid) = force.resolved(&problem)?.fluid {
                let held = (0..setup.state.len()).map(|id| problem.is_held(id)).collect();
                let (table, first, warning, last, worst) = (None, None, None, Ledger::default(), Ledger::default());
                let (bounds, dt, mean) = (setup.bounds, setup.dt, 0.0);
                return Ok(Some(Self {
                    medium: fluid.medium,
                    bounds,
                    held,
                    dt,
                    table,
                    first,
                    last,
                    worst,
                    mean,
                    warning,
                }));
            }
        }
        Ok(None)
    }
    /// What is to be said once: that a count is no longer 0 that must stay so.
    pub(super) fn warning(&mut self) -> Option<String> {
        self.warning.take()
    }
    fn add(&mut self, row: Ledger) {
        self.warning = (row.outside > self.worst.outside || row.broken > self.worst.broken).then(|| {
            format!(
                "{} particles of the fluid are out of the box and {} are broken at {}: both must stay 0",
                row.outside,
                row.broken,
                plain(row.time)
            )
        });
        if row.worst_density > self.worst.worst_density {
            (self.worst.worst_density, self.worst.worst_particle) = (row.worst_density, row.worst_particle);
            self.worst.time = row.time;
        }
        self.mean = self.mean.max(row.mean_density);
        self.worst.outside = self.worst.outside.max(row.outside);
        self.worst.broken = self.worst.broken.max(row.broken);
        self.first.get_or_insert(row);
        self.last = row;
    }
    /// A line for the end of a run.
    #[must_use]
    pub fn summary(&self) -> Option<String> {
        let (first, last, worst) = (self.first?, self.last, self.worst);
        let lost = last.mass - first.mass;
        let counts = if worst.outside + worst.broken == 0 {
            "no particle out of the box or broken".to_owned()
        } else {
            format!("UP TO {} OUT OF THE BOX AND {} BROKEN", worst.outside, worst.broken)
        };
        // Walls weigh something too, and the energy of a run counts them.
        let which = if self.held.contains(&true) { " without walls" } else { "" };
        Some(format!(
            "fluid: mass {:.6e} ({lost:+.1e}), energy{which} {:.4e} → {:.4e}, too dense by {:.2} % at most (particle {} at {:.4}), {:.3} % in \
             the mean; {counts}",
            last.mass,
            first.total(),
            last.total(),
            100.0 * worst.worst_density,
            worst.worst_particle,
            worst.time,
            100.0 * self.mean
        ))
    }
}

impl Writer for Book {
    fn open(&mut self, folder: &Arc<Folder>, past: &Lengths) -> Result<(), Error> {
        let (table, rows) = Table::open(folder, "fluid.csv", HEADER, past)?;
        for words in rows.iter() {
            let number = |k: usize| words.get(k).and_then(|word| word.parse().ok()).unwrap_or(f64::NAN);
            let whole = |k: usize| words.get(k).and_then(|word| word.parse::<u64>().ok()).unwrap_or_default();
            self.add(Ledger {
                step: whole(0),
                time: number(1),
                mass: number(6),
                momentum: DVec3::new(number(7), number(8), number(9)),
                kinetic: number(10),
                potential: number(11),
                internal: number(12),
                worst_density: number(14),
                worst_particle: u32::try_from(whole(15)).unwrap_or(u32::MAX),
                mean_density: number(16),
                outside: whole(17),
                broken: whole(18),
                ..Ledger::default()
            });
        }
        // That was said before.
        self.warning = None;
        self.table = Some(table);
        Ok(())
    }
    fn measures(&self) -> bool {
        true
    }
    fn take(&mut self, moment: &Moment<'_>) -> Result<(), Error> {
        let held = |id: usize| self.held.get(id).copied().unwrap_or(false);
        let row = Ledger::of(moment.state, moment.density, &self.medium, &self.bounds, held)?;
        let clock = moment.clock;
        let (dt, free, reason) =
            clock.map_or((self.dt, self.dt, Reason::Longest), |clock| (clock.dt, clock.free, clock.reason));
        let limiting = clock.and_then(|clock| clock.particle).map_or_else(String::new, |id| id.to_string());
        let p = row.momentum;
        let words = [
            format!("{:?},{dt:?},{free:?},{},{limiting}", row.time, reason.name()),
            format!("{:?},{:?},{:?},{:?}", row.mass, p.x, p.y, p.z),
            format!("{:?},{:?},{:?},{:?}", row.kinetic, row.potential, row.internal, row.total()),
            format!("{:?},{},{:?}", row.worst_density, row.worst_particle, row.mean_density),
            format!("{},{}", row.outside, row.broken),
        ];
        if let Some(table) = &mut self.table {
            table.words(row.step, &words.join(","))?;
        }
        self.add(row);
        Ok(())
    }
    fn tables(&self) -> Vec<&Table> {
        self.table.iter().collect()
    }
}
