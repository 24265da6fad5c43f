//! A kick or a drift of a column: y ← y + c y' dt.

use super::{Advanced, Real, Work, kernel};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Problem};

#[derive(Clone)]
struct Advance {
    pair: Advanced,
    factor: f64,
    problem: Problem,
}

impl Work for Advance {
    fn run<T: Real>(&self, host: &Host) -> Result<(), Error> {
        let (part, dt) = (&self.pair.part, self.factor * host.world().dt);
        let moving = part.moving(&self.problem, host)?;
        let (mut value, rate) = (host.writing::<T>(&part.buffer)?, host.reading::<T>(&self.pair.rate)?);
        for (_, (y, slope)) in value.iter_mut().zip(rate.iter()).enumerate().filter(|(i, _)| moving(*i)) {
            *y = T::own(*y, *y + *slope * dt, &part.components);
        }
        Ok(())
    }
}

/// The kernel, for a part of the step; `verb` is the verb of the integrator.
pub fn advance(verb: &str, pair: &Advanced, factor: f64, problem: &Problem) -> Result<Kernel, Error> {
    let work = Advance { pair: pair.clone(), factor, problem: problem.clone() };
    let fields = vec![("value", pair.part.buffer.clone()), ("rate", pair.rate.clone())];
    let file = crate::shader!("integrators/pairs/advance.wgsl");
    kernel(verb, &pair.part, file, &[("FACTOR", factor)], &fields, problem, work)
}
