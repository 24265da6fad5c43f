//! The circles model in plain Rust, by the same algorithm: a counting sort by cell and rows of three cells, in f32, over
//! all cores. Nothing by hand; the instruction set is the one cargo compiled for.

use rayon::prelude::*;

use super::cells::sorted;

/// How far agents look.
pub const RADIUS: f32 = 2.0;
const REPULSE: f32 = 0.05;

/// Agents in a cube from 0 to `side`.
pub struct Agents {
    position: Vec<[f32; 3]>,
    velocity: Vec<[f32; 3]>,
    cells: usize,
    per_cell: f32,
}

impl Agents {
    /// At these places, at rest.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
    pub fn new(position: Vec<[f32; 3]>, side: f32) -> Self {
        let velocity = vec![[0.0; 3]; position.len()];
        Self { position, velocity, cells: (side / RADIUS).ceil().max(1.0) as usize, per_cell: 1.0 / RADIUS }
    }
    /// The cells of a place.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a float to an integer saturates")]
    fn cell(&self, x: [f32; 3]) -> [usize; 3] {
        x.map(|x| ((x * self.per_cell) as usize).min(self.cells - 1))
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
        let pushes: Vec<[f32; 3]> =
            (0..sorted.len()).into_par_iter().with_min_len(256).map(|slot| self.push(slot, &sorted, &starts)).collect();
        let mut accelerations = vec![[0.0; 3]; ids.len()];
        ids.iter().zip(pushes).for_each(|(i, a)| accelerations[*i as usize] = a);
        self.position.par_iter_mut().zip(&mut self.velocity).zip(accelerations).for_each(|((x, v), a)| {
            for axis in 0..3 {
                v[axis] += a[axis] * dt;
                x[axis] += v[axis] * dt;
            }
        });
    }
    #[inline]
    fn push(&self, slot: usize, sorted: &[[f32; 3]], starts: &[u32]) -> [f32; 3] {
        let me = sorted[slot];
        let [x, y, z] = self.cell(me);
        let near = |c: usize| c.saturating_sub(1)..=(c + 1).min(self.cells - 1);
        let mut sum = [0.0f32; 3];
        for z in near(z) {
            for y in near(y) {
                let row = near(x);
                let first = starts[self.key([*row.start(), y, z])] as usize;
                let last = starts[self.key([*row.end(), y, z]) + 1] as usize;
                for (j, you) in sorted[first..last].iter().enumerate() {
                    let r = [you[0] - me[0], you[1] - me[1], you[2] - me[2]];
                    let square = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
                    if square < RADIUS * RADIUS && first + j != slot {
                        let separation = square.sqrt();
                        let k = (separation / RADIUS * -std::f32::consts::TAU).sin() * REPULSE;
                        let k = k / separation.max(1e-12);
                        sum = [sum[0] + k * r[0], sum[1] + k * r[1], sum[2] + k * r[2]];
                    }
                }
            }
        }
        sum
    }
    /// Where they are.
    pub fn positions(&self) -> &[[f32; 3]] {
        &self.position
    }
}
