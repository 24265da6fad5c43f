//! What a good plain Rust loop does on this processor: f32, structure of arrays, sixteen targets side by side so that the
//! compiler makes vectors of them, over all cores. Nothing by hand; the instruction set is the one cargo compiled for.

use rayon::prelude::*;

/// Targets side by side.
const LANES: usize = 16;
type Lanes = [f32; LANES];

/// Bodies, one array for each coordinate.
pub struct Bodies {
    x: Vec<f32>,
    y: Vec<f32>,
    z: Vec<f32>,
    mass: Vec<f32>,
}

impl Bodies {
    /// From positions and masses. A last block is filled up with bodies of no mass.
    pub fn new(bodies: &[[f32; 4]]) -> Self {
        let padded = bodies.len().next_multiple_of(LANES);
        let column = |c: usize| bodies.iter().map(|b| b[c]).chain(std::iter::repeat(0.0)).take(padded).collect();
        Self { x: column(0), y: column(1), z: column(2), mass: column(3) }
    }
    /// Softened gravity with G = 1, by direct summation: acceleration and potential of all bodies.
    pub fn evaluate(&self, softening: f32) -> Vec<[Lanes; 4]> {
        (0..self.x.len() / LANES)
            .into_par_iter()
            .map(|block| self.block(block * LANES, softening * softening))
            .collect()
    }
    #[inline]
    fn block(&self, i: usize, softening2: f32) -> [Lanes; 4] {
        let lanes = |a: &[f32]| {
            let mut out = [0.0; LANES];
            out.copy_from_slice(&a[i..i + LANES]);
            out
        };
        let (xi, yi, zi) = (lanes(&self.x), lanes(&self.y), lanes(&self.z));
        let (mut ax, mut ay, mut az, mut potential) = ([0.0; LANES], [0.0; LANES], [0.0; LANES], [0.0; LANES]);
        for (((x, y), z), mass) in self.x.iter().zip(&self.y).zip(&self.z).zip(&self.mass) {
            for l in 0..LANES {
                let (dx, dy, dz) = (x - xi[l], y - yi[l], z - zi[l]);
                let inverse = 1.0 / (dx * dx + dy * dy + dz * dz + softening2).sqrt();
                let part = mass * inverse;
                let force = part * inverse * inverse;
                ax[l] += force * dx;
                ay[l] += force * dy;
                az[l] += force * dz;
                potential[l] -= part;
            }
        }
        [ax, ay, az, potential]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_bodies_pull_each_other() {
        let bodies = Bodies::new(&[[0.0, 0.0, 0.0, 2.0], [3.0, 0.0, 0.0, 5.0]]);
        let [ax, ay, _, potential] = bodies.evaluate(4.0)[0];
        // r² + ε² = 25: a = 5 · 3 / 125, φ = −5 / 5 − 2 / 4, the last being the body's own, which a softened loop includes.
        assert!((ax[0] - 0.12).abs() < 1e-6 && (ax[1] + 0.048).abs() < 1e-6 && ay[0] == 0.0);
        assert!((potential[0] + 1.5).abs() < 1e-6);
    }
}
