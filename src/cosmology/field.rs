//! Gaussian random fields, and the displacements of a lattice by which gravity has moved it, to first order (Zel'dovich 1970) and to second
//! (Bouchet et al. 1995; Scoccimarro 1998).

use std::f64::consts::TAU;

use glam::DVec3;
use rayon::prelude::*;

use super::fourier::{Complex, Fourier};

/// Displacements at the points of a cube, x fastest, for a growth of one: of first order, and those of second.
pub struct Displacements {
    /// −∇φ₁, with ∇²φ₁ = δ.
    pub first: Vec<DVec3>,
    /// ∇φ₂, with ∇²φ₂ = Σ φ₁,ii φ₁,jj − φ₁,ij² over pairs of axes; empty where it is not asked for.
    pub second: Vec<DVec3>,
}

/// Those of a periodic cube of a side, with so many points along it, of a field δ of which `power(k)` \[length³\] is the power spectrum. `random`
/// gives normal numbers; the same ones make the same waves of a finer cube.
pub fn displacements(
    (points, side): (usize, f64),
    power: impl Fn(f64) -> f64,
    mut random: impl FnMut() -> f64,
    second: bool,
) -> Displacements {
    let fourier = Fourier::new(points);
    let waves = density(points, side, &power, &mut random);
    Cube { points, side, fourier }.displacements(&waves, second)
}

/// The waves of δ, those that the points resolve: shell by shell, so that those of a coarser cube come first.
fn density(points: usize, side: f64, power: &dyn Fn(f64) -> f64, random: &mut dyn FnMut() -> f64) -> Vec<Complex> {
    let mut waves = vec![Complex::default(); points * points * points];
    let most = i64::try_from(points.saturating_sub(1) / 2).unwrap_or(0);
    let place = |n: i64| usize::try_from(n.rem_euclid(i64::try_from(points).unwrap_or(1))).unwrap_or(0);
    let at = |i: i64, j: i64, l: i64| place(i) + points * (place(j) + points * place(l));
    let volume = side * side * side;
    for shell in 1..=most {
        for l in 0..=shell {
            for j in -shell..=shell {
                for i in -shell..=shell {
                    // Of a wave and its opposite one is drawn.
                    let first = l > 0 || j > 0 || (j == 0 && i > 0);
                    if !first || i.abs().max(j.abs()).max(l) != shell {
                        continue;
                    }
                    let k = TAU / side * ((i * i + j * j + l * l) as f64).sqrt();
                    let size = (0.5 * power(k) / volume).sqrt();
                    let wave = Complex { re: size * random(), im: size * random() };
                    waves[at(i, j, l)] = wave;
                    waves[at(-i, -j, -l)] = Complex { re: wave.re, im: -wave.im };
                }
            }
        }
    }
    waves
}

struct Cube {
    points: usize,
    side: f64,
    fourier: Fourier,
}

impl Cube {
    /// Those of a field of such waves.
    fn displacements(&self, waves: &[Complex], second: bool) -> Displacements {
        let first = self.gradient(waves, -1.0);
        if !second {
            return Displacements { first, second: Vec::new() };
        }
        let [xx, yy, zz] = [(0, 0), (1, 1), (2, 2)].map(|axes| self.curvature(waves, axes));
        let mut source: Vec<Complex> = (0..xx.len())
            .into_par_iter()
            .map(|i| Complex { re: xx[i] * yy[i] + xx[i] * zz[i] + yy[i] * zz[i], im: 0.0 })
            .collect();
        drop([xx, yy, zz]);
        for axes in [(0, 1), (0, 2), (1, 2)] {
            let mixed = self.curvature(waves, axes);
            source.par_iter_mut().zip(mixed).for_each(|(sum, one)| sum.re -= one * one);
        }
        self.fourier.waves(&mut source);
        Displacements { first, second: self.gradient(&source, 1.0) }
    }
    /// The wave vector of a place; none where it is longer than the points resolve, of which the sign is not known.
    fn vector(&self, place: usize) -> Option<DVec3> {
        let n = self.points;
        let signed = |k: usize| if 2 * k < n { k as f64 } else { k as f64 - n as f64 };
        let axes = [place % n, place / n % n, place / (n * n)];
        if axes.iter().any(|k| 2 * k == n) || place == 0 {
            return None;
        }
        Some(TAU / self.side * DVec3::from_array(axes.map(signed)))
    }
    /// A real field whose waves are those of the source times a complex number: the real part of `by`, or i times it.
    fn field(&self, source: &[Complex], by: impl Fn(DVec3) -> f64 + Sync, turned: bool) -> Vec<f64> {
        let wave = |(place, c): (usize, &Complex)| {
            let c = self.vector(place).map_or(Complex::default(), |k| c.scaled(by(k)));
            if turned { c.turned() } else { c }
        };
        let mut cube: Vec<Complex> = source.par_iter().enumerate().map(wave).collect();
        self.fourier.points(&mut cube);
        cube.into_iter().map(|c| c.re).collect()
    }
    /// The gradient of φ, with ∇²φ = the source, times a factor.
    fn gradient(&self, source: &[Complex], factor: f64) -> Vec<DVec3> {
        let [x, y, z] = [0, 1, 2].map(|axis| self.field(source, |k| -factor * k[axis] / k.length_squared(), true));
        x.into_iter().zip(y).zip(z).map(|((x, y), z)| DVec3::new(x, y, z)).collect()
    }
    /// φ,ij with ∇²φ = the source.
    fn curvature(&self, source: &[Complex], (i, j): (usize, usize)) -> Vec<f64> {
        self.field(source, |k| k[i] * k[j] / k.length_squared(), false)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use glam::DVec3;

    use super::super::fourier::{Complex, Fourier};
    use super::{Cube, displacements};

    fn normal(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        let mut uniform = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (f64::from(u32::try_from(state >> 32).unwrap_or(0)) + 0.5) / 4_294_967_296.0
        };
        move || (-2.0 * uniform().ln()).sqrt() * (2.0 * PI * uniform()).cos()
    }

