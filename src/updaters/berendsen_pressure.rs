//! A barostat with which the pressure relaxes.

use super::{Component, Problem, Properties, Stage};
use crate::component::barostat::{Barostat, COMPRESSIBILITY, EVERY, PRESSURE, TIME, columns};
use crate::error::Error;
use crate::kernel::{Column, Plan};
use crate::settings::{Key, Settings};

/// The keys in a scene.
pub const KEYS: &[Key] = &[PRESSURE, COMPRESSIBILITY, TIME, EVERY];

/// `berendsen_pressure`: the box and the particles in it are scaled such that the pressure relaxes to a given one within τ (Berendsen, Postma,
/// van Gunsteren, DiNola & Haak, J. Chem. Phys. 81, 3684, 1984). Volumes do not fluctuate as they do at a given pressure: for equilibration
/// only. The box is the column `box_corner`.
#[derive(Clone)]
pub struct BerendsenPressure(Barostat);

impl BerendsenPressure {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(Barostat::of("berendsen_pressure", settings, false))
    }
}

impl Component for BerendsenPressure {
    fn columns(&self) -> Vec<Column> {
        columns()
    }
    fn properties(&self) -> Properties {
        let why = "berendsen_pressure changes the box after steps of one length";
        Properties { fixed_step: Some(why), constrains: true, barostat: Some(self.0.pressed()), ..Properties::default() }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        match stage {
            Stage::AfterDrift { .. } => self.0.change(problem)?.into_iter().for_each(|kernel| plan.add(kernel)),
            Stage::Pressure => {
                let file = crate::shader!("updaters/berendsen_pressure.wgsl");
                plan.add(self.0.decide(&[file], &[], |_| 0.0)?);
            }
            _ => {}
        }
        Ok(())
    }
}
