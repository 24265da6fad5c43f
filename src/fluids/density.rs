//! Density by summation: ρ = Σ m W, over the fluid and its walls (Gingold & Monaghan 1977; Akinci et al. 2012).

use std::sync::Arc;

use glam::DVec3;

use super::{DENSITY, Medium};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Problem};
use crate::visit::{Candidate, Sweep, gathered};

/// The kernel that sums it, for everybody that is not held.
///
/// # Errors
/// When the range is none, or a shader does not compile.
pub fn density(medium: &Medium, problem: &Problem) -> Result<Kernel, Error> {
    let (holding, tables) = problem.holding();
    let files = medium.files(&[holding, crate::shader!("fluids/density.wgsl")]);
    let (me, who) = (*medium, problem.clone());
    let twin = move |host: &Host| {
        let range = me.range();
        let weights = gathered(
            host,
            range,
            |body| !who.is_held(body.index),
            |_, you, r, sum: &mut f64| {
                *sum += you.mass * me.kernel(r);
            },
        )?;
        let view = crate::visit::View::of(host)?;
        let bodies = view.particles();
        let mut density = host.write(DENSITY)?;
        for (body, sum) in bodies.iter().zip(weights) {
            if let Some(sum) = sum {
                density[body.index] = sum + body.mass * me.kernel(DVec3::ZERO);
            }
        }
        Ok(())
    };
    let sweep = Sweep {
        name: "fluid density".to_owned(),
        grid: medium.grid(problem)?,
        candidate: Candidate::STILL,
        files,
        params: Vec::new(),
        constants: medium.constants(),
        twin: Arc::new(twin),
    };
    Ok(Kernel { tables, ..sweep.kernel(problem)? })
}
