//! What groups of targets meet on their walks through a tree: on average, and the one that meets the most.

use glam::Vec4;
use motes::kernel::{Backend, Plan, Problem};
use motes::tree::{Opening, Tree};
use motes::{ACCELERATION, Error, Gpu, Simulation};

use crate::met::met;

/// Far groups and particles that a target meets.
pub struct Effort {
    pub mean: f64,
    pub largest: f64,
}

impl Effort {
    /// How many times the average the target meets that meets the most: a dispatch waits for it.
    pub fn ratio(&self) -> f64 {
        self.largest / self.mean
    }
}

/// Walks a tree over particles where they are now, by their last accelerations. It leaves worthless numbers in place of
/// accelerations.
pub async fn effort(opening: Opening, problem: &Problem, simulation: &mut Simulation<Gpu>) -> Result<Effort, Error> {
    let law = met(opening, 0.0);
    let mut plan = Plan::default();
    Tree::new(opening, 0.0, problem).kernels(problem)?.into_iter().for_each(|kernel| plan.add(kernel));
    plan.add(law.kernel(problem)?);
    let before: Vec<Vec4> = simulation.read(ACCELERATION).await?;
    let backend = simulation.backend();
    let program = backend.compile(&plan)?;
    backend.run(&program, 1)?;
    let after: Vec<Vec4> = simulation.read(ACCELERATION).await?;
    let met = |(after, before): (&Vec4, &Vec4)| f64::from(after.x - before.x) + f64::from(after.y - before.y);
    let met: Vec<f64> = after.iter().zip(&before).map(met).collect();
    Ok(Effort { mean: met.iter().sum::<f64>() / met.len() as f64, largest: met.into_iter().fold(0.0, f64::max) })
}
