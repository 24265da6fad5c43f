//! Stages of births and deaths, and of kernels that skip particles that are not active.

#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use glam::DVec3;
use motes::forces::{Over, Problem};
use motes::integrators::Step;
use motes::kernel::{Backend, Kernel, LIFE, Machine, Plan, World};
use motes::life::{Birth, Drain};
use motes::motion::{Held, Hold};
use motes::render::absent;
use motes::settings::Value;
use motes::solids::Solid;
use motes::{Bounds, Gpu, POSITION, Side, Simulation};

use crate::curious::{CHOOSY, MOVING, OTHERS, STILL, law};
use crate::stages::{Device, FEW, Stage, fill, moving, put, stage};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::{alone, subgroups_of_eight};
use crate::support::states::force;
use crate::support::{Random, Shared};

const MACHINE: Machine = Machine::HOST;
const EIGHT: Machine = Machine { software: true, subgroup: 8, invocations: 256, ..Machine::HOST };
/// Mutants that do the same.
pub const EQUIVALENT: &[Equivalent] = &[
    same("life/drain.wgsl", "if i < world.count", "<", "<=", "behind the last word of life stands none that says 1"),
    same("life/drain.wgsl", "if params.side *", "*", "/", "a quotient has the sign of the product"),
];
/// Now, and a step: a 64th of a step later is a number that f32 holds.
const TIME: f64 = 1.125;
const STEP: f64 = 0.5;
const SOON: f64 = TIME + STEP / 64.0;

/// Each kind, no two neighbours alike more often than others.
fn life() -> Vec<u32> {
    (0..FEW).map(|id| [1, 0, 2, 1, 1, 0, 2][id % 7]).collect()
}

/// Due or not, waiting or not, one of them on the edge, and one right behind it; in no order.
fn births() -> Vec<Birth> {
    let mut random = Random::new(17);
    let single = |x: f64| f64::from(x as f32);
    let mut birth = |k: u32| Birth {
        id: k * 37 % FEW as u32,
        time: single(0.7 + 0.006 * f64::from(k)),
        velocity: random.vector().as_vec3().as_dvec3(),
        mass: single(1.5 + random.next()),
        guided: 0.0,
        emitter: 0,
    };
    let mut births: Vec<Birth> = (0..120).map(&mut birth).collect();
    let waiting: Vec<usize> = (0..120).filter(|k| births[*k].id % 7 == 1).collect();
    births[waiting[0]].time = SOON;
    births[waiting[1]].time = single(SOON + 0.003);
    // Some are free now, some have been, some will be.
    for (k, birth) in births.iter_mut().enumerate() {
        birth.guided = (TIME - birth.time).max(0.0) * [1.0, 0.5, 1.5][k % 3];
    }
    births
}

fn drains(bounds: &Bounds, edge: DVec3) -> Vec<Drain> {
    let near = DVec3::new(0.17, -0.33, 0.11);
    let solids = [
        Solid::Sphere(0.9),
        Solid::Box(DVec3::new(1.9, 1.3, 1.6)),
        Solid::Plane(DVec3::new(0.3, 0.5, -0.7).normalize()),
        Solid::Capsule(DVec3::new(0.3, 0.9, -0.7), 0.5),
    ];
    let mut drains: Vec<Drain> = solids
        .into_iter()
        .zip([false, true, false, true])
        .map(|(solid, outside)| Drain { solid, position: near, outside, species: outside.then_some(1) })
        .collect();
    drains.push(Drain { solid: Solid::Plane(DVec3::X), position: edge, outside: false, species: None });
    if bounds.has(Side::Periodic) {
        // Across the seam.
        for drain in &mut drains {
            drain.position += DVec3::new(0.7, 0.6, -0.8);
        }
        drains.pop();
    }
    drains
}

fn with_life(machine: Machine, bounds: Bounds, held: &[Held]) -> Problem {
    let links = motes::links::Links::default();
    Problem::new(FEW as u32, machine).at(&[], bounds).tied(&links, held).with_life(&[], &[], true)
}

fn staged(name: &str, mut simulation: Simulation<Gpu>, bounds: Bounds, plan: Plan) -> Stage {
    fill(&mut simulation, &plan);
    let clock = pollster::block_on(simulation.backend().world()).expect("a clock");
    let clock = World { time: TIME, dt: STEP, bounds, ..clock };
    simulation.backend().set_world(clock).expect("a clock");
    if plan.kernels.len() > 1 {
        // Slots that become free later hold another particle first.
        put(&mut simulation, LIFE, &[1; FEW]);
        let gpu = simulation.backend();
        let program = gpu.compile(&plan).expect("a good plan");
        gpu.run(&program, 1).expect("a run");
    }
    put(&mut simulation, LIFE, &life());
    Stage::of(name, simulation, plan)
}

