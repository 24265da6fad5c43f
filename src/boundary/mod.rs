//! Boundaries of the box: periodic and reflecting sides, and the validation of boxes.

mod check;
mod periodic;
mod reflecting;

pub use check::{check, holds};
pub use periodic::wrapped;

use crate::error::Error;
use crate::kernel::{Kernel, Problem, Side};

/// The kernels that run after positions have been advanced; none in open space. Reflecting sides do not reflect fixed particles.
///
/// # Errors
/// When a shader does not compile.
pub fn kernels(problem: &Problem) -> Result<Vec<Kernel>, Error> {
    let mut kernels = Vec::new();
    if problem.bounds.has(Side::Periodic) {
        kernels.push(periodic::kernel(problem.capacity)?);
    }
    if problem.bounds.has(Side::Reflecting) {
        kernels.push(reflecting::kernel(problem)?);
    }
    Ok(kernels)
}
