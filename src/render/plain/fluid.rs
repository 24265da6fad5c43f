//! A fluid: the surface of its drops, made smooth, and light on it.

use glam::{DVec2, DVec3, DVec4};
use rayon::prelude::*;

use super::super::fluid::ROUNDS;
use super::super::frame::{Frame, NEVER, middle, rounded, whole};
use super::super::light::LAMP;
use super::super::tank::{Edge, cover};
use super::tones::{background, smoothstep};
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
const WALL: DVec3 = DVec3::new(0.50, 0.52, 0.56);
const EDGE: f64 = 0.4;
const ALONE: f64 = 0.6;
const MANY: f64 = 0.35;
const FEWEST: f64 = 0.22;
const BEND_IN: f64 = 1.2;

/// The fluid at a pixel.
#[derive(Clone, Copy)]
struct Wet {
    /// The depth of its surface; [`NEVER`] where there is none.
    level: f64,
    thickness: f64,
    /// Red, green, blue and foam.
    dye: DVec4,
    /// How much of the pixel drops cover, seen or not.
    rim: f64,
}

const DRY: Wet = Wet { level: NEVER, thickness: 0.0, dye: DVec4::ZERO, rim: 0.0 };

impl Canvas<'_> {
    /// Draws the fluid over what is behind it, and edges of tanks.
    pub fn draw_fluid(&mut self) {
        let mut surface = self.drops();
        let mut covers = self.covers(&surface);
        for down in [false, true] {
            covers = (0..covers.len()).into_par_iter().map(|i| soft(&covers, &self.frame, i, down)).collect();
        }
        for (turn, down) in [false, true].repeat(ROUNDS).into_iter().enumerate() {
            let smooth = |i: usize| {
                let fills = turn < 2 && surface[i].level >= NEVER;
                if fills { self.fill(&surface, i, down) } else { smooth(&surface, &self.frame, i, down) }
            };
            surface = (0..surface.len()).into_par_iter().map(smooth).collect();
        }
        let edges = self.picture.facets().tank_edges(&self.frame);
        let pool = Pool { frame: &self.frame, canvas: self, surface: &surface, covers: &covers, edges: &edges };
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
                if off >= reach {
                    continue;
                }
                let wet = &mut surface[at];
                wet.rim = wet.rim.max((reach - off).clamp(0.0, 1.0));
                if depth >= self.front[at] {
                    continue;
                }
                wet.thickness += frame.water.layer * frame.water.grain * half;
                if depth < wet.level {
                    wet.level = depth;
                    wet.dye = self.color[id].extend(self.foam(id));
                }
            }
        }
        surface
    }
    /// The parts of each pixel that drops and walls cover, and the part that counts.
    fn covers(&self, surface: &[Wet]) -> Vec<DVec3> {
        let frame = &self.frame;
        let mut walls = vec![0.0_f64; surface.len()];
        let flat = if frame.water.turn == 0.0 { &self.walls[..] } else { &[] };
        for disc in flat {
            let reach = disc.radius + 0.5;
            for (at, pixel) in self.pixels(disc.place - reach, disc.place + reach) {
                walls[at] = walls[at].max((reach - pixel.distance(disc.place)).clamp(0.0, 1.0));
            }
        }
        let wraps = frame.water.ends(frame).wraps;
        let drawn = |x: i64, y: i64| {
            let is_inside = (0..i64::from(frame.width)).contains(&x) && (0..i64::from(frame.height)).contains(&y);
            let at = usize::try_from(y * i64::from(frame.width) + x).ok().filter(|_| is_inside);
            at.map_or(DVec2::ZERO, |at| DVec2::new(surface[at].rim, walls[at]))
        };
        let of = |i: u32| {
            let (x, y) = (i % frame.width, i / frame.width);
            let wet = surface[i as usize];
            let hidden = wet.level >= NEVER && wet.rim > 0.0;
            let part = if hidden { 0.0 } else { within(frame, middle(x, y)) };
            let mut both = drawn(x.into(), y.into());
            for (wrap, way) in wraps.into_iter().zip([[1, 0], [0, 1]]).filter(|(wrap, _)| *wrap > 0) {
                for turn in [-i64::from(wrap), i64::from(wrap)] {
                    both = both.max(drawn(i64::from(x) + turn * way[0], i64::from(y) + turn * way[1]));
                }
            }
            part * DVec3::new(both.x, if frame.water.turn > 0.0 { both.x } else { both.y }, 1.0)
        };
        (0..frame.area()).into_par_iter().map(of).collect()
    }
    /// A surface beside drops, unless a solid hides it.
    fn fill(&self, surface: &[Wet], i: usize, down: bool) -> Wet {
        let Line { stride, at, len } = Line::through(&self.frame, i, down);
        let water = &self.frame.water;
        let reach = (if water.turn > 0.0 { water.softer } else { water.soft }) as usize;
        let (mut sum, mut weights) = (DRY, 0.0);
        sum.level = 0.0;
        for k in at.saturating_sub(reach)..=(at + reach).min(len - 1) {
            let other = surface[i + k * stride - at * stride];
            if other.level < NEVER {
                let weight = bell(k.abs_diff(at), reach);
                sum.level += weight * other.level;
                sum.thickness += weight * other.thickness;
                sum.dye += weight * other.dye;
                weights += weight;
            }
        }
        if weights > 0.0 && sum.level / weights < self.front[i] {
            let dye = (sum.dye / weights * 255.0).round() / 255.0;
            Wet { level: sum.level / weights, thickness: sum.thickness / weights, dye, rim: surface[i].rim }
        } else {
            surface[i]
        }
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

/// The part of a pixel within the box of a fluid in a plane.
fn within(frame: &Frame, place: DVec2) -> f64 {
    let ends = frame.water.ends(frame);
    let low = (place - ends.low + 0.5).clamp(DVec2::ZERO, DVec2::ONE);
    let high = (ends.high - place + 0.5).clamp(DVec2::ZERO, DVec2::ONE);
    low.x * low.y * high.x * high.y
}

/// The row or column of a pixel: the way from one to the next, the pixel's number in it, and how many there are.
struct Line {
    stride: usize,
    at: usize,
    len: usize,
}

impl Line {
    fn through(frame: &Frame, i: usize, down: bool) -> Self {
        let columns = frame.width as usize;
        if down {
            Self { stride: columns, at: i / columns, len: frame.height as usize }
        } else {
            Self { stride: 1, at: i % columns, len: columns }
        }
    }
}

/// The weight of a pixel so far away, of those within reach.
fn bell(k: usize, reach: usize) -> f64 {
    (1.0 - (k as f64 / (reach + 1) as f64).min(1.0).powi(2)).powi(2)
}

/// Means along a row, or a column, of covered parts; in space the second is made smooth farther.
fn soft(covers: &[DVec3], frame: &Frame, i: usize, down: bool) -> DVec3 {
    let Line { stride, at, len } = Line::through(frame, i, down);
    let soft = frame.water.soft as usize;
    let softer = if frame.water.turn > 0.0 { frame.water.softer as usize } else { soft };
    let (mut sum, mut weights) = (covers[i], DVec3::ONE);
    for k in 1..=soft.max(softer) {
        let weight = DVec3::new(bell(k, soft), bell(k, softer), bell(k, soft));
        sum += weight * (covers[i - k.min(at) * stride] + covers[i + k.min(len - 1 - at) * stride]);
        weights += 2.0 * weight;
    }
    sum / weights
}

/// A mean along a row, or a column, of depths in a narrow range.
fn smooth(surface: &[Wet], frame: &Frame, i: usize, down: bool) -> Wet {
    let here = surface[i];
    if here.level >= NEVER {
        return here;
    }
    let Line { stride, at, len } = Line::through(frame, i, down);
    let range = frame.water.range * frame.water.drop;
    let wide =
        (frame.water.calm * frame.water.drop * frame.scale_at(here.level)).clamp(0.0, frame.water.farthest.into());
    let (mut sum, mut weights) = (here, 1.0);
    for k in 1..=(whole(wide) as usize).min(at).min(len - 1 - at) {
        let (a, b) = (surface[i - k * stride], surface[i + k * stride]);
        let room = (2.0 - 2.0 * (a.level.max(b.level) - here.level) / range).clamp(0.0, 1.0);
        if room > 0.0 {
            let weight = room * (1.0 - (k as f64 / (wide + 1.0)).powi(2)).powi(2);
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

/// Outlines of fluid and walls at a pixel: how far inside them it is, and the change of that from pixel to pixel, to the right and up.
struct Outline {
    depth: DVec3,
    change: [DVec2; 3],
}

impl Outline {
    /// The part of the pixel within one of them, so many pixels farther out, less a half.
    fn part(&self, k: usize, more: f64) -> f64 {
        let steep = self.change[k].length().max(0.1);
        (more + self.depth[k] / steep).clamp(0.0, 1.0)
    }
    /// Near its outline a surface turns away from the eye.
    fn turned(&self, frame: &Frame, normal: DVec3) -> DVec3 {
        let (steep, water) = (self.change[2].length(), &frame.water);
        let near = 1.0 - (self.depth.z / (BEND_IN * f64::from(water.soft))).clamp(0.0, 1.0);
        let part = water.turn * near * near * steep.min(1.0);
        normal.lerp((-self.change[2] / steep.max(1e-9)).extend(0.0), part).normalize()
    }
}

/// What is looked at.
struct Pool<'a> {
    frame: &'a Frame,
    canvas: &'a Canvas<'a>,
    surface: &'a [Wet],
    covers: &'a [DVec3],
    edges: &'a [Edge],
}

impl Pool<'_> {
    fn pixel(&self, i: u32) -> DVec3 {
        let frame = self.frame;
        let (x, y) = (i % frame.width, i / frame.width);
        let (at, pixel, wet) = (i as usize, middle(x, y), self.surface[i as usize]);
        let outline = self.outline(pixel);
        let box_part = within(frame, pixel);
        let mut normal = DVec3::ZERO;
        let mut aside = DVec2::ZERO;
        if wet.level < NEVER {
            normal = self.slope(pixel, wet.level, DVec2::Y).cross(self.slope(pixel, wet.level, DVec2::X)).normalize();
            normal = outline.turned(frame, normal);
            let bend = (BEND * frame.scale_at(wet.level) * wet.thickness).min(FURTHEST);
            aside = bend * DVec2::new(normal.x, -normal.y);
        }
        let mut c = self.under(pixel + aside, wet.level);
        if self.canvas.front[at] >= NEVER {
            c = c.lerp(WALL, box_part * outline.part(1, 1.5));
        }
        if wet.level < NEVER {
            let shaded = self.shaded(&wet, self.place(pixel, wet.level), normal, c);
            c = c.lerp(shaded, box_part * outline.part(0, 0.5));
        }
        c = c.lerp(GLASS, BEFORE * cover(self.edges, frame, pixel, wet.level, self.canvas.front[at]).before);
        rounded(c)
    }
    /// How far inside the outlines of fluid and of walls a pixel is, and how far inside that from which normals turn, in about pixels.
    fn depths(&self, pixel: DVec2) -> DVec3 {
        let q = pixel.clamp(DVec2::splat(0.5), self.frame.size() - 0.5);
        let cover = self.covers[self.frame.pixel(whole(q.x), whole(q.y))];
        if cover.z <= 0.0 {
            return DVec3::splat(-1.0);
        }
        let [fluid, wall] = (cover.truncate() / cover.z).to_array();
        let (soft, softer) = (f64::from(self.frame.water.soft), f64::from(self.frame.water.softer));
        if self.frame.water.turn > 0.0 {
            let (alone, many) = ((fluid - ALONE) * soft, (wall - MANY) * softer);
            return DVec3::new(alone.max(many), -1.0, alone + (many - alone) * smoothstep(FEWEST, MANY, wall));
        }
        let both = DVec2::new(fluid - wall, wall - fluid).min(DVec2::splat(fluid + wall - EDGE));
        soft * both.extend(0.0)
    }
    fn outline(&self, pixel: DVec2) -> Outline {
        let right = 0.5 * (self.depths(pixel + DVec2::X) - self.depths(pixel - DVec2::X));
        let up = 0.5 * (self.depths(pixel - DVec2::Y) - self.depths(pixel + DVec2::Y));
        Outline { depth: self.depths(pixel), change: [0, 1, 2].map(|k| DVec2::new(right[k], up[k])) }
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
        } else if (a - z).abs().max((b - z).abs()) < self.frame.water.range * self.frame.water.drop {
            0.5 * (self.place(pixel + way, b) - self.place(pixel - way, a))
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
