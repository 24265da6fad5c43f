//! The halo and the bulge of a galaxy: Hernquist's profile  ρ(r) ∝ 1 / (r (r + a)³)  (Hernquist 1990), cut at ten scale lengths, in
//! balance with the whole galaxy's gravity.
//!
//! The second moment of the velocities solves the isotropic Jeans equation (Hernquist 1993), the disk counted as if it
//! were spherical. Their shape is that of a polytrope,  `p(v) ∝ v² (1 - v²/v_esc²)^n`, with n chosen at every radius for that
//! moment: Gaussian deep inside, and always below the escape speed. (For Plummer's sphere it is exact, with n = 7/2.)

use glam::DVec3;

use super::random::Random;
use super::rotation::Galaxy;

/// Radius of the cut, in scale lengths.
pub(super) const CUT: f64 = 10.0;
const INNER: f64 = 1e-4;
const ROWS: u32 = 2000;

/// Dispersion and escape speed over radius.
pub(super) struct Round {
    scale: f64,
    /// ln r of the first row, and from row to row.
    first: f64,
    step: f64,
    /// Squares of the dispersion per axis and of the escape speed \[length² / time²\].
    rows: Vec<(f64, f64)>,
}

/// Share of the mass within r, for r in scale lengths.
pub(super) fn enclosed(r: f64) -> f64 {
    let share = |r: f64| (r / (r + 1.0)) * (r / (r + 1.0));
    if r >= CUT { 1.0 } else { share(r) / share(CUT) }
}

impl Round {
    /// Integrates pressure and potential inwards from the cut of a part of such a scale length.
    pub(super) fn new(galaxy: &Galaxy, scale: f64) -> Self {
        let first = libm::log(INNER * scale);
        let step = libm::log(CUT / INNER) / f64::from(ROWS - 1);
        let radius = |row: u32| libm::exp(first + step * f64::from(row));
        let density = |r: f64| 1.0 / (r * (r + scale) * (r + scale) * (r + scale));

        let edge = radius(ROWS - 1);
        let mut r = edge;
        let mut gravity = galaxy.spherical(edge);
        let mut pressure = 0.0;
        let mut depth = gravity * edge; // of a point mass, from the edge to infinity
        let mut rows = vec![(0.0, 2.0 * depth)];
        for row in (0..ROWS - 1).rev() {
            let inner = radius(row);
            let pull = galaxy.spherical(inner);
            // Trapezoids in ln r.
            pressure += 0.5 * step * (density(r) * gravity * r + density(inner) * pull * inner);
            depth += 0.5 * step * (gravity * r + pull * inner);
            rows.push((pressure / density(inner), 2.0 * depth));
            (r, gravity) = (inner, pull);
        }
        rows.reverse();
        Self { scale, first, step, rows }
    }

    /// Position and velocity of one particle.
    pub(super) fn draw(&self, random: &mut Random) -> (DVec3, DVec3) {
        // M(r) ∝ r² / (r + a)², turned round.
        let root = random.uniform().sqrt() * CUT / (CUT + 1.0);
        let r = self.scale * root / (1.0 - root);
        let position = random.direction() * r;
        let (dispersion, escape) = self.at(r);
        // Mean of v² is 3/2 v_esc² / (n + 5/2) = 3 σ².
        let n = (0.5 * escape / dispersion - 2.5).clamp(0.0, 1e9);
        // v² / v_esc² has a beta distribution (3/2, n + 1): the quotient of two gamma numbers, of which half the square of
        // three normal numbers is one.
        let normals = random.normals();
        let rest = 2.0 * random.gamma(n + 1.0);
        let velocity = normals * (escape / (normals.length_squared() + rest)).sqrt();
        (position, velocity)
    }

    /// The squares of dispersion and escape speed at a radius.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "held within the table")]
    fn at(&self, r: f64) -> (f64, f64) {
        let place = ((libm::log(r) - self.first) / self.step).clamp(0.0, f64::from(ROWS - 2));
        let row = place as usize;
        let part = (place - place.floor()).clamp(0.0, 1.0);
        let (low, high) = (self.rows[row], self.rows[row + 1]);
        (low.0 + (high.0 - low.0) * part, low.1 + (high.1 - low.1) * part)
    }
}
