//! Stages of the list of neighbours: built for the first time, kept, and built again because of one particle.

#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use glam::{DVec3, DVec4, Vec4};
use motes::forces::{Law, Over, Problem};
use motes::kernel::{ALARM, Backend, Elastic, LIFE, ListShape, Machine, Plan, Source, World};
use motes::links::{Link, Links};
use motes::neighbors::{LIST_STATE, List};
use motes::{Bounds, Gpu, POSITION, Side, Simulation};

use crate::curious::{MOVING, law};
use crate::stages::{Device, FEW, Stage, fill, moving, put};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::subgroups_of_eight;
use crate::support::{self, Random, Shared};

const LANES: Machine = Machine { software: false, subgroup: 0, invocations: 1 << 18, ..Machine::HOST };
const EIGHT: Machine = Machine { software: true, subgroup: 8, invocations: 256, ..Machine::HOST };
const RANGE: f64 = 0.4;
const SKIN: f64 = 0.25;
/// Of 500 particles in a volume of 10 one has 57 neighbours within 0.65: four and a half deviations more, in a multiple of four.
const ROOM: u32 = 96;
/// For about half of them.
const TIGHT: u32 = 56;

const ALWAYS_SET: &str = "the host sets every override";
const EDGE: &str = "no pair lies exactly at the edge";
const LAST_DIGITS: &str = "a millionth of a coordinate, for what a wrap rounds away";
const ALL_KNOW: &str = "all layers and lanes hold the same value, so any of them may write it";
const NOT_ASKED: &str = "it is not asked for";
const MORE: &str = "it does more than is asked for, and the same";

