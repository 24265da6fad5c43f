//! Particles: where they are seen, their colours, balls, lights and trails.

use glam::{DVec2, DVec3, DVec4};
use rayon::prelude::*;

use super::super::Color;
use super::super::frame::{Seen, rounded, unpack};
use super::super::heading::tint;
use super::super::palette::value_color;
use super::{Canvas, Disc};

/// The lightest is drawn so large, beside the heaviest.
const LIGHTEST: f64 = 0.5;
const OLDEST: f64 = 0.25;
const NEWEST: f64 = 0.95;
/// How much narrower a stroke is at its far end.
const TAPER: f64 = 0.6;

impl Canvas<'_> {
    /// Where particles are seen. Counts those out of the picture, and those of which a number is none.
    pub(super) fn project(&mut self) -> [u32; 2] {
        let one = |(x, v): (&DVec4, &DVec4)| (x.is_finite() && v.is_finite()).then(|| self.disc(*x, *v));
        let discs: Vec<Option<Option<Disc>>> = self.position.par_iter().zip(&self.velocity[..]).map(one).collect();
        let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        let broken = count(discs.iter().filter(|disc| disc.is_none()).count());
        self.hidden = vec![false; discs.len()];
        self.discs = discs.into_iter().map(Option::flatten).collect();
        [count(self.discs.iter().filter(|disc| disc.is_none()).count()) - broken, broken]
    }
    fn disc(&self, x: DVec4, v: DVec4) -> Option<Disc> {
        let frame = &self.frame;
        let seen = frame.see(x.truncate());
        let part = if frame.heaviest > 0.0 { (x.w / frame.heaviest).clamp(0.0, 1.0).powf(0.125) } else { 1.0 };
        let size = (v.w.max(frame.water.drop) * frame.magnified * seen.scale).max(frame.marker * part.max(LIGHTEST));
        let is_ball = size >= frame.solid;
        let radius = if is_ball { size.min(frame.largest) } else { 0.0 };
        let reach = if is_ball { radius + 0.5 } else { frame.glow };
        let (columns, rows) = frame.touched(seen.place - reach, seen.place + reach);
        let is_seen = seen.visible && !columns.is_empty() && !rows.is_empty();
        is_seen.then(|| Disc { place: seen.place, depth: seen.depth - radius / seen.scale, radius })
    }
    /// The colour of every particle.
    pub(super) fn set_colors(&mut self) {
        let (slow, fast) = self.frame.speeds;
        self.color = match &self.picture.color {
            Color::Given(words) => words.iter().map(|word| unpack(*word)).collect(),
            Color::Speed { .. } => {
                let part = |v: &DVec4| ((v.truncate().length() - slow) / (fast - slow)).clamp(0.0, 1.0);
                self.velocity.par_iter().map(|v| rounded(value_color(part(v)))).collect()
            }
            Color::Value(scaled) => self.values.iter().map(|value| rounded(scaled.color(*value))).collect(),
            Color::Column(_) => Vec::new(),
            Color::Heading => self.velocity.par_iter().map(|v| rounded(tint(*v))).collect(),
        };
        self.color.resize(self.position.len(), DVec3::ZERO);
    }
    /// Balls, lights and trails.
    pub fn draw_lights(&mut self) {
        self.balls();
        if self.frame.tail > 0.0 {
            self.strokes();
        } else {
            self.splat();
        }
        self.trails();
    }
    fn balls(&mut self) {
        for id in 0..self.discs.len() {
            let Some(disc) = self.discs[id].filter(|disc| disc.radius > 0.0) else { continue };
            let reach = disc.radius + 0.5;
            for (at, pixel) in self.pixels(disc.place - reach, disc.place + reach) {
                if pixel.distance(disc.place) < reach && disc.depth < self.front[at] {
                    self.front[at] = disc.depth;
                    self.ball[at] = Some(id);
                }
            }
        }
    }
    fn splat(&mut self) {
        for id in 0..self.discs.len() {
            let Some(disc) = self.discs[id].filter(|disc| disc.radius == 0.0) else { continue };
            for (at, q) in self.about(disc.place) {
                if disc.depth < self.front[at] {
                    self.light[at] += self.frame.unit * profile(q) * self.color[id];
                }
            }
        }
    }
    fn strokes(&mut self) {
        let frame = self.frame;
        for id in 0..self.position.len() {
            let (x, v) = (self.position[id], self.velocity[id]);
            let head = frame.see(x.truncate());
            if !x.is_finite() || !v.is_finite() || !head.visible || self.hidden[id] {
                continue;
            }
            let end = frame.see((x - frame.tail * v).truncate());
            let end = if end.visible { end } else { frame.see(x.truncate()) };
            let reach = DVec2::splat(frame.glow);
            for (at, pixel) in self.pixels(head.place.min(end.place) - reach, head.place.max(end.place) + reach) {
                let (s, off) = nearest(&head, &end, pixel);
                let q = 1.0 - (off / (frame.glow * (1.0 - TAPER * s))).powi(2);
                if q > 0.0 && head.depth + (end.depth - head.depth) * s < self.front[at] {
                    self.light[at] += frame.unit * (1.0 - s) * profile(q) * self.color[id];
                }
            }
        }
    }
    fn trails(&mut self) {
        let (frame, count) = (self.frame, self.position.len());
        if frame.points == 0 {
            return;
        }
        let points: Vec<DVec3> = self.picture.trail.points().collect();
        let moments = (points.len() / count.max(1)) as f64;
        for (s, from) in points.iter().enumerate() {
            let to = points.get(s + count).copied().unwrap_or(self.position[s % count].truncate());
            let (a, b) = (frame.see(*from), frame.see(to));
            if !from.is_finite() || !to.is_finite() || !a.visible || !b.visible {
                continue;
            }
            let age = OLDEST + (NEWEST - OLDEST) * ((s / count + 1) as f64 / moments);
            let reach = DVec2::splat(frame.line + 0.5);
            for (at, pixel) in self.pixels(a.place.min(b.place) - reach, a.place.max(b.place) + reach) {
                let (t, off) = nearest(&a, &b, pixel);
                let bright = age * (frame.line + 0.5 - off).clamp(0.0, 1.0);
                // Of equally bright ones the last particle's: so it is on a device.
                if (bright, s % count) > self.trail[at]
                    && bright > 0.0
                    && a.depth + (b.depth - a.depth) * t < self.front[at]
                {
                    self.trail[at] = (bright, s % count);
                }
            }
        }
    }
}

/// The light of a particle, by how near a pixel is to its middle: a core in a wider glow.
fn profile(q: f64) -> f64 {
    q * q * (0.25 + 0.75 * q.powi(4))
}

/// The place on a line that is nearest to a pixel, as a part of it, and how far it is \[pixels\].
fn nearest(a: &Seen, b: &Seen, pixel: DVec2) -> (f64, f64) {
    let (way, off) = (b.place - a.place, pixel - a.place);
    let part = (off.dot(way) / way.length_squared().max(1e-12)).clamp(0.0, 1.0);
    (part, (off - part * way).length())
}
