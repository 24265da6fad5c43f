//! How heavy the particles of walls are.

use std::sync::Arc;

use glam::DVec3;

use super::Medium;
use crate::error::Error;
use crate::kernel::{Host, Kernel, POSITION, Problem, Scalar};
use crate::visit::{Candidate, Sweep, gathered};

/// What the particles of walls weigh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WallMass {
    /// The fluid whose place they take, where they are a layer (Akinci et al. 2012): ρ₀ / Σ W, over the walls.
    Sampled,
    /// A share of the lattice each, ρ₀ d^D, where they are several layers of it (Adami, Hu & Adams 2012).
    Lattice,
}

/// The kernel that gives whoever is held its mass.
///
/// # Errors
/// When the range is none, or a shader does not compile.
pub fn walls(medium: &Medium, weighs: WallMass, problem: &Problem) -> Result<Kernel, Error> {
    let (holding, tables) = problem.holding();
    let files = medium.files(&[holding, crate::shader!("fluids/walls.wgsl")]);
    let (me, who) = (*medium, problem.clone());
    let twin = move |host: &Host| {
        let range = me.range();
        let held = |i: usize| who.is_held(i);
        let numbers = gathered(
            host,
            range,
            |body| held(body.index),
            |_, you, r, sum: &mut f64| {
                *sum += if held(you.index) { me.kernel(r) } else { 0.0 };
            },
        )?;
        let mut position = host.write(POSITION)?;
        for (i, sum) in numbers.into_iter().enumerate() {
            if let Some(sum) = sum {
                let sampled = me.density / (sum + me.kernel(DVec3::ZERO));
                position[i].w = if weighs == WallMass::Sampled { sampled } else { me.mass() };
            }
        }
        Ok(())
    };
    // 0 where the sum says it.
    let mass = if weighs == WallMass::Sampled { 0.0 } else { medium.mass() };
    let sweep = Sweep {
        name: "fluid walls".to_owned(),
        grid: medium.grid(problem)?,
        candidate: Candidate::STILL,
        files,
        params: vec![("mass", Scalar::Float(mass))],
        constants: medium.constants(),
        twin: Arc::new(twin),
    };
    let mut kernel = sweep.kernel_of_all(problem)?;
    kernel.passes.iter_mut().for_each(|pass| pass.fields.push(("weighed", POSITION.name.into())));
    Ok(Kernel { tables, ..kernel })
}