pub const EQUIVALENT: &[Equivalent] = &[
    same("list_search", "override REACH: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("list_search", "override ROOM: u32 = 4u;", "4u", "5u", ALWAYS_SET),
    same("list_order", "override ROOM: u32 = 4u;", "4u", "5u", ALWAYS_SET),
    same("list_moved", "override LIMIT: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("list_decide", "override WORDS: u32 = 0u;", "0u", "1u", ALWAYS_SET),
    same("neighbors/history", "override SLOTS: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("visit/list", "override RANGE: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("visit/list.wgsl", "let near = r.x", "<", "<=", EDGE),
    same("visit/list.wgsl", "for (var n = 0u; n < head.x; n += 4u)", "<", "<=", MORE),
    same(
        "visit/list.wgsl",
        "} else if REMEMBERS && head.y != NONE {",
        "&&",
        "||",
        "without history nothing is forgotten",
    ),
    same("visit/list_plain", "const REMEMBERS: bool = false;", "false", "true", "without history nothing is forgotten"),
    same("history_held", "array<f32, 8>", "8", "9", MORE),
    same("history_held", "{ history_words[word] = 0.0; }", "<", "<=", MORE),
    same("history_held", "history[word_of(", "+", "-", "the half is that of even or of odd steps"),
    same("history_stored", "history[word_of(you.pair", "+", "-", "the half is that of even or of odd steps"),
    same("history_stored", "history[word_of(pair", "+", "-", "the half is that of even or of odd steps"),
    same("list_order", "if 4u * first < end", "*", "/", MORE),
    same("list_order", "if 4u * first < end", "<", "<=", MORE),
    same("visit/list_plain", "fn pair_at", "0u", "1u", NOT_ASKED),
    same("list_order", "if found.x > atomicLoad", ">", ">=", MORE),
    same("list_order", "if group.z == 0u", "==", "!=", ALL_KNOW),
    same("list_order", "if group.z == 0u", "0u", "1u", ALL_KNOW),
    same("list_save", "if group.z == 0u", "==", "!=", ALL_KNOW),
    same("list_save", "if group.z == 0u", "0u", "1u", ALL_KNOW),
    same("list_save", "if first < head.x", "<", "<=", MORE),
    same("list_match", "while old < end", "<", "<=", "behind the last neighbour none is known"),
    same("list_moved", "const ROUNDING: f32", "9.5367431640625e-7", "1.430511474609375e-6", LAST_DIGITS),
    same("list_moved", "let size = max(", "max", "min", LAST_DIGITS),
    same("list_moved", "limit -= ROUNDING", "max", "min", LAST_DIGITS),
    same("list_moved", "limit -= ROUNDING", "-=", "+=", LAST_DIGITS),
    same("list_moved", "limit -= ROUNDING", "*", "/", LAST_DIGITS),
    same("list_moved", "square < limit * limit", "<", "<=", EDGE),
    same("list_moved", "override REACH: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("list_moved", "if limit <= 0.0", "<=", "<", EDGE),
    same("list_moved", "atomicStore(&list_state[0].moved, 1u)", "1u", "2u", "it is set or not"),
    same("list_search", "< REACH * REACH", "<", "<=", EDGE),
    same("list_search", "if (*sum).number < ROOM", "<", "<=", "a row without room for all is empty"),
    same("list_exclude", "while next < end", "<", "<=", "behind the end of a row nothing is left out"),
    same("list_decide", "n += WORKGROUP", "+=", "-=", "there are fewer arguments than lanes"),
    same("list_decide", "if lane == 0u", "==", "!=", ALL_KNOW),
    same("list_decide", "if lane == 0u", "0u", "1u", ALL_KNOW),
];

struct Place<'a> {
    device: &'a Device,
    machine: Machine,
    bounds: Bounds,
    has_inactive: bool,
    capacity: u32,
    slots: u32,
    /// Pairs up to so many bonds apart are left out.
    exclude: u32,
    /// How much longer the sides of the box are after the list was built, where they may change.
    stretch: Option<f64>,
}

/// What happens to particles after the list has been built.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Since {
    /// It has not been.
    Never,
    /// All have moved by less than is borne, two of them in opposite directions by almost so much.
    Little,
    /// The last has moved by more.
    Much,
    /// One has been spawned.
    Spawned,
    /// One has been removed.
    Removed,
    /// It is to be the first again: pairs begin without history.
    First,
}

impl Place<'_> {
    fn plan(&self, problem: &Problem) -> Plan {
        let list = List::new(problem.list.expect("a list"), problem).expect("a list");
        let list = motes::visit::list_kernel(list, problem).expect("a kernel");
        let law = match self.slots {
            0 => law(MOVING, Over::List { range: RANGE, skin: Some(SKIN), slots: 0 }),
            slots => winding(slots),
        };
        let mut plan = Plan::default();
        plan.add(list);
        // A row without room for all is empty, and no law may be judged by it.
        if self.capacity < ROOM {
            return plan;
        }
        plan.add(law.kernel(problem).expect("a kernel"));
        plan
    }
    fn stage(&self, since: Since) -> Stage {
        let count = FEW;
        let mut random = Random::new(5);
        let side = self.bounds.high - self.bounds.low;
        let flat = self.bounds.dimensions == 2;
        let plane = |x: DVec3| if flat { x.with_z(0.0) } else { x };
        let place = |x: DVec3| plane((self.bounds.low + side * (0.5 + 0.5 * x)).as_vec3().as_dvec3());
        let places: Vec<DVec3> = (0..count).map(|_| place(random.vector())).collect();
        let (words, exclude, capacity) = (self.slots, self.exclude, self.capacity);
        let shape = ListShape { range: RANGE, skin: SKIN, tuned: false, words, exclude, capacity };
        let problem = Problem::new(count as u32, self.machine).at(&places, self.bounds);
        let links = if exclude > 0 { bonds(count as u32) } else { Links::default() };
        let problem = problem.tied(&links, &[]);
        let elastic = self.stretch.map(|part| Elastic { least: part.min(0.9), most: 1.1, start: self.bounds.period() });
        let problem = problem.with_life(&[], &[], self.has_inactive).listed(Some(shape)).stretched(elastic);
        let plan = self.plan(&problem);
        let mut simulation = moving(self.device, count, Some(self.machine));
        let clock = pollster::block_on(simulation.backend().world()).expect("a clock");
        let clock = World { bounds: self.bounds, step: clock.step + self.slots % 2, ..clock };
        simulation.backend().set_world(clock).expect("a world");
        fill(&mut simulation, &plan);
        let mass = |i: usize| 0.2 + 0.1 * (i % 3) as f64;
        let mut now: Vec<Vec4> = places.iter().enumerate().map(|(i, x)| x.extend(mass(i)).as_vec4()).collect();
        simulation.write(POSITION, &now).expect("places");
        put(&mut simulation, ALARM, &[u32::MAX; 3]);
        begin(&mut simulation);
        let mut life: Vec<u32> = (0..count as u32).map(|i| if i % 5 == 3 { i % 2 * 2 } else { 1 }).collect();
        if self.has_inactive {
            put(&mut simulation, LIFE, &life);
        }
        if since != Since::Never {
            let program = simulation.backend().compile(&plan).expect("a good plan");
            simulation.backend().run(&program, 1).expect("a run");
            // What it left is read in the next step.
            let part = self.stretch.unwrap_or(1.0);
            let low = self.bounds.low.as_vec3().as_dvec3();
            let high = self.stretch.map_or(self.bounds.high, |part| (low + part * side).as_vec3().as_dvec3());
            let bounds = Bounds { high, ..self.bounds };
            let next = World { step: clock.step + u32::from(self.slots > 0), bounds, ..clock };
            simulation.backend().set_world(next).expect("a world");
            // What lies still in a box that changes moves with it.
            if self.stretch.is_some() {
                let with_box = |x: DVec3| plane(low + part * (x - low));
                now.iter_mut().for_each(|x| *x = with_box(x.truncate().as_dvec3()).as_vec3().extend(x.w));
            }
            let limit = (0.5 * (SKIN + (part - 1.0) * (RANGE + SKIN))).max(0.0) as f32;
            let origin = now[count - 1];
            for (i, x) in now.iter_mut().enumerate() {
                let way = plane(random.vector() * 0.56).as_vec3() * limit;
                // Along one axis each, by all but a hundredth of what is borne.
                let axis = [glam::Vec3::X, glam::Vec3::NEG_Y, glam::Vec3::Z][i % if flat { 2 } else { 3 }];
                *x += (if i % 50 < 3 { 0.99 * limit * axis } else { way }).extend(0.0);
            }
            let last = now.last_mut().expect("some");
            match since {
                Since::Much if flat => *last = origin + limit * Vec4::new(0.8, 0.8, 0.0, 0.0),
                Since::Much => *last = origin + limit * Vec4::new(0.05, 0.8, 0.8, 0.0),
                Since::Spawned => life[count - 2] = 1,
                Since::Removed => life[count - 1] = 2,
                _ => {}
            }
            simulation.write(POSITION, &now).expect("places");
            if self.has_inactive {
                put(&mut simulation, LIFE, &life);
            }
            if since == Since::First {
                begin(&mut simulation);
            }
        }
        Stage::of(&format!("list, {since:?}"), simulation, plan)
    }
}

/// Most of the particles are in chains, some of them in two; the last has none.
fn bonds(count: u32) -> Links {
    let bond = |ends| Link { ends, rest: 0.1, stiffness: 1.0, damping: 0.0, rope: false };
    let steps = [1, 7, 30].into_iter().flat_map(|step| (0..count - step - 1).step_by(2).map(move |i| [i, i + step]));
    Links { springs: steps.map(bond).collect(), ..Links::default() }
}

/// The list is to be built, for the first time.
fn begin(simulation: &mut Simulation<Gpu>) {
    simulation.backend().write_bytes(LIST_STATE, 0, &[0; 16]).expect("a state");
}

/// A law that leaves another number in each slot, where it leaves one.
fn winding(slots: u32) -> Law {
    let wgsl = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
        if (me.index + you.index) % 3u != 1u {
            for (var word = 0u; word < SLOTS; word += 1u) { remember(you, word, recall(you, word) + f32(word + 1u) * r.x); }
        }
        (*sum).acceleration += recall(you, 0u) * r;
        (*sum).potential += recall(you, SLOTS - 1u);
        // There is no such word, and no such pair.
        remember(you, SLOTS, 7.5);
        remember(me, 0u, 2.5);
        (*sum).potential += recall(you, SLOTS) + recall(me, 0u);
    }
    fn acts_on(me: Particle) -> bool { return me.index % 5u != 2u; }
    fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }";
    let last = slots as usize - 1;
    let over = (RANGE, Some(SKIN), slots);
    Law::remembering(
        "winding",
        over,
        Source::ours("winding", wgsl),
        Vec::new(),
        &["acceleration"],
        move |me, you, r, _, memory, sum: &mut DVec4| {
            if me.index % 5 == 2 {
                return;
            }
            if (me.index + you.index) % 3 != 1 {
                (0..=last).for_each(|word| memory.remember(word, memory.recall(word) + (word + 1) as f64 * r.x));
            }
            *sum += (memory.recall(0) * r).extend(memory.recall(last));
        },
        |_, sum, _, outcome| outcome.accelerate(*sum),
    )
}

