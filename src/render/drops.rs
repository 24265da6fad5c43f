//! A fluid as drops: the nearest front in each pixel, how much there is behind it, and its particle.

use glam::{DVec2, DVec4};

use super::cover;
use super::frame::{
    COLOR, CREST, DYE, FRONT, Frame, LEVEL, NEVER, NONE, PROJECTED, RIM, SOURCE, THICKNESS, VOLUME, key, middle, whole,
};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Threads};
use crate::primitives::fill;

/// Depths that so few of the numbers between them part are one.
const SAME: u32 = 64;

/// The kernel: four fields are emptied, and two dispatches over all drops.
pub fn kernel(frame: &Frame) -> Result<Kernel, Error> {
    let mut passes = Vec::new();
    for (field, value) in [(CREST, NONE), (VOLUME, 0), (RIM, 0), (SOURCE, NONE)] {
        passes.extend(fill::passes(&field.name.into(), frame.area(), value)?);
    }
    let (threads, rows) = cover::layers(frame);
    for file in [crate::shader!("render/drops.wgsl"), crate::shader!("render/source.wgsl")] {
        let files = [crate::shader!("render/disc.wgsl"), crate::shader!("render/drop.wgsl"), file];
        let mut pass = frame.pass(&files, threads, 64)?;
        pass.constants = vec![("ROWS", f64::from(rows))];
        passes.push(pass);
    }
    let frame = *frame;
    let reference = move |host: &Host| {
        let (projected, front) = (host.read(PROJECTED)?, host.read(FRONT)?);
        let (mut crest, mut volume) = (host.write(CREST)?, host.write(VOLUME)?);
        let (mut rim, mut source) = (host.write(RIM)?, host.write(SOURCE)?);
        crest.fill(NONE);
        source.fill(NONE);
        volume.fill(0);
        rim.fill(0);
        for p in projected.iter().filter(|p| p.w > 0.0) {
            touched(&frame, *p, |at, pixel| {
                let (half, depth) = front_at(&frame, *p, pixel);
                if depth >= front[at] {
                    return;
                }
                crest[at] = crest[at].min(depth);
                volume[at] += whole(frame.water.grain * half + 0.5);
                let cover = (p.w + 0.5 - pixel.distance(p.truncate().truncate())).clamp(0.0, 1.0);
                rim[at] = rim[at].max(whole(255.0 * cover + 0.5));
            });
        }
        for (id, p) in (0..).zip(projected.iter()).filter(|(_, p)| p.w > 0.0) {
            touched(&frame, *p, |at, pixel| {
                // In the order of ids, the first of equals keeps the pixel.
                if source[at] == NONE && front_at(&frame, *p, pixel).1 <= crest[at].wrapping_add(SAME) {
                    source[at] = id;
                }
            });
        }
        Ok(())
    };
    Ok(frame.kernel("drops", passes, reference))
}

/// The pixels that a drop touches.
fn touched(frame: &Frame, p: DVec4, mut each: impl FnMut(usize, DVec2)) {
    let place = p.truncate().truncate();
    let (columns, rows) = frame.touched(place - p.w - 0.5, place + p.w + 0.5);
    for (x, y) in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
        if middle(x, y).distance(place) < p.w + 0.5 {
            each(frame.pixel(x, y), middle(x, y));
        }
    }
}

/// Half of what of it is behind a pixel, as a part of its radius, and the depth of its front there.
fn front_at(frame: &Frame, p: DVec4, pixel: DVec2) -> (f64, u32) {
    let half = (1.0 - ((pixel - p.truncate().truncate()) / p.w).length_squared()).max(0.0).sqrt();
    let parallel = frame.camera.distance == 0.0;
    let scale = if parallel { frame.scale() } else { (frame.scale() * frame.camera.distance - p.w) / p.z };
    (half, key(p.z + frame.water.oblate * p.w * (1.0 - half) / scale))
}

/// The surface before it is smooth.
pub fn level(frame: &Frame) -> Result<Kernel, Error> {
    let pass = frame.pass(&[crate::shader!("render/level.wgsl")], Threads::new(frame.area()), 1)?;
    let frame = *frame;
    let reference = move |host: &Host| {
        let (crest, volume) = (host.read(CREST)?, host.read(VOLUME)?);
        let (source, color) = (host.read(SOURCE)?, host.read(COLOR)?);
        let (mut level, mut thickness, mut dye) = (host.write(LEVEL)?, host.write(THICKNESS)?, host.write(DYE)?);
        for i in 0..crest.len() {
            let wet = crest[i] != NONE;
            level[i] = if wet { unkey(crest[i]) } else { NEVER };
            thickness[i] = if wet { frame.water.layer * f64::from(volume[i]) } else { 0.0 };
            dye[i] = if wet { color[source[i] as usize] } else { 0 };
        }
        Ok(())
    };
    Ok(frame.kernel("level", vec![pass], reference))
}

/// The depth of a key.
fn unkey(k: u32) -> f64 {
    f64::from(f32::from_bits(if k >> 31 == 1 { k & 0x7fff_ffff } else { !k }))
}
