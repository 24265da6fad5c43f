//! Foam, by speed.

use rayon::prelude::*;

use super::frame::{COLOR, Frame, whole};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Threads, VELOCITY};

/// The kernel.
pub fn kernel(frame: &Frame) -> Result<Kernel, Error> {
    let pass = frame.pass(&[crate::shader!("render/foam.wgsl")], Threads::new(frame.count), 1)?;
    let full = frame.water.foam;
    let reference = move |host: &Host| {
        let velocity = host.read(VELOCITY)?;
        host.write(COLOR)?.par_iter_mut().zip(&velocity[..]).for_each(|(color, v)| {
            let speed = v.truncate().length();
            let white = if v.is_finite() { (2.5 * speed / full - 1.5).clamp(0.0, 1.0) } else { 0.0 };
            *color = *color & 0x00ff_ffff | whole(255.0 * white + 0.5) << 24;
        });
        Ok(())
    };
    Ok(frame.kernel("foam", vec![pass], reference))
}
