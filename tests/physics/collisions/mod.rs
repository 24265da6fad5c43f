//! Bodies that merge, and bodies that bounce: conservation laws, closed forms and published rates.

mod bounces;
mod mergers;

use glam::DVec3;
use motes::forces::Component;
use motes::integrators::Precise;
use motes::kernel::{Array, Backend, Column, Kind, Machine, Precision};
use motes::lockstep::compare;
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::{Bounds, Cpu, Error, Gpu, Setup, Side, Simulation, State};

use crate::support::states::{force, integrator, word};
use crate::support::{self, Random, Shared, machines};

pub fn merging() -> Box<dyn Component> {
    force("collide", &[])
}

fn bouncing(restitution: f64) -> Box<dyn Component> {
    force("collide", &[("outcome", word("bounce")), ("restitution", Value::Number(restitution))])
}

fn near(range: f64, settings: &[(&'static str, Value)]) -> Box<dyn Component> {
    let search = [("over", word("near")), ("range", Value::Number(range))];
    force("collide", &[settings, &search].concat())
}

/// Gives all bodies radii.
fn with_radii(mut state: State, radii: Vec<f64>) -> State {
    let column = Column::new("collision_radius", Kind::Scalar, "length", "of the sphere that collides").required();
    state.declare(&column).expect("a column");
    state.set("collision_radius", Array::Float(radii)).expect("radii");
    state
}

/// Bodies by place, velocity, mass and radius.
fn bodies(all: &[(DVec3, DVec3, f64, f64)]) -> State {
    let mut state = State::default();
    all.iter().for_each(|(x, v, mass, _)| state.push(*x, *v, *mass, 0.0));
    with_radii(state, all.iter().map(|one| one.3).collect())
}

fn references(setup: &Setup) -> Simulation<Cpu> {
    Simulation::on(Cpu::new(setup.check().expect("a setup")).expect("references"), setup).expect("a simulation")
}

fn on(shared: &Shared, setup: &Setup) -> Simulation<Gpu> {
    Simulation::new(&shared.found.device, &shared.found.queue, setup).expect("a simulation")
}

fn state<B: Backend>(simulation: &mut Simulation<B>) -> State {
    pollster::block_on(simulation.snapshot()).expect("a snapshot")
}

fn momentum(state: &State) -> DVec3 {
    state.mass().iter().zip(state.velocity()).map(|(m, v)| *m * *v).sum()
}

fn centre(state: &State) -> DVec3 {
    let all: DVec3 = state.mass().iter().zip(state.position()).map(|(m, x)| *m * *x).sum();
    all / state.mass().iter().sum::<f64>()
}

fn kinetic(state: &State) -> f64 {
    state.mass().iter().zip(state.velocity()).map(|(m, v)| 0.5 * *m * v.length_squared()).sum()
}

/// A crowd in which many touch, some of them fixed, without mass, or gone.
fn crowd(count: usize, seed: u64, single: bool) -> State {
    let mut random = Random::new(seed);
    let mut state = State::default();
    for k in 0..count {
        let mass = if k % 7 == 3 { 0.0 } else { 1.0 + 0.5 * random.next() };
        state.push(0.9 * random.vector(), random.vector(), mass, 0.03);
    }
    let radii = (0..count).map(|_| 0.05 * (1.5 + random.next())).collect();
    let mut state = with_radii(state, radii);
    if !single {
        state.held =
            (0..count).step_by(5).map(|id| Held { id: u32::try_from(id).expect("few"), by: Hold::Fixed }).collect();
        (0..count).step_by(5).for_each(|id| state.velocity_mut()[id] = DVec3::ZERO);
    }
    state
}

#[test]
fn every_kernel_agrees_with_its_reference() {
    let shared = support::device();
    let periodic = Bounds::new(DVec3::splat(-1.0), DVec3::splat(1.0), Side::Periodic);
    let outcomes: [&[(&'static str, Value)]; 2] =
        [&[], &[("outcome", word("bounce")), ("restitution", Value::Number(0.7))]];
    for (turn, precision) in
        [Precision::Single, Precision::Compensated, Precision::DoubleSingle].into_iter().enumerate()
    {
        for (name, machine) in machines::machines(&shared) {
            for (place, (count, bounds)) in
                [(2usize, periodic), (65, Bounds::default()), (333, periodic)].into_iter().enumerate()
            {
                for outcome in outcomes {
                    let seed = (turn + 3 * place) as u64;
                    let grid = precision != Precision::DoubleSingle && place == 2;
                    let bounds = if precision.is_double() { Bounds::default() } else { bounds };
                    let force = if grid { near(0.4, outcome) } else { force("collide", outcome) };
                    let integrator = Box::new(Precise { integrator: integrator("leapfrog"), precision });
                    let state = crowd(count, seed, place < 2);
                    let setup = Setup { bounds, integrator, ..Setup::new(state, vec![force], 0.02) };
                    let verdicts = stepped(&shared, &setup, machine, count);
                    let own = verdicts.iter().filter(|verdict| verdict.kernel.starts_with("collide"));
                    assert!(own.clone().count() >= 2, "{name}: {verdicts:?}");
                    for verdict in own {
                        // Parts of masses and lines of centres are single numbers: what they make of a low word is as rounded as forces are.
                        let good = if precision.is_double() { verdict.sound() } else { verdict.good() };
                        assert!(good, "{precision:?}, {name}, {count}, {outcome:?}: {verdict:?}");
                    }
                }
            }
        }
    }
}

fn stepped(shared: &Shared, setup: &Setup, machine: Machine, count: usize) -> Vec<motes::lockstep::Verdict> {
    let mut gpu = machines::gpu(shared, count);
    gpu.pretend(machine);
    let mut simulation = Simulation::on(gpu, setup).expect("a simulation");
    simulation.step(1).expect("a step");
    let plan = setup.plans(machine).expect("plans").step;
    let gpu = simulation.backend();
    gpu.compile(&plan).expect("a program");
    pollster::block_on(compare(gpu, &plan, u32::try_from(count).expect("few"))).expect("verdicts")
}

#[test]
fn what_outgrows_the_search_ends_the_run() {
    let shared = support::device();
    let at = |x: f64| (DVec3::new(x, 0.0, 0.0), DVec3::ZERO, 1.0, 0.1);
    let setup = Setup::new(bodies(&[at(0.0), at(5.0), at(5.1)]), vec![near(0.2, &[])], 0.01);
    let mut device = on(&shared, &setup);
    device.step(3).expect("steps");
    let mut host = references(&setup);
    host.step(3).expect("steps");
    for error in [pollster::block_on(device.check()), pollster::block_on(host.check())] {
        assert!(matches!(error, Err(Error::Outgrown { particle: 1, largest: 0.1 })), "{error:?}");
    }
    // With room for two there is none.
    let mut device = on(&shared, &Setup::new(bodies(&[at(0.0), at(5.0), at(5.1)]), vec![near(0.26, &[])], 0.01));
    device.step(3).expect("steps");
    pollster::block_on(device.check()).expect("no alarm");
}

#[test]
fn what_it_refuses() {
    let shared = support::device();
    let refused = |setup: &Setup| {
        Simulation::new(&shared.found.device, &shared.found.queue, setup).err().expect("refused").to_string()
    };
    let two = || bodies(&[(DVec3::ZERO, DVec3::ZERO, 1.0, 0.1), (DVec3::X, DVec3::ZERO, 1.0, 0.1)]);
    let text = refused(&Setup { integrator: integrator("beeman"), ..Setup::new(two(), vec![merging()], 0.01) });
    assert!(text.contains("beeman keeps") && text.contains("choose leapfrog"), "{text}");
    let bath = force("langevin", &[("temperature", Value::Number(1.0))]);
    assert!(
        Simulation::new(&shared.found.device, &shared.found.queue, &Setup::new(two(), vec![bouncing(1.0), bath], 0.01))
            .is_ok()
    );
    let bath = force("nose_hoover", &[("temperature", Value::Number(1.0))]);
    let text = refused(&Setup::new(two(), vec![merging(), bath], 0.01));
    assert!(text.contains("leave out emitters, drains and mergers"), "{text}");
    let mut state = two();
    let charge = Column::new("charge", Kind::Scalar, "charge", "its charge, with sign");
    state.declare(&charge).expect("a column");
    let coulomb = || force("coulomb", &[("range", Value::Number(0.4))]);
    let text = refused(&Setup::new(state.clone(), vec![merging(), coulomb()], 0.01));
    assert!(text.contains("the `charge` of coulomb"), "{text}");
    assert!(
        Simulation::new(
            &shared.found.device,
            &shared.found.queue,
            &Setup::new(state, vec![bouncing(1.0), coulomb()], 0.01)
        )
        .is_ok()
    );
    let mut state = two();
    state.links.springs.push(motes::links::Link { ends: [0, 1], rest: 1.0, stiffness: 1.0, damping: 0.0, rope: false });
    let text = refused(&Setup::new(state, vec![merging(), force("spring", &[])], 0.01));
    assert!(text.contains("some are linked"), "{text}");
    let text = refused(&Setup::new(two(), vec![near(0.0, &[])], 0.01));
    assert!(text.contains("`range`"), "{text}");
    let text = refused(&Setup::new(two(), vec![force("collide", &[("range", Value::Number(1.0))])], 0.01));
    assert!(text.contains("over = \"near\""), "{text}");
    let elastic = |outcome: &'static str, restitution: f64| {
        force("collide", &[("outcome", word(outcome)), ("restitution", Value::Number(restitution))])
    };
    let text = refused(&Setup::new(two(), vec![elastic("merge", 0.5)], 0.01));
    assert!(text.contains("restitution = 0.5 is that of outcome = \"bounce\""), "{text}");
    let text = refused(&Setup::new(two(), vec![elastic("bounce", 1.5)], 0.01));
    assert!(text.contains("part 1.5 times as fast") && text.contains("give 1 at most"), "{text}");
    let text = refused(&Setup::new(two(), vec![merging(), bouncing(1.0)], 0.01));
    // What is said of two, and not of what one of them lacks.
    assert!(text.contains("collide is there twice") && text.contains("one other in a step"), "{text}");
    let text = refused(&Setup::new(two(), vec![near(0.15, &[])], 0.01));
    assert!(text.contains("collision_radius 0.1") && text.contains("half of the `range`"), "{text}");
    let text = refused(&Setup::new(with_radii(two(), vec![0.1, -0.1]), vec![merging()], 0.01));
    assert!(text.contains("collision_radius -0.1"), "{text}");
    let lennard = force("lennard_jones", &[("range", Value::Number(0.3)), ("over", word("within"))]);
    let text = refused(&Setup::new(two(), vec![merging(), lennard], 0.01));
    assert!(text.contains("evaluates all pairs"), "{text}");
}

/// What a run would miss, or not hold up, is remarked on before.
#[test]
fn what_is_remarked_on() {
    let remarks = |start: &State, forces: Vec<Box<dyn Component>>| -> Vec<(&'static str, Option<f64>, String)> {
        let setup = Setup::new(start.clone(), forces, 0.01);
        let all = pollster::block_on(motes::diagnose::diagnose(&setup)).expect("remarks");
        let all = all.iter().filter(|remark| remark.id.ends_with("-collisions"));
        all.map(|remark| (remark.id, remark.number("particles"), remark.to_string())).collect()
    };
    // In a step they move by 0.19, 0.21 and 0.25; the diameter is 0.2.
    let bodies = |radius: f64| {
        let at = |x: f64, speed: f64| (DVec3::new(x, 0.0, 0.0), DVec3::Y * speed, 1.0, radius);
        bodies(&[at(0.0, 19.0), at(1.0, 21.0), at(2.0, 25.0)])
    };
    let gravity = || force("gravity", &[("softening", Value::Number(0.1))]);
    assert_eq!(remarks(&bodies(0.1), vec![merging(), gravity()]), []);
    let one = |all: Vec<(&'static str, Option<f64>, String)>| {
        assert_eq!(all.len(), 1, "{all:?}");
        all.into_iter().next().expect("a remark")
    };
    let (id, count, text) = one(remarks(&bodies(0.1), vec![bouncing(1.0), gravity()]));
    assert!(
        (id, count) == ("fast-collisions", Some(2.0)) && text.contains("particle 1 of radius 0.1 moves by 2.100e-1"),
        "{text}"
    );
    assert_eq!(remarks(&bodies(0.13), vec![bouncing(1.0), gravity()]), []);
    // Where they are searched in a range each has half of it.
    let (id, count, text) = one(remarks(&bodies(0.1), vec![near(0.6, &[]), gravity()]));
    assert!((id, count) == ("fast-collisions", Some(2.0)) && text.contains("half of the range"), "{text}");
    assert_eq!(remarks(&bodies(0.1), vec![near(0.72, &[]), gravity()]), []);
    // Gravity presses together what does not part.
    let (id, _, text) = one(remarks(&bodies(0.2), vec![bouncing(0.5), gravity()]));
    assert!(
        id == "resting-collisions" && text.contains("gravity presses together") && text.contains("`contact`"),
        "{text}"
    );
    assert_eq!(remarks(&bodies(0.2), vec![bouncing(0.5)]), []);
}
