//! Reflecting boundaries: x ← 2 b − x and v ← −v at a side b, repeated until the particle is inside.

use std::sync::Arc;

use crate::error::Error;
use crate::kernel::{Host, Kernel, POSITION, Problem, Shader, Side, VELOCITY};

/// The kernel.
pub fn kernel(problem: &Problem) -> Result<Kernel, Error> {
    let (holding, tables) = problem.holding();
    let shader = Shader::join(&[
        holding,
        problem.active(),
        crate::shader!("world.wgsl"),
        crate::shader!("broken.wgsl"),
        crate::shader!("boundary/reflecting.wgsl"),
    ])?;
    let all = problem.clone();
    let reference = move |host: &Host| {
        let bounds = host.world().bounds;
        let (mut position, mut velocity) = (host.write(POSITION)?, host.write(VELOCITY)?);
        let is_active = host.is_active()?;
        let free = position
            .iter_mut()
            .zip(velocity.iter_mut())
            .enumerate()
            .filter(|(id, _)| !all.is_held(*id) && is_active(*id));
        for (_, (x, v)) in free.filter(|(_, (x, _))| x.is_finite()) {
            for axis in (0..3).filter(|axis| bounds.sides[*axis] == Side::Reflecting) {
                let (place, thrown_back) = folded(x[axis], bounds.low[axis], bounds.high[axis]);
                x[axis] = place;
                if thrown_back {
                    v[axis] = -v[axis];
                }
            }
        }
        Ok(())
    };
    Ok(Kernel {
        tables,
        ..Kernel::new("reflecting", shader, Vec::new(), problem.capacity, Arc::new(reference)).alone()
    })
}

/// The path of a particle reflected between two sides, unfolded, is a straight line: the position of x on it, and whether the
/// particle is reflected there.
fn folded(x: f64, low: f64, high: f64) -> (f64, bool) {
    if (low..=high).contains(&x) {
        return (x, false);
    }
    let size = high - low;
    let way = (x - low).rem_euclid(2.0 * size);
    if way > size { ((high - (way - size)).max(low), true) } else { ((low + way).min(high), false) }
}
