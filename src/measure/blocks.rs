//! The standard error of the mean of a series whose values are correlated, by block averages.

/// The fewest blocks whose scatter is an error.
const FEWEST: usize = 8;

/// Averages over blocks of b = 1, 2, 4, … values have the scatter of independent ones once b exceeds the time of correlation (Flyvbjerg &
/// Petersen, J. Chem. Phys. 91, 461, 1989). The error is that of the smallest b for which b³ > 2 n (σ_b / σ₁)⁴, where what the
/// blocks still have in common is less than the uncertainty of their own scatter (Lee et al., Phys. Rev. E 83, 066706, 2011). `None` if
/// there are fewer than 8 such blocks: the series is too short.
pub(super) fn error(values: &[f64]) -> Option<f64> {
    let (whole, mut blocks, mut length) = (values.len() as f64, values.to_vec(), 1.0_f64);
    let alone = squared(values);
    while blocks.len() >= FEWEST {
        let square = squared(&blocks);
        // A series of equal values has no error.
        let growth = if alone > 0.0 { square / alone } else { 0.0 };
        if length.powi(3) > 2.0 * whole * growth * growth {
            return Some(square.sqrt());
        }
        blocks = blocks.chunks_exact(2).map(|two| 0.5 * (two[0] + two[1])).collect();
        length *= 2.0;
    }
    None
}

/// The squared error of the mean of independent values.
fn squared(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (count * (count - 1.0).max(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::visit::random::{fraction, pcg4d};

    /// xₙ = φ xₙ₋₁ + noise of unit variance, uniform.
    fn correlated(phi: f64, count: u32, seed: u32) -> Vec<f64> {
        let noise = |n: u32| 12.0_f64.sqrt() * (fraction(pcg4d([n, seed, 0, 7])[0]) - 0.5);
        let mut x = 0.0;
        let next = |n: u32| {
            x = phi * x + noise(n);
            x
        };
        (0..count).map(next).collect()
    }

    /// The variance of the mean of n such values is 1 / (1 − φ)² n, for n far above the time of correlation. Of b³ > 2 n (2 τ)² values to a block,
    /// 64 and 128 for φ = 0.9, there are 512 and 256 or more: errors of 1 / √(2 · 256) = 4.4 % each, and what blocks share adds 2 τ / 2 b ≤ 15 %.
    #[test]
    fn errors_are_those_of_correlated_values() {
        for (phi, seed) in [(0.0, 1), (0.0, 2), (0.9, 3), (0.9, 4), (0.9, 5), (-0.5, 6)] {
            let count = 32_768;
            let values = correlated(phi, count, seed);
            let want = 1.0 / ((1.0 - phi) * f64::from(count).sqrt());
            let have = error(&values).expect("enough values");
            assert!((have / want - 1.0).abs() < 0.2, "{phi} {seed}: {have} {want}");
            if phi > 0.5 {
                assert!(squared(&values).sqrt() < 0.3 * want, "without blocks it is too small");
            }
        }
    }
    #[test]
    fn series_that_are_too_short_have_none() {
        assert_eq!(error(&[]), None);
        assert_eq!(error(&[1.0, 2.0, 3.0]), None);
        assert_eq!(error(&correlated(0.99, 400, 1)), None);
        assert_eq!(error(&(0..1000).map(f64::from).collect::<Vec<_>>()), None, "a drift");
        assert_eq!(error(&[2.0; 100]), Some(0.0));
    }
}
