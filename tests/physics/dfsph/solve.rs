//! What a solve leaves, against the same in f64 as the paper writes it.

use glam::{DVec3, Vec4};
use motes::kernel::Element;
use motes::settings::Value;
use motes::{Bounds, POSITION, Simulation, VELOCITY};

use crate::dfsph::reference::{Flow, medium};
use crate::dfsph::{SPACING, Tank, WEIGHT, fluid, setup};
use crate::support::{self, Random, Shared};

const DT: f64 = 0.004;

fn stirred(tank: &mut Tank, flat: bool) {
    let mut random = Random::new(5);
    let walls = tank.particles.held.len();
    for v in &mut tank.particles.velocity_mut()[walls..] {
        let way = random.vector() * SPACING * 10.0;
        *v = (if flat { way.with_z(0.0) } else { way }).as_vec3().as_dvec3();
    }
}

fn read<T: Element>(simulation: &mut Simulation<motes::Gpu>, field: motes::kernel::Field<T>) -> Vec<T> {
    pollster::block_on(simulation.read(field)).expect("a field")
}

#[test]
fn a_solve_keeps_the_density_in_as_many_iterations_as_in_f64() {
    let shared = support::device();
    for (numbers, flat) in [([9, 12], true), ([6, 7], false)] {
        let mut tank = Tank::new(numbers, flat, 0.2);
        stirred(&mut tank, flat);
        let mut simulation = tank.simulation(&shared, &[], DT);
        simulation.step(1).expect("a step");
        let solves = pollster::block_on(simulation.pressure_solves()).expect("read").expect("solves");
        let v: Vec<DVec3> = read(&mut simulation, VELOCITY).iter().map(|v| v.truncate().as_dvec3()).collect();

        let (particles, bounds) = (&tank.particles, tank.bounds);
        let wall: Vec<bool> = (0..particles.len()).map(|i| i < tank.walls()).collect();
        let medium = medium(bounds.dimensions);
        // Walls weigh as the device has found.
        let mass = read(&mut simulation, POSITION).iter().map(|x| f64::from(x.w)).collect();
        let (x, v0) = (particles.position().to_vec(), particles.velocity().to_vec());
        let mut flow = Flow::new(medium, x, v0, mass, wall, move |r| bounds.shortest(r));
        let (count, few) = (particles.len(), flow.few());
        let first = flow.solve(&vec![1.0; count], &few, DT, 1e-3, 50);
        let fluid: Vec<usize> = flow.fluid().collect();
        for i in &fluid {
            flow.velocity[*i] -= DT * WEIGHT * tank.up;
        }
        let density: Vec<f64> = (0..count).map(|i| flow.density(i)).collect();
        let second = flow.solve(&density, &vec![false; count], DT, 1e-4, 50);
        for (solve, want) in solves.iter().zip([&first, &second]) {
            assert!(
                solve.iterations.abs_diff(want.iterations) <= 2,
                "{flat}: {solve:?}, and {} in f64",
                want.iterations
            );
            assert!(
                want.iterations > 2 && solve.failures == 0 && solve.all_iterations == solve.iterations,
                "{solve:?}"
            );
            assert!((solve.error / want.error - 1.0).abs() < 0.3, "{solve:?}, and {} in f64", want.error);
        }
        assert!(second.kappa.iter().any(|kappa| *kappa > 0.0));
        // The same in as many iterations, up to rounding that is carried through them; else up to the tolerance.
        let same = solves[0].iterations == first.iterations && solves[1].iterations == second.iterations;
        let off =
            (v.iter().zip(&flow.velocity).map(|(a, b)| (*a - *b).length_squared()).sum::<f64>() / count as f64).sqrt();
        let allowed = if same { 1e-5 } else { 5e-4 } * SPACING / DT;
        assert!(off < allowed, "{flat}: velocities are off by {off}, allowed are {allowed}");
        // What the device's velocities compress, beside what they should.
        flow.velocity = v;
        let over = |i: &usize| (density[*i] + DT * flow.divergence(*i) - 1.0).max(0.0);
        let left = fluid.iter().map(over).sum::<f64>() / fluid.len() as f64;
        let before = fluid.iter().map(|i| (density[*i] - 1.0).max(0.0)).sum::<f64>() / fluid.len() as f64;
        // Rounding of velocities of 0.2 to 1e-8 is 1e-8 · 0.004 / 0.02 of a density, far below.
        assert!(left <= 1e-4 && left <= solves[1].error * 1.001 + 1e-6, "{flat}: {left} are left");
        assert!(before > 10.0 * left, "{before} before, {left} after");
        println!(
            "{flat} {:?} {} {} {off:e} {left:e} {before:e}",
            solves.map(|s| s.iterations),
            first.iterations,
            second.iterations
        );
    }
}

