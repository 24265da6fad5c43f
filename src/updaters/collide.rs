//! Collisions of bodies: mergers, and bounces.

use std::borrow::Cow;
use std::sync::Arc;

use glam::{DVec3, DVec4};

use super::{Component, Over, Problem, Properties, Stage};
use crate::component::{Collisions, Largest};
use crate::error::Error;
use crate::kernel::{
    ACCELERATION, ALARM, ALARM_WORDS, Bounds, Column, Field, Host, ID, Kernel, Kind as Element, LIFE, Name, POSITION, POSITION_LOW, Pass, Plan,
    Reference, Shader, Source, VELOCITY, VELOCITY_LOW, World, time,
};
use crate::life::Life;
use crate::primitives::{Items, Operation, rows};
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit::{Law, Outcome, Particle};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("outcome", Kind::Choice(&["merge", "bounce"]), Value::Text(Cow::Borrowed("merge")), "what becomes of two bodies that collide: one body, or two that part"),
    Key::new("restitution", Kind::NotNegative, Value::Number(1.0), "outcome = \"bounce\": the speed at which they part, over that at which they approach, 1 at most: no energy is lost; 0: they keep no speed along their line of centres"),
    Key::new("over", Kind::Choice(&["pairs", "near"]), Value::Text(Cow::Borrowed("pairs")), "how collisions are found: among all pairs, or by a cell list, among those in `range`"),
    Key::new("range", Kind::NotNegative, Value::Number(0.0), "over = \"near\": the largest distance of the centres of bodies that touch; it must be given, and no radius may exceed half of it [length]"),
];

/// The radius of a body.
pub(crate) const RADIUS: Field<f32> = Field::new("collision_radius");
/// The same of an active body, and a number below all radii of another.
const SIZE: Field<f32> = Field::new("collision_size");
const GONE: f64 = -3e38;
/// How far from its place a body may have touched another, and how far any may \[length\].
const BOUND: Field<glam::Vec4> = Field::new("collision_bound");
const REACH: Field<glam::Vec4> = Field::new("collision_reach");
/// The row of the body that comes nearest of those that a body touches, plus 1; 0: none.
const PARTNER: Field<u32> = Field::new("collision_partner");
/// The id of the body that has taken up another, plus 1; 0: none.
const INTO: Field<u32> = Field::new("merged_into");
/// The time of that.
const WHEN: Field<f32> = Field::new("merge_time");

/// The word of the alarm for a body that has outgrown the search.
const OUTGROWN: usize = 14;

/// `collide`: at the end of each step, bodies that touch, |r| < R + R′, merge or bounce. Merging bodies are found on straight paths of the step as well;
/// mass, momentum and the centre of mass are conserved, the volume of the spheres is, and the energy of their motion within it and its spin are lost. The heavier one remains; the other is removed,
/// and its columns `merged_into` and `merge_time` tell by which and when. Bodies that bounce part along their line of centres with e times the
/// speed of their approach. Each body collides with one other in a step, the nearest, if it is that one's nearest, too; others follow in the next.
#[derive(Clone)]
pub struct Collide {
    merges: bool,
    restitution: f64,
    /// The range of the cell list; none: all pairs.
    range: Option<f64>,
    /// The range where it has no use.
    unused: f64,
}

