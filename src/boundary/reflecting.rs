//! Reflecting sides: x ← 2 b − x and v ← −v at a side b, as often as it takes.

use std::sync::Arc;

use crate::error::Error;
use crate::kernel::{Host, Kernel, POSITION, Shader, Side, VELOCITY};

/// The kernel.
pub fn kernel(count: u32) -> Result<Kernel, Error> {
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("broken.wgsl"),
        crate::shader!("boundary/reflecting.wgsl"),
    ])?;
    let twin = |host: &Host| {
        let bounds = host.world().bounds;
        let (mut position, mut velocity) = (host.write(POSITION)?, host.write(VELOCITY)?);
        for (x, v) in position.iter_mut().zip(velocity.iter_mut()).filter(|(x, _)| x.is_finite()) {
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
    Ok(Kernel::new("reflecting", shader, Vec::new(), count, Arc::new(twin)))
}

/// The way of a particle to and fro between two sides, unrolled, is a straight line: where on it x is, and whether the
/// particle is on its way back there.
fn folded(x: f64, low: f64, high: f64) -> (f64, bool) {
    if (low..=high).contains(&x) {
        return (x, false);
    }
    let size = high - low;
    let way = (x - low).rem_euclid(2.0 * size);
    if way > size { ((high - (way - size)).max(low), true) } else { ((low + way).min(high), false) }
}
