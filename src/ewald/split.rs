//! How the field of a periodic cube is cut into a law between two and a sum over waves.

use std::f64::consts::PI;

use glam::{DVec3, DVec4};

/// The law between two is 1 / r − (2 / L) P(1 − (2 r / L)²) up to half a side, and nothing beyond. With t = 2 r / L the part t P(1 − t²) of a
/// mass is smeared over what is nearer than t; its derivative is a window, and a wave of the smooth rest has 4π / k² times the transform of
/// that. How few waves do is a matter of the window.
pub struct Split {
    /// P(v) = Σ c vⁿ.
    coefficients: Vec<f64>,
    /// The maximum |k|² of waves, in periods per side.
    shells: i32,
    /// Whether it is the fitted one, which fades out by the softened distance and has its coefficients in its shaders.
    pub softens: bool,
}

/// The error of the fitted window: the root mean square over the cube of the force of a unit mass on another [G M / L²].
pub const FITTED: f64 = 1.5e-4;
/// The least error that sums in f64 reach with room to spare [G M / L²].
pub const LEAST: f64 = 1e-10;
/// Coefficients of P on a device, in vectors of four: 28, and what is left out changes forces by 7e-6 G M / L² at most where 1e-10 is asked for, and
/// by 3e-8 at 1e-8, below the rounding of single precision.
pub const VECTORS: usize = 7;
/// Parts of an integral: windows are as smooth as a Gaussian of a sixth of their width, and this leaves 1e-13.
const PARTS: u32 = 1 << 14;

impl Split {
    /// For a root mean square error of the force of a unit mass, over the cube [G M / L²].
    pub fn new(accuracy: f64) -> Self {
        if accuracy >= FITTED { Self::fitted() } else { Self::of(sharpness(accuracy)) }
    }
    /// 126 waves up to |k|² = 14. P is (1 − v)^(−1/2) to second order, so that the force and its slope vanish at half a side; the rest was fitted
    /// so that the waves left out are the least, in the mean over the cube, among all polynomials of its degree (`benches/ewald_split.py`;
    /// the idea of the best taper: Shamshirgar, Bagge & Tornberg 2021). The force of a unit mass is wrong by 4.6e-4 G M / L² at most.
    fn fitted() -> Self {
        let coefficients = vec![1.0, 0.5, 0.375, 0.296_344, 0.309_035, 0.003_588, 0.434_914, -0.227_071, 0.161_508];
        Self { coefficients, shells: 14, softens: true }
    }
    /// By the window √(1 − t²) I₁(β √(1 − t²)), which is next to the best for a band of waves (Kaiser & Schafer, IEEE Trans. ASSP 28, 105, 1980, one order above theirs, so
    /// that the force vanishes at half a side). Its P is the series of (1 − v)^(−1/2) with its n-th coefficient faded by what is left from n on of a
    /// sum with terms in the ratio (β / 2)² / (n (n + 3/2)). Waves end where its transform stops falling, and those left out are 35 to 105 exp(−β) in all.
    pub fn of(beta: f64) -> Self {
        let mut terms = vec![1.0];
        let mut n = 1.0;
        while let Some(last) = terms.last().filter(|last| n < beta || **last > 1e-18 * terms.iter().sum::<f64>()) {
            terms.push(last * 0.25 * beta * beta / (n * (n + 1.5)));
            n += 1.0;
        }
        let mut left = 0.0;
        let mut tails: Vec<f64> = terms
            .iter()
            .rev()
            .map(|term| {
                left += term;
                left
            })
            .collect();
        tails.push(left);
        let newton = |n: usize| (1..=n).map(|m| 1.0 - 0.5 / m as f64).product::<f64>();
        let coefficients = tails.iter().rev().enumerate().map(|(n, tail)| newton(n) * tail / left).collect();
        #[expect(clippy::cast_possible_truncation, reason = "below a hundred")]
        let shells = (last_wave(beta) / PI).powi(2).ceil() as i32 - 1;
        Self { coefficients, shells, softens: false }
    }
    /// P, P′, P″ and P‴.
    pub fn taper(&self, v: f64) -> [f64; 4] {
        let mut at = [0.0; 4];
        for c in self.coefficients.iter().rev() {
            at = [at[0] * v + c, at[1] * v + at[0], at[2] * v + at[1], at[3] * v + at[2]];
        }
        [at[0], at[1], 2.0 * at[2], 6.0 * at[3]]
    }
    /// The coefficients of P from the constant on, in fours.
    pub fn vectors(&self) -> [[f64; 4]; VECTORS] {
        let at = |n| self.coefficients.get(n).copied().unwrap_or(0.0);
        std::array::from_fn(|vector| std::array::from_fn(|n| at(4 * vector + n)))
    }
    /// The waves, with how much of each there is: k in turns per side, of k and −k one; the mean of the faded law, which the
    /// background takes away, as the first.
    pub fn waves(&self) -> Vec<DVec4> {
        let places = (0..=PARTS).map(|i| f64::from(i) / f64::from(PARTS));
        // t P(1 − t²) is the part of the mass within t half sides that is smeared out, and its derivative twice the taper's window.
        let smeared: Vec<[f64; 2]> = places.map(|t| [t, t * self.taper(1.0 - t * t)[0]]).collect();
        let end = smeared.last().map_or(0.0, |[_, all]| *all);
        let amount = |square: i32| {
            let k = PI * f64::from(square).sqrt();
            let window = end * k.cos() + k * integral(smeared.iter().map(|[t, part]| part * (k * t).sin()));
            2.0 * window / (PI * f64::from(square))
        };
        let shells: Vec<f64> = (0..=self.shells).map(|square| if square > 0 { amount(square) } else { 0.0 }).collect();
        let mean = PI * integral(smeared.iter().map(|[t, part]| t * (1.0 - part)));
        let mut all = vec![DVec4::new(0.0, 0.0, 0.0, -mean)];
        let most = (1..=self.shells).take_while(|n| n * n <= self.shells).last().unwrap_or(0);
        let along = || -most..=most;
        for (x, y, z) in
            along().flat_map(|x| along().map(move |y| (x, y))).flat_map(|(x, y)| along().map(move |z| (x, y, z)))
        {
            let square = x * x + y * y + z * z;
            if (x, y, z) > (0, 0, 0) && square <= self.shells {
                let k = DVec3::new(f64::from(x), f64::from(y), f64::from(z));
                all.push(k.extend(shells[usize::try_from(square).unwrap_or(0)]));
            }
        }
        all
    }
}

/// β of a window that gives the force of a unit mass such a root mean square error, over the cube [G M / L²].
pub fn sharpness(accuracy: f64) -> f64 {
    (130.0 / accuracy).ln()
}

/// Where waves end: there the transform of the window of β stops falling. In radians per half side.
pub fn last_wave(beta: f64) -> f64 {
    beta / 0.97
}

/// The integral from 0 to 1 of what has such values, by Simpson's rule.
fn integral(values: impl Iterator<Item = f64>) -> f64 {
    let weight = |i: u32| if i == 0 || i == PARTS { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
    (0..=PARTS).zip(values).map(|(i, value)| weight(i) * value).sum::<f64>() / f64::from(3 * PARTS)
}
