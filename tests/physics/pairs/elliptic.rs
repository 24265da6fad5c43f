//! Elliptic functions by the arithmetic–geometric mean (Abramowitz & Stegun 1964, 16.4 and 17.6).

/// The complete integral K of a parameter m = k².
pub fn complete(m: f64) -> f64 {
    let (mut a, mut b) = (1.0f64, (1.0 - m).sqrt());
    for _ in 0..10 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    std::f64::consts::PI / (2.0 * a)
}

/// sn, cn and dn of u.
pub fn jacobi(u: f64, m: f64) -> [f64; 3] {
    let (mut a, mut b, mut ratios) = (1.0f64, (1.0 - m).sqrt(), Vec::new());
    for _ in 0..10 {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        ratios.push(c / a);
    }
    let mut angle = 1024.0 * a * u;
    for ratio in ratios.into_iter().rev() {
        angle = 0.5 * (angle + (ratio * angle.sin()).asin());
    }
    let (sn, cn) = angle.sin_cos();
    [sn, cn, (1.0 - m * sn * sn).sqrt()]
}

#[test]
fn known_values() {
    // K(1/2) = Γ(1/4)² / 4√π; sn and cn of K/2 (16.5).
    assert!(
        (complete(0.5) - 1.854_074_677_301_371_9).abs() < 1e-15
            && (complete(0.0) - std::f64::consts::FRAC_PI_2).abs() < 1e-15
    );
    let m: f64 = 0.83;
    let [sn, cn, dn] = jacobi(0.5 * complete(m), m);
    let rest = (1.0 - m).sqrt();
    assert!((sn * sn - 1.0 / (1.0 + rest)).abs() < 1e-13 && (cn * cn - rest / (1.0 + rest)).abs() < 1e-13);
    assert!((dn * dn - rest).abs() < 1e-13, "{sn} {cn} {dn}");
}
