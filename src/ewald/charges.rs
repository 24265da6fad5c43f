//! Charges: in any box, in a conductor.
//!
//! As for gravity the field is cut in two: a law between two that ends at the range R, 1 / r − P(1 − (r / R)²) / R, and the smooth rest, a sum
//! over waves. How much there is of a wave vector κ is 4π w(κ R) / (V κ²), with the Fourier transform w of the window of P: i₁(z) / z over its
//! value at κ = 0, with z² = β² − (κ R)². So R is a length, and not a part of the box, which may have any sides.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DVec3, DVec4};
use rayon::prelude::*;

use super::split::{LEAST, Split, last_wave, sharpness};
use super::waves::{CHARGE_WAVE, MOST, MOST_ELASTIC, Strength, Waves, wave_at};
use crate::error::Error;
use crate::kernel::{
    ACCELERATION, Bounds, Elastic, Field, Host, Kernel, Name, POSITION, Pass, Problem, Reference, Scalar, Shader, Side,
    Source, Threads, World,
};
use crate::links::Exclusions;
use crate::visit::{VIRIAL, numbered};

/// The largest error that may be asked for.
const COARSEST: f64 = 0.1;
/// There are waves to a little beyond the last that is part of a sum, however its κ² is rounded.
const ROUNDED: f64 = 1.0 + 1e-4;
/// Coefficients of P in a vector.
const FOUR: usize = 4;
/// Vectors that a device always has.
const ALWAYS: usize = 3;

/// Sums over all images of charges, with Coulomb's constant, the range R, and pairs up to so many bonds apart left out.
#[derive(Clone)]
pub struct Charges {
    pub constant: f64,
    pub range: f64,
    pub exclude: u32,
    /// β of the window.
    beta: f64,
    split: Arc<Split>,
}

