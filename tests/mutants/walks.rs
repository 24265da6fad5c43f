//! Stages of what walks a tree: every walk over so many bodies that nodes of all kinds are met.

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

use crate::stages::{Device, Stage, moving};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::{alone, parts, walkers};
use crate::support::states::{force, word};
use crate::support::{Random, Shared};

const EDGE: &str = "no node is just so far";
const ROOM: &str = "it is more room than there need be";
const ALL_KNOW: &str = "all know the same, and whoever says it says the same";
const DEEP: &str = "only trees of more than 131 072 bodies wait in a second word; tests/tree/complete.rs counts one";
const LAST_LEAF: &str = "turns would have to end within the very last leaf";
const NO_GROUP: &str = "a group that is not there only has to stay inside of the fields";
const FILLS: &str = "who only fills a place has no mass";
const SET_FIRST: &str = "it is set before it is looked at";

pub const EQUIVALENT: &[Equivalent] = &[
    same("tree_geometric", "fn demand_of", "0.0", "1.0", "nobody asks what a group demands"),
    same("tree_relative", "return d <=", ">", ">=", EDGE),
    same("tree_tile", "const WAITING", "2u", "3u", ROOM),
    same("tree_tile", "const WAITING", "25u", "26u", ROOM),
    same("tree_tile", "var<workgroup> votes", "3", "4", ROOM),
    same("tree_tile", "var<workgroup> fars", "2u", "3u", ROOM),
    same("tree_tile", "var<workgroup> leaves", "2u", "3u", ROOM),
    same("tree_tile", "let last =", "-", "+", "who is not there is not met, and meets nobody"),
    same("tree_tile", "if lane == 0u {", "==", "!=", ALL_KNOW),
    same("tree_tile", "if lane == 0u {", "0u", "1u", ALL_KNOW),
    same("tree_subgroup", "const FAR", "128u", "129u", ROOM),
    same("tree_subgroup", "var<workgroup> list", "2u", "3u", ROOM),
    same("tree_subgroup", "let first =", "-", "+", NO_GROUP),
    same("tree_subgroup", "let first =", "1u", "2u", NO_GROUP),
    same(
        "tree_subgroup",
        "while more && spent",
        "<=",
        "<",
        "turns are counted in threes here, and it is in the loop within that they end",
    ),
    same("tree_subgroup", "while more && spent", "&&", "||", "it turns idly until turns are spent"),
    same("tree_subgroup", "while more && listed.x", "<", "<=", ROOM),
    same(
        "tree_subgroup",
        "let also =",
        "-",
        "+",
        "what holds the group is nearer than its own side, or it is the root",
    ),
    same("tree_subgroup", "waits = (waits << ", "24u", "25u", DEEP),
    same("tree_subgroup", "waits = (waits >> ", "24u", "25u", DEEP),
    same("tree_subgroup", "waits = (waits >> ", "0u", "1u", "a bit that comes in from above is behind what waits"),
    same("tree_subgroup", "let wide =", "1u", "2u", "it only is a place to read from"),
    same("tree_subgroup", "let shut =", "1u", "2u", "it only is a place to read from"),
    same(
        "tree_subgroup",
        "if far || others && leaf",
        "&&",
        "||",
        "what is written behind the end of a list is written over",
    ),
    same("tree_subgroup", "let n = list[", "-", "+", FILLS),
    same("tree_subgroup", "let leaf = list[", "-", "+", FILLS),
    same("tree_broadcast", "gather(me, Particle(index", "1.0", "1.5", "nobody is there, wherever that is"),
    same("tree_broadcast", "let you = body(", "-", "+", "who is not there is not met"),
    same("tree_broadcast", "let index = tree_id[", "-", "+", "who is not there is not met"),
    same("tree_tile", "var far = 0u;", "0u", "1u", "fields and lists begin with zeros: node 0 of a heap is nobody"),
    same(
        "tree_tile",
        "var near = 0u;",
        "0u",
        "1u",
        "lists begin with zeros, and 0 is no leaf: its particles are behind the last",
    ),
    same("tree_tile", "while top > 0u", ">", ">=", "it turns idly until turns are spent"),
    same("tree_tile", "if top > 0u", "0u", "1u", "turns would have to end with just one node waiting"),
    same("tree_alone", "if k < tree.end {", "<", "<=", "behind the last stands nobody whose id is in the fields"),
    same("tree_alone", "if more || bodies", ">", "<", LAST_LEAF),
    same("tree_alone", "if more || bodies", "0u", "1u", LAST_LEAF),
    same("tree_alone", "var slot = 0u;", "0u", "1u", SET_FIRST),
    same("tree_alone", "more = node > 1u;", "1u", "2u", "it is odd"),
];

/// Nine workgroups in a row, nine times, are two more than these many have groups.
const ROW: u32 = 9;
const MANY: usize = 79 * 32 - 3;

/// The turns that each walk takes for many, at most: with one less there is an alarm.
const TURNS: [(&str, u32); 3] = [("tile", 1724), ("alone", 2602), ("subgroup", 303)];

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

/// A law that adds up whole numbers, so that to meet somebody else, or in another way, is seen whatever it weighs.
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
fn crowd() -> Vec<Vec4> {
    let mut random = Random::new(53);
    let mut place = || (1e6 + 0.0625 * (1.5 * random.next()).round()) as f32;
    (0..1024).map(|i| Vec4::new(place(), place(), place(), (1 + i % 3) as f32)).collect()
}

/// Bodies on a device, the tree over them, and the kernel that walks it.
struct Scene {
    simulation: Rc<RefCell<Simulation<Gpu>>>,
    walk: Kernel,
}

