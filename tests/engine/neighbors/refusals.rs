//! What cannot be searched is said, with the particle or the number, and spoils nothing else.

use glam::{DVec3, DVec4, Vec4};
use motes::forces::{Component, Law, Over, Problem};
use motes::integrators::Step;
use motes::kernel::{ALARM, Backend, Machine, Plan, Source};
use motes::{ACCELERATION, Array, Bounds, Error, POSITION, Side, VELOCITY};

use crate::neighbors::exact::{Whole, by_force, by_sort, found, same, simulation};
use crate::neighbors::variants;
use crate::support::{self, Random, machines};

fn cloud(count: usize) -> Vec<DVec3> {
    let mut random = Random::new(12);
    (0..count).map(|_| random.vector().as_vec3().as_dvec3()).collect()
}

fn refusal(over: Over) -> String {
    let machine = Machine::HOST;
    let forces: [Box<dyn Component>; 1] = [Box::new(Whole(over))];
    let mut step = Step::new(&forces, Problem::new(10, machine));
    step.evaluate();
    match step.finished() {
        Err(Error::Scene(text)) => text,
        other => panic!("{over:?}: {other:?}"),
    }
}

#[test]
fn ranges_that_are_none_are_refused() {
    for range in [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e-20, 1e-300, 1e20, f64::MAX] {
        for over in [Over::Near { range, of: None }, Over::Near { range, of: Some(1) }, Over::Within { range }] {
            let text = refusal(over);
            assert!(text.contains(&format!("a range of {range:e}: ")) && text.contains("1.1e-19"), "{text}");
        }
    }
    for count in [0, 17, u32::MAX] {
        let text = refusal(Over::Nearest { count });
        assert!(text.contains(&format!("`whole` searches {count} nearest neighbours: 1 to 16 are possible")), "{text}");
    }
}

#[test]
fn the_shortest_and_the_longest_ranges_search() {
    let shared = support::device();
    for (range, close) in [(1.1e-19, 1e-19), (1.8e19, 1e19)] {
        let positions: Vec<_> = [0.0, close, close * 30.0].map(|x| (DVec3::X * x).as_vec3().as_dvec3()).to_vec();
        let want = by_force(&positions, &Bounds::default(), range);
        for (name, machine) in variants(&shared) {
            let over = Over::Near { range, of: None };
            let near = found(&shared, Some(machine), &positions, Bounds::default(), over);
            same(&near, &want, &format!("{range}, {name}"));
        }
    }
}

/// Half of a law.
#[derive(Clone)]
struct Half(Over);

impl Component for Half {
    fn laws(&self) -> Vec<Law> {
        let wgsl = "fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(); }";
        let whole = Whole(self.0).laws().remove(0);
        vec![Law { wgsl: Source::ours("half", wgsl), ..whole }]
    }
}

#[test]
fn a_law_without_pairs_is_refused() {
    let machine = Machine::HOST;
    for over in [Over::Near { range: 1.0, of: None }, Over::Nearest { count: 3 }] {
        let forces: [Box<dyn Component>; 1] = [Box::new(Half(over))];
        let mut step = Step::new(&forces, Problem::new(10, machine));
        step.evaluate();
        let Err(Error::Shader { message }) = step.finished() else { panic!("half of a law is a law") };
        assert!(message.contains(over.name()) && message.contains("fn gather("), "{message}");
    }
}

