//! Gravity of all images of a periodic cube, in a uniform background that makes the mean density nothing (Ewald 1921).
//!
//! The field is cut in two, as [`Split`] says: a law between two that ends at half a side, so that the nearest image is all that there is
//! of it; and the smooth rest, a sum of waves, by the structure factor of all particles.
//!
//! Softening is Plummer's, of the law between two: waves are those of points. The fitted law fades out by ρ² = r² + ε² as it would by r², and
//! errs by some 50 (ε / L)² G M / L²; those of a given accuracy soften Newton's term alone, which jumps by 24 (ε / L)² G M / L² at half a side. The potential has the mean nothing over the cube; its part of a particle's own images is there too, so that a
//! mass alone has the energy 1.4186 G m² / L of a lattice.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DVec3, DVec4};
use rayon::prelude::*;

use super::split::Split;
use super::waves::{Strength, Waves, wave_at};
use crate::cosmology::Expansion;
use crate::error::Error;
use crate::kernel::{ACCELERATION, Host, Kernel, Name, POSITION, Problem, Side, Source, Threads, World};
use crate::visit::Group;

/// h = s^(−1/2) − (2 / L) P(1 − (2 / L)² q) and its first three derivatives by r², with s = r² + ε², and q = s or r²; 0 from half a side on.
fn faded(split: &Split, softening: f64, r: DVec3, frequency: f64) -> [f64; 4] {
    let rate = 2.0 * frequency;
    let s = r.length_squared() + softening * softening;
    let v = 1.0 - if split.softens { s } else { r.length_squared() } * rate * rate;
    if v <= 0.0 {
        return [0.0; 4];
    }
    let (p, newton) = (split.taper(v), [1.0, -0.5, 0.75, -1.875]);
    std::array::from_fn(|n| {
        let n_th = i32::try_from(n).unwrap_or(0);
        let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
        newton[n] * s.powf(-0.5 - n as f64) - sign * p[n] * rate.powi(2 * n_th + 1)
    })
}

/// The law between two.
pub fn pair(split: &Split, gm: f64, softening: f64, r: DVec3, frequency: f64) -> DVec4 {
    let [value, slope, ..] = faded(split, softening, r, frequency);
    gm * (-2.0 * slope * r).extend(-value)
}

/// The same for a far group, by its mass and second moments about its centre.
pub fn group(split: &Split, g: f64, you: &Group, softening: f64, r: DVec3, frequency: f64) -> DVec4 {
    let [value, first, second, third] = faded(split, softening, r, frequency);
    let (mass, q) = (you.mass, you.moments);
    let (trace, qr) = (q.x_axis.x + q.y_axis.y + q.z_axis.z, q * r);
    let along = 2.0 * r.dot(qr);
    let a = -2.0 * ((mass * first + trace * second + along * third) * r + 2.0 * second * qr);
    g * a.extend(-(mass * value + trace * first + along * second))
}

/// Whether there is an Ewald sum in such a box.
///
/// # Errors
/// [`Error::Scene`] with the sides that are in its way.
pub fn fits(problem: &Problem, softening: f64) -> Result<(), Error> {
    let bounds = &problem.bounds;
    let period = bounds.period();
    // Sides in single precision, as on the device.
    let even = (period - DVec3::splat(period.x)).abs().max_element() <= f64::from(f32::EPSILON) * period.x;
    if bounds.dimensions == 3 && bounds.sides == [Side::Periodic; 3] && even {
        // The law between two ends at half a side, and the waves know of no softening.
        if softening <= WIDEST * period.x {
            return Ok(());
        }
        return Err(Error::Scene(format!(
            "gravity with images = \"ewald\" has a softening of {softening} in a cube of side {}: it may be {} at most, because \
             the sum over waves is not softened",
            period.x,
            WIDEST * period.x
        )));
    }
    Err(Error::Scene(format!(
        "gravity with images = \"ewald\" requires a cube that is periodic on all sides; here {bounds}: give [box] three equal \
         sides that are \"periodic\", or say images = \"nearest\""
    )))
}