#[test]
fn solves_that_do_not_converge_are_reported() {
    let shared = support::device();
    let mut tank = Tank::new([9, 12], true, 0.2);
    stirred(&mut tank, true);
    let tight = [("tolerance", 1e-5), ("divergence_tolerance", 1e-5), ("max_iterations", 3.0)];
    let mut simulation = tank.simulation(&shared, &tight.map(|(key, x)| (key, Value::Number(x))), DT);
    simulation.step(4).expect("steps");
    for solve in pollster::block_on(simulation.pressure_solves()).expect("read").expect("solves") {
        assert_eq!((solve.solves, solve.failures, solve.first_failure), (4, 4, Some(0)), "{solve:?}");
        assert_eq!((solve.iterations, solve.most_iterations, solve.all_iterations), (3, 3, 12), "{solve:?}");
        assert!(solve.error > 1e-5, "{solve:?}");
    }
}

/// A drop without walls and weight, that is stirred.
fn drop(shared: &Shared) -> Simulation<motes::Gpu> {
    let mut tank = Tank::new([7, 8], false, 0.2);
    stirred(&mut tank, false);
    let mut particles = motes::State::default();
    for i in tank.walls()..tank.particles.len() {
        let p = &tank.particles;
        particles.push(p.position()[i], p.velocity()[i], p.mass()[i], 0.0);
    }
    let setup = setup(&particles, Bounds::default(), vec![fluid(&[])], DT);
    Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation")
}

fn momentum(velocity: &[Vec4]) -> DVec3 {
    velocity.iter().map(|v| v.truncate().as_dvec3()).sum::<DVec3>() / velocity.len() as f64
}

#[test]
fn pressure_keeps_momentum() {
    let shared = support::device();
    let mut simulation = drop(&shared);
    let before = read(&mut simulation, VELOCITY);
    simulation.step(10).expect("steps");
    let after = read(&mut simulation, VELOCITY);
    let changed =
        before.iter().zip(&after).map(|(a, b)| f64::from((*a - *b).length())).sum::<f64>() / before.len() as f64;
    let off = (momentum(&after) - momentum(&before)).length();
    // Sums of 30 pushes each round by 1e-6 of what they are; those errors have no direction, 392 of them ten times.
    assert!(changed > 0.03 && off < 1e-6 * changed, "velocities changed by {changed}, momentum by {off}");
}

#[test]
fn the_same_run_has_the_same_bits_however_often_one_looks() {
    let shared = support::device();
    let run = |looks: bool| {
        let mut simulation = drop(&shared);
        for _ in 0..4 {
            simulation.step(3).expect("steps");
            if looks {
                pollster::block_on(simulation.snapshot()).expect("a state");
            }
        }
        let words = |v: Vec<Vec4>| v.iter().flat_map(|v| v.to_array().map(f32::to_bits)).collect::<Vec<_>>();
        (words(read(&mut simulation, POSITION)), words(read(&mut simulation, VELOCITY)))
    };
    let plain = run(false);
    assert!(plain == run(false), "the second run is another");
    assert!(plain == run(true), "looking changes the run");
}