impl Charges {
    /// Those with a root mean square error of the force between two unit charges, over a cube of side 2 R, in units of k / R².
    pub fn new(constant: f64, range: f64, accuracy: f64, exclude: u32) -> Self {
        // A unit of k / R² is four of k / side².
        let beta = sharpness(4.0 * accuracy);
        Self { constant, range, exclude, beta, split: Arc::new(Split::of(beta)) }
    }
    /// Energy and slope of two unit charges, without Coulomb's constant: U(r) up to R.
    pub fn pair(&self, r: f64) -> [f64; 2] {
        let [value, slope] = self.smooth(r);
        [1.0 / r - value, -1.0 / (r * r) - slope]
    }
    /// The same of the smooth rest, beyond R too.
    fn smooth(&self, r: f64) -> [f64; 2] {
        let part = r / self.range;
        if part >= 1.0 {
            return [1.0 / r, -1.0 / (r * r)];
        }
        let p = self.split.taper(1.0 - part * part);
        [p[0] / self.range, -2.0 * part * p[1] / (self.range * self.range)]
    }
    /// The parameters of the law between two.
    pub fn params(&self) -> Vec<(String, Scalar)> {
        let numbers = [("coulomb", self.constant), ("inverse_range", 1.0 / self.range)];
        let vectors = self.split.vectors().into_iter().enumerate();
        let numbers = numbers.map(|(name, x)| (name.to_owned(), Scalar::Float(x)));
        numbers.into_iter().chain(vectors.map(|(n, four)| (format!("taper_{n}"), Scalar::Vector4(four)))).collect()
    }
    /// Its constants: as many vectors of coefficients as there are above the rounding of single precision.
    pub fn constants(&self) -> Vec<(&'static str, f64)> {
        let all = self.split.vectors();
        let size = |four: &[f64; FOUR]| four.iter().map(|c| c.abs()).sum::<f64>();
        let some = all.iter().rposition(|four| size(four) > 1e-9).map_or(0, |last| last + 1);
        vec![("VECTORS", some.max(ALWAYS) as f64)]
    }
    /// Refuses a box in which there is no such sum, or which needs too many waves where it may change so far.
    ///
    /// # Errors
    /// [`Error::Setting`] with the key that is in its way.
    pub fn check(&self, accuracy: f64, bounds: &Bounds, elastic: Option<Elastic>) -> Result<(), Error> {
        let refuse = |key, why| Err(Error::Setting { key, why });
        if !(LEAST..=COARSEST).contains(&accuracy) {
            return refuse(
                "accuracy",
                format!(
                    "accuracy = {accuracy:e} for images = \"ewald\": give a number from {LEAST:e}, which sums in double precision reach, to {COARSEST}"
                ),
            );
        }
        if bounds.dimensions != 3 || bounds.sides != [Side::Periodic; 3] {
            return refuse(
                "images",
                format!(
                    "images = \"ewald\" requires a box that is periodic on all sides; here {bounds}: set boundary = \"periodic\" in [box], or \
                     images = \"nearest\""
                ),
            );
        }
        let shortest = bounds.period().min_element();
        // Sides are differences of corners, which are rounded.
        if self.range > 0.5 * shortest * (1.0 + 1e-6) {
            return refuse(
                "range",
                format!(
                    "range = {} for images = \"ewald\" in a box of which the shortest side is {shortest}: the law between two must end at half of it, {}",
                    self.range,
                    0.5 * shortest
                ),
            );
        }
        self.few_waves(bounds, elastic)
    }
    /// Refuses a box that needs too many waves.
    fn few_waves(&self, bounds: &Bounds, elastic: Option<Elastic>) -> Result<(), Error> {
        let (most, times, beside) = match elastic {
            Some(elastic) => (MOST_ELASTIC, elastic.most, ", which a barostat changes"),
            None => (MOST, 1.0, ""),
        };
        // Few enough to be counted.
        let estimate = self.estimate(bounds) * times.powi(3);
        let waves = if estimate < 2.0 * most as f64 { self.vectors(bounds, elastic).len() as f64 } else { estimate };
        if waves > most as f64 {
            let shortest = bounds.period().min_element();
            let wanted = self.range * (waves / most as f64).cbrt() * 1.02;
            let way = if wanted <= 0.5 * shortest {
                format!("raise range to {wanted:.3e} or more, or accuracy")
            } else {
                "raise accuracy, or choose a box that is less oblong".to_owned()
            };
            let why = format!(
                "range = {} for images = \"ewald\" needs some {waves:.0} waves in {bounds}{beside}, and there may be {most}: {way}",
                self.range
            );
            return Err(Error::Setting { key: "range", why });
        }
        Ok(())
    }
    /// The expected number of waves.
    fn estimate(&self, bounds: &Bounds) -> f64 {
        let sides = bounds.period() * (last_wave(self.beta) / (2.0 * PI * self.range));
        2.0 / 3.0 * PI * sides.element_product()
    }
    /// The wave vectors of a box, in turns per side, the longest waves first: of k and −k one, and none, which is that of the background.
    /// Where the box changes there are those of a larger one, too, behind the others.
    fn vectors(&self, bounds: &Bounds, elastic: Option<Elastic>) -> Vec<DVec4> {
        // All sides change by one part, so that the sides at the start give one order in all boxes, however they are rounded.
        let period = bounds.period();
        let start = elastic.map_or(period, |elastic| elastic.start);
        let times = elastic.map_or(1.0, |elastic| elastic.most * period.x / start.x);
        let last = (self.last_square() * ROUNDED).sqrt() * times / (2.0 * PI);
        #[expect(clippy::cast_possible_truncation, reason = "few, as the box was checked")]
        let most = (start * last).to_array().map(|most| most.floor() as i32);
        let along = |axis: usize| -most[axis]..=most[axis];
        let mut all = vec![DVec4::ZERO];
        for x in 0..=most[0] {
            for (y, z) in along(1).flat_map(|y| along(2).map(move |z| (y, z))) {
                let k = DVec3::new(f64::from(x), f64::from(y), f64::from(z));
                if (x, y, z) > (0, 0, 0) && (k / start).length() <= last {
                    all.push(k.extend(0.0));
                }
            }
        }
        let square = |k: &DVec4| (k.truncate() / start).length_squared();
        all.sort_by(|a, b| square(a).total_cmp(&square(b)));
        all
    }
    /// The largest κ² of a wave that is part of the sum.
    fn last_square(&self) -> f64 {
        (last_wave(self.beta) / self.range).powi(2)
    }
    /// What is left of a charge with itself.
    fn alone(&self) -> f64 {
        self.constant * self.split.taper(1.0)[0] / self.range
    }
    /// κ² of a wave, and how much there is of it: A.
    fn amount(&self, wave: DVec4, world: &World) -> [f64; 2] {
        let frequency = world.bounds.frequency();
        let (square, density) = (square(wave, frequency), frequency.element_product());
        if square == 0.0 {
            return [0.0, density * self.background()];
        }
        if square > self.last_square() {
            return [square, 0.0];
        }
        let part = bessel(self.beta.powi(2) - square * self.range.powi(2), 3.0);
        [square, density * self.whole() / square * part]
    }
    /// 8π k / w₀
    fn whole(&self) -> f64 {
        8.0 * PI * self.constant / bessel(self.beta.powi(2), 3.0)
    }
    /// The mean of the law between two, less than nothing, times the volume: the background that neutralizes a net charge.
    fn background(&self) -> f64 {
        let curve = bessel(self.beta.powi(2), 5.0) / bessel(self.beta.powi(2), 3.0);
        -0.4 * PI * self.constant * self.range.powi(2) * curve
    }
    fn waves(&self, problem: &Problem, earlier: usize) -> Waves {
        let name = |text: &str| Name::from(numbered(text, earlier));
        Waves {
            vectors: Arc::new(self.vectors(&problem.bounds, problem.elastic)),
            vector: name(CHARGE_WAVE),
            structure: name("charge_structure"),
            parts: name("charge_structure_parts"),
        }
    }
    fn files(problem: &Problem) -> Vec<Source> {
        vec![
            crate::shader!("world.wgsl"),
            crate::shader!("fields.wgsl"),
            crate::shader!("law/circle.wgsl"),
            problem.active(),
            crate::shader!("ewald/waves.wgsl"),
            crate::shader!("ewald/charges.wgsl"),
        ]
    }
    fn window(&self) -> [(&'static str, f64); 5] {
        [
            ("AMOUNT", self.whole()),
            ("BACKGROUND", self.background()),
            ("SHARPNESS", self.beta.powi(2)),
            ("RANGE", self.range),
            ("LAST", self.last_square()),
        ]
    }
    /// The kernels beside the law between two, of which this is the WGSL: the structure factor, what each particle makes of it, and what pairs that bonds leave out do not have.
    ///
    /// # Errors
    /// When a shader does not compile, or there are too many such pairs.
    pub fn kernels(&self, law: &Source, problem: &Problem, earlier: usize) -> Result<Vec<Kernel>, Error> {
        let (waves, files, count) = (self.waves(problem, earlier), Self::files(problem), problem.capacity);
        let mut structure = waves.structure(&files, self.clone(), problem)?;
        for pass in &mut structure.passes {
            pass.constants.extend(self.window());
        }
        let files = [&files[..], &[crate::shader!("ewald/charge_images.wgsl")]].concat();
        let mut passes = Vec::new();
        for [first, end] in waves.dispatches(problem) {
            let alone = if first == 0 { self.alone() } else { 0.0 };
            let constants = [("FIRST", f64::from(first)), ("END", f64::from(end)), ("SELF", alone)];
            let work = u64::from(count) * u64::from(end - first);
            passes.push(waves.pass(&files, &constants, Threads::new(count), work)?);
        }
        let mut images = waves.kernel(passes);
        let (sums, fields) = (self.clone(), waves.clone());
        images.reference = Some(Arc::new(move |host| sums.add_waves(&fields, host)));
        let kernels = vec![named("coulomb structure", structure), named("coulomb images", images)];
        let excluded =
            (self.exclude > 0).then(|| self.excluded(law, problem, earlier, ACCELERATION.name)).transpose()?;
        Ok(kernels.into_iter().chain(excluded).collect())
    }
    /// The kernels that add the virial of all that is not in the law between two.
    ///
    /// # Errors
    /// As [`Charges::kernels`].
    pub fn virial(&self, law: &Source, problem: &Problem, earlier: usize) -> Result<Vec<Kernel>, Error> {
        let (waves, count) = (self.waves(problem, earlier), problem.capacity);
        let parts = Name::from(numbered("charge_virial_parts", earlier));
        let on = |pass: Pass| pass.on(&[("wave_virial", parts.clone())]);
        let files = [&Self::files(problem)[..], &[crate::shader!("ewald/charge_virial.wgsl")]].concat();
        let each = waves.pass(&files, &self.window(), Threads::new(waves.number()), u64::from(waves.number()))?;
        let files = [crate::shader!("world.wgsl"), crate::shader!("ewald/charge_virial_sum.wgsl")];
        let all = waves.pass(&files, &[], Threads::new(count), u64::from(count) + u64::from(waves.number()))?;
        let mut kernel = waves.kernel(vec![on(each), on(all)]);
        kernel.sizes.push((VIRIAL.name.into(), 2 * u64::from(count)));
        kernel.sizes.push((parts.clone(), 2 * u64::from(waves.number())));
        kernel.scratch.push(parts);
        let (sums, fields) = (self.clone(), waves.clone());
        kernel.reference = Some(Arc::new(move |host| sums.add_virial(&fields, host)));
        let excluded = (self.exclude > 0).then(|| self.excluded(law, problem, earlier, VIRIAL.name)).transpose()?;
        Ok([named("virial of coulomb images", kernel)].into_iter().chain(excluded).collect())
    }
    /// The kernel that takes the smooth part of pairs that bonds leave out off a field: accelerations, or the virial.
    fn excluded(&self, law: &Source, problem: &Problem, earlier: usize, field: &str) -> Result<Kernel, Error> {
        let pairs = Exclusions::new(&problem.network, self.exclude, problem.capacity)?;
        let [start, others] =
            ["coulomb_excluded_start", "coulomb_excluded"].map(|text| Name::from(numbered(text, earlier)));
        let to_virial = field == VIRIAL.name;
        let files = [
            crate::shader!("world.wgsl"),
            crate::shader!("fields.wgsl"),
            crate::shader!("particle.wgsl"),
            crate::shader!("visit/potential.wgsl"),
            law.clone(),
            crate::shader!("ewald/excluded.wgsl"),
            if to_virial {
                crate::shader!("ewald/excluded_virial.wgsl")
            } else {
                crate::shader!("ewald/excluded_force.wgsl")
            },
        ];
        let shader = Shader::join(&files)?;
        let values = self.params();
        let values: Vec<_> = values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        let constants = [self.constants(), problem.constants(&shader)].concat();
        let mut pass = Pass { constants, ..Pass::new(shader, problem.capacity) };
        if let Some(block) = pass.shader.reflection().binding("params") {
            pass.uniforms = vec![("params", block.packed.pack("the pairs that `coulomb` leaves out", &values)?)];
        }
        let pass = pass.on(&[("excluded_start", start.clone()), ("excluded", others.clone())]);
        // A field has one element at least.
        let words = if pairs.others.is_empty() { Arc::new(vec![0]) } else { pairs.others.clone() };
        let mut sizes = vec![(start.clone(), pairs.start.len() as u64), (others.clone(), words.len() as u64)];
        sizes.extend(to_virial.then(|| (VIRIAL.name.into(), 2 * u64::from(problem.capacity))));
        let tables = vec![(start, pairs.start.clone()), (others, words)];
        let sums = self.clone();
        let reference: Reference =
            Arc::new(move |host| if to_virial { sums.take_virial(&pairs, host) } else { sums.take_off(&pairs, host) });
        let name = if to_virial { "virial of coulomb excluded" } else { "coulomb excluded" };
        let kernel = Kernel {
            name: String::new(),
            passes: vec![pass],
            reference: Some(reference),
            sizes,
            scratch: Vec::new(),
            tables,
        };
        Ok(named(name, kernel))
    }
    /// Adds the accelerations by waves to each particle.
    fn add_waves(&self, waves: &Waves, host: &Host) -> Result<(), Error> {
        let (position, structure) = (host.read(POSITION)?, host.reading::<f32>(&waves.structure)?);
        let (charges, frequency, alone) = (self.all(host)?, host.world().bounds.frequency(), self.alone());
        let mut acceleration = host.write(ACCELERATION)?;
        let all = acceleration.par_iter_mut().zip(position.par_iter()).zip(&charges);
        all.filter(|((_, p), _)| p.w > 0.0).for_each(|((a, p), charge)| {
            let mut sum = DVec4::new(0.0, 0.0, 0.0, -alone * charge);
            for (wave, s) in waves.vectors.iter().zip(structure.chunks(2)) {
                let [cosine, sine] = wave_at(*wave, *p, frequency);
                let along = 2.0 * PI * frequency * (sine * s[0] - cosine * s[1]) * wave.truncate();
                sum += along.extend(cosine * s[0] + sine * s[1]);
            }
            *a += charge / p.w * sum * HALVED;
        });
        Ok(())
    }
    fn add_virial(&self, waves: &Waves, host: &Host) -> Result<(), Error> {
        let (structure, world) = (host.reading::<f32>(&waves.structure)?, host.world());
        let mut virial = host.write(VIRIAL)?;
        let rows = world.count.max(1) as usize;
        for (place, (wave, kept)) in waves.vectors.iter().zip(structure.chunks(2)).enumerate() {
            let [square, amount] = self.amount(*wave, &world);
            let (Some(row), true) = (virial.chunks_mut(2).nth(place % rows), amount != 0.0) else { continue };
            let half = 0.5 * (kept[0] * kept[0] + kept[1] * kept[1]) / amount;
            row[0] += half * DVec4::new(1.0, 1.0, 1.0, 0.0);
            if square > 0.0 {
                let ranges = square * self.range.powi(2);
                let [above, below] = [5.0, 3.0].map(|order| bessel(self.beta.powi(2) - ranges, order));
                let along = half * (2.0 + 0.2 * ranges * above / below) / square;
                let k = 2.0 * PI * wave.truncate() * world.bounds.frequency();
                row[0] -= along * (k * k).extend(0.0);
                row[1] -= along * DVec4::new(k.y * k.z, k.x * k.z, k.x * k.y, 0.0);
            }
        }
        Ok(())
    }
    /// The pairs of a particle that bonds leave out: r, and the force on it and the energy of what is taken off.
    fn taken<'a>(
        &'a self,
        pairs: &'a Exclusions,
        host: &Host,
    ) -> Result<impl Fn(usize) -> Vec<(DVec3, DVec3, f64)> + Sync + use<'a>, Error> {
        let (position, charges, bounds) = (host.read(POSITION)?.to_vec(), charge_of(host)?, host.world().bounds);
        Ok(move |me: usize| {
            let of = |other: &u32| {
                let other = *other as usize;
                let r = bounds.shortest(position[other].truncate() - position[me].truncate());
                let [value, slope] = self.smooth(r.length()).map(|x| -self.constant * charges[me] * charges[other] * x);
                // Two at one place have no direction between them.
                let force = if r == DVec3::ZERO { DVec3::ZERO } else { slope / r.length() * r };
                (r, force, value)
            };
            pairs.of(u32::try_from(me).unwrap_or(u32::MAX)).iter().map(of).collect()
        })
    }
    fn take_off(&self, pairs: &Exclusions, host: &Host) -> Result<(), Error> {
        let (taken, position) = (self.taken(pairs, host)?, host.read(POSITION)?);
        let rows = host.world().count as usize;
        for (me, (a, p)) in host.write(ACCELERATION)?.iter_mut().zip(position.iter()).take(rows).enumerate() {
            if p.w > 0.0 {
                *a +=
                    taken(me).into_iter().map(|(_, force, energy)| force.extend(energy) * HALVED / p.w).sum::<DVec4>();
            }
        }
        Ok(())
    }
    fn take_virial(&self, pairs: &Exclusions, host: &Host) -> Result<(), Error> {
        let taken = self.taken(pairs, host)?;
        let rows = host.world().count as usize;
        for (me, row) in host.write(VIRIAL)?.chunks_mut(2).take(rows).enumerate() {
            for (r, f, _) in taken(me) {
                row[0] -= 0.5 * (r * f).extend(0.0);
                row[1] += (-0.5 * DVec3::new(r.y * f.z, r.x * f.z, r.x * f.y)).extend(f.length());
            }
        }
        Ok(())
    }
}