/// The widest softening, of a side.
const WIDEST: f64 = 0.125;

/// Masses.
struct Masses;

impl Strength for Masses {
    fn all(&self, host: &Host) -> Result<Vec<f64>, Error> {
        Ok(host.read(POSITION)?.iter().map(|p| p.w).collect())
    }
    fn kept(&self, _: DVec4, _: &World) -> f64 {
        1.0
    }
}

/// The file of the factor by which gravity grows where space expands, and its constants.
#[must_use]
pub fn growing(expansion: Option<&Arc<Expansion>>) -> (Source, Vec<(&'static str, f64)>) {
    match expansion {
        Some(expansion) => (crate::shader!("law/expansion.wgsl"), expansion.constants()),
        None => (crate::shader!("law/no_expansion.wgsl"), Vec::new()),
    }
}

/// A constant of gravity with that factor, at the time of a world.
#[must_use]
pub fn grown(g: f64, expansion: Option<&Expansion>, world: &World) -> f64 {
    g * expansion.map_or(1.0, |expansion| expansion.scale_factor(world.time))
}

/// What comes beside the law between two: the structure factor, and what each particle makes of it.
///
/// # Errors
/// When a shader does not compile.
pub fn kernels(
    split: &Split,
    g: f64,
    expansion: Option<&Arc<Expansion>>,
    problem: &Problem,
) -> Result<[Kernel; 2], Error> {
    let [vector, structure, parts] = ["gravity_wave", "structure", "structure_parts"].map(Name::from);
    let waves = Waves { vectors: Arc::new(split.waves()), vector, structure, parts };
    let count = problem.capacity;
    let files = [
        crate::shader!("world.wgsl"),
        crate::shader!("fields.wgsl"),
        crate::shader!("law/circle.wgsl"),
        crate::shader!("ewald/waves.wgsl"),
    ];
    let factor = [&files[..], &[crate::shader!("ewald/masses.wgsl")]].concat();
    let structure = waves.structure(&factor, Masses, problem)?;
    let alone = 2.0 * split.taper(1.0)[0];
    let (grows, constants) = growing(expansion);
    let files = [&files[..], &[crate::shader!("ewald/mass_images.wgsl"), grows]].concat();
    let work = u64::from(count) * u64::from(waves.number());
    let pass =
        waves.pass(&files, &[&[("G", g), ("SELF", alone)], &constants[..]].concat(), Threads::new(count), work)?;
    let mut images = waves.kernel(vec![pass]);
    let expansion = expansion.cloned();
    images.reference = Some(Arc::new(move |host| {
        add_waves(grown(g, expansion.as_deref(), &host.world()), alone, &waves.vectors, host)
    }));
    Ok([structure, images])
}

/// Adds the accelerations by waves to each particle.
fn add_waves(g: f64, alone: f64, waves: &[DVec4], host: &Host) -> Result<(), Error> {
    let (position, structure) = (host.read(POSITION)?, host.reading::<f32>("structure")?);
    let frequency = host.world().bounds.frequency();
    let mut acceleration = host.write(ACCELERATION)?;
    acceleration.par_iter_mut().zip(position.par_iter()).for_each(|(a, p)| {
        let mut sum = DVec4::new(0.0, 0.0, 0.0, alone * p.w);
        for (wave, s) in waves.iter().zip(structure.chunks(2)) {
            let (k, [cosine, sine]) = (wave.truncate(), wave_at(*wave, *p, frequency));
            let (same, across) = (cosine * s[0] + sine * s[1], cosine * s[1] - sine * s[0]);
            sum += wave.w * (2.0 * PI * frequency.x * across * k).extend(-same);
        }
        // Each of a pair holds half of its potential energy.
        *a += g * frequency.x * sum * DVec4::new(1.0, 1.0, 1.0, 0.5);
    });
    Ok(())
}
