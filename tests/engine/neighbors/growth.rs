//! Lists that turn out too short grow, and bits are those of a list that was longer from the start.

use glam::{DVec3, Vec4};
use motes::forces::Component;
use motes::kernel::Machine;
use motes::life::Life;
use motes::{Bounds, Error, Gpu, POSITION, Setup, Side, Simulation, VELOCITY};

use crate::neighbors::exact::same;
use crate::neighbors::list::{Weak, accelerations, jet, list, on, positions, setup, wanted};
use crate::neighbors::{Curious, variants};
use crate::support::{self, Shared};

#[test]
fn a_list_that_cannot_grow_names_the_particle_and_the_room() {
    let shared = support::device();
    for (variant, machine) in variants(&shared) {
        let particles = support::cloud(300, 8);
        let setup = setup(&particles, Bounds::default(), Box::new(Weak(list(0.1, 0.05))), 2e-3);
        let room = setup.problem(machine).expect("a problem").list.expect("a list").capacity;
        // The longest list that the device binds is that of the start.
        let machine = Machine { bindable: 16 * 300 * u64::from(1 + room / 4), ..machine };
        let mut simulation = on(&shared, machine, &setup);
        simulation.step(1).expect("a step");
        pollster::block_on(simulation.check()).expect("room for all");
        together(&mut simulation);
        for _ in 0..2 {
            simulation.step(1).expect("a step");
            let error = pollster::block_on(simulation.check()).expect_err("no room");
            let Error::ListFull { particle: 40, longest: 59, capacity, .. } = error else {
                panic!("{variant}: {error}")
            };
            assert!(capacity == room && capacity < 59, "{capacity}");
            let text = error.to_string();
            assert!(text.contains("particle 40") && text.contains("choose a smaller skin"), "{text}");
        }
    }
}

/// Particles 40 to 99 come together.
fn together(simulation: &mut Simulation<Gpu>) {
    let mut places = positions(simulation);
    places[40..100].fill(Vec4::new(5.0, 0.0, 0.0, 0.1));
    simulation.write(POSITION, &places).expect("places");
}

#[test]
fn steps_that_a_caller_encoded_find_more_room_or_an_error() {
    let shared = support::device();
    let encoded = |simulation: &mut Simulation<Gpu>, steps: u32| {
        let mut encoder = shared.found.device.create_command_encoder(&motes::wgpu::CommandEncoderDescriptor::default());
        simulation.encode(steps, &mut encoder).expect("steps");
        shared.found.queue.submit([encoder.finish()]);
    };
    let setup = setup(&support::cloud(300, 8), Bounds::default(), Box::new(Weak(list(0.1, 0.05))), 2e-3);
    let mut simulation = on(&shared, variants(&shared)[0].1, &setup);
    together(&mut simulation);
    encoded(&mut simulation, 1);
    let error = pollster::block_on(simulation.check()).expect_err("no room");
    assert!(matches!(error, Error::ListFull { particle: 40, .. }), "{error}");
    // Looked at often enough, it grows before it is too short.
    let setup = inward(300, 8, Box::new(Weak(list(0.31, 0.1))));
    let mut simulation = on(&shared, variants(&shared)[0].1, &setup);
    for _ in 0..STEPS {
        encoded(&mut simulation, 1);
        pollster::block_on(simulation.check()).expect("room for all");
    }
    assert!(simulation.generation() > 1, "grown {} times", simulation.generation());
    same(&accelerations(&mut simulation), &wanted(&mut simulation, &Bounds::default(), 0.31), "encoded");
}

/// Steps after which a cloud that falls in has a sixth of its size.
pub const STEPS: u32 = 119;

/// A cloud of particles that all move to its centre.
pub fn inward(count: usize, seed: u64, force: Box<dyn Component>) -> Setup {
    let mut state = support::cloud(count, seed);
    state.links = motes::links::Links::default();
    let places = state.position().to_vec();
    state.velocity_mut().iter_mut().zip(&places).for_each(|(v, x)| *v = -*x);
    setup(&state, Bounds::default(), force, 7e-3)
}

/// The same with particles at one place far away, so many that the list has room for all from the start.
pub fn roomy(setup: &Setup) -> Setup {
    let mut state = setup.state.clone();
    for _ in 0..setup.state.len() {
        state.push(DVec3::new(90.0, 0.0, 0.0), DVec3::ZERO, 1.0, 0.0);
    }
    Setup { state, ..setup.clone() }
}

/// A state after some steps, the same with room from the start, and how often the first one grew.
pub fn collapsed(shared: &Shared, setup: &Setup, batch: u32) -> [Vec<Vec4>; 4] {
    let machine = variants(shared)[0].1;
    let run = |setup: &Setup, grows: bool| {
        let mut simulation = on(shared, machine, setup);
        let mut left = STEPS;
        while left > 0 {
            let some = batch.min(left);
            simulation.step(some).expect("steps");
            pollster::block_on(simulation.check()).expect("room for all");
            left -= some;
        }
        assert_eq!(simulation.generation() > 0, grows, "grown {} times", simulation.generation());
        assert_eq!(simulation.steps(), u64::from(STEPS));
        let velocity: Vec<Vec4> = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
        [positions(&mut simulation), velocity]
    };
    let [x, v] = run(setup, true);
    let [mut long_x, mut long_v] = run(&roomy(setup), false);
    long_x.truncate(x.len());
    long_v.truncate(v.len());
    [x, v, long_x, long_v]
}

