//! A thermostat that relaxes the temperature.

use std::sync::Arc;

use glam::DVec4;

use super::{Component, Problem, Properties, Stage};
use crate::component::bath::TEMPERATURE;
use crate::component::thermostat::{CHANGE, HEAT, REMOVED, TOTAL, decayed, heat, measured, scale, serves};
use crate::error::Error;
use crate::kernel::{Column, Host, Kernel, Name, Plan, Shader};
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    TEMPERATURE,
    Key::new("time", Kind::Positive, Value::Number(1.0), "τ, the relaxation time of the temperature [time]"),
    REMOVED,
];

/// `berendsen`: at the end of each step all velocities are scaled by one factor, so that the temperature relaxes to the given one within τ
/// (Berendsen et al., J. Chem. Phys. 81, 3684, 1984). For equilibration only: the kinetic energy hardly fluctuates, so that no ensemble is
/// sampled. K + U less the heat that it has given, the column `thermostat_heat`, is conserved.
#[derive(Clone)]
pub struct Berendsen {
    temperature: f64,
    time: f64,
    removed: f64,
}

impl Berendsen {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        let [temperature, time, removed] = ["temperature", "time", "removed"].map(|name| settings.number(name));
        Self { temperature, time, removed }
    }
    /// The factor of velocities, and the heat.
    fn relax(&self, problem: &Problem) -> Result<Kernel, Error> {
        let shader = Shader::join(&[
            crate::shader!("world.wgsl"),
            crate::shader!("law/decayed.wgsl"),
            crate::shader!("updaters/berendsen.wgsl"),
        ])?;
        let dimensions = f64::from(problem.bounds.dimensions);
        let (temperature, time, removed) = (self.temperature, self.time, self.removed);
        let reference = move |host: &Host| {
            let DVec4 { x: twice, y: count, .. } = host.read(TOTAL)?[0];
            let (mut heat, mut change) = (host.write(HEAT)?, host.write(CHANGE)?);
            let freedoms = dimensions * count - removed;
            change[0] = 0.0;
            if freedoms > 0.0 && twice > 0.0 {
                let part = decayed(host.world().dt / time) * (freedoms * temperature / twice - 1.0);
                change[0] = part / (1.0 + (1.0 + part).sqrt());
                heat[0] += 0.5 * twice * part;
            }
            Ok(())
        };
        let constants =
            vec![("DIMENSIONS", dimensions), ("REMOVED", removed), ("TEMPERATURE", temperature), ("TIME", time)];
        let kernel = Kernel::new("berendsen", shader, constants, 1, Arc::new(reference));
        let one = |name: &'static str| (Name::from(name), 1);
        Ok(Kernel { sizes: [TOTAL.name, HEAT.name, CHANGE.name].map(one).to_vec(), ..kernel })
    }
}

impl Component for Berendsen {
    fn columns(&self) -> Vec<Column> {
        vec![heat()]
    }
    fn properties(&self) -> Properties {
        Properties { constrains: true, thermostat: true, temperature: Some(self.temperature), ..Properties::default() }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        if stage == Stage::EndOfStep {
            serves("berendsen", self.removed, problem)?;
            measured(problem)?.into_iter().for_each(|kernel| plan.add(kernel));
            plan.add(self.relax(problem)?);
            plan.add(scale(problem)?);
        }
        Ok(())
    }
}
