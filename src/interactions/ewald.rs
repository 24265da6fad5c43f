//! Gravity of all images of a periodic cube, in a uniform background that makes the mean density nothing (Ewald 1921).
//!
//! The field is cut in two: a law between two that ends at half a side, so that the nearest image is all that there is of
//! it; and the smooth rest, a sum of 126 waves, by the structure factor of all particles. How well waves up
//! to |k|² = 14 do is a matter of how the law ends: P below was fitted so that the waves left out are the least, in the
//! mean over the cube, among all polynomials of its degree (`benches/ewald_split.py`; the idea of the best taper: Shamshirgar,
//! Bagge & Tornberg 2021). The force of a unit mass on another is wrong by 1.5e-4 G M / L² in the mean (root mean square), and
//! by 4.6e-4 at most.
//!
//! Softening is Plummer's, of the law between two, which fades out by ρ² = r² + ε² as it would by r²: waves are those of
//! points. The potential has the mean nothing over the cube; its part of a particle's own images is there too, so that a
//! mass alone has the energy 1.4186 G m² / L of a lattice.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DMat3, DVec3, DVec4};
use rayon::prelude::*;

use crate::error::Error;
use crate::kernel::{ACCELERATION, Host, Kernel, POSITION, Pass, Problem, Shader, Side, Source, Threads};

/// P(v) = Σ c vⁿ: (1 − v)^(−1/2) to second order, and beyond that fitted.
const TAPER: [f64; 9] = [1.0, 0.5, 0.375, 0.296_344, 0.309_035, 0.003_588, 0.434_914, -0.227_071, 0.161_508];
/// The maximum |k|² of waves, in periods per side.
const SHELLS: i32 = 14;
/// Blocks into which particles are cut for a structure factor: enough to keep a device busy, and few to add.
const BLOCKS: u32 = 512;
/// Particles in a block: no fewer than are worth it, and no more than a loop may take.
const BLOCK: std::ops::RangeInclusive<u32> = 32..=32_768;

/// P, P′, P″ and P‴.
fn taper(v: f64) -> [f64; 4] {
    let mut at = [0.0; 4];
    for c in TAPER.iter().rev() {
        at = [at[0] * v + c, at[1] * v + at[0], at[2] * v + at[1], at[3] * v + at[2]];
    }
    [at[0], at[1], 2.0 * at[2], 6.0 * at[3]]
}

/// h(s) = s^(−1/2) − (2 / L) P(1 − (2 / L)² s) and its first three derivatives, with s = r² + ε²; 0 from half a side on.
fn faded(s: f64, frequency: f64) -> [f64; 4] {
    let rate = 2.0 * frequency;
    let v = 1.0 - s * rate * rate;
    if v <= 0.0 {
        return [0.0; 4];
    }
    let (p, newton) = (taper(v), [1.0, -0.5, 0.75, -1.875]);
    std::array::from_fn(|n| {
        let n_th = i32::try_from(n).unwrap_or(0);
        let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
        newton[n] * s.powf(-0.5 - n as f64) - sign * p[n] * rate.powi(2 * n_th + 1)
    })
}

/// The law between two.
pub fn pair(gm: f64, softening: f64, r: DVec3, frequency: f64) -> DVec4 {
    let [value, slope, ..] = faded(r.length_squared() + softening * softening, frequency);
    gm * (-2.0 * slope * r).extend(-value)
}

/// The same for a far group, by its mass and second moments about its centre.
pub fn group((g, mass, q): (f64, f64, DMat3), softening: f64, r: DVec3, frequency: f64) -> DVec4 {
    let [value, first, second, third] = faded(r.length_squared() + softening * softening, frequency);
    let (trace, qr) = (q.x_axis.x + q.y_axis.y + q.z_axis.z, q * r);
    let along = 2.0 * r.dot(qr);
    let a = -2.0 * ((mass * first + trace * second + along * third) * r + 2.0 * second * qr);
    g * a.extend(-(mass * value + trace * first + along * second))
}

