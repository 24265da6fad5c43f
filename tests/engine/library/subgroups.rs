//! What a device without subgroups loses, where a tree is walked.

use std::time::Instant;

use motes::kernel::Backend;
use motes::typed::{Gravity, default, plummer};
use motes::{Setup, Simulation, wgpu};

/// Particles, of which a step is timed.
const COUNT: u32 = 40_000;
/// How many times slower it may be at most. Measured 2.4 to 3.3 times with 100 000 particles on lavapipe.
const SLOWER: f64 = 8.0;

#[test]
fn a_tree_is_not_eight_times_slower_without_subgroups() {
    let shared = crate::support::device();
    let adapter = &shared.found.adapter;
    let bare = wgpu::DeviceDescriptor { required_limits: wgpu::Limits::default(), ..Default::default() };
    let (device, queue) = pollster::block_on(adapter.request_device(&bare)).expect("a bare device");
    let gravity = Gravity { softening: 0.05, over: "tree".into(), ..default() };
    let setup = Setup::new(plummer(COUNT).build().expect("stars"), vec![gravity.into()], 0.01);
    let time = |device: &wgpu::Device, queue: &wgpu::Queue| {
        let mut simulation = Simulation::new(device, queue, &setup).expect("a simulation");
        let mut step = || {
            simulation.step(1).and_then(|()| simulation.backend().wait()).expect("a step");
        };
        // The first pays for what later ones have ready.
        step();
        let start = Instant::now();
        step();
        step();
        (start.elapsed().as_secs_f64() / 2.0, simulation.backend().machine().subgroup)
    };
    let ((with, lanes), (without, none)) = (time(&shared.found.device, &shared.found.queue), time(&device, &queue));
    println!("a step of {COUNT}: {with:.3} s with subgroups of {lanes}, {without:.3} s without");
    assert_eq!(none, 0);
    assert!(without < SLOWER * with, "{:.1} times slower", without / with);
}
