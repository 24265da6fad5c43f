//! Seeded numbers, the same bits on every platform: integers from a PCG, logarithms and angles from `libm`.
//!
//! The standard library's `sin`, `ln` and `powf` differ between platforms in the last bit, so nothing here calls them.

use std::f64::consts::TAU;

use glam::DVec3;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A stream of random numbers (PCG XSL RR 128/64, `O'Neill` 2014).
#[derive(Debug, Clone)]
pub struct Random(Pcg64Mcg);

impl Random {
    /// The stream of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    /// A number strictly between 0 and 1, on a grid of 2⁻⁵²: safe below a logarithm and as an exponent's base.
    #[expect(clippy::cast_precision_loss, reason = "52 bits fit an f64")]
    pub fn uniform(&mut self) -> f64 {
        const STEP: f64 = 1.0 / (1u64 << 52) as f64;
        ((self.0.next_u64() >> 12) as f64 + 0.5) * STEP
    }

    /// A number strictly between two others.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform()
    }

    /// A number with mean 0 and variance 1 (Box & Muller 1958).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * libm::log(self.uniform())).sqrt();
        radius * libm::cos(TAU * self.uniform())
    }

    /// Three independent normal numbers: an isotropic Maxwellian velocity of dispersion 1 per axis.
    pub fn normals(&mut self) -> DVec3 {
        let x = self.normal();
        let y = self.normal();
        let z = self.normal();
        DVec3::new(x, y, z)
    }

    /// A number of the gamma distribution of a shape of 1 or more and scale 1 (Marsaglia & Tsang 2000).
    pub fn gamma(&mut self, shape: f64) -> f64 {
        let d = shape.max(1.0) - 1.0 / 3.0;
        let c = 1.0 / (9.0 * d).sqrt();
        loop {
            let x = self.normal();
            let root = 1.0 + c * x;
            let cube = root * root * root;
            let height = libm::log(self.uniform());
            if root > 0.0 && height < 0.5 * x * x + d * (1.0 - cube + libm::log(cube)) {
                return d * cube;
            }
        }
    }

    /// A point on the unit sphere: uniform in height and angle (Archimedes).
    pub fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let angle = TAU * self.uniform();
        let ring = (1.0 - z * z).sqrt();
        DVec3::new(ring * libm::cos(angle), ring * libm::sin(angle), z)
    }

    /// A point in the unit ball, uniform in volume.
    pub fn ball(&mut self) -> DVec3 {
        let direction = self.direction();
        direction * libm::cbrt(self.uniform())
    }
}
