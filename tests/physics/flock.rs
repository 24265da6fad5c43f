//! Flocks: numbers by hand, symmetries, limits of speed, and what must not break them.

use crate::support::states::{accelerations, cpu, evaluated, force, integrator, one, phase, vector, word};
use glam::{DMat3, DVec3, DVec4};
use motes::forces::Component;
use motes::integrators::INTEGRATORS;
use motes::kernel::World;
use motes::settings::Value;
use motes::{Bounds, Setup, Simulation, State, VELOCITY};

const NUMBER: fn(f64) -> Value = Value::Number;

/// One flock with a weight for each rule, the range 1 and force enough.
fn boids(weights: [f64; 3], more: &[(&'static str, Value)]) -> Vec<Box<dyn Component>> {
    let mut settings = vec![
        ("range", NUMBER(1.0)),
        ("separation_range", NUMBER(0.5)),
        ("separation", NUMBER(weights[0])),
        ("alignment", NUMBER(weights[1])),
        ("cohesion", NUMBER(weights[2])),
        ("vision", NUMBER(180.0)),
        ("max_speed", NUMBER(2.0)),
        ("max_force", NUMBER(100.0)),
    ];
    settings.extend_from_slice(more);
    vec![force("boids", &settings)]
}

fn two(r: DVec3, v: DVec3, w: DVec3) -> State {
    let mut two = one(DVec3::new(0.3, 0.4, 0.5), v);
    two.push(DVec3::new(0.3, 0.4, 0.5) + r, w, 1.0, 0.0);
    two
}

/// An acceleration without a potential.
fn near(got: DVec4, want: DVec3) {
    assert!((got.truncate() - want).length() < 1e-12 && got.w == 0.0, "{got}, not {want}");
}

#[test]
fn two_by_hand() {
    let (v, w) = (DVec3::new(1.0, 0.0, 0.0), DVec3::new(0.0, 0.5, 0.0));
    let boids_of = |weights, r, more: &[_]| accelerations(&boids(weights, more), &two(r, v, w), 0.0);
    let r = DVec3::new(0.0, 0.0, 0.25);
    // u = 2 away from the other, and towards it; and its velocity.
    let apart = boids_of([1.0, 0.0, 0.0], r, &[]);
    near(apart[0], DVec3::new(-1.0, 0.0, -2.0));
    near(apart[1], DVec3::new(0.0, -0.5, 2.0));
    near(boids_of([0.0, 0.0, 1.0], r, &[])[0], DVec3::new(-1.0, 0.0, 2.0));
    near(boids_of([0.0, 1.0, 0.0], r, &[])[0], w - v);
    // Together, and each a part of its own: (−1, 0, −2) 0.5 + (−1, 0.5, 0) 2 + (−1, 0, 2) 3.
    near(boids_of([0.5, 2.0, 3.0], r, &[])[0], DVec3::new(-5.5, 1.0, 5.0));
    // Each rule asks for √2 at most, and all together too: (−1, 0, −2) → √2/√5, the sum of two of 2 √(2/5) in x.
    let most = [("max_force", NUMBER(2f64.sqrt()))];
    near(boids_of([1.0, 0.0, 0.0], r, &most)[0], DVec3::new(-1.0, 0.0, -2.0) * (2.0f64 / 5.0).sqrt());
    near(boids_of([2.0, 0.0, 2.0], r, &most)[0], DVec3::new(-(2f64.sqrt()), 0.0, 0.0));
    // Too far to keep apart, and too far to be seen.
    near(boids_of([1.0, 0.0, 0.0], DVec3::X * 0.6, &[])[0], DVec3::ZERO);
    near(boids_of([1.0, 1.0, 1.0], DVec3::X * 1.1, &[])[0], DVec3::ZERO);
}

/// Separation weighs the near more: two others at 0.1 and at 0.2 of two sides.
#[test]
fn separation_falls_off_with_distance() {
    let mut three = two(DVec3::X * 0.1, DVec3::ZERO, DVec3::ZERO);
    three.push(three.position()[0] + DVec3::Y * 0.2, DVec3::ZERO, 1.0, 0.0);
    // Σ r / r² = (10, 5).
    near(accelerations(&boids([1.0, 0.0, 0.0], &[]), &three, 0.0)[0], 2.0 * DVec3::new(-2.0, -1.0, 0.0) / 5f64.sqrt());
    // Cohesion is a mean way, (0.1, 0.2) / 2.
    near(accelerations(&boids([0.0, 0.0, 1.0], &[]), &three, 0.0)[0], 2.0 * DVec3::new(1.0, 2.0, 0.0) / 5f64.sqrt());
}

#[test]
fn no_bird_sees_behind() {
    let view = |degrees: f64, angle: f64| {
        let r = 0.3 * DVec3::new(angle.to_radians().cos(), angle.to_radians().sin(), 0.0);
        let flock = boids([0.0, 1.0, 0.0], &[("vision", NUMBER(degrees))]);
        accelerations(&flock, &two(r, DVec3::X, DVec3::Y), 0.0)[0] != DVec4::ZERO
    };
    assert!(!view(179.0, 180.0) && view(180.0, 180.0) && view(200.0, 180.0));
    assert!(view(90.0, 89.0) && !view(90.0, 91.0) && view(135.0, -134.0) && !view(135.0, -136.0) && !view(0.5, 1.0));
    // A bird at rest looks nowhere, and sees all round.
    let rest = two(-DVec3::X * 0.3, DVec3::ZERO, DVec3::Y);
    near(accelerations(&boids([0.0, 1.0, 0.0], &[("vision", NUMBER(30.0))]), &rest, 0.0)[0], DVec3::Y);
}

#[test]
fn a_bird_without_neighbours_flies_straight_on() {
    let (x, v) = (DVec3::new(0.1, 0.2, 0.3), DVec3::new(0.5, -0.25, 1.0));
    let mut pair = one(x, v);
    pair.push(x + DVec3::Z * 30.0, -v, 1.0, 0.0);
    let mut simulation = cpu(&pair, boids([1.0; 3], &[]), "leapfrog", 0.125);
    simulation.step(16).expect("steps");
    let (places, velocities) = phase(&mut simulation);
    // Numbers that f64 holds: nothing is rounded.
    assert!(velocities[0].truncate() == v && (places[0].truncate() - (x + 2.0 * v)).length() < 1e-14);
}

/// What is done in another order, elsewhere, and turned round comes out in that order, the same, and turned round.
#[test]
fn symmetries() {
    let cloud = crate::support::cloud(60, 9);
    let turn = DMat3::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 0.9);
    let mut other = State::default();
    for i in 0..60 {
        let from = (i * 7) % 60;
        let x = turn * cloud.position()[from] + DVec3::new(3.0, -1.0, 2.0);
        other.push(x, turn * cloud.velocity()[from], cloud.mass()[from], 0.01);
        other.species_mut()[i] = cloud.species()[from];
    }
    for over in ["near", "list", "within", "nearest"] {
        let settings =
            [("over", word(over)), ("vision", NUMBER(120.0)), ("species", NUMBER(1.0)), ("max_force", NUMBER(2.0))];
        let flock = boids([1.5, 1.0, 0.8], &settings);
        let (a, b) = (accelerations(&flock, &cloud, 0.0), accelerations(&flock, &other, 0.0));
        for i in 0..60 {
            let want = turn * a[(i * 7) % 60].truncate();
            // Sums of some tens, rounded by 1e-16 and divided by what is left of them, a hundredth at the least.
            assert!((b[i].truncate() - want).length() < 1e-11, "{over}: {i}: {} is not {want}", b[i]);
        }
        assert!(a.iter().any(|a| a.length() > 1.0), "{over}: no bird steers");
    }
}

/// A flock of one species does not see the others, and is not pushed by them.
#[test]
fn species_keep_to_themselves() {
    let mut cloud = crate::support::cloud(50, 4);
    let flock = boids([1.0; 3], &[("species", NUMBER(1.0))]);
    let all = accelerations(&flock, &cloud, 0.0);
    assert!(all.iter().zip(cloud.species()).all(|(a, s)| *s == 1 || *a == DVec4::ZERO));
    let kinds = cloud.species().to_vec();
    for (x, species) in cloud.position_mut().iter_mut().zip(&kinds) {
        *x += if *species == 1 { DVec3::ZERO } else { DVec3::splat(0.05) };
    }
    assert!(all == accelerations(&flock, &cloud, 0.0) && all.iter().any(|a| *a != DVec4::ZERO));
}

/// At one place, at rest, in rows: all that divides by nothing somewhere.
#[test]
fn what_is_degenerate_is_finite() {
    let shared = crate::support::device();
    let mut particles = State::default();
    for i in 0..40u32 {
        let row = f64::from(i / 8);
        let v = if i % 3 == 0 { DVec3::ZERO } else { DVec3::X };
        particles.push(DVec3::splat(0.25 * row), v, 1.0, 0.0);
        particles.species_mut()[i as usize] = i % 2;
    }
    for integrator_name in ["symplectic_euler", "rk4"] {
        let forces = [
            boids([1.0; 3], &[("min_speed", NUMBER(0.1))]),
            boids([1.0; 3], &[("over", word("nearest")), ("vision", NUMBER(90.0))]),
            vec![force("flee", &[]), force("chase", &[])],
            vec![force("goal", &[("slow_radius", NUMBER(0.0))]), force("wander", &[]), force("soft_turn", &[])],
            ["sphere", "box", "plane"].map(|shape| force("obstacle", &[("shape", word(shape))])).into(),
            vec![force("vicsek", &[])],
        ];
        for forces in forces {
            let setup = Setup {
                state: particles.clone(),
                forces,
                integrator: integrator(integrator_name),
                dt: 0.05,
                bounds: Bounds::default(),
                solver: motes::Solver::default(),
            };
            let device = (&shared.found.device, &shared.found.queue);
            let mut simulation = Simulation::new(device.0, device.1, &setup).expect("a simulation");
            simulation.step(5).expect("steps");
            pollster::block_on(simulation.check()).expect("finite numbers");
        }
    }
}

/// After every step of every integrator no bird is faster or slower than the limits say; others are left alone.
#[test]
fn speeds_are_within_limits() {
    let shared = crate::support::device();
    for entry in INTEGRATORS {
        let flock = [("min_speed", NUMBER(0.4)), ("max_speed", NUMBER(0.9)), ("species", NUMBER(1.0))];
        let limit = [("min", NUMBER(1.5)), ("max", NUMBER(1.75)), ("species", NUMBER(2.0))];
        let setup = Setup {
            state: crate::support::cloud(200, 3),
            forces: vec![
                force("boids", &flock),
                force("speed_limit", &limit),
                force("uniform", &[("acceleration", vector(0.0, 2.0, 7.0))]),
            ],
            integrator: entry.by_default(),
            dt: 0.1,
            bounds: Bounds::default(),
            solver: motes::Solver::default(),
        };
        let mut simulation = Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation");
        for _ in 0..6 {
            simulation.step(1).expect("a step");
            let velocities = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
            let mut free = 0.0f64;
            for (v, species) in velocities.iter().zip(setup.state.species()) {
                let speed = f64::from(v.truncate().length());
                // A length, a division and a product: a few roundings of 6e-8.
                let within = |least: f64, most: f64| speed > least * (1.0 - 5e-7) && speed < most * (1.0 + 5e-7);
                match species {
                    1 => assert!(within(0.4, 0.9), "{}: {speed}", entry.name),
                    2 => assert!(within(1.5, 1.75), "{}: {speed}", entry.name),
                    _ => free = free.max(speed),
                }
            }
            assert!(free > 0.9, "{}: a limit for one species holds others to {free}", entry.name);
        }
    }
}

#[test]
fn limits_by_hand() {
    let limit = [force("speed_limit", &[("min", NUMBER(2.0)), ("max", NUMBER(5.0))])];
    let after = |v: DVec3| evaluated(&limit, &one(DVec3::ZERO, v), World::default()).1[0][0].truncate();
    assert_eq!(after(DVec3::new(0.0, 6.0, 8.0)), DVec3::new(0.0, 3.0, 4.0));
    assert_eq!(after(DVec3::new(0.0, 0.0, -1.0)), DVec3::new(0.0, 0.0, -2.0));
    assert_eq!(after(DVec3::new(3.0, 0.0, 0.0)), DVec3::new(3.0, 0.0, 0.0));
    // A bird at rest has no direction: it gets one.
    assert_eq!(after(DVec3::ZERO), DVec3::new(2.0, 0.0, 0.0));
    let wrong = [("min", NUMBER(3.0)), ("max", NUMBER(2.0))];
    let setup = Setup {
        state: crate::support::cloud(3, 1),
        forces: vec![force("speed_limit", &wrong)],
        integrator: integrator("leapfrog"),
        dt: 0.1,
        bounds: Bounds::default(),
        solver: motes::Solver::default(),
    };
    let machine = motes::kernel::Machine::HOST;
    let fault = setup.plans(machine).err().expect("no speed is above 3 and below 2").to_string();
    assert!(fault.contains('3') && fault.contains('2'), "{fault}");
}
