//! An empty canvas.

use super::frame::{BINS, CANVAS, FRONT, Frame, HISTOGRAM, MISSED, NONE, OWNER, STREAK};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Threads};

/// The kernel.
pub fn kernel(frame: &Frame) -> Result<Kernel, Error> {
    let threads = Threads::new(frame.area().max(256));
    let pass = frame.pass(&[crate::shader!("render/blank.wgsl")], threads, 1)?;
    debug_assert!(threads.count as usize >= BINS);
    let reference = |host: &Host| {
        for field in [CANVAS, STREAK, HISTOGRAM, MISSED] {
            host.write(field)?.fill(0);
        }
        host.write(FRONT)?.fill(NONE);
        host.write(OWNER)?.fill(NONE);
        Ok(())
    };
    Ok(frame.kernel("blank", vec![pass], reference))
}
