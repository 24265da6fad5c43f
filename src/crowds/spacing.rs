//! The collision-free speed model (Tordeux, Chraibi & Seyfried, arXiv 1512.05597), with walls: what pedestrians wish, the direction that they take beside others,
//! and the speed for which there is room.

use std::sync::Arc;

use glam::{DVec2, DVec3, DVec4, Vec4};

use super::desire::DIRECTION;
use super::walls::{WALLS, rounded, table};
use super::{desired_speed_of, radius_of};
use crate::error::Error;
use crate::floor_plan::{FloorPlan, Segment};
use crate::kernel::{
    Column, Field, Host, Kernel, Kind as Element, POSITION, Pass, Problem, Scalar, Shader, Source, VELOCITY, World,
};
use crate::visit::{Law, Outcome, Over, Particle};

/// What each would do without the others: `xy` the sum of its desired direction and of what walls add, `z` its radius \[length\], `w` its desired speed
/// \[length / time\]; −1 for particles that are no pedestrians of the model.
const WISH: Field<Vec4> = Field::new("wish");
/// What each does: `xy` the direction, `z` the speed \[length / time\], `w` the distance to the nearest wall \[length\].
const COURSE: Field<Vec4> = Field::new("course");
/// The distance to walls that there are none of.
const FAR: f64 = 1e9;

/// The columns of both.
pub(crate) fn columns() -> Vec<Column> {
    let (wish, course) =
        ("what it would do alone: the way x, y, and the radius", "what it does: the direction x, y, and the speed");
    vec![
        Column::new(WISH.name, Element::Vector, "", wish).derived(),
        Column::new("wished_speed", Element::Scalar, "length / time", "the speed that it would have alone")
            .derived()
            .within(WISH.name, 3),
        Column::new(COURSE.name, Element::Vector, "", course).derived(),
        Column::new("clearance", Element::Scalar, "length", "the distance to the nearest wall")
            .derived()
            .within(COURSE.name, 3),
    ]
}

/// A repulsion a exp(o / D) by the overlap o.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Repulsion {
    pub strength: f64,
    /// D \[length\].
    pub decay: f64,
}

impl Repulsion {
    fn at(self, overlap: f64) -> f64 {
        self.strength * (overlap / self.decay).exp()
    }
}

/// The model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spacing {
    /// T \[time\].
    pub time_gap: f64,
    pub others: Repulsion,
    pub walls: Repulsion,
    /// The species of its pedestrians, if not all.
    pub species: Option<u32>,
}

/// The walls of a plan, or none.
struct Floor {
    walls: Vec<Segment>,
}

impl Floor {
    fn of(plan: Option<&FloorPlan>) -> Self {
        Self { walls: plan.map(rounded).unwrap_or_default() }
    }
    /// The push of walls, and the distance to the nearest.
    fn before(&self, x: DVec2, radius: f64, repulsion: Repulsion) -> (DVec2, f64) {
        if self.walls.is_empty() {
            return (DVec2::ZERO, 0.0);
        }
        let mut clearance = FAR;
        let mut push = DVec2::ZERO;
        for pieces in self.walls.chunk_by(|a, b| a.wall == b.wall) {
            let mut nearest = (FAR, DVec2::ZERO, false);
            for found in pieces.iter().map(|piece| piece.nearest(x)) {
                let distance = found.way.length();
                if distance < nearest.0 {
                    nearest = (distance, found.way, found.seen);
                }
            }
            let (distance, way, seen) = nearest;
            if seen && distance > 0.0 {
                push += repulsion.at(radius - distance) / distance * way;
            }
            clearance = clearance.min(distance);
        }
        (push, clearance)
    }
    fn hides(&self, x: DVec2, r: DVec2, clearance: f64) -> bool {
        r.length_squared() > clearance * clearance && self.walls.iter().any(|wall| wall.crosses(x, x + r))
    }
    fn before_contact(&self, x: DVec2, e: DVec2, radius: f64, most: f64) -> f64 {
        self.walls.iter().fold(most, |way, wall| {
            let here = wall.nearest(x).way;
            let (distance, into) = (here.length(), -e.dot(here));
            if into > 0.0 { way.min((distance - radius).max(0.0) * distance / into) } else { way }
        })
    }
}

/// The file with the functions of walls of a plan, or of none.
fn walls_file(plan: Option<&FloorPlan>) -> Vec<Source> {
    match plan {
        Some(_) => vec![crate::shader!("crowds/crosses.wgsl"), crate::shader!("crowds/floor.wgsl")],
        None => vec![crate::shader!("crowds/open_floor.wgsl")],
    }
}

fn wish_of(me: &Particle) -> DVec4 {
    me.vector(WISH.name).unwrap_or_default()
}
fn course_of(me: &Particle) -> DVec4 {
    me.vector(COURSE.name).unwrap_or_default()
}

/// The least spacing to those in front; none where there are none.
#[derive(Default)]
struct Ahead(Option<f64>);

