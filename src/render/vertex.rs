//! The corners of facets: where they are seen, and which way the surface faces there.

use glam::{DVec3, DVec4, Vec4};
use rayon::prelude::*;

use super::frame::{AROUND, AROUND_START, FACET, Frame, NONE, TORN};
use super::scenery::Facets;
use crate::error::Error;
use crate::kernel::{Field, Host, Kernel, POSITION, Threads};

/// The kernel. The corners as a frame sees them go to a field.
pub fn kernel(name: &str, frame: &Frame, facets: &Facets, to: Field<Vec4>) -> Result<Kernel, Error> {
    let files = [crate::shader!("render/flat.wgsl"), crate::shader!("render/vertex.wgsl")];
    let pass = frame.pass(&files, Threads::new(frame.count), 8)?.on(&[("vertex", to.name.into())]);
    let frame_of = *frame;
    let reference = move |host: &Host| {
        let (position, facet, torn) = (host.read(POSITION)?, host.read(FACET)?, host.read(TORN)?);
        let (start, around) = (host.read(AROUND_START)?, host.read(AROUND)?);
        let (position, facet, torn): (&[DVec4], &[u32], &[u32]) = (&position, &facet, &torn);
        let (start, around): (&[u32], &[u32]) = (&start, &around);
        host.write(to)?.par_chunks_exact_mut(2).zip(0..position.len()).for_each(|(out, i)| {
            let seen = frame_of.see(position[i].truncate());
            let drawn = seen.visible && position[i].is_finite();
            let flat = frame_of.flat_depth(seen.depth);
            out[0] = if drawn { DVec4::new(seen.place.x, seen.place.y, flat, 1.0) } else { DVec4::ZERO };
            let mut sum = DVec3::ZERO;
            for t in &around[start[i] as usize..start[i + 1] as usize] {
                let part = part(position, &facet[3 * *t as usize..]);
                if torn[*t as usize] == 0 && part.abs().max_element() <= f64::from(f32::MAX) {
                    sum += part;
                }
            }
            let camera = &frame_of.camera;
            let turned = DVec3::new(sum.dot(camera.right), sum.dot(camera.up), sum.dot(camera.back));
            out[1] = (turned / turned.length().max(1e-30)).extend(0.0);
        });
        Ok(())
    };
    Ok(facets.bind(frame.kernel(name, vec![pass], reference), frame))
}

/// Twice the area of a triangle along its normal, or the way along a line.
fn part(position: &[DVec4], ids: &[u32]) -> DVec3 {
    let at = |k: usize| position[ids[k] as usize].truncate();
    let way = at(1) - at(0);
    if ids[2] == NONE { way } else { way.cross(at(2) - at(0)) }
}
