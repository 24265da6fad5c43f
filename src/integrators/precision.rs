//! The precision of positions and velocities: one number of single precision, or the sum of two.

use super::{INTEGRATORS, Integrator, Step};
use crate::error::Error;
use crate::kernel::{Kernel, LOW_WORDS, Machine, Plan, Precision, Problem};

/// A kernel that moves fixed and kinematic particles writes their velocities anew in each step; nothing accelerates them, so that
/// their low words stay zero.
const LEAD: &str = "lead";

/// Another integrator, which keeps positions and velocities in a precision.
#[derive(Clone)]
pub struct Precise {
    /// The method.
    pub integrator: Box<dyn Integrator>,
    /// The precision.
    pub precision: Precision,
}

impl Integrator for Precise {
    fn wrapped(&self) -> Option<&dyn Integrator> {
        Some(self.integrator.as_ref())
    }
    fn order(&self) -> u32 {
        self.integrator.order()
    }
    fn in_fixed_steps(&self) -> Box<dyn Integrator> {
        Box::new(Self { integrator: self.integrator.in_fixed_steps(), precision: self.precision })
    }
    fn precision(&self) -> Precision {
        self.precision
    }
    fn step(&self, s: &mut Step) {
        self.integrator.step(s);
    }
}

/// What a kernel writes in one word that has two: the name of the field.
fn rounded(kernel: &Kernel) -> Option<&'static str> {
    let leads = kernel.passes.iter().all(|pass| pass.shader.reflection().entry == LEAD);
    let written = kernel.writes();
    let one = LOW_WORDS.iter().find(|(high, low)| {
        written.iter().any(|name| *name == high.name) && written.iter().all(|name| *name != low.name)
    });
    one.filter(|_| !leads).map(|(high, _)| high.name)
}

/// Whether an integrator keeps both words in all of its kernels.
fn serves(integrator: &dyn Integrator, precision: Precision) -> bool {
    let problem = Problem::new(1, Machine::HOST).precise(precision);
    let mut step = Step::new(&[], problem);
    integrator.step(&mut step);
    step.finished().is_ok_and(|plan| plan.kernels.iter().all(|kernel| rounded(kernel).is_none()))
}

/// Refuses kernels that would round positions or velocities to one word where they have two.
///
/// # Errors
/// [`Error::Scene`] that names the integrator or the kernel.
pub fn check(integrator: &dyn Integrator, plans: [&Plan; 2]) -> Result<(), Error> {
    let precision = integrator.precision();
    if precision == Precision::Single {
        return Ok(());
    }
    let name = precision.name();
    if !serves(integrator, precision) {
        let all = INTEGRATORS.iter().filter(|entry| serves(entry.by_default().as_ref(), precision));
        let all: Vec<&str> = all.map(|entry| entry.name).collect();
        return Err(Error::Scene(format!(
            "precision = \"{name}\" is for integrators of kicks and drifts, and {} rounds positions or velocities to single precision: choose \
             {}, or precision = \"single\"",
            integrator.name(),
            all.join(", ")
        )));
    }
    let mut kernels = plans.into_iter().flat_map(|plan| &plan.kernels);
    match kernels.find_map(|kernel| Some((kernel, rounded(kernel)?))) {
        Some((kernel, field)) => Err(Error::Scene(format!(
            "precision = \"{name}\" keeps `{field}` as the sum of two numbers, and `{}` changes it in single precision: leave that out, or \
             choose precision = \"single\"",
            kernel.name
        ))),
        None => Ok(()),
    }
}
