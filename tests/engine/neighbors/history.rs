//! History of pairs: a map by the ids of both remembers the same, however often the list is built and evaluated.

use std::collections::BTreeMap;

use glam::{DVec3, DVec4, Vec4};
use motes::forces::{Component, Law, Over};
use motes::kernel::{Backend, Machine, Source};
use motes::{Bounds, Error, Setup, Side, Simulation, State};

use crate::neighbors::growth::{STEPS, collapsed, inward};
use crate::neighbors::list::{
    accelerations, active_places, agree, builds, evaluation, jet, life, on, positions, setup,
};
use crate::neighbors::variants;
use crate::support::{self, machines};

/// A power of two: nothing is rounded, and particles move on.
const PART: f64 = 1.0 / 1_048_576.0;
pub const RANGE: f64 = 0.31;

/// Counts the steps that each pair has been in range without a break, and the ids that it has seen on the way.
#[derive(Clone)]
pub struct Steps {
    pub skin: Option<f64>,
}

impl Component for Steps {
    fn laws(&self) -> Vec<Law> {
        let wgsl = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
            let steps = recall(you, 0u) + 1.0;
            remember(you, 0u, steps);
            // A pair that has met often enough starts over, by leaving nothing.
            if steps < 9.0 { remember(you, 1u, recall(you, 1u) + f32(you.index % 7u)); }
            (*sum).acceleration += vec3f(steps, recall(you, 1u), 1.0);
        }
        fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, 0.0) / 1048576.0; }";
        let over = (RANGE, self.skin, 2);
        vec![Law::remembering(
            "steps",
            over,
            Source::ours("steps", wgsl),
            Vec::new(),
            &["acceleration"],
            |_, you, _, _, memory, sum: &mut DVec3| {
                let [steps, ids] = [0, 1].map(|word| memory.recall(word));
                memory.remember(0, steps + 1.0);
                if steps + 1.0 < 9.0 {
                    memory.remember(1, ids + (you.index % 7) as f64);
                }
                *sum += DVec3::new(steps + 1.0, ids, 1.0);
            },
            |_, sum, _, outcome| outcome.accelerate((PART * *sum).extend(0.0)),
        )]
    }
}

type Map = BTreeMap<(usize, usize), [f64; 2]>;

/// One step of the reference: what pairs remember, and the accelerations.
fn remembered(known: &Map, places: &[DVec3], bounds: &Bounds) -> (Map, Vec<Vec4>) {
    let (mut map, mut acting) = (Map::new(), vec![DVec4::ZERO; places.len()]);
    for i in 0..places.len() {
        let near = |j: &usize| *j != i && bounds.within(places[*j] - places[i], RANGE);
        for j in (0..places.len()).filter(near) {
            let [steps, ids] = known.get(&(i, j)).copied().unwrap_or_default();
            let left = if steps + 1.0 < 9.0 { ids + (j % 7) as f64 } else { 0.0 };
            map.insert((i, j), [steps + 1.0, left]);
            acting[i] += PART * DVec4::new(steps + 1.0, ids, 1.0, 0.0);
        }
    }
    (map, acting.into_iter().map(DVec4::as_vec4).collect())
}

fn flock() -> State {
    let mut state = support::cloud(250, 9);
    state.links = motes::links::Links::default();
    state
}

#[test]
fn a_map_by_ids_remembers_the_same() {
    let shared = support::device();
    let side = |half: f64| Bounds::new(DVec3::splat(-half), DVec3::splat(half), Side::Periodic);
    for (state, bounds, skin) in
        [(flock(), side(1.0), 0.1), (flock(), Bounds::default(), 0.0), (jet(0.15, 0.6, 0.7), side(0.8), 0.15)]
    {
        for (variant, machine) in variants(&shared) {
            let setup = setup(&state, bounds, Box::new(Steps { skin: Some(skin) }), 7e-3);
            let mut simulation = on(&shared, machine, &setup);
            let mut known = Map::new();
            let mut longest = 0.0_f64;
            for step in 0..60 {
                // Measuring, and beginning anew where nothing has changed, are evaluations more.
                if step % 3 == 1 {
                    pollster::block_on(simulation.snapshot()).expect("a snapshot");
                }
                if step % 7 == 2 {
                    let places = positions(&mut simulation);
                    simulation.write(motes::POSITION, &places).expect("places");
                }
                // A particle that is due at the start is spawned there.
                simulation.step(0).expect("a start");
                let before = life(&mut simulation);
                simulation.step(1).expect("a step");
                pollster::block_on(simulation.check()).expect("no alarm");
                // A particle that is spawned or removed at the end of a step has been evaluated as it was before.
                let places = active_places(&mut simulation, before.as_deref());
                let (next, acting) = remembered(&known, &places, &bounds);
                let after = life(&mut simulation);
                let got = accelerations(&mut simulation);
                for i in 0..places.len() {
                    // A drain takes the acceleration.
                    let gone = after.as_ref().is_some_and(|life| life[i] != 1);
                    let of = format!("{bounds}, {variant}, step {step}, particle {i}");
                    assert!(gone || got[i] == acting[i], "{of}: {} is not {}", got[i], acting[i]);
                }
                longest = next.values().map(|[steps, _]| *steps).fold(longest, f64::max);
                known = next;
            }
            let built = builds(&mut simulation);
            assert!(built > 4 && longest > 25.0, "{bounds}, {variant}: built {built} times, {longest} steps");
            let plan = evaluation(&setup, machine);
            agree(&mut simulation, &plan, variant);
            // Far enough for another list, and not out of range.
            let mut places = positions(&mut simulation);
            places.iter_mut().step_by(9).for_each(|x| x.x += 0.08);
            simulation.write(motes::POSITION, &places).expect("places");
            assert!(agree(&mut simulation, &plan, variant), "{variant}: not built");
        }
    }
}

