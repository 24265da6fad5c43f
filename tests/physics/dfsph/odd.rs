//! States in which there is nothing to solve, or no solution; and what is refused.

use glam::DVec3;
use motes::forces::Component;
use motes::kernel::Machine;
use motes::settings::Value;
use motes::{Bounds, Setup, Simulation, State, VELOCITY};

use crate::dfsph::{DENSITY, SPACING, fluid, setup};
use crate::support::states::{force, word};

/// Particles of one mass at these places, after some steps: velocities, and how many solves of the density failed.
fn after(places: &[DVec3], steps: u32) -> (Vec<DVec3>, u32) {
    let shared = crate::support::device();
    let mut particles = State::default();
    for x in places {
        particles.push(*x, DVec3::new(0.3, -0.2, 0.1), DENSITY * SPACING.powi(3), 0.0);
    }
    let setup = setup(&particles, Bounds::default(), vec![fluid(&[])], 0.004);
    let mut simulation = Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation");
    simulation.step(steps).expect("steps");
    pollster::block_on(simulation.check()).expect("numbers");
    let solves = pollster::block_on(simulation.pressure_solves()).expect("read").expect("solves");
    assert_eq!(solves[1].solves, steps);
    let velocity = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
    (velocity.iter().map(|v| v.truncate().as_dvec3()).collect(), solves[1].failures)
}

#[test]
fn a_single_particle_flies_on() {
    for places in
        [vec![DVec3::ZERO], vec![DVec3::ZERO, DVec3::X], vec![DVec3::ZERO, 0.999 * 2.0 * SPACING * DVec3::X, DVec3::Y]]
    {
        let (velocity, failures) = after(&places, 3);
        assert_eq!(failures, 0, "{places:?}");
        assert!(velocity.iter().all(|v| v.distance(DVec3::new(0.3, -0.2, 0.1)) < 1e-7), "{places:?}: {velocity:?}");
    }
}

#[test]
fn coincident_particles_are_reported_and_not_solved_for() {
    let (velocity, failures) = after(&[DVec3::splat(0.1); 30], 2);
    assert_eq!(failures, 2);
    assert!(velocity.iter().all(|v| v.distance(DVec3::new(0.3, -0.2, 0.1)) < 1e-7), "{velocity:?}");
}

fn refused(force: Box<dyn Component>) -> String {
    let mut particles = State::default();
    particles.push(DVec3::ZERO, DVec3::ZERO, 1.0, 0.0);
    let setup: Setup = setup(&particles, Bounds::default(), vec![force], 0.004);
    let machine = Machine::HOST;
    setup.plans(machine).err().map(|error| error.to_string()).unwrap_or_default()
}

#[test]
fn what_cannot_be_had_is_refused() {
    let one = |key: &'static str, x: f64| refused(fluid(&[(key, Value::Number(x))]));
    assert!(one("tolerance", 1e-7).contains("single precision"));
    assert!(one("divergence_tolerance", 1e-7).contains("single precision"));
    assert!(one("max_iterations", 1.0).contains("2 to 1 iterations"));
    assert!(one("max_iterations", 2000.0).contains("1000 at most"));
    assert!(one("max_iterations", 2.0).is_empty());
    let weak = force("fluid", &[("spacing", Value::Number(SPACING)), ("solver", word("wcsph"))]);
    assert!(refused(weak).contains("sound_speed"));
    let properties = fluid(&[]).properties();
    assert!(properties.integrators == ["symplectic_euler"] && properties.evaluated_last);
    // 0.4 of a spacing.
    assert!(properties.largest_move == Some(0.4 * SPACING) && properties.caution.is_none(), "{properties:?}");
    let caution = fluid(&[("alpha", Value::Number(0.1))]).properties().caution.unwrap_or_default();
    assert!(caution.contains("give viscosity instead"), "{caution}");
}
