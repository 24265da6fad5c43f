//! Stages of what walks a tree: every walk over so many bodies that nodes of all kinds occur.

#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use std::cell::RefCell;
use std::rc::Rc;

use glam::{DVec3, DVec4, Vec4};
use motes::forces::{Component, Law, Over, Particle};
use motes::integrators::Step;
use motes::kernel::{ACCELERATION, ALARM, Backend, Kernel, Machine, POSITION, Plan, Problem, QUIET, Source};
use motes::settings::Value;
use motes::tree::Opening;
use motes::{Gpu, Simulation};

use crate::stages::{Device, Stage, moving, put};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::{alone, parts, walkers};
use crate::support::states::{force, word};
use crate::support::{Random, Shared};

const EDGE: &str = "no node is just so far";
const ROOM: &str = "it is more room than there need be";
const ALL_KNOW: &str = "all lanes hold the same value, so any of them may write it";
const DEEP: &str =
    "only trees of more than 131 072 bodies wait in a second word; tests/engine/tree/complete.rs counts one";
const BEHIND: &str = "nothing is delivered to what is behind the last";
const SET_FIRST: &str = "it is set before it is looked at";
const WRITTEN_OVER: &str = "what is written behind the end of a list is written over";
const MARGIN: &str = "a walk stops an iteration or some earlier or later, for which the limit has room";
const WHOLE_LEAVES: &str = "a group is of whole leaves";

pub const EQUIVALENT: &[Equivalent] = &[
    same("tree_geometric", "fn demand_of", "0.0", "1.0", "what a group demands is not read"),
    same("tree_relative", "return d <=", ">", ">=", EDGE),
    same("tree_tile", "for (; i < whole", "<", ">", "the loop after it takes what it leaves"),
    same("tree_tile", "var partial =", "0u", "1u", "the root is a leaf only of its own group"),
    same("tree_tile", "moments_b[lane] =", "0.0", "1.0", "nothing reads it"),
    same("tree_tile", "var<workgroup> votes", "3", "4", ROOM),
    same("tree_tile", "var<workgroup> fars", "2u", "3u", ROOM),
    same("tree_tile", "var<workgroup> leaves", "2u", "3u", ROOM),
    same("tree_tile", "let last =", "-", "+", "a lane without a particle is paired with none"),
    same("tree_tile", "if lane == 0u {", "==", "!=", ALL_KNOW),
    same("tree_tile", "if lane == 0u {", "0u", "1u", ALL_KNOW),
    same("tree_look", "const FAR", "128u", "129u", "sums are divided elsewhere, which rounding may show").sometimes(),
    same("tree_look", "const ROWS", "2u", "3u", ROOM),
    same("tree_look", "s.leaves < NEAR && s.spent", "<", "<=", "sums are divided elsewhere, which rounding may show")
        .sometimes(),
    same("tree_look", "if turn < countOneBits(fars)", "<", "<=", WRITTEN_OVER),
    same("tree_look", "if leaf && rest != 0u", "&&", "||", WRITTEN_OVER),
    same("tree_subgroup", "var ours = select(", "0u", "1u", BEHIND),
    same("tree_subgroup", "let n = subgroupMax(", "0u", "1u", "a node that is listed has a higher number"),
    same("tree_look", "fn begun()", "0u", "1u", MARGIN).sometimes(),
    same("tree_subgroup", "search.spent += 1u;", "1u", "2u", MARGIN).sometimes(),
    same("tree_subgroup", "search.spent += 1u;", "+=", "-=", MARGIN).sometimes(),
    same("tree_subgroup", "let ends =", ">", ">=", MARGIN).sometimes(),
    same("tree_subgroup", "var leaf = 0u;", "0u", "1u", SET_FIRST),
    same("tree_subgroup", "if i >= ours && (i - ours) % LEAF", "-", "+", WHOLE_LEAVES),
    same("tree_subgroup", "let slot = select(leaf * LEAF", "-", "+", WHOLE_LEAVES),
    same("tree_look", "let also =", "-", "+", "what holds the group is nearer than its own side, or it is the root"),
    same("tree_look", "s.waits = (s.waits << ", "24u", "25u", DEEP),
    same("tree_look", "s.waits = (s.waits >> ", "24u", "25u", DEEP),
    same("tree_look", "s.waits = (s.waits >> ", "0u", "1u", "a bit that comes in from above is behind what waits"),
    same("tree_look", "let node_m =", "1u", "2u", "it only is a place to read from"),
    same("tree_look", "let node_n =", "1u", "2u", "it only is a place to read from"),
    same("tree_tile", "var far = 0u;", "0u", "1u", "fields and lists begin with zeros; node 0 is no particle"),
    same("tree_tile", "while top > 0u", ">", ">=", "it turns idly until the driver ends the loop").sometimes(),
    same("tree_alone", "var slot = 0u;", "0u", "1u", SET_FIRST),
    same("tree_alone", "more = node > 1u;", "1u", "2u", "it is odd"),
    same("tree_alone", "if first < last_target()", "<", "<=", BEHIND),
    same("tree_alone", "let last =", "-", "+", BEHIND),
];

