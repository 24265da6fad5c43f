//! Discrete Fourier transforms of a cube, of any number of points along a side (Cooley & Tukey 1965), with the same bits on every platform.

use std::f64::consts::TAU;

use rayon::prelude::*;

/// A complex number.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Complex {
    /// Its real part.
    pub re: f64,
    /// Its imaginary part.
    pub im: f64,
}

impl Complex {
    fn plus(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
    fn times(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }
    /// The same, by a real number.
    pub fn scaled(self, by: f64) -> Self {
        Self { re: self.re * by, im: self.im * by }
    }
    /// The same times i.
    pub fn turned(self) -> Self {
        Self { re: -self.im, im: self.re }
    }
}

/// Sums  Σ c(k) exp(±2πi k·x / n)  over a cube of n³ points, x fastest.
pub struct Fourier {
    side: usize,
    roots: Vec<Complex>,
}

impl Fourier {
    /// For a cube of so many points along a side.
    pub fn new(side: usize) -> Self {
        let root = |n: usize| {
            let angle = TAU * n as f64 / side as f64;
            Complex { re: libm::cos(angle), im: libm::sin(angle) }
        };
        Self { side, roots: (0..side).map(root).collect() }
    }
    /// The sums over all waves at each point, with the sign +.
    pub fn points(&self, cube: &mut [Complex]) {
        let n = self.side;
        cube.par_chunks_mut(n).for_each_init(|| vec![Complex::default(); n], |line, x| self.line(x, line));
        // Planes of z hold all lines along y; lines along z are gathered from all planes.
        cube.par_chunks_mut(n * n).for_each(|plane| {
            let (mut from, mut line) = (vec![Complex::default(); n], vec![Complex::default(); n]);
            for x in 0..n {
                (0..n).for_each(|y| from[y] = plane[x + n * y]);
                self.sum(&from, 1, &mut line, 1);
                (0..n).for_each(|y| plane[x + n * y] = line[y]);
            }
        });
        let columns: Vec<Vec<Complex>> = (0..n * n)
            .into_par_iter()
            .map(|at| {
                let from: Vec<Complex> = (0..n).map(|z| cube[at + n * n * z]).collect();
                let mut line = vec![Complex::default(); n];
                self.sum(&from, 1, &mut line, 1);
                line
            })
            .collect();
        cube.par_chunks_mut(n * n).enumerate().for_each(|(z, plane)| {
            plane.iter_mut().zip(&columns).for_each(|(to, column)| *to = column[z]);
        });
    }
    /// The waves of what is given at all points: the sums with the sign −, over the number of points.
    pub fn waves(&self, cube: &mut [Complex]) {
        cube.par_iter_mut().for_each(|c| c.im = -c.im);
        self.points(cube);
        let share = 1.0 / cube.len() as f64;
        cube.par_iter_mut().for_each(|c| *c = Complex { re: c.re * share, im: -c.im * share });
    }
    fn line(&self, line: &mut [Complex], room: &mut [Complex]) {
        room.copy_from_slice(line);
        self.sum(room, 1, line, 1);
    }
    /// The sums of every `stride`th number, with every `turn`th root.
    fn sum(&self, from: &[Complex], stride: usize, to: &mut [Complex], turn: usize) {
        let n = to.len();
        if n == 1 {
            to[0] = from[0];
            return;
        }
        let parts = (2..n).take_while(|p| p * p <= n).find(|p| n.is_multiple_of(*p)).unwrap_or(n);
        let length = n / parts;
        for part in 0..parts {
            self.sum(&from[part * stride..], stride * parts, &mut to[part * length..][..length], turn * parts);
        }
        let root = |n: usize| self.roots[n * turn % self.side];
        if parts == 2 {
            for k in 0..length {
                let (even, odd) = (to[k], to[length + k].times(root(k)));
                (to[k], to[length + k]) = (even.plus(odd), even.plus(odd.scaled(-1.0)));
            }
            return;
        }
        let mut terms = vec![Complex::default(); parts];
        for k in 0..length {
            for (part, term) in terms.iter_mut().enumerate() {
                *term = to[part * length + k].times(root(part * k % n));
            }
            for q in 0..parts {
                let all = terms.iter().enumerate();
                to[q * length + k] =
                    all.fold(Complex::default(), |sum, (part, term)| sum.plus(term.times(root(part * q * length % n))));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Complex, Fourier};

    /// Against the sums themselves, with factors 2, 3, 5, 7 and primes.
    #[test]
    fn transforms_are_the_sums() {
        for n in [1, 2, 3, 4, 6, 7, 8, 10] {
            let mut next = 1_u64;
            let mut random = || {
                next = next.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                f64::from(u32::try_from(next >> 40).unwrap_or(0)) / f64::from(1 << 24) - 0.5
            };
            let waves: Vec<Complex> = (0..n * n * n).map(|_| Complex { re: random(), im: random() }).collect();
            let mut found = waves.clone();
            let made = Fourier::new(n);
            made.points(&mut found);
            let split = |at: usize| [at % n, at / n % n, at / (n * n)];
            for (at, found) in found.iter().enumerate() {
                let (mut re, mut im) = (0.0, 0.0);
                for (k, c) in waves.iter().enumerate() {
                    let turns: usize = split(at).iter().zip(split(k)).map(|(x, k)| x * k).sum();
                    let (sine, cosine) = (std::f64::consts::TAU * turns as f64 / n as f64).sin_cos();
                    re += c.re * cosine - c.im * sine;
                    im += c.re * sine + c.im * cosine;
                }
                assert!((found.re - re).abs() + (found.im - im).abs() < 1e-11, "{n} {at}");
            }
            made.waves(&mut found);
            for (found, c) in found.iter().zip(&waves) {
                assert!((found.re - c.re).abs() + (found.im - c.im).abs() < 1e-13, "{n}");
            }
        }
    }
}
