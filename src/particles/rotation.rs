//! How fast an exponential disk with a halo turns, and how warm it is, over radius.
//!
//! The disk's own pull is the Hankel integral of its surface density (Toomre 1963; thin and unsoftened it is Freeman 1970),
//!
//!   v²(R) = G M R ∫ k J₁(kR) ⟨e^(-k √(d² + ε²))⟩ (1 + k² R_d²)^(-3/2) dk ,
//!
//! averaged over the difference d of two heights in the disk: so thickness and Plummer softening ε are in it. Accurate to
//! 0.5 % beyond 0.1 `R_d`, for disks no thinner than 0.05 `R_d`.

use std::f64::consts::PI;

use super::hernquist;

/// The masses and lengths of a galaxy.
#[derive(Debug, Clone, Copy)]
pub(super) struct Galaxy {
    pub g: f64,
    pub disk_mass: f64,
    pub disk_scale: f64,
    pub disk_height: f64,
    pub halo_mass: f64,
    pub halo_scale: f64,
    pub softening: f64,
    pub toomre_q: f64,
}

/// The disk's state at one radius; all are [length / time] or its square, frequencies [1 / time²].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Ring {
    /// Square of the circular velocity.
    pub circular: f64,
    /// Square of the epicyclic frequency κ.
    pub epicyclic: f64,
    /// Square of the radial dispersion.
    pub radial: f64,
    /// Square of the azimuthal dispersion.
    pub azimuthal: f64,
    /// Square of the vertical dispersion.
    pub vertical: f64,
    /// Square of the mean rotation.
    pub mean: f64,
}

/// Rings at radii in equal steps of ln R.
pub(super) struct Rotation {
    scale: f64,
    rings: Vec<Ring>,
}

const INNER: f64 = 1e-3;
const OUTER: f64 = 50.0;
const RINGS: u32 = 320;
/// Beyond this radius, in `R_d`, the disk pulls like its monopole and quadrupole.
const FAR: f64 = 20.0;
/// Steps of the Hankel integral. Its sum repeats the disk every 2π / step = 251 `R_d`, far from what it is asked for.
const K_STEP: f64 = 0.025;
const K_STEPS: u32 = 4000;

impl Galaxy {
    /// Surface density of the disk [mass / length²].
    fn surface(&self, radius: f64) -> f64 {
        self.disk_mass / (2.0 * PI * self.disk_scale * self.disk_scale) * libm::exp(-radius / self.disk_scale)
    }

    /// Softened pull of the whole galaxy as if it were spherical [length / time²].
    pub(super) fn spherical(&self, r: f64) -> f64 {
        let x = r / self.disk_scale;
        let disk = self.disk_mass * (1.0 - (1.0 + x) * libm::exp(-x));
        self.g * (disk + self.halo_mass * hernquist::enclosed(r / self.halo_scale)) * r / self.softened(r * r)
    }

    /// Square of the halo's angular velocity near the plane, at the mean square height.
    fn halo_turn(&self, radius: f64) -> f64 {
        let r2 = radius * radius + PI * PI / 12.0 * self.disk_height * self.disk_height;
        let inside = hernquist::enclosed(r2.sqrt() / self.halo_scale);
        self.g * self.halo_mass * inside / self.softened(r2)
    }

    /// (r² + ε²)^(3/2)
    fn softened(&self, r2: f64) -> f64 {
        let s2 = r2 + self.softening * self.softening;
        s2 * s2.sqrt()
    }
}

/// Differences of two heights drawn from  sech²(z / z₀) , and their weights: two logistic numbers of scale z₀ / 2.
/// In units of `z₀`.
fn differences() -> impl Iterator<Item = (f64, f64)> {
    const STEP: f64 = 0.1;
    (0..300_u32).map(|i| {
        let x = STEP * (f64::from(i) + 0.5);
        let e = libm::exp(-x);
        let rest = 1.0 - e;
        let density = e * (x - 2.0 + (x + 2.0) * e) / (rest * rest * rest);
        (0.5 * x, 2.0 * STEP * density)
    })
}

