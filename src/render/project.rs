//! Where each particle is seen, how far, and how large.

use glam::DVec4;
use rayon::prelude::*;

use super::frame::{Frame, MISSED, PROJECTED};
use crate::error::Error;
use crate::kernel::{Host, Kernel, POSITION, Threads, VELOCITY};

/// A particle that is not drawn.
const HIDDEN: DVec4 = DVec4::new(0.0, 0.0, 0.0, -1.0);
const LIGHTEST: f64 = 0.5;

/// The kernel.
pub fn kernel(frame: &Frame) -> Result<Kernel, Error> {
    let pass = frame.pass(&[crate::shader!("render/project.wgsl")], Threads::new(frame.count), 1)?;
    let frame = *frame;
    let reference = move |host: &Host| {
        let (position, velocity) = (host.read(POSITION)?, host.read(VELOCITY)?);
        let mut projected = host.write(PROJECTED)?;
        let mut missed = host.write(MISSED)?;
        projected.par_iter_mut().zip(&position[..]).zip(&velocity[..]).for_each(|((p, x), v)| {
            *p = if x.is_finite() && v.is_finite() { project(&frame, *x, *v) } else { HIDDEN };
        });
        for (p, (x, v)) in projected.iter().zip(position.iter().zip(velocity.iter())) {
            let broken = !(x.is_finite() && v.is_finite());
            if p.w < 0.0 {
                missed[usize::from(broken)] += 1;
            }
        }
        Ok(())
    };
    Ok(frame.kernel("project", vec![pass], reference))
}

fn project(frame: &Frame, x: DVec4, v: DVec4) -> DVec4 {
    let seen = frame.see(x.truncate());
    let part = if frame.heaviest > 0.0 { (x.w / frame.heaviest).clamp(0.0, 1.0).sqrt().sqrt().sqrt() } else { 1.0 };
    let size = (v.w.max(frame.water.drop) * seen.scale).max(frame.marker * part.max(LIGHTEST));
    let ball = size >= frame.solid;
    let radius = if ball { size.min(frame.largest) } else { 0.0 };
    let reach = if ball { radius + 0.5 } else { frame.glow };
    let (columns, rows) = frame.touched(seen.place - reach, seen.place + reach);
    if !seen.visible || columns.is_empty() || rows.is_empty() {
        return HIDDEN;
    }
    DVec4::new(seen.place.x, seen.place.y, seen.depth - radius / seen.scale, radius)
}
