//! A step of a weakly compressible fluid in plain Rust, by the same algorithm: a counting sort by cell, density by summation
//! and pressure with artificial viscosity over rows of three cells, in f32, over all cores. Nothing by hand; the instruction set
//! is the one cargo compiled for.

use motes::sph::{Friction, Medium};
use rayon::prelude::*;

use super::cells::sorted;

/// A fluid in a periodic cube from 0 to `side`.
pub struct Water {
    position: Vec<[f32; 3]>,
    velocity: Vec<[f32; 3]>,
    side: f32,
    cells: usize,
    law: Law,
}

/// What it is made of, as the device has it.
#[derive(Clone, Copy)]
struct Law {
    mass: f32,
    range: f32,
    weight: f32,
    slope: f32,
    density: f32,
    stiffness: f32,
    sound: f32,
    alpha: f32,
    cubic: bool,
}

/// A neighbour: where it is, its density, how it moves, and p / ρ².
type Flow = [f32; 8];

impl Water {
    /// At these places, at rest.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "single precision, and a small whole number"
    )]
    pub fn new(position: Vec<[f32; 3]>, side: f64, medium: &Medium, friction: Friction) -> Self {
        let law = Law {
            mass: medium.mass() as f32,
            range: medium.range() as f32,
            weight: medium.weight() as f32,
            slope: (medium.weight() / medium.range().powi(2)) as f32,
            density: medium.density as f32,
            stiffness: medium.stiffness() as f32,
            sound: medium.sound as f32,
            alpha: friction.alpha as f32,
            cubic: medium.smoothing == motes::sph::Smoothing::Cubic,
        };
        let velocity = vec![[0.0; 3]; position.len()];
        let cells = ((side / medium.range()).floor() as usize).max(3);
        Self { position, velocity, side: side as f32, cells, law }
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "a float to an integer saturates"
    )]
    fn cell(&self, x: [f32; 3]) -> [usize; 3] {
        x.map(|x| ((x * (self.cells as f32 / self.side)) as usize).min(self.cells - 1))
    }
    fn key(&self, [x, y, z]: [usize; 3]) -> usize {
        x + self.cells * (y + self.cells * z)
    }
    /// One step of the symplectic Euler method.
    pub fn step(&mut self, dt: f32) {
        let keys: Vec<u32> =
            self.position.par_iter().map(|x| u32::try_from(self.key(self.cell(*x))).unwrap_or(0)).collect();
        let (starts, ids) = sorted(&keys, self.cells.pow(3));
        let sorted: Vec<[f32; 3]> = ids.par_iter().map(|i| self.position[*i as usize]).collect();
        let law = self.law;
        let all = || (0..sorted.len()).into_par_iter().with_min_len(256);
        let flows: Vec<Flow> = all()
            .map(|slot| {
                let mut sum = law.profile(0.0);
                self.around(sorted[slot], &starts, |j, shift| {
                    let square = apart(sorted[slot], sorted[j], shift).1;
                    if square < law.range * law.range && j != slot {
                        sum += law.profile(square.sqrt() / law.range);
                    }
                });
                let rho = law.mass * law.weight * sum;
                let e = ((rho - law.density) / law.density).max(0.0);
                let x = 1.0 + e;
                let powers = 1.0 + x * (1.0 + x * (1.0 + x * (1.0 + x * (1.0 + x * (1.0 + x)))));
                let ([x, y, z], [u, v, w]) = (sorted[slot], self.velocity[ids[slot] as usize]);
                [x, y, z, rho, u, v, w, law.stiffness * e * powers / (rho * rho)]
            })
            .collect();
        let pushes: Vec<[f32; 3]> = all()
            .map(|slot| {
                let (me, mut sum) = (flows[slot], [0.0f32; 3]);
                self.around(sorted[slot], &starts, |j, shift| {
                    let (r, square) = apart(sorted[slot], sorted[j], shift);
                    if square < law.range * law.range && j != slot {
                        let k = law.push(&me, &flows[j], r, square);
                        sum = [sum[0] + k * r[0], sum[1] + k * r[1], sum[2] + k * r[2]];
                    }
                });
                sum
            })
            .collect();
        let mut accelerations = vec![[0.0; 3]; ids.len()];
        ids.iter().zip(pushes).for_each(|(i, a)| accelerations[*i as usize] = a);
        let side = self.side;
        self.position.par_iter_mut().zip(&mut self.velocity).zip(accelerations).for_each(|((x, v), a)| {
            for axis in 0..3 {
                v[axis] += a[axis] * dt;
                x[axis] = (x[axis] + v[axis] * dt).rem_euclid(side);
            }
        });
    }
    /// Calls with each slot of the rows around a place, and what to add to the way to it.
    #[inline]
    fn around(&self, me: [f32; 3], starts: &[u32], mut call: impl FnMut(usize, [f32; 3])) {
        let n = self.cells;
        let [x, y, z] = self.cell(me);
        let wrapped = |c: usize, step: usize| {
            let c = c + step;
            if c == 0 {
                (n - 1, -self.side)
            } else if c > n {
                (0, self.side)
            } else {
                (c - 1, 0.0)
            }
        };
        for (z, dz) in (0..3).map(|step| wrapped(z, step)) {
            for (y, dy) in (0..3).map(|step| wrapped(y, step)) {
                let mut row = |first: usize, last: usize, dx: f32| {
                    let (first, last) = (starts[self.key([first, y, z])], starts[self.key([last, y, z]) + 1]);
                    (first as usize..last as usize).for_each(|j| call(j, [dx, dy, dz]));
                };
                row(x.saturating_sub(1), (x + 1).min(n - 1), 0.0);
                if x == 0 {
                    row(n - 1, n - 1, -self.side);
                } else if x == n - 1 {
                    row(0, 0, self.side);
                }
            }
        }
    }
    /// Where they are.
    pub fn positions(&self) -> &[[f32; 3]] {
        &self.position
    }
}

#[inline]
fn apart(me: [f32; 3], you: [f32; 3], shift: [f32; 3]) -> ([f32; 3], f32) {
    let r = [you[0] - me[0] + shift[0], you[1] - me[1] + shift[1], you[2] - me[2] + shift[2]];
    (r, r[0] * r[0] + r[1] * r[1] + r[2] * r[2])
}

impl Law {
    #[inline]
    fn profile(&self, q: f32) -> f32 {
        let p = 1.0 - q;
        if self.cubic {
            if q <= 0.5 { 1.0 - 6.0 * q * q * p } else { 2.0 * p * p * p }
        } else {
            p * p * p * p * (4.0 * q + 1.0)
        }
    }
    #[inline]
    fn profile_slope(&self, q: f32) -> f32 {
        let p = 1.0 - q;
        if self.cubic { if q <= 0.5 { 18.0 * q - 12.0 } else { -6.0 * p * p / q } } else { -20.0 * p * p * p }
    }
    #[inline]
    fn push(&self, me: &Flow, you: &Flow, r: [f32; 3], square: f32) -> f32 {
        let s = 0.5 * self.range;
        let approach = (you[4] - me[4]) * r[0] + (you[5] - me[5]) * r[1] + (you[6] - me[6]) * r[2];
        let closing = approach.min(0.0) * s / (square + 0.01 * s * s);
        let artificial = self.alpha * self.sound * closing / (0.5 * (me[3] + you[3]));
        self.mass * self.slope * self.profile_slope(square.sqrt() / self.range) * (me[7] + you[7] - artificial)
    }
}