/// ∫ f from 0 to 1, by Simpson's rule: f is as smooth as its polynomial, and 2048 parts leave 1e-11.
fn integral(f: impl Fn(f64) -> f64) -> f64 {
    let parts = 2048;
    let weight = |i: i32| if i == 0 || i == parts { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
    (0..=parts).map(|i| weight(i) * f(f64::from(i) / f64::from(parts))).sum::<f64>() / f64::from(3 * parts)
}

/// The waves, with how much of each there is: k in turns per side, of k and −k one; the mean of the faded law, which the
/// background takes away, as the first.
pub fn waves() -> Vec<DVec4> {
    // t P(1 − t²) is the part of the mass within t half sides that is smeared out, and its derivative twice the taper's window.
    let smeared = |t: f64| t * taper(1.0 - t * t)[0];
    let amount = |square: i32| {
        let k = PI * f64::from(square).sqrt();
        let window = smeared(1.0) * k.cos() + k * integral(|t| smeared(t) * (k * t).sin());
        2.0 * window / (PI * f64::from(square))
    };
    let shells: Vec<f64> = (0..=SHELLS).map(|square| if square > 0 { amount(square) } else { 0.0 }).collect();
    let mean = PI * integral(|t| t * (1.0 - smeared(t)));
    let mut all = vec![DVec4::new(0.0, 0.0, 0.0, -mean)];
    let most = -3..=3;
    for (x, y, z) in
        most.clone().flat_map(|x| most.clone().map(move |y| (x, y))).flat_map(|(x, y)| (-3..=3).map(move |z| (x, y, z)))
    {
        let square = x * x + y * y + z * z;
        if (x, y, z) > (0, 0, 0) && square <= SHELLS {
            let k = DVec3::new(f64::from(x), f64::from(y), f64::from(z));
            all.push(k.extend(shells[usize::try_from(square).unwrap_or(0)]));
        }
    }
    all
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

/// What comes beside the law between two: the structure factor, and what each particle makes of it. Before the sources of
/// the waves, the structure factor, its sum, and the images are those of the world.
///
/// # Errors
/// When a shader does not compile.
pub fn kernels(
    g: f64,
    world: &[Source],
    [wave, structure, sum, images]: [Source; 4],
    problem: &Problem,
) -> Result<[Kernel; 2], Error> {
    let waves = Arc::new(waves());
    let count = problem.capacity;
    let number = u32::try_from(waves.len()).unwrap_or(u32::MAX);
    let block = count.div_ceil(BLOCKS).clamp(*BLOCK.start(), *BLOCK.end());
    let blocks = count.div_ceil(block).max(1);
    let join = |files: &[Source]| Shader::join(&[world, files].concat());
    let all = ("WAVES", f64::from(number));
    let with = |shader, constants: &[(&'static str, f64)], threads, work| Pass {
        constants: constants.to_vec(),
        threads,
        work,
        ..Pass::new(shader, count)
    };
    let work = u64::from(count) * u64::from(number);
    let lanes = Threads { count: blocks * 64, layers: number.div_ceil(64) };
    let passes = vec![
        with(join(&[wave.clone(), structure])?, &[all, ("BLOCK", f64::from(block))], lanes, work),
        with(join(&[sum])?, &[all, ("BLOCKS", f64::from(blocks))], Threads::new(number), u64::from(number * blocks)),
    ];
    #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
    let words = waves.iter().flat_map(DVec4::to_array).map(|x| (x as f32).to_bits()).collect();
    let table = vec![("gravity_wave".into(), Arc::new(words))];
    let sizes = vec![
        ("gravity_wave".into(), waves.len() as u64),
        ("structure".into(), 2 * waves.len() as u64),
        ("structure_parts".into(), u64::from(blocks) * waves.len() as u64),
    ];
    let alone = 2.0 * taper(1.0)[0];
    let factor = waves.clone();
    let structure = Kernel {
        name: String::new(),
        passes,
        reference: Some(Arc::new(move |host| add_up(&factor, host))),
        sizes,
        scratch: vec!["structure_parts".into()],
        tables: table,
    };
    let pass = with(join(&[wave, images])?, &[all, ("G", g), ("SELF", alone)], Threads::new(count), work);
    let images = Kernel {
        passes: vec![pass],
        reference: Some(Arc::new(move |host| add_waves(g, alone, &waves, host))),
        scratch: Vec::new(),
        ..structure.clone()
    };
    Ok([structure, images])
}

/// S(k), real and imaginary part after each other.
fn add_up(waves: &[DVec4], host: &Host) -> Result<(), Error> {
    let (position, frequency) = (host.read(POSITION)?, host.world().bounds.frequency());
    let bodies = &position[..(host.world().count as usize).min(position.len())];
    let mut structure = host.writing::<f32>("structure")?;
    structure.par_chunks_mut(2).zip(waves).for_each(|(s, wave)| {
        let sum = bodies.iter().fold((0.0, 0.0), |(re, im), p| {
            let (sine, cosine) = (2.0 * PI * wave.truncate().dot(p.truncate() * frequency)).sin_cos();
            (re + p.w * cosine, im + p.w * sine)
        });
        (s[0], s[1]) = sum;
    });
    Ok(())
}

/// Adds the accelerations by waves to each particle.
fn add_waves(g: f64, alone: f64, waves: &[DVec4], host: &Host) -> Result<(), Error> {
    let (position, structure) = (host.read(POSITION)?, host.reading::<f32>("structure")?);
    let frequency = host.world().bounds.frequency();
    let mut acceleration = host.write(ACCELERATION)?;
    acceleration.par_iter_mut().zip(position.par_iter()).for_each(|(a, p)| {
        let mut sum = DVec4::new(0.0, 0.0, 0.0, alone * p.w);
        for (wave, s) in waves.iter().zip(structure.chunks(2)) {
            let k = wave.truncate();
            let (sine, cosine) = (2.0 * PI * k.dot(p.truncate() * frequency)).sin_cos();
            let (same, across) = (cosine * s[0] + sine * s[1], cosine * s[1] - sine * s[0]);
            sum += wave.w * (2.0 * PI * frequency.x * across * k).extend(-same);
        }
        // Each of a pair holds half of its potential energy.
        *a += g * frequency.x * sum * DVec4::new(1.0, 1.0, 1.0, 0.5);
    });
    Ok(())
}