/// Each of a pair holds half of its potential energy.
const HALVED: DVec4 = DVec4::new(1.0, 1.0, 1.0, 0.5);

impl Strength for Charges {
    fn all(&self, host: &Host) -> Result<Vec<f64>, Error> {
        let (mut charges, is_active) = (charge_of(host)?, host.is_active()?);
        charges.iter_mut().enumerate().filter(|(i, _)| !is_active(*i)).for_each(|(_, charge)| *charge = 0.0);
        Ok(charges)
    }
    fn kept(&self, wave: DVec4, world: &World) -> f64 {
        self.amount(wave, world)[1]
    }
}

/// The column of charges.
const CHARGE: Field<f32> = Field::new("charge");

fn charge_of(host: &Host) -> Result<Vec<f64>, Error> {
    Ok(host.read(CHARGE)?.to_vec())
}

fn named(name: &str, kernel: Kernel) -> Kernel {
    Kernel { name: name.to_owned(), ..kernel }
}

/// κ²
fn square(wave: DVec4, frequency: DVec3) -> f64 {
    (2.0 * PI * wave.truncate() * frequency).length_squared()
}

/// The modified spherical Bessel function i₁(z) / z over its value at 0, by z², below 0 too; of the order 5, i₂(z) / z².
fn bessel(square: f64, order: f64) -> f64 {
    (1..=60).rev().map(f64::from).fold(1.0, |sum, n| 1.0 + sum * square / (2.0 * n * (2.0 * n + order)))
}
