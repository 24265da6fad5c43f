//! Periodic sides: x ← x − L ⌊(x − low) / L⌋.

use std::sync::Arc;

use glam::DVec3;

use crate::error::Error;
use crate::kernel::{Bounds, Host, Kernel, POSITION, Shader, Side};

/// The kernel.
pub fn kernel(count: u32) -> Result<Kernel, Error> {
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("broken.wgsl"),
        crate::shader!("boundary/periodic.wgsl"),
    ])?;
    let reference = |host: &Host| {
        let bounds = host.world().bounds;
        for x in host.write(POSITION)?.iter_mut().filter(|x| x.is_finite()) {
            *x = wrapped(&bounds, x.truncate()).extend(x.w);
        }
        Ok(())
    };
    Ok(Kernel::new("periodic", shader, Vec::new(), count, Arc::new(reference)).alone())
}

/// The image that is in the box: low ≤ x < high along its periodic axes, also when the result is rounded to single
/// precision. What is NaN stays what it is.
#[must_use]
pub fn wrapped(bounds: &Bounds, mut x: DVec3) -> DVec3 {
    for axis in (0..3).filter(|axis| bounds.sides[*axis] == Side::Periodic) {
        x[axis] = image(x[axis], bounds.low[axis], bounds.high[axis]);
    }
    x
}

fn image(x: f64, low: f64, high: f64) -> f64 {
    #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
    let below = |x: f64| (x as f32) < high as f32;
    if !x.is_finite() || x >= low && below(x) {
        return x;
    }
    let image = low + (x - low).rem_euclid(high - low);
    if below(image) { image } else { low }
}
