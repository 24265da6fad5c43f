//! Conserved quantities, summed in f64.

use glam::DVec3;
use rayon::prelude::*;

use super::series::number;
use super::{Measure, Moment, Row, Series, Times};
use crate::error::Error;
use crate::settings::Settings;
use crate::state::State;

/// `energy.csv`.
pub const MEASURE: Measure = Measure {
    name: "energy",
    about: "energies and momenta of all particles",
    keys: &[],
    cells: &[
        ("kinetic", "½ Σ m v² [mass length² / time²]"),
        ("potential", "the potential energy of all forces that have one [mass length² / time²]"),
        ("total", "both together [mass length² / time²]"),
        ("momentum_x", "Σ m v [mass length / time]"),
        ("momentum_y", "along y"),
        ("momentum_z", "along z"),
        ("angular_momentum_x", "Σ m x × v, about the origin [mass length² / time]"),
        ("angular_momentum_y", "along y"),
        ("angular_momentum_z", "along z"),
    ],
    times: Times::Outputs,
    usual: |_| Ok(Some(Settings::default())),
    begin: |_, _| Ok(Box::new(Energies::default())),
};

/// Energies and momenta of a state: a row of `energy.csv`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Energy {
    /// Steps done.
    pub step: u64,
    /// The time.
    pub time: f64,
    /// ½ Σ m v² \[mass length² / time²\]
    pub kinetic: f64,
    /// The potential energy of all forces that have one \[mass length² / time²\]
    pub potential: f64,
    /// Σ m v \[mass length / time\]
    pub momentum: DVec3,
    /// Σ m x × v, about the origin \[mass length² / time\]; in a periodic box it jumps, and is meaningless
    pub angular_momentum: DVec3,
    /// Σ m x / Σ m; the mean position when all masses are zero \[length\]; in a periodic box it depends on the corner of the box
    pub center: DVec3,
}

/// Particles in one partial sum. The partial sums are added in order, so that a sum has the same bits for any number of threads.
const CHUNK: usize = 4096;

impl Energy {
    /// Measures a state.
    ///
    /// # Errors
    /// [`Error::Scene`] where the state does not have the potential energies.
    pub fn of(snapshot: &State) -> Result<Self, Error> {
        let (position, velocity, mass) = (snapshot.position(), snapshot.velocity(), snapshot.mass());
        let (count, energies) = (snapshot.len(), snapshot.energies()?);
        let chunks: Vec<(Self, f64)> = (0..count.div_ceil(CHUNK))
            .into_par_iter()
            .map(|chunk| {
                let mut sum = Self::default();
                let mut total = 0.0;
                for i in chunk * CHUNK..((chunk + 1) * CHUNK).min(count) {
                    let (x, v, m) = (position[i], velocity[i], mass[i]);
                    sum.kinetic += 0.5 * m * v.length_squared();
                    sum.potential += energies[i];
                    sum.momentum += m * v;
                    sum.angular_momentum += m * x.cross(v);
                    sum.center += m * x;
                    total += m;
                }
                (sum, total)
            })
            .collect();
        let mut total = Self { step: snapshot.step, time: snapshot.time, ..Self::default() };
        let mut weight = 0.0;
        for (part, m) in chunks {
            total.kinetic += part.kinetic;
            total.potential += part.potential;
            total.momentum += part.momentum;
            total.angular_momentum += part.angular_momentum;
            total.center += part.center;
            weight += m;
        }
        let living = || (0..count).filter(|id| snapshot.is_active(*id));
        let mean = living().map(|id| position[id]).sum::<DVec3>() / living().count().max(1) as f64;
        total.center = if weight > 0.0 { total.center / weight } else { mean };
        Ok(total)
    }
    /// Kinetic and potential energy together.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential
    }
    /// The difference of the total to that of another state, relative to it; absolute when that is zero.
    #[must_use]
    pub fn drift_from(&self, first: &Self) -> f64 {
        let change = self.total() - first.total();
        if first.total() == 0.0 { change } else { change / first.total().abs() }
    }
}

/// The energies of a run.
#[derive(Debug, Default)]
pub struct Energies(Vec<Energy>);

impl Energies {
    /// One for each output.
    #[must_use]
    pub fn rows(&self) -> &[Energy] {
        &self.0
    }
}

impl Series for Energies {
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let row = Energy::of(moment.state)?;
        self.0.push(row);
        let (p, l) = (row.momentum, row.angular_momentum);
        let numbers = [row.kinetic, row.potential, row.total(), p.x, p.y, p.z, l.x, l.y, l.z];
        Ok(vec![numbers.map(Into::into).to_vec()])
    }
    fn recall(&mut self, step: u64, cells: &[&str]) {
        let three = |k: usize| DVec3::new(number(cells, k), number(cells, k + 1), number(cells, k + 2));
        self.0.push(Energy {
            step,
            time: number(cells, 0),
            kinetic: number(cells, 1),
            potential: number(cells, 2),
            momentum: three(4),
            angular_momentum: three(7),
            ..Energy::default()
        });
    }
}
