//! Trails: lines from where each particle was to where it is.

use super::frame::{FRONT, Frame, STREAK, Seen, TRAIL, key, middle, whole};
use crate::error::Error;
use crate::kernel::{Host, Kernel, POSITION, Threads};

const OLDEST: f64 = 0.25;
const NEWEST: f64 = 0.95;

/// The kernel.
pub fn kernel(frame: &Frame) -> Result<Kernel, Error> {
    let mut pass = frame.pass(&[crate::shader!("render/streak.wgsl")], Threads::new(frame.points), 256)?;
    pass.threads.layers = frame.width.max(frame.height).div_ceil(pass.shader.reflection().constant("WALK"));
    let frame = *frame;
    let reference = move |host: &Host| {
        let (position, trail, front) = (host.read(POSITION)?, host.read(TRAIL)?, host.read(FRONT)?);
        let mut streak = host.write(STREAK)?;
        let count = frame.count as usize;
        let moments = f64::from(frame.points / frame.count.max(1));
        for (s, from) in trail.iter().enumerate() {
            let to = trail.get(s + count).unwrap_or(&position[s % count]);
            if !from.is_finite() || !to.is_finite() {
                continue;
            }
            let (a, b) = (frame.see(from.truncate()), frame.see(to.truncate()));
            let age = f64::from(u32::try_from(s / count).unwrap_or(0) + 1) / moments;
            if a.visible && b.visible {
                line(&frame, &front, &mut streak, &a, &b, |bright| {
                    let bright = bright * (OLDEST + (NEWEST - OLDEST) * age);
                    whole(bright * 65535.0) << 16 | u32::try_from(s % count).unwrap_or(0)
                });
            }
        }
        Ok(())
    };
    Ok(frame.kernel("streak", vec![pass], reference))
}

/// Every pixel that a line may touch. The device walks along the line instead, and finds the same pixels.
fn line(frame: &Frame, front: &[u32], streak: &mut [u32], a: &Seen, b: &Seen, mark: impl Fn(f64) -> u32) {
    let way = b.place - a.place;
    let (low, high) = (a.place.min(b.place), a.place.max(b.place));
    let reach = frame.line + 0.5;
    let (columns, rows) = frame.touched(low - reach, high + reach);
    for (x, y) in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
        let from = middle(x, y) - a.place;
        let t = (from.dot(way) / way.length_squared().max(1e-12)).clamp(0.0, 1.0);
        let bright = (reach - (from - t * way).length()).clamp(0.0, 1.0);
        let at = frame.pixel(x, y);
        if bright > 0.0 && key(a.depth + (b.depth - a.depth) * t) < front[at] {
            streak[at] = streak[at].max(mark(bright));
        }
    }
}