#[test]
fn a_list_that_grows_has_the_bits_of_one_that_was_longer() {
    let shared = support::device();
    for (seed, batch) in [(8, STEPS), (21, 40), (5, 1)] {
        let setup = inward(300, seed, Box::new(Curious(list(0.31, 0.1))));
        let [x, v, long_x, long_v] = collapsed(&shared, &setup, batch);
        assert!(x == long_x && v == long_v, "seed {seed}, {batch} steps at a time: other bits");
    }
}

/// When a list grows goes by when it is looked at, as a command does whenever a second has passed: no state may tell.
#[test]
fn states_are_the_same_whenever_a_list_was_looked_at() {
    let shared = support::device();
    let machine = variants(&shared)[0].1;
    for seed in [8, 21] {
        let whole = inward(300, seed, Box::new(Curious(list(0.31, 0.1))));
        let state = |setup: &Setup, looks: &[u32]| {
            let mut simulation = on(&shared, machine, setup);
            for steps in looks {
                simulation.step(*steps).expect("steps");
                pollster::block_on(simulation.check()).expect("room for all");
            }
            let state = pollster::block_on(simulation.snapshot()).expect("a state");
            (state, simulation.generation())
        };
        let (want, often) = state(&whole, &[1; STEPS as usize]);
        let (got, seldom) = state(&whole, &[100, STEPS - 100]);
        assert!(often > 0 && seldom > 0, "grown {often} and {seldom} times");
        assert!(got == want, "seed {seed}: another state");
        // It goes on from a state of which the list has grown, too.
        let (half, grown) = state(&whole, &[90]);
        assert!(grown > 0, "not grown");
        let (got, _) = state(&Setup { state: half, ..whole.clone() }, &[STEPS - 90]);
        assert!(got == want, "seed {seed}: another state after a stop");
    }
}

#[test]
fn a_list_grows_under_births_and_without_a_look() {
    let shared = support::device();
    let bounds = Bounds::new(DVec3::splat(-0.7), DVec3::splat(0.7), Side::Periodic);
    for (variant, machine) in variants(&shared) {
        let mut state = jet(0.1, 1.0, 0.6);
        let places = state.position().to_vec();
        let inward = state.velocity_mut().iter_mut().zip(&places).rev().take(100);
        inward.for_each(|(v, x)| *v = -*x);
        // As many as the list has room for where nothing is known of particles to come, and more.
        for k in 0..200 {
            let x = DVec3::new(0.5, 0.0013 * f64::from(k) - 0.1, 0.1);
            state.push(x, -x, 1.0, 0.0);
        }
        let setup = setup(&state, bounds, Box::new(Weak(list(0.23, 0.2))), 7e-3);
        let mut simulation = on(&shared, machine, &setup);
        // No look in between: reading is one.
        (0..STEPS).for_each(|_| simulation.step(1).expect("a step"));
        // What has been spawned and removed last is known to the next evaluation.
        let places = positions(&mut simulation);
        simulation.write(POSITION, &places).expect("places");
        simulation.step(0).expect("an evaluation");
        let want = wanted(&mut simulation, &bounds, 0.23);
        assert!(simulation.generation() > 0, "{variant}: the list has not grown");
        same(&accelerations(&mut simulation), &want, variant);
    }
}

#[test]
fn a_written_place_and_a_snapshot_find_more_room() {
    let shared = support::device();
    let setup = setup(&support::cloud(300, 8), Bounds::default(), Box::new(Weak(list(0.1, 0.05))), 2e-3);
    let mut simulation = on(&shared, variants(&shared)[0].1, &setup);
    simulation.step(1).expect("a step");
    together(&mut simulation);
    let state = pollster::block_on(simulation.snapshot()).expect("a state");
    assert_eq!((simulation.generation(), simulation.steps(), state.step), (1, 1, 1));
    simulation.step(1).expect("a step");
    let want = wanted(&mut simulation, &Bounds::default(), 0.1);
    same(&accelerations(&mut simulation), &want, "written");
}

/// Particles that are only removed are counted at the start; of grains that are yet to come as many have room as fit, of others nothing is known.
#[test]
fn lists_have_room_for_pending_particles() {
    let room = |setup: &Setup| setup.problem(Machine::HOST).expect("a problem").list.expect("a list").capacity;
    let scene = motes::scene::SCENES.iter().find(|scene| scene.name == "hopper").expect("a scene");
    let (name, folder) = ("hopper.toml".to_owned(), std::path::PathBuf::from("."));
    let source = motes::scene::Source::Text { name, text: scene.text.to_owned(), folder };
    let scene = motes::scene::Scene::load(&source, &[], &motes::scene::Options::default());
    let mut hopper = support::scenes::setup(scene.unwrap_or_else(|faults| panic!("{faults}")));
    // It has a drain. On the lattice six or a few more are within 10.7 mm: 1.5 times as many and 8.
    let counted = room(&hopper);
    assert!((16..=28).contains(&counted), "{counted}");
    hopper.state.set_life(7, Life::Pending);
    // 0.64 (10.68 / 3.6)³ = 16.7, and again 1.5 times as many and 8.
    let fit = room(&hopper);
    assert!((32..=40).contains(&fit), "{fit}");
    let mut cloud = setup(&support::cloud(300, 8), Bounds::default(), Box::new(Weak(list(0.1, 0.05))), 2e-3);
    assert!(room(&cloud) < 60, "{}", room(&cloud));
    cloud.state.links = motes::links::Links::default();
    cloud.state.set_life(7, Life::Pending);
    assert_eq!(room(&cloud), 200);
}
