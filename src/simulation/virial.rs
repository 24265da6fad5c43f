//! The virial of all forces of pairs, links and joints, computed on request.

use super::{Setup, Simulation};
use crate::component::pressure::{self, ROUNDING};
use crate::error::Error;
use crate::forces::Problem;
use crate::kernel::{Array, Backend, Machine, Plan};
use crate::visit::VIRIAL;

impl Setup {
    /// Whether its forces have a virial: see [`Simulation::virial`].
    ///
    /// # Errors
    /// [`Error::Scene`] with the force that has none.
    pub(crate) fn has_virial(&self) -> Result<(), Error> {
        self.virial(&self.problem(Machine::HOST)?).map(drop)
    }
    /// The plan that computes the virial after an evaluation.
    fn virial(&self, problem: &Problem) -> Result<Plan, Error> {
        Ok(Plan::of(pressure::virial(&self.forces, problem)?))
    }
}

impl<B: Backend> Simulation<B> {
    /// The virial −½ Σ r ⊗ F of all forces of pairs, links and joints at the end of the last step \[energy\]: xx, yy, zz, yz, xz, xy. The force of a pair is
    /// that of a law for one neighbour. It evaluates the forces once more, which does not change the run.
    ///
    /// # Errors
    /// [`Error::Scene`] where a force is none of pairs in range, links or joints, or those of pairs do not add up to the force on a particle; and those of
    /// [`Simulation::snapshot`].
    pub async fn virial(&mut self) -> Result<[f64; 6], Error> {
        // A list that grows and cells that are made anew replace the problem and the backend.
        self.settle().await?;
        let (values, alarm) = loop {
            let plan = self.setup.virial(&self.problem)?;
            let program = self.backend.compile(&plan)?;
            self.begin_measurement().await?;
            self.backend.run(&program, 1)?;
            let like = Array::Vec4(Vec::new());
            let values = self.backend.read(VIRIAL.name, &like, 2 * self.rows.used() as usize).await;
            if let Some(alarm) = self.end_measurement().await? {
                break (values, alarm);
            }
        };
        self.sound(&alarm)?;
        let Array::Vec4(values) = values? else { return Ok([0.0; 6]) };
        let mut sum = [0.0; 6];
        for (row, pair) in (0..).zip(values.chunks_exact(2)) {
            if !(pair[0].is_finite() && pair[1].is_finite()) {
                return Err(Error::Scene(format!(
                    "a force of a pair on particle {} is not finite, so that it has no virial: leave out what measures the pressure",
                    self.named(row)
                )));
            }
            let adds_up = pair[0].w <= ROUNDING * pair[1].w;
            if !adds_up {
                return Err(Error::Scene(format!(
                    "the forces of pairs on particle {} do not add up to its force, so that they have no virial: leave out what measures the \
                     pressure",
                    self.named(row)
                )));
            }
            let parts = [pair[0].truncate().to_array(), pair[1].truncate().to_array()].concat();
            sum.iter_mut().zip(parts).for_each(|(sum, part)| *sum += part);
        }
        Ok(sum)
    }
}
