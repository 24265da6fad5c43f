//! What a program gives that makes no sense is refused with the reason, and nothing has changed then.

use glam::{DVec3, Vec4};
use motes::typed::{Boids, Fluid, SoftTurn, Wander, default, fluid};
use motes::{Array, Error, Field, LIFE, POSITION, Setup, Simulation, State, VELOCITY};

use crate::support::{cloud, device};

fn said<T>(result: Result<T, Error>) -> String {
    result.err().expect("it makes no sense").to_string()
}

#[test]
fn numbers_that_are_none_and_the_clock_are_not_written() {
    let shared = device();
    let mut state = cloud(20, 3);
    (state.links, state.held) = Default::default();
    let mut simulation = super::on_gpu(&shared, &super::setup(state, vec![Wander::default().into()]));
    let before = pollster::block_on(simulation.read(POSITION)).expect("positions");
    for bad in [f32::NAN, f32::INFINITY] {
        let why = said(simulation.write_at(POSITION, 11, &[Vec4::ONE, Vec4::new(0.0, bad, 0.0, 1.0)]));
        assert!(why.contains("element 12") && why.contains("`position`"), "{why}");
        let why = said(simulation.write(VELOCITY, &[Vec4::splat(bad)]));
        assert!(why.contains("element 0") && why.contains("`velocity`"), "{why}");
    }
    assert_eq!(pollster::block_on(simulation.read(POSITION)).expect("positions"), before);
    // By the names of columns too, whether or not a kernel has them.
    let mut column = |name, values| said(pollster::block_on(simulation.write_column(name, &values)));
    assert!(column("life", Array::Uint(vec![2; 20])).contains("spawn and remove"));
    assert!(column("id", Array::Uint(vec![7; 20])).contains("the simulation assigns ids"));
    let why = column("mass", Array::Float([vec![1.0; 19], vec![1e300]].concat()));
    assert!(why.contains("element 19") && why.contains("`mass`") && why.contains("beyond single precision"), "{why}");
    assert!(said(simulation.write(Field::<u32>::new("world"), &[1_000_000])).contains("`world`"));
    pollster::block_on(simulation.remove(&[8])).expect("one goes");
    assert!(said(simulation.write_at(LIFE, 0, &[7])).contains("spawn and remove"));
    pollster::block_on(simulation.check()).expect("it runs on");
}

/// A block of a fluid at rest, of which one particle has another mass.
fn block(changed: Option<f64>) -> Setup {
    let fluid = Fluid { density: 1.0, sound_speed: 10.0, ..fluid(0.1) };
    let mut state = State::default();
    for n in 0..64 {
        let x = DVec3::new(f64::from(n % 4), f64::from(n / 4 % 4), f64::from(n / 16));
        state.push(0.1 * x, DVec3::ZERO, changed.filter(|_| n == 21).unwrap_or(1e-3), 0.0);
    }
    Setup::new(state, vec![fluid.into()], 1e-4)
}

#[test]
fn what_weighs_nothing_is_no_fluid() {
    let shared = device();
    let new = |setup: &Setup| Simulation::new(&shared.found.device, &shared.found.queue, setup);
    let why = said(new(&block(Some(0.0))));
    assert!(why.contains("particle 21 of the fluid has mass 0"), "{why}");
    let mut simulation = new(&block(None)).expect("a fluid");
    let mut weightless = State::default();
    weightless.push(DVec3::splat(1.0), DVec3::ZERO, 0.0, 0.0);
    let why = said(pollster::block_on(simulation.spawn(&weightless)));
    assert!(why.contains("particle 0 of the fluid has mass 0"), "{why}");
    assert_eq!(simulation.count(), 64);
}

#[test]
fn settings_that_contradict_each_other_are_refused() {
    let shared = device();
    let new = |force: Box<dyn motes::forces::Component>| {
        Simulation::new(&shared.found.device, &shared.found.queue, &super::setup(cloud(20, 3), vec![force]))
    };
    let why = said(new(Boids { range: 0.3, separation_range: 0.5, ..default() }.into()));
    assert!(why.contains("separation_range") && why.contains("0.5") && why.contains("0.3"), "{why}");
    // The nearest are seen however far they are.
    new(Boids { range: 0.3, separation_range: 0.5, over: "nearest".into(), ..default() }.into())
        .expect("it makes sense");
    let (low, high) = (DVec3::new(-1.0, 2.0, -1.0), DVec3::ONE);
    let why = said(new(SoftTurn { low, high, ..default() }.into()));
    assert!(why.contains("along y") && why.contains('2'), "{why}");
    // Numbers do not hold this one, and it is not rounded to another.
    let why = said(new(Wander { seed: (1 << 53) + 1, ..default() }.into()));
    assert!(why.contains("seed") && why.contains("too large"), "{why}");
    new(Wander { seed: 1 << 53, ..default() }.into()).expect("the largest");
}
