//! The direct sum in f64: what forces of a tree are held against.

use glam::{DVec3, Vec4};
use rayon::prelude::*;

/// Targets of a sample, at most.
const TARGETS: usize = 1000;

/// How far forces are from the direct sum over all bodies: |a - a_direct| / |a_direct|, of a sample of targets evenly
/// spread over the ids. Median, 99th percentile, maximum. Bodies are positions and masses; G = 1.
pub fn errors(bodies: &[Vec4], accelerations: &[Vec4], softening: f64) -> [f64; 3] {
    let stride = bodies.len().div_ceil(TARGETS).max(1);
    let targets: Vec<usize> = (0..bodies.len()).step_by(stride).collect();
    let error = |target: &usize| {
        let exact = attraction(bodies, *target, softening);
        (accelerations[*target].truncate().as_dvec3() - exact).length() / exact.length()
    };
    let mut errors: Vec<f64> = targets.par_iter().map(error).collect();
    errors.sort_by(f64::total_cmp);
    let rank = |percent: usize| errors.get((errors.len() * percent / 100).min(errors.len().saturating_sub(1)));
    [50, 99, 100].map(|percent| rank(percent).copied().unwrap_or(f64::NAN))
}

/// The acceleration of one body by all; its own share is zero.
fn attraction(bodies: &[Vec4], target: usize, softening: f64) -> DVec3 {
    let me = bodies[target].truncate().as_dvec3();
    let mut sum = DVec3::ZERO;
    for (_, you) in bodies.iter().enumerate().filter(|(id, _)| *id != target) {
        let r = you.truncate().as_dvec3() - me;
        let square = r.length_squared() + softening * softening;
        sum += r * (f64::from(you.w) / (square * square.sqrt()));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_force_is_as_wrong_as_it_is() {
        // Two bodies, r² + ε² = 25: a = 5 · 3 / 125 and 2 · 3 / 125.
        let bodies = [Vec4::new(0.0, 0.0, 0.0, 2.0), Vec4::new(3.0, 0.0, 0.0, 5.0)];
        let right = [Vec4::new(0.12, 0.0, 0.0, 7.0), Vec4::new(-0.048, 0.0, 0.0, 7.0)];
        assert!(errors(&bodies, &right, 4.0)[2] < 1e-7);
        let wrong = [right[0], right[1] + Vec4::Y * 0.0048];
        let [median, _, max] = errors(&bodies, &wrong, 4.0);
        assert!((median - 0.1).abs() < 1e-6 && (max - 0.1).abs() < 1e-6, "{median} {max}");
    }
}
