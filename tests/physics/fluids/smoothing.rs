//! Kernels and the equation of state, by themselves.

use std::f64::consts::PI;

use glam::DVec3;
use motes::sph::{Medium, Smoothing};

const KERNELS: [Smoothing; 2] = [Smoothing::Cubic, Smoothing::Wendland];

fn medium(smoothing: Smoothing, support: f64, dimensions: u32) -> Medium {
    let (density, spacing, sound) = (1.7, 0.3, 2.3);
    Medium { density, spacing, support, smoothing, sound, exponent: 7, negative: true, dimensions }
}

/// Simpson's rule. Kernels are polynomials of degree 5 on each half of their support, 7 with the shell's surface: with so
/// many intervals its error is (1/2000)⁴ of derivatives of some hundreds.
fn integral(f: impl Fn(f64) -> f64) -> f64 {
    let n = 2000;
    let weight = |i: i32| f64::from(if i == 0 || i == n { 1 } else { 2 + 2 * (i % 2) });
    (0..=n).map(|i| weight(i) * f(f64::from(i) / f64::from(n))).sum::<f64>() / f64::from(3 * n)
}

#[test]
fn kernels_integrate_to_one() {
    for smoothing in KERNELS {
        for dimensions in [2, 3] {
            let shell = |q: f64| if dimensions == 2 { 2.0 * PI * q } else { 4.0 * PI * q * q };
            let volume = integral(|q| shell(q) * smoothing.constant(dimensions) * smoothing.profile(q));
            assert!((volume - 1.0).abs() < 1e-11, "{smoothing:?} in {dimensions} dimensions: {volume}");
        }
        assert!(
            smoothing.profile(0.0) > 0.0
                && smoothing.profile(1.0).abs() < 1e-300
                && smoothing.profile(1.5).abs() < 1e-300
        );
    }
}

#[test]
fn gradients_are_derivatives() {
    let e = 1e-5;
    for smoothing in KERNELS {
        for q in [0.1, 0.3, 0.499, 0.501, 0.7, 0.9, 1.1] {
            let slope = (smoothing.profile(q + e) - smoothing.profile(q - e)) / (2.0 * e);
            // A central difference errs by e² / 6 of the third derivative, which is below 200; rounding by 1e-16 / e.
            assert!((smoothing.profile_slope(q) * q - slope).abs() < 1e-8, "{smoothing:?} at {q}: {slope}");
        }
        for dimensions in [2, 3] {
            let (me, r) = (medium(smoothing, 2.3, dimensions), DVec3::new(0.2, -0.31, 0.17));
            let moved = |by: f64| me.smoothed().kernel(r - by * DVec3::Y);
            // A particle r away is where the kernel is looked at: to move there is to shorten r.
            let slope = (moved(e) - moved(-e)) / (2.0 * e);
            assert!(
                (me.smoothed().gradient(r) * -r.y - slope).abs() < 1e-7 * slope.abs(),
                "{smoothing:?}, {dimensions}: {slope}"
            );
        }
    }
}

/// Σ W over a cubic lattice, as an independent script has it.
const SUMS: [(Smoothing, u32, [f64; 5]); 4] = [
    (Smoothing::Cubic, 3, [0.99997, 1.0008, 0.9973, 1.0018, 1.0001]),
    (Smoothing::Cubic, 2, [1.0009, 0.9998, 1.0000, 1.0034, 1.0000]),
    (Smoothing::Wendland, 3, [1.0338, 1.0175, 1.0095, 1.0031, 1.0006]),
    (Smoothing::Wendland, 2, [1.0376, 1.0180, 1.0105, 1.0051, 1.0012]),
];

#[test]
fn a_lattice_at_rest_is_at_the_density_of_rest() {
    for (smoothing, dimensions, sums) in SUMS {
        for (support, want) in [2.0, 2.4, 2.6, 3.0, 4.0].into_iter().zip(sums) {
            let sum = smoothing.lattice_sum(support, dimensions);
            // As many digits as there are.
            assert!((sum - want).abs() < 6e-5, "{smoothing:?}, {dimensions} dimensions, {support}: {sum}, not {want}");
            let me = medium(smoothing, support, dimensions);
            let steps = || (-5..=5).map(|i| 0.3 * f64::from(i));
            let flat = |z: &f64| dimensions == 3 || z.abs() < 1e-9;
            let mut density = 0.0;
            for x in steps() {
                for y in steps() {
                    density += steps()
                        .filter(flat)
                        .map(|z| me.mass() * me.smoothed().kernel(DVec3::new(x, y, z)))
                        .sum::<f64>();
                }
            }
            // A sum of at most 300 terms in f64.
            assert!((density / me.density - 1.0).abs() < 1e-13, "{smoothing:?}, {dimensions}, {support}: {density}");
        }
    }
}

#[test]
fn pressure_is_taits_and_energy_its_integral() {
    for exponent in [2, 3, 7, 15] {
        let me = Medium { exponent, ..medium(Smoothing::Cubic, 2.0, 3) };
        let stiffness = 1.7 * 2.3 * 2.3 / f64::from(exponent);
        for ratio in [0.9, 0.999, 1.0, 1.0001, 1.01, 1.3] {
            let density = ratio * me.density;
            let (pressure, energy) = me.state(density);
            let want = stiffness * (f64::powi(ratio, exponent.cast_signed()) - 1.0);
            // Their difference loses digits where the density is all but that of rest.
            assert!(
                (pressure * density * density - want).abs() < 1e-14 * (stiffness + want),
                "γ = {exponent}, {ratio}"
            );
            let e = 1e-6 * density;
            let slope = (me.state(density + e).1 - me.state(density - e).1) / (2.0 * e);
            // By e² / 6 of its third derivative, γ² of it at most; and rounding.
            assert!((slope - pressure).abs() < 1e-9 * (stiffness + pressure.abs()), "γ = {exponent}, {ratio}: {slope}");
            assert!(energy >= 0.0);
        }
        let thin = Medium { negative: false, ..me }.state(0.9 * me.density);
        assert!(thin.0.abs() + thin.1.abs() < 1e-300, "{thin:?}");
    }
}
