//! A fluid at rest, and its smoothing kernel.

use std::sync::Arc;

use glam::DVec3;

use super::Smoothing;
use crate::error::Error;
use crate::kernel::{Bounds, Problem, Source};
use crate::neighbors::Grid;
use crate::visit::{Candidate, Over, Search};

/// A fluid: its rest density, its compressibility, and its smoothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medium {
    /// The density at rest \[mass / length^D\].
    pub density: f64,
    /// The spacing of particles at rest, on a cubic lattice \[length\].
    pub spacing: f64,
    /// The radius of the kernel, in spacings.
    pub support: f64,
    /// The kernel.
    pub smoothing: Smoothing,
    /// The speed of sound at rest \[length / time\].
    pub sound: f64,
    /// γ of Tait's equation, an integer.
    pub exponent: u32,
    /// Whether pressure may be below 0: where there is no free surface.
    pub negative: bool,
    /// 2 or 3.
    pub dimensions: u32,
}

/// The data of a neighbour that searches of a fluid load: velocity, density and pressure, too.
pub(super) const FLOWING: Candidate = Candidate {
    particle: crate::shader!("sph/flowing.wgsl"),
    broadcast: crate::shader!("sph/flowing_broadcast.wgsl"),
    listed: Some(crate::shader!("sph/flowing_listed.wgsl")),
};

/// The fluid in a box, which says its dimensions.
pub type Boxed = Arc<dyn Fn(&Bounds) -> Result<Medium, Error> + Send + Sync>;

/// A kernel with the constants in front of it, which are sums over a lattice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Smoothed {
    weight: f64,
    slope: f64,
    range: f64,
    smoothing: Smoothing,
}

impl Smoothed {
    /// W(r).
    #[must_use]
    pub fn kernel(&self, r: DVec3) -> f64 {
        self.weight * self.smoothing.profile(r.length() / self.range)
    }
    /// The factor of r in the gradient of W at distance r: W′(r) / r.
    #[must_use]
    pub fn gradient(&self, r: DVec3) -> f64 {
        self.slope * self.smoothing.profile_slope(r.length() / self.range)
    }
}

impl Medium {
    /// Refuses particles of the fluid without mass.
    ///
    /// # Errors
    /// [`Error::Scene`] with the first of them.
    pub fn weighs(&self, particles: impl IntoIterator<Item = (usize, f64)>) -> Result<(), Error> {
        particles.into_iter().find(|(_, mass)| *mass <= 0.0).map_or(Ok(()), |(id, _)| {
            Err(Error::Scene(format!(
                "particle {id} of the fluid has mass 0: it has no density, and pressure cannot move it; give it the mass \
                 {}, which is density × spacing^{}, as the shapes block and drop do",
                self.mass(),
                self.dimensions
            )))
        })
    }
    /// The radius of the kernel \[length\].
    #[must_use]
    pub fn range(&self) -> f64 {
        self.support * self.spacing
    }
    /// The mass of a particle: that of the fluid in its share of the lattice \[mass\].
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.density * self.volume()
    }
    /// A particle's share of the lattice.
    #[must_use]
    pub fn volume(&self) -> f64 {
        if self.dimensions == 2 { self.spacing * self.spacing } else { self.spacing.powi(3) }
    }
    /// The constant in front of the kernel: such that the sum over a lattice at rest is just the density at rest. (An integral of
    /// 1 is not a sum of 1: with Wendland's kernel and a support of two spacings it is 1.034, a pressure of six times what weighs
    /// on the bottom of a dam break.)
    #[must_use]
    pub fn weight(&self) -> f64 {
        let sum = self.smoothing.lattice_sum(self.support, self.dimensions);
        let volume = self.range().powi(if self.dimensions == 2 { 2 } else { 3 });
        self.smoothing.constant(self.dimensions) / (volume * sum)
    }
    /// The kernel, ready to be evaluated for many pairs.
    #[must_use]
    pub fn smoothed(&self) -> Smoothed {
        let (weight, range) = (self.weight(), self.range());
        Smoothed { weight, slope: weight / range.powi(2), range, smoothing: self.smoothing }
    }
    /// B of Tait's equation p = B ((ρ/ρ₀)^γ − 1) \[pressure\].
    #[must_use]
    pub fn stiffness(&self) -> f64 {
        self.density * self.sound * self.sound / f64::from(self.exponent)
    }
    /// Pressure over the square of the density, and the internal energy per unit mass (Monaghan 1994), of a density.
    #[must_use]
    pub fn state(&self, density: f64) -> (f64, f64) {
        let excess = (density - self.density) / self.density;
        let x = if self.negative || excess > 0.0 { excess } else { 0.0 };
        let (ratio, stiffness) = (1.0 + x, self.stiffness());
        // x^γ − 1 = e (1 + x + … + x^(γ−1)), with e = x − 1: no digits are lost where e is small.
        let (mut sum, mut energy) = (0.0, 0.0);
        for k in 1..=self.exponent {
            sum = sum * ratio + 1.0;
            // ∫ p / ρ² dρ = B e² (1 x^(γ−2) + 2 x^(γ−3) + … + γ − 1) / ((γ − 1) ρ₀ x)
            if k < self.exponent {
                energy = energy * ratio + f64::from(k);
            }
        }
        let share = f64::from(self.exponent - 1) * self.density * ratio;
        (stiffness * x * sum / (density * density), stiffness * x * x * energy / share)
    }
    /// The grid in which neighbours are found.
    ///
    /// # Errors
    /// [`Error::Scene`] when the range is invalid.
    pub fn grid(&self, problem: &Problem) -> Result<Grid, Error> {
        Grid::apart(self.range(), problem)
    }
    /// The grid of a visit that is settled; none over a kept list.
    ///
    /// # Errors
    /// [`Error::Scene`] when the range is invalid.
    pub fn grid_over(&self, over: Over, problem: &Problem) -> Result<Option<Grid>, Error> {
        Ok(if matches!(over, Over::List { .. }) { None } else { Some(self.grid(problem)?) })
    }
    /// A search of the fluid, of particles that are not fixed, with these fields.
    pub(super) fn search(
        &self,
        over: Over,
        candidate: Candidate,
        fields: &[&'static str],
        problem: &Problem,
    ) -> Result<Search, Error> {
        let (grid, files, constants) = (self.grid_over(over, problem)?, self.files(&[]), self.constants());
        Ok(Search { grid, candidate, fields: fields.to_vec(), files, constants, fixed: false })
    }
    /// The files of a search of the fluid, with these files of its own.
    pub(super) fn files(&self, own: &[Source]) -> Vec<Source> {
        [&[self.smoothing.source(), crate::shader!("sph/medium.wgsl")], own].concat()
    }
    /// The `override`s of `shaders/sph/medium.wgsl`: a simulation has one fluid, and kernels few enough uniform blocks.
    #[must_use]
    pub fn constants(&self) -> Vec<(&'static str, f64)> {
        vec![
            ("PER_SUPPORT", 1.0 / self.range()),
            ("WEIGHT", self.weight()),
            ("SLOPE", self.weight() / self.range().powi(2)),
            ("SMOOTHING", 0.5 * self.range()),
            ("REST_DENSITY", self.density),
            ("SOUND", self.sound),
            ("STIFFNESS", self.stiffness()),
            ("EXPONENT", f64::from(self.exponent)),
            ("NEGATIVE", f64::from(u8::from(self.negative))),
        ]
    }
}
