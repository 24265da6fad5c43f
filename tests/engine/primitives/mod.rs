//! The primitives against their references: both variants, at sizes around every seam, for inputs that are awkward.

mod reductions;
mod scans;
mod sorts;
mod speed;

use crate::support::Shared;
use crate::support::machines::{alone, gpu};
use motes::Gpu;
use motes::kernel::{Backend, Kernel, Machine};
use motes::lockstep::compare;

/// The variants: for GPUs, and for software adapters.
const MACHINES: [(&str, Machine); 2] = [
    ("gpu", Machine { software: false, subgroup: 0, invocations: 1 << 18, ..Machine::HOST }),
    ("software", Machine { software: true, subgroup: 0, invocations: 256, ..Machine::HOST }),
];

/// A device of its own for every kernel, since a field has one length for good.
fn device(shared: &Shared, machine: Machine) -> Gpu {
    let mut gpu = gpu(shared, 1);
    gpu.pretend(machine);
    gpu
}

/// Runs a kernel on inputs beside its reference. Whether it changed anything.
fn agree(gpu: &mut Gpu, kernel: &Kernel, inputs: &[(&str, &[u32])], of: &str) -> bool {
    let plan = alone(kernel.clone());
    gpu.compile(&plan).unwrap_or_else(|e| panic!("{of}: {e}"));
    for (name, words) in inputs {
        gpu.write_bytes(name, 0, bytemuck::cast_slice(words)).expect("a field");
    }
    let verdicts = pollster::block_on(compare(gpu, &plan, 1)).unwrap_or_else(|e| panic!("{of}: {e}"));
    assert!(!verdicts.is_empty(), "{of}: nothing was compared");
    for verdict in &verdicts {
        assert!(verdict.good(), "{of}: {verdict:?}");
    }
    verdicts.iter().any(|verdict| verdict.changed)
}

/// Words that repeat from run to run, over all 32 bits.
fn random(count: usize, seed: u64) -> Vec<u32> {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let next = |_| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        u32::try_from(state >> 32).expect("half of the bits")
    };
    (0..count).map(next).collect()
}

/// Inputs that are awkward, by name: sums wrap, order is there or turned round, all are one.
fn awkward(count: usize) -> Vec<(&'static str, Vec<u32>)> {
    let rising: Vec<u32> = (0..u32::try_from(count).expect("few")).map(|i| 3 * i + 1).collect();
    vec![
        ("random", random(count, 17)),
        ("equal", vec![7; count]),
        ("rising", rising.clone()),
        ("falling", rising.into_iter().rev().collect()),
        ("maximal", vec![u32::MAX; count]),
    ]
}
