//! The three verbs of an explicit Runge–Kutta step, of a column.

use super::{Advanced, Part, Real, Work, kernel};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Name, Problem};

fn start(part: &Part) -> Name {
    format!("start_{}", part.name).into()
}

fn slope(part: &Part) -> Name {
    format!("slope_{}", part.name).into()
}

#[derive(Clone)]
struct Save(Part);

impl Work for Save {
    fn run<T: Real>(&self, host: &Host) -> Result<(), Error> {
        host.writing::<T>(&start(&self.0))?.copy_from_slice(&host.reading::<T>(&self.0.buffer)?);
        host.writing::<T>(&slope(&self.0))?.fill(T::ZERO);
        Ok(())
    }
}

/// Saves the start of the step.
pub fn save(part: &Part, problem: &Problem) -> Result<Kernel, Error> {
    let fields = vec![("value", part.buffer.clone()), ("start", start(part)), ("slope", slope(part))];
    let file = crate::shader!("integrators/pairs/save.wgsl");
    kernel("rk_save", part, file, &[], &fields, problem, Save(part.clone()))
}

fn fields(pair: &Advanced) -> Vec<(&'static str, Name)> {
    let Advanced { part, rate } = pair;
    vec![("value", part.buffer.clone()), ("rate", rate.clone()), ("start", start(part)), ("slope", slope(part))]
}

#[derive(Clone)]
struct Stage {
    pair: Advanced,
    weight: f64,
    factor: f64,
    problem: Problem,
}

impl Work for Stage {
    fn run<T: Real>(&self, host: &Host) -> Result<(), Error> {
        let (part, dt) = (&self.pair.part, self.factor * host.world().dt);
        let moving = part.moving(&self.problem, host)?;
        let (mut value, rate) = (host.writing::<T>(&part.buffer)?, host.reading::<T>(&self.pair.rate)?);
        let (start, mut slope) = (host.reading::<T>(&start(part))?, host.writing::<T>(&slope(part))?);
        for i in (0..value.len()).filter(|i| moving(*i)) {
            slope[i] = slope[i] + rate[i] * self.weight;
            value[i] = T::own(value[i], start[i] + rate[i] * dt, &part.components);
        }
        Ok(())
    }
}

/// A stage: adds `weight` times the slope to the sum, and advances to `factor` of the step from its start for the next slope.
pub fn stage(pair: &Advanced, weight: f64, factor: f64, problem: &Problem) -> Result<Kernel, Error> {
    let work = Stage { pair: pair.clone(), weight, factor, problem: problem.clone() };
    let (file, constants) = (crate::shader!("integrators/pairs/stage.wgsl"), [("WEIGHT", weight), ("FACTOR", factor)]);
    kernel("rk_stage", &pair.part, file, &constants, &fields(pair), problem, work)
}

#[derive(Clone)]
struct Finish {
    pair: Advanced,
    weight: f64,
    problem: Problem,
}

impl Work for Finish {
    fn run<T: Real>(&self, host: &Host) -> Result<(), Error> {
        let (part, dt) = (&self.pair.part, host.world().dt);
        let moving = part.moving(&self.problem, host)?;
        let (mut value, rate) = (host.writing::<T>(&part.buffer)?, host.reading::<T>(&self.pair.rate)?);
        let (start, slope) = (host.reading::<T>(&start(part))?, host.reading::<T>(&slope(part))?);
        for i in (0..value.len()).filter(|i| moving(*i)) {
            let new = start[i] + (slope[i] + rate[i] * self.weight) * dt;
            value[i] = T::own(value[i], new, &part.components);
        }
        Ok(())
    }
}

/// The end of the step, with the weight of the last slope.
pub fn finish(pair: &Advanced, weight: f64, problem: &Problem) -> Result<Kernel, Error> {
    let work = Finish { pair: pair.clone(), weight, problem: problem.clone() };
    let file = crate::shader!("integrators/pairs/finish.wgsl");
    kernel("rk_finish", &pair.part, file, &[("WEIGHT", weight)], &fields(pair), problem, work)
}