pub fn all(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    let few = |machine| moving(device, FEW, Some(machine));
    let some: Vec<_> = (0..FEW as u32).filter(|id| id % 5 == 2).map(|id| Held { id, by: Hold::Fixed }).collect();
    // Random numbers by ids that are no rows.
    let named = Problem::new(FEW as u32, MACHINE).with_ids(true);
    let wander = force("wander", &[]).laws().remove(0).kernel(&named).expect("a kernel");
    stages.push(stage("wander by ids", few(MACHINE), wander));
    let periodic = Bounds::new(DVec3::new(-0.9, -1.1, -1.0), DVec3::new(0.7, 0.8, 0.9), Side::Periodic);
    let edge = pollster::block_on(few(MACHINE).read(POSITION)).expect("places")[3].truncate().as_dvec3();
    for (bounds, held) in [(Bounds::default(), &[][..]), (periodic, &some[..])] {
        let problem = with_life(MACHINE, bounds, held).with_life(&births(), &drains(&bounds, edge), true);
        let mut step = Step::new(&[], problem);
        step.evaluate();
        step.populate();
        for kernel in step.finished().expect("a plan").kernels {
            let ours = ["spawn", "rest", "guide", "drain"].iter().any(|name| kernel.name.starts_with(name));
            if ours {
                stages.push(staged(&kernel.name.clone(), few(MACHINE), bounds, alone(tabled(kernel))));
            }
        }
    }
    stages.push(staged("absent", few(MACHINE), Bounds::default(), alone(absent(FEW as u32).expect("a kernel"))));
    passing_by(device, &some, stages);
    searches(shared, device, stages);
}

/// A birth more in the table than are spawned.
fn tabled(kernel: Kernel) -> Kernel {
    if !["spawn", "guide"].contains(&kernel.name.as_str()) {
        return kernel;
    }
    let mut all = births();
    // A pending particle that is due; or an active one whose slot does not become free soon.
    let kind = if kernel.name == "spawn" { 1 } else { 3 };
    let id = (kind..FEW as u32).step_by(7).find(|id| all.iter().all(|birth| birth.id != *id));
    all.push(Birth { id: id.expect("another particle"), time: 0.3, guided: 9.0, ..all[0] });
    let table = std::sync::Arc::new(motes::life::table(&all));
    Kernel { sizes: vec![("births".into(), all.len() as u64)], tables: vec![("births".into(), table)], ..kernel }
}

/// What moves every particle but those that are not active.
fn passing_by(device: &Device, held: &[Held], stages: &mut Vec<Stage>) {
    let mirrors = Bounds::new(DVec3::splat(-0.8), DVec3::splat(0.7), Side::Reflecting);
    for held in [held, &[]] {
        let problem = with_life(MACHINE, mirrors, held);
        let mut plan = Plan::default();
        let limits = [("min", Value::Number(0.3)), ("max", Value::Number(0.6))];
        force("speed_limit", &limits).stage(motes::component::Stage::AfterKick, &mut plan, &problem).expect("a kernel");
        force("solid", &[("radius", Value::Number(0.9))])
            .stage(motes::component::Stage::AfterDrift { factor: 0.7 }, &mut plan, &problem)
            .expect("a kernel");
        plan.kernels.extend(motes::boundary::kernels(&problem).expect("kernels"));
        for kernel in plan.kernels {
            let name = format!("{} of inactive", kernel.name);
            stages.push(staged(&name, moving(device, FEW, None), mirrors, alone(kernel)));
        }
    }
}

/// Searches of a grid in which some are not.
fn searches(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    let machines = [MACHINE].into_iter().chain(subgroups_of_eight(shared).then_some(EIGHT));
    for machine in machines {
        let near = Over::Near { range: 0.4, of: None };
        let one = Over::Near { range: 0.4, of: Some(OTHERS + 1) };
        for (text, over) in [(MOVING, near), (STILL, near), (STILL, Over::Nearest { count: 5 }), (CHOOSY, one)] {
            let problem = with_life(machine, Bounds::default(), &[]);
            let law = law(text, over);
            let (grid, moves) = law.grid(&problem).expect("a range").expect("a grid");
            let kernels = vec![grid.kernel(&problem, moves).expect("a grid"), law.kernel(&problem).expect("a search")];
            let plan = Plan::of(kernels);
            let simulation = moving(device, FEW, Some(machine));
            stages.push(staged(&format!("{} of the living", over.name()), simulation, Bounds::default(), plan));
        }
    }
}
