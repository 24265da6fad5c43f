//! A number in text.

/// A number in its usual notation: with twelve digits, which hides the rounding errors of sums and products.
#[must_use]
pub fn plain(x: f64) -> String {
    let x = format!("{x:.11e}").parse().unwrap_or(x);
    if x == 0.0 || (1e-4..1e7).contains(&x.abs()) { format!("{x}") } else { format!("{x:e}") }
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn numbers_are_written_as_one_would() {
        let written = [7.0 * 0.2, 4e-6 * 0.1, 1e20, -0.00025, 0.0, 1600.0].map(plain);
        assert_eq!(written, ["1.4", "4e-7", "1e20", "-0.00025", "0", "1600"]);
    }
}
