//! State that a caller writes, and a device that a caller loses.

mod columns;
mod commands;
mod ids;
mod poison;
mod restarts;

use glam::Vec4;
use motes::kernel::{Backend, Field};
use motes::render::{KEYS, Picture, Trail};
use motes::settings::Settings;
use motes::{Cpu, POSITION, Setup, Simulation, VELOCITY, forces, gpu, integrators};

/// Two bodies that attract each other, without softening.
fn pair() -> Setup {
    let gravity = forces::entry("gravity").expect("gravity");
    let forces = vec![(gravity.build)(&Settings::defaults(gravity.keys))];
    Setup {
        state: crate::support::cloud(2, 1),
        forces,
        integrator: Box::new(integrators::Leapfrog),
        dt: 0.1,
        bounds: motes::Bounds::default(),
        solver: motes::Solver::default(),
    }
}

/// The speed that a body has after a step from rest, 200 from the other, to which it was moved between two steps.
fn moved<B: Backend>(mut simulation: Simulation<B>) -> f32 {
    simulation.step(1).expect("a step");
    simulation.write(POSITION, &[Vec4::new(-100.0, 0.0, 0.0, 1.0), Vec4::new(100.0, 0.0, 0.0, 1.0)]).expect("written");
    simulation.write(VELOCITY, &[Vec4::ZERO; 2]).expect("written");
    simulation.step(1).expect("a step");
    pollster::block_on(simulation.read(VELOCITY)).expect("read")[0].x
}

#[test]
fn a_step_after_a_write_begins_with_the_forces_there() {
    let shared = crate::support::device();
    let on_gpu = Simulation::new(&shared.found.device, &shared.found.queue, &pair()).expect("a simulation");
    let on_cpu = Simulation::on(Cpu::new(2).expect("two"), &pair()).expect("a simulation");
    for speed in [moved(on_gpu), moved(on_cpu)] {
        // G m dt / r², and the last half of the kick a little later: a part in 10⁷.
        assert!((speed / (0.1 / 40_000.0) - 1.0).abs() < 1e-5, "{speed:e}");
    }
}

#[test]
fn writing_keeps_to_the_field() {
    let shared = crate::support::device();
    let nowhere = Field::<Vec4>::new("nowhere");
    let mut on_gpu = Simulation::new(&shared.found.device, &shared.found.queue, &pair()).expect("a simulation");
    let mut on_cpu = Simulation::on(Cpu::new(2).expect("two"), &pair()).expect("a simulation");
    assert!(on_gpu.write(nowhere, &[Vec4::ONE]).is_err() && on_cpu.write(nowhere, &[Vec4::ONE]).is_err());
    assert!(on_gpu.write(POSITION, &[Vec4::ONE; 3]).is_err() && on_cpu.write(POSITION, &[Vec4::ONE; 3]).is_err());
    on_cpu.write(POSITION, &[Vec4::ONE]).expect("the first of two");
    assert_eq!(pollster::block_on(on_cpu.read(POSITION)).expect("read").len(), 2);
}

#[test]
fn a_lost_device_is_an_error_for_new_simulations_and_pictures_too() {
    let found = pollster::block_on(async {
        let instance = gpu::instance();
        gpu::open(gpu::choose(gpu::adapters(&instance).await, &gpu::Choice::Best)?).await
    })
    .expect("a device of its own");
    let mut simulation = Simulation::new(&found.device, &found.queue, &pair()).expect("a simulation");
    let picture = Picture::new(&Settings::defaults(KEYS), &pair().state, &[], Trail::new(0)).expect("a picture");
    found.device.destroy();
    assert!(pollster::block_on(simulation.draw(&picture)).is_err(), "a picture of a lost device");
    assert!(Simulation::new(&found.device, &found.queue, &pair()).is_err(), "a simulation on a lost device");
}
