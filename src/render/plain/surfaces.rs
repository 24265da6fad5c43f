//! Cloth, lines and solids, by the mean of a pixel's samples.

use glam::{DVec2, DVec3, DVec4};
use rayon::prelude::*;

use super::super::frame::{Frame, NEAR, NEVER, NONE, middle, rounded};
use super::super::light::{LAMP, from_lamp};
use super::super::solid::{Shape, square_of};
use super::Canvas;
use super::light::{Lamp, Meeting, matte, meet, square, strand};
use super::raster::{Raster, mean};

const STONE: DVec3 = DVec3::new(0.58, 0.60, 0.64);
const FLOOR: DVec3 = DVec3::new(0.20, 0.21, 0.25);
/// How much lighter the lines of a floor are, and half their width as a part of a square.
const LINES: f64 = 0.09;
const LINE: f64 = 0.012;

/// What is seen at a sample.
struct Sample {
    color: DVec3,
    cover: f64,
    depth: f64,
}

struct Stage<'a> {
    frame: &'a Frame,
    raster: &'a Raster<'a>,
    color: &'a [DVec3],
    lamp: Lamp<'a>,
}

impl Canvas<'_> {
    /// Draws surfaces, lines and solids, and hides the particles that those stand for.
    pub(super) fn stand(&mut self) {
        let facets = self.picture.facets();
        for id in facets.hidden() {
            self.walls.extend(self.discs[id].filter(|disc| disc.radius > 0.0));
            self.hide(id);
        }
        if facets.is_empty() {
            return;
        }
        let frame = self.frame;
        let broken: Vec<bool> = (0..facets.count as usize).map(|i| facets.is_broken(i, self.link.as_deref())).collect();
        let raster = Raster::new(&frame, facets, &broken, &self.position);
        let shadows = Raster::new(&from_lamp(&frame), facets, &broken, &self.position);
        let solids: Vec<_> = facets.standing().iter().map(|solid| solid.seen_by(&frame.camera)).collect();
        let lamp = Lamp { solids: &solids, map: &shadows.nearest, frame: &frame };
        let stage = Stage { frame: &frame, raster: &raster, color: &self.color, lamp };
        let samples = f64::from(frame.fine * frame.fine);
        self.behind.par_iter_mut().zip(&mut self.front).zip(0..frame.area()).for_each(|((behind, front), i)| {
            let (sum, depth) = stage.pixel(i % frame.width, i / frame.width);
            *behind = rounded(sum.truncate() / sum.w.max(1e-30)).extend(sum.w / samples);
            // What covers half of a pixel hides what is behind it.
            if sum.w >= 0.5 * samples {
                *front = depth;
            }
        });
    }
}

impl Stage<'_> {
    /// The sum of a pixel's samples, and the nearest depth.
    fn pixel(&self, x: u32, y: u32) -> (DVec4, f64) {
        let fine = self.frame.fine;
        let (mut sum, mut nearest) = (DVec4::ZERO, NEVER);
        for (row, column) in (0..fine).flat_map(|row| (0..fine).map(move |column| (row, column))) {
            let (u, v) = (x * fine + column, y * fine + row);
            let facet = self.raster.holder[(v * self.frame.width * fine + u) as usize];
            if let Some(Sample { color, cover, depth }) = self.sample(middle(u, v) / f64::from(fine), facet) {
                sum += cover * color.extend(1.0);
                nearest = nearest.min(depth);
            }
        }
        (sum, nearest)
    }
    fn sample(&self, place: DVec2, facet: u32) -> Option<Sample> {
        let distance = self.frame.camera.distance;
        let off = (place - 0.5 * self.frame.size()) * DVec2::new(1.0, -1.0) / self.frame.scale();
        let (o, d, least) = if distance > 0.0 {
            (distance * DVec3::Z, (off / distance).extend(-1.0), NEAR * distance)
        } else {
            (off.extend(0.0), DVec3::NEG_Z, -NEVER)
        };
        let (view, jitter) = (-d.normalize(), place - place.floor() - 0.5);
        let met = meet(self.lamp.solids, o, d, least, true);
        if facet != NONE {
            let parts = self.raster.facet(facet).within(self.frame, place);
            let depth = self.raster.facet(facet).depth(self.frame, parts);
            if met.is_none_or(|met| depth < met.way) {
                let color = self.facet(facet, parts, o + depth * d, view, jitter);
                return Some(Sample { color, cover: 1.0, depth });
            }
        }
        met.map(|met| self.solid(&met, o + met.way * d, view, jitter))
    }
    fn facet(&self, facet: u32, parts: DVec3, p: DVec3, view: DVec3, jitter: DVec2) -> DVec3 {
        let facet = self.raster.facet(facet);
        let tint = mean(parts, |k| self.color[facet.ids[k]]);
        let normal = facet.normal(parts);
        if facet.is_line {
            return strand(tint, normal, view, self.lamp.seen(p, LAMP, jitter));
        }
        let (normal, dyed) = if facet.is_front() { (normal, tint) } else { (-normal, 0.55 * tint + 0.06) };
        matte(dyed, normal, view, self.lamp.seen(p, normal, jitter))
    }
    fn solid(&self, met: &Meeting, p: DVec3, view: DVec3, jitter: DVec2) -> Sample {
        let light = self.lamp.seen(p, met.normal, jitter);
        if met.solid.shape != Shape::Plane {
            return Sample { color: matte(STONE, met.normal, view, light), cover: 1.0, depth: met.way };
        }
        let place = square(met.solid, p, square_of(self.frame.camera.extent)) + 0.5;
        let off = (place - place.floor() - 0.5).abs();
        let line = if off.min_element() < LINE { LINES } else { 0.0 };
        // Far away it is lost in the dark.
        let cover = (1.6 - 0.6 * p.length() / self.frame.lamp).clamp(0.0, 1.0);
        Sample { color: matte(FLOOR + line, met.normal, view, light), cover, depth: met.way }
    }
}
