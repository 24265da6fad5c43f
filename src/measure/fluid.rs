//! The ledger of a fluid: what must stay, and what must not happen, summed in f64.

use glam::DVec3;

use crate::error::Error;
use crate::kernel::Bounds;
use crate::sph::Medium;
use crate::state::State;

/// What a fluid has at a time, without fixed particles, which are its walls. A row of `fluid.csv`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Ledger {
    /// Steps done.
    pub step: u64,
    /// The time.
    pub time: f64,
    /// Particles of the fluid.
    pub count: u64,
    /// Σ m \[mass\]
    pub mass: f64,
    /// Σ m v \[mass length / time\]
    pub momentum: DVec3,
    /// ½ Σ m v² \[mass length² / time²\]
    pub kinetic: f64,
    /// The potential energy without the internal one: that of weight and other forces \[mass length² / time²\]
    pub potential: f64,
    /// Σ m ∫ p / ρ² dρ, by the equation of state; 0 where sound has no speed \[mass length² / time²\]
    pub internal: f64,
    /// The largest of ρ/ρ₀ − 1, where it is above 0.
    pub worst_density: f64,
    /// Its particle.
    pub worst_particle: u32,
    /// The mean of max(ρ/ρ₀ − 1, 0).
    pub mean_density: f64,
    /// Particles out of the box, along axes where it has an extent: open ones too. It must stay 0.
    pub outside: u64,
    /// Particles with a number that is none. It must stay 0.
    pub broken: u64,
}

impl Ledger {
    /// Measures a state, with the densities of all particles \[mass / length³, or mass / length² in two dimensions\].
    ///
    /// # Errors
    /// [`Error::Scene`] where the state does not have the potential energies.
    pub fn of(
        snapshot: &State,
        density: &[f32],
        medium: &Medium,
        bounds: &Bounds,
        held: impl Fn(usize) -> bool,
    ) -> Result<Self, Error> {
        let particles = snapshot;
        let energies = snapshot.energies()?;
        let mut ledger = Self { step: snapshot.step, time: snapshot.time, ..Self::default() };
        let extent: Vec<usize> = (0..3).filter(|axis| bounds.high[*axis] > bounds.low[*axis]).collect();
        // Single precision may put a particle at a side just behind it.
        let slack = f64::from(f32::EPSILON) * bounds.low.abs().max(bounds.high.abs());
        let sounds = medium.sound > 0.0;
        let ids = particles.ids();
        for i in (0..particles.len()).filter(|i| !held(*i) && particles.is_active(*i)) {
            let (x, v, m) = (particles.position()[i], particles.velocity()[i], particles.mass()[i]);
            let rho = density.get(i).copied().map_or(medium.density, f64::from);
            ledger.count += 1;
            if !(x.is_finite() && v.is_finite() && rho.is_finite()) {
                ledger.broken += 1;
                continue;
            }
            let internal = if sounds { m * medium.state(rho).1 } else { 0.0 };
            ledger.mass += m;
            ledger.momentum += m * v;
            ledger.kinetic += 0.5 * m * v.length_squared();
            ledger.potential += energies[i] - internal;
            ledger.internal += internal;
            let error = (rho / medium.density - 1.0).max(0.0);
            ledger.mean_density += error;
            if error > ledger.worst_density {
                (ledger.worst_density, ledger.worst_particle) = (error, ids[i]);
            }
            let out = |axis: &usize| {
                let (low, high) = (bounds.low - slack, bounds.high + slack);
                x[*axis] < low[*axis] || x[*axis] > high[*axis]
            };
            ledger.outside += u64::from(extent.iter().any(out));
        }
        ledger.mean_density /= (ledger.count - ledger.broken).max(1) as f64;
        Ok(ledger)
    }
    /// All energies together.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential + self.internal
    }
}
