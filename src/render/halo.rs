//! A halo around what is bright: the picture at a quarter of its size, blurred along rows and columns.

use glam::{DVec3, DVec4};
use rayon::prelude::*;

use super::frame::{Frame, HALO, SHRINK, SPREAD};
use super::look::{Look, expose};
use super::meter::Exposure;
use crate::error::Error;
use crate::kernel::{Host, Kernel, Threads};

/// The kernel: three dispatches.
pub fn kernel(frame: &Frame, exposure: Exposure) -> Result<Kernel, Error> {
    let (columns, rows) = frame.shrunk();
    let threads = Threads::new(columns * rows);
    let files = [crate::shader!("render/look.wgsl"), crate::shader!("render/shrink.wgsl")];
    let mut shrink = frame.pass(&files, threads, u64::from(4 * SHRINK * SHRINK))?;
    expose(&mut shrink, frame, exposure)?;
    let across = frame.pass(&[crate::shader!("render/blur.wgsl")], threads, 2 * u64::from(frame.reach) + 1)?;
    let mut down = across.clone();
    down.constants = vec![("DOWN", 1.0)];
    let frame = *frame;
    let reference = move |host: &Host| {
        let small = Look::at(host, &frame, exposure, |look| shrunk(&frame, look))?;
        let spread = blur(&small, frame.reach, columns as usize, 1, |at| at % columns as usize);
        let both = blur(&spread, frame.reach, rows as usize, columns as usize, |at| at / columns as usize);
        for (halo, light) in host.write(HALO)?.iter_mut().zip(both) {
            *halo = light.extend(0.0);
        }
        Ok(())
    };
    let kernel = frame.kernel("halo", vec![shrink, across, down], reference);
    Ok(Kernel { scratch: vec![SPREAD.name.into()], ..kernel })
}

fn shrunk(frame: &Frame, look: &Look) -> Vec<DVec3> {
    let (columns, rows) = frame.shrunk();
    let block = |i: u32| {
        let (left, top) = (i % columns * SHRINK, i / columns * SHRINK);
        let mut sum = DVec3::ZERO;
        for y in top..(top + SHRINK).min(frame.height) {
            for x in left..(left + SHRINK).min(frame.width) {
                sum += look.pixel(x, y, DVec3::ZERO);
            }
        }
        sum / f64::from(SHRINK * SHRINK)
    };
    (0..columns * rows).into_par_iter().map(block).collect()
}

/// Along a line of `len` that an element's neighbours are `stride` away in; `place` says where in its line it is.
fn blur(light: &[DVec3], reach: u32, len: usize, stride: usize, place: impl Fn(usize) -> usize + Sync) -> Vec<DVec3> {
    let weights: Vec<f64> =
        (0..=reach).map(|k| (1.0 - (f64::from(k) / f64::from(reach + 1)).powi(2)).powi(4)).collect();
    let total = 2.0 * weights.iter().sum::<f64>() - weights[0];
    let one = |at: usize| {
        let mut sum = weights[0] * light[at];
        for (k, weight) in weights.iter().enumerate().skip(1) {
            // Beyond the edge it is dark.
            if place(at) >= k {
                sum += *weight * light[at - k * stride];
            }
            if place(at) + k < len {
                sum += *weight * light[at + k * stride];
            }
        }
        sum / total
    };
    (0..light.len()).into_par_iter().map(one).collect()
}

/// Between four pixels of the halo.
pub fn between(frame: &Frame, halo: &[DVec4], x: u32, y: u32) -> DVec3 {
    let (columns, rows) = frame.shrunk();
    let q = super::frame::middle(x, y) / f64::from(SHRINK) - 0.5;
    let (low, part) = (q.floor(), q - q.floor());
    let near = |dx: f64, dy: f64| {
        let x = super::frame::whole((low.x + dx).clamp(0.0, f64::from(columns - 1)));
        let y = super::frame::whole((low.y + dy).clamp(0.0, f64::from(rows - 1)));
        halo[y as usize * columns as usize + x as usize].truncate()
    };
    near(0.0, 0.0).lerp(near(1.0, 0.0), part.x).lerp(near(0.0, 1.0).lerp(near(1.0, 1.0), part.x), part.y)
}