fn scene(device: &Device, machine: Machine, bodies: &[Vec4], felt: f64, law: Box<dyn Component>) -> Scene {
    let mut simulation = moving(device, bodies.len(), Some(machine));
    let forces = [law];
    let mut step = Step::new(&forces, Problem::new(bodies.len() as u32, machine));
    step.evaluate();
    let plan = step.finished().expect("a plan");
    let program = simulation.backend().compile(&plan).expect("a program");
    simulation.write(POSITION, bodies).expect("bodies");
    let mut random = Random::new(47);
    let mut last: Vec<Vec4> = bodies.iter().map(|_| (random.vector() * felt).extend(0.3).as_vec4()).collect();
    // One group of them has felt nothing yet.
    last[bodies.len() / 3] = Vec4::ZERO;
    simulation.write(ACCELERATION, &last).expect("what they felt");
    simulation.backend().run(&program, 1).expect("a run");
    simulation.write(ACCELERATION, &last).expect("what is there already");
    let walk = plan.kernels.into_iter().find(|kernel| kernel.passes[0].shader.reflection().entry == "walk");
    Scene { simulation: Rc::new(RefCell::new(simulation)), walk: walk.expect("a walk") }
}

impl Scene {
    fn with_most(&self, most: u32) -> Plan {
        let mut kernel = self.walk.clone();
        let constants = kernel.passes.iter_mut().flat_map(|pass| &mut pass.constants);
        constants.filter(|(name, _)| *name == "MOST").for_each(|(_, n)| *n = f64::from(most));
        alone(kernel)
    }
    /// What the alarm says after a walk of so many turns at most.
    fn alarm(&self, most: u32) -> Vec<f32> {
        let mut simulation = self.simulation.borrow_mut();
        simulation.write(ALARM, &QUIET).expect("an alarm");
        let gpu = simulation.backend();
        let program = gpu.compile(&self.with_most(most)).expect("a program");
        gpu.run(&program, 1).expect("a run");
        let bytes = pollster::block_on(gpu.bytes(ALARM.name, 0, 4 * QUIET.len() as u64)).expect("an alarm");
        simulation.write(ALARM, &QUIET).expect("an alarm");
        bytemuck::pod_collect_to_vec(&bytes)
    }
    /// The fewest turns that are enough.
    fn turns(&self) -> u32 {
        let (mut few, mut enough) = (1, 3000);
        while enough - few > 1 {
            let middle = u32::midpoint(few, enough);
            if self.alarm(middle)[2].to_bits() == u32::MAX { enough = middle } else { few = middle }
        }
        enough
    }
    /// What everybody counts.
    fn counts(&self) -> Vec<f32> {
        let mut simulation = self.simulation.borrow_mut();
        let last = pollster::block_on(simulation.read(ACCELERATION)).expect("what is there");
        let gpu = simulation.backend();
        let program = gpu.compile(&self.with_most(60_000)).expect("a program");
        gpu.run(&program, 1).expect("a run");
        let felt = pollster::block_on(simulation.read(ACCELERATION)).expect("masses");
        simulation.write(ACCELERATION, &last).expect("what was there");
        felt.iter().flat_map(Vec4::to_array).collect()
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

pub fn all(shared: &Shared, stages: &mut Vec<Stage>) {
    let device = &pollster::block_on(crate::support::limited(shared, |limits| {
        limits.max_compute_workgroups_per_dimension = ROW;
    }));
    for (name, machine) in walkers(shared) {
        // The law that compiles fastest is asked first.
        let openings = [Opening::Geometric { theta: 1.0 }, Opening::Relative { alpha: 0.5, g: 1e-9, theta: 1.0 }];
        for opening in openings {
            let scene = scene(device, machine, &crowd(), 3.7, Box::new(Counted(opening)));
            let told = scene.counts();
            let stage = scene.stage(&format!("walk {name}, counted by {opening}"), scene.with_most(60_000));
            stages.push(stage.told(ACCELERATION.name, told));
        }
        for (case, count, law) in [
            // One group, and two of which the last is not whole.
            ("a group", 32, gravity(["plummer", "monopole"], 0.9, 0.0)),
            ("two groups", 37, gravity(["plummer", "monopole"], 0.9, 0.0)),
            ("few", 300, gravity(["plummer", "quadrupole"], 0.7, 0.0)),
            ("many", MANY, gravity(["plummer", "quadrupole"], 0.5, 0.0)),
            ("relative", 1000, gravity(["plummer", "monopole"], 0.6, 0.03)),
            ("spline", 1000, gravity(["spline", "quadrupole"], 0.8, 0.0)),
        ] {
            let scene = scene(device, machine, &bodies(count), 3.7, law);
            if case != "many" {
                stages.push(scene.stage(&format!("walk {name}, {case}"), scene.with_most(60_000)));
                continue;
            }
            let most = TURNS.iter().find(|(of, _)| *of == name).expect("its turns").1;
            stages.push(scene.stage(&format!("walk {name}, {case}"), scene.with_most(most)));
            let quiet = |most: u32| scene.alarm(most)[2].to_bits() == u32::MAX;
            assert!(quiet(most) && !quiet(most - 1), "{name}: {} turns are the fewest", scene.turns());
            for less in [1, 5, 40] {
                let told = scene.alarm(most - less);
                let stage = scene.stage(&format!("walk {name}, {less} turns too few"), scene.with_most(most - less));
                stages.push(stage.told(ALARM.name, told));
            }
        }
        // Ends that are whole groups, and one that is not.
        let scene = scene(device, machine, &bodies(300), 3.7, gravity(["plummer", "quadrupole"], 0.9, 0.0));
        stages.push(scene.stage(&format!("walk {name}, in parts"), scene.in_parts(160)));
    }
}
