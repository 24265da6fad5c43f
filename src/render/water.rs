//! A fluid in the picture: its numbers, and light on it.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::frame::{DYE, EDGE, FRONT, Frame, LEVEL, NEVER, RIM, SCENERY, THICKNESS, WET, middle, unpack, whole};
use super::light::LAMP;
use super::paint::rounded;
use super::scenery::Facets;
use super::sky::background;
use super::tank::{Edge, edges};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Scalar, Threads};

/// What a fluid looks like.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Water {
    /// The radius of a drop \[length\]; zero where there is no fluid.
    pub drop: f64,
    /// How far its rim is behind its front, as a part of that.
    pub oblate: f64,
    /// Parts in which the thickness of a drop is counted.
    pub grain: f64,
    /// The thickness that one of those stands for \[length\].
    pub layer: f64,
    /// How much of it absorbs light \[1 / length\].
    pub murk: f64,
    /// How much less it absorbs of the light of its own colour: 1 for water, 0 for paint.
    pub stain: f64,
    /// The speed from which on it is white \[length / time\].
    pub foam: f64,
    /// How much nearer and farther the same surface may be \[drops\].
    pub range: f64,
    /// How wide the surface is made smooth \[drops\].
    pub calm: f64,
    /// The same, at most \[pixels\].
    pub farthest: u32,
    /// Brightness of the sky that it mirrors.
    pub gloss: f64,
    /// Half the width of a tank's edge \[pixels\].
    pub wire: f64,
    /// Edges of tanks.
    pub edges: u32,
}

impl Water {
    /// By their names in shaders.
    pub(super) fn values(&self) -> [(&'static str, Scalar); 13] {
        let float = Scalar::Float;
        [
            ("drop", float(self.drop)),
            ("oblate", float(self.oblate)),
            ("grain", float(self.grain)),
            ("layer", float(self.layer)),
            ("murk", float(self.murk)),
            ("stain", float(self.stain)),
            ("foam", float(self.foam)),
            ("range", float(self.range)),
            ("calm", float(self.calm)),
            ("farthest", Scalar::Uint(self.farthest)),
            ("gloss", float(self.gloss)),
            ("wire", float(self.wire)),
            ("edges", Scalar::Uint(self.edges)),
        ]
    }
    /// Whether there is a fluid.
    #[must_use]
    pub fn is_there(&self) -> bool {
        self.drop > 0.0
    }
}

const ABSORB: f64 = 1.1;
const BEND: f64 = 0.35;
const FURTHEST: f64 = 40.0;
const LOW: DVec3 = DVec3::new(0.32, 0.36, 0.44);
const HIGH: DVec3 = DVec3::new(0.80, 0.90, 1.0);
const GLASS: DVec3 = DVec3::new(0.42, 0.48, 0.56);
const BEHIND: f64 = 0.5;
const BEFORE: f64 = 0.8;

/// The kernel.
pub fn kernel(frame: &Frame, facets: &Facets) -> Result<Kernel, Error> {
    let files = [
        crate::shader!("render/flat.wgsl"),
        crate::shader!("render/sky.wgsl"),
        crate::shader!("render/edge.wgsl"),
        crate::shader!("render/water.wgsl"),
    ];
    let pass = frame.pass(&files, Threads::new(frame.area()), 16 + 2 * u64::from(frame.water.edges))?;
    let on = *frame;
    let reference = move |host: &Host| {
        let (front, scenery, rim) = (host.read(FRONT)?, host.read(SCENERY)?, host.read(RIM)?);
        let (level, thickness, dye) = (host.read(LEVEL)?, host.read(THICKNESS)?, host.read(DYE)?);
        let edge = host.read(EDGE)?;
        let edges = edges(&edge);
        let pool = Pool {
            frame: on,
            front: &front,
            scenery: &scenery,
            level: &level,
            thickness: &thickness,
            dye: &dye,
            edges: edges.get(..on.water.edges as usize).unwrap_or(&[]),
        };
        let rim: &[u32] = &rim;
        host.write(WET)?.par_iter_mut().zip(0..on.area()).for_each(|(out, i)| {
            let (x, y) = (i % on.width, i / on.width);
            let (at, z) = (i as usize, pool.level[i as usize]);
            let normal = (z < NEVER).then(|| pool.normal(i64::from(x), i64::from(y), z));
            let aside = normal.map_or(DVec2::ZERO, |normal| pool.aside(at, z, normal));
            let mut c = pool.under(middle(x, y) + aside, z);
            if let Some(normal) = normal {
                let place = pool.place(i64::from(x), i64::from(y), z);
                c = c.lerp(pool.look(at, place, normal, c), f64::from(rim[at]) / 255.0);
            }
            let before = Edge::cover(pool.edges, &on, middle(x, y), z, pool.front[at]).y;
            *out = rounded(c.lerp(GLASS, BEFORE * before));
        });
        Ok(())
    };
    Ok(facets.bind(frame.kernel("water", vec![pass], reference), frame))
}

/// What is looked at.
struct Pool<'a> {
    frame: Frame,
    front: &'a [u32],
    scenery: &'a [u32],
    level: &'a [f64],
    thickness: &'a [f64],
    dye: &'a [u32],
    edges: &'a [Edge],
}

