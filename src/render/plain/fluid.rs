//! A fluid: the surface of its drops, made smooth, and light on it.

use glam::{DVec2, DVec3, DVec4};
use rayon::prelude::*;

use super::super::fluid::ROUNDS;
use super::super::frame::{Frame, NEVER, middle, rounded, whole};
use super::super::light::LAMP;
use super::super::tank::{Edge, cover};
use super::tones::background;
use super::{Canvas, Disc};

const ABSORB: f64 = 1.1;
/// Pixels aside, for each of the thickness and of the normal's; and of those at most.
const BEND: f64 = 0.35;
const FURTHEST: f64 = 40.0;
const LOW: DVec3 = DVec3::new(0.32, 0.36, 0.44);
const HIGH: DVec3 = DVec3::new(0.80, 0.90, 1.0);
const GLASS: DVec3 = DVec3::new(0.42, 0.48, 0.56);
const BEHIND: f64 = 0.5;
const BEFORE: f64 = 0.8;

/// The fluid at a pixel.
#[derive(Clone, Copy)]
struct Wet {
    /// The depth of its surface; [`NEVER`] where there is none.
    level: f64,
    thickness: f64,
    /// Red, green, blue and foam.
    dye: DVec4,
    /// How much of the pixel it covers.
    rim: f64,
}

const DRY: Wet = Wet { level: NEVER, thickness: 0.0, dye: DVec4::ZERO, rim: 0.0 };

impl Canvas<'_> {
    /// Draws the fluid over what is behind it, and edges of tanks.
    pub fn draw_fluid(&mut self) {
        let mut surface = self.drops();
        for down in [false, true].repeat(ROUNDS) {
            let smooth = |i: usize| smooth(&surface, &self.frame, i, down);
            surface = (0..surface.len()).into_par_iter().map(smooth).collect();
        }
        let edges = self.picture.facets().tank_edges(&self.frame);
        let pool = Pool { frame: &self.frame, canvas: self, surface: &surface, edges: &edges };
        self.behind = (0..self.frame.area()).into_par_iter().map(|i| pool.pixel(i).extend(1.0)).collect();
    }
    /// The nearest front of drops in each pixel, and how much there is behind it.
    fn drops(&self) -> Vec<Wet> {
        let frame = &self.frame;
        let mut surface = vec![DRY; frame.area() as usize];
        for (id, disc) in self.discs.iter().enumerate().filter_map(|(id, disc)| Some((id, (*disc)?))) {
            let reach = disc.radius + 0.5;
            for (at, pixel) in self.pixels(disc.place - reach, disc.place + reach) {
                let off = pixel.distance(disc.place);
                let (half, depth) = front_at(frame, &disc, off);
                if off >= reach || depth >= self.front[at] {
                    continue;
                }
                let wet = &mut surface[at];
                wet.thickness += frame.water.layer * frame.water.grain * half;
                wet.rim = wet.rim.max((reach - off).clamp(0.0, 1.0));
                if depth < wet.level {
                    wet.level = depth;
                    wet.dye = self.color[id].extend(self.foam(id));
                }
            }
        }
        surface
    }
    /// How white a particle is, by its speed.
    fn foam(&self, id: usize) -> f64 {
        let v = self.velocity[id];
        if v.is_finite() { (2.5 * v.truncate().length() / self.frame.water.foam - 1.5).clamp(0.0, 1.0) } else { 0.0 }
    }
}

/// Half of what of a drop is behind a pixel, as a part of its radius, and the depth of its front there: flatter than a ball.
fn front_at(frame: &Frame, disc: &Disc, off: f64) -> (f64, f64) {
    let half = (1.0 - (off / disc.radius).powi(2)).max(0.0).sqrt();
    let parallel = frame.camera.distance == 0.0;
    let scale =
        if parallel { frame.scale() } else { (frame.scale() * frame.camera.distance - disc.radius) / disc.depth };
    (half, disc.depth + frame.water.oblate * disc.radius * (1.0 - half) / scale)
}

/// A mean along a row, or a column, of depths in a narrow range.
fn smooth(surface: &[Wet], frame: &Frame, i: usize, down: bool) -> Wet {
    let here = surface[i];
    if here.level >= NEVER {
        return here;
    }
    let columns = frame.width as usize;
    let (stride, at, len) =
        if down { (columns, i / columns, frame.height as usize) } else { (1, i % columns, columns) };
    let range = frame.water.range * frame.water.drop;
    let reach = whole((frame.water.calm * frame.water.drop * frame.scale_at(here.level)).max(0.0));
    let reach = reach.min(frame.water.farthest) as usize;
    let (mut sum, mut weights) = (here, 1.0);
    for k in 1..=reach.min(at).min(len - 1 - at) {
        let (a, b) = (surface[i - k * stride], surface[i + k * stride]);
        if a.level.max(b.level) < here.level + range {
            let weight = (1.0 - (k as f64 / (reach + 1) as f64).powi(2)).powi(2);
            sum.level += weight * (a.level.max(here.level - range) + b.level.max(here.level - range));
            sum.thickness += weight * (a.thickness + b.thickness);
            sum.dye += weight * (a.dye + b.dye);
            weights += 2.0 * weight;
        }
    }
    // In whole levels, as a device keeps it.
    let dye = (sum.dye / weights * 255.0).round() / 255.0;
    Wet { level: sum.level / weights, thickness: sum.thickness / weights, dye, rim: here.rim }
}

