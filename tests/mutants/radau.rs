//! Stages of steps along the nodes of Radau's quadrature.

use std::cell::RefCell;
use std::rc::Rc;

use glam::Vec4;
use motes::integrators::{Adaptive, Precise};
use motes::kernel::{
    ACCELERATION, AdaptiveStep, Backend, Element, Field, Kernel, LARGEST_CRITERION, Precision, STEP_CLOCK, World,
};
use motes::{Gpu, Setup, Simulation};

use crate::adaptive::{MACHINE, words};
use crate::stages::{Device, FEW, Stage, fill, moving, put};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::alone;
use crate::support::states::{force, integrator};
use crate::support::{self, Random};

const ALWAYS_SET: &str = "every kernel sets it";
const BEYOND: &str = "nothing is beyond the last difference, or it is not used";
const CHANCE: &str = "they are equal by chance alone";

pub const EQUIVALENT: &[Equivalent] = &[
    same("radau/move", "override H: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("radau/rest_even", "override REST: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("radau/rest_adaptive", "override UNIT_REST: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("radau/settle", "override ROUNDING: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("radau/settle", "override NOISE: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("radau/settle", "let idle =", "1.0", "1.5", "there is a whole number of iterations"),
    same("radau/settle", "let idle =", "<=", "<", CHANCE),
    same("radau/decide", "override UNIT: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("radau/decide", "override TOLERANCE: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("radau/decide", "override NOISE: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("radau/decide", "if error > 0.0", ">", ">=", "of no error it makes infinity, which is too much"),
    same("radau/decide", "let accepted =", ">=", ">", CHANCE),
    same("radau/decide", "if !(accepted", ">=", ">", CHANCE),
    same("radau/node", "override AT: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("radau/differences", "0.0, 0.056", "0.0", "1.0", "no sum has a factor of the start"),
    same("radau/two_product", "let c =", "4097.0", "6145.5", "the digits are divided in nearly the same place"),
    same("radau/begin", "var power: array<vec3f, 8>;", "8", "9", BEYOND),
    same("radau/begin", "{ power[k + 1u] = differences[k]; }", "<", "<=", BEYOND),
    same("radau/begin", "for (var k = DIFFERENCES - 1u; k > 0u", "-", "+", BEYOND),
    same("radau/begin", "for (var k = 1u; k < DIFFERENCES; k += 1u) {", "<", "<=", BEYOND),
    same("radau/begin", "{ all[k] = power[k + 1u]; }", "<", "<=", BEYOND),
    same("radau/begin", "let known =", ">", ">=", "a step has a length"),
    same("radau/begin", "let ratio =", "0.0", "1.0", "what is not known is not used"),
];

/// The step, which is no number of single precision.
const DT: f64 = 0.37;
const DIFFERENCES: Field<Vec4> = Field::new("acceleration_differences");
const START: Field<Vec4> = Field::new("step_start");
const STEP: Field<f32> = Field::new("radau_step");
const LARGEST: Field<Vec4> = Field::new("radau_largest");
const ITERATION: &str = "radau_iteration";

/// The kernels of a step.
fn kernels(is_adaptive: bool, precision: Precision, dt: f64) -> Vec<Kernel> {
    let method = integrator("gauss_radau");
    let adaptive_step = AdaptiveStep { least: 1e-6 * dt, courant: 0.25, before: None };
    let method = if is_adaptive { Box::new(Adaptive { integrator: method, adaptive_step }) } else { method };
    let integrator = Box::new(Precise { integrator: method, precision });
    let setup = Setup { integrator, ..Setup::new(support::cloud(FEW, 11), vec![force("uniform", &[])], dt) };
    setup.plans(MACHINE).expect("plans").step.kernels
}

fn named(kernels: &[Kernel], name: &str) -> Kernel {
    kernels.iter().find(|kernel| kernel.name == name).unwrap_or_else(|| panic!("a step has `{name}`")).clone()
}

/// What is on a stage: fields with their contents, and the length of the step.
struct Case<'a> {
    step: &'a [f32],
    largest: [f32; 3],
    iteration: [f32; 3],
    dt: f32,
}

const USUAL: Case<'static> =
    Case { step: &[0.31, 1.0, 2.5, 0.0, 9.0], largest: [0.1, 2.3, 0.7], iteration: [1.0, 4.0, 0.05], dt: 0.37 };

fn bytes<T: Element>(values: &[T]) -> &[u8] {
    bytemuck::cast_slice(values)
}

fn staged(
    all: &Rc<RefCell<Simulation<Gpu>>>,
    name: &str,
    kernel: Kernel,
    case: &Case<'_>,
    clock: &[u32],
    more: impl Fn(&mut Simulation<Gpu>),
) -> Stage {
    let plan = alone(kernel);
    let mut simulation = all.borrow_mut();
    fill(&mut simulation, &plan);
    let fields = plan.fields(u32::try_from(FEW).expect("few"));
    let has = |name: &str| fields.contains_key(name);
    let gpu = simulation.backend();
    if has(STEP.name) {
        gpu.write_bytes(STEP.name, 0, bytes(case.step)).expect("a field");
    }
    if has(LARGEST.name) {
        let [change, acceleration, last] = case.largest;
        gpu.write_bytes(LARGEST.name, 0, bytes(&[Vec4::new(change, acceleration, last, 9.0)])).expect("a field");
    }
    if has(ITERATION) {
        gpu.write_bytes(ITERATION, 0, bytes(&case.iteration)).expect("a field");
    }
    if has(STEP_CLOCK.name) {
        gpu.write_bytes(STEP_CLOCK.name, 0, bytes(clock)).expect("a field");
    }
    let world = pollster::block_on(gpu.world()).expect("a clock");
    gpu.set_world(World { dt: f64::from(case.dt), ..world }).expect("a clock");
    more(&mut simulation);
    drop(simulation);
    Stage::amid(name, all, plan)
}

pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    let clock = words([3, 900_001, 10_000_003, 9], 7, [1, 2]);
    let simulation = Rc::new(RefCell::new(moving(device, FEW, Some(MACHINE))));
    let even = kernels(false, Precision::Single, DT);
    let adaptive = kernels(true, Precision::Single, DT);
    // After an accepted step, one that is tried again, none, one that is too short, and just not too short; over no time.
    let lasts = [[0.31, 1.0, 2.5], [0.61, 0.0, 2.5], [0.0, 1.0, 0.0], [0.0924, 1.0, 1.0], [0.0925, 1.0, 1.0]];
    for step in &lasts {
        let name = format!("begin along nodes after {step:?}");
        stages.push(staged(
            &simulation,
            &name,
            named(&even, "begin along nodes"),
            &Case { step, ..USUAL },
            &clock,
            |_| (),
        ));
    }
    for name in ["begin along nodes", "node 7"] {
        let still = Case { dt: 0.0, ..USUAL };
        stages.push(staged(&simulation, &format!("{name} in no time"), named(&even, name), &still, &clock, |_| ()));
    }
    for name in ["node 1", "node 2", "node 4", "node 7", "measure differences", "restart iterations"] {
        stages.push(staged(&simulation, name, named(&even, name), &USUAL, &clock, |_| ()));
    }
    for step in [[0.31, 1.0, 2.5], [0.31, 0.0, 2.5]] {
        let name = format!("end along nodes, {step:?}");
        let case = Case { step: &step, ..USUAL };
        stages.push(staged(&simulation, &name, named(&even, "end along nodes"), &case, &clock, |_| ()));
    }
    // Changes: none, of rounding alone, by no less than before and little, much, less than before, in the first iteration; over no time.
    for (case, (change, iteration, dt)) in [
        (0.0, [0.0, 3.0, 0.5], 0.37),
        (1e-16, [0.0, 3.0, 1e-17], 0.37),
        (4e-12, [0.0, 3.0, 1e-12], 0.37),
        (1e-13, [0.0, 1.0, 1e-13], 0.37),
        (2e-13, [0.0, 0.0, 1e-13], 0.37),
        (2e-13, [0.0, 1.0, 1e-13], 0.37),
        (1e-13, [0.0, 3.0, 1e-12], 0.37),
        (0.3, [0.0, 3.0, 0.1], 0.37),
        (0.3, [0.0, 3.0, 0.1], 0.0),
        // Just the last place: 2⁻⁵³ of the acceleration.
        (2.0 * 0.5 * f32::powi(2.0, -52), [0.0, 3.0, 1.0], 0.37),
    ]
    .into_iter()
    .enumerate()
    {
        let case_of = Case { largest: [change, 2.0, 0.7], iteration, dt, ..USUAL };
        stages.push(staged(&simulation, &format!("settle {case}"), named(&even, "settle"), &case_of, &clock, |_| ()));
    }
    for (case, (done, report)) in [(1.0, [0.0, 9.0]), (0.0, [0.0, 9.0]), (0.0, [2.0, 9.0])].into_iter().enumerate() {
        let step = [0.31, 1.0, 2.5, report[0], report[1]];
        let case_of = Case { step: &step, iteration: [done, 12.0, 0.5], ..USUAL };
        let name = format!("accept {case}");
        stages.push(staged(&simulation, &name, named(&even, "accept"), &case_of, &clock, |_| ()));
    }
    // Errors: none, small, as large as allowed, four times too long and a little less, far too large; not settled; before a stop; over no time.
    let by = |longer: f32| 2.3e-5 / longer.powi(7);
    for (case, (error, done, reason, dt)) in [
        (0.0, 1.0, 7, 0.37),
        (1e-20, 1.0, 7, 0.37),
        (by(1.3), 1.0, 7, 0.37),
        (by(0.6), 1.0, 7, 0.37),
        (by(0.2501), 1.0, 5, 0.37),
        (by(0.2499), 1.0, 5, 0.37),
        (by(0.05), 1.0, 7, 0.37),
        (by(1.3), 0.0, 7, 0.37),
        (by(0.1), 0.0, 7, 0.37),
        (by(1.3), 1.0, 6, 0.37),
        (by(0.7), 1.0, 6, 0.37),
        (by(0.1), 1.0, 6, 0.37),
        (by(0.15), 1.0, 7, 0.37),
        (by(1.3), 1.0, 7, 0.0),
    ]
    .into_iter()
    .enumerate()
    {
        let mut clock = clock.clone();
        clock[4] = reason;
        // The shortest and the longest so far: longer, shorter, neither.
        (clock[10], clock[11]) = [(16_000_000, 1), (3, 16_000_000)][case % 2];
        let step = [0.31, 1.0, 2.5, [0.0, 3.0][case / 2 % 2], 9.0];
        let case_of = Case { step: &step, largest: [0.1, 2.3, error], iteration: [done, 12.0, 0.5], dt };
        stages.push(staged(
            &simulation,
            &format!("decide {case}"),
            named(&adaptive, "decide"),
            &case_of,
            &clock,
            |_| (),
        ));
    }
    // An error beside which that of rounding counts.
    let noisy = Case { largest: [0.1, 2.3e5, 1.3e-6], ..USUAL };
    stages.push(staged(&simulation, "decide amid noise", named(&adaptive, "decide"), &noisy, &clock, |_| ()));
    let criterion = named(&adaptive, "error criterion");
    stages.push(staged(&simulation, "error criterion", criterion, &USUAL, &clock, |simulation| {
        put(simulation, LARGEST_CRITERION, &[Vec4::splat(7.0)]);
    }));
    in_two_words(&simulation, stages);
}

/// The part of the step that single precision lacks, here: large, so that it shows beside the rounding of a product.
const LACKING: f64 = 3e-4;

/// Small steps and forces, beside which what a product loses shows.
fn in_two_words(simulation: &Rc<RefCell<Simulation<Gpu>>>, stages: &mut Vec<Stage>) {
    const SMALL: f64 = 0.001_3;
    let clock = words([3, 900_001, 12_345_344, 9], 7, [1, 2]);
    #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
    let (short, part) = (((1.0 - LACKING) * SMALL) as f32, 12_345_344.0f32 / 16_777_216.0);
    for (is_adaptive, name, accepted, dt) in [
        (false, "begin along nodes", 1.0, short),
        (false, "node 4", 1.0, short),
        (false, "end along nodes", 1.0, short),
        (true, "end along nodes", 1.0, part * short),
        (true, "end along nodes", 0.0, part * short),
    ] {
        let mut kernel = named(&kernels(is_adaptive, Precision::Compensated, SMALL), name);
        let h = kernel.passes[0].constants.iter().find(|(name, _)| *name == "H").expect("a part of the step").1;
        #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
        let single = h as f32;
        for (name, value) in &mut kernel.passes[0].constants {
            match *name {
                "REST" => *value = h * SMALL - f64::from(single * short),
                "UNIT" => *value = f64::from(short),
                "UNIT_REST" => *value = SMALL - f64::from(short),
                _ => {}
            }
        }
        let step = [0.001, accepted, 2.5];
        let label = format!("{name} in two words, {is_adaptive} {accepted}");
        stages.push(staged(simulation, &label, kernel, &Case { step: &step, dt, ..USUAL }, &clock, |simulation| {
            let mut random = Random::new(29);
            let mut vectors = |n: usize, size: f32| -> Vec<Vec4> {
                (0..n).map(|_| (random.vector().as_vec3() * size).extend(0.0)).collect()
            };
            put(simulation, DIFFERENCES, &vectors(7 * FEW, 1e-3));
            // Large velocities, and places to which they bring the particle: what the product of the step and a velocity loses shows there.
            let (mut start, low) = (vectors(6 * FEW, 1.0), vectors(2 * FEW, 1e-3));
            for (i, start) in start.chunks_exact_mut(6).enumerate() {
                start[1] *= 1e5;
                start[0] -= single * dt * start[1];
                start[0].w = 1.5;
                start[1].w = 0.3;
                start[2] *= 1e-3;
                start[3] = low[2 * i];
                start[4] = 3e3 * low[2 * i + 1];
            }
            put(simulation, START, &start);
            if name == "begin along nodes" {
                put(simulation, ACCELERATION, &vectors(FEW, 1e-3));
                for field in [Field::<Vec4>::new("position_low"), Field::new("velocity_low")] {
                    put(simulation, field, &vectors(FEW, 2e-8));
                }
            }
        }));
    }
}