impl Spacing {
    /// The laws on a plan or on an open floor, over pairs found so, with the file of the last of them.
    pub fn laws(&self, plan: Option<&FloorPlan>, over: Over, wgsl: Source) -> Vec<Law> {
        let on_floor = |law: Law| {
            let constants = plan.map(|plan| vec![("COUNT", plan.segments().len() as f64)]).unwrap_or_default();
            Law { tables: plan.map(table).into_iter().collect(), constants, beside: walls_file(plan), ..law }
        };
        [self.wishes(plan), self.turns(plan, over), self.paces(plan, over, wgsl)].map(on_floor).to_vec()
    }
    fn wishes(&self, plan: Option<&FloorPlan>) -> Law {
        let (floor, own) = (Floor::of(plan), *self);
        let rule = move |me: &Particle, _: &World, outcome: &mut Outcome| {
            let e = me.vector(DIRECTION.name).unwrap_or_default().truncate().truncate();
            let radius = radius_of(me);
            let (push, clearance) = floor.before(me.position.truncate(), radius, own.walls);
            let is_one = me.mass > 0.0 && own.species.is_none_or(|species| species == me.species());
            let desired = if e == DVec2::ZERO { 0.0 } else { desired_speed_of(me).max(0.0) };
            let speed = if is_one { desired } else { -1.0 };
            outcome.set(WISH.name, (e + push).extend(radius).extend(speed));
            outcome.set(COURSE.name, DVec4::W * clearance);
        };
        let values = vec![
            ("wall_repulsion".to_owned(), Scalar::Float(self.walls.strength)),
            ("wall_decay".to_owned(), Scalar::Float(self.walls.decay)),
            ("species".to_owned(), Scalar::Uint(self.species.unwrap_or(u32::MAX))),
        ];
        let into = [WISH.name, COURSE.name];
        Law::updating("collision_free_speed", crate::shader!("crowds/wish.wgsl"), values, &into, rule)
    }
    fn turns(&self, plan: Option<&FloorPlan>, over: Over) -> Law {
        let (floor, repulsion) = (Floor::of(plan), self.others);
        let gather = move |me: &Particle, you: &Particle, r: DVec3, _: &World, sum: &mut DVec2| {
            let (mine, yours, distance) = (wish_of(me), wish_of(you), r.length());
            let r = r.truncate();
            if yours.w >= 0.0 && distance > 0.0 && !floor.hides(me.position.truncate(), r, course_of(me).w) {
                *sum -= repulsion.at(mine.z + yours.z - distance) / distance * r;
            }
        };
        let finish = |me: &Particle, sum: &DVec2, _: &World, outcome: &mut Outcome| {
            let mine = wish_of(me);
            if mine.w >= 0.0 {
                let e = (mine.truncate().truncate() + *sum).normalize_or_zero();
                outcome.set(COURSE.name, e.extend(0.0).extend(course_of(me).w));
            }
        };
        let values = vec![
            ("repulsion".to_owned(), Scalar::Float(repulsion.strength)),
            ("decay".to_owned(), Scalar::Float(repulsion.decay)),
        ];
        let wgsl = crate::shader!("crowds/turn.wgsl");
        Law::computing("turn aside", over, wgsl, values, &[COURSE.name], gather, finish)
    }
    fn paces(&self, plan: Option<&FloorPlan>, over: Over, wgsl: Source) -> Law {
        let (floor, time) = (Floor::of(plan), self.time_gap);
        let gather = move |me: &Particle, you: &Particle, r: DVec3, _: &World, ahead: &mut Ahead| {
            let (own, yours, distance) = (course_of(me), wish_of(you), r.length());
            let (e, r) = (own.truncate().truncate(), r.truncate());
            let both = wish_of(me).z + yours.z;
            let spacing = distance - both;
            let is_in_front = e.dot(r) >= 0.0 && e.perp_dot(r).abs() <= both;
            let is_nearest = ahead.0.is_none_or(|known| spacing < known);
            let is_one = yours.w >= 0.0 && distance > 0.0 && is_in_front && is_nearest;
            if is_one && !floor.hides(me.position.truncate(), r, own.w) {
                ahead.0 = Some(spacing);
            }
        };
        let finish = move |me: &Particle, ahead: &Ahead, _: &World, outcome: &mut Outcome| {
            let most = wish_of(me).w.max(0.0);
            let speed = ahead.0.map_or(most, |spacing| (spacing / time).clamp(0.0, most));
            outcome.set(COURSE.name, DVec4 { z: speed, ..course_of(me) });
        };
        let values = vec![("time_gap".to_owned(), Scalar::Float(time))];
        Law::computing("keep spacing", over, wgsl, values, &[COURSE.name], gather, finish)
    }
}

/// The kernel by which pedestrians take up their velocities.
pub(crate) fn set_off(problem: &Problem) -> Result<Kernel, Error> {
    let plan = problem.floor_plan.as_deref();
    let (holding, mut tables) = problem.holding();
    let mut files =
        vec![crate::shader!("world.wgsl"), crate::shader!("crowds/set_off.wgsl"), holding, problem.active()];
    files.extend(walls_file(plan));
    let (of, floor) = (problem.clone(), Floor::of(plan));
    let reference = move |host: &Host| {
        let view = crate::visit::View::of(host)?;
        let (bodies, dt) = (view.particles(), host.world().dt);
        let position = host.read(POSITION)?;
        let mut velocity = host.write(VELOCITY)?;
        for me in bodies.iter().filter(|me| me.is_active() && !of.is_held(me.index)) {
            let (wish, own) = (wish_of(me), course_of(me));
            if wish.w >= 0.0 {
                let (x, e) = (position[me.index].truncate().truncate(), own.truncate().truncate());
                let speed = floor.before_contact(x, e, wish.z, own.z * dt) / dt;
                velocity[me.index] = (speed * e).extend(0.0).extend(velocity[me.index].w);
            }
        }
        Ok(())
    };
    let mut sizes = Vec::new();
    let mut constants = Vec::new();
    if let Some(plan) = plan {
        let count = plan.segments().len();
        constants.push(("COUNT", count as f64));
        sizes.push((WALLS.into(), count as u64));
        tables.push(table(plan));
    }
    let pass = Pass { constants, alone: true, ..Pass::new(Shader::join(&files)?, problem.capacity) };
    let (name, scratch) = ("set off".to_owned(), Vec::new());
    Ok(Kernel { name, passes: vec![pass], reference: Some(Arc::new(reference)), sizes, scratch, tables })
}
