//! A barostat with which the volume fluctuates.

use super::{Component, Problem, Properties, Stage};
use crate::component::barostat::{Barostat, COMPRESSIBILITY, EVERY, PRESSURE, TIME, columns};
use crate::component::bath::{TEMPERATURE, normals};
use crate::component::keys::SEED;
use crate::error::Error;
use crate::kernel::{Column, Plan};
use crate::settings::{Key, Settings};
use crate::visit::random::{pcg4d, words};

/// The keys in a scene.
pub const KEYS: &[Key] = &[PRESSURE, TEMPERATURE, COMPRESSIBILITY, TIME, EVERY, SEED];

/// Changes the seed, so that a barostat has other random numbers than a thermostat with the same seed.
const NUMBERS: u32 = 0xB0C5_1DE5;

/// `cell_rescaling`: the box and the particles in it are scaled, and velocities by the inverse, by a factor that relaxes within τ and has a
/// random part, so that volumes have the distribution of a given pressure and temperature (Bernetti & Bussi, J. Chem. Phys. 153, 114107,
/// 2020). It needs a thermostat of the same temperature. The box is the column `box_corner`.
#[derive(Clone)]
pub struct CellRescaling {
    barostat: Barostat,
    temperature: f64,
    seed: [u32; 2],
}

impl CellRescaling {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        let [low, high] = words(settings.whole("seed"));
        let barostat = Barostat::of("cell_rescaling", settings, true);
        Self { barostat, temperature: settings.number("temperature"), seed: [low, high ^ NUMBERS] }
    }
}

impl Component for CellRescaling {
    fn columns(&self) -> Vec<Column> {
        columns()
    }
    fn properties(&self) -> Properties {
        let why = "cell_rescaling changes the box after steps of one length";
        let (barostat, temperature) = (Some(self.barostat.pressed()), Some(self.temperature));
        Properties { fixed_step: Some(why), constrains: true, temperature, barostat, ..Properties::default() }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        match stage {
            Stage::AfterDrift { .. } => self.barostat.change(problem)?.into_iter().for_each(|kernel| plan.add(kernel)),
            Stage::Pressure => {
                let files = [
                    crate::shader!("law/random.wgsl"),
                    crate::shader!("law/circle.wgsl"),
                    crate::shader!("law/normals.wgsl"),
                    crate::shader!("updaters/cell_rescaling.wgsl"),
                ];
                let [low, high] = self.seed;
                let more = [("TEMPERATURE", self.temperature), ("SEED_LOW", low.into()), ("SEED_HIGH", high.into())];
                let noise = move |step: u32| normals(pcg4d([0, step, low, high]), 2).x;
                plan.add(self.barostat.decide(&files, &more, noise)?);
            }
            _ => {}
        }
        Ok(())
    }
}
