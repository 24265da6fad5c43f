//! Built-in scenes start as their descriptions say.

use motes::{Gpu, Simulation, VELOCITY};

use crate::walls::builtin;

/// The maximum speed of the first `first` particles of a scene, after each `every` steps.
fn fastest(name: &str, overrides: &[&str], (first, every, times): (usize, u32, usize)) -> Vec<f32> {
    let (shared, setup) = (crate::support::device(), builtin(name, overrides));
    let gpu = Gpu::new(&shared.found.device, &shared.found.queue, setup.check().expect("a setup")).expect("room");
    let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
    let mut speeds = Vec::new();
    for _ in 0..times {
        simulation.step(every).expect("steps");
        let read = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
        speeds.push(read.iter().take(first).map(|v| v.truncate().length()).fold(0.0, f32::max));
    }
    speeds
}

/// Before the jet arrives, which takes half a second, the pool only settles into hydrostatic equilibrium, no
/// faster than a fall through half a spacing, √(2 g 0.01 m) = 0.44 m/s.
#[test]
fn the_pool_waits_for_the_jet() {
    let speeds = fastest("fountain_pool", &[], (780, 25, 10));
    assert!(speeds.iter().all(|speed| *speed < 0.44), "{speeds:?}");
    assert!(speeds.iter().any(|speed| *speed > 1e-3), "{speeds:?}");
}

/// A drop at rest is contracted by its surface tension, and two drops keep their velocity: the limit at the start is a fifth of the speed of
/// sound, 2 m/s.
#[test]
fn drops_begin_gently() {
    let coarse = ["force.0.spacing=0.04", "simulation.dt=0.002"];
    let one = fastest("droplet", &coarse, (usize::MAX, 10, 5));
    assert!(one.iter().all(|speed| *speed < 2.0), "{one:?}");
    let two = fastest("two_drops", &coarse, (usize::MAX, 10, 5));
    assert!(two.iter().all(|speed| (0.35..2.35).contains(speed)), "{two:?}");
}
