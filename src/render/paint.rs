//! Colours by speed.

use glam::DVec3;
use rayon::prelude::*;

use super::frame::{COLOR, Frame, whole};
use super::palette::pack;
use crate::error::Error;
use crate::kernel::{Host, Kernel, Threads, VELOCITY};

/// The kernel.
pub fn kernel(frame: &Frame) -> Result<Kernel, Error> {
    let pass = frame.pass(&[crate::shader!("render/paint.wgsl")], Threads::new(frame.count), 1)?;
    let (slow, fast) = frame.speeds;
    let reference = move |host: &Host| {
        let velocity = host.read(VELOCITY)?;
        host.write(COLOR)?.par_iter_mut().zip(&velocity[..]).for_each(|(color, v)| {
            let part = ((v.truncate().length() - slow) / (fast - slow)).clamp(0.0, 1.0);
            *color = rounded(map(part));
        });
        Ok(())
    };
    Ok(frame.kernel("paint", vec![pass], reference))
}

/// The nearest of all colours of three bytes.
pub(super) fn rounded(rgb: DVec3) -> u32 {
    let byte = |x: f64| u8::try_from(whole((x.clamp(0.0, 1.0) * 255.0 + 0.5).floor())).unwrap_or(u8::MAX);
    pack([byte(rgb.x), byte(rgb.y), byte(rgb.z)])
}

/// The slowest, three between, the fastest: lighter from each to the next but the last.
const MAP: [DVec3; 5] = [
    DVec3::new(0.26, 0.28, 0.84),
    DVec3::new(0.29, 0.54, 0.96),
    DVec3::new(0.52, 0.79, 0.94),
    DVec3::new(0.96, 0.90, 0.74),
    DVec3::new(1.0, 0.77, 0.38),
];

fn map(part: f64) -> DVec3 {
    let low = (4.0 * part).floor().min(3.0);
    let index = whole(low) as usize;
    MAP[index].lerp(MAP[index + 1], 4.0 * part - low)
}
