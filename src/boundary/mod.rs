//! The sides of the box: what brings particles back, and which boxes there can be.

mod check;
mod periodic;
mod reflecting;

pub use check::{check, holds};
pub use periodic::wrapped;

use crate::error::Error;
use crate::kernel::{Bounds, Kernel, Side};

/// What runs where positions have been advanced; nothing in open space.
///
/// # Errors
/// When a shader does not compile.
pub fn kernels(count: u32, bounds: &Bounds) -> Result<Vec<Kernel>, Error> {
    let mut kernels = Vec::new();
    if bounds.has(Side::Periodic) {
        kernels.push(periodic::kernel(count)?);
    }
    if bounds.has(Side::Reflecting) {
        kernels.push(reflecting::kernel(count)?);
    }
    Ok(kernels)
}