/// Nine workgroups in a row, nine times, are two more than these many have groups.
const ROW: u32 = 9;
const MANY: usize = 79 * 32 - 3;

/// Bodies of which half are in a small part of the place, some without mass.
fn bodies(count: usize) -> Vec<Vec4> {
    let mut random = Random::new(43);
    let mass = |i: usize| if i % 11 == 4 { 0.0 } else { (0.3 + 0.01 * (i % 7) as f64) / count as f64 };
    let place = |i: usize, x: DVec3| if i.is_multiple_of(2) { x } else { x * x.length_squared() * 0.3 };
    (0..count).map(|i| place(i, random.vector()).extend(mass(i)).as_vec4()).collect()
}

fn gravity(words: [&'static str; 2], theta: f64, alpha: f64) -> Box<dyn Component> {
    let numbers = [("theta", theta), ("alpha", alpha), ("softening", 0.17), ("g", 1.3)];
    let mut settings: Vec<_> = numbers.iter().map(|(key, x)| (*key, Value::Number(*x))).collect();
    settings.extend([("over", word("tree")), ("kernel", word(words[0])), ("multipoles", word(words[1]))]);
    force("gravity", &settings)
}

/// A law that adds up integers, so that another pair, or a pair evaluated another way, is seen whatever it weighs.
#[derive(Clone)]
struct Counted(Opening);

impl Component for Counted {
    fn laws(&self) -> Vec<Law> {
        let wgsl = "struct Sum { mass: f32, index: f32 }
            fn merge(total: ptr<function, Sum>, part: Sum) { (*total).mass += part.mass; (*total).index += part.index; }
            fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
                (*sum).mass += you.mass;
                if you.mass > 0.0 { (*sum).index += f32(you.index % 1000u); }
                if any(abs(you.position - me.position - r) > vec3f(0.1)) { (*sum).index += 0.5; }
            }
            fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.mass, sum.index, 0.0, 0.0); }";
        let over = Over::Tree { opening: self.0, core: 0.0, auto: false };
        let none = |_: &Particle, _: &Particle, _, (): &mut ()| ();
        let wgsl = Source::ours("counted", wgsl);
        vec![Law::gathering("counted", over, wgsl, Vec::new(), none, |_, (), _| DVec4::ZERO)]
    }
}

/// Bodies a few roundings apart, many at the same places, as many as fill their tree.
fn coincident() -> Vec<Vec4> {
    let mut random = Random::new(53);
    let mut place = || (1e6 + 0.0625 * (1.5 * random.next()).round()) as f32;
    (0..1024).map(|i| Vec4::new(place(), place(), place(), (1 + i % 3) as f32)).collect()
}

/// Bodies on a device, the tree over them, and the kernel that walks it.
struct Scene {
    simulation: Rc<RefCell<Simulation<Gpu>>>,
    walk: Kernel,
}