    /// The mean square of each component is ∫ P(k) / k² over waves, by the sum that it is of.
    #[test]
    fn displacements_have_the_power_that_is_asked_for() {
        let (points, side) = (12, 30.0);
        let power = |k: f64| 7.0 / (0.01 + k * k);
        let mut expected = 0.0;
        for l in -5_i32..=5 {
            for j in -5_i32..=5 {
                for i in -5_i32..=5 {
                    let k = 2.0 * PI / side * DVec3::new(f64::from(i), f64::from(j), f64::from(l));
                    if k.length() > 0.0 {
                        expected += power(k.length()) / side.powi(3) / k.length_squared();
                    }
                }
            }
        }
        let (mut sum, seeds) = (0.0, 60);
        for seed in 0..seeds {
            let made = displacements((points, side), power, normal(seed), false);
            sum += made.first.iter().map(|d| d.length_squared()).sum::<f64>() / (points * points * points) as f64;
        }
        // 26 waves have most of it, each with a deviation of its own size: 1 / sqrt(13 · 60) is 4 %.
        let found = sum / f64::from(u32::try_from(seeds).unwrap_or(1));
        assert!((found / expected - 1.0).abs() < 0.12, "{found} {expected}");
    }
    /// A finer cube has the same long waves.
    #[test]
    fn waves_do_not_depend_on_the_resolution() {
        let power = |k: f64| if k < 2.0 * PI / 30.0 * 2.9 { 1.0 } else { 0.0 };
        let [coarse, fine] = [8, 16].map(|points| displacements((points, 30.0), power, normal(5), true));
        for z in 0..8 {
            for y in 0..8 {
                for x in 0..8 {
                    let (a, b) = (x + 8 * (y + 8 * z), 2 * x + 16 * (2 * y + 32 * z));
                    assert!((coarse.first[a] - fine.first[b]).length() < 1e-12);
                }
            }
        }
        assert!(fine.second.iter().any(|d| d.length() > 1e-6));
    }
    /// Two plane waves across each other, along axes and along diagonals: of what does not depend on the axes, the source is the product of their δ.
    #[test]
    fn the_second_order_of_crossed_waves_has_a_closed_form() {
        let (points, side) = (16_usize, 1.0);
        for [p, q] in
            [[[1, 0, 0], [0, 2, 0]], [[1, 1, 0], [1, -1, 0]], [[0, 1, 2], [0, -2, 1]], [[2, 0, -1], [1, 0, 2]]]
        {
            let (a, b) = (0.3, 0.2);
            let cube = Cube { points, side, fourier: Fourier::new(points) };
            let mut waves = vec![Complex::default(); points * points * points];
            // δ = A cos p·x + B cos q·x
            let n = i32::try_from(points).expect("few");
            for (k, size) in [(p, a), (q, b)] {
                for sign in [1, -1] {
                    let at = k.map(|k: i32| usize::try_from((sign * k).rem_euclid(n)).expect("a place"));
                    waves[at[0] + points * (at[1] + points * at[2])].re += 0.5 * size;
                }
            }
            let made = cube.displacements(&waves, true);
            let [p, q] = [p, q].map(|k| 2.0 * PI * DVec3::from_array(k.map(f64::from)));
            for (at, (one, two)) in made.first.iter().zip(&made.second).enumerate() {
                let place = [at % points, at / points % points, at / (points * points)];
                let x = DVec3::from_array(place.map(|n| n as f64 / points as f64));
                let (u, v) = (p.dot(x), q.dot(x));
                // −∇φ₁ = −A sin(p·x) p / p² − …: towards the crests.
                let expected = -a * u.sin() * p / p.length_squared() - b * v.sin() * q / q.length_squared();
                assert!((*one - expected).length() < 1e-12, "{one} {expected}");
                // ∇²φ₂ = A B cos(p·x) cos(q·x).
                let k = (p + q).length_squared();
                let expected = a * b / k * (p * u.sin() * v.cos() + q * u.cos() * v.sin());
                assert!((*two - expected).length() < 1e-12, "{p} {q}: {two} {expected}");
            }
        }
    }
}
