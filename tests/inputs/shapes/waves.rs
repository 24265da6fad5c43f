//! Random waves in a lattice: as large, as long and as steep as they were asked for, and in the growing mode.

use std::f64::consts::TAU;

use glam::DVec3;
use motes::State;
use motes::settings::Value;

use crate::shapes::{made, settings};

const SPACING: f64 = 0.5;
const GROWTH: f64 = 1.7;

fn lattice(size: [f64; 3], spectrum: f64, displacement: f64, seed: u32) -> State {
    let numbers = [
        ("spacing", SPACING),
        ("displacement", displacement),
        ("spectrum", spectrum),
        ("growth", GROWTH),
        ("seed", f64::from(seed)),
    ];
    made("lattice", &settings("lattice", &numbers).with("size", Value::Vector(DVec3::from_array(size))))
}

/// How far each is from its place, in spacings.
fn waves(size: [f64; 3], spectrum: f64, seed: u32) -> Vec<DVec3> {
    let (straight, bent) = (lattice(size, spectrum, 0.0, seed), lattice(size, spectrum, 0.3, seed));
    let away = straight.position().iter().zip(bent.position()).map(|(a, b)| (*b - *a) / SPACING);
    away.collect()
}

#[test]
fn they_are_as_large_as_was_asked_and_grow() {
    let size = [12.0, 8.0, 5.0];
    let (moved, bent) = (waves(size, -2.0, 3), lattice(size, -2.0, 0.3, 3));
    let mean = moved.iter().sum::<DVec3>() / 480.0;
    let square = moved.iter().map(|d| d.length_squared()).sum::<f64>() / (3.0 * 480.0);
    // Roundings of 480 numbers of some lengths.
    assert!(mean.length() < 1e-12 && (square.sqrt() - 0.3).abs() < 1e-12, "{mean} {square}");
    for (away, velocity) in moved.iter().zip(bent.velocity()) {
        assert!((*velocity - *away * SPACING * GROWTH).length() < 1e-12, "{away} {velocity}");
    }
    // Too few for a wave.
    assert_eq!(lattice([3.0, 2.0, 1.0], -2.0, 0.3, 3), lattice([3.0, 2.0, 1.0], -2.0, 0.0, 3));
}

/// The amplitude of a wave, as its real and its imaginary part.
fn amplitude(moved: &[DVec3], size: [usize; 3], wave: DVec3) -> [DVec3; 2] {
    let mut sums = [DVec3::ZERO; 2];
    for (id, d) in moved.iter().enumerate() {
        let place = [id % size[0], id / size[0] % size[1], id / (size[0] * size[1])];
        let part = |axis: usize| wave[axis] * place[axis] as f64 / size[axis] as f64;
        let angle = TAU * (part(0) + part(1) + part(2));
        sums[0] += *d * angle.cos();
        sums[1] += *d * angle.sin();
    }
    sums
}

#[test]
fn they_are_gradients_with_the_spectrum_that_was_asked() {
    let size = [16, 20, 16];
    let power = |spectrum: f64, wave: DVec3| -> f64 {
        let of = |seed| {
            let moved = waves(size.map(|n| n as f64), spectrum, seed);
            let parts = amplitude(&moved, size, wave);
            let along = DVec3::from_array([0, 1, 2].map(|axis| wave[axis] / size[axis] as f64)).normalize();
            let across = parts.iter().map(|d| (*d - along * d.dot(along)).length()).fold(0.0, f64::max);
            // Roundings of 5120 numbers.
            assert!(across < 1e-9, "{wave}: {across} across");
            parts.iter().map(|d| d.length_squared()).sum::<f64>() / 5120.0_f64.powi(2)
        };
        (1..=16).map(of).sum::<f64>() / 16.0
    };
    for spectrum in [-2.0, 0.0] {
        // |ψ|² ∝ k^(n - 2); k of these are as 1 to 3. Each mean of 16 has a standard error of 25 %, the quotient of 35 %: four.
        let ratio = power(spectrum, DVec3::X) / power(spectrum, 3.0 * DVec3::Z);
        let wanted = 3.0_f64.powf(2.0 - spectrum);
        assert!((ratio / wanted).ln().abs() < 1.4, "{spectrum}: {ratio} for {wanted}");
    }
    // The shortest are those of four particles, along the longest side.
    assert!(power(-2.0, DVec3::new(0.0, 5.0, 0.0)) > 1e-9 && power(-2.0, DVec3::new(0.0, 6.0, 0.0)) < 1e-20);
    assert!(power(-2.0, DVec3::new(4.0, 0.0, 3.0)) < 1e-20);
}
