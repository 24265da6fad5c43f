//! Rotation curve and velocity dispersion of an exponential disk with a halo: Toomre's criterion, the epicyclic
//! frequency of the whole galaxy, and the asymmetric drift of the radial Jeans equation (Hernquist 1993).

use std::f64::consts::PI;

use super::exponential_disk::Spectrum;
use super::halo;

/// The masses and lengths of a galaxy.
#[derive(Debug, Clone, Copy)]
pub(super) struct Galaxy {
    pub g: f64,
    pub disk_mass: f64,
    pub disk_scale: f64,
    pub disk_height: f64,
    pub halo: Sphere,
    pub bulge: Sphere,
    pub softening: f64,
    pub toomre_q: f64,
}

/// A part with Hernquist's profile.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sphere {
    pub mass: f64,
    pub scale: f64,
}

impl Sphere {
    /// Mass within r \[mass\].
    fn enclosed(&self, r: f64) -> f64 {
        self.mass * halo::enclosed(r / self.scale)
    }
}

/// The disk's state at one radius; all are \[length / time\] or its square, frequencies \[1 / time²\].
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

impl Galaxy {
    /// Surface density of the disk \[mass / length²\].
    fn surface(&self, radius: f64) -> f64 {
        self.disk_mass / (2.0 * PI * self.disk_scale * self.disk_scale) * libm::exp(-radius / self.disk_scale)
    }

    /// Softened pull of the whole galaxy as if it were spherical \[length / time²\].
    pub(super) fn spherical(&self, r: f64) -> f64 {
        let x = r / self.disk_scale;
        let disk = self.disk_mass * (1.0 - (1.0 + x) * libm::exp(-x));
        self.g * (disk + self.halo.enclosed(r) + self.bulge.enclosed(r)) * r / self.softened(r * r)
    }

    /// The pull of halo and bulge on the disk at a radius, averaged over the heights there: R ∂Φ/∂R and z ∂Φ/∂z.
    fn round_pull(&self, radius: f64) -> (f64, f64) {
        const STEP: f64 = 0.1;
        let (mut inward, mut across) = (0.0, 0.0);
        for i in 0..80_u32 {
            let height = STEP * (f64::from(i) + 0.5);
            let fade = libm::exp(-2.0 * height);
            let weight = STEP * 4.0 * fade / ((1.0 + fade) * (1.0 + fade));
            let z = height * self.disk_height;
            let r2 = radius * radius + z * z;
            let pull = |part: Sphere| weight * self.g * part.mass * halo::enclosed(r2.sqrt() / part.scale);
            let turn = (pull(self.halo) + pull(self.bulge)) / self.softened(r2);
            inward += turn * radius * radius;
            across += turn * z * z;
        }
        (inward, across)
    }

    /// (r² + ε²)^(3/2)
    fn softened(&self, r2: f64) -> f64 {
        let s2 = r2 + self.softening * self.softening;
        s2 * s2.sqrt()
    }
}

impl Rotation {
    pub(super) fn new(galaxy: &Galaxy) -> Self {
        let scale = galaxy.disk_scale;
        let spectrum = Spectrum::new(galaxy.disk_height / scale, galaxy.softening / scale);
        let unit = galaxy.g * galaxy.disk_mass / scale;
        let mut rings: Vec<Ring> = (0..RINGS)
            .map(|row| {
                let x = radius(row);
                let (inward, across) = galaxy.round_pull(x * scale);
                let circular = unit * spectrum.inward(x) + inward;
                // ⟨σ_z²⟩ = ⟨z ∂Φ/∂z⟩: the virial theorem across the plane.
                let vertical = unit * spectrum.across(x) + across;
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

    /// The ring at a radius \[length\].
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
