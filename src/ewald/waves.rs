//! Sums over the Fourier modes of a periodic box: the structure factor of what particles have, by which each is moved.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DVec3, DVec4};
use rayon::prelude::*;

use crate::error::Error;
use crate::kernel::{Host, Kernel, Name, POSITION, Pass, Problem, Shader, Source, Threads, World};

/// Blocks into which particles are cut for a structure factor: enough to keep a device busy, and few to add.
const BLOCKS: u32 = 512;
/// Particles in a block: no fewer than are worth it, and no more than a loop may take.
const BLOCK: std::ops::RangeInclusive<u32> = 32..=32_768;
/// The maximum number of wave vectors, below the iterations that loops over them may have.
pub const MOST: usize = 64_000;
/// The same in a box that changes: with so many the blocks are the same as with fewer, so that more of them change no bit.
pub const MOST_ELASTIC: usize = (PARTS / BLOCKS) as usize;
/// The constant of their number in all passes over waves.
pub const NUMBER: &str = "WAVES";
/// Where the name of a field of wave vectors of charges begins.
pub const CHARGE_WAVE: &str = "charge_wave";
/// Elements of the parts of the structure factor, 8 bytes each: as many as a binding holds by default.
const PARTS: u32 = 1 << 24;
/// Wave vectors of a workgroup.
const LANES: u32 = 64;

/// Wave vectors of a box, and the names of the fields of their structure factor.
#[derive(Clone)]
pub struct Waves {
    /// In turns per side, of k and −k one, with a number of their own.
    pub vectors: Arc<Vec<DVec4>>,
    /// The field of the vectors.
    pub vector: Name,
    /// The field of the structure factor, real and imaginary part after each other.
    pub structure: Name,
    /// The field of the parts of which it is the sum.
    pub parts: Name,
}

/// What each particle adds to a structure factor, and what is kept of its sum, as the file beside has it in `strength` and `kept`.
pub trait Strength: Send + Sync + 'static {
    /// That of all particles.
    ///
    /// # Errors
    /// When a field is missing.
    fn all(&self, host: &Host) -> Result<Vec<f64>, Error>;
    /// The factor by which the sum for a wave is multiplied.
    fn kept(&self, wave: DVec4, world: &World) -> f64;
}

impl Waves {
    /// So many invocations, and as many waves as one dispatch of them may take: the first and the end of each.
    pub fn dispatches(&self, problem: &Problem) -> Vec<[u32; 2]> {
        let number = self.number();
        let most = problem.machine.meetings / u64::from(problem.capacity.max(1));
        let most =
            u32::try_from(most).unwrap_or(u32::MAX).max(1).div_ceil(LANES).saturating_mul(LANES).min(number.max(1));
        let starts = (0..number.div_ceil(most)).map(|n| n * most);
        starts.map(|first| [first, first.saturating_add(most).min(number)]).collect()
    }
    /// The number of wave vectors.
    pub fn number(&self) -> u32 {
        u32::try_from(self.vectors.len()).unwrap_or(u32::MAX)
    }
    /// A dispatch over its fields.
    pub fn pass(
        &self,
        files: &[Source],
        constants: &[(&'static str, f64)],
        threads: Threads,
        work: u64,
    ) -> Result<Pass, Error> {
        let all = [(NUMBER, f64::from(self.number()))];
        let pass = Pass {
            constants: [&all, constants].concat(),
            threads,
            work,
            ..Pass::new(Shader::join(files)?, threads.count)
        };
        let fields = [("wave_vector", &self.vector), ("structure", &self.structure), ("structure_parts", &self.parts)];
        let own: Vec<_> = fields
            .into_iter()
            .filter(|(name, field)| *name != &***field)
            .map(|(name, field)| (name, field.clone()))
            .collect();
        Ok(pass.on(&own))
    }
    /// The kernel of such dispatches.
    pub fn kernel(&self, passes: Vec<Pass>) -> Kernel {
        #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
        let words = self.vectors.iter().flat_map(DVec4::to_array).map(|x| (x as f32).to_bits()).collect();
        Kernel {
            name: String::new(),
            passes,
            reference: None,
            sizes: vec![
                (self.vector.clone(), self.vectors.len() as u64),
                (self.structure.clone(), 2 * self.vectors.len() as u64),
            ],
            scratch: Vec::new(),
            tables: vec![(self.vector.clone(), Arc::new(words))],
        }
    }
    /// The structure factor. `files` come before those of the sum: the world, what a wave is at a position, and the strength.
    ///
    /// # Errors
    /// When a shader does not compile.
    pub fn structure(&self, files: &[Source], strength: impl Strength, problem: &Problem) -> Result<Kernel, Error> {
        let (count, number) = (problem.capacity, self.number());
        let blocks = BLOCKS.min(PARTS / number.max(1)).max(1);
        let block = count.div_ceil(blocks).clamp(*BLOCK.start(), *BLOCK.end());
        let blocks = count.div_ceil(block).max(1);
        let mut passes = Vec::new();
        let each = [files, &[crate::shader!("ewald/structure.wgsl")]].concat();
        for [first, end] in self.dispatches(problem) {
            let threads = Threads { count: blocks * LANES, layers: (end - first).div_ceil(LANES) };
            let constants = [("BLOCK", f64::from(block)), ("FIRST", f64::from(first))];
            passes.push(self.pass(&each, &constants, threads, u64::from(count) * u64::from(end - first))?);
        }
        let sum = [files, &[crate::shader!("ewald/structure_sum.wgsl")]].concat();
        let work = u64::from(number) * u64::from(blocks);
        passes.push(self.pass(&sum, &[("BLOCKS", f64::from(blocks))], Threads::new(number), work)?);
        let mut kernel = self.kernel(passes);
        kernel.sizes.push((self.parts.clone(), u64::from(blocks) * u64::from(number)));
        kernel.scratch.push(self.parts.clone());
        let waves = self.clone();
        kernel.reference = Some(Arc::new(move |host| waves.add_up(&strength, host)));
        Ok(kernel)
    }
    fn add_up(&self, strength: &impl Strength, host: &Host) -> Result<(), Error> {
        let (position, world) = (host.read(POSITION)?, host.world());
        let frequency = world.bounds.frequency();
        let bodies = &position[..(world.count as usize).min(position.len())];
        let strengths = strength.all(host)?;
        let mut structure = host.writing::<f32>(&self.structure)?;
        structure.par_chunks_mut(2).zip(&*self.vectors).for_each(|(s, wave)| {
            let sum = bodies.iter().zip(&strengths).fold((0.0, 0.0), |(re, im), (p, strength)| {
                let [cosine, sine] = wave_at(*wave, *p, frequency);
                (re + strength * cosine, im + strength * sine)
            });
            let factor = strength.kept(*wave, &world);
            (s[0], s[1]) = (factor * sum.0, factor * sum.1);
        });
        Ok(())
    }
}

/// exp(2πi k·x / L), cosine and sine.
pub fn wave_at(wave: DVec4, position: DVec4, frequency: DVec3) -> [f64; 2] {
    let (sine, cosine) = (2.0 * PI * wave.truncate().dot(position.truncate() * frequency)).sin_cos();
    [cosine, sine]
}
