//! Balls: the nearest in each pixel, and its particle.

use super::frame::{FRONT, Frame, OWNER, PROJECTED, key, middle};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Threads};

/// Turns of one invocation's loops in one layer, at most: half of the 65 535 that lavapipe allows.
const TURNS: u32 = 1 << 15;

/// The kernel: two dispatches.
pub fn kernel(frame: &Frame) -> Result<Kernel, Error> {
    let (threads, rows) = layers(frame);
    let mut passes = Vec::new();
    for file in [crate::shader!("render/cover.wgsl"), crate::shader!("render/claim.wgsl")] {
        let mut pass = frame.pass(&[crate::shader!("render/disc.wgsl"), file], threads, 64)?;
        pass.constants = vec![("ROWS", f64::from(rows))];
        passes.push(pass);
    }
    let frame = *frame;
    let reference = move |host: &Host| {
        let projected = host.read(PROJECTED)?;
        let (mut front, mut owner) = (host.write(FRONT)?, host.write(OWNER)?);
        for (id, p) in projected.iter().enumerate().filter(|(_, p)| p.w > 0.0) {
            let place = p.truncate().truncate();
            let (columns, rows) = frame.touched(place - p.w - 0.5, place + p.w + 0.5);
            for (x, y) in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
                let at = frame.pixel(x, y);
                // In the order of ids, the first of equals keeps the pixel.
                if middle(x, y).distance(place) < p.w + 0.5 && key(p.z) < front[at] {
                    front[at] = key(p.z);
                    owner[at] = u32::try_from(id).unwrap_or(u32::MAX);
                }
            }
        }
        Ok(())
    };
    Ok(frame.kernel("cover", passes, reference))
}

/// A dispatch over all discs, in layers of so many rows.
pub fn layers(frame: &Frame) -> (Threads, u32) {
    let across = super::frame::whole(2.0 * frame.largest) + 3;
    // A turn for each row, besides one for each pixel in it.
    let rows = (TURNS / (across + 1)).max(1);
    (Threads { count: frame.count, layers: across.div_ceil(rows) }, rows)
}
