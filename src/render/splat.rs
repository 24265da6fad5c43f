//! Light of small particles on the canvas.

use super::frame::{CANVAS, COLOR, FRONT, Frame, PROJECTED, key, middle, unpack, whole};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Threads};

/// The kernel.
pub fn kernel(frame: &Frame) -> Result<Kernel, Error> {
    let across = u64::from(whole(2.0 * frame.glow)) + 2;
    let pass = frame.pass(&[crate::shader!("render/splat.wgsl")], Threads::new(frame.count), across * across)?;
    let frame = *frame;
    let reference = move |host: &Host| {
        let (projected, color, front) = (host.read(PROJECTED)?, host.read(COLOR)?, host.read(FRONT)?);
        let mut canvas = host.write(CANVAS)?;
        for (p, color) in projected.iter().zip(color.iter()).filter(|(p, _)| p.w == 0.0) {
            let (place, light) = (p.truncate().truncate(), frame.unit * unpack(*color));
            let (columns, rows) = frame.touched(place - frame.glow, place + frame.glow);
            for (x, y) in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
                let at = frame.pixel(x, y);
                let q = 1.0 - ((middle(x, y) - place) / frame.glow).length_squared();
                if q > 0.0 && key(p.z) < front[at] {
                    let add = light * (q * q * (0.25 + 0.75 * q.powi(4)));
                    for (sum, add) in canvas[3 * at..3 * at + 3].iter_mut().zip(add.to_array()) {
                        *sum += whole(add + 0.5);
                    }
                }
            }
        }
        Ok(())
    };
    Ok(frame.kernel("splat", vec![pass], reference))
}
