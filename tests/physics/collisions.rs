//! Bodies that merge, and bodies that bounce: conservation laws, closed forms and published rates.

use std::f64::consts::PI;

use glam::DVec3;
use motes::forces::Component;
use motes::integrators::{Adaptive, Precise};
use motes::kernel::{AdaptiveStep, Array, Backend, Column, Kind, Machine, Precision};
use motes::life::Life;
use motes::lockstep::compare;
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::{Bounds, Cpu, Error, Gpu, Setup, Side, Simulation, State};

use crate::support::states::{force, integrator, phase, word};
use crate::support::{self, Random, Shared, machines};

fn merging() -> Box<dyn Component> {
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

/// Two bodies meet head-on, beside one that they pass.
#[test]
fn two_become_one() {
    let start = bodies(&[
        (DVec3::new(-1.0, 0.02, 0.0), DVec3::new(1.0, 0.0, 0.1), 1.0, 0.1),
        (DVec3::new(1.0, -0.01, 0.0), DVec3::new(-0.5, 0.0, 0.0), 3.0, 0.2),
        (DVec3::new(0.0, 0.0, 0.7), DVec3::ZERO, 2.0, 0.1),
    ]);
    for precision in [Precision::Single, Precision::Compensated, Precision::DoubleSingle] {
        let integrator = Box::new(Precise { integrator: integrator("leapfrog"), precision });
        let setup = Setup { integrator, ..Setup::new(start.clone(), vec![merging()], 0.01) };
        let mut simulation = references(&setup);
        simulation.step(200).expect("steps");
        let end = state(&mut simulation);
        assert_eq!(end.life(), [Life::Removed, Life::Active, Life::Active], "{precision:?}");
        let apart = |a: DVec3, b: DVec3| (a - b).length();
        let v = DVec3::new(-0.125, 0.0, 0.025);
        assert!(apart(end.velocity()[1], v) < 1e-12, "{precision:?}: {}", end.velocity()[1]);
        // Where the centre of mass of the two is.
        let x = DVec3::new(0.5, -0.0025, 0.0) + 2.0 * v;
        assert!(apart(end.position()[1], x) < 1e-9, "{precision:?}: {}", end.position()[1]);
        assert_eq!((end.mass()[1], end.mass()[0], end.velocity()[0]), (4.0, 0.0, DVec3::ZERO));
        assert_eq!((end.mass()[2], end.position()[2]), (2.0, DVec3::new(0.0, 0.0, 0.7)));
        let radius = end.scalar("collision_radius").expect("radii")[1];
        assert!((radius - 0.009f64.cbrt()).abs() < 1e-9, "{radius}");
        assert_eq!(end.whole("merged_into").expect("ids"), [2, 0, 0]);
        // They touch where (2 − 1.5 t)² + 0.03² + (0.1 t)² = 0.3²: at the end of that step.
        let exact = (6.0 - (36.0f64 - 4.0 * 2.26 * (4.0 - 0.0891)).sqrt()) / 4.52;
        let time = end.scalar("merge_time").expect("times")[0];
        assert!(time >= exact && time < exact + 0.01, "{time}, {exact}");
    }
}

/// What is quicker than its size in a step merges all the same, and only what crosses does.
#[test]
fn paths_of_a_step_cross() {
    let shared = support::device();
    for (miss, merges) in [(0.0, true), (0.18, true), (0.22, false)] {
        for force in [merging(), near(30.0, &[])] {
            let start = bodies(&[
                (DVec3::new(-5.3, miss, 0.0), DVec3::new(7.0, 0.0, 0.0), 1.0, 0.1),
                (DVec3::new(4.0, 0.0, 0.0), DVec3::new(-4.0, 0.0, 0.0), 1.0, 0.1),
            ]);
            let setup = Setup::new(start, vec![force], 1.0);
            let (mut device, mut host) = (on(&shared, &setup), references(&setup));
            device.step(3).expect("steps");
            host.step(3).expect("steps");
            for end in [state(&mut device), state(&mut host)] {
                assert_eq!(end.life().contains(&Life::Removed), merges, "{miss}");
                assert!((momentum(&end) - DVec3::new(3.0, 0.0, 0.0)).length() < 1e-6);
            }
        }
    }
}

/// Of equal bodies the first remains; a fixed one stays where it is, and takes up a heavier one; two fixed ones, and two without mass, do not merge.
#[test]
fn which_one_remains() {
    let shared = support::device();
    let at = |x: f64, mass: f64| (DVec3::new(x, 0.0, 0.0), DVec3::new(0.0, 0.3, 0.0), mass, 0.1);
    let mut start = bodies(&[
        at(0.0, 1.0),
        at(0.1, 1.0),
        at(1.0, 1.0),
        at(1.1, 5.0),
        at(2.0, 1.0),
        at(2.1, 1.0),
        at(3.0, 0.0),
        at(3.1, 0.0),
        at(4.0, 0.0),
        at(4.1, 0.5),
    ]);
    let fixed = [2u32, 4, 5];
    fixed.iter().for_each(|id| start.velocity_mut()[*id as usize] = DVec3::ZERO);
    start.held = fixed.iter().map(|id| Held { id: *id, by: Hold::Fixed }).collect();
    let setup = Setup::new(start.clone(), vec![merging()], 0.125);
    let (mut device, mut host) = (on(&shared, &setup), references(&setup));
    device.step(2).expect("steps");
    host.step(2).expect("steps");
    for end in [state(&mut device), state(&mut host)] {
        let removed: Vec<usize> = (0..10).filter(|id| end.life()[*id] == Life::Removed).collect();
        assert_eq!(removed, [1, 3, 8]);
        assert_eq!(end.whole("merged_into").expect("ids"), [0, 1, 0, 3, 0, 0, 0, 0, 10, 0]);
        let fixed = (end.mass()[2], end.position()[2], end.velocity()[2]);
        assert_eq!(fixed, (6.0, start.position()[2], DVec3::ZERO));
        assert_eq!((end.mass()[9], end.velocity()[9].y as f32), (0.5, 0.3));
    }
}

/// In each step each body merges with one other at most, and all that touch have merged in the end.
#[test]
fn a_chain_merges_from_step_to_step() {
    let shared = support::device();
    let row = |k: usize| (DVec3::new(0.125 * k as f64, 0.0, 0.0), DVec3::ZERO, 1.0, 0.15);
    let setup = Setup::new(bodies(&(0..6).map(row).collect::<Vec<_>>()), vec![merging()], 0.01);
    let mut simulation = on(&shared, &setup);
    let mut left = Vec::new();
    for _ in 0..6 {
        simulation.step(1).expect("a step");
        let now = state(&mut simulation);
        left.push(now.life().iter().filter(|life| **life == Life::Active).count());
        assert!((centre(&now).x - 0.3125).abs() < 1e-6 && now.mass().iter().sum::<f64>() == 6.0);
    }
    // Of equal distances the lower row counts: first 0 and 1 merge, whose centre is then nearer to that of 2 and 3 than these to 4.
    assert!(left.windows(2).all(|two| two[1] == two[0] - 1 || two[1] == 1), "{left:?}");
    assert_eq!((left[0], left[5]), (5, 1), "{left:?}");
}

/// A ball of bodies at rest that collapses under its own gravity.
fn collapse(count: usize, seed: u64) -> State {
    let mut random = Random::new(seed);
    let mut state = State::default();
    while state.len() < count {
        let x = random.vector();
        if x.length() < 1.0 {
            state.push(x, 0.2 * random.vector(), 1.0, 0.02);
        }
    }
    let drift = momentum(&state) / count as f64;
    state.velocity_mut().iter_mut().for_each(|v| *v -= drift);
    with_radii(state, vec![0.015; count])
}

fn attraction() -> Box<dyn Component> {
    force("gravity", &[("g", Value::Number(0.002)), ("softening", Value::Number(0.01))])
}

/// Masses as the records of mergers tell them: each body has those of all that were merged into it.
fn told(end: &State) -> Vec<f64> {
    let (into, time) = (end.whole("merged_into").expect("ids"), end.scalar("merge_time").expect("times"));
    let mut mass = vec![1.0; end.len()];
    let mut order: Vec<usize> = (0..end.len()).filter(|id| into[*id] > 0).collect();
    order.sort_by(|a, b| time[*a].total_cmp(&time[*b]));
    for id in order {
        let to = into[id] as usize - 1;
        assert!(into[to] == 0 || time[to] > time[id], "{id} went into {to} when that was gone");
        mass[to] += std::mem::take(&mut mass[id]);
    }
    mass
}

#[test]
fn a_collapse_conserves_mass_momentum_and_volume() {
    let shared = support::device();
    for (seed, precision, force) in [
        (3, Precision::Single, merging()),
        (4, Precision::Compensated, merging()),
        (5, Precision::DoubleSingle, merging()),
        (6, Precision::Single, near(0.5, &[])),
    ] {
        let start = collapse(500, seed);
        let integrator = Box::new(Precise { integrator: integrator("leapfrog"), precision });
        let setup = Setup { integrator, ..Setup::new(start.clone(), vec![attraction(), force], 0.004) };
        let mut simulation = on(&shared, &setup);
        simulation.step(260).expect("steps");
        pollster::block_on(simulation.check()).expect("no alarm");
        let end = state(&mut simulation);
        let left = end.life().iter().filter(|life| **life == Life::Active).count();
        assert!(left < 450 && left > 1, "{seed}: {left} are left");
        // Masses are integers, which single precision adds exactly.
        assert_eq!(end.mass(), told(&end), "{seed}");
        assert_eq!(end.mass().iter().sum::<f64>(), 500.0);
        // Each of 260 sums of forces, and each merger, is rounded to 6e-8 of velocities and forces of about 1: by chance.
        assert!(momentum(&end).length() < 2e-3, "{seed}: {}", momentum(&end));
        assert!((centre(&end) - centre(&start)).length() < 1e-4, "{seed}: {}", centre(&end));
        let radii = end.scalar("collision_radius").expect("radii");
        for id in (0..500).filter(|id| end.life()[*id] == Life::Active) {
            let right = 0.015 * end.mass()[id].cbrt();
            assert!((radii[id] / right - 1.0).abs() < 1e-5, "{seed}, {id}: {} for {right}", radii[id]);
            // So do the sizes in pictures.
            assert!((end.size()[id] / (0.02 * end.mass()[id].cbrt()) - 1.0).abs() < 1e-5);
        }
        // Batches and searches change no bit.
        let other = if seed == 3 { near(0.5, &[]) } else { merging() };
        let forces = vec![attraction(), if seed == 6 { near(0.5, &[]) } else { other }];
        let integrator = setup.integrator.clone();
        let mut same = on(&shared, &Setup { integrator, ..Setup::new(start, forces, 0.004) });
        for steps in [1, 7, 92, 160] {
            same.step(steps).expect("steps");
            pollster::block_on(same.check()).expect("no alarm");
        }
        let again = state(&mut same);
        assert_eq!((end.position(), end.velocity(), end.mass()), (again.position(), again.velocity(), again.mass()));
    }
}

#[test]
fn a_run_goes_on_to_the_bit() {
    let shared = support::device();
    for precision in [Precision::Single, Precision::DoubleSingle] {
        let make = |state: State| {
            let integrator = Box::new(Precise { integrator: integrator("leapfrog"), precision });
            Setup { integrator, ..Setup::new(state, vec![attraction(), merging()], 0.004) }
        };
        let mut whole = on(&shared, &make(collapse(300, 8)));
        whole.step(150).expect("steps");
        let middle = state(&mut whole);
        assert!(middle.life().contains(&Life::Removed));
        whole.step(150).expect("steps");
        let mut again = on(&shared, &make(middle));
        assert!(again.goes_on());
        again.step(150).expect("steps");
        let ends = [state(&mut whole), state(&mut again)];
        assert_eq!(ends[0].position(), ends[1].position(), "{precision:?}");
        for name in ["collision_radius", "merge_time"] {
            assert_eq!(ends[0].scalar(name), ends[1].scalar(name), "{precision:?}, {name}");
        }
        assert_eq!(ends[0].whole("merged_into"), ends[1].whole("merged_into"));
    }
}

/// Two bodies fall from rest: t = √(r³ / 2 G M) (√(x (1 − x)) + arccos √x) from r to x r.
#[test]
fn a_fall_ends_when_the_bodies_touch() {
    let (r, reach, m) = (1.0f64, 0.02, 1.25f64);
    let x = reach / r;
    let time = (r.powi(3) / (2.0 * m)).sqrt() * ((x * (1.0 - x)).sqrt() + x.sqrt().acos());
    let start = bodies(&[
        (DVec3::new(0.8, 0.0, 0.0), DVec3::ZERO, 0.25, 0.005),
        (DVec3::new(-0.2, 0.0, 0.0), DVec3::ZERO, 1.0, 0.015),
    ]);
    let adaptive_step = AdaptiveStep { least: 1e-6, courant: 0.25, before: None };
    for (name, dt, before, after) in [("gauss_radau", 0.01, 1e-3, 0.01), ("rk4", 1e-4, 1e-4, 2e-4)] {
        let forces = vec![force("gravity", &[]), merging()];
        let mut setup = Setup { integrator: integrator(name), ..Setup::new(start.clone(), forces, dt) };
        if name == "gauss_radau" {
            setup.integrator = Box::new(Adaptive { integrator: integrator(name), adaptive_step });
        }
        let mut simulation = references(&setup);
        while state(&mut simulation).life()[0] == Life::Active {
            simulation.step(10).expect("steps");
            pollster::block_on(simulation.check()).expect("no alarm");
        }
        let end = state(&mut simulation);
        let found = end.scalar("merge_time").expect("times")[0];
        assert!(found > time - before && found < time + after, "{name}: {found} for {time}");
        // At rest, where the centre of mass is.
        assert!(end.velocity()[1].length() < 1e-9 && end.position()[1].length() < 1e-9, "{name}");
    }
}

/// Hard spheres on a lattice in a periodic box, all as fast.
fn gas(cells: usize, spacing: f64, seed: u64) -> (State, Bounds) {
    let mut random = Random::new(seed);
    let mut state = State::default();
    for k in 0..cells.pow(3) {
        let [x, y, z] = [k % cells, k / cells % cells, k / cells / cells].map(|i| i as f64 + 0.5);
        state.push(spacing * DVec3::new(x, y, z), 3f64.sqrt() * random.vector().normalize(), 1.0, 0.0);
    }
    let count = state.len();
    let drift = momentum(&state) / count as f64;
    state.velocity_mut().iter_mut().for_each(|v| *v -= drift);
    let bounds = Bounds::new(DVec3::ZERO, DVec3::splat(spacing * cells as f64), Side::Periodic);
    (with_radii(state, vec![0.5; count]), bounds)
}

/// Spheres that lose no energy take on Maxwell's distribution: from equal speeds ⟨v⁴⟩ / ⟨v²⟩² goes from 1 to 5/3.
#[test]
fn elastic_spheres_become_a_gas() {
    let shared = support::device();
    for seed in [1, 2] {
        let (start, bounds) = gas(12, 1.9, seed);
        let forces = vec![near(1.0, &[("outcome", word("bounce"))])];
        let mut simulation = on(&shared, &Setup { bounds, ..Setup::new(start.clone(), forces, 0.02) });
        simulation.step(600).expect("steps");
        let end = state(&mut simulation);
        // Some 6000 collisions, each of which rounds the energy of two by 1e-7.
        assert!((kinetic(&end) / kinetic(&start) - 1.0).abs() < 2e-6, "{seed}: {}", kinetic(&end));
        assert!((momentum(&end) - momentum(&start)).length() < 1e-2, "{seed}: {}", momentum(&end));
        let mean = |power: i32| end.velocity().iter().map(|v| v.length().powi(power)).sum::<f64>() / end.len() as f64;
        let kurtosis = mean(4) / mean(2).powi(2);
        // √(8 / 3 N) · … of 1728 samples of it is about 0.04.
        assert!((kurtosis - 5.0 / 3.0).abs() < 0.15, "{seed}: {kurtosis}");
    }
}

/// Haff's law (J. Fluid Mech. 134, 401, 1983): spheres that lose energy cool as T = T₀ / (1 + t / τ)², 1 / τ = (1 − e²) ω / 6, with Enskog's rate of
/// collisions ω = 4 n d² χ √(π T₀ / m) and χ of Carnahan & Starling (J. Chem. Phys. 51, 635, 1969).
#[test]
fn inelastic_spheres_cool_by_haffs_law() {
    let shared = support::device();
    let (restitution, spacing, dt, steps) = (0.8f64, 2.4f64, 0.02, 1000);
    // The gas of equal speeds first becomes one of Maxwell's.
    let (start, bounds) = gas(14, spacing, 7);
    let run = |state: State, restitution: f64, steps: u32| {
        let settings = [("outcome", word("bounce")), ("restitution", Value::Number(restitution))];
        let setup = Setup { bounds, ..Setup::new(state, vec![near(1.0, &settings)], dt) };
        let mut simulation = on(&shared, &setup);
        simulation.step(steps).expect("steps");
        self::state(&mut simulation)
    };
    let warm = run(start, 1.0, 800).begin_anew();
    let temperature = |state: &State| 2.0 * kinetic(state) / (3.0 * state.len() as f64);
    let first = temperature(&warm);
    let last = temperature(&run(warm, restitution, steps));
    let density = spacing.powi(-3);
    let part = PI / 6.0 * density;
    let crowded = (1.0 - 0.5 * part) / (1.0 - part).powi(3);
    let rate = 4.0 * density * crowded * (PI * first).sqrt() * (1.0 - restitution * restitution) / 6.0;
    let right = first / (1.0 + rate * dt * f64::from(steps)).powi(2);
    // 2744 spheres have some 13 000 collisions. Steps of a fortieth of a diameter find a grazing one in a hundred too late.
    assert!((last / right - 1.0).abs() < 0.04, "{first} cools to {last}, for {right}");
    assert!(right < 0.6 * first);
}

/// The ball that meets another of e and masses m, M at an angle: momentum, angular momentum, and the speed at which they part.
#[test]
fn bounces_in_the_large() {
    for (restitution, mass) in [(1.0, 1.0), (0.5, 3.0), (0.25, 0.0)] {
        let start = bodies(&[
            (DVec3::new(-0.3, 0.05, 0.02), DVec3::new(2.0, 0.3, 0.0), 2.0, 0.1),
            (DVec3::new(0.0, 0.0, 0.0), DVec3::new(0.0, -0.2, 0.1), mass, 0.1),
        ]);
        let mut simulation = references(&Setup::new(start.clone(), vec![bouncing(restitution)], 0.01));
        let mut before = (start.position().to_vec(), start.velocity().to_vec());
        let bounced = (0..40).find_map(|_| {
            simulation.step(1).expect("a step");
            let (x, v) = phase(&mut simulation);
            let [x, v] = [x, v].map(|all| all.iter().map(|one| one.truncate()).collect::<Vec<_>>());
            let was = std::mem::replace(&mut before, (x.clone(), v.clone()));
            (v[0] != was.1[0] || v[1] != was.1[1]).then_some((x, v, was.1))
        });
        let (x, v, was) = bounced.expect("a collision");
        let n = (x[1] - x[0]).normalize();
        let (away, toward) = ((v[1] - v[0]).dot(n), (was[1] - was[0]).dot(n));
        assert!(toward < 0.0 && (away + restitution * toward).abs() < 1e-12, "{away}, {toward}");
        let moment = |v: &[DVec3]| 2.0 * x[0].cross(v[0]) + mass * x[1].cross(v[1]);
        assert!((2.0 * (v[0] - was[0]) + mass * (v[1] - was[1])).length() < 1e-12);
        assert!((moment(&v) - moment(&was)).length() < 1e-12);
        // The tangential part is as it was.
        let across = |u: DVec3| u - u.dot(n) * n;
        assert!((across(v[1] - v[0]) - across(was[1] - was[0])).length() < 1e-12);
    }
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
        state.held = (0..count).step_by(5).map(|id| Held { id: id as u32, by: Hold::Fixed }).collect();
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
                        // What a line of centres of near bodies says of a low word is rounded with their distance.
                        let bounces = precision.is_double() && verdict.kernel == "collide bounce";
                        let good = if bounces { verdict.sound() } else { verdict.good() };
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
    let text = refused(&Setup::new(two(), vec![near(0.15, &[])], 0.01));
    assert!(text.contains("collision_radius 0.1") && text.contains("half of the `range`"), "{text}");
    let text = refused(&Setup::new(with_radii(two(), vec![0.1, -0.1]), vec![merging()], 0.01));
    assert!(text.contains("collision_radius -0.1"), "{text}");
    let lennard = force("lennard_jones", &[("range", Value::Number(0.3)), ("over", word("within"))]);
    let text = refused(&Setup::new(two(), vec![merging(), lennard], 0.01));
    assert!(text.contains("evaluates all pairs"), "{text}");
}
