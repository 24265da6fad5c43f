//! Accelerations along a step as a polynomial, by its divided differences at the nodes.

use glam::{DVec3, DVec4};

/// Nodes after the start of a step, and divided differences.
pub const NODES: u32 = 7;
/// The start and the nodes: zeros of P₇ + P₈ of 2 h − 1 (Radau 1880), as in the shader.
pub const NODE: [f64; 8] = [
    0.0,
    0.056_262_560_536_922_15,
    0.180_240_691_736_892_36,
    0.352_624_717_113_169_6,
    0.547_153_626_330_555_4,
    0.734_210_177_215_410_5,
    0.885_320_946_839_095_8,
    0.977_520_613_561_287_5,
];

/// The integrals of the terms h (h − h₁) … (h − hₖ), and the integrals of these, from 0 to h.
pub fn integrals(h: f64) -> [[f64; NODES as usize]; 2] {
    let mut all = [[0.0; NODES as usize]; 2];
    let mut term = vec![1.0];
    for k in 0..NODES as usize {
        // The coefficients of the term, times another factor.
        let mut next = vec![0.0; term.len() + 1];
        for (power, coefficient) in term.iter().enumerate() {
            next[power + 1] += coefficient;
            next[power] -= NODE[k] * coefficient;
        }
        term = next;
        for (power, coefficient) in term.iter().enumerate() {
            let n = power as f64;
            let once = coefficient * h.powf(n + 1.0) / (n + 1.0);
            all[0][k] += once;
            all[1][k] += once * h / (n + 2.0);
        }
    }
    all
}

/// The polynomial from another start, with its length in the new step's: by its powers.
pub fn predicted(differences: &[DVec3; NODES as usize], start: f64, ratio: f64) -> [DVec3; NODES as usize] {
    let last = NODES as usize;
    let mut power = [DVec3::ZERO; NODES as usize + 1];
    power[1..].copy_from_slice(differences);
    for k in (1..last).rev() {
        for j in k..last {
            power[j] -= NODE[k] * power[j + 1];
        }
    }
    for k in 0..last {
        for j in (k..last).rev() {
            power[j] += start * power[j + 1];
        }
    }
    let mut scale = 1.0;
    for power in &mut power[1..] {
        scale *= ratio;
        *power *= scale;
    }
    for (k, node) in NODE.iter().enumerate().take(last).skip(1) {
        for j in (k..last).rev() {
            power[j] += node * power[j + 1];
        }
    }
    let mut all = [DVec3::ZERO; NODES as usize];
    all.copy_from_slice(&power[1..]);
    all
}

/// The divided difference of an acceleration at a node, less that at the start.
pub fn difference(acceleration: DVec3, differences: &[DVec4], node: usize) -> DVec3 {
    let first = acceleration / NODE[node];
    (1..node).fold(first, |sum, k| (sum - differences[k - 1].truncate()) / (NODE[node] - NODE[k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// P₇ + P₈ by Bonnet's recursion.
    fn radau(x: f64) -> f64 {
        let (mut before, mut now) = (1.0, x);
        for n in 1..7 {
            let n = f64::from(n);
            (before, now) = (now, ((2.0 * n + 1.0) * x * now - n * before) / (n + 1.0));
        }
        now + (15.0 * x * now - 7.0 * before) / 8.0
    }

    #[test]
    fn nodes_are_zeros() {
        for node in NODE {
            let x = 2.0 * node - 1.0;
            let slope = (radau(x + 1e-6) - radau(x - 1e-6)) / 2e-6;
            assert!((radau(x) / slope).abs() < 1e-15 * 3.0, "{node}");
        }
    }

    /// A polynomial of degree 7 is its divided differences, and its integrals are exact.
    #[test]
    fn integrals_of_powers() {
        for power in 1..=7 {
            let mut g = [DVec4::ZERO; NODES as usize];
            for n in 1..NODE.len() {
                g[n - 1] = difference(DVec3::splat(NODE[n].powi(power)), &g, n).extend(0.0);
            }
            let terms = g.map(DVec4::truncate);
            // From t = a on in parts of s: the differences of ((a + s h)ⁿ − aⁿ).
            for (a, s) in [(1.0_f64, 0.7), (0.0, 0.3), (1.0, 2.5)] {
                let mut want = [DVec4::ZERO; NODES as usize];
                for n in 1..NODE.len() {
                    let value = (a + s * NODE[n]).powi(power) - a.powi(power);
                    want[n - 1] = difference(DVec3::splat(value), &want, n).extend(0.0);
                }
                for (found, want) in predicted(&terms, a, s).iter().zip(want) {
                    assert!(
                        (found.x - want.x).abs() < 1e-10 * s.powi(power).max(1.0),
                        "{power}, {a}, {s}: {found}, {want}"
                    );
                }
            }
            for h in [0.3, 1.0, 1.7] {
                let n = f64::from(power);
                let [once, twice] = integrals(h).map(|all| all.iter().zip(&terms).map(|(w, g)| w * g.x).sum::<f64>());
                assert!((once - h.powi(power + 1) / (n + 1.0)).abs() < 1e-12, "{power}, {h}: {once}");
                assert!((twice - h.powi(power + 2) / ((n + 1.0) * (n + 2.0))).abs() < 1e-12, "{power}, {h}: {twice}");
            }
        }
    }
}
