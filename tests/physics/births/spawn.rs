//! Particles come and go while a simulation runs.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec3, Vec4};
use motes::forces::{Component, Law};
use motes::gpu::Gpu;
use motes::kernel::{ACCELERATION, Array, Backend, Source};
use motes::life::{Drain, Population};
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::solids::Solid;
use motes::{Bounds, Cpu, Error, POSITION, Setup, Side, Simulation, State};

use crate::births::{setup, state};
use crate::support::states::{force, integrator};
use crate::support::{self, Random};

/// Particles of masses about 1 in a box of side 2 around the origin, without links.
fn some(count: usize, seed: u64) -> State {
    let mut random = Random::new(seed);
    let mut state = State::default();
    for _ in 0..count {
        let round = |v: DVec3| v.as_vec3().as_dvec3();
        let (x, v) = (round(random.vector()), round(0.4 * random.vector()));
        state.push(x, v, f64::from(1.1_f32 + 0.3 * random.narrow()), 0.0);
    }
    state
}

/// A periodic box: cells are the same however many particles there are.
fn periodic() -> Bounds {
    Bounds::new(DVec3::splat(-1.25), DVec3::splat(1.25), Side::Periodic)
}

fn gravity(over: &'static str) -> Vec<Box<dyn Component>> {
    vec![force("gravity", &[("over", Value::Text(over.into())), ("softening", Value::Number(0.05))])]
}