#[test]
fn particles_at_nan_are_named_and_meet_none() {
    let shared = support::device();
    let positions = cloud(200);
    let boxed = Bounds::new(DVec3::splat(-1.0), DVec3::splat(1.0), Side::Periodic);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for bounds in [Bounds::default(), boxed] {
            for over in [Over::Near { range: 0.5, of: None }, Over::Nearest { count: 7 }] {
                for (name, machine) in variants(&shared) {
                    let mut gpu = machines::gpu(&shared, positions.len());
                    gpu.pretend(machine);
                    let mut simulation = simulation(gpu, &positions, bounds, over);
                    let mut places: Vec<DVec4> = positions.iter().map(|x| x.extend(1.0)).collect();
                    (places[60].y, places[131]) = (bad, DVec4::splat(bad));
                    // `Simulation::write` would refuse them.
                    simulation.backend().write(POSITION.name, &Array::Vec4(places)).expect("places");
                    simulation.step(0).expect("a start");
                    let error = pollster::block_on(simulation.check()).expect_err("an alarm");
                    assert!(matches!(error, Error::NotFinite { particle: 60, step: 0 }), "{name}: {error}");
                    // All others have the neighbours that they would have without the two.
                    let mut others = positions.clone();
                    (others[60], others[131]) = (DVec3::NAN, DVec3::NAN);
                    let mut want = match over {
                        Over::Nearest { count } => by_sort(&others, &bounds, count as usize),
                        _ => by_force(&others, &bounds, 0.5),
                    };
                    let mut got = pollster::block_on(simulation.read(ACCELERATION)).expect("accelerations");
                    for list in [&mut want, &mut got] {
                        (list[60], list[131]) = (Vec4::ZERO, Vec4::ZERO);
                    }
                    same(&got, &want, &format!("{bad}, {bounds}, {over:?}, {name}"));
                }
            }
        }
    }
}

#[test]
fn a_velocity_that_is_none_is_named() {
    let shared = support::device();
    let positions = cloud(100);
    let mut simulation =
        simulation(machines::gpu(&shared, 100), &positions, Bounds::default(), Over::Near { range: 0.5, of: None });
    let none = Array::Vec4(vec![DVec4::ZERO, DVec4::new(0.0, f64::NAN, 0.0, 0.0)]);
    simulation.backend().write(VELOCITY.name, &none).expect("velocities");
    simulation.step(0).expect("a start");
    let error = pollster::block_on(simulation.check()).expect_err("an alarm");
    assert!(matches!(error, Error::NotFinite { particle: 1, step: 0 }), "{error}");
}

#[test]
fn a_crowd_is_named() {
    let shared = support::device();
    // Ids from 30 on stand at one place.
    let place = |i: i32| if i < 30 { DVec3::X * f64::from(i) / 10.0 } else { DVec3::Y * 10.0 };
    let positions: Vec<DVec3> = (0..1030).map(place).collect();
    for over in [Over::Near { range: 1.0, of: None }, Over::Nearest { count: 5 }] {
        for (name, machine) in variants(&shared) {
            let mut gpu = machines::gpu(&shared, positions.len());
            gpu.pretend(machine);
            let problem = Problem::new(1030, machine).at(&positions, Bounds::default());
            let law = Whole(over).laws().remove(0);
            let (grid, moving) = law.grid(&problem).expect("a range").expect("a grid");
            let mut kernel = law.kernel(&problem).expect("a law");
            kernel.passes[0].constants.push(("MOST", 900.0));
            let kernels = vec![grid.kernel(&problem, moving).expect("a grid"), kernel];
            let plan = Plan::of(kernels);
            let mut simulation = simulation(gpu, &positions, Bounds::default(), over);
            pollster::block_on(simulation.check()).expect("no alarm yet");
            let program = simulation.backend().compile(&plan).expect("a plan");
            simulation.step(0).expect("a start");
            pollster::block_on(simulation.check()).expect("no alarm yet");
            simulation.backend().run(&program, 1).expect("a search");
            let bytes = pollster::block_on(simulation.backend().bytes(ALARM.name, 0, 12)).expect("an alarm");
            let alarm = bytemuck::pod_collect_to_vec::<u8, u32>(&bytes);
            assert_eq!(&alarm[..2], [u32::MAX; 2], "{over:?}, {name}");
            let error = pollster::block_on(simulation.check()).expect_err("an alarm");
            // A search for the nearest in thin air looks far, and finds the dense part too.
            let first = if over.range().is_some() { 30 } else { 0 };
            assert!(
                matches!(error, Error::TooManyNeighbors { particle } if particle >= first),
                "{over:?}, {name}: {error}"
            );
            assert!(over.range().is_none() || alarm[2] == 30, "{name}: {alarm:?}");
        }
    }
}