impl Collide {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        let near = settings.text("over") == "near";
        let range = settings.number("range");
        Self {
            merges: settings.text("outcome") == "merge",
            restitution: settings.number("restitution"),
            range: near.then_some(range),
            unused: if near { 0.0 } else { range },
        }
    }
    /// The law that finds the partner of each body.
    fn law(&self, problem: &Problem) -> Law {
        let over = self.range.map_or(Over::Pairs, |range| Over::Near { range, of: None });
        let (holding, tables) = problem.holding();
        let among = match self.range {
            Some(_) => crate::shader!("collide/among_near.wgsl"),
            None => crate::shader!("collide/among_all.wgsl"),
        };
        let (merges, of) = (self.merges, problem.clone());
        let gather = move |me: &Particle, you: &Particle, r: DVec3, world: &World, nearest: &mut Option<Nearest>| {
            let u = you.velocity - me.velocity;
            let approach = r.dot(u);
            let back = if merges && approach > 0.0 { (approach / u.length_squared()).min(world.dt) } else { 0.0 };
            let square = (r - back * u).length_squared();
            let reach = size(me) + size(you);
            let both_held = of.is_held(me.index) && of.is_held(you.index);
            let heavy = me.mass > 0.0 || you.mass > 0.0;
            let meets = reach > 0.0 && heavy && !both_held && (merges || approach < 0.0);
            let nearer = |known: &Nearest| (square, you.index) < (known.square, known.index);
            if square < reach * reach && meets && nearest.as_ref().is_none_or(nearer) {
                *nearest = Some(Nearest { index: you.index, square });
            }
        };
        let finish = move |_: &Particle, nearest: &Option<Nearest>, world: &World, outcome: &mut Outcome| {
            let nearest = nearest.as_ref().filter(|_| world.dt > 0.0);
            outcome.set(PARTNER.name, nearest.map_or(0, |you| row(you.index) + 1));
        };
        let wgsl = crate::shader!("updaters/collide.wgsl");
        Law {
            constants: vec![("MERGES", f64::from(u8::from(self.merges)))],
            beside: vec![holding, among],
            tables,
            ..Law::computing("collide", over, wgsl, Vec::new(), &[], gather, finish)
        }
    }
    /// The kernels that find the partner of each body.
    fn search(&self, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        plan.add(self.prepared(problem)?);
        if self.range.is_none() {
            let (bound, reach) = (Name::from(BOUND.name), Name::from(REACH.name));
            let most = rows(Operation::Max, Items::Vec4, &bound, &reach, problem.capacity, &problem.machine)?;
            plan.add(Kernel { name: "collide reach".to_owned(), ..most });
        }
        let law = self.law(problem);
        if let Some((grid, moving)) = law.grid(problem)? {
            plan.add(grid.kernel(problem, moving)?);
        }
        let mut kernel = law.kernel(&in_parts(problem))?;
        let rows = u64::from(problem.capacity);
        kernel.sizes.extend([(SIZE.name.into(), rows), (PARTNER.name.into(), rows)]);
        kernel.sizes.extend(self.range.is_none().then(|| (REACH.name.into(), 1)));
        plan.add(kernel);
        Ok(())
    }
    /// The kernel that prepares the search.
    fn prepared(&self, problem: &Problem) -> Result<Kernel, Error> {
        let paths = f64::from(u8::from(self.merges));
        let reference = move |host: &Host| {
            let (world, is_active) = (host.world(), host.is_active()?);
            let (velocity, radius) = (host.read(VELOCITY)?, host.read(RADIUS)?);
            let (mut size, mut bound) = (host.write(SIZE)?, host.write(BOUND)?);
            for row in 0..world.count as usize {
                let reach = radius[row] + paths * world.dt * velocity[row].truncate().length();
                let active = is_active(row);
                size[row] = if active { radius[row] } else { GONE };
                bound[row] = if active { DVec4::X * reach } else { DVec4::ZERO };
            }
            Ok(())
        };
        let files = [crate::shader!("world.wgsl"), problem.active(), crate::shader!("collide/prepare.wgsl")];
        let constants = vec![("PATHS", paths)];
        let shader = Shader::join(&files)?;
        let kernel = Kernel::new("collide prepare", shader, constants, problem.capacity, Arc::new(reference));
        let rows = [RADIUS.name, SIZE.name, BOUND.name].map(|name| (name.into(), u64::from(problem.capacity)));
        Ok(Kernel { name: "collide prepare".to_owned(), sizes: rows.to_vec(), ..kernel })
    }
}