impl Rotation {
    pub(super) fn new(galaxy: &Galaxy) -> Self {
        let scale = galaxy.disk_scale;
        let spectrum = spectrum(galaxy.disk_height / scale, galaxy.softening / scale);
        let flatness = flatness(galaxy.softening / galaxy.disk_height);
        let mut rings: Vec<Ring> = (0..RINGS)
            .map(|row| {
                let x = radius(row);
                let circular = galaxy.g * galaxy.disk_mass / scale * pull(&spectrum, x)
                    + galaxy.halo_turn(x * scale) * x * x * scale * scale;
                let z0 = galaxy.disk_height;
                // ⟨σ_z²⟩ by the virial theorem across the plane: its own pull, and the halo's.
                let vertical = PI * galaxy.g * galaxy.surface(x * scale) * z0 * flatness
                    + PI * PI / 12.0 * z0 * z0 * galaxy.halo_turn(x * scale);
                Ring { circular, vertical, ..Ring::default() }
            })
            .collect();

        let step = log_step();
        let turn = |rings: &[Ring], row: usize| {
            let r = radius(u32::try_from(row).unwrap_or(RINGS)) * scale;
            rings[row].circular / (r * r)
        };
        // Warmth by Toomre's criterion, but never more than the pull can hold together without any rotation.
        let mut held = 0.0;
        for row in (0..rings.len()).rev() {
            let (low, high) = (row.saturating_sub(1), (row + 1).min(rings.len() - 1));
            #[expect(clippy::cast_precision_loss, reason = "1 or 2")]
            let slope = (turn(&rings, high) - turn(&rings, low)) / ((high - low) as f64 * step);
            let here = turn(&rings, row);
            // κ = 2 Ω where it turns like a solid, Ω about a point mass; a disk's edge falls a little below.
            rings[row].epicyclic = (4.0 * here + slope).clamp(0.5 * here, 4.0 * here);
            let surface = galaxy.surface(radius(u32::try_from(row).unwrap_or(RINGS)) * scale);
            held += step * surface * rings[row].circular;
            let wanted = 3.36 * galaxy.g * surface * galaxy.toomre_q;
            rings[row].radial =
                if surface > 0.0 { (wanted * wanted / rings[row].epicyclic).min(held / surface) } else { 0.0 };
            rings[row].azimuthal = rings[row].radial * rings[row].epicyclic / (4.0 * here);
        }
        // Asymmetric drift, from the radial Jeans equation.
        let pressure: Vec<f64> =
            rings.iter().zip(0..).map(|(ring, row)| ring.radial * galaxy.surface(radius(row) * scale)).collect();
        for row in 0..rings.len() {
            let (low, high) = (row.saturating_sub(1), (row + 1).min(rings.len() - 1));
            #[expect(clippy::cast_precision_loss, reason = "1 or 2")]
            let slope = if pressure[high] > 0.0 {
                libm::log(pressure[high] / pressure[low]) / ((high - low) as f64 * step)
            } else {
                0.0
            };
            let ring = &mut rings[row];
            ring.mean = (ring.circular - ring.azimuthal + ring.radial * (1.0 + slope)).max(0.0);
        }
        Self { scale, rings }
    }

    /// The ring at a radius [length].
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "held within the table")]
    pub(super) fn at(&self, radius: f64) -> Ring {
        let place = libm::log(radius / (self.scale * INNER)) / log_step();
        let place = place.clamp(0.0, f64::from(RINGS - 2));
        let row = place as usize;
        let part = (place - place.floor()).clamp(0.0, 1.0);
        let (low, high) = (self.rings[row], self.rings[row + 1]);
        let mix = |a: f64, b: f64| a + (b - a) * part;
        Ring {
            circular: mix(low.circular, high.circular),
            epicyclic: mix(low.epicyclic, high.epicyclic),
            radial: mix(low.radial, high.radial),
            azimuthal: mix(low.azimuthal, high.azimuthal),
            vertical: mix(low.vertical, high.vertical),
            mean: mix(low.mean, high.mean),
        }
    }
}

