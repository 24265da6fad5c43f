//! A thermostat with a variable of the whole system.

use std::sync::Arc;

use glam::{DVec4, Vec4};

use super::{Component, Problem, Properties, Stage};
use crate::component::bath::TEMPERATURE;
use crate::error::Error;
use crate::kernel::{
    Column, Field, Host, Kernel, Kind as Element, Name, POSITION, Pass, Plan, Reference, Shader, Shape, Source, VELOCITY,
};
use crate::primitives::{Items, Operation, reduce};
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    TEMPERATURE,
    Key::new("time", Kind::Positive, Value::Number(1.0), "τ, the relaxation time of the thermostat; some periods of the fastest motion [time]"),
    REMOVED,
];

/// What does not count as a degree of freedom.
pub(super) const REMOVED: Key = Key::new("removed", Kind::Whole, Value::Number(0.0), "constrained degrees of freedom: as many as dimensions where forces conserve the total momentum, and it is 0");

/// ξ
const RATE: Field<f32> = Field::new("thermostat_rate");
/// η
const PHASE: Field<f32> = Field::new("thermostat_phase");
/// m v² of each particle that is free, and 1 where it is.
const KINETIC: Field<Vec4> = Field::new("thermostat_kinetic");
/// The sum of these.
pub(super) const TOTAL: Field<Vec4> = Field::new("thermostat_total");
/// The relative change of velocities.
pub(super) const CHANGE: Field<f32> = Field::new("thermostat_change");

/// `nose_hoover`: v' = a − ξ v, ξ' = (2 K / N k T − 1) / τ², with N degrees of freedom of all particles that are free and have
/// mass (Nosé, J. Chem. Phys. 81, 511, 1984; Hoover, Phys. Rev. A 31, 1695, 1985). Half of it is done before each step and half after
/// it, which is reversible (Martyna, Tuckerman, Tobias & Klein, Mol. Phys. 87, 1117, 1996), so that
/// K + U + N k T (τ² ξ² / 2 + η), with η the integral of ξ, swings by dt² and does not drift. Few or harmonic particles do not visit all
/// states that they should (Hoover 1985): a single oscillator keeps to its torus.
#[derive(Clone)]
pub struct NoseHoover {
    temperature: f64,
    time: f64,
    removed: f64,
}

impl NoseHoover {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        let [temperature, time, removed] = ["temperature", "time", "removed"].map(|name| settings.number(name));
        Self { temperature, time, removed }
    }
    /// Kernels of a part of a step.
    fn part(&self, factor: f64, problem: &Problem) -> Result<Vec<Kernel>, Error> {
        let mut kernels = measured(problem)?;
        kernels.extend([self.advance(factor, problem)?, scale(problem)?]);
        Ok(kernels)
    }
    /// ξ and η over a part of a step, and what velocities change by.
    fn advance(&self, factor: f64, problem: &Problem) -> Result<Kernel, Error> {
        let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("updaters/nose_hoover.wgsl")])?;
        let dimensions = f64::from(problem.bounds.dimensions);
        let (temperature, time, removed) = (self.temperature, self.time, self.removed);
        let reference = move |host: &Host| {
            let DVec4 { x: twice, y: count, .. } = host.read(TOTAL)?[0];
            let (mut rate, mut phase, mut change) = (host.write(RATE)?, host.write(PHASE)?, host.write(CHANGE)?);
            let (h, freedoms) = (factor * host.world().dt, dimensions * count - removed);
            let push = |twice: f64| 0.5 * h * (twice / (freedoms * temperature) - 1.0) / (time * time);
            change[0] = 0.0;
            if freedoms > 0.0 {
                rate[0] += push(twice);
                let x = h * rate[0];
                change[0] = -x / (1.0 + x * (0.5 + x / 12.0));
                phase[0] += x;
                rate[0] += push(twice * (1.0 + change[0]).powi(2));
            }
            Ok(())
        };
        let constants = vec![
            ("FACTOR", factor),
            ("DIMENSIONS", dimensions),
            ("REMOVED", removed),
            ("TEMPERATURE", temperature),
            ("TIME", time),
        ];
        let kernel = Kernel::new("nose_hoover", shader, constants, 1, Arc::new(reference));
        let one = |name: &'static str| (Name::from(name), 1);
        let sizes = [TOTAL.name, RATE.name, PHASE.name, CHANGE.name].map(one).to_vec();
        Ok(Kernel { sizes, ..kernel })
    }
}

