//! Lighting of surfaces, shadows, and intersections of rays with solids. In the picture's axes: right, up, towards the eye.

use glam::{DQuat, DVec2, DVec3};

use super::super::frame::{Frame, NEVER, whole};
use super::super::light::{LAMP, LAMP_RIGHT, LAMP_UP};
use super::super::solid::{Shape, Solid};

/// A surface that is so near casts no shadow; and how wide a shadow's edge is \[pixels of the map\].
const BIAS: f64 = 2.5;
const RIM: f64 = 4.0;
/// The lamp's own width, as seen from here.
const WIDTH: f64 = 0.09;
const THIN: f64 = 1e-9;

/// What shadows are made of.
pub struct Lamp<'a> {
    pub solids: &'a [Solid],
    /// The nearest of all facets to the lamp, in a map of so many pixels each way.
    pub map: &'a [f64],
    pub frame: &'a Frame,
}

/// Where a ray intersects a solid.
#[derive(Clone, Copy)]
pub struct Meeting<'a> {
    /// How often the ray's direction it is away.
    pub way: f64,
    pub normal: DVec3,
    pub solid: &'a Solid,
}

impl Lamp<'_> {
    /// Whether a part of the lamp is seen: 1 or 0.
    pub fn seen(&self, p: DVec3, normal: DVec3, jitter: DVec2) -> f64 {
        let map = f64::from(self.frame.map);
        let texel = 2.0 * self.frame.lamp / map;
        let q = p + BIAS * texel * normal;
        let at = 0.5 * map + DVec2::new(q.dot(LAMP_RIGHT), -q.dot(LAMP_UP)) / texel + RIM * jitter;
        let is_inside = at.min_element() >= 0.0 && at.max_element() < map;
        let nearest = |at: DVec2| self.map[(whole(at.y) * self.frame.map + whole(at.x)) as usize];
        if is_inside && nearest(at) < -q.dot(LAMP) - BIAS * texel {
            return 0.0;
        }
        let way = LAMP + WIDTH * (jitter.x * LAMP_RIGHT + jitter.y * LAMP_UP);
        if meet(self.solids, q, way, 0.0, false).is_none() { 1.0 } else { 0.0 }
    }
}

/// Of a surface; `view` leads to the eye.
pub fn matte(color: DVec3, normal: DVec3, view: DVec3, light: f64) -> DVec3 {
    let day = (0.8 * normal.dot(LAMP) + 0.2).max(0.0) * light;
    let shine = normal.dot((LAMP + view).normalize()).max(0.0).powi(20) * light;
    let rim = (1.0 - normal.dot(view).clamp(0.0, 1.0)).powi(4);
    color * (0.22 + 0.08 * normal.y + 0.72 * day) + 0.1 * shine + 0.08 * rim
}

/// Of a thread.
pub fn strand(color: DVec3, along: DVec3, view: DVec3, light: f64) -> DVec3 {
    let (l, v) = (along.dot(LAMP), along.dot(view));
    let day = (1.0 - l * l).max(0.0).sqrt();
    let shine = (day * (1.0 - v * v).max(0.0).sqrt() - l * v).max(0.0).powi(30);
    color * (0.25 + (0.2 + 0.45 * light) * day) + (0.1 + 0.35 * light) * shine * (0.3 + 0.7 * color)
}

/// The nearest of all that is further along a ray than `least`. What is cut open, as cones are, has no shadow.
pub fn meet(solids: &[Solid], o: DVec3, d: DVec3, least: f64, open: bool) -> Option<Meeting<'_>> {
    let met = |solid: &'_ Solid| {
        if !open && matches!(solid.shape, Shape::Cone { .. }) {
            return None;
        }
        let own = |v: DVec3| solid.turn.conjugate() * v;
        let (way, normal) = into(&solid.shape, own(o - solid.place), own(d))?;
        (way > least && way < NEVER).then_some((way, solid.turn * normal))
    };
    let all = solids.iter().filter_map(|solid| met(solid).map(|(way, normal)| Meeting { way, normal, solid }));
    all.min_by(|a, b| a.way.total_cmp(&b.way))
}

