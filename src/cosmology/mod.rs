//! Universes that expand: matter, curvature and a cosmological constant (Friedmann 1922; Lemaître 1927).
//!
//! Positions x = r / a are comoving, with the scale factor a of 1 today, and time t is that of supercomoving coordinates (Martel & Shapiro,
//! MNRAS 297, 467, 1998): dt = dT / a² of the physical time T. Then velocities dx / dt = a² dx / dT are canonical momenta by mass, free
//! particles keep them, and the equations of motion are those of a space that does not expand, with a constant of gravity that grows as a(t)
//! and the mean density taken off. The velocity relative to the expansion (the peculiar velocity) is dx / dt / a.

mod expansion;
mod field;
mod fourier;
mod growth;
mod spectrum;

pub use expansion::Expansion;
pub use field::displacements;
pub use spectrum::Spectrum;

use std::f64::consts::PI;

use crate::error::Error;

/// A homogeneous universe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cosmology {
    hubble: f64,
    matter: f64,
    lambda: f64,
}

impl Cosmology {
    /// With Hubble's constant H₀ \[1 / time\], and the densities of matter and of the cosmological constant today, of the critical one. What
    /// they lack of 1 is curvature.
    ///
    /// # Errors
    /// [`Error::Scene`] where H₀ or the density of matter is not above 0, a density is not finite, or a universe does not expand for ever.
    pub fn new(hubble: f64, matter: f64, lambda: f64) -> Result<Self, Error> {
        let refuse = |why: String| Err(Error::Scene(why));
        if !(hubble > 0.0 && hubble.is_finite()) {
            return refuse(format!("hubble is {hubble}: an expanding universe has a constant above 0 [1 / time]"));
        }
        if !(matter > 0.0 && matter.is_finite() && lambda.is_finite()) {
            return refuse(format!(
                "omega_matter is {matter} and omega_lambda {lambda}: the first must be above 0, and both finite"
            ));
        }
        let made = Self { hubble, matter, lambda };
        // H² / H₀² a³ = Ω_m + Ω_k a + Ω_Λ a³ is least at one scale factor at most.
        let curvature = made.curvature();
        let turn = if lambda > 0.0 && curvature < 0.0 { (-curvature / (3.0 * lambda)).sqrt() } else { 0.0 };
        let expands = lambda > 0.0 || (lambda == 0.0 && curvature >= 0.0);
        if !expands || matter + curvature * turn + lambda * turn * turn * turn <= 0.0 {
            return refuse(format!(
                "omega_matter = {matter} and omega_lambda = {lambda} are a universe that does not expand for ever, or never was small: \
                 choose omega_lambda from 0 to about 1"
            ));
        }
        Ok(made)
    }
    /// The density of curvature today, of the critical one.
    #[must_use]
    pub fn curvature(&self) -> f64 {
        1.0 - self.matter - self.lambda
    }
    /// H / H₀ at a scale factor.
    fn relative_rate(&self, a: f64) -> f64 {
        (self.matter / (a * a * a) + self.curvature() / (a * a) + self.lambda).sqrt()
    }
    /// The rate of expansion H at a scale factor \[1 / physical time\].
    #[must_use]
    pub fn rate(&self, a: f64) -> f64 {
        self.hubble * self.relative_rate(a)
    }
    /// The share of matter in the critical density at a scale factor.
    #[must_use]
    pub fn matter_at(&self, a: f64) -> f64 {
        let rate = self.relative_rate(a);
        self.matter / (a * a * a * rate * rate)
    }
    /// The comoving mean density of matter \[mass / length³\], by the constant of gravity: 3 H₀² Ω_m / 8πG.
    #[must_use]
    pub fn mean_density(&self, g: f64) -> f64 {
        3.0 * self.hubble * self.hubble * self.matter / (8.0 * PI * g)
    }
}

/// The scale factor of a redshift.
#[must_use]
pub fn scale_factor(redshift: f64) -> f64 {
    1.0 / (1.0 + redshift)
}

/// The nodes and weights of Gauss and Legendre with eight points, from −1 to 1: the positive half.
const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_5],
    [0.960_289_856_497_536_2, 0.101_228_536_290_376_26],
];

/// The integral from 0 to an end of a function that may be steep at 0: octave by octave, in four parts each.
fn integral(end: f64, f: impl Fn(f64) -> f64) -> f64 {
    let mut sum = 0.0;
    let mut high = end;
    for octave in 0..40 {
        let low = if octave == 39 { 0.0 } else { 0.5 * high };
        let half = (high - low) / 8.0;
        for part in 0..4 {
            let middle = low + half * f64::from(2 * part + 1);
            sum += GAUSS.iter().map(|[x, w]| w * half * (f(middle - half * x) + f(middle + half * x))).sum::<f64>();
        }
        high = low;
    }
    sum
}