pub fn all(shared: &Shared, stages: &mut Vec<Stage>) {
    // With as many layers as there are fours of neighbours.
    let device = &pollster::block_on(support::limited(shared, |_| {}));
    let periodic = Bounds::new(DVec3::new(0.125, 3.0, -2.5), DVec3::new(2.125, 5.5, -0.5), Side::Periodic);
    let open = Bounds { sides: [Side::Open; 3], ..periodic };
    let place = |machine, bounds, has_inactive, capacity| Place {
        device,
        machine,
        bounds,
        has_inactive,
        capacity,
        slots: 0,
        exclude: 0,
        stretch: None,
    };
    let lanes = place(LANES, periodic, false, ROOM);
    stages.extend([Since::Never, Since::Little, Since::Much].map(|since| lanes.stage(since)));
    stages.push(place(LANES, open, false, ROOM).stage(Since::Little));
    let has_inactive = place(LANES, open, true, ROOM);
    stages.extend([Since::Never, Since::Spawned, Since::Removed, Since::Little].map(|since| has_inactive.stage(since)));
    // Some have more neighbours than there is room for.
    stages.push(place(LANES, periodic, false, TIGHT).stage(Since::Never));
    // Of an odd step and of an even one.
    let steps = |slots: u32| Place { slots, ..place(LANES, open, true, ROOM) };
    let all = [Since::Never, Since::Little, Since::Much, Since::Spawned, Since::First];
    stages.extend(all.map(|since| steps(2).stage(since)));
    stages.extend([Since::Much, Since::Removed].map(|since| steps(3).stage(since)));
    // As many words as registers hold, and more.
    stages.push(steps(8).stage(Since::Little));
    stages.extend([Since::Little, Since::Much].map(|since| steps(9).stage(since)));
    stages.push(Place { slots: 2, ..place(LANES, periodic, false, ROOM) }.stage(Since::Much));
    // Bonds that leave pairs out.
    stages.push(Place { exclude: 3, ..place(LANES, periodic, false, ROOM) }.stage(Since::Much));
    // Half of the rows have lower ids alone, and the next ones higher ids.
    stages.push(Place { exclude: 1, ..place(LANES, open, false, ROOM) }.stage(Since::Never));
    stages.push(Place { exclude: 2, ..steps(2) }.stage(Since::Spawned));
    // In a box that shrinks and grows, little and so much that no pair is sure to be listed.
    let stretched = |part, room| Place { stretch: Some(part), ..place(LANES, periodic, false, room) };
    // What shrinks is denser, by the cube of that.
    for (part, room) in [(0.9, 132), (1.1, ROOM)] {
        stages.extend([Since::Little, Since::Much].map(|since| stretched(part, room).stage(since)));
    }
    stages.push(stretched(0.6, 448).stage(Since::Little));
    // A plane stays where it is, and its box may be elsewhere.
    let low = DVec3::new(0.125, 3.0, 2.5);
    let plane = Bounds::new(low, low + DVec3::new(4.0, 5.0, 0.0), Side::Periodic);
    for since in [Since::Little, Since::Much] {
        stages.push(Place { stretch: Some(1.1), ..place(LANES, plane, false, ROOM) }.stage(since));
    }
    if subgroups_of_eight(shared) {
        stages.push(place(EIGHT, periodic, false, ROOM).stage(Since::Never));
        stages.push(place(EIGHT, periodic, false, TIGHT).stage(Since::Never));
    }
}