fn scene(device: &Device, machine: Machine, bodies: &[Vec4], scale: f64, law: Box<dyn Component>) -> Scene {
    let mut simulation = moving(device, bodies.len(), Some(machine));
    let forces = [law];
    let mut step = Step::new(&forces, Problem::new(bodies.len() as u32, machine));
    step.evaluate();
    let plan = step.finished().expect("a plan");
    let program = simulation.backend().compile(&plan).expect("a program");
    simulation.write(POSITION, bodies).expect("bodies");
    let mut random = Random::new(47);
    let mut last: Vec<Vec4> = bodies.iter().map(|_| (random.vector() * scale).extend(0.3).as_vec4()).collect();
    // One group of them has no last acceleration yet.
    last[bodies.len() / 3] = Vec4::ZERO;
    put(&mut simulation, ACCELERATION, &last);
    simulation.backend().run(&program, 1).expect("a run");
    put(&mut simulation, ACCELERATION, &last);
    let walk = plan.kernels.into_iter().find(|kernel| kernel.passes[0].shader.reflection().entry == "walk");
    Scene { simulation: Rc::new(RefCell::new(simulation)), walk: walk.expect("a walk") }
}

impl Scene {
    fn plan(&self) -> Plan {
        alone(self.walk.clone())
    }
    /// The walk with fewer dispatches that continue than it takes.
    fn stopped(&self, rounds: usize) -> Plan {
        let mut kernel = self.walk.clone();
        let mut gone = 0;
        kernel.passes.retain(|pass| {
            gone += usize::from(pass.indirect.is_some());
            pass.indirect.is_none() || gone <= rounds
        });
        alone(kernel)
    }
    /// What a field holds after a plan.
    fn holds(&self, field: &str, words: u64, plan: &Plan) -> Vec<f32> {
        let mut simulation = self.simulation.borrow_mut();
        let last = pollster::block_on(simulation.read(ACCELERATION)).expect("what is there");
        put(&mut simulation, ALARM, &QUIET);
        let gpu = simulation.backend();
        let program = gpu.compile(plan).expect("a program");
        gpu.run(&program, 1).expect("a run");
        let bytes = pollster::block_on(gpu.bytes(field, 0, 4 * words)).expect("a field");
        put(&mut simulation, ALARM, &QUIET);
        put(&mut simulation, ACCELERATION, &last);
        bytemuck::pod_collect_to_vec(&bytes)
    }
    /// A stage that is judged by the bits of a field.
    fn expected(&self, name: &str, field: &'static str, words: u64, plan: Plan) -> Stage {
        let expected = self.holds(field, words, &plan);
        self.stage(name, plan).expected(field, expected)
    }
    /// The walk in dispatches of so many targets.
    fn in_parts(&self, targets: u32) -> Plan {
        let mut kernel = self.walk.clone();
        kernel.passes = parts(&kernel.passes[0], self.simulation.borrow().count(), targets);
        alone(kernel)
    }
    fn stage(&self, name: &str, plan: Plan) -> Stage {
        self.simulation.borrow_mut().write(ALARM, &QUIET).expect("an alarm");
        Stage::amid(name, &self.simulation, plan)
    }
}

/// A dense middle, and few around it: boxes of groups hold the middle, and their targets are far from it.
fn halo(count: usize) -> Vec<Vec4> {
    let mut random = Random::new(59);
    let place = |i: usize, x: DVec3| if i % 4 < 3 { 0.05 * x } else { 2.0 * x + x.normalize() };
    (0..count)
        .map(|i| place(i, random.vector()).extend((0.3 + 0.01 * (i % 7) as f64) / count as f64).as_vec4())
        .collect()
}

/// Walks that stop after a few turns and continue: the agreement with the reference; sums bit for bit, which tell where they
/// stopped; and with too few dispatches the alarm, and how many workgroups would continue.
fn stops(device: &Device, name: &str, machine: Machine, stages: &mut Vec<Stage>) {
    for (case, bodies, law) in [
        ("many", bodies(MANY), gravity(["plummer", "quadrupole"], 0.5, 0.0)),
        ("a halo", halo(1000), gravity(["plummer", "monopole"], 0.7, 0.0)),
    ] {
        let words = 4 * bodies.len() as u64;
        let scene = scene(device, Machine { turns: 230, workgroups: ROW, ..machine }, &bodies, 3.7, law);
        stages.push(scene.stage(&format!("walk {name}, {case}, stopping"), scene.plan()));
        stages.push(scene.expected(&format!("walk {name}, {case}, bits"), ACCELERATION.name, words, scene.plan()));
        for rounds in [1, 3] {
            let plan = || scene.stopped(rounds);
            let silent = scene.holds(ALARM.name, QUIET.len() as u64, &plan())[2].to_bits() == u32::MAX;
            assert!(!silent, "{name}, {case}: it is done after {rounds} rounds");
            let of = |what| format!("walk {name}, {case}, {what} after {rounds} rounds");
            stages.push(scene.expected(&of("alarm"), ALARM.name, QUIET.len() as u64, plan()));
            stages.push(scene.expected(&of("workgroups"), "tree go", 3, plan()));
        }
    }
}

