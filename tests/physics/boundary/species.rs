//! Species: from the setup to laws on the device and by the references, and into snapshots.

use std::sync::Arc;

use glam::{DVec3, DVec4};
use motes::forces::{Component, Law, Over};
use motes::kernel::{ACCELERATION, Backend, Host, Source};
use motes::{Bounds, Cpu, SPECIES, Setup, Simulation, State, VELOCITY};

use crate::boundary::setup;
use crate::support;

/// Pushes by species.
#[derive(Clone)]
struct Sorting;

impl Component for Sorting {
    fn laws(&self) -> Vec<Law> {
        let wgsl = "fn force(me: Particle) -> vec4f { return vec4f(f32(species[me.index]), 0.0, 0.0, 0.0); }";
        let reference = |host: &Host| {
            let species = host.read(SPECIES)?;
            for (a, of) in host.write(ACCELERATION)?.iter_mut().zip(species.iter()) {
                *a += DVec4::X * f64::from(*of);
            }
            Ok(())
        };
        let wgsl = Source::ours("sorting", wgsl);
        vec![Law::plain("sorting", Over::Each, wgsl, Vec::new(), Arc::new(reference))]
    }
}

fn particles() -> State {
    let mut particles = support::cloud(40, 2).of_species(3);
    particles.append(&support::cloud(25, 3).of_species(0)).expect("one kind");
    particles.velocity_mut().fill(DVec3::ZERO);
    particles.species_mut()[64] = 9;
    particles
}

fn sorted<B: Backend>(mut simulation: Simulation<B>, setup: &Setup) {
    simulation.step(2).expect("steps");
    let velocity = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
    for (v, species) in velocity.iter().zip(setup.state.species()) {
        // Twice 0.25 times a small whole number: exact.
        assert!((f64::from(v.x) - 0.5 * f64::from(*species)).abs() < 1e-6, "{v} of {species}");
    }
    let snapshot = pollster::block_on(simulation.snapshot()).expect("a snapshot");
    assert_eq!(snapshot.species(), setup.state.species());
    assert_eq!(pollster::block_on(simulation.read(SPECIES)).expect("species"), setup.state.species());
}

#[test]
fn laws_may_tell_species_apart() {
    let shared = support::device();
    let setup = setup(particles(), vec![Box::new(Sorting)], "leapfrog", 0.25, Bounds::default());
    assert_eq!(setup.state.species().iter().map(|of| u64::from(*of)).sum::<u64>(), 129);
    sorted(Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation"), &setup);
    sorted(Simulation::on(Cpu::new(65).expect("some"), &setup).expect("a simulation"), &setup);
}

#[test]
fn where_no_law_asks_none_are_on_the_device() {
    let shared = support::device();
    let setup = setup(particles(), Vec::new(), "leapfrog", 0.25, Bounds::default());
    let mut simulation = Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation");
    assert!(simulation.buffer(SPECIES).is_none());
    let snapshot = pollster::block_on(simulation.snapshot()).expect("a snapshot");
    assert_eq!(snapshot.species(), setup.state.species());
}
