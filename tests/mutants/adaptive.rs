//! Stages of adaptive steps: clocks in every state, the limiting particle, and what moves by such a clock.
#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use glam::Vec4;
use motes::error::Error;
use motes::forces::{Component, Law, Problem, Resolved};
use motes::integrators::Adaptive;
use motes::kernel::{
    ALARM, AdaptiveStep, Backend, Kernel, LARGEST_CRITERION, Machine, STEP_CLOCK, STEP_CLOCK_WORDS, STEP_CRITERIA,
    STOP, World,
};
use motes::{Bounds, Gpu, Setup, Simulation, Solver};

use crate::stages::{Device, FEW, Stage, fill, moving, put};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::alone;
use crate::support::states::{force, integrator, vector};
use crate::support::{self, Random};

const ALWAYS_SET: &str = "the host sets every override";
const FAR: &str = "what is farther than two longest steps shortens none";

pub const EQUIVALENT: &[Equivalent] = &[
    same("adaptive.wgsl", "override UNIT: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("adaptive_dt.wgsl", "override UNIT: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("adaptive_dt.wgsl", "override LEAST: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("adaptive_dt.wgsl", "override VISCOUS: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("adaptive_dt.wgsl", "override RECORDS: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("tick_adaptive.wgsl", "override WINDOW: u32 = 16u;", "16u", "17u", ALWAYS_SET),
    same("at_adaptive.wgsl", "override FACTOR: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("limiting_particle.wgsl", "if i < world.count {", "<", "<=", "behind the last particle there is no criterion"),
    same("adaptive_dt.wgsl", "for (var k = 0u; k < 4u;", "<", "<=", "the last one is looked at twice"),
    same("adaptive_dt.wgsl", "for (var k = 0u; k < 4u;", "4u", "5u", "the last one is looked at twice"),
    same("adaptive_dt.wgsl", "} else if whole < 3u {", "<", "<=", FAR),
    same("adaptive_dt.wgsl", "} else if whole < 3u {", "3u", "4u", FAR),
];

pub const MACHINE: Machine = Machine::HOST;
/// As in [`moving`].
pub const DT: f64 = 0.37;
const TICKS: u32 = 1 << 24;
pub const NONE: u32 = u32::MAX;

/// Wants so many steps for viscosity.
#[derive(Clone)]
struct Thick(f64);

impl Component for Thick {
    fn laws(&self) -> Vec<Law> {
        Vec::new()
    }
    fn resolved(&self, _: &Problem) -> Result<Resolved, Error> {
        Ok(Resolved { viscous_steps: Some(self.0), ..Resolved::default() })
    }
}

fn setup(force: Box<dyn Component>, least: f64) -> Setup {
    let adaptive_step = AdaptiveStep { least, courant: 0.3, before: None };
    Setup {
        state: support::cloud(FEW, 11),
        forces: vec![force],
        integrator: Box::new(Adaptive { integrator: integrator("heun"), adaptive_step }),
        dt: DT,
        bounds: Bounds::default(),
        solver: Solver::default(),
    }
}

/// A kernel of a step by its first word, and of several the one of most constants.
fn kernel(setup: &Setup, name: &str) -> Kernel {
    let kernels = setup.plans(MACHINE).expect("plans").step.kernels;
    let named = kernels.into_iter().filter(|kernel| kernel.name.split(' ').next() == Some(name));
    named.max_by_key(|kernel| kernel.name.len()).unwrap_or_else(|| panic!("a step has a {name}"))
}

/// A clock: the time, the ticks of the step, those before, then the alarm, the shortest and the longest.
pub fn words([whole, rest, step, free]: [u32; 4], alarm: u32, [shortest, longest]: [u32; 2]) -> Vec<u32> {
    let mut words: Vec<u32> = (0..STEP_CLOCK_WORDS as u32).map(|k| 70 + 3 * k).collect();
    words[..4].copy_from_slice(&[whole, rest, step, free]);
    words[4..12].copy_from_slice(&[3, 77, alarm, 9, 8, 7, shortest, longest]);
    words
}

pub fn staged(
    stages: &mut Vec<Stage>,
    name: &str,
    mut simulation: Simulation<Gpu>,
    kernel: Kernel,
    clock: &[u32],
    more: impl Fn(&mut Simulation<Gpu>),
) {
    let plan = alone(kernel);
    fill(&mut simulation, &plan);
    put(&mut simulation, STEP_CLOCK, clock);
    more(&mut simulation);
    stages.push(Stage::of(name, simulation, plan));
}

/// What is wanted, the clock, the stop, and what viscosity wants; the shortest step is a 64th.
fn steps(device: &Device, stages: &mut Vec<Stage>) {
    let far = [NONE, 0];
    let free = TICKS;
    let usual = words([5, 3_000_001, 11, free], NONE, [9_000_000, 100]);
    let wide = words([5, 3_000_001, 11, free], NONE, [100, 16_000_000]);
    let low = [0.3, 0.2, 0.1];
    let mut cases = vec![
        ([3.3, 2.1, 1.7], 0.5, usual.clone(), far),
        ([2.1, 3.7, 1.2], 2.9, usual.clone(), far),
        ([1.3, 1.2, 1.4], 2.9, wide.clone(), far),
        ([1.3, 1.2, 4.4], 3.1, usual.clone(), far),
        ([2.5, 2.5, 2.5], 2.5, wide.clone(), far),
        ([1.2, 2.5, 2.5], 2.5, wide.clone(), far),
        ([1.2, 1.1, 2.5], 2.5, wide, far),
        ([1.0, 0.2, 0.3], 0.1, usual.clone(), far),
        (low, 0.1, words([5, 3, 11, 1_000_003], NONE, [1, 2]), far),
        // Just as long as growth allows: 13981014 and a fifth of it.
        (low, 0.1, words([5, 3, 11, 13_981_014], NONE, [1, 2]), far),
        // Just the shortest; shorter; shorter once more.
        ([64.0, 0.2, 0.3], 0.1, usual.clone(), far),
        ([1e5, 0.2, 0.3], 0.1, usual.clone(), far),
        ([1e12, 0.2, 0.3], 0.1, usual.clone(), far),
        ([0.1, 1e5, 0.3], 0.1, words([5, 3, 11, free], 2, [1, 2]), far),
        ([0.1, 0.2, 0.3], 1e5, words([5, 3, 11, free], 3, [1, 2]), far),
    ];
    // A quarter of the longest is 4194304 ticks. Stops: gone by, here, in the step, at its end, in the next, at the end of that.
    let quarter = [4.0, 0.2, 0.3];
    let at = |rest| words([5, rest, 11, free], NONE, [9_000_000, 100]);
    for (rest, stop) in [
        (7, [4, 9]),
        (7, [5, 6]),
        (7, [5, 7]),
        (7, [5, 8]),
        (7, [5, 9]),
        (7, [5, 4_000_000]),
        (7, [5, 4_194_311]),
        (7, [5, 4_194_312]),
        (7, [5, 8_000_000]),
        (7, [5, 8_388_614]),
        (7, [5, 8_388_615]),
        (7, [5, 8_388_616]),
        (16_000_000, [6, 2_000_000]),
        (16_000_000, [6, 5_000_000]),
        (16_000_000, [6, 9_000_000]),
        (16_000_000, [7, 5]),
    ] {
        cases.push((quarter, 0.1, at(rest), stop));
    }
    for (rest, stop) in [(3_000_000, [7, 1_000_000]), (3_000_000, [7, 4_000_000]), (16_777_215, [8, 1]), (5, [6, 3])] {
        cases.push((low, 0.1, at(rest), stop));
    }
    let cases = cases.into_iter().map(|case| (case, 0.0));
    // The error of an integrator: above all others, and just not.
    let errors = [([1.3, 1.2, 2.4], 2.5), ([1.3, 2.5, 2.4], 2.5), ([0.1, 0.2, 0.3], 1.0), ([0.1, 0.2, 0.3], 1.25)]
        .map(|(wants, error)| ((wants, 0.1, usual.clone(), far), error));
    for (case, ((wants, viscous, clock, stop), error)) in cases.chain(errors).enumerate() {
        let kernel = kernel(&setup(Box::new(Thick(viscous)), DT / 64.0), "adaptive");
        staged(stages, &format!("adaptive dt {case}"), moving(device, FEW, None), kernel, &clock, |simulation| {
            let most = Vec4::new(wants[0], wants[1], wants[2], error);
            put(simulation, LARGEST_CRITERION, &[most]);
            put(simulation, STOP, &stop);
        });
    }
    // Fewer ticks than digits, about as many, and none.
    for (case, ticks) in [1500.3f32, 2047.2, 2049.7, 4095.3, 4099.6, 0.3].into_iter().enumerate() {
        let kernel = kernel(&setup(Box::new(Thick(0.1)), 1e-6 * DT), "adaptive");
        staged(
            stages,
            &format!("adaptive dt of few ticks {case}"),
            moving(device, FEW, None),
            kernel,
            &usual,
            |simulation| {
                put(simulation, LARGEST_CRITERION, &[Vec4::new(TICKS as f32 / ticks, 0.2, 0.3, 0.0)]);
                put(simulation, STOP, &far);
            },
        );
    }
}

/// The limiting particle: of each reason, of none, with an alarm of now and of before.
fn limiting(device: &Device, stages: &mut Vec<Stage>) {
    let mut random = Random::new(5);
    let mut step_criteria: Vec<Vec4> = (0..FEW).map(|_| random.vector().as_vec3().abs().extend(0.0)).collect();
    // Each is the most of some: two, two of which one is the last, the last alone.
    for (part, ids) in [[40, 377], [20, FEW - 1], [FEW - 1, FEW - 1]].into_iter().enumerate() {
        for id in ids {
            step_criteria[id][part] = 2.5;
        }
    }
    let clock = pollster::block_on(moving(device, FEW, None).backend().world()).expect("a clock");
    for reason in 0..7 {
        for (case, [alarm, field]) in
            [[NONE, 0], [clock.step, 1], [clock.step, 2], [clock.step, 4], [clock.step + 1, 1]].into_iter().enumerate()
        {
            let mut state = words([5, 3, 11, 12], alarm, [1, 2]);
            (state[4], state[5], state[7]) = (reason, NONE, field);
            state[8] = if case % 2 == 0 { NONE } else { 25 };
            let kernel = kernel(&setup(Box::new(Thick(0.1)), DT / 64.0), "limiting");
            staged(
                stages,
                &format!("limiting particle {reason} {case}"),
                moving(device, FEW, None),
                kernel,
                &state,
                |simulation| {
                    put(simulation, STEP_CRITERIA, &step_criteria);
                    put(simulation, LARGEST_CRITERION, &[Vec4::new(2.5, 2.5, 2.5, 0.0)]);
                },
            );
        }
    }
}

/// What time it is, and when a step ends.
fn clocks(device: &Device, stages: &mut Vec<Stage>) {
    let setup = || {
        let mut setup = setup(Box::new(Thick(0.1)), DT / 64.0);
        let adaptive_step = setup.integrator.adaptive_step().expect("adaptive steps");
        setup.integrator = Box::new(Adaptive { integrator: integrator("forest_ruth"), adaptive_step });
        setup.forces.push(force("goal", &[("velocity", vector(0.2, 0.3, -0.1))]));
        setup
    };
    for clock in [[3, 5_000_003, 7_000_001, 9], [0, 16_000_000, 16_777_216, 9]] {
        let state = words(clock, NONE, [1, 2]);
        staged(stages, "at, adaptive", moving(device, FEW, None), kernel(&setup(), "at"), &state, |_| ());
        for (case, [now, before]) in [[3.1f32, 1.3], [2.6, 1.3], [1.2, 1.3]].into_iter().enumerate() {
            for step in [14, 15, 16] {
                let mut simulation = moving(device, FEW, None);
                let world = pollster::block_on(simulation.backend().world()).expect("a clock");
                simulation.backend().set_world(World { step, ..world }).expect("a clock");
                let alarm = [NONE, NONE, NONE, 5, 6, now.to_bits(), before.to_bits(), 4];
                staged(
                    stages,
                    &format!("tick, adaptive, {case} {step}"),
                    simulation,
                    kernel(&setup(), "tick"),
                    &state,
                    |it| {
                        put(it, ALARM, &alarm);
                    },
                );
            }
        }
    }
    for ticks in [0, 1] {
        let state = words([3, 5_000_003, ticks, 9], NONE, [1, 2]);
        staged(
            stages,
            "tick, adaptive, of nothing",
            moving(device, FEW, None),
            kernel(&setup(), "tick"),
            &state,
            |_| (),
        );
    }
}

pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    steps(device, stages);
    limiting(device, stages);
    clocks(device, stages);
}
