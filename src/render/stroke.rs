//! Strokes of light: where each particle has just been, in the light of where it is.

use super::frame::{CANVAS, COLOR, FRONT, Frame, Seen, key, middle, unpack, whole};
use crate::error::Error;
use crate::kernel::{Host, Kernel, POSITION, Threads, VELOCITY};

/// Turns of one invocation's loops in one layer, at most: half of the 65 535 that lavapipe allows.
const TURNS: u32 = 1 << 15;
/// Pixels across a diagonal, for each straight across.
const DIAGONAL: f64 = 1.4143;

const TAPER: f64 = 0.6;

/// The kernel.
pub fn kernel(frame: &Frame) -> Result<Kernel, Error> {
    let across = whole(2.0 * DIAGONAL * frame.glow) + 3;
    // A turn for each column, besides one for each pixel in it.
    let walk = (TURNS / (across + 1)).max(1);
    let threads = Threads { count: frame.count, layers: frame.width.max(frame.height).div_ceil(walk) };
    let mut pass = frame.pass(&[crate::shader!("render/stroke.wgsl")], threads, u64::from(across * across))?;
    pass.constants = vec![("WALK", f64::from(walk))];
    let frame = *frame;
    let reference = move |host: &Host| {
        let (position, velocity) = (host.read(POSITION)?, host.read(VELOCITY)?);
        let (color, front) = (host.read(COLOR)?, host.read(FRONT)?);
        let mut canvas = host.write(CANVAS)?;
        for ((x, v), color) in position.iter().zip(&velocity[..]).zip(&color[..]) {
            let head = frame.see(x.truncate());
            if !x.is_finite() || !v.is_finite() || !head.visible {
                continue;
            }
            let end = frame.see((*x - frame.tail * *v).truncate());
            let light = frame.unit * unpack(*color);
            stroke(&frame, &head, if end.visible { &end } else { &head }, |at, depth, bright| {
                if key(depth) < front[at] {
                    for (sum, add) in canvas[3 * at..3 * at + 3].iter_mut().zip((light * bright).to_array()) {
                        *sum += whole(add + 0.5);
                    }
                }
            });
        }
        Ok(())
    };
    Ok(frame.kernel("stroke", vec![pass], reference))
}

/// Every pixel that a stroke may touch, with its depth and brightness. The device walks along the stroke instead, and
/// finds the same pixels.
fn stroke(frame: &Frame, head: &Seen, end: &Seen, mut draw: impl FnMut(usize, f64, f64)) {
    let way = end.place - head.place;
    let (low, high) = (head.place.min(end.place), head.place.max(end.place));
    let (columns, rows) = frame.touched(low - frame.glow, high + frame.glow);
    for (x, y) in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
        let off = middle(x, y) - head.place;
        let s = (off.dot(way) / way.length_squared().max(1e-12)).clamp(0.0, 1.0);
        let q = 1.0 - ((off - s * way) / (frame.glow * (1.0 - TAPER * s))).length_squared();
        if q > 0.0 {
            let bright = (1.0 - s) * q * q * (0.25 + 0.75 * q.powi(4));
            draw(frame.pixel(x, y), head.depth + (end.depth - head.depth) * s, bright);
        }
    }
}
