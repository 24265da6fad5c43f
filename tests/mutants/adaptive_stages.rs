//! Stages of what moves by a clock of steps that are not all alike, and of what fluids want of their length.

use std::sync::Arc;

use glam::Vec4;
use motes::error::Error;
use motes::forces::{Component, Law, Problem, Resolved};
use motes::integrators::{Adaptive, Step};
use motes::kernel::{AdaptiveStep, Backend, HOME, Machine, Plan, TARGET, World};
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::sph::{self, Limits, Medium, Smoothing};
use motes::{Bounds, Gpu, Setup, Side, Simulation, Solver};

use crate::adaptive::{DT, MACHINE, NONE, staged, words};
use crate::laws::resting;
use crate::stages::{Device, FEW, Stage, put};
use crate::support::fluids::{SPACING, bounds, cloud, fluid};
use crate::support::machines::{alone, subgroups_of_eight};
use crate::support::states::{force, integrator, vector, word};
use crate::support::{Random, Shared};
use crate::{fluids as stages_of_fluids, held};

/// The limits of a fluid without sound.
#[derive(Clone)]
struct Silent;

impl Silent {
    fn medium() -> Medium {
        let (density, spacing, support, smoothing) = (1.3, SPACING, 2.0, Smoothing::Cubic);
        Medium { density, spacing, support, smoothing, sound: 0.0, exponent: 7, negative: false, dimensions: 3 }
    }
}

impl Component for Silent {
    fn laws(&self) -> Vec<Law> {
        Vec::new()
    }
    fn resolved(&self, problem: &Problem) -> Result<Resolved, Error> {
        let none = sph::Friction { alpha: 0.0, viscosity: 0.0, form: sph::Form::Central, wall: 1.0 };
        let viscous_steps = sph::viscous_steps(&Self::medium(), none, problem);
        Ok(Resolved { viscous_steps, ..Resolved::default() })
    }
    fn stage(&self, stage: motes::component::Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        if stage != motes::component::Stage::StepLimit {
            return Ok(());
        }
        let (of, over) = (|_: &Bounds| Ok(Self::medium()), motes::forces::Over::Each);
        sph::limits(&(Arc::new(of) as sph::Boxed), over, Limits { sound: None, alpha: 0.0 }, plan, problem)
    }
}

/// Held ones and solids on their motions.
fn motions(device: &Device, stages: &mut Vec<Stage>) {
    let count = u32::try_from(FEW).expect("few");
    let number = u32::try_from(held::motions().len()).expect("few");
    let by = |id: u32| if id % 3 == 1 { Hold::Target } else { Hold::Motion(id / 3 % number) };
    let led: Vec<Held> = (0..count).map(|id| Held { id, by: by(id) }).collect();
    let adaptive_step = Some(AdaptiveStep { least: DT / 64.0, courant: 0.3, before: None });
    // At 1.13, in a step of 0.22.
    let clock = words([3, 900_001, 10_000_003, 9], NONE, [1, 2]);
    let places = |it: &mut Simulation<Gpu>| {
        let mut random = Random::new(31);
        for field in [HOME, TARGET] {
            let last = |id: usize| [0.7, 1.2, 1.9, 5.3][id % 4];
            let values: Vec<Vec4> = (0..FEW).map(|id| random.vector().as_vec3().extend(last(id))).collect();
            if it.backend().size(field.name) > 0 {
                put(it, field, &values);
            }
        }
    };
    let periodic = Bounds::new(glam::DVec3::new(-0.9, -1.1, -1.0), glam::DVec3::new(0.7, 0.8, 0.9), Side::Periodic);
    let problem = held::problem(&led, periodic).adapted(adaptive_step);
    let mut step = Step::new(&[], problem);
    step.lead();
    for kernel in step.finished().expect("a plan").kernels {
        staged(stages, "lead, adaptive", resting(device, MACHINE, periodic), kernel, &clock, places);
    }
    for (case, motion) in held::motions().into_iter().enumerate() {
        let problem =
            Problem { reached: [0.3, 1.0][case % 2], ..held::problem(&[], Bounds::default()).adapted(adaptive_step) };
        let settings = [
            ("shape", word("sphere")),
            ("motion", Value::Text(motion.name.clone().into())),
            ("radius", Value::Number(0.9)),
            ("position", vector(0.17, -0.33, 0.11)),
            ("restitution", Value::Number(0.3)),
        ];
        let mut plan = Plan::default();
        force("solid", &settings)
            .stage(motes::component::Stage::AfterDrift { factor: 0.7 }, &mut plan, &problem)
            .expect("a kernel");
        for kernel in plan.kernels {
            staged(stages, "solid, adaptive", resting(device, MACHINE, Bounds::default()), kernel, &clock, |_| ());
            // The time is rounded to a tick, which moves the fastest by a place in the last digit.
            let last = stages.pop().map(|stage| stage.slack(2.0));
            stages.extend(last);
        }
    }
    // Over no time a motion moves no particle.
    let mut still = resting(device, MACHINE, periodic);
    let world = pollster::block_on(still.backend().world()).expect("a clock");
    still.backend().set_world(World { dt: 0.0, ..world }).expect("a clock");
    let fixed: Vec<Held> = (0..count).step_by(2).map(|id| Held { id, by: Hold::Fixed }).collect();
    let mut step = Step::new(&[], held::problem(&fixed, periodic));
    step.lead();
    let kernel = step.finished().expect("a plan").kernels.remove(0);
    let velocity = pollster::block_on(still.read(motes::VELOCITY)).expect("velocities");
    let expected = velocity.iter().flat_map(Vec4::to_array).collect();
    stages.push(Stage::new("lead in no time", still, kernel).expected(motes::VELOCITY.name, expected));
}

/// What fluids want, with sound and without.
fn wants(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    let lanes = Machine { software: false, subgroup: 0, invocations: 1 << 18, ..Machine::HOST };
    let eight = Machine { software: true, subgroup: 8, invocations: 256, ..Machine::HOST };
    let machines = if subgroups_of_eight(shared) { vec![lanes, eight] } else { vec![lanes] };
    for machine in machines {
        for silent in [false, true] {
            let adaptive_step = AdaptiveStep { least: 1e-4, courant: 0.3, before: None };
            let forces = if silent { vec![Box::new(Silent) as Box<dyn Component>] } else { vec![fluid(&[])] };
            let setup = Setup {
                // Without fixed particles, a write behind the last one is seen.
                state: cloud(FEW, false, !silent),
                forces,
                integrator: Box::new(Adaptive { integrator: integrator("leapfrog"), adaptive_step }),
                dt: 0.003,
                bounds: bounds(FEW, false, Side::Periodic),
                solver: Solver::default(),
            };
            for kernel in setup.plans(machine).expect("plans").step.kernels {
                if !["fluid closing", "fluid step criterion"].contains(&kernel.name.as_str()) {
                    continue;
                }
                let name = format!("{}, silent {silent}", kernel.name);
                let mut simulation = stages_of_fluids::simulation(device, machine, &setup);
                let mut random = Random::new(41);
                let gpu = simulation.backend();
                // What they make anew held other numbers; fixed ones keep them.
                for field in ["closing", "step_criteria"] {
                    let some: Vec<f32> = (0..gpu.size(field) / 4).map(|_| random.narrow().abs()).collect();
                    gpu.write_bytes(field, 0, bytemuck::cast_slice(&some)).expect("a field");
                }
                stages.push(Stage::of(&name, simulation, alone(kernel)));
            }
        }
    }
}

pub fn all(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    motions(device, stages);
    wants(shared, device, stages);
}