/// A contact: a spring along the way, and one across it that is wound up by sliding.
#[derive(Clone)]
struct Contact;

impl Component for Contact {
    fn laws(&self) -> Vec<Law> {
        let wgsl = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
            let size = max(length(r), 1e-9);
            let n = r / size;
            let v = velocity_of(you) - velocity_of(me);
            let slid = vec3f(recall(you, 0u), recall(you, 1u), recall(you, 2u));
            let wound = slid - dot(slid, n) * n + world.dt * (v - dot(v, n) * n);
            remember(you, 0u, wound.x);
            remember(you, 1u, wound.y);
            remember(you, 2u, wound.z);
            (*sum).acceleration += -20.0 * (0.31 - size) * n + 7.0 * wound;
            (*sum).potential += 20.0 * (0.31 - size) * (0.31 - size);
        }
        fn acts_on(me: Particle) -> bool { return me.index % 6u != 4u; }
        fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }";
        let over = (RANGE, Some(0.08), 3);
        vec![Law::remembering(
            "contact",
            over,
            Source::ours("contact", wgsl),
            Vec::new(),
            &["acceleration"],
            |me, you, r, world, memory, sum: &mut DVec4| {
                if me.index % 6 == 4 {
                    return;
                }
                let (size, v) = (r.length(), you.velocity - me.velocity);
                let n = r / size;
                let slid = DVec3::new(memory.recall(0), memory.recall(1), memory.recall(2));
                let wound = slid - slid.dot(n) * n + world.dt * (v - v.dot(n) * n);
                wound.to_array().into_iter().enumerate().for_each(|(word, value)| memory.remember(word, value));
                let depth = RANGE - size;
                *sum += (-20.0 * depth * n + 7.0 * wound).extend(20.0 * depth * depth);
            },
            |_, sum, _, outcome| outcome.accelerate(*sum),
        )]
    }
}

/// A number that f32 holds.
const DT: f64 = 1.0 / 128.0;

#[test]
fn a_contact_agrees_with_its_reference() {
    let shared = support::device();
    let bounds = Bounds::new(DVec3::splat(-1.0), DVec3::splat(1.0), Side::Periodic);
    for (variant, machine) in variants(&shared) {
        let setup = setup(&flock(), bounds, Box::new(Contact), DT);
        let mut simulation = on(&shared, machine, &setup);
        let plan = evaluation(&setup, machine);
        for _ in 0..6 {
            agree(&mut simulation, &plan, variant);
            simulation.step(7).expect("steps");
        }
        assert!(builds(&mut simulation) > 3);
        // Columns of its own fit: eight buffers are what every device binds.
        let law = plan.kernels.iter().find(|kernel| kernel.name == "contact").expect("a contact");
        let bound: Vec<_> = law.bindings().map(|(name, _)| name).filter(|name| *name != "world").collect();
        assert_eq!(bound, ["position", "velocity", "list", "history", "acceleration"]);
    }
}

#[test]
fn a_run_that_goes_on_remembers_with_the_same_bits() {
    let shared = support::device();
    let bounds = Bounds::new(DVec3::splat(-1.0), DVec3::splat(1.0), Side::Periodic);
    let machine = variants(&shared)[0].1;
    // Lists are built in the middle of each part, and both halves of the history are the one that is kept.
    for (state, stops) in [(flock(), vec![11, 12]), (flock(), vec![1]), (jet(0.15, 0.6, 0.7), vec![20, 41])] {
        let whole = setup(&state, bounds, Box::new(Contact), DT);
        let device = |setup: &Setup| on(&shared, machine, setup);
        let reference = |setup: &Setup| {
            let host = motes::Cpu::new(setup.check().expect("particles")).expect("memory");
            Simulation::on(host, setup).expect("a simulation")
        };
        goes_on(&whole, &stops, device);
        goes_on(&whole, &stops, reference);
    }
}

