//! Heat baths of single particles: kernels that give velocities by random numbers.

use std::sync::Arc;

use glam::DVec3;

use crate::error::Error;
use crate::kernel::{Host, Kernel, Pass, Problem, Shader, Source, VELOCITY};
use crate::settings::{Key, Kind, Settings};
use crate::visit::random::{fraction, pcg4d, words};
use crate::visit::{Particle, View};

/// The temperature of the bath.
pub(crate) const TEMPERATURE: Key =
    Key::required("temperature", Kind::Positive, "k T, twice the mean kinetic energy of a degree of freedom [energy]");

/// Changes the seed, so that a thermostat has other random numbers than a force with the same seed.
const NUMBERS: u32 = 0x5EA7_BA78;

/// The temperature and the seed of settings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bath {
    pub temperature: f64,
    pub seed: [u32; 2],
}

impl Bath {
    pub fn of(settings: &Settings) -> Self {
        let [low, high] = words(settings.whole("seed"));
        Self { temperature: settings.number("temperature"), seed: [low, high ^ NUMBERS] }
    }
    /// A kernel of one invocation for each particle; `turn` gives the velocity of one that is free, active and has mass.
    pub fn kernel(
        self,
        name: &str,
        file: Source,
        rate: (&'static str, f64),
        problem: &Problem,
        turn: impl Fn(&Particle, f64, &Host) -> DVec3 + Send + Sync + 'static,
    ) -> Result<Kernel, Error> {
        if !problem.network.rods.is_empty() {
            return Err(Error::Scene(format!(
                "{name} gives each particle a velocity of its own, also along its rods: leave out the rods, or choose springs"
            )));
        }
        let (holding, tables) = problem.holding();
        let shader = Shader::join(&[
            crate::shader!("world.wgsl"),
            crate::shader!("law/random.wgsl"),
            crate::shader!("law/circle.wgsl"),
            crate::shader!("law/normals.wgsl"),
            crate::shader!("law/decayed.wgsl"),
            problem.naming(),
            problem.active(),
            holding,
            crate::shader!("thermostat/bath.wgsl"),
            file,
        ])?;
        let [low, high] = self.seed.map(f64::from);
        let constants = vec![("TEMPERATURE", self.temperature), rate, ("SEED_LOW", low), ("SEED_HIGH", high)];
        let pass = Pass { constants, alone: true, ..Pass::new(shader, problem.capacity) };
        let of = problem.clone();
        let reference = move |host: &Host| {
            let view = View::of(host)?;
            let mut velocity = host.write(VELOCITY)?;
            for me in view.particles() {
                if me.mass > 0.0 && me.is_active() && !of.is_held(me.index) {
                    let radius = velocity[me.index].w;
                    velocity[me.index] = turn(&me, rate.1 * host.world().dt, host).extend(radius);
                }
            }
            Ok(())
        };
        let (sizes, scratch) = (Vec::new(), Vec::new());
        Ok(Kernel {
            name: name.to_owned(),
            passes: vec![pass],
            reference: Some(Arc::new(reference)),
            sizes,
            scratch,
            tables,
        })
    }
    /// Four random words for a particle and a count of steps.
    pub fn words(self, me: &Particle, step: u32) -> [u32; 4] {
        pcg4d([me.id(), step, self.seed[0], self.seed[1]])
    }
}

/// Three normal numbers out of four random words; in the plane the third is 0.
pub(crate) fn normals(words: [u32; 4], dimensions: u32) -> DVec3 {
    let radius = |word: u32| (-2.0 * ((f64::from(word >> 8) + 0.5) / 16_777_216.0).ln()).sqrt();
    let angle = |word: u32| std::f64::consts::TAU * fraction(word);
    let [a, b, c, d] = words;
    let z = if dimensions == 3 { radius(c) * angle(d).cos() } else { 0.0 };
    DVec3::new(radius(a) * angle(b).cos(), radius(a) * angle(b).sin(), z)
}
