//! The power spectrum of cold dark matter.

use std::f64::consts::{E, PI};

use super::Cosmology;
use crate::error::Error;

/// The temperature of the cosmic microwave background, of 2.7 K (Fixsen 2009).
const WARMTH: f64 = 2.7255 / 2.7;

/// The linear power spectrum today, P(k) = A kⁿ T(k)², with the transfer function T of Eisenstein & Hu (ApJ 496, 605, 1998, equations 26 and 28
/// to 31), that without acoustic oscillations; A is found from σ₈.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spectrum {
    matter: f64,
    baryons: f64,
    h: f64,
    index: f64,
    amplitude: f64,
}

impl Spectrum {
    /// Of a universe with `baryons` of the critical density, Hubble's constant 100 h km/s/Mpc, the spectral index and σ₈: the root mean square of
    /// the density contrast in balls of 8 Mpc/h.
    ///
    /// # Errors
    /// [`Error::Scene`] where baryons are no part of the matter, or h or σ₈ are not above 0.
    pub fn new(cosmology: &Cosmology, baryons: f64, h: f64, index: f64, sigma: f64) -> Result<Self, Error> {
        let matter = cosmology.matter;
        if !(baryons >= 0.0 && baryons <= matter) {
            return Err(Error::Scene(format!(
                "omega_baryon is {baryons}: it is a part of omega_matter = {matter}, from 0 to that"
            )));
        }
        if !(h > 0.0 && sigma > 0.0 && index.is_finite() && h.is_finite() && sigma.is_finite()) {
            return Err(Error::Scene(format!(
                "h is {h}, sigma_8 {sigma} and spectral_index {index}: the first two must be above 0"
            )));
        }
        if !(0.1..=10.0).contains(&h) {
            return Err(Error::Scene(format!(
                "h is {h}: it is Hubble's constant in 100 km/s/Mpc, some 0.7, and from 0.1 to 10"
            )));
        }
        if !(-3.0 < index && index < 4.0) {
            return Err(Error::Scene(format!(
                "spectral_index is {index}: where it is not above -3 and below 4, sigma_8 is not finite"
            )));
        }
        let one = Self { matter, baryons, h, index, amplitude: 1.0 };
        let (horizon, damping) = (one.horizon(), one.damping());
        if !(horizon > 0.0 && damping > 0.0) {
            return Err(Error::Scene(format!(
                "omega_matter = {matter}, omega_baryon = {baryons} and h = {h} are beyond the fit of Eisenstein & Hu (1998), whose sound horizon is \
                 {horizon:.3} Mpc and whose shape is {damping:.3} there: choose less of baryons, or densities times h² from 0.02 to 1"
            )));
        }
        Ok(Self { amplitude: (sigma / one.deviation(8.0)).powi(2), ..one })
    }
    /// The sound horizon \[Mpc\].
    fn horizon(&self) -> f64 {
        let (matter, baryons) = (self.matter * self.h * self.h, self.baryons * self.h * self.h);
        44.5 * libm::log(9.83 / matter) / (1.0 + 10.0 * libm::pow(baryons, 0.75)).sqrt()
    }
    /// By how much baryons make the shape less.
    fn damping(&self) -> f64 {
        let (matter, share) = (self.matter * self.h * self.h, self.baryons / self.matter);
        1.0 - 0.328 * libm::log(431.0 * matter) * share + 0.38 * libm::log(22.3 * matter) * share * share
    }
    /// T(k), with k in h/Mpc.
    fn transfer(&self, k: f64) -> f64 {
        let (horizon, damping) = (self.horizon(), self.damping());
        let scale = 0.43 * k * self.h * horizon;
        let shape = self.matter * self.h * (damping + (1.0 - damping) / (1.0 + scale * scale * scale * scale));
        let q = k * WARMTH * WARMTH / shape;
        let long = libm::log(2.0 * E + 1.8 * q);
        long / (long + (14.2 + 731.0 / (1.0 + 62.5 * q)) * q * q)
    }
    /// P(k) \[(Mpc/h)³\], with k in h/Mpc.
    #[must_use]
    pub fn power(&self, k: f64) -> f64 {
        let transfer = self.transfer(k);
        if k > 0.0 { self.amplitude * libm::pow(k, self.index) * transfer * transfer } else { 0.0 }
    }
    /// The root mean square of the density contrast in balls of a radius \[Mpc/h\], over whole turns of ln k by Simpson's rule.
    fn deviation(&self, radius: f64) -> f64 {
        let (from, to, steps) = (libm::log(1e-5 / radius), libm::log(1e3 / radius), 8192);
        let step = (to - from) / f64::from(steps);
        let part = |n: i32| {
            let k = libm::exp(from + step * f64::from(n));
            let x = k * radius;
            let window =
                if x < 1e-2 { 1.0 - 0.1 * x * x } else { 3.0 * (libm::sin(x) - x * libm::cos(x)) / (x * x * x) };
            let weight = match n {
                0 => 1.0,
                n if n == steps => 1.0,
                n if n % 2 == 1 => 4.0,
                _ => 2.0,
            };
            weight * self.power(k) * k * k * k * window * window
        };
        ((0..=steps).map(part).sum::<f64>() * step / 3.0 / (2.0 * PI * PI)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::super::Cosmology;
    use super::Spectrum;

    #[test]
    fn it_has_the_deviation_that_is_asked_for_and_the_slopes_of_theory() {
        let cosmology = Cosmology::new(1.0, 0.3, 0.7).expect("a universe");
        let made = Spectrum::new(&cosmology, 0.045, 0.7, 0.96, 0.8).expect("a spectrum");
        // By another rule than the one that found the amplitude: midpoints in k.
        let (mut sum, steps) = (0.0, 400_000);
        for n in 0..steps {
            let k = 20.0 * (f64::from(n) + 0.5) / f64::from(steps);
            let x = 8.0 * k;
            let window = 3.0 * (x.sin() - x * x.cos()) / x.powi(3);
            sum += made.power(k) * (k * window).powi(2) * 20.0 / f64::from(steps);
        }
        let sigma = (sum / (2.0 * std::f64::consts::PI.powi(2))).sqrt();
        assert!((sigma - 0.8).abs() < 1e-4, "{sigma}");
        let slope = |k: f64| (made.power(1.01 * k) / made.power(k)).ln() / 1.01_f64.ln();
        assert!((slope(1e-5) - 0.96).abs() < 1e-2);
        // k^(n - 4) ln² k
        assert!((-2.95..-2.6).contains(&slope(1e2)), "{}", slope(1e2));
        assert!(made.power(0.0).abs() < f64::MIN_POSITIVE);
    }
    /// By Colossus (Diemer, `ApJS` 239, 35, 2018), `eisenstein98_zb`, which normalizes by an integral of its own.
    #[test]
    fn it_is_that_of_another_program() {
        let cosmology = Cosmology::new(1.0, 0.3, 0.7).expect("a universe");
        let made = Spectrum::new(&cosmology, 0.045, 0.7, 0.96, 0.8).expect("a spectrum");
        for (k, expected) in
            [(1e-3, 3631.3112), (1e-2, 20_799.078), (0.1, 5607.5913), (1.0, 63.070_778), (10.0, 0.210_221_45)]
        {
            assert!((made.power(k) / expected - 1.0).abs() < 1e-3, "{k}: {} {expected}", made.power(k));
        }
    }
    #[test]
    fn baryons_are_a_part_of_matter() {
        let cosmology = Cosmology::new(1.0, 0.3, 0.7).expect("a universe");
        let refused = [
            (0.31, 0.7, 0.96, 0.8),
            (-0.01, 0.7, 0.96, 0.8),
            (0.04, 0.0, 0.96, 0.8),
            (0.04, 0.7, 0.96, f64::NAN),
            (0.04, 70.0, 0.96, 0.8),
        ];
        for (baryons, h, index, sigma) in
            refused.into_iter().chain([(0.04, 0.7, -3.0, 0.8), (0.04, 0.7, 4.0, 0.8), (0.04, 6.0, 0.96, 0.8)])
        {
            assert!(Spectrum::new(&cosmology, baryons, h, index, sigma).is_err(), "{baryons} {h} {index} {sigma}");
        }
        // Where all is baryons, and little, the fit has no shape.
        let light = Cosmology::new(1.0, 0.02, 0.7).expect("a universe");
        assert!(Spectrum::new(&light, 0.02, 0.7, 0.96, 0.8).is_err());
    }
}
