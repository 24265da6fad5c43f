//! The scale factor by time.

use super::{Cosmology, integral};
use crate::error::Error;

/// The constants of a shader that computes the scale factor: the time left before a is infinite, and the coefficients of its polynomial.
const CONSTANTS: [&str; 1 + TERMS] = [
    "LEFT", "A_0", "A_1", "A_2", "A_3", "A_4", "A_5", "A_6", "A_7", "A_8", "A_9", "A_10", "A_11", "A_12", "A_13",
    "A_14", "A_15", "A_16", "A_17", "A_18", "A_19", "A_20", "A_21", "A_22", "A_23", "A_24", "A_25", "A_26", "A_27",
];
/// Terms of the polynomial.
const TERMS: usize = 28;
/// The relative error of a⁻¹ᐟ² that is accepted, up to [`FARTHEST`]: less than what times are rounded by on a device.
const ERROR: f64 = 3e-7;
/// Scale factors up to which the error is measured.
const FARTHEST: f64 = 10.0;

/// The scale factor of a universe from a time t = 0 on.
///
/// In supercomoving time all that is left until a is infinite is finite, T. With u = a⁻¹ᐟ² and y = (1 − t / T)¹ᐟ⁴, u / y is a smooth function of y,
/// near 0 as well: a sum of Chebyshev polynomials of 2 y − 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Expansion {
    /// The universe.
    pub cosmology: Cosmology,
    /// The scale factor at t = 0.
    pub start: f64,
    left: f64,
    terms: [f64; TERMS],
}

impl Cosmology {
    /// The time from a scale factor a = u⁻² on until it is infinite \[time\].
    fn left(&self, u: f64) -> f64 {
        let (curvature, lambda) = (self.curvature(), self.lambda);
        let rate = |square: f64| (self.matter * square * square * square + curvature * square * square + lambda).sqrt();
        integral(u, |v| 2.0 * v * v * v / rate(v * v)) / self.hubble
    }
    /// The time from one scale factor to another \[time\].
    #[must_use]
    pub fn time(&self, from: f64, to: f64) -> f64 {
        self.left(1.0 / from.sqrt()) - self.left(1.0 / to.sqrt())
    }
    /// u = a⁻¹ᐟ² where so much time is left.
    fn where_left(&self, time: f64, most: f64) -> f64 {
        let (mut low, mut high) = (0.0, most);
        // Bisection, which ends at two neighbouring numbers.
        while low < 0.5 * (low + high) && 0.5 * (low + high) < high {
            let middle = 0.5 * (low + high);
            if self.left(middle) < time { low = middle } else { high = middle }
        }
        high
    }
}