fn log_step() -> f64 {
    libm::log(OUTER / INNER) / f64::from(RINGS - 1)
}

/// Radius of a row, in `R_d`.
fn radius(row: u32) -> f64 {
    INNER * libm::exp(log_step() * f64::from(row))
}

/// ⟨e^(-k √(d² + ε²))⟩ k / (1 + k²)^(3/2) at every k, lengths in `R_d`.
fn spectrum(height: f64, softening: f64) -> Vec<f64> {
    let apart: Vec<(f64, f64)> =
        differences().map(|(d, weight)| ((d * d * height * height + softening * softening).sqrt(), weight)).collect();
    (1..=K_STEPS)
        .map(|i| {
            let k = K_STEP * f64::from(i);
            let factor: f64 = apart.iter().map(|(d, weight)| weight * libm::exp(-k * d)).sum();
            let spread = 1.0 + k * k;
            factor * k / (spread * spread.sqrt())
        })
        .collect()
}

/// v²(x) of the disk alone, in G M / `R_d`.
fn pull(spectrum: &[f64], x: f64) -> f64 {
    if x > FAR {
        return (1.0 + 4.5 / (x * x)) / x;
    }
    let sum: f64 = spectrum.iter().zip(1_u32..).map(|(s, i)| s * libm::j1(K_STEP * f64::from(i) * x)).sum();
    x * K_STEP * sum
}

/// How much softening weakens the pull of a sheet on itself: ⟨d² / √(d² + ε²)⟩ / ⟨|d|⟩, softening in heights.
fn flatness(softening: f64) -> f64 {
    let (weak, full) = differences().fold((0.0, 0.0), |(weak, full), (d, weight)| {
        (weak + weight * d * d / (d * d + softening * softening).sqrt(), full + weight * d)
    });
    weak / full
}

#[cfg(test)]
mod tests {
    use super::{differences, flatness, pull, spectrum};

    /// Freeman (1970), v² = 2 y² [I₀K₀ - I₁K₁](y), y = x/2, in G M / `R_d`: values by an independent Bessel library.
    const FREEMAN: [(f64, f64); 5] =
        [(0.25, 0.053940642), (0.5, 0.136705006), (1.0, 0.277958789), (2.2, 0.386911990), (6.0, 0.194455379)];

    #[test]
    fn a_thin_disk_turns_as_freeman_says() {
        const HEIGHT: f64 = 0.01;
        let spectrum = spectrum(HEIGHT, 0.0);
        for (x, thin) in FREEMAN {
            // Thickness lifts the potential by 2π G Σ ⟨|d|⟩, to first order, and ⟨|d|⟩ is the height.
            let v2 = thin - HEIGHT * x * libm::exp(-x);
            let got = pull(&spectrum, x);
            // 0.2 %: second order in height / radius, 0.01² / 0.25² at the first row.
            assert!((got / v2 - 1.0).abs() < 2e-3, "x {x}: {got} is not {v2}");
        }
        // The far formula takes over where it has become as good: next terms are (1/20)⁴.
        assert!((pull(&spectrum, 20.001) / pull(&spectrum, 19.999) - 1.0).abs() < 2e-3);
    }

    #[test]
    fn height_differences_have_weight_one_and_their_mean() {
        let (weight, mean) = differences().fold((0.0, 0.0), |(w, m), (d, p)| (w + p, m + p * d));
        assert!((weight - 1.0_f64).abs() < 1e-4, "{weight}");
        // Two logistic numbers of scale 1/2 are 1 apart in the mean (Gini's mean difference 2 s).
        assert!((mean - 1.0_f64).abs() < 1e-4, "{mean}");
        assert!((flatness(0.0) - 1.0).abs() < 1e-12);
        assert!(flatness(1.0) < 0.8);
    }
}
