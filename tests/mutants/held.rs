//! Stages of fixed particles, of the motions that lead them, and of solids that move.

use glam::{DVec3, Vec4};
use motes::forces::Problem;
use motes::kernel::{Backend, HOME, Kernel, Machine, POSITION, Plan, TARGET, World};
use motes::motion::{Held, Hold, Keyframe, Motion};
use motes::settings::Value;
use motes::{Bounds, Gpu, Side, Simulation};

use crate::laws::resting;
use crate::stages::{Device, FEW, Stage, fill, moving, put};
use crate::support::machines::{alone, kernel_in};
use crate::support::states::{force, integrator, vector, word};
use crate::support::{Random, choices};

const MACHINE: Machine = Machine::HOST;
/// As in [`moving`]: after three steps it is 1.11, and the next one ends at 1.48.
const DT: f64 = 0.37;

fn keys(times: &[f64]) -> Vec<Keyframe> {
    let mut random = Random::new(9);
    let key = |time: &f64| Keyframe { time: *time, shift: random.vector(), turn: 2.0 * random.vector() };
    times.iter().map(key).collect()
}

/// Over, not begun, in the middle of many keys, over and over; gently and not; each behind another, so that its own keys
/// are not the first.
pub fn motions() -> Vec<Motion> {
    let motion = |name: &str, times: &[f64], smooth| Motion {
        name: name.to_owned(),
        about: DVec3::new(0.3, -0.2, 0.6),
        keys: keys(times),
        smooth,
        repeat: false,
    };
    // Five times over, and for the first time.
    let mut again = motion("again", &[-3.1, -2.6, -2.2], true);
    again.keys[2] = Keyframe { time: -2.2, ..again.keys[0] };
    again.repeat = true;
    let mut late = motion("late", &[0.9, 1.2, 1.9], false);
    late.keys[2] = Keyframe { time: 1.9, ..late.keys[0] };
    late.repeat = true;
    // Hardly longer than a step.
    let mut quick = motion("quick", &[-0.3, -0.1, 0.15], false);
    quick.keys[2] = Keyframe { time: 0.15, ..quick.keys[0] };
    quick.repeat = true;
    let mut spun = motion("spun", &[0.8, 1.9], false);
    spun.keys[1].turn = spun.keys[0].turn * -3.7;
    vec![
        motion("over", &[0.1, 0.9], false),
        motion("to come", &[2.1, 2.9], false),
        motion("one of many", &[0.2, 0.3, 0.5, 0.6, 0.8, 1.0, 1.2, 1.9, 2.0, 2.2, 2.5], true),
        motion("begun before", &[-2.3, -0.9, 1.7], false),
        again,
        late,
        spun,
        choices::swing(),
        motion("still", &[0.7], false),
        quick,
    ]
}

pub fn problem(held: &[Held], bounds: Bounds) -> Problem {
    let count = u32::try_from(FEW).expect("few");
    Problem::new(count, MACHINE).at(&[], bounds).tied(&motes::links::Links::default(), held).moved(&motions(), DT)
}

/// All particles but some held, as `by` says.
fn held(by: impl Fn(u32) -> Hold) -> Vec<Held> {
    let some = (0..u32::try_from(FEW).expect("few")).rev().filter(|id| id % 7 != 3);
    some.map(|id| Held { id, by: by(id) }).collect()
}

fn staged(name: &str, mut simulation: Simulation<Gpu>, kernel: Kernel) -> Stage {
    let plan = alone(kernel);
    fill(&mut simulation, &plan);
    let gpu = simulation.backend();
    let mut random = Random::new(31);
    let places = |last: &dyn Fn(usize) -> f32, random: &mut Random| -> Vec<Vec4> {
        (0..FEW).map(|id| random.vector().as_vec3().extend(last(id))).collect()
    };
    for (field, count) in [(HOME, gpu.size(HOME.name) / 16), (TARGET, gpu.size(TARGET.name) / 16)] {
        let count = usize::try_from(count).expect("few").min(FEW);
        let values = places(&|id| [0.7, 1.2, 1.9, 5.3][id % 4], &mut random);
        if simulation.backend().size(field.name) > 0 {
            put(&mut simulation, field, &values[..count]);
        }
    }
    Stage::of(name, simulation, plan)
}

pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    let number = u32::try_from(motions().len()).expect("few");
    let mixed = held(|id| match id % 3 {
        0 => Hold::Fixed,
        1 => Hold::Target,
        _ => Hold::Motion(id / 3 % number),
    });
    let all = 0..u32::try_from(FEW).expect("few");
    let all_led: Vec<_> = all.map(|id| Held { id, by: Hold::Motion(id % number) }).collect();
    let periodic = Bounds::new(DVec3::new(-0.9, -1.1, -1.0), DVec3::new(0.7, 0.8, 0.9), Side::Periodic);
    let moves = integrator("symplectic_euler");
    for (held, bounds) in [(&all_led, Bounds::default()), (&mixed, periodic)] {
        let mut step = motes::integrators::Step::new(&[], problem(held, bounds));
        step.lead();
        moves.step(&mut step);
        for kernel in step.finished().expect("a plan").kernels {
            if kernel.name.starts_with("lead") || kernel.name == "hold" {
                let simulation = resting(device, MACHINE, bounds);
                stages.push(staged(&kernel.name.clone(), simulation, kernel));
            }
        }
    }
    let some = held(|_| Hold::Fixed).into_iter().filter(|one| one.id % 2 == 0).collect::<Vec<_>>();
    let mirrors = Bounds::new(DVec3::splat(-0.8), DVec3::splat(0.7), Side::Reflecting);
    for kernel in motes::boundary::kernels(&problem(&some, mirrors)).expect("kernels") {
        let mut simulation = moving(device, FEW, None);
        let clock = pollster::block_on(simulation.backend().world()).expect("a clock");
        simulation.backend().set_world(World { bounds: mirrors, ..clock }).expect("a clock");
        stages.push(staged("mirrors and held ones", simulation, kernel));
    }
    solids(device, &some, periodic, stages);
    // From its line there is a way out of a capsule, whichever way it points; a plane has no images.
    for axis in [vector(0.0, 0.0, 0.9), vector(0.3, 0.4, 0.2)] {
        let mut plan = Plan::default();
        let capsule = force("solid", &[("shape", word("capsule")), ("axis", axis), ("radius", Value::Number(0.3))]);
        capsule
            .stage(motes::component::Stage::AfterDrift { factor: 0.7 }, &mut plan, &problem(&[], Bounds::default()))
            .expect("a kernel");
        for kernel in plan.kernels {
            stages.push(staged("capsule", resting(device, MACHINE, Bounds::default()), kernel));
        }
    }
    for shape in ["plane", "sphere"] {
        let settings =
            [("shape", word(shape)), ("position", vector(0.5, -0.4, 0.3)), ("normal", vector(0.3, 0.5, -0.7))];
        let kernel = kernel_in(periodic, force("obstacle", &settings).as_ref(), FEW, &MACHINE);
        stages.push(staged("obstacle in a box", resting(device, MACHINE, periodic), kernel));
    }
}

/// Every shape on every motion that moves; with some held, in a periodic box, with a drift that goes back.
fn solids(device: &Device, some: &[Held], periodic: Bounds, stages: &mut Vec<Stage>) {
    for (case, motion) in motions().into_iter().enumerate() {
        let shape = motes::solids::SHAPES[case * 3 % 4];
        let settings = [
            ("shape", word(shape)),
            ("motion", Value::Text(motion.name.clone().into())),
            ("radius", Value::Number(0.9)),
            ("size", vector(1.9, 1.3, 1.6)),
            ("axis", vector(0.3, 0.9, -0.7)),
            ("normal", vector(0.3, 0.5, -0.7)),
            ("position", vector(0.17, -0.33, 0.11)),
            ("restitution", Value::Number(0.3)),
            ("thickness", Value::Number(0.2)),
        ];
        let held = if case % 2 == 0 { some } else { &[] };
        let bounds = if case % 3 == 1 { periodic } else { Bounds::default() };
        let problem = Problem { reached: [0.3, 1.0][case % 2], ..problem(held, bounds) };
        let mut plan = Plan::default();
        force("solid", &settings)
            .stage(motes::component::Stage::AfterDrift { factor: [0.7, -0.4][case % 2] }, &mut plan, &problem)
            .expect("a kernel");
        for kernel in plan.kernels {
            let mut simulation = resting(device, MACHINE, bounds);
            // Fast, so that a bounce goes a good part of the way.
            let v: Vec<Vec4> = pollster::block_on(simulation.read(motes::VELOCITY)).expect("velocities");
            let fast: Vec<Vec4> = v.iter().map(|v| *v * Vec4::splat(2.7).with_w(1.0)).collect();
            simulation.write(motes::VELOCITY, &fast).expect("velocities");
            let places: Vec<Vec4> = pollster::block_on(simulation.read(POSITION)).expect("places");
            simulation.write(POSITION, &places).expect("places");
            stages.push(staged(&format!("solid {shape} {}", motion.name), simulation, kernel));
        }
    }
}
