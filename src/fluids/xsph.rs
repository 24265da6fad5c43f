//! XSPH: velocities drawn towards those around.

use std::sync::Arc;

use glam::DVec3;

use super::Medium;
use super::medium::FLOWING;
use super::pressure::{flowing, states};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Host, Kernel, Problem, Scalar};
use crate::visit::{Sweep, gathered};

/// The kernel that adds  ε / dt Σ m / ρ̄ (v' − v) W  to accelerations (Monaghan 1989; Schechter & Bridson 2012).
///
/// # Errors
/// When the range is none, or a shader does not compile.
pub fn xsph(medium: &Medium, strength: f64, problem: &Problem) -> Result<Kernel, Error> {
    let grid = medium.grid(problem)?;
    let files = medium.files(&[crate::shader!("fluids/xsph.wgsl")]);
    let (me, slots) = (*medium, grid.clone());
    let twin = move |host: &Host| {
        let states = states(host, &slots)?;
        let flows = |id: usize| states[id].x > 0.0;
        let drawn = gathered(
            host,
            me.range(),
            |body| flows(body.index),
            |a, b, r, sum: &mut DVec3| {
                if flows(b.index) {
                    let density = 0.5 * (states[a.index].x + states[b.index].x);
                    *sum += b.mass / density * me.kernel(r) * (b.velocity - a.velocity);
                }
            },
        )?;
        let mut acceleration = host.write(ACCELERATION)?;
        let rate = strength / host.world().dt;
        acceleration.iter_mut().zip(drawn).for_each(|(a, drawn)| *a += (rate * drawn.unwrap_or_default()).extend(0.0));
        Ok(())
    };
    let (params, constants) = (vec![("xsph", Scalar::Float(strength))], medium.constants());
    flowing(
        Sweep {
            name: "fluid xsph".to_owned(),
            candidate: FLOWING,
            files,
            params,
            constants,
            twin: Arc::new(twin),
            grid,
        },
        &[],
        problem,
    )
}