impl Expansion {
    /// From a scale factor on, at t = 0.
    ///
    /// # Errors
    /// [`Error::Scene`] for a scale factor that is not above 0, or a universe with which single precision cannot compute.
    pub fn new(cosmology: Cosmology, start: f64) -> Result<Self, Error> {
        if !(start > 0.0 && start.is_finite()) {
            return Err(Error::Scene(format!("a universe begins with the scale factor {start}: it must be above 0")));
        }
        let u = 1.0 / start.sqrt();
        let left = cosmology.left(u);
        let node = |k: usize| libm::cos(std::f64::consts::PI * (k as f64 + 0.5) / TERMS as f64);
        let values: [f64; TERMS] = std::array::from_fn(|k| {
            let y = 0.5 * (node(k) + 1.0);
            cosmology.where_left(left * (y * y * y * y), u) / y
        });
        let terms = std::array::from_fn(|n| {
            let at = |k: usize| libm::cos(std::f64::consts::PI * n as f64 * (k as f64 + 0.5) / TERMS as f64);
            let sum: f64 = (0..TERMS).map(|k| values[k] * at(k)).sum();
            sum * if n == 0 { 1.0 } else { 2.0 } / TERMS as f64
        });
        let made = Self { cosmology, start, left, terms };
        let error = made.error();
        if error > ERROR {
            return Err(Error::Scene(format!(
                "a universe with omega_matter = {}, omega_lambda = {} from the scale factor {start} on is not smooth enough: its scale factor \
                 would err by {error:.1e}, and {ERROR:.0e} is accepted; choose a lower redshift, or densities that are nearer to 1",
                cosmology.matter, cosmology.lambda
            )));
        }
        Ok(made)
    }
    /// The largest relative error of a⁻¹ᐟ², between the nodes.
    fn error(&self) -> f64 {
        let steps = 64;
        let (from, to) = (self.start.ln(), (FARTHEST * self.start.max(1.0)).ln());
        let errors = (0..=steps).map(|n| {
            let a = (from + (to - from) * f64::from(n) / f64::from(steps)).exp();
            let found = self.scale_factor(self.left - self.cosmology.left(1.0 / a.sqrt()));
            ((a / found).sqrt() - 1.0).abs()
        });
        errors.fold(0.0, f64::max)
    }
    /// The scale factor at a time t; not a number from [`Self::end`] on.
    #[must_use]
    pub fn scale_factor(&self, time: f64) -> f64 {
        let y = (1.0 - time / self.left).sqrt().sqrt();
        let x = 2.0 * y - 1.0;
        // Clenshaw's recurrence.
        let (one, two) = self.terms.iter().skip(1).rev().fold((0.0, 0.0), |(b1, b2), c| (2.0 * x * b1 - b2 + c, b1));
        let u = y * (x * one - two + self.terms[0]);
        1.0 / (u * u)
    }
    /// The time at which a redshift is reached.
    #[must_use]
    pub fn time_at(&self, redshift: f64) -> f64 {
        self.cosmology.time(self.start, super::scale_factor(redshift))
    }
    /// The time at which the scale factor is infinite \[time\].
    #[must_use]
    pub fn end(&self) -> f64 {
        self.left
    }
    /// Values for the overrides of `law/expansion.wgsl`, by name.
    #[must_use]
    pub fn constants(&self) -> Vec<(&'static str, f64)> {
        let values = std::iter::once(self.left).chain(self.terms);
        CONSTANTS.into_iter().zip(values).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::Cosmology;
    use super::Expansion;

    /// Einstein and de Sitter: u = 1 / sqrt(a) falls evenly, by H₀ / 2.
    #[test]
    fn matter_alone_has_a_closed_form() {
        let made = Expansion::new(Cosmology::new(0.7, 1.0, 0.0).expect("one"), 0.02).expect("an expansion");
        for n in 0..1000 {
            let time = made.end() * 0.99 * f64::from(n) / 1000.0;
            let exact = (0.02_f64.powf(-0.5) - 0.35 * time).powi(-2);
            let found = made.scale_factor(time);
            assert!((found / exact - 1.0).abs() < 1e-11, "{time}: {found} {exact}");
        }
        assert!((made.time_at(0.0) - 2.0 / 0.7 * (50.0_f64.sqrt() - 1.0)).abs() < 1e-11);
    }
    /// The inverse of the integral of 1 / (a³ H), which is done here by small steps of the differential equation.
    #[test]
    fn scale_factors_solve_the_equation_of_friedmann() {
        for (matter, lambda, start) in [
            (0.3, 0.7, 0.01),
            (0.25, 0.75, 0.001),
            (0.3, 0.0, 0.02),
            (0.3, 0.5, 0.05),
            (0.3, 0.8, 0.02),
            (0.1, 0.9, 0.5),
            (0.3, 0.7, 1.0),
        ] {
            let universe = Cosmology::new(2.0, matter, lambda).expect("a universe");
            let made = Expansion::new(universe, start).expect("an expansion");
            let slope = |a: f64| a.powi(3) * universe.rate(a);
            let (mut a, steps) = (start, 200_000);
            let dt = universe.time(start, 3.0) / f64::from(steps);
            for n in 0..steps {
                let found = made.scale_factor(dt * f64::from(n));
                assert!(
                    (found / a - 1.0).abs() < if start > 0.005 { 2.5e-7 } else { 6e-7 },
                    "{matter} {lambda} {start}: a = {a}, found {found}"
                );
                let k1 = slope(a);
                let k2 = slope(a + 0.5 * dt * k1);
                let k3 = slope(a + 0.5 * dt * k2);
                a += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + slope(a + dt * k3));
            }
            assert!((a / 3.0 - 1.0).abs() < 1e-7, "{matter} {lambda} {start}: {a}");
        }
    }
    #[test]
    fn universes_that_turn_back_are_refused() {
        for (hubble, matter, lambda) in
            [(0.0, 0.3, 0.7), (1.0, 0.0, 0.7), (1.0, 2.0, 0.0), (1.0, 0.3, -0.1), (1.0, 0.1, 2.5), (f64::NAN, 1.0, 0.0)]
        {
            assert!(Cosmology::new(hubble, matter, lambda).is_err(), "{hubble} {matter} {lambda}");
        }
        assert!(Cosmology::new(1.0, 1.2, 0.7).is_ok());
    }
}