impl Pool<'_> {
    fn place(&self, x: i64, y: i64, z: f64) -> DVec3 {
        let off = (DVec2::new(x as f64, y as f64) + 0.5 - 0.5 * self.frame.size()) * DVec2::new(1.0, -1.0);
        let off = off / self.frame.scale();
        let distance = self.frame.camera.distance;
        (if distance > 0.0 { off * z / distance } else { off }).extend(-z)
    }
    fn level(&self, x: i64, y: i64) -> f64 {
        let (width, height) = (i64::from(self.frame.width), i64::from(self.frame.height));
        let inside = (0..width).contains(&x) && (0..height).contains(&y);
        let at = usize::try_from(y * width + x).unwrap_or(0);
        if inside { self.level[at] } else { NEVER }
    }
    fn slope(&self, x: i64, y: i64, z: f64, (dx, dy): (i64, i64)) -> DVec3 {
        let here = self.place(x, y, z);
        let (a, b) = (self.level(x - dx, y - dy), self.level(x + dx, y + dy));
        if a.min(b) >= NEVER {
            self.place(x + dx, y + dy, z) - here
        } else if (a - z).abs() < (b - z).abs() {
            here - self.place(x - dx, y - dy, a)
        } else {
            self.place(x + dx, y + dy, b) - here
        }
    }
    fn under(&self, place: DVec2, depth: f64) -> DVec3 {
        let q = place.max(DVec2::ZERO).min(self.frame.size() - 0.5);
        let at = self.frame.pixel(whole(q.x), whole(q.y));
        let stands = self.scenery[at];
        let behind = Edge::cover(self.edges, &self.frame, q, depth, self.front[at]).x;
        let c = background(&self.frame, q).lerp(unpack(stands), f64::from(stands >> 24) / 255.0);
        c.lerp(GLASS, BEHIND * behind)
    }
    fn normal(&self, x: i64, y: i64, z: f64) -> DVec3 {
        self.slope(x, y, z, (0, 1)).cross(self.slope(x, y, z, (1, 0))).normalize()
    }
    /// How many pixels aside one sees what is behind it.
    fn aside(&self, at: usize, z: f64, normal: DVec3) -> DVec2 {
        (BEND * self.frame.scale_at(z) * self.thickness[at]).min(FURTHEST) * DVec2::new(normal.x, -normal.y)
    }
    fn look(&self, at: usize, place: DVec3, normal: DVec3, behind: DVec3) -> DVec3 {
        let frame = &self.frame;
        let view = if frame.camera.distance > 0.0 { -place.normalize() } else { DVec3::Z };
        let (paint, foam) = (unpack(self.dye[at]), f64::from(self.dye[at] >> 24) / 255.0);
        let thickness = self.thickness[at];
        let exponent = -thickness * frame.water.murk * (ABSORB - frame.water.stain * paint);
        let clear = DVec3::from_array(exponent.to_array().map(f64::exp));
        let day = (0.6 * normal.dot(LAMP) + 0.4).max(0.0);
        let facing = normal.dot(view).clamp(0.0, 1.0);
        let mirror = (0.03 + 0.97 * (1.0 - facing).powi(5)) * (1.0 - foam);
        let up = (2.0 * normal.dot(view) * normal - view).y;
        let sky = frame.water.gloss * LOW.lerp(HIGH, 0.5 + 0.5 * up);
        let shine = normal.dot((LAMP + view).normalize()).max(0.0).powi(120) * (1.0 - foam);
        let body = paint * (0.4 + 0.75 * day);
        let c = body + (behind - body) * clear;
        let c = c.lerp(DVec3::splat(0.7 + 0.3 * day), foam * (1.0 - clear.x.powi(4)));
        (c.lerp(sky, mirror) + 0.8 * shine).clamp(DVec3::ZERO, DVec3::ONE)
    }
}
