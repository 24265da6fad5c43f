//! How cost grows with the size of a problem, out of what was measured at some sizes.

/// Where a ratio rises through 1 for the last time, a straight line in the logarithms between two sizes; `None` where it
/// does not among these. Points are sizes and ratios, in ascending order of sizes.
pub fn crossing(points: &[(f64, f64)]) -> Option<f64> {
    let pair = points.windows(2).rfind(|pair| pair[0].1 < 1.0 && pair[1].1 >= 1.0)?;
    let [(low, below), (high, above)] = [pair[0], pair[1]].map(|(size, ratio)| (size.ln(), ratio.ln()));
    Some((low + (high - low) * below / (below - above)).exp())
}

/// p of  cost ∝ N^p  over the last three steps from size to size, or as many as there are; `None` with fewer than two
/// sizes. Points are sizes and costs, in ascending order of sizes.
pub fn growth(points: &[(f64, f64)]) -> Option<f64> {
    let [first, .., last] = &points[points.len().saturating_sub(4)..] else { return None };
    Some((last.1 / first.1).ln() / (last.0 / first.0).ln())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_in_the_logarithms_cross_where_they_do() {
        // N / 3000, and a bump of noise below.
        let points = [(512.0, 1.2), (1024.0, 0.3), (2048.0, 2048.0 / 3000.0), (4096.0, 4096.0 / 3000.0), (8192.0, 3.0)];
        assert!(crossing(&points).is_some_and(|n| (n - 3000.0).abs() < 1e-6), "{:?}", crossing(&points));
        assert_eq!((crossing(&points[3..]), crossing(&points[..3]), crossing(&[])), (None, None, None));
    }

    #[test]
    fn a_power_is_found_in_the_tail() {
        let points: Vec<(f64, f64)> =
            [1.0, 8.0, 16.0, 32.0, 64.0].iter().map(|n: &f64| (*n, 5.0 * n.powf(1.3))).collect();
        let noisy: Vec<(f64, f64)> = [(0.5, 100.0)].into_iter().chain(points[1..].to_vec()).collect();
        assert!(growth(&noisy).is_some_and(|p| (p - 1.3).abs() < 1e-12), "{:?}", growth(&noisy));
        assert_eq!((growth(&points[..1]), growth(&points[..2]).map(|p| (10.0 * p).round())), (None, Some(13.0)));
    }
}
