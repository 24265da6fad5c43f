//! Stages of positions and velocities in two words.

use std::sync::Arc;

use motes::Setup;
use motes::forces::Component;
use motes::integrators::Precise;
use motes::kernel::{ALARM, Backend, Kernel, Precision, QUIET};

use crate::stages::{Device, FEW, Stage, moving, put};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::alone;
use crate::support::states::{force, integrator};
use crate::support::{self, Random};

const ALWAYS_SET: &str = "every kernel sets it";

pub const EQUIVALENT: &[Equivalent] = &[
    same("kick_drift_compensated.wgsl", "override KICK: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("kick_drift_compensated.wgsl", "override DRIFT: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("prove_sums.wgsl", "abs(a) > abs(b)", ">", ">=", "the summands differ"),
    same("prove_sums.wgsl", "&& all(fast.high", "&&", "||", "both sums have the same result"),
    same("compensated.wgsl", "REST: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
];

/// Small, so that a step is small beside positions and what they lose by rounding shows; and not one of single precision.
const DT: f64 = 0.001_3;

/// The kernels of a method in two words.
fn kernels(device: &Device, method: &str) -> Vec<Kernel> {
    let machine = moving(device, 1, None).backend().machine();
    let forces: Vec<Box<dyn Component>> = vec![force("uniform", &[])];
    let integrator = Precise { integrator: integrator(method), precision: Precision::Compensated };
    let setup = Setup { integrator: Box::new(integrator), ..Setup::new(support::cloud(FEW, 11), forces, DT) };
    let plans = setup.plans(machine).expect("plans");
    plans.start.kernels.into_iter().chain(plans.step.kernels).collect()
}

/// The kernel of a step that has this file as its last.
fn of(kernels: &[Kernel], file: &str) -> Kernel {
    let runs = |kernel: &&Kernel| kernel.passes[0].shader.sources().iter().any(|source| source.file.ends_with(file));
    kernels.iter().find(runs).unwrap_or_else(|| panic!("a step runs {file}")).clone()
}

/// The part of a step that single precision lacks, and the low words of velocities beside the high ones, here: large, so that they show beside
/// the rounding of a product. What the shader leaves out, the product of both, is below that.
const LACKING: f64 = 3e-4;

/// A stage with low words; those of positions are less than half a last place of numbers around 1.
#[expect(clippy::cast_possible_truncation, reason = "as the device holds them")]
fn stage(device: &Device, name: &str, mut kernel: Kernel) -> Stage {
    let short = ((1.0 - LACKING) * DT) as f32;
    let constants = &mut kernel.passes[0].constants;
    for (factor, rest) in [("FACTOR", "REST"), ("KICK", "KICK_REST"), ("DRIFT", "DRIFT_REST")] {
        let known = constants.iter().find(|(name, _)| *name == factor).map(|(_, value)| *value);
        let Some((known, entry)) = known.zip(constants.iter_mut().find(|(name, _)| *name == rest)) else { continue };
        entry.1 = known * DT - f64::from(known as f32 * short);
    }
    let mut simulation = moving(device, FEW, None);
    let plan = alone(kernel);
    simulation.backend().compile(&plan).expect("a good plan");
    let mut random = Random::new(29);
    let mut words = |size: f32| -> Vec<f32> {
        (0..4 * FEW).map(|n| if n % 4 == 3 { 0.0 } else { size * random.narrow() }).collect()
    };
    for (field, size) in [("position_low", 3e-8), ("velocity_low", LACKING as f32), ("acceleration", 1.7)] {
        let values = words(size);
        if plan.fields(1).contains_key(field) {
            simulation.backend().write_bytes(field, 0, bytemuck::cast_slice(&values)).expect("a field");
        }
    }
    let world = pollster::block_on(simulation.backend().world()).expect("a clock");
    simulation.backend().set_world(motes::kernel::World { dt: f64::from(short), ..world }).expect("a clock");
    Stage::of(name, simulation, plan)
}

pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    // A kick, drifts, and kicks with drifts, by factors that are no numbers of single precision.
    let (leapfrog, pefrl) = (kernels(device, "leapfrog"), kernels(device, "pefrl"));
    for (all, file) in [
        (&pefrl, "drift_compensated.wgsl"),
        (&pefrl, "kick_drift_compensated.wgsl"),
        (&leapfrog, "/kick_compensated.wgsl"),
    ] {
        stages.push(stage(device, file, of(all, file)));
    }
    // Sums that are right in all but one component of one of the vectors.
    let prove = of(&leapfrog, "prove_sums.wgsl");
    let (name, words) = prove.tables[0].clone();
    for wrong in std::iter::once(None).chain((0..16).map(Some)) {
        let mut kernel = prove.clone();
        let mut words = words.to_vec();
        let folded = wrong.is_some_and(|place| place >= 8 && place % 4 != 3);
        if let Some(place) = wrong {
            if place < 8 {
                continue;
            }
            words[place] = (f32::from_bits(words[place]) * 0.5 + 0.25).to_bits();
        }
        kernel.tables[0] = (name.clone(), Arc::new(words));
        let mut simulation = moving(device, FEW, None);
        put(&mut simulation, ALARM, &QUIET);
        let mut alarm = QUIET.map(f32::from_bits).to_vec();
        if folded {
            alarm[10] = f32::from_bits(1);
        }
        let stage = Stage::of(&format!("prove sums, {wrong:?}"), simulation, alone(kernel));
        stages.push(stage.expected(ALARM.name, alarm));
    }
}
