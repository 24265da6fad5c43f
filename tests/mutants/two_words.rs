//! Stages of differences of positions of two words, and of compensated sums over all pairs.

use glam::{DVec3, DVec4, Vec4};
use motes::forces::{Law, Over, Problem};
use motes::kernel::{Backend, Kernel, Machine, POSITION, Precision, Source};
use motes::settings::Value;
use motes::tree::{Opening, Tree};

use crate::stages::{Device, FEW, Stage, moving, stage};
use crate::support::equivalents::Equivalent;
use crate::support::machines::{kernels, machines};
use crate::support::states::force;
use crate::support::{self, Random, Shared};

pub const EQUIVALENT: &[Equivalent] = &[];

/// Three blocks of sources.
const MANY: usize = 384;

/// Masses add up along an axis, for those particles alone that are light; and an energy of as much.
const MASSES: &str = "
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    if abs(me.mass) < 0.5 {
        (*sum).acceleration += you.mass * vec3f(1.0, -2.0, 4.0);
        (*sum).potential += f32(abs(you.mass) < 0.5);
    }
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }
";

fn masses(over: Over) -> Law {
    let rule = |me: &motes::forces::Particle, you: &motes::forces::Particle, _: DVec3| -> DVec4 {
        let light = |mass: f64| f64::from(u8::from(mass.abs() < 0.5));
        light(me.mass) * (you.mass * DVec3::new(1.0, -2.0, 4.0)).extend(light(you.mass))
    };
    Law::between("masses", over, Source::ours("masses", MASSES), Vec::new(), rule)
}

fn machine(invocations: u32) -> Machine {
    Machine { software: true, subgroup: 0, invocations, ..Machine::HOST }
}

fn problem(count: usize, machine: Machine) -> Problem {
    Problem::new(u32::try_from(count).expect("few"), machine).precise(Precision::DoubleSingle)
}

/// Sources of which the first and the last are so heavy, and cancel, that all others are lost where sums are plain: they are less than
/// half a last place of the first.
fn sums(device: &Device, stages: &mut Vec<Stage>) {
    let wide = Over::Within { range: 1e3 };
    // Each source; each block, of which the heavy ones are alone in theirs; and layers.
    for (over, each, invocations) in [
        (Over::Pairs, true, 1),
        (wide, true, 1),
        (Over::Pairs, false, 1),
        (Over::Pairs, true, 1 << 18),
        (Over::Pairs, false, 1 << 18),
    ] {
        let machine = machine(invocations);
        let mut kernel = masses(over).kernel(&problem(MANY, machine)).expect("a kernel");
        let set = |kernel: &mut Kernel| {
            let constants = kernel.passes.iter_mut().flat_map(|pass| &mut pass.constants);
            constants.filter(|(name, _)| *name == "EACH").for_each(|(_, value)| *value = f64::from(u8::from(each)));
        };
        set(&mut kernel);
        let mut simulation = moving(device, MANY, Some(machine));
        let mut random = Random::new(31);
        let mut place = |mass: f32| Vec4::new(random.narrow(), random.narrow(), random.narrow(), mass);
        let tiny = 2f32.powi(-27);
        let mass = |k: usize| match (k, k / 128) {
            (5, _) => 1.0,
            (300, _) => -1.0,
            (_, 1) => tiny * (1.0 + (k % 7) as f32),
            _ if each => tiny * (1.0 + (k % 5) as f32),
            _ => 0.0,
        };
        let bodies: Vec<Vec4> = (0..MANY).map(|k| place(mass(k))).collect();
        simulation.write(POSITION, &bodies).expect("bodies");
        stages.push(stage(&format!("sums, each {each}, {invocations}"), simulation, kernel));
    }
}

/// Low words as large as positions: pairs, springs of both kinds of tables, and the places of a tree.
fn differences(device: &Device, stages: &mut Vec<Stage>) {
    let links = support::links(FEW);
    let machine = machine(1);
    let problem = problem(FEW, machine).tied(&links, &[]);
    for name in ["gravity", "spring"] {
        for kernel in kernels(
            force(name, &[("over", Value::Text("pairs".into()))][..usize::from(name == "gravity")]).as_ref(),
            &problem,
        ) {
            stages.push(stage(&format!("{name} in two words"), moving(device, FEW, Some(machine)), kernel));
        }
    }
    let tree = Tree::new(Opening::Geometric { theta: 0.5 }, 0.0, &problem);
    let places = tree.kernels(&problem).expect("kernels").into_iter().find(|kernel| kernel.name.starts_with("places"));
    for free in [0, 3] {
        let mut simulation = moving(device, FEW, Some(machine));
        let count = u32::try_from(FEW).expect("few");
        simulation.backend().set_rows(count - free, free).expect("rows");
        stages.push(stage("places", simulation, places.clone().expect("places")));
    }
}

/// Each visit of all pairs, with blocks of its own targets, of others, and one that is not full.
fn visits(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    let count = MANY + 10;
    for (name, machine) in machines(shared).into_iter().filter(|(name, _)| !name.contains("layers")) {
        let problem = problem(count, machine);
        for kernel in kernels(force("gravity", &[]).as_ref(), &problem) {
            stages.push(stage(&format!("{name} in two words"), moving(device, count, Some(machine)), kernel));
        }
    }
}

pub fn all(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    sums(device, stages);
    visits(shared, device, stages);
    differences(device, stages);
}