/// What is looked at.
struct Pool<'a> {
    frame: &'a Frame,
    canvas: &'a Canvas<'a>,
    surface: &'a [Wet],
    edges: &'a [Edge],
}

impl Pool<'_> {
    fn pixel(&self, i: u32) -> DVec3 {
        let frame = self.frame;
        let (x, y) = (i % frame.width, i / frame.width);
        let (at, pixel, wet) = (i as usize, middle(x, y), self.surface[i as usize]);
        let mut c = if wet.level < NEVER {
            let normal =
                self.slope(pixel, wet.level, DVec2::Y).cross(self.slope(pixel, wet.level, DVec2::X)).normalize();
            let aside = (BEND * frame.scale_at(wet.level) * wet.thickness).min(FURTHEST);
            let under = self.under(pixel + aside * DVec2::new(normal.x, -normal.y), wet.level);
            under.lerp(self.shaded(&wet, self.place(pixel, wet.level), normal, under), wet.rim)
        } else {
            self.under(pixel, wet.level)
        };
        c = c.lerp(GLASS, BEFORE * cover(self.edges, frame, pixel, wet.level, self.canvas.front[at]).before);
        rounded(c)
    }
    /// A place of the surface, in the picture's axes.
    fn place(&self, pixel: DVec2, z: f64) -> DVec3 {
        let off = (pixel - 0.5 * self.frame.size()) * DVec2::new(1.0, -1.0) / self.frame.scale();
        let distance = self.frame.camera.distance;
        (if distance > 0.0 { off * z / distance } else { off }).extend(-z)
    }
    fn level(&self, pixel: DVec2) -> f64 {
        let is_inside = pixel.min_element() >= 0.0 && pixel.cmplt(self.frame.size()).all();
        if is_inside { self.surface[self.frame.pixel(whole(pixel.x), whole(pixel.y))].level } else { NEVER }
    }
    /// From one neighbour to the next, by the one that is less of a step.
    fn slope(&self, pixel: DVec2, z: f64, way: DVec2) -> DVec3 {
        let here = self.place(pixel, z);
        let (a, b) = (self.level(pixel - way), self.level(pixel + way));
        if a.min(b) >= NEVER {
            self.place(pixel + way, z) - here
        } else if (a - z).abs() < (b - z).abs() {
            here - self.place(pixel - way, a)
        } else {
            self.place(pixel + way, b) - here
        }
    }
    /// What is behind the fluid at a place of the picture.
    fn under(&self, place: DVec2, depth: f64) -> DVec3 {
        let q = place.max(DVec2::ZERO).min(self.frame.size() - 0.5);
        let at = self.frame.pixel(whole(q.x), whole(q.y));
        let stands = self.canvas.behind[at];
        let c = background(self.frame, q).lerp(stands.truncate(), stands.w);
        c.lerp(GLASS, BEHIND * cover(self.edges, self.frame, q, depth, self.canvas.front[at]).behind)
    }
    fn shaded(&self, wet: &Wet, place: DVec3, normal: DVec3, behind: DVec3) -> DVec3 {
        let water = &self.frame.water;
        let view = if self.frame.camera.distance > 0.0 { -place.normalize() } else { DVec3::Z };
        let (paint, foam) = (wet.dye.truncate(), wet.dye.w);
        let clear = (-wet.thickness * water.absorption * (ABSORB - water.stain * paint)).exp();
        let day = (0.6 * normal.dot(LAMP) + 0.4).max(0.0);
        let facing = normal.dot(view).clamp(0.0, 1.0);
        let mirror = (0.03 + 0.97 * (1.0 - facing).powi(5)) * (1.0 - foam);
        let sky = water.gloss * LOW.lerp(HIGH, 0.5 + normal.dot(view) * normal.y - 0.5 * view.y);
        let shine = normal.dot((LAMP + view).normalize()).max(0.0).powi(120) * (1.0 - foam);
        let body = paint * (0.4 + 0.75 * day);
        // Mist where it is thin.
        let c = (body + (behind - body) * clear).lerp(DVec3::splat(0.7 + 0.3 * day), foam * (1.0 - clear.x.powi(4)));
        (c.lerp(sky, mirror) + 0.8 * shine).clamp(DVec3::ZERO, DVec3::ONE)
    }
}