fn into(shape: &Shape, o: DVec3, d: DVec3) -> Option<(f64, DVec3)> {
    match *shape {
        Shape::Ball { radius } => into_round(radius, 0.0, o, d),
        Shape::Capsule { radius, half } => into_round(radius, half, o, d),
        Shape::Box { half } => into_box(half, o, d),
        Shape::Cone { radius, end, half } => out_of_cone([radius, end], half, o, d),
        Shape::Plane => (d.z < 0.0).then(|| (-o.z / d.z, DVec3::Z)),
    }
}

/// Into a tube between two ends, or the balls at those.
fn into_round(radius: f64, half: f64, o: DVec3, d: DVec3) -> Option<(f64, DVec3)> {
    let (flat_o, flat_d) = (o.truncate(), d.truncate());
    let squared = flat_d.length_squared().max(THIN);
    let along = -flat_o.dot(flat_d) / squared;
    let rest = radius.powi(2) - (flat_o + along * flat_d).length_squared();
    let tube = along - (rest.max(0.0) / squared).sqrt();
    let z = o.z + tube * d.z;
    let core = z.clamp(-half, half) * DVec3::Z;
    let way = if z.abs() < half { (rest >= 0.0).then_some(tube)? } else { into_ball(o - core, d, radius)? };
    Some((way, (o + way * d - core) / radius))
}

fn into_ball(o: DVec3, d: DVec3, radius: f64) -> Option<f64> {
    let along = -o.dot(d) / d.length_squared();
    let rest = radius * radius - (o + along * d).length_squared();
    (rest >= 0.0).then(|| along - (rest / d.length_squared()).sqrt())
}

/// Where a ray leaves a cone about z, if it does between the ends.
fn out_of_cone([low, high]: [f64; 2], half: f64, o: DVec3, d: DVec3) -> Option<(f64, DVec3)> {
    let slope = 0.5 * (high - low) / half;
    let wide = 0.5 * (high + low) + slope * o.z;
    let (flat_o, flat_d) = (o.truncate(), d.truncate());
    let a = flat_d.length_squared() - slope * slope * d.z * d.z;
    let b = flat_o.dot(flat_d) - slope * d.z * wide;
    let c = flat_o.length_squared() - wide * wide;
    let root = b.mul_add(b, -a * c);
    if root < 0.0 {
        return None;
    }
    let root = root.sqrt();
    // Of two forms that which does not cancel.
    let way = if b < 0.0 { (root - b) / if a.abs() < THIN { THIN } else { a } } else { -c / (b + root).max(1e-30) };
    let p = o + way * d;
    let radius = wide + slope * way * d.z;
    (p.z.abs() <= half && radius > 0.0).then(|| (way, (-p.truncate()).extend(slope * radius).normalize()))
}

/// Where the last of three slabs is entered, if that is before the first is left.
fn into_box(half: DVec3, o: DVec3, d: DVec3) -> Option<(f64, DVec3)> {
    let safe = DVec3::from_array(d.to_array().map(|x| if x.abs() < THIN { THIN } else { x }));
    let (middle, thick) = (-o / safe, (half / safe).abs());
    let (enter, leave) = (middle - thick, middle + thick);
    let way = enter.max_element();
    let side = |k: usize| if enter[k] >= way && d[k] != 0.0 { -d[k].signum() } else { 0.0 };
    (way <= leave.min_element()).then(|| (way, DVec3::new(side(0), side(1), side(2))))
}

/// A place on a floor, in squares of it.
pub fn square(solid: &Solid, p: DVec3, side: f64) -> DVec2 {
    let turn: DQuat = solid.turn.conjugate();
    (turn * (p - solid.place)).truncate() / side
}