/// The same problem with fewer sources in a dispatch of a software adapter, where each may be one iteration for each target of an invocation:
/// with four of them these are half of what lavapipe allows.
fn in_parts(problem: &Problem) -> Problem {
    let mut problem = problem.clone();
    if problem.machine.software {
        problem.machine.meetings = problem.machine.meetings.min(8192 * u64::from(problem.capacity));
    }
    problem
}

/// The nearest of the others that a body touches.
struct Nearest {
    index: usize,
    square: f64,
}

fn row(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}

fn size(body: &Particle) -> f64 {
    body.scalar(SIZE.name).unwrap_or(GONE)
}

/// The part of the mass of two bodies that the other one has, where a fixed one has all of it.
fn weight(problem: &Problem, position: &[DVec4], i: usize, j: usize) -> f64 {
    match [i, j].map(|row| problem.is_held(row)) {
        [true, _] => 0.0,
        [_, true] => 1.0,
        _ => position[j].w / (position[i].w + position[j].w),
    }
}

/// The pairs of rows that collide, each once.
fn pairs(host: &Host) -> Result<Vec<[usize; 2]>, Error> {
    let partner = host.read(PARTNER)?;
    let other = |i: usize| (partner[i] as usize).checked_sub(1);
    let mutual = |i: usize| other(i).filter(|j| *j > i && other(*j) == Some(i));
    Ok((0..partner.len()).filter_map(|i| mutual(i).map(|j| [i, j])).collect())
}

/// The radius of a sphere with the volume of two.
fn of_both(a: f64, b: f64) -> f64 {
    (a.powi(3) + b.powi(3)).cbrt()
}

/// A kernel that runs over all rows.
fn kernel(name: &str, files: Vec<Source>, problem: &Problem, reference: Reference) -> Result<Kernel, Error> {
    let mut all = vec![crate::shader!("world.wgsl"), crate::shader!("collide/pair.wgsl")];
    all.extend(files);
    let tables = problem.hold(&mut all);
    let shader = Shader::join(&all)?;
    let pass = Pass { constants: problem.constants(&shader), ..Pass::new(shader, problem.capacity) };
    let (sizes, scratch) = (vec![(PARTNER.name.into(), u64::from(problem.capacity))], Vec::new());
    Ok(Kernel { name: name.to_owned(), passes: vec![pass], reference: Some(reference), sizes, scratch, tables })
}

