//! Devices with no optional feature and the smallest limits that WebGPU has.

use std::collections::BTreeSet;

use motes::scene::SCENES;
use motes::wgpu::{DeviceDescriptor, Features, Limits};
use motes::{POSITION, Simulation};
use naga::valid::{Capabilities, ValidationFlags, Validator};

use crate::drivers::kernels::{every, fluids, machines};
use crate::support;
use crate::support::scenes::{setup, small};

#[test]
fn kernels_for_machines_without_subgroups_need_no_capability() {
    let mut faults = BTreeSet::new();
    let mut seen = BTreeSet::new();
    for (name, machine) in machines().into_iter().filter(|(_, machine)| machine.subgroup == 0) {
        for (of, kernel) in every(machine) {
            for pass in kernel.passes.iter().filter(|pass| seen.insert(pass.shader.text().to_owned())) {
                let module = naga::front::wgsl::parse_str(pass.shader.text()).expect("it was parsed before");
                let verdict = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&module);
                if let Err(error) = verdict {
                    faults.insert(format!("{of}, {name}: `{}`: {:?}", kernel.name, error.as_inner()));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
    assert!(seen.len() > 100, "{} shaders are not all", seen.len());
}

#[test]
fn a_bare_device_steps_every_scene_and_fluid() {
    let shared = support::device();
    let descriptor = DeviceDescriptor {
        label: Some("bare"),
        required_features: Features::empty(),
        required_limits: Limits::default(),
        ..Default::default()
    };
    let bare = pollster::block_on(shared.found.adapter.request_device(&descriptor));
    let (device, queue) = bare.expect("every adapter has WebGPU's default limits");
    assert!(!device.features().contains(Features::SUBGROUP), "the device is not bare");
    let scenes = SCENES.iter().map(|builtin| (builtin.name, setup(small(builtin.name))));
    for (name, setup) in scenes.chain(fluids()) {
        let mut simulation = Simulation::new(&device, &queue, &setup).unwrap_or_else(|error| panic!("{name}: {error}"));
        simulation.step(2).unwrap_or_else(|error| panic!("{name}: {error}"));
        let before = pollster::block_on(simulation.read(POSITION)).expect("positions");
        simulation.step(1).unwrap_or_else(|error| panic!("{name}: {error}"));
        let after = pollster::block_on(simulation.read(POSITION)).expect("positions");
        let checked = pollster::block_on(simulation.check());
        checked.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(before != after, "{name}: nothing moves");
    }
}