/// A name, a box and what acts in it.
type Case = (&'static str, Bounds, Vec<Box<dyn Component>>);

/// What attracts, what flocks, what wanders and what flows.
fn cases() -> Vec<Case> {
    let fluid = force("fluid", &[("spacing", Value::Number(0.2)), ("sound_speed", Value::Number(3.0))]);
    vec![
        ("gravity over pairs", Bounds::default(), gravity("pairs")),
        ("gravity over a tree", Bounds::default(), gravity("tree")),
        ("boids", periodic(), vec![force("boids", &[("range", Value::Number(0.4))])]),
        (
            "boids over a list",
            periodic(),
            vec![force("boids", &[("range", Value::Number(0.4)), ("over", Value::Text("list".into()))])],
        ),
        ("wander", Bounds::default(), vec![force("wander", &[])]),
        ("a fluid", periodic(), vec![fluid]),
    ]
}

fn on_device(setup: &Setup) -> Simulation<Gpu> {
    // A device of its own: tests side by side would poll one from two threads, which wgpu does not support where a wait times out.
    let own = support::open();
    Simulation::new(&own.found.device, &own.found.queue, setup).expect("a simulation")
}

fn by_references(setup: &Setup) -> Simulation<Cpu> {
    let cpu = Cpu::new(u32::try_from(setup.state.len()).expect("few")).expect("some");
    Simulation::on(cpu, setup).expect("a simulation")
}

fn roomy(mut state: State, capacity: u32) -> State {
    state.capacity = Some(capacity);
    state
}

/// Positions and velocities by id, bit for bit.
fn bits(state: &State) -> BTreeMap<u32, [u64; 6]> {
    let one = |(id, (x, v)): (&u32, (&DVec3, &DVec3))| {
        let numbers = [x.to_array(), v.to_array()].concat();
        (*id, std::array::from_fn(|k| numbers[k].to_bits()))
    };
    state.ids().iter().zip(state.position().iter().zip(state.velocity())).map(one).collect()
}

fn run<B: Backend>(mut simulation: Simulation<B>, steps: u32) -> State {
    simulation.step(steps).expect("steps");
    state(&mut simulation)
}

fn wait<T>(future: impl Future<Output = T>) -> T {
    pollster::block_on(future)
}

fn room_changes_nothing<B: Backend>(make: impl Fn(&Setup) -> Simulation<B>) {
    for (name, bounds, forces) in cases() {
        let of = |state: State| run(make(&setup(state, forces.clone(), bounds)), 9);
        let (want, got) = (of(some(61, 4)), of(roomy(some(61, 4), 333)));
        assert_eq!(bits(&want), bits(&got), "{name}");
        assert_eq!((got.len(), got.capacity, got.next_id()), (61, Some(333), 61), "{name}");
    }
}

#[test]
fn free_rows_change_no_bit() {
    room_changes_nothing(on_device);
    room_changes_nothing(by_references);
}

fn spawned_as_if_there<B: Backend>(make: impl Fn(&Setup) -> Simulation<B>) {
    for (name, bounds, forces) in cases() {
        // Room for all, for some, for none.
        for capacity in [Some(97), Some(41), None] {
            let of = |state: State| make(&setup(state, forces.clone(), bounds));
            let (mut first, new) = (some(40, 8), some(23, 9));
            first.capacity = capacity;
            let mut simulation = of(first);
            simulation.step(4).expect("steps");
            let mut then = state(&mut simulation);
            let before = simulation.generation();
            let ids = wait(simulation.spawn(&new)).expect("spawned");
            assert_eq!(ids, (40..63).collect::<Vec<u32>>(), "{name}");
            assert_eq!(simulation.generation() - before, u32::from(capacity != Some(97)), "{name}");
            then.append(&new).expect("one kind");
            then.capacity = None;
            let (got, want) = (run(simulation, 7), run(of(then), 7));
            assert_eq!(bits(&got), bits(&want), "{name}, {capacity:?}");
        }
    }
}

#[test]
fn spawned_particles_are_as_if_they_had_been_there() {
    spawned_as_if_there(on_device);
    spawned_as_if_there(by_references);
}

fn removed_as_if_never_there<B: Backend>(make: impl Fn(&Setup) -> Simulation<B>) {
    // Where each is accelerated alone, accelerations stay, and random numbers of the last step with them: see below.
    for (name, bounds, forces) in cases().into_iter().filter(|(name, ..)| *name != "wander") {
        let of = |state: State| make(&setup(state, forces.clone(), bounds));
        let mut simulation = of(roomy(some(40, 8), 40));
        simulation.step(4).expect("steps");
        let order: Vec<usize> = (0..40).filter(|id| ![0, 7, 8, 39].contains(id)).collect();
        let mut then = state(&mut simulation).picked(&order);
        then.capacity = None;
        wait(simulation.remove(&[7, 39, 0, 8])).expect("removed");
        let there = wait(simulation.population()).expect("counts");
        assert_eq!(there, Population { pending: 0, active: 36, removed: 0 }, "{name}");
        assert_eq!((simulation.row_of(7), simulation.row_of(9), simulation.ids()[8]), (None, Some(9), None));
        let (got, want) = (run(simulation, 7), run(of(then), 7));
        assert_eq!((got.len(), got.ids()), (36, want.ids()), "{name}");
        // Blocks of pairs and leaves of a tree are of rows: a hole shifts what stands in one, and so the order of sums.
        if name.contains("gravity") {
            let apart = got.position().iter().zip(want.position()).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            // A tree is wrong by a thousandth of accelerations of up to 200, for a tenth of a unit of time: 0.5 · 0.2 · 0.01.
            assert!(apart < 1e-3, "{name}: {apart:e}");
        } else {
            assert_eq!(bits(&got), bits(&want), "{name}");
        }
    }
}

#[test]
fn removed_particles_are_as_if_they_had_never_been_there() {
    removed_as_if_never_there(on_device);
    removed_as_if_never_there(by_references);
}

fn rows_not_ids_are_used_again<B: Backend>(make: impl Fn(&Setup) -> Simulation<B>) {
    let mut simulation = make(&setup(roomy(some(6, 1), 6), vec![force("wander", &[])], Bounds::default()));
    let mut ever: BTreeSet<u32> = (0..6).collect();
    let mut there: Vec<u32> = (0..6).collect();
    for round in 0..20 {
        let gone: Vec<u32> = there.drain(..2).collect();
        wait(simulation.remove(&gone)).expect("removed");
        let ids = wait(simulation.spawn(&some(2, 30 + round))).expect("spawned");
        assert!(ids.iter().all(|id| ever.insert(*id)), "{ids:?} again");
        there.extend(ids);
        simulation.step(1).expect("a step");
    }
    assert_eq!((simulation.capacity(), simulation.count(), simulation.generation()), (6, 6, 0));
    let last = state(&mut simulation);
    let mut ids = last.ids().to_vec();
    ids.sort_unstable();
    assert_eq!((ids, last.next_id()), (there, 46));
}

#[test]
fn a_run_that_adds_and_removes_for_ever_stays_at_one_capacity() {
    rows_not_ids_are_used_again(on_device);
    rows_not_ids_are_used_again(by_references);
}

fn restarted<B: Backend>(make: impl Fn(&Setup) -> Simulation<B>) {
    for (name, bounds, forces) in cases() {
        let of = |state: State| make(&setup(state, forces.clone(), bounds));
        let mut simulation = of(roomy(some(40, 8), 50));
        simulation.step(3).expect("steps");
        wait(simulation.remove(&[3, 17])).expect("removed");
        wait(simulation.spawn(&some(5, 2))).expect("spawned");
        wait(simulation.remove(&[40])).expect("removed");
        simulation.step(3).expect("steps");
        let saved = state(&mut simulation);
        assert_eq!((saved.len(), saved.next_id(), saved.capacity), (42, 45, Some(50)), "{name}");
        let mut again = of(saved);
        assert!(again.goes_on(), "{name}");
        for side in [&mut simulation, &mut again] {
            assert_eq!(wait(side.spawn(&some(1, 77))).expect("spawned"), [45], "{name}");
            side.step(4).expect("steps");
        }
        let (want, got) = (state(&mut simulation), state(&mut again));
        // Rows are others: see above.
        if name.contains("gravity") {
            assert_eq!(got.len(), want.len());
        } else {
            assert_eq!(bits(&got), bits(&want), "{name}");
        }
    }
}

#[test]
fn states_hold_particles_alone_and_go_on() {
    restarted(on_device);
    restarted(by_references);
}

fn refusals<B: Backend>(make: impl Fn(&Setup) -> Simulation<B>) {
    let mut first = roomy(some(9, 3), 12);
    first.held = vec![Held { id: 4, by: Hold::Fixed }];
    let mut simulation = make(&setup(first, vec![force("drag", &[])], Bounds::default()));
    simulation.step(2).expect("steps");
    wait(simulation.remove(&[2])).expect("removed");
    let before = bits(&state(&mut simulation));
    let mut why = |ids: &[u32]| wait(simulation.remove(ids)).expect_err("a refusal").to_string();
    for (ids, words) in [
        (&[1, 77][..], "no particle 77"),
        (&[1, 2], "particle 2 has been removed already"),
        (&[1, 1], "particle 1 is to be removed twice"),
        (&[1, 4], "particle 4 is linked, fixed or kinematic"),
    ] {
        let why = why(ids);
        assert!(why.contains(words), "{why}");
    }
    let mut odd = some(2, 5);
    odd.set("charge", Array::Float(vec![1.0, 2.0])).expect("two");
    let mut named = some(2, 5);
    named.set_ids(vec![7, 8]).expect("two");
    let mut broken = some(2, 5);
    broken.position_mut()[1].x = f64::NAN;
    let mut tied = support::cloud(3, 1);
    tied.held.clear();
    for (new, words) in [
        (odd, "no column `charge`"),
        (named, "get ids of their own"),
        (broken, "particle 1 has the position [NaN"),
        (tied, "cannot be linked"),
    ] {
        let why = wait(simulation.spawn(&new)).expect_err("a refusal").to_string();
        assert!(why.contains(words), "{why}");
    }
    assert_eq!((bits(&state(&mut simulation)), simulation.count(), simulation.generation()), (before, 9, 0));
    // A law over all pairs that massless particles act on too.
    let links = vec![force("gravity", &[]), force("spring", &[])];
    let mut tied = make(&setup(support::cloud(9, 2), links, Bounds::default()));
    let why = wait(tied.remove(&[0])).expect_err("a refusal").to_string();
    assert!(why.contains("linked"), "{why}");
    assert_eq!(wait(tied.spawn(&some(1, 2))).expect("spawned"), [9]);
}

#[test]
fn what_cannot_be_added_or_removed_changes_nothing() {
    refusals(on_device);
    refusals(by_references);
}

fn drained<B: Backend>(make: impl Fn(&Setup) -> Simulation<B>) {
    let mut first = some(8, 6);
    first.position_mut()[3] = DVec3::new(5.0, 0.0, 0.0);
    first.drains = vec![Drain { position: DVec3::ZERO, solid: Solid::Sphere(3.0), outside: true, species: None }];
    let mut simulation = make(&setup(roomy(first, 8), vec![force("wander", &[])], Bounds::default()));
    simulation.step(2).expect("steps");
    let why = wait(simulation.remove(&[3])).expect_err("a refusal").to_string();
    assert!(why.contains("particle 3 has been removed already"), "{why}");
    assert_eq!(state(&mut simulation).len(), 7);
    assert_eq!(wait(simulation.spawn(&some(1, 2))).expect("spawned"), [8]);
    assert_eq!((simulation.row_of(8), simulation.row_of(3), simulation.capacity()), (Some(3), None, 8));
}

#[test]
fn rows_of_drained_particles_are_used_again() {
    drained(on_device);
    drained(by_references);
}

fn written<B: Backend>(make: impl Fn(&Setup) -> Simulation<B>) {
    let mut simulation = make(&setup(some(5, 1), vec![force("drag", &[])], Bounds::default()));
    let before = wait(simulation.read(POSITION)).expect("read");
    simulation.write_at(POSITION, 3, &[Vec4::splat(0.25)]).expect("written");
    let after = wait(simulation.read(POSITION)).expect("read");
    assert_eq!((&after[..3], after[3], after[4]), (&before[..3], Vec4::splat(0.25), before[4]));
    assert!(simulation.write_at(POSITION, 4, &[Vec4::ONE; 2]).is_err());
}

#[test]
fn writing_begins_at_an_offset() {
    written(on_device);
    written(by_references);
}

/// Wandering of others continues as it would have, and where there were no free rows, it is carried over to other buffers.
fn walks<B: Backend>(make: impl Fn(&Setup) -> Simulation<B>) {
    for state in [roomy(some(12, 3), 12), some(12, 3)] {
        walk(&make, &state);
    }
}

fn walk<B: Backend>(make: impl Fn(&Setup) -> Simulation<B>, start: &State) {
    let of = || make(&setup(start.clone(), vec![force("wander", &[])], Bounds::default()));
    let (mut all, mut less) = (of(), of());
    all.step(3).expect("steps");
    less.step(3).expect("steps");
    wait(less.remove(&[1, 2, 5])).expect("removed");
    all.step(5).expect("steps");
    less.step(5).expect("steps");
    let (all, less) = (bits(&state(&mut all)), bits(&state(&mut less)));
    assert_eq!(less.len(), 9);
    for id in less.keys() {
        assert_eq!(all[id], less[id], "particle {id}");
    }
}

#[test]
fn random_numbers_follow_ids() {
    walks(on_device);
    walks(by_references);
}

/// Counts the evaluations that each pair has been in range without a break, and the neighbours.
#[derive(Clone)]
struct Steps;

const PART: f64 = 1.0 / 1_048_576.0;

impl Component for Steps {
    fn laws(&self) -> Vec<Law> {
        let wgsl = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
            let steps = recall(you, 0u) + 1.0;
            remember(you, 0u, steps);
            (*sum).acceleration += vec3f(steps, 1.0, 0.0);
        }
        fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, 0.0) / 1048576.0; }";
        vec![Law::remembering(
            "steps",
            (0.31, Some(0.1), 1),
            Source::ours("steps", wgsl),
            Vec::new(),
            &["acceleration"],
            |_, _, _, _, memory, sum: &mut DVec3| {
                let steps = memory.recall(0) + 1.0;
                memory.remember(0, steps);
                *sum += DVec3::new(steps, 1.0, 0.0);
            },
            |_, sum, _, outcome| outcome.accelerate((PART * *sum).extend(0.0)),
        )]
    }
}

