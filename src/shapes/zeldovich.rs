//! A random displacement of a lattice, the growing mode of gravity's instability:  x = q + ψ(q),  v = ω ψ(q)  (Zel'dovich
//! 1970). ψ is the gradient of a Gaussian random field whose density has the power spectrum  P(k) ∝ kⁿ  over long waves.

use std::f64::consts::TAU;

use glam::DVec3;

use super::random::Random;

/// Whole waves along the longest side, at most.
const WAVES: i32 = 12;

/// A complex vector.
#[derive(Debug, Clone, Copy, Default)]
struct Wave {
    re: DVec3,
    im: DVec3,
}

impl Wave {
    /// Adds another one, rotated by the angle with this cosine and sine.
    fn add(&mut self, other: Self, (cos, sin): (f64, f64)) {
        self.re += other.re * cos - other.im * sin;
        self.im += other.re * sin + other.im * cos;
    }
}

/// The displacements of a periodic lattice with this number of particles along each axis, x fastest; in its spacings, with a root mean
/// square of one along each axis, and zero where no wave fits.
pub(super) fn displacements(size: [usize; 3], slope: f64, random: &mut Random) -> Vec<DVec3> {
    let longest = size.into_iter().max().unwrap_or(1);
    // No more than a wave for four particles: the lattice does not resolve shorter ones well.
    let most = WAVES.min(i32::try_from(longest / 4).unwrap_or(WAVES));
    let lengths = size.map(|n| n as f64);
    let mut field = waves(lengths, most, slope, random);
    // Axis by axis; each sum replaces the waves of its axis by its particles.
    let mut shape = [2 * most + 1; 3].map(|n| usize::try_from(n).unwrap_or(0));
    for axis in [2, 1, 0] {
        field = summed(&field, shape, axis, size[axis], most);
        shape[axis] = size[axis];
    }
    let square: f64 = field.iter().map(|wave| wave.re.length_squared()).sum::<f64>() / (3.0 * field.len() as f64);
    let scale = if square > 0.0 { square.sqrt().recip() } else { 0.0 };
    field.into_iter().map(|wave| wave.re * scale).collect()
}

/// The amplitude of each wave  k = 2π (i / nx, j / ny, l / nz)  with i fastest: a normal complex number times  k |k|^(n/2 - 2).
fn waves(lengths: [f64; 3], most: i32, slope: f64, random: &mut Random) -> Vec<Wave> {
    let longest = lengths.into_iter().fold(1.0, f64::max);
    let mut all = Vec::new();
    for l in -most..=most {
        for j in -most..=most {
            for i in -most..=most {
                let k = DVec3::new(f64::from(i), f64::from(j), f64::from(l)) / DVec3::from_array(lengths);
                let length = k.length();
                // The same random numbers are drawn for any lattice.
                let (re, im) = (random.normal(), random.normal());
                let fits = length > 0.0 && length * longest < f64::from(most) + 0.5;
                let along = if fits { k * libm::pow(length, 0.5 * slope - 2.0) } else { DVec3::ZERO };
                all.push(Wave { re: along * re, im: along * im });
            }
        }
    }
    all
}

/// The sum over the waves of one axis, at each of `places` points along it.
fn summed(field: &[Wave], shape: [usize; 3], axis: usize, places: usize, most: i32) -> Vec<Wave> {
    let stride: usize = shape[..axis].iter().product();
    let (many, blocks) = (shape[axis], shape[axis + 1..].iter().product::<usize>());
    let mut sums = vec![Wave::default(); stride * places * blocks];
    for place in 0..places {
        for (wave, n) in (-most..=most).enumerate() {
            let angle = TAU * f64::from(n) * place as f64 / places as f64;
            let turn = (libm::cos(angle), libm::sin(angle));
            for block in 0..blocks {
                let (from, to) = ((block * many + wave) * stride, (block * places + place) * stride);
                for i in 0..stride {
                    sums[to + i].add(field[from + i], turn);
                }
            }
        }
    }
    sums
}
