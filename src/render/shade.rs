//! What stands in the picture: facets and solids, by the mean of a pixel's samples.

use glam::{DVec2, DVec3, DVec4};
use rayon::prelude::*;

use super::frame::{
    COLOR, FACET, FRONT, Frame, HOLDER, LIT, NEAR, NEVER, NONE, SCENERY, SOLID, VERTEX, key, middle, unpack,
};
use super::light::{Lamp, matte, strand};
use super::paint::rounded;
use super::raster::Facet;
use super::scenery::Facets;
use super::solid::{Body, Meeting, meet};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Threads};

const STONE: DVec3 = DVec3::new(0.58, 0.60, 0.64);
const FLOOR: DVec3 = DVec3::new(0.20, 0.21, 0.25);
const LINES: f64 = 0.09;
const LINE: f64 = 0.012;

/// The kernel.
pub fn kernel(frame: &Frame, facets: &Facets) -> Result<Kernel, Error> {
    let files = [
        crate::shader!("render/flat.wgsl"),
        crate::shader!("render/facet.wgsl"),
        crate::shader!("render/solid.wgsl"),
        crate::shader!("render/light.wgsl"),
        crate::shader!("render/shade.wgsl"),
    ];
    let each = u64::from(frame.fine * frame.fine) * u64::from(8 + 4 * frame.solids);
    let pass = frame.pass(&files, Threads::new(frame.area()), each)?;
    let on = *frame;
    let reference = move |host: &Host| {
        let (facet, vertex, color) = (host.read(FACET)?, host.read(VERTEX)?, host.read(COLOR)?);
        let (holder, lit, solid) = (host.read(HOLDER)?, host.read(LIT)?, host.read(SOLID)?);
        let bodies: Vec<Body> = Body::all(&solid).into_iter().take(on.solids as usize).collect();
        let lamp = Lamp { bodies: &bodies, lit: &lit, extent: on.lamp, map: on.map };
        let stage = Stage { frame: on, facet: &facet, vertex: &vertex, color: &color, lamp };
        let holder: &[u32] = &holder;
        let (mut scenery, mut front) = (host.write(SCENERY)?, host.write(FRONT)?);
        scenery.par_iter_mut().zip(front.par_iter_mut()).zip(0..on.area()).for_each(|((out, front), i)| {
            let (sum, depth) = stage.pixel(i % on.width, i / on.width, holder);
            let samples = f64::from(on.fine * on.fine);
            let cover = rounded(DVec3::splat(sum.w / samples)) & 0xff;
            *out = rounded(sum.truncate() / sum.w.max(1e-30)) & 0x00ff_ffff | cover << 24;
            if sum.w >= 0.5 * samples {
                *front = key(depth);
            }
        });
        Ok(())
    };
    Ok(facets.bind(frame.kernel("shade", vec![pass], reference), frame))
}

struct Stage<'a> {
    frame: Frame,
    facet: &'a [u32],
    vertex: &'a [DVec4],
    color: &'a [u32],
    lamp: Lamp<'a>,
}

impl Stage<'_> {
    /// The sum of a pixel's samples, and the nearest depth.
    fn pixel(&self, x: u32, y: u32, holder: &[u32]) -> (DVec4, f64) {
        let fine = self.frame.fine;
        let (mut sum, mut depth) = (DVec4::ZERO, NEVER);
        for (row, column) in (0..fine).flat_map(|row| (0..fine).map(move |column| (row, column))) {
            let (u, v) = (x * fine + column, y * fine + row);
            let place = middle(u, v) / f64::from(fine);
            let id = holder[v as usize * (self.frame.width * fine) as usize + u as usize];
            let jitter = place - place.floor() - 0.5;
            let (color, cover, far) = self.sample(place, id, jitter);
            sum += cover * color.extend(1.0);
            depth = depth.min(far);
        }
        (sum, depth)
    }
    /// Colour, cover and depth of a sample.
    fn sample(&self, place: DVec2, id: u32, jitter: DVec2) -> (DVec3, f64, f64) {
        let distance = self.frame.camera.distance;
        let off = (place - 0.5 * self.frame.size()) * DVec2::new(1.0, -1.0) / self.frame.scale();
        let (o, d, least) = if distance > 0.0 {
            (distance * DVec3::Z, (off / distance).extend(-1.0), NEAR * distance)
        } else {
            (off.extend(0.0), DVec3::NEG_Z, -NEVER)
        };
        let view = -d.normalize();
        let met = meet(self.lamp.bodies, o, d, least);
        if id != NONE {
            let f = Facet::of(self.facet, self.vertex, id as usize);
            let w = f.parts(self.frame.thread, place);
            let depth = f.depth(&self.frame, w);
            if depth < met.way {
                return (self.facet_looks(&f, w, o + depth * d, view, jitter), 1.0, depth);
            }
        }
        if met.way >= NEVER {
            return (DVec3::ZERO, 0.0, met.way);
        }
        let (color, cover) = self.solid_looks(&met, o + met.way * d, view, jitter);
        (color, cover, met.way)
    }
    fn facet_looks(&self, f: &Facet, w: DVec4, p: DVec3, view: DVec3, jitter: DVec2) -> DVec3 {
        let mixed = |of: &dyn Fn(usize) -> DVec3| (0..3).fold(DVec3::ZERO, |sum, k| sum + w[k] * of(f.ids[k]));
        let sum = mixed(&|id| self.vertex[2 * id + 1].truncate());
        let mean = sum / sum.length().max(1e-30);
        let tint = mixed(&|id| unpack(self.color[id]));
        if f.line {
            return strand(tint, mean, view, self.lamp.seen(p, super::light::LAMP, jitter));
        }
        let [a, b, c] = f.places();
        // Corners that go round against the clock are seen from the front; right and down is left-handed.
        let back = (b - a).perp_dot(c - a) > 0.0;
        let (normal, dyed) = if back { (-mean, 0.55 * tint + 0.06) } else { (mean, tint) };
        matte(dyed, normal, view, self.lamp.seen(p, normal, jitter))
    }
    fn solid_looks(&self, met: &Meeting, p: DVec3, view: DVec3, jitter: DVec2) -> (DVec3, f64) {
        let light = self.lamp.seen(p, met.normal, jitter);
        let body = &self.lamp.bodies[met.number as usize];
        if !body.is_plane() {
            return (matte(STONE, met.normal, view, light), 1.0);
        }
        let square = (body.unturned(p - body.place) / body.size.x + 0.5).truncate();
        let square = (square - square.floor() - 0.5).abs();
        let line = if square.min_element() < LINE { LINES } else { 0.0 };
        let cover = (1.6 - 0.6 * p.length() / self.frame.lamp).clamp(0.0, 1.0);
        (matte(FLOOR + line, met.normal, view, light), cover)
    }
}