/// Compares a run that is taken from state to state with one that never stops.
fn goes_on<B: Backend>(whole: &Setup, stops: &[u64], on: impl Fn(&Setup) -> Simulation<B>) {
    let last = 57;
    let snapshot = |simulation: &mut Simulation<B>| pollster::block_on(simulation.snapshot()).expect("a state");
    let step = |simulation: &mut Simulation<B>, to: u64| {
        let steps = u32::try_from(to - simulation.steps()).expect("few");
        simulation.step(steps).expect("steps");
    };
    let mut never = on(whole);
    step(&mut never, last);
    let mut parts = on(whole);
    for stop in stops {
        step(&mut parts, *stop);
        let state = snapshot(&mut parts);
        parts = on(&Setup { state, ..whole.clone() });
        assert!(parts.goes_on(), "from step {stop}");
    }
    step(&mut parts, last);
    let (got, want) = (snapshot(&mut parts), snapshot(&mut never));
    for (column, values) in want.columns() {
        assert!(got.get(&column.name) == Some(values), "{} is other after {stops:?}", column.name);
    }
}

/// History of pairs is carried over where the list grows: the force goes by it.
#[test]
fn a_list_that_grows_remembers() {
    let shared = support::device();
    for (seed, batch) in [(8, 60), (21, STEPS)] {
        let setup = inward(250, seed, Box::new(Steps { skin: Some(0.1) }));
        let [x, v, long_x, long_v] = collapsed(&shared, &setup, batch);
        assert!(x == long_x && v == long_v, "seed {seed}, {batch} steps at a time: other bits");
    }
}

/// Where a force goes by history alone, a run that forgets it is another one.
#[test]
fn history_does_something() {
    let shared = support::device();
    let whole = setup(&flock(), Bounds::default(), Box::new(Steps { skin: Some(0.1) }), DT);
    let mut simulation = on(&shared, variants(&shared)[0].1, &whole);
    simulation.step(20).expect("steps");
    let state = pollster::block_on(simulation.snapshot()).expect("a state");
    let after = |state: State| {
        let mut simulation = on(&shared, variants(&shared)[0].1, &Setup { state, ..whole.clone() });
        simulation.step(9).expect("steps");
        positions(&mut simulation)
    };
    simulation.step(9).expect("steps");
    assert_eq!(after(state.clone()), positions(&mut simulation));
    assert_ne!(after(state.begin_anew()), positions(&mut simulation));
}

#[test]
fn integrators_that_evaluate_more_than_once_are_refused() {
    for entry in motes::integrators::INTEGRATORS {
        let mut setup = setup(&flock(), Bounds::default(), Box::new(Contact), DT);
        setup.integrator = entry.by_default();
        let refused = match setup.plans(Machine::HOST) {
            Ok(_) => None,
            Err(Error::Scene(text)) if text.contains("`contact` keeps history") => Some(text),
            Err(other) => panic!("{}: {other}", entry.name),
        };
        // Of the others, a step evaluates the law at several places.
        let once = ["leapfrog", "symplectic_euler", "forward_euler", "beeman"].contains(&entry.name);
        assert_eq!(
            refused.is_none(),
            once || entry.name.contains("backward") || entry.name.contains("implicit"),
            "{}: {refused:?}",
            entry.name
        );
    }
}

#[test]
fn states_that_say_nothing_of_pairs_are_refused() {
    let shared = support::device();
    let whole = setup(&flock(), Bounds::default(), Box::new(Contact), DT);
    let refused = |state: State, force: Box<dyn Component>| {
        let setup = Setup { state, forces: vec![force], ..whole.clone() };
        match Simulation::on(machines::gpu(&shared, setup.state.len()), &setup).map(drop) {
            Err(Error::Scene(text)) => text,
            other => panic!("{other:?}"),
        }
    };
    let mut state = flock();
    (state.step, state.time) = (3, 3.0 * DT);
    let text = refused(state, Box::new(Contact));
    assert!(text.contains("step 3") && text.contains("NPZ") && text.contains("begin_anew"), "{text}");
    let mut simulation = on(&shared, variants(&shared)[0].1, &whole);
    simulation.step(5).expect("steps");
    let state = pollster::block_on(simulation.snapshot()).expect("a state");
    let text = refused(state, Box::new(Steps { skin: Some(0.1) }));
    assert!(text.contains("3 numbers for each pair") && text.contains("keeps 2"), "{text}");
}

#[test]
fn what_cannot_remember_is_refused() {
    let refusal = |laws: Vec<Box<dyn Component>>| {
        let mut setup = setup(&flock(), Bounds::default(), Box::new(Contact), DT);
        setup.forces = laws;
        match setup.plans(Machine::HOST).map(|_| ()) {
            Err(Error::Scene(text)) => text,
            other => panic!("{other:?}"),
        }
    };
    let text = refusal(vec![Box::new(Contact), Box::new(Steps { skin: Some(0.1) })]);
    assert!(text.contains("`steps` the second of them") && text.contains("slots for one"), "{text}");
    #[derive(Clone)]
    struct Forgetful;
    impl Component for Forgetful {
        fn laws(&self) -> Vec<Law> {
            let mut law = Contact.laws().remove(0);
            law.over = Over::List { range: RANGE, skin: None, slots: 0 };
            vec![law]
        }
    }
    let text = refusal(vec![Box::new(Forgetful)]);
    assert!(text.contains("`recall` is for a law with history of pairs") && text.contains("slots = 3"), "{text}");
}