/// Steps of all pairs of particle 0 together, and how many pairs these are.
fn counted<B: Backend>(simulation: &mut Simulation<B>) -> [u32; 2] {
    simulation.step(1).expect("a step");
    wait(simulation.check()).expect("no alarm");
    let a = wait(simulation.read(ACCELERATION)).expect("read")[0] * 1_048_576.0;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small whole numbers")]
    [a.x, a.y].map(|x| x as u32)
}

fn at(places: &[DVec3]) -> State {
    let mut state = State::default();
    places.iter().for_each(|x| state.push(*x, DVec3::ZERO, 1.0, 0.0));
    state
}

fn history_is_of_particles<B: Backend>(make: impl Fn(&Setup) -> Simulation<B>) {
    let places = [DVec3::ZERO, 0.125 * DVec3::X, 0.125 * DVec3::Y, 0.125 * DVec3::Z];
    let mut simulation = make(&setup(roomy(at(&places), 4), vec![Box::new(Steps)], Bounds::default()));
    let [first, pairs] = counted(&mut simulation);
    assert_eq!(pairs, 3);
    let new = first / 3;
    simulation.step(6).expect("steps");
    let [all, _] = counted(&mut simulation);
    assert_eq!(all, 3 * (new + 7));
    // Another particle in the same row and place is another one.
    wait(simulation.remove(&[1])).expect("removed");
    assert_eq!(wait(simulation.spawn(&at(&places[1..2]))).expect("spawned"), [4]);
    assert_eq!(simulation.row_of(4), Some(1));
    assert_eq!(counted(&mut simulation), [2 * (new + 8) + new, 3]);
    // History continues in other buffers, of more rows.
    assert_eq!(wait(simulation.spawn(&at(&[DVec3::splat(9.0); 1]))).expect("spawned"), [5]);
    assert_eq!((simulation.generation(), simulation.capacity()), (1, 6));
    assert_eq!(counted(&mut simulation), [2 * (new + 9) + new + 1, 3]);
    wait(simulation.remove(&[2, 5])).expect("removed");
    assert_eq!(counted(&mut simulation), [new + 10 + new + 2, 2]);
    // A row that was in no list before.
    let more = at(&[-0.125 * DVec3::X, -0.125 * DVec3::Y, -0.125 * DVec3::Z]);
    assert_eq!(wait(simulation.spawn(&more)).expect("spawned"), [6, 7, 8]);
    assert_eq!(counted(&mut simulation), [new + 11 + new + 3 + 3 * new, 5]);
    assert_eq!(counted(&mut simulation), [new + 12 + new + 4 + 3 * (new + 1), 5]);
}

#[test]
fn history_of_pairs_is_of_particles_not_of_rows() {
    history_is_of_particles(on_device);
    history_is_of_particles(by_references);
}

#[test]
fn a_device_that_does_not_hold_more_says_so_and_goes_on() {
    let shared = support::device();
    let (device, queue) = pollster::block_on(support::limited(&shared, |limits| {
        limits.max_storage_buffer_binding_size = 16 * 1024;
        limits.max_buffer_size = 16 * 1024;
    }));
    let setup = Setup {
        integrator: integrator("leapfrog"),
        ..setup(some(600, 2), vec![force("drag", &[])], Bounds::default())
    };
    let mut simulation = Simulation::new(&device, &queue, &setup).expect("a simulation");
    simulation.step(2).expect("steps");
    let before = bits(&state(&mut simulation));
    let why = wait(simulation.spawn(&some(700, 3))).expect_err("a refusal");
    assert!(matches!(why, Error::Limit(_)) && why.to_string().contains("1300 particles need"), "{why}");
    assert_eq!((bits(&state(&mut simulation)), simulation.capacity(), simulation.generation()), (before, 600, 0));
    assert_eq!(wait(simulation.spawn(&some(100, 3))).expect("room").len(), 100);
}
