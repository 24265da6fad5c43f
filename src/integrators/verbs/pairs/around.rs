//! Kernels around evaluations, measurements and steps: sums are zeroed, rates are saved, values are checked.

use super::{Part, Real, Work, kernel};
use crate::error::Error;
use crate::kernel::{ALARM, ALARM_WORDS, Host, Kernel, Name, Problem, Shape};

#[derive(Clone)]
struct Clear(Part);

impl Work for Clear {
    fn run<T: Real>(&self, host: &Host) -> Result<(), Error> {
        host.writing::<T>(&self.0.buffer)?.fill(T::ZERO);
        Ok(())
    }
}

/// Sets the buffer of a sum to zero, before the first law.
pub fn clear(part: &Part, problem: &Problem) -> Result<Kernel, Error> {
    let fields = vec![("value", part.buffer.clone())];
    let file = crate::shader!("integrators/pairs/clear.wgsl");
    kernel("clear", part, file, &[], &fields, problem, Clear(part.clone()))
}

#[derive(Clone)]
struct Copy {
    from: Name,
    to: Name,
}

impl Work for Copy {
    fn run<T: Real>(&self, host: &Host) -> Result<(), Error> {
        host.writing::<T>(&self.to)?.copy_from_slice(&host.reading::<T>(&self.from)?);
        Ok(())
    }
}

fn copy(verb: &str, part: &Part, [from, to]: [Name; 2], problem: &Problem) -> Result<Kernel, Error> {
    let fields = vec![("from_field", from.clone()), ("to_field", to.clone())];
    let file = crate::shader!("integrators/pairs/copy.wgsl");
    kernel(verb, part, file, &[], &fields, problem, Copy { from, to })
}

fn kept(part: &Part) -> Name {
    format!("kept_{}", part.buffer).into()
}

/// Saves the buffer of a rate that the next step uses.
pub fn keep(part: &Part, problem: &Problem) -> Result<Kernel, Error> {
    copy("keep", part, [part.buffer.clone(), kept(part)], problem)
}

/// Restores it.
pub fn restore(part: &Part, problem: &Problem) -> Result<Kernel, Error> {
    copy("restore", part, [kept(part), part.buffer.clone()], problem)
}

#[derive(Clone)]
struct Watch {
    part: Part,
    ahead: u32,
}

impl Work for Watch {
    fn run<T: Real>(&self, host: &Host) -> Result<(), Error> {
        let (done, value) = (host.world().step + self.ahead, host.reading::<T>(&self.part.buffer)?);
        let first = value.iter().position(|y| !T::is_finite(*y, &self.part.components));
        let mut alarm = host.write(ALARM)?;
        if let ([broken, id, ..], Some(first)) = (&mut alarm[..], first)
            && *broken >= done
        {
            (*broken, *id) = (done, (*id).min(u32::try_from(first / self.part.slots()).unwrap_or(u32::MAX)));
        }
        Ok(())
    }
}

/// Raises the alarm when a column of particles is not finite; it may run before the last steps, `ahead`, are counted.
pub fn watch(part: &Part, ahead: u32, problem: &Problem) -> Result<Option<Kernel>, Error> {
    if matches!(part.shape, Shape::System(_)) {
        return Ok(None);
    }
    let fields = vec![("value", part.buffer.clone())];
    let file = crate::shader!("integrators/pairs/watch.wgsl");
    let mut kernel = kernel(
        "watch",
        part,
        file,
        &[("AHEAD", f64::from(ahead))],
        &fields,
        problem,
        Watch { part: part.clone(), ahead },
    )?;
    kernel.sizes.push((ALARM.name.into(), ALARM_WORDS as u64));
    Ok(Some(kernel))
}
