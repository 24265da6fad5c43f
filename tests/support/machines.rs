//! The variants of `pairs`: machines to pretend to be, and cuts that only very many particles would bring about.

use motes::forces::{Component, Problem, Stage};
use motes::gpu::Gpu;
use motes::kernel::{Access, Bounds, Columns, Kernel, Machine, Pass, Plan, Scalar};

use super::Shared;

/// Machines that bring about each file of `pairs`, in one layer and in many. Subgroups only where the device has them.
pub fn machines(shared: &Shared) -> Vec<(&'static str, Machine)> {
    let machine = |software, subgroup, invocations| Machine { software, subgroup, invocations, ..Machine::HOST };
    let mut all = vec![
        ("tile", machine(false, 0, 1)),
        ("tile in layers", machine(false, 0, 1 << 18)),
        ("loop", machine(true, 0, 1)),
        ("loop in layers", machine(true, 0, 1 << 18)),
    ];
    if subgroups_of_eight(shared) {
        all.extend([("subgroup", machine(true, 8, 1)), ("subgroup in layers", machine(true, 8, 1 << 18))]);
    }
    all
}

/// Machines that bring about each walk of a tree.
pub fn walkers(shared: &Shared) -> Vec<(&'static str, Machine)> {
    let named = |(name, machine): (&'static str, Machine)| match name {
        "loop" => Some(("alone", machine)),
        "tile" | "subgroup" => Some((name, machine)),
        _ => None,
    };
    machines(shared).into_iter().filter_map(named).collect()
}

/// Whether the file for subgroups can run here.
pub fn subgroups_of_eight(shared: &Shared) -> bool {
    let info = shared.found.device.adapter_info();
    let allowed = shared.found.device.features().contains(motes::wgpu::Features::SUBGROUP);
    allowed && info.subgroup_min_size == 8 && info.subgroup_max_size == 8
}

/// The GPU of a test, with sentinels behind every field.
pub fn gpu(shared: &Shared, count: usize) -> Gpu {
    let count = u32::try_from(count).expect("few");
    let mut gpu = Gpu::new(&shared.found.device, &shared.found.queue, count).expect("some particles");
    gpu.pad(5);
    gpu
}

/// The kernels of a force's first law on a machine.
pub fn kernel(force: &dyn Component, count: usize, machine: &Machine) -> Kernel {
    let law = force.laws().into_iter().next().expect("a law");
    law.kernel(&Problem::new(u32::try_from(count).expect("few"), *machine).tied(&super::links(count), &[]))
        .expect("a kernel")
}

/// The kernels of a force: those of its laws, those that keep velocities and positions lawful, and those that end a step.
pub fn kernels(force: &dyn Component, problem: &Problem) -> Vec<Kernel> {
    let problem = &problem.clone().of_columns(Columns::with(force.columns()).expect("columns"));
    let mut all: Vec<_> = force.laws().into_iter().map(|law| law.kernel(problem).expect("a kernel")).collect();
    let mut limits = Plan::default();
    force.stage(Stage::AfterKick, &mut limits, problem).expect("limits");
    // A setting that a test makes up may be refused, and then runs nowhere.
    let _ = force.stage(Stage::AfterDrift { factor: 0.8 }, &mut limits, problem);
    force.stage(Stage::EndOfStep, &mut limits, problem).expect("an end");
    all.extend(limits.kernels);
    all
}

/// The same in a box.
pub fn kernel_in(bounds: Bounds, force: &dyn Component, count: usize, machine: &Machine) -> Kernel {
    let law = force.laws().into_iter().next().expect("a law");
    let problem =
        Problem::new(u32::try_from(count).expect("few"), *machine).at(&[], bounds).tied(&super::links(count), &[]);
    law.kernel(&problem).expect("a kernel")
}

/// A plan of one kernel.
pub fn alone(kernel: Kernel) -> Plan {
    Plan::of([kernel])
}

/// The same meetings in `layers` layers, cut into dispatches that see `slice` sources in each. `kernel` has one pass that
/// evaluates all in one layer; `finish` is the last pass of a kernel in layers.
pub fn cut(kernel: &Kernel, finish: &Pass, count: usize, layers: u32, slice: u32) -> Kernel {
    let count = u32::try_from(count).expect("few");
    let whole = &kernel.passes[0];
    let span = whole.shader.reflection().binding("span").expect("a span").packed.clone();
    let dispatch = |first: u32| {
        let end = (first + layers * slice).min(count);
        let values = [("first", first), ("end", end), ("slice", slice)].map(|(name, n)| (name, Scalar::Uint(n)));
        let mut pass = whole.clone();
        pass.constants.retain(|(name, _)| *name != "WHOLE");
        pass.constants.push(("WHOLE", 0.0));
        pass.uniforms.retain(|(name, _)| *name != "span");
        pass.uniforms.push(("span", span.pack("span", &values).expect("three numbers")));
        pass.threads.layers = layers;
        pass
    };
    let mut passes: Vec<_> = (0..count).step_by((layers * slice) as usize).map(dispatch).collect();
    let mut last = finish.clone();
    last.constants.retain(|(name, _)| *name != "LAYERS");
    last.constants.push(("LAYERS", f64::from(layers)));
    passes.push(last);
    Kernel { passes, sizes: vec![("parts".into(), u64::from(layers * count))], ..kernel.clone() }
}

/// A walk of a tree in dispatches of so many targets, which are whole groups of 32.
pub fn parts(whole: &Pass, count: u32, targets: u32) -> Vec<Pass> {
    let members = &whole.shader.reflection().binding("tree").expect("a tree").packed.members;
    let part = |first: u32| {
        let mut pass = whole.clone();
        let end = (first + targets).min(count);
        let block = &mut pass.uniforms.iter_mut().find(|(name, _)| *name == "tree").expect("a tree").1;
        for (name, n) in [("first", first), ("end", end)] {
            let at = members.iter().find(|member| member.name == name).expect("a member").offset;
            block[at..at + 4].copy_from_slice(&n.to_le_bytes());
        }
        pass.threads.count = whole.threads.count / count.div_ceil(32) * (end - first).div_ceil(32);
        pass
    };
    (0..count).step_by(targets as usize).map(part).collect()
}

/// What is wrong with the uniform blocks of a kernel, if one does not begin with the unused word; see `src/kernel/unused_word.rs`.
pub fn without_unused_word(kernel: &Kernel) -> Option<String> {
    let blocks = || kernel.bindings().map(|(_, binding)| binding).filter(|b| b.access == Access::Uniform);
    let members = |b: &motes::kernel::Binding| b.packed.members.clone();
    let bad = blocks().find(|b| members(b).is_empty() || members(b).iter().any(|member| member.offset < 4))?;
    Some(format!("the block `{}` has a member at offset 0", bad.name))
}
