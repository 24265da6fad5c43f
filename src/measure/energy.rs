//! Conserved quantities, summed in f64.

use glam::DVec3;
use rayon::prelude::*;

use crate::error::Error;
use crate::state::State;

/// Energies and momenta of a state: a row of `energy.csv`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Measure {
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
    /// Σ m x × v, about the origin \[mass length² / time\]; it jumps, and means nothing, where images count for each other
    pub angular_momentum: DVec3,
    /// Σ m x / Σ m; the mean position when all masses are zero \[length\]; in a periodic box it
    /// depends on where the box begins
    pub center: DVec3,
}

/// Particles in one partial sum. The partial sums are added in order, so that a sum has the same bits on any number of cores.
const CHUNK: usize = 4096;

impl Measure {
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
    /// How far the total is from that of another state, relative to it; absolute when that is zero.
    #[must_use]
    pub fn drift_from(&self, first: &Self) -> f64 {
        let change = self.total() - first.total();
        if first.total() == 0.0 { change } else { change / first.total().abs() }
    }
}
