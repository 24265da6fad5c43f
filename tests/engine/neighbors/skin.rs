//! The skin that a simulation chooses while it runs, where no law names one: it changes no bit.

use glam::{DVec3, Vec4};
use motes::forces::{Component, Over};
use motes::{Bounds, Gpu, Setup, Side, Simulation, State, VELOCITY};

use crate::neighbors::history::{RANGE, Steps};
use crate::neighbors::list::{on, positions, setup};
use crate::neighbors::{Curious, variants};
use crate::support;

/// The skin at the start where none is given.
const USUAL: f64 = 0.2 * RANGE;
const STEPS: u64 = 1200;

/// Particles of which the fastest move by `speed` of the usual skin in a step.
fn moving(seed: u64, speed: f64, dt: f64) -> State {
    let mut state = support::cloud(250, seed);
    state.links = motes::links::Links::default();
    let fastest = state.velocity().iter().map(|v| v.length()).fold(0.0, f64::max);
    state.velocity_mut().iter_mut().for_each(|v| *v *= speed * USUAL / (dt * fastest));
    state
}

/// The same in a plane, where the box is one.
fn within(mut state: State, bounds: &Bounds) -> State {
    if bounds.dimensions == 2 {
        state.position_mut().iter_mut().for_each(|x| x.z = 0.0);
        state.velocity_mut().iter_mut().for_each(|v| v.z = 0.0);
    }
    state
}

fn step(simulation: &mut Simulation<Gpu>, to: u64) {
    while simulation.steps() < to {
        simulation.step(40).expect("steps");
        pollster::block_on(simulation.check()).expect("a sound run");
    }
}

fn whole(simulation: &mut Simulation<Gpu>) -> [Vec<Vec4>; 2] {
    [positions(simulation), pollster::block_on(simulation.read(VELOCITY)).expect("velocities")]
}

#[test]
fn a_chosen_skin_changes_no_bit() {
    let shared = support::device();
    let dt = 7e-3;
    let half = [DVec3::ONE, DVec3::new(1.0, 1.0, 0.0)];
    let [space, plane] = half.map(|half| Bounds::new(-half, half, Side::Periodic));
    let plain = |skin| -> Box<dyn Component> { Box::new(Curious(Over::List { range: RANGE, skin, slots: 0 })) };
    let history = |skin| -> Box<dyn Component> { Box::new(Steps { skin }) };
    let laws: [&dyn Fn(Option<f64>) -> Box<dyn Component>; 2] = [&plain, &history];
    // In space and in a plane; what moves slowly needs less of a skin, what moves fast in a plane more. In space what is so fast has the list built
    // in almost every step, and the smallest skin.
    for (seed, speed, bounds, larger) in [(3, 1e-4, space, false), (17, 0.3, plane, true), (29, 0.9, space, false)] {
        // The law with history leads out of a plane.
        for (law, force) in laws.iter().enumerate().take(if larger { 1 } else { 2 }) {
            for (variant, machine) in variants(&shared) {
                let what = format!("{variant}, law {law}, seed {seed}");
                let of = |skin| setup(&within(moving(seed, speed, dt), &bounds), bounds, force(skin), dt);
                let mut given = on(&shared, machine, &of(Some(USUAL)));
                let mut free = on(&shared, machine, &of(None));
                assert_eq!(given.neighbor_list(), free.neighbor_list(), "{what}: not the same at the start");
                step(&mut given, STEPS);
                step(&mut free, STEPS);
                let [usual, list] = [&given, &free].map(|one| one.neighbor_list().expect("a list"));
                assert!(!usual.chosen && usual.skin.to_bits() == list_skin(USUAL).to_bits(), "{what}: {usual:?}");
                assert!(list.chosen && free.generation() > 0, "{what}: {list:?}");
                assert!((list.skin < 0.8 * USUAL) != larger, "{what}: {list:?}");
                assert!((list.skin > 1.2 * USUAL) == larger, "{what}: {list:?}");
                assert!(whole(&mut given) == whole(&mut free), "{what}: other bits");
                // So does a state go on, by a simulation that begins with the usual skin.
                let state = pollster::block_on(free.snapshot()).expect("a state");
                let mut next = on(&shared, machine, &Setup { state, ..of(None) });
                assert!(next.goes_on() && !next.neighbor_list().expect("a list").chosen, "{what}");
                step(&mut next, STEPS + 80);
                step(&mut given, STEPS + 80);
                assert!(whole(&mut given) == whole(&mut next), "{what}: other bits from a state");
            }
        }
    }
}

/// What a list of that skin has: what its reach exceeds the range by.
fn list_skin(skin: f64) -> f64 {
    (RANGE + skin) - RANGE
}

#[test]
fn a_skin_that_is_given_stays() {
    let shared = support::device();
    let force = Curious(Over::List { range: RANGE, skin: Some(USUAL), slots: 0 });
    let setup = setup(&moving(5, 1e-4, 7e-3), Bounds::default(), Box::new(force), 7e-3);
    let mut simulation = on(&shared, variants(&shared)[0].1, &setup);
    step(&mut simulation, 600);
    let list = simulation.neighbor_list().expect("a list");
    assert!(simulation.generation() == 0 && !list.chosen && list.every >= 100.0, "{list:?}");
}
