//! A smooth surface of a fluid.

use glam::DVec4;
use rayon::prelude::*;

use super::frame::{DYE, Frame, LEVEL, NEVER, NEXT_DYE, NEXT_LEVEL, NEXT_THICKNESS, THICKNESS, whole};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Threads};

/// How often along rows and columns: the mean over a square by two of them is a cross where the range cuts it off.
const ROUNDS: usize = 3;

/// A surface, pixel by pixel.
struct Surface {
    level: Vec<f64>,
    thickness: Vec<f64>,
    dye: Vec<u32>,
}

/// The kernel: twice as many dispatches as rounds.
pub fn kernel(frame: &Frame) -> Result<Kernel, Error> {
    let files = [crate::shader!("render/settle.wgsl")];
    let each = 4 * u64::from(frame.water.farthest);
    let across = frame.pass(&files, Threads::new(frame.area()), each)?;
    let mut down = across.clone().on(&[
        ("level", NEXT_LEVEL.name.into()),
        ("thickness", NEXT_THICKNESS.name.into()),
        ("dye", NEXT_DYE.name.into()),
        ("next_level", LEVEL.name.into()),
        ("next_thickness", THICKNESS.name.into()),
        ("next_dye", DYE.name.into()),
    ]);
    down.constants = vec![("DOWN", 1.0)];
    let passes = (0..ROUNDS).flat_map(|_| [across.clone(), down.clone()]).collect();
    let frame = *frame;
    let reference = move |host: &Host| {
        let (mut level, mut thickness, mut dye) = (host.write(LEVEL)?, host.write(THICKNESS)?, host.write(DYE)?);
        let mut surface = Surface { level: level.to_vec(), thickness: thickness.to_vec(), dye: dye.to_vec() };
        for _ in 0..ROUNDS {
            for down in [false, true] {
                surface = surface.smooth(&frame, down);
            }
        }
        level.copy_from_slice(&surface.level);
        thickness.copy_from_slice(&surface.thickness);
        dye.copy_from_slice(&surface.dye);
        Ok(())
    };
    let kernel = frame.kernel("settle", passes, reference);
    let scratch = vec![NEXT_LEVEL.name.into(), NEXT_THICKNESS.name.into(), NEXT_DYE.name.into()];
    Ok(Kernel { scratch, ..kernel })
}

impl Surface {
    fn smooth(&self, frame: &Frame, down: bool) -> Self {
        let all: Vec<(f64, f64, u32)> =
            (0..self.level.len()).into_par_iter().map(|i| self.mean(frame, down, i)).collect();
        Self {
            level: all.iter().map(|one| one.0).collect(),
            thickness: all.iter().map(|one| one.1).collect(),
            dye: all.iter().map(|one| one.2).collect(),
        }
    }
    fn mean(&self, frame: &Frame, down: bool, i: usize) -> (f64, f64, u32) {
        let z = self.level[i];
        if z >= NEVER {
            return (z, self.thickness[i], self.dye[i]);
        }
        let columns = frame.width as usize;
        let (stride, at, len) =
            if down { (columns, i / columns, frame.height as usize) } else { (1, i % columns, columns) };
        let range = frame.water.range * frame.water.drop;
        let reach = whole((frame.water.calm * frame.water.drop * frame.scale_at(z)).max(0.0)) as usize;
        let reach = reach.min(frame.water.farthest as usize);
        let mut sum = (z, self.thickness[i], bytes(self.dye[i]));
        let mut weights = 1.0;
        for k in 1..=reach.min(at).min(len - 1 - at) {
            let (a, b) = (i - k * stride, i + k * stride);
            if self.level[a].max(self.level[b]) < z + range {
                let weight = (1.0 - (k as f64 / (reach + 1) as f64).powi(2)).powi(2);
                sum.0 += weight * (self.level[a].max(z - range) + self.level[b].max(z - range));
                sum.1 += weight * (self.thickness[a] + self.thickness[b]);
                sum.2 += weight * (bytes(self.dye[a]) + bytes(self.dye[b]));
                weights += 2.0 * weight;
            }
        }
        (sum.0 / weights, sum.1 / weights, packed(sum.2 / weights))
    }
}

fn bytes(word: u32) -> DVec4 {
    DVec4::from_array(word.to_le_bytes().map(f64::from))
}

fn packed(bytes: DVec4) -> u32 {
    u32::from_le_bytes(bytes.to_array().map(|x| u8::try_from(whole((x + 0.5).floor())).unwrap_or(u8::MAX)))
}
