//! Parts of thermostats of all particles: the sum of m v², one factor for all velocities, the heat that was given.

use std::sync::Arc;

use glam::{DVec4, Vec4};

use super::each;
use crate::error::Error;
use crate::kernel::{Column, Field, Host, Kernel, Kind as Element, Name, POSITION, Problem, Shape, VELOCITY};
use crate::primitives::{Items, Operation, reduce};
use crate::settings::{Key, Kind, Value};

/// What does not count as a degree of freedom.
pub(crate) const REMOVED: Key = Key::new(
    "removed",
    Kind::Whole,
    Value::Number(0.0),
    "constrained degrees of freedom: as many as dimensions where forces conserve the total momentum, and it is 0",
);

/// m v² of each particle that is free, and 1 where it is.
const KINETIC: Field<Vec4> = Field::new("thermostat_kinetic");
/// The sum of these.
pub(crate) const TOTAL: Field<Vec4> = Field::new("thermostat_total");
/// The relative change of velocities.
pub(crate) const CHANGE: Field<f32> = Field::new("thermostat_change");
/// What a thermostat has given to particles.
pub(crate) const HEAT: Field<f32> = Field::new("thermostat_heat");

/// The column of the heat.
pub(crate) fn heat() -> Column {
    let about = "what the thermostat has given to particles";
    Column::new(HEAT.name, Element::Scalar, "energy", about).shaped(Shape::System(1))
}

/// 1 − exp(−x), the part that is forgotten in x relaxation times.
pub(crate) fn decayed(x: f64) -> f64 {
    -(-x).exp_m1()
}

/// Refuses what thermostats of all particles do not serve.
pub(crate) fn serves(name: &str, removed: f64, problem: &Problem) -> Result<(), Error> {
    let refuse = |why: &str| Err(Error::Scene(format!("{name} {why}")));
    if problem.has_inactive {
        return refuse("regulates the same particles all the time: leave out emitters, drains and mergers");
    }
    if !problem.network.rods.is_empty() {
        return refuse("counts three degrees of freedom of a particle, and rods take some of them: leave out the rods");
    }
    let free = (0..problem.capacity as usize).filter(|id| !problem.is_held(*id)).count();
    let freedoms = free as f64 * f64::from(problem.bounds.dimensions) - removed;
    if freedoms <= 0.0 {
        return Err(Error::Scene(format!(
            "{name} has no degree of freedom to regulate: {free} particles move in {} dimensions, and {removed} degrees of freedom are \
             constrained: add particles that are not fixed, or remove the thermostat",
            problem.bounds.dimensions
        )));
    }
    Ok(())
}

/// Kernels of the sum of m v², and of how many particles have it.
pub(crate) fn measured(problem: &Problem) -> Result<Vec<Kernel>, Error> {
    let (field, total): (Name, Name) = (KINETIC.name.into(), TOTAL.name.into());
    let mut sum = reduce(Operation::Sum, Items::Vec4, &field, &total, problem.capacity, &problem.machine)?;
    sum.name = "thermostat total".into();
    Ok(vec![kinetic(problem)?, sum])
}

fn kinetic(problem: &Problem) -> Result<Kernel, Error> {
    let of = problem.clone();
    let reference = move |host: &Host| {
        let (position, velocity) = (host.read(POSITION)?, host.read(VELOCITY)?);
        for (id, part) in host.write(KINETIC)?.iter_mut().enumerate() {
            let mass = position[id].w;
            let free = mass > 0.0 && !of.is_held(id);
            *part = if free {
                DVec4::new(mass * velocity[id].truncate().length_squared(), 1.0, 0.0, 0.0)
            } else {
                DVec4::ZERO
            };
        }
        Ok(())
    };
    each("thermostat kinetic", crate::shader!("thermostat/kinetic.wgsl"), problem, Arc::new(reference))
}

/// Changes velocities by a part.
pub(crate) fn scale(problem: &Problem) -> Result<Kernel, Error> {
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
    let kernel = each("thermostat scale", crate::shader!("thermostat/scale.wgsl"), problem, Arc::new(reference))?;
    Ok(Kernel { sizes: vec![(CHANGE.name.into(), 1)], ..kernel })
}
