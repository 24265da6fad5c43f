//! A thermostat that rescales velocities at random.

use std::sync::Arc;

use glam::{DVec4, Vec4};

use super::{Component, Problem, Properties, Stage};
use crate::component::bath::{Bath, TEMPERATURE, normals};
use crate::component::keys::SEED;
use crate::component::thermostat::{CHANGE, HEAT, TOTAL, decayed, heat, measured, scale, serves};
use crate::error::Error;
use crate::kernel::{Column, Field, Host, Kernel, Name, Pass, Plan, Shader};
use crate::primitives::{Items, Operation, reduce};
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit::View;

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    TEMPERATURE,
    Key::new("time", Kind::Positive, Value::Number(1.0), "τ, the relaxation time of the kinetic energy [time]"),
    Key::new("drift", Kind::Flag, Value::Flag(true), "whether the motion of the centre of mass is heat; say false where forces conserve the total momentum, and it is 0"),
    SEED,
];

/// √m n and m of each particle, √m n · v and n², and their sums.
const NOISE: Field<Vec4> = Field::new("thermostat_noise");
const WORK: Field<Vec4> = Field::new("thermostat_work");
const NOISE_TOTAL: Field<Vec4> = Field::new("thermostat_noise_total");
const WORK_TOTAL: Field<Vec4> = Field::new("thermostat_work_total");

/// `csvr`: at the end of each step all velocities are scaled by one random factor, so that the kinetic energy relaxes within τ and has the
/// canonical distribution (Bussi, Donadio & Parrinello, J. Chem. Phys. 126, 014101, 2007). Directions and ratios of velocities are kept, so
/// that diffusion is hardly changed. K + U less the heat that it has given, the column `thermostat_heat`, is conserved. The normal numbers,
/// one for each degree of freedom, are counted by id, step and seed.
#[derive(Clone)]
pub struct Csvr {
    bath: Bath,
    time: f64,
    drift: bool,
}

impl Csvr {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self { bath: Bath::of(settings), time: settings.number("time"), drift: settings.flag("drift") }
    }
    /// Degrees of freedom of the momentum.
    fn removed(&self, problem: &Problem) -> f64 {
        if self.drift { 0.0 } else { f64::from(problem.bounds.dimensions) }
    }
    /// The noise of each particle, and its sums.
    fn noise(&self, problem: &Problem) -> Result<Vec<Kernel>, Error> {
        let (holding, tables) = problem.holding();
        let shader = Shader::join(&[
            crate::shader!("world.wgsl"),
            crate::shader!("law/random.wgsl"),
            crate::shader!("law/circle.wgsl"),
            crate::shader!("law/normals.wgsl"),
            problem.naming(),
            holding,
            crate::shader!("updaters/csvr_noise.wgsl"),
        ])?;
        let (of, bath) = (problem.clone(), self.bath);
        let reference = move |host: &Host| {
            let (view, world) = (View::of(host)?, host.world());
            let (mut noise, mut work) = (host.write(NOISE)?, host.write(WORK)?);
            for me in view.particles() {
                let free = me.mass > 0.0 && !of.is_held(me.index);
                let n = normals(bath.words(&me, world.step), world.bounds.dimensions) * f64::from(u8::from(free));
                let root = me.mass.sqrt();
                noise[me.index] = if free { (root * n).extend(me.mass) } else { DVec4::ZERO };
                work[me.index] = DVec4::new(root * n.dot(me.velocity), n.length_squared(), 0.0, 0.0);
            }
            Ok(())
        };
        let [low, high] = bath.seed.map(f64::from);
        let constants = vec![("SEED_LOW", low), ("SEED_HIGH", high)];
        let passes = vec![Pass { constants, ..Pass::new(shader, problem.capacity) }];
        let (sizes, scratch) = (Vec::new(), Vec::new());
        let each = Kernel { name: "csvr noise".into(), passes, reference: Some(Arc::new(reference)), sizes, scratch, tables };
        let sum = |field: Field<Vec4>, total: Field<Vec4>| -> Result<Kernel, Error> {
            let (field, total): (Name, Name) = (field.name.into(), total.name.into());
            let sum = reduce(Operation::Sum, Items::Vec4, &field, &total, problem.capacity, &problem.machine)?;
            Ok(Kernel { name: format!("sum of {field}"), ..sum })
        };
        Ok(vec![each, sum(NOISE, NOISE_TOTAL)?, sum(WORK, WORK_TOTAL)?])
    }
    /// The factor of velocities, and the heat.
    fn draw(&self, problem: &Problem) -> Result<Kernel, Error> {
        let shader = Shader::join(&[
            crate::shader!("world.wgsl"),
            crate::shader!("law/decayed.wgsl"),
            crate::shader!("updaters/csvr.wgsl"),
        ])?;
        let (temperature, time, removed) = (self.bath.temperature, self.time, self.removed(problem));
        let reference = move |host: &Host| {
            let (twice, noise) = (host.read(TOTAL)?[0].x, host.read(NOISE_TOTAL)?[0]);
            let DVec4 { x: work, y: mut squares, .. } = host.read(WORK_TOTAL)?[0];
            let (mut heat, mut change) = (host.write(HEAT)?, host.write(CHANGE)?);
            change[0] = 0.0;
            if twice > 0.0 {
                if removed > 0.0 {
                    squares -= noise.truncate().length_squared() / noise.w;
                }
                let lost = decayed(host.world().dt / time);
                let along = (lost * temperature).sqrt() * work / twice;
                let part = lost * (temperature * squares / twice - 1.0) + 2.0 * (1.0 - lost).sqrt() * along;
                let factor = (1.0 + part).max(0.0).sqrt();
                let turns = (1.0 - lost).sqrt() + along < 0.0;
                change[0] = if turns { -1.0 - factor } else { part / (1.0 + factor) };
                heat[0] += 0.5 * twice * part;
            }
            Ok(())
        };
        let constants = vec![("REMOVED", removed), ("TEMPERATURE", temperature), ("TIME", time)];
        let kernel = Kernel::new("csvr", shader, constants, 1, Arc::new(reference));
        let one = |name: &'static str| (Name::from(name), 1);
        let sizes = [TOTAL, NOISE_TOTAL, WORK_TOTAL].map(|field| field.name);
        Ok(Kernel { sizes: sizes.into_iter().chain([HEAT.name, CHANGE.name]).map(one).collect(), ..kernel })
    }
}

impl Component for Csvr {
    fn columns(&self) -> Vec<Column> {
        vec![heat()]
    }
    fn properties(&self) -> Properties {
        let why = "csvr draws its noise for steps of one length";
        Properties { fixed_step: Some(why), constrains: true, thermostat: true, canonical: true, temperature: Some(self.bath.temperature), ..Properties::default() }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        if stage == Stage::EndOfStep {
            serves("csvr", self.removed(problem), problem)?;
            measured(problem)?.into_iter().for_each(|kernel| plan.add(kernel));
            self.noise(problem)?.into_iter().for_each(|kernel| plan.add(kernel));
            plan.add(self.draw(problem)?);
            plan.add(scale(problem)?);
        }
        Ok(())
    }
}