/// Refuses what thermostats of all particles do not serve.
pub(super) fn serves(name: &str, removed: f64, problem: &Problem) -> Result<(), Error> {
    let refuse = |why: &str| Err(Error::Scene(format!("{name} {why}")));
    if problem.has_inactive {
        return refuse("regulates the same particles all the time: leave out emitters and drains");
    }
    if !problem.network.rods.is_empty() {
        return refuse("counts three degrees of freedom of a particle, and rods take some of them: leave out the rods");
    }
    let free = (0..problem.capacity as usize).filter(|id| !problem.is_held(*id)).count();
    let freedoms = free as f64 * f64::from(problem.bounds.dimensions) - removed;
    if freedoms <= 0.0 {
        return Err(Error::Scene(format!(
            "{name} has no degree of freedom to regulate: {free} particles are free, in {} dimensions, less {} that are removed",
            problem.bounds.dimensions, removed
        )));
    }
    Ok(())
}

/// Kernels of the sum of m v², and of how many particles have it.
pub(super) fn measured(problem: &Problem) -> Result<Vec<Kernel>, Error> {
    let (field, total): (Name, Name) = (KINETIC.name.into(), TOTAL.name.into());
    let mut sum = reduce(Operation::Sum, Items::Vec4, &field, &total, problem.capacity, &problem.machine)?;
    sum.name = "thermostat total".into();
    Ok(vec![kinetic(problem)?, sum])
}

/// A kernel of one invocation for each particle, with the information which ones are free.
fn each(name: &str, file: Source, problem: &Problem, reference: Reference) -> Result<Kernel, Error> {
    let (holding, tables) = problem.holding();
    let shader = Shader::join(&[crate::shader!("world.wgsl"), holding, file])?;
    let passes = vec![Pass::new(shader, problem.capacity)];
    let sizes = vec![(CHANGE.name.into(), 1)];
    Ok(Kernel { name: name.to_owned(), passes, reference: Some(reference), sizes, scratch: Vec::new(), tables })
}

fn kinetic(problem: &Problem) -> Result<Kernel, Error> {
    let of = problem.clone();
    let reference = move |host: &Host| {
        let (position, velocity) = (host.read(POSITION)?, host.read(VELOCITY)?);
        for (id, part) in host.write(KINETIC)?.iter_mut().enumerate() {
            let mass = position[id].w;
            let free = mass > 0.0 && !of.is_held(id);
            *part = if free { DVec4::new(mass * velocity[id].truncate().length_squared(), 1.0, 0.0, 0.0) } else { DVec4::ZERO };
        }
        Ok(())
    };
    each("thermostat kinetic", crate::shader!("updaters/nose_hoover_kinetic.wgsl"), problem, Arc::new(reference))
}

/// Changes velocities by a part.
pub(super) fn scale(problem: &Problem) -> Result<Kernel, Error> {
    let of = problem.clone();
    let reference = move |host: &Host| {
        let (change, position) = (host.read(CHANGE)?[0], host.read(POSITION)?);
        for (id, v) in host.write(VELOCITY)?.iter_mut().enumerate() {
            if position[id].w > 0.0 && !of.is_held(id) {
                *v += (change * v.truncate()).extend(0.0);
            }
        }
        Ok(())
    };
    each("thermostat scale", crate::shader!("updaters/nose_hoover_scale.wgsl"), problem, Arc::new(reference))
}

impl Component for NoseHoover {
    fn columns(&self) -> Vec<Column> {
        let of_all = |name, unit, about| Column::new(name, Element::Scalar, unit, about).shaped(Shape::System(1));
        vec![
            of_all(RATE.name, "1 / time", "ξ, the rate at which the thermostat brakes all particles"),
            of_all(PHASE.name, "", "η, the integral of ξ over time, which the conserved energy counts"),
        ]
    }
    fn properties(&self) -> Properties {
        let why = "nose_hoover is reversible in steps of one length";
        Properties { fixed_step: Some(why), constrains: true, thermostat: true, ..Properties::default() }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        if matches!(stage, Stage::StartOfStep | Stage::EndOfStep) {
            serves("nose_hoover", self.removed, problem)?;
            self.part(0.5, problem)?.into_iter().for_each(|kernel| plan.add(kernel));
        }
        Ok(())
    }
}
