//! A step along the nodes of Radau's quadrature.

use super::Step;
use crate::error::Error;
use crate::integrators::verbs::radau;

/// Iterations of a step, at most; where rounding does not end them before that, the step is too long.
const MOST: u32 = 12;

impl Step<'_> {
    /// Accelerations along the step, by iterations that end where the last divided difference settles.
    pub fn along_nodes(&mut self) {
        if let Some(pair) = self.problem.columns.pairs().first() {
            let text = format!(
                "gauss_radau advances positions and velocities alone, and `{}` is advanced too: choose rk4 or leapfrog",
                pair.column.name
            );
            self.error.get_or_insert(Error::Scene(text));
            return;
        }
        self.add(radau::restart(&self.problem));
        self.add(radau::begin(&self.problem));
        self.moved = true;
        self.repeat(MOST, radau::ITERATION.name, "done", |step| {
            for (node, h) in radau::polynomial::NODE.into_iter().enumerate().skip(1) {
                step.at(h);
                step.evaluate();
                step.add(radau::node(node, &step.problem));
                step.moved = true;
            }
            step.add_all(radau::settle(&step.problem).map(Vec::from));
        });
    }
    /// The end of the step, if its error is accepted.
    pub fn accept(&mut self, tolerance: f64) {
        self.add(radau::decide(tolerance, &self.problem));
        self.add(radau::finish(&self.problem));
        self.arrive();
    }
}
