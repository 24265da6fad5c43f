//! The device against the references, which solve other equations by another method.

use crate::support::Random;
use crate::support::machines::gpu;
use crate::support::states::integrator;
use glam::{DVec3, Vec4};
use motes::kernel::{Backend, World};
use motes::links::Rod;
use motes::lockstep::compare;
use motes::motion::{Held, Hold};
use motes::{Bounds, POSITION, Side, Simulation, State, VELOCITY};

use crate::rods::{chain, device, forces, read, setup, stretch};

/// Chains of `rods` rods with masses of all sizes, some of them held at an end or in the middle, in no order of ids.
fn tangle(count: usize, rods: usize) -> State {
    let mut random = Random::new(5);
    let mut particles = crate::support::cloud(count, 7);
    // Ids along a chain lie apart from each other.
    let place = |n: usize| (n * 7 + 3) % count;
    for n in 0..count - 1 {
        if n % (rods + 1) < rods {
            let ends = [place(n), place(n + 1)];
            if n % (rods + 1) == 0 {
                particles.position_mut()[ends[0]] *= 0.3;
            }
            let way = random.vector().normalize() * (0.1 + 0.04 * random.next());
            particles.position_mut()[ends[1]] = (particles.position()[ends[0]] + way).as_vec3().as_dvec3();
            let length = f64::from(particles.position()[ends[0]].distance(particles.position()[ends[1]]) as f32);
            particles.links.rods.push(Rod { ends: ends.map(|id| id as u32), length });
        }
        if n % 11 == 4 {
            particles.held.push(Held { id: place(n) as u32, by: Hold::Fixed });
        }
    }
    for i in 0..count {
        particles.mass_mut()[i] = f64::from((1.3 + random.next()) as f32);
        particles.velocity_mut()[i] = DVec3::ZERO;
    }
    let held: Vec<u32> = particles.held.iter().map(|held| held.id).collect();
    particles.links.rods.retain(|rod| !rod.ends.iter().all(|id| held.contains(id)));
    particles
}

#[test]
fn device_and_references_solve_alike() {
    let shared = crate::support::device();
    // A multiple of 7 would give an id twice.
    for (count, rods) in [(2, 1), (3, 2), (65, 1), (200, 2), (1000, 3), (1000, 16), (500, 400)] {
        for name in ["leapfrog", "forest_ruth", "heun"] {
            let particles = tangle(count, rods);
            let gpu = gpu(&shared, count);
            let machine = gpu.machine();
            let setup = setup(&particles, forces(), name, 0.04);
            let plan = setup.plans(machine).expect("plans").step;
            let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
            let mut random = Random::new(9);
            let velocity: Vec<Vec4> = (0..count).map(|_| (random.vector() * 0.1).as_vec3().extend(0.4)).collect();
            simulation.write(VELOCITY, &velocity).expect("velocities");
            let verdicts = pollster::block_on(compare(simulation.backend(), &plan, setup.check().expect("some")));
            let mut seen = 0;
            for verdict in verdicts.expect("a run").iter().filter(|v| v.kernel.starts_with("rod")) {
                // Two places of the own speed are allowed; here the other end's round as well, and a rod's two ends may
                // be three times as fast, and of masses 1 to 8.
                let good = verdict.worst < 5.0 && !verdict.spilled;
                assert!(good, "{count} in chains of {rods}, {name}: {verdict:?}");
                assert!(verdict.changed || verdict.field == POSITION.name, "{name}: nothing happens: {verdict:?}");
                seen += 1;
            }
            assert!(seen >= 4, "{seen}");
        }
    }
}

