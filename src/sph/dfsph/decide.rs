//! The convergence check of a solve: the mean error, summed in a fixed order.

use std::sync::Arc;

use super::{Dfsph, ERRORS, STATE, STATES, Solve, with};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Scalar};
use crate::neighbors::STARTS;

const PARTS: &str = "parts";
/// Invocations of a workgroup, as in solve_total.wgsl.
const WORKGROUP: u32 = 256;
/// The maximum number of errors that one workgroup adds alone.
const ALONE: u32 = 1 << 13;
/// The number of errors in each part of a longer sum.
const CHUNK: u32 = 1 << 11;

/// The kernels: one where there are few particles, else two.
pub fn kernels(of: &Dfsph<'_>, solve: Solve) -> Result<Vec<Kernel>, Error> {
    let count = of.grid.ahead(of.problem).max(1);
    if count <= ALONE {
        return Ok(vec![decide(of, solve, ERRORS, count)?]);
    }
    Ok(vec![tally(of, solve)?, decide(of, solve, PARTS, count.div_ceil(CHUNK))?])
}

fn extent(elements: u32) -> [(&'static str, Scalar); 2] {
    [("elements", Scalar::Uint(elements)), ("chunk", Scalar::Uint(CHUNK))]
}

fn tally(of: &Dfsph<'_>, solve: Solve) -> Result<Kernel, Error> {
    let (count, errors, parts) = (of.grid.ahead(of.problem).max(1), of.name(ERRORS), of.name(PARTS));
    let groups = count.div_ceil(CHUNK);
    let (from, to) = (errors.clone(), parts.clone());
    let reference = move |host: &Host| {
        let errors = host.reading::<f32>(&from)?;
        let sums = errors[..errors.len().min(count as usize)].chunks(CHUNK as usize).map(|run| run.iter().sum());
        host.writing::<f32>(&to)?.iter_mut().zip(sums).for_each(|(part, sum): (_, f64)| *part = sum);
        Ok(())
    };
    let files = [crate::shader!("integrators/solve_total.wgsl"), crate::shader!("sph/dfsph/tally.wgsl")];
    let name = format!("fluid {} tally", solve.name());
    let mut kernel = of.plain(&name, &files, &extent(count), groups * WORKGROUP, Arc::new(reference))?;
    kernel.passes[0].fields.push((PARTS.into(), parts.clone()));
    kernel.sizes.push((parts, u64::from(groups)));
    Ok(kernel)
}

fn decide(of: &Dfsph<'_>, solve: Solve, what: &'static str, elements: u32) -> Result<Kernel, Error> {
    let asked = of.asked;
    let tolerance = if solve == Solve::Density { asked.density } else { asked.divergence };
    let (starts, cells) = (of.name(STARTS), of.grid.count() as usize);
    let field = of.name(what);
    let from = field.clone();
    let reference = move |host: &Host| {
        let sum: f64 = host.reading::<f32>(&from)?.iter().take(elements as usize).sum();
        let fluid = host.reading::<u32>(&starts)?.get(cells).map_or(1, |n| (*n).max(1));
        let mut states = host.writing::<f32>(STATES)?;
        let state = &mut states[STATE * solve as usize..STATE * (solve as usize + 1)];
        state[2] = sum / f64::from(fluid);
        state[0] += 1.0;
        state[1] = if !sum.is_finite() {
            2.0
        } else if state[2] <= tolerance && state[0] >= f64::from(asked.least) {
            1.0
        } else if state[0] >= f64::from(asked.most) {
            3.0
        } else {
            0.0
        };
        Ok(())
    };
    let files = [
        crate::shader!("broken.wgsl"),
        crate::shader!("integrators/solve_total.wgsl"),
        crate::shader!("sph/dfsph/decide.wgsl"),
    ];
    let name = format!("fluid {} decide", solve.name());
    let mut kernel = of.plain(&name, &files, &extent(elements), WORKGROUP, Arc::new(reference))?;
    let fields = &mut kernel.passes[0].fields;
    fields.retain(|(name, _)| *name != ERRORS);
    fields.push((ERRORS.into(), field.clone()));
    kernel.sizes.push((field, u64::from(elements)));
    let (least, most) = (f64::from(asked.least), f64::from(asked.most));
    let constants = [("SOLVE", f64::from(solve as u32)), ("TOLERANCE", tolerance), ("LEAST", least), ("MOST", most)];
    Ok(with(kernel, &constants))
}