/// The same kernel with more constants.
fn with(mut kernel: Kernel, constants: &[(&'static str, f64)]) -> Kernel {
    kernel.passes.iter_mut().for_each(|pass| pass.constants.extend_from_slice(constants));
    kernel
}

/// The files with the motion of bodies, in one word or two.
fn motion(problem: &Problem, [single, double]: [Source; 2]) -> Vec<Source> {
    if problem.precision.is_double() { vec![crate::shader!("integrators/two_sum.wgsl"), double] } else { vec![single] }
}

/// Adds the low words of a field, where there are any, to its numbers, and sets those of some rows to zero: references keep all digits in the
/// high words.
fn joined(host: &Host, field: Field<glam::Vec4>, low: Field<glam::Vec4>, rows: &[usize]) -> Result<(), Error> {
    if !host.contains(low.name) {
        return Ok(());
    }
    let (mut high, mut low) = (host.write(field)?, host.write(low)?);
    for row in rows {
        high[*row] += low[*row].with_w(0.0);
        low[*row] = DVec4::ZERO;
    }
    Ok(())
}

/// The low word of a position.
fn low(host: &Host, row: usize) -> Result<DVec4, Error> {
    if host.contains(POSITION_LOW.name) { Ok(host.read(POSITION_LOW)?[row]) } else { Ok(DVec4::ZERO) }
}

fn merged(problem: &Problem) -> Result<Kernel, Error> {
    let all = problem.clone();
    let reference = move |host: &Host| {
        let bounds = host.world().bounds;
        let pairs = pairs(host)?;
        for [first, second] in pairs {
            let held = [first, second].map(|row| all.is_held(row));
            let stays = if held[0] || held[1] {
                held[0]
            } else {
                let position = host.read(POSITION)?;
                position[first].w >= position[second].w
            };
            let [i, j] = if stays { [first, second] } else { [second, first] };
            joined(host, POSITION, POSITION_LOW, &[i])?;
            joined(host, VELOCITY, VELOCITY_LOW, &[i, j])?;
            let low = low(host, j)?;
            let (mut position, mut velocity) = (host.write(POSITION)?, host.write(VELOCITY)?);
            let (mut acceleration, mut life) = (host.write(ACCELERATION)?, host.write(LIFE)?);
            let part = weight(&all, &position, i, j);
            let way = bounds.shortest((position[j] + low - position[i]).truncate());
            let change = (velocity[j] - velocity[i]).truncate();
            position[i] = (position[i].truncate() + part * way).extend(position[i].w + position[j].w);
            velocity[i] = (velocity[i].truncate() + part * change).extend(of_both(velocity[i].w, velocity[j].w));
            acceleration[i] = acceleration[i].lerp(acceleration[j], part);
            life[j] = Life::Removed.word();
            position[j].w = 0.0;
            velocity[j] = DVec4::ZERO.with_w(velocity[j].w);
            acceleration[j] = DVec4::ZERO;
        }
        Ok(())
    };
    let words = [crate::shader!("collide/single.wgsl"), crate::shader!("collide/two_words.wgsl")];
    let own = [
        crate::shader!("nearest_image.wgsl"),
        crate::shader!("collide/volume.wgsl"),
        crate::shader!("collide/weight.wgsl"),
        crate::shader!("collide/merge.wgsl"),
    ];
    kernel("collide merge", [motion(problem, words), own.to_vec()].concat(), problem, Arc::new(reference))
}

/// `largest`: the largest radius for the range of the search, if there is one.
fn recorded(problem: &Problem, largest: Option<f64>) -> Result<Kernel, Error> {
    let all = problem.clone();
    let reference = move |host: &Host| {
        let end = time(host, &all, 1.0)?;
        let ids = if host.contains(ID.name) { Some(host.read(ID)?) } else { None };
        let is_active = host.is_active()?;
        let (mut radius, mut into, mut when) = (host.write(RADIUS)?, host.write(INTO)?, host.write(WHEN)?);
        let mut alarm = host.write(ALARM)?;
        for [first, second] in pairs(host)? {
            let [stays, goes] = if is_active(first) { [first, second] } else { [second, first] };
            radius[stays] = of_both(radius[stays], radius[goes]);
            if largest.is_some_and(|largest| radius[stays] > largest) {
                alarm[OUTGROWN] = alarm[OUTGROWN].min(row(stays));
            }
            into[goes] = 1 + ids.as_ref().map_or(row(stays), |ids| ids[stays]);
            when[goes] = end;
        }
        Ok(())
    };
    let files = vec![
        problem.active(),
        problem.naming(),
        problem.clock(),
        crate::shader!("collide/volume.wgsl"),
        crate::shader!("collide/record.wgsl"),
    ];
    let mut constants = problem.clock_constants();
    constants.push(("LARGEST", largest.unwrap_or(f64::from(f32::MAX))));
    let mut kernel = with(kernel("collide record", files, problem, Arc::new(reference))?, &constants);
    kernel.sizes.extend(problem.clock_sizes());
    kernel.sizes.push((ALARM.name.into(), ALARM_WORDS as u64));
    Ok(kernel)
}

fn bounced(problem: &Problem, restitution: f64) -> Result<Kernel, Error> {
    let all = problem.clone();
    let reference = move |host: &Host| {
        let bounds = host.world().bounds;
        let pairs = pairs(host)?;
        joined(host, VELOCITY, VELOCITY_LOW, pairs.as_flattened())?;
        let (position, mut velocity) = (host.read(POSITION)?, host.write(VELOCITY)?);
        for [i, j] in pairs {
            let way = position[j] + low(host, j)? - position[i] - low(host, i)?;
            let n = bounds.shortest(way.truncate()).normalize();
            let push = (1.0 + restitution) * (velocity[j] - velocity[i]).truncate().dot(n) * n;
            velocity[i] += (weight(&all, &position, i, j) * push).extend(0.0);
            velocity[j] -= (weight(&all, &position, j, i) * push).extend(0.0);
        }
        Ok(())
    };
    let words = [crate::shader!("collide/kick_single.wgsl"), crate::shader!("collide/kick_two_words.wgsl")];
    let own = [
        crate::shader!("nearest_image.wgsl"),
        crate::shader!("collide/weight.wgsl"),
        crate::shader!("collide/bounce.wgsl"),
    ];
    let kernel = kernel("collide bounce", [motion(problem, words), own.to_vec()].concat(), problem, Arc::new(reference))?;
    Ok(with(kernel, &[("RESTITUTION", restitution)]))
}

impl Component for Collide {
    fn columns(&self) -> Vec<Column> {
        let radius = Column::new(RADIUS.name, Element::Scalar, "length", "of the sphere that collides").required();
        let into = Column::new(INTO.name, Element::Whole, "", "the id of the body that has taken it up, plus 1; 0: none");
        let when = Column::new(WHEN.name, Element::Scalar, "time", "when that was");
        if self.merges { vec![radius, into, when] } else { vec![radius] }
    }
    fn properties(&self) -> Properties {
        let (loses, turns) = if self.merges { (vec!["mergers"], vec!["mergers"]) } else { (vec!["bounces"], Vec::new()) };
        let dissipates = if self.merges || self.restitution < 1.0 { loses } else { Vec::new() };
        let limit = match self.range {
            Some(range) => (0.5 * range, "it is half of the `range` of collide, in which collisions are searched: choose a larger range, or over = \"pairs\""),
            None => (-0.3 * GONE, "single precision ends there"),
        };
        let largest = vec![Largest { column: RADIUS.name, value: limit.0, why: limit.1 }];
        let restitution = (!self.merges).then_some(self.restitution);
        let collides = Some(Collisions { restitution, range: self.range });
        Properties { collides, removes: self.merges, dissipates, turns, largest, ..Properties::default() }
    }
    fn check(&self, _: &Bounds) -> Result<(), Error> {
        let refuse = |why: String| Err(Error::Setting { key: "range", why });
        let restitution = self.restitution;
        let refuse_part = |why: String| Err(Error::Setting { key: "restitution", why });
        if restitution > 1.0 {
            return refuse_part(format!("bodies would part {restitution} times as fast as they approach, and gain energy: give 1 at most"));
        }
        if self.merges && restitution < 1.0 {
            return refuse_part(format!("restitution = {restitution} is that of outcome = \"bounce\", and these bodies merge: set it, or leave the restitution out"));
        }
        match self.range {
            Some(range) if range <= 0.0 => refuse("over = \"near\" searches bodies in `range`, which is missing: give twice the largest radius that a body may have".to_owned()),
            None if self.unused > 0.0 => refuse(format!("range = {} is that of over = \"near\", and all pairs are searched: set it, or leave the range out", self.unused)),
            _ => Ok(()),
        }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        if stage != Stage::EndOfStep {
            return Ok(());
        }
        self.search(plan, problem)?;
        if self.merges {
            plan.add(merged(problem)?);
            plan.add(recorded(problem, self.range.map(|range| 0.5 * range))?);
        } else {
            plan.add(bounced(problem, self.restitution)?);
        }
        Ok(())
    }
}
