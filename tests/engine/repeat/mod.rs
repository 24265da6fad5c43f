//! Loops in plans: how often their bodies run, on the device and by the references, and what is refused.

mod toy;

use crate::support::Shared;
use motes::kernel::{Array, Backend, Indirect, Op, Plan};
use motes::{Cpu, Error, Gpu};
use toy::{COUNT, Toy};

/// What a plan leaves: how often lanes worked in the inner loop and in the outer one.
fn left<B: Backend>(backend: &mut B) -> [Vec<u32>; 2] {
    ["work", "marks"].map(|field| {
        match pollster::block_on(backend.read(field, &Array::Uint(Vec::new()), COUNT as usize)).expect("a field") {
            Array::Uint(words) => words,
            other => panic!("{other:?}"),
        }
    })
}

fn gpu(shared: &Shared) -> Gpu {
    Gpu::new(&shared.found.device, &shared.found.queue, COUNT).expect("a GPU")
}

#[test]
fn loops_end_by_their_flags_and_by_their_length() {
    let shared = crate::support::device();
    let mut gpu = gpu(&shared);
    for toy in toy::all() {
        let plan = toy.plan();
        let want = toy.counts().map(|times| vec![2 * times; COUNT as usize]);
        let mut cpu = Cpu::new(COUNT).expect("a CPU");
        let program = cpu.compile(&plan).expect("a program");
        cpu.run(&program, 2).expect("runs");
        assert!(left(&mut cpu) == want, "references, {toy:?}: {:?}", left(&mut cpu).map(|words| words[0]));
        for field in ["work", "marks"] {
            gpu.forget(field);
        }
        let program = gpu.compile(&plan).expect("a program");
        gpu.run(&program, 2).expect("runs");
        let got = left(&mut gpu);
        assert!(got == want, "{toy:?}: {:?} of {want:?}", got.map(|words| words[0]));
    }
}

/// A submission may end anywhere in a loop.
#[test]
fn cut_submissions_change_nothing() {
    let shared = crate::support::device();
    let mut gpu = gpu(&shared);
    let toy = Toy { outer: 4, inner: 3, most: [6, 5] };
    let program = gpu.compile(&toy.plan()).expect("a program");
    gpu.limit_submissions(std::time::Duration::from_nanos(1), std::time::Duration::from_mins(1));
    let before = gpu.submissions();
    // Each that takes longer than that makes the next ones shorter, down to single dispatches.
    (0..20).for_each(|_| gpu.run(&program, 2).expect("runs"));
    gpu.wait().expect("an end");
    assert!(gpu.submissions() - before > 1000, "{} submissions are not cut", gpu.submissions() - before);
    assert!(left(&mut gpu) == toy.counts().map(|times| vec![40 * times; COUNT as usize]));
}

#[test]
fn a_caller_encodes_loops_in_its_own_encoder() {
    let shared = crate::support::device();
    let mut gpu = gpu(&shared);
    let toy = Toy { outer: 2, inner: 4, most: [5, 7] };
    let program = gpu.compile(&toy.plan()).expect("a program");
    let mut encoder = shared.found.device.create_command_encoder(&motes::wgpu::CommandEncoderDescriptor::default());
    gpu.encode(&program, 3, &mut encoder);
    shared.found.queue.submit([encoder.finish()]);
    assert!(left(&mut gpu) == toy.counts().map(|times| vec![3 * times; COUNT as usize]));
}

#[test]
fn a_plan_says_what_it_repeats() {
    let plan = Toy { outer: 2, inner: 4, most: [5, 7] }.plan();
    assert_eq!(plan.to_string(), "start | (repeat ≤ 5: begin | (repeat ≤ 7: work | count) | mark | count outer)");
    assert_eq!(plan.dispatches(), 1 + 5 * (1 + 7 * 2 + 2));
    let names: Vec<_> = plan.steps().map(|kernel| kernel.name.as_str()).collect();
    assert_eq!(names, ["start", "begin", "work", "count", "mark", "count outer"]);
    let Some(Op::Repeat { most: 5, until, .. }) = plan.ops.last() else { panic!("{:?}", plan.ops) };
    assert_eq!((until.field.as_ref(), until.word, until.member), ("state", 1, "outer_done"));
    // Another plan takes it over whole.
    let mut other = Plan::of([toy::work()]);
    other.append(plan);
    assert_eq!(other.to_string().matches("repeat").count(), 2);
    assert_eq!(other.kernels.len(), 6);
}

#[test]
fn loops_that_cannot_end_are_refused() {
    let mut plan = Plan::default();
    for (field, member, body) in [
        ("state", "inner_done", toy::work()),
        ("state", "nothing", toy::count()),
        ("other", "inner_done", toy::count()),
        // It reads the state, and does not write it.
        ("state", "inner_done", toy::look()),
    ] {
        match plan.repeat(3, field, 0, member, Plan::of([body])) {
            Err(Error::Device(text)) => assert!(text.contains(member) && text.contains(field), "{text}"),
            other => panic!("{field} {member}: {other:?}"),
        }
    }
    assert!(plan.is_empty());
}

#[test]
fn indirect_dispatches_stand_outside_of_loops() {
    let mut work = toy::work();
    work.passes[0].indirect = Some(Indirect { field: "workgroups of work".into(), word: 0, rests: false });
    let mut plan = Plan::default();
    plan.repeat(3, "state", 0, "inner_done", Plan::of([work, toy::count()])).expect("a loop");
    let shared = crate::support::device();
    match gpu(&shared).compile(&plan) {
        Err(Error::Device(text)) => assert!(text.contains("indirect arguments") && text.contains("loop"), "{text}"),
        other => panic!("{:?}", other.err()),
    }
}