/// A rod may reach through a periodic side: the ways are those to the nearest image.
#[test]
fn rods_go_through_periodic_sides() {
    let shared = crate::support::device();
    let bounds = Bounds::new(DVec3::splat(-1.0), DVec3::splat(1.0), Side::Periodic);
    let mut particles = State::default();
    let velocity = DVec3::new(0.5, 0.7, -0.4);
    chain(&mut particles, &[0.4, 0.8, 1.2].map(|x| DVec3::new(x, 0.9, 0.3)), [false, false]);
    particles.position_mut()[2].x -= 2.0;
    particles.links.rods[1].length = 0.4;
    for (v, way) in particles.velocity_mut().iter_mut().zip([DVec3::Z, DVec3::Y, -DVec3::Z]) {
        *v = velocity + way;
    }
    let free = |particles: &State, bounds| motes::Setup {
        state: particles.clone(),
        forces: vec![crate::support::states::force("rod", &[])],
        integrator: integrator("leapfrog"),
        dt: 0.01,
        bounds,
        solver: motes::Solver::default(),
    };
    let mut open = particles.clone();
    open.position_mut()[2].x += 2.0;
    let run = |particles: &State, bounds| {
        let gpu = &shared.found;
        let mut simulation = Simulation::new(&gpu.device, &gpu.queue, &free(particles, bounds)).expect("a simulation");
        simulation.step(300).expect("steps");
        read(&mut simulation).0
    };
    let (inside, outside) = (run(&particles, bounds), run(&open, Bounds::default()));
    for (a, b) in inside.iter().zip(&outside) {
        let apart = bounds.shortest((*a - *b).truncate()).length();
        // 300 roundings of places up to 2.
        assert!(apart < 3e-5, "{a} is no image of {b}");
        assert!(b.truncate().abs().max_element() > 1.0, "{b} is inside");
    }
}

/// Many copies side by side do the same bit for bit: one invocation does not touch another's.
#[test]
fn chains_side_by_side_do_the_same() {
    let shared = crate::support::device();
    let mut particles = State::default();
    for _ in 0..150 {
        let places: Vec<_> = (0..16).map(|n| DVec3::new(0.05, 0.02, 0.04) * f64::from(n)).collect();
        chain(&mut particles, &places, [true, false]);
    }
    let mut simulation = device(&shared, &particles, forces(), "leapfrog", 0.004);
    simulation.step(30).expect("steps");
    let (x, v) = read(&mut simulation);
    for n in 1..150 {
        assert!(x[16 * n..16 * (n + 1)] == x[..16] && v[16 * n..16 * (n + 1)] == v[..16], "chain {n} goes its own way");
    }
    assert!(stretch(&particles, &x) < 2e-6, "{:e}", stretch(&particles, &x));
    assert!(x[15].truncate().distance(particles.position()[15]) > 0.05, "nothing happens");
}

/// A rod that turns by more than a radian in a step is lost, and the run says so.
#[test]
fn what_does_not_come_right_stops_the_run() {
    let shared = crate::support::device();
    let mut particles = crate::rods::pendulum(&[0.3]);
    particles.velocity_mut()[1] = 300.0 * crate::rods::down(0.3 + std::f64::consts::FRAC_PI_2);
    let mut simulation = device(&shared, &particles, forces(), "leapfrog", 0.01);
    simulation.step(2).expect("steps");
    let lost = pollster::block_on(simulation.check());
    assert!(matches!(lost, Err(motes::Error::NotFinite { particle: 1, step: 0 })), "{lost:?}");
    let mut simulation = crate::rods::references(&particles, forces(), "leapfrog", 0.01);
    simulation.step(2).expect("steps");
    let lost = pollster::block_on(simulation.check());
    assert!(matches!(lost, Err(motes::Error::NotFinite { particle: 1, step: 0 })), "{lost:?}");
    // The same a hundred times slower.
    particles.velocity_mut()[1] /= 100.0;
    let mut simulation = device(&shared, &particles, forces(), "leapfrog", 0.01);
    simulation.step(2).expect("steps");
    pollster::block_on(simulation.check()).expect("a good run");
    let world = pollster::block_on(simulation.backend().world()).expect("a clock");
    assert_eq!(World { bounds: Bounds::default(), ..world }.step, 2);
}
