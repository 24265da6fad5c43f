//! How small waves of the density grow.

use super::{Cosmology, integral};

impl Cosmology {
    /// The factor D by which waves of the density have grown, the growing mode of linear theory (Heath 1977), which is a early on, where
    /// matter is all: D = 5/2 Ω_m (H / H₀) ∫ da / (a H / H₀)³.
    #[must_use]
    pub fn growth(&self, a: f64) -> f64 {
        let speed = |a: f64| (self.matter / a + self.curvature() + self.lambda * a * a).sqrt();
        let inverse = |a: f64| 1.0 / (speed(a) * speed(a) * speed(a));
        2.5 * self.matter * self.relative_rate(a) * integral(a, inverse)
    }
    /// The rate of that growth, f = d ln D / d ln a.
    #[must_use]
    pub fn growth_rate(&self, a: f64) -> f64 {
        let square = self.relative_rate(a) * self.relative_rate(a);
        let slope = -(1.5 * self.matter / (a * a * a) + self.curvature() / (a * a)) / square;
        slope + 2.5 * self.matter / (a * a * square * self.growth(a))
    }
    /// The same of waves to second order (Bouchet et al. 1995), the growth and its rate: −3/7 D² Ω_m(a)^(−1/143) and 2 Ω_m(a)^(6/11), which are those of a flat
    /// universe; without a cosmological constant −3/7 D² Ω_m(a)^(−2/63) and 2 Ω_m(a)^(4/7).
    #[must_use]
    pub fn second_growth(&self, a: f64) -> [f64; 2] {
        let share = self.matter_at(a);
        let first = self.growth(a);
        let open = self.lambda == 0.0 && self.curvature() > 0.0;
        let [size, rate] = if open { [-2.0 / 63.0, 4.0 / 7.0] } else { [-1.0 / 143.0, 6.0 / 11.0] };
        [-3.0 / 7.0 * first * first * libm::pow(share, size), 2.0 * libm::pow(share, rate)]
    }
}

#[cfg(test)]
mod tests {
    use super::super::Cosmology;

    /// The fit of Carroll, Press & Turner (1992), which errs by 2 %, and its closed forms.
    #[test]
    fn growth_is_that_of_linear_theory() {
        let flat = Cosmology::new(1.0, 1.0, 0.0).expect("a universe");
        for a in [0.01, 0.3, 1.0, 2.0] {
            assert!((flat.growth(a) / a - 1.0).abs() < 1e-12, "{a}");
            assert!((flat.growth_rate(a) - 1.0).abs() < 1e-12, "{a}");
        }
        for (matter, lambda) in [(0.3, 0.7), (0.3, 0.0), (0.2, 0.5)] {
            let universe = Cosmology::new(3.0, matter, lambda).expect("a universe");
            let fit =
                2.5 * matter / (f64::powf(matter, 4.0 / 7.0) - lambda + (1.0 + matter / 2.0) * (1.0 + lambda / 70.0));
            assert!((universe.growth(1.0) / fit - 1.0).abs() < 0.02, "{matter} {lambda}");
            // What the rate is of.
            for a in [0.02, 0.5, 1.0, 3.0_f64] {
                let [low, high] = [-1e-4_f64, 1e-4].map(|by| universe.growth(a * by.exp()).ln());
                assert!(((high - low) / 2e-4 - universe.growth_rate(a)).abs() < 1e-6, "{matter} {lambda} {a}");
            }
        }
        // An open universe without a cosmological constant, by x = (1 − Ω) a / Ω (Peebles 1980, 11.16).
        let open = Cosmology::new(1.0, 0.3, 0.0).expect("a universe");
        for a in [0.1, 0.5, 1.0, 4.0_f64] {
            let x = 0.7 * a / 0.3;
            let d = 1.0 + 3.0 / x + 3.0 * ((1.0 + x) / x.powi(3)).sqrt() * ((1.0 + x).sqrt() - x.sqrt()).ln();
            // Early on it is 2/5 x.
            assert!((open.growth(a) * 0.4 * 0.7 / 0.3 / d - 1.0).abs() < 1e-9, "{a}");
        }
    }
}
