//! The smoothing kernels: W(r) = c profile(r / h) / h^D, with h the support, beyond which they vanish.

use std::f64::consts::PI;

use crate::kernel::Source;

/// A kernel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Smoothing {
    /// The cubic spline (Monaghan & Lattanzio 1985).
    Cubic,
    /// Wendland's C2 (Wendland 1995; Dehnen & Aly 2012): no pairing, however many neighbours.
    Wendland,
}

impl Smoothing {
    /// Their names in scenes.
    pub const NAMES: &'static [&'static str] = &["cubic", "wendland"];

    /// The kernel of a name in scenes; the first for any other.
    #[must_use]
    pub fn named(name: &str) -> Self {
        if name == "wendland" { Self::Wendland } else { Self::Cubic }
    }
    /// Its WGSL: `fn profile(q: f32) -> f32` and `fn profile_slope(q: f32) -> f32`.
    #[must_use]
    pub fn source(self) -> Source {
        match self {
            Self::Cubic => crate::shader!("sph/cubic.wgsl"),
            Self::Wendland => crate::shader!("sph/wendland.wgsl"),
        }
    }
    /// The kernel without its constant, of q = r / h between 0 and 1.
    #[must_use]
    pub fn profile(self, q: f64) -> f64 {
        let p = 1.0 - q;
        match self {
            _ if q >= 1.0 => 0.0,
            Self::Cubic if q <= 0.5 => 1.0 - 6.0 * q * q * p,
            Self::Cubic => 2.0 * p * p * p,
            Self::Wendland => p * p * p * p * (4.0 * q + 1.0),
        }
    }
    /// Its derivative by q, over q: so that times r it needs no direction.
    #[must_use]
    pub fn profile_slope(self, q: f64) -> f64 {
        let p = 1.0 - q;
        match self {
            _ if q >= 1.0 => 0.0,
            Self::Cubic if q <= 0.5 => 18.0 * q - 12.0,
            Self::Cubic => -6.0 * p * p / q,
            Self::Wendland => -20.0 * p * p * p,
        }
    }
    /// The constant c that makes its integral 1, in so many dimensions.
    #[must_use]
    pub fn constant(self, dimensions: u32) -> f64 {
        match (self, dimensions) {
            (Self::Cubic, 2) => 40.0 / (7.0 * PI),
            (Self::Cubic, _) => 8.0 / PI,
            (Self::Wendland, 2) => 7.0 / PI,
            (Self::Wendland, _) => 21.0 / (2.0 * PI),
        }
    }
    /// Σ W over a cubic lattice of unit spacing, of a support in spacings: what a particle in the middle of a block at rest
    /// finds, where it should find 1.
    #[must_use]
    pub fn lattice_sum(self, support: f64, dimensions: u32) -> f64 {
        let scale = self.constant(dimensions) / support.powi(if dimensions == 2 { 2 } else { 3 });
        let most = support.ceil();
        let mut total = 0.0;
        let range = || steps(most);
        for x in range() {
            for y in range() {
                for z in range().filter(|z| dimensions != 2 || *z == 0.0) {
                    total += self.profile((x * x + y * y + z * z).sqrt() / support);
                }
            }
        }
        scale * total
    }
}

/// The integers from −most to most.
fn steps(most: f64) -> impl Iterator<Item = f64> {
    std::iter::successors(Some(-most), move |x| (*x < most).then_some(x + 1.0))
}
