//! From light to pixels.

use super::super::Exposure;
use super::super::frame::{BLURRED, Frame, SHRINK, WET};
use super::expose;
use crate::error::Error;
use crate::kernel::{Kernel, Plan, Threads};

/// The bloom around what is bright, and the tones of all.
pub fn tones(frame: &Frame, exposure: Exposure, plan: &mut Plan) -> Result<(), Error> {
    // Without light there is none to spread: what a device has not written is zero.
    if frame.bloom > 0.0 {
        plan.add(bloom(frame, exposure)?);
    }
    let files =
        [crate::shader!("render/shading.wgsl"), crate::shader!("render/sky.wgsl"), crate::shader!("render/tone.wgsl")];
    let mut pass = frame.pass(&files, Threads::new(frame.area()), 8)?;
    expose(&mut pass, frame, exposure)?;
    if frame.water.is_there() {
        pass = pass.on(&[("scenery", WET.name.into())]);
    }
    plan.add(frame.kernel("tone", vec![pass]));
    Ok(())
}

/// The picture at a quarter of its size, blurred along rows and columns: three dispatches.
fn bloom(frame: &Frame, exposure: Exposure) -> Result<Kernel, Error> {
    let (columns, rows) = frame.shrunk();
    let threads = Threads::new(columns * rows);
    let files = [crate::shader!("render/shading.wgsl"), crate::shader!("render/bloom_shrink.wgsl")];
    let mut shrink = frame.pass(&files, threads, u64::from(4 * SHRINK * SHRINK))?;
    expose(&mut shrink, frame, exposure)?;
    let across = frame.pass(&[crate::shader!("render/bloom_blur.wgsl")], threads, 2 * u64::from(frame.reach) + 1)?;
    let mut down = across.clone();
    down.constants = vec![("DOWN", 1.0)];
    let kernel = frame.kernel("bloom", vec![shrink, across, down]);
    Ok(Kernel { scratch: vec![BLURRED.name.into()], ..kernel })
}