pub fn all(shared: &Shared, stages: &mut Vec<Stage>) {
    let device = &pollster::block_on(crate::support::limited(shared, |limits| {
        limits.max_compute_workgroups_per_dimension = ROW;
    }));
    for (name, machine) in walkers(shared) {
        // The law that compiles fastest is asked first.
        let relative = Opening::Relative { alpha: 0.5, g: 1e-9, theta: 1.0 };
        let geometric = Opening::Geometric { theta: 1.0 };
        // Every leaf is opened, of which the last has two of four bodies, which only one walk evaluates apart.
        let every = (!machine.software).then(|| (Opening::Geometric { theta: 0.01 }, bodies(1022)));
        for (opening, bodies) in [(geometric, coincident()), (relative, coincident())].into_iter().chain(every) {
            let scene = scene(device, machine, &bodies, 3.7, Box::new(Counted(opening)));
            let words = 4 * bodies.len() as u64;
            stages.push(scene.expected(
                &format!("walk {name}, {} counted by {opening}", bodies.len()),
                ACCELERATION.name,
                words,
                scene.plan(),
            ));
        }
        for (case, bodies, law) in [
            // One group, and two of which the last is not whole.
            ("a group", bodies(32), gravity(["plummer", "monopole"], 0.9, 0.0)),
            ("two groups", bodies(37), gravity(["plummer", "monopole"], 0.9, 0.0)),
            ("few", bodies(304), gravity(["plummer", "quadrupole"], 0.7, 0.0)),
            ("many", bodies(MANY), gravity(["plummer", "quadrupole"], 0.5, 0.0)),
            ("relative", bodies(1000), gravity(["plummer", "monopole"], 0.6, 0.03)),
            ("spline", bodies(1000), gravity(["spline", "quadrupole"], 0.8, 0.0)),
            ("a halo", halo(1000), gravity(["plummer", "monopole"], 0.8, 0.0)),
        ] {
            let scene = scene(device, machine, &bodies, 3.7, law);
            stages.push(scene.stage(&format!("walk {name}, {case}"), scene.plan()));
        }
        // Far groups by their mass alone, of particles with softenings of their own.
        let law =
            [("over", "tree"), ("kernel", "spline"), ("multipoles", "monopole")].map(|(key, name)| (key, word(name)));
        let numbers = [("theta", 0.8), ("softening", 0.17), ("g", 1.3)].map(|(key, x)| (key, Value::Number(x)));
        let own = [("individual_softening", Value::Flag(true))];
        let law = force("gravity", &[law.as_slice(), &numbers, &own].concat());
        let soft = scene(device, machine, &bodies(700), 3.7, law);
        let mut random = Random::new(53);
        let softenings: Vec<f32> = (0..700).map(|_| 0.17 * random.narrow().abs()).collect();
        let bytes = bytemuck::cast_slice(&softenings);
        soft.simulation.borrow_mut().backend().write_bytes("softening_length", 0, bytes).expect("softenings");
        stages.push(soft.stage(&format!("walk {name}, softenings"), soft.plan()));
        if machine.software {
            stops(device, name, machine, stages);
        }
        // Ends that are whole groups, and one that is not.
        let scene = scene(device, machine, &bodies(300), 3.7, gravity(["plummer", "quadrupole"], 0.9, 0.0));
        stages.push(scene.stage(&format!("walk {name}, in parts"), scene.in_parts(160)));
    }
}
