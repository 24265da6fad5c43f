//! Solids: distances in closed form, inclines, bounces, things at rest, and no particle inside after any step.

mod shapes;
mod touch;

use crate::support::Random;
use crate::support::states::{force, integrator, one, phase, vector, word};
use glam::DVec3;
use motes::forces::Component;
use motes::kernel::{Backend, Bounds, POSITION, Side, VELOCITY};
use motes::lockstep::compare;
use motes::motion::{Held, Hold, Keyframe, Motion};
use motes::settings::Value;
use motes::solids::{SHAPES, Solid};
use motes::{Cpu, Gpu, Setup, Simulation, State};

const G: f64 = 9.81;

pub(crate) fn setup(particles: State, forces: Vec<Box<dyn Component>>, name: &str, dt: f64) -> Setup {
    Setup {
        state: particles,
        forces,
        integrator: integrator(name),
        dt,
        bounds: Bounds::default(),
        solver: motes::Solver::default(),
    }
}

fn references(setup: &Setup) -> Simulation<Cpu> {
    let count = u32::try_from(setup.state.len()).expect("few");
    Simulation::on(Cpu::new(count).expect("some"), setup).expect("a simulation")
}

fn weight() -> Box<dyn Component> {
    force("uniform", &[("acceleration", vector(0.0, 0.0, -G))])
}

pub(crate) fn solid(shape: &'static str, settings: &[(&'static str, Value)]) -> Box<dyn Component> {
    force("solid", &[&[("shape", word(shape))], settings].concat())
}

pub(crate) fn number(x: f64) -> Value {
    Value::Number(x)
}

fn slide(from: f64, to: f64, x: f64) -> Motion {
    let key = |time, x| Keyframe { time, shift: DVec3::X * x, turn: DVec3::ZERO };
    Motion { name: "slide".to_owned(), keys: vec![key(from, 0.0), key(to, x)], ..Motion::default() }
}

/// Coulomb: it sticks where tan θ < μ, and else slides with a = g (sin θ − μ cos θ).
#[test]
fn on_an_incline_it_sticks_or_slides() {
    let (dt, steps) = (1e-3, 1000u32);
    for (degrees, friction) in [(20.0f64, 0.5), (26.0, 0.5), (27.0, 0.5), (45.0, 0.3), (30.0, 0.0)] {
        let angle = degrees.to_radians();
        let normal = DVec3::new(angle.sin(), 0.0, angle.cos());
        let down = DVec3::new(angle.cos(), 0.0, -angle.sin());
        for name in ["leapfrog", "symplectic_euler", "pefrl", "rk4"] {
            let ramp = solid(
                "plane",
                &[("normal", Value::Vector(normal)), ("friction", number(friction)), ("thickness", number(0.1))],
            );
            let start = 0.1 * normal;
            let mut simulation = references(&setup(one(start, DVec3::ZERO), vec![weight(), ramp], name, dt));
            simulation.step(steps).expect("steps");
            let way = phase(&mut simulation).0[0].truncate() - start;
            let pull = (G * (angle.sin() - friction * angle.cos())).max(0.0);
            let want = 0.5 * pull * (dt * f64::from(steps)).powi(2);
            // Nothing moves that sticks; what slides is a step early or late, a g t dt.
            let late = G * dt * dt * f64::from(steps);
            // Kicks of both signs lift it off for a part of a step.
            let sticks = if name == "pefrl" { 0.02 * late } else { 1e-10 };
            let allowed = if pull > 0.0 { 1.5 * late } else { sticks };
            assert!(
                (way.dot(down) - want).abs() < allowed,
                "{name}, {degrees}°, μ {friction}: {} is not {want}",
                way.dot(down)
            );
            assert!(way.dot(normal).abs() < 1e-5, "{name}, {degrees}°: {} off the ramp", way.dot(normal));
        }
    }
}

/// Dropped from h it comes back to e² h.
#[test]
fn a_bounce_comes_back_to_e_squared() {
    let dt = 1e-4;
    for e in [0.3, 0.8, 1.0] {
        let floor = solid(
            "plane",
            &[("restitution", number(e)), ("position", vector(0.0, 0.0, -1.0)), ("thickness", number(0.05))],
        );
        let drop = one(DVec3::new(0.3, 0.2, -0.95 + 0.7), DVec3::X);
        let mut simulation = references(&setup(drop, vec![weight(), floor], "leapfrog", dt));
        let fall = (2.0 * 0.7 / G).sqrt();
        let top = fall * (1.0 + e);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some thousands")]
        simulation.step((top / dt).round() as u32).expect("steps");
        let height = phase(&mut simulation).0[0].z + 0.95;
        // The speed at the touch is that of up to a step later, g dt of √(2 g h): twice that in the height.
        let allowed = 3.0 * e * e * 0.7 * (dt / fall) + 1e-6;
        assert!((height - e * e * 0.7).abs() < allowed, "e = {e}: {height} is not {}", e * e * 0.7);
    }
}

#[test]
fn what_lies_still_does_not_jitter() {
    let dt = 0.01;
    let shared = crate::support::device();
    for e in [0.0, 0.4, 0.9] {
        let floor =
            || solid("plane", &[("restitution", number(e)), ("thickness", number(0.1)), ("friction", number(0.6))]);
        let rest = one(DVec3::new(0.37, 0.0, 0.1), DVec3::ZERO);
        let setup = setup(rest, vec![weight(), floor()], "leapfrog", dt);
        let mut simulation = Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation");
        for _ in 0..40 {
            simulation.step(25).expect("steps");
            let v = pollster::block_on(simulation.read(VELOCITY)).expect("velocities")[0].truncate().as_dvec3();
            let x = pollster::block_on(simulation.read(POSITION)).expect("places")[0].truncate().as_dvec3();
            // A kick and a half of weight, and what bounces of it, at most.
            assert!(v.length_squared() <= 2.0 * (G * dt).powi(2), "e = {e}: it moves with {v}");
            assert!((x.z - 0.1).abs() < 2.0 * G * dt * dt && (x.x - 0.37).abs() < 1e-6, "e = {e}: it is at {x}");
        }
    }
}

#[test]
fn a_moving_sphere_pushes() {
    for (e, name) in [(0.0, "leapfrog"), (0.0, "rk4"), (0.5, "pefrl")] {
        let ball = solid(
            "sphere",
            &[("motion", word("slide")), ("position", vector(-1.0, 0.0, 0.0)), ("restitution", number(e))],
        );
        let mut particles = one(DVec3::ZERO, DVec3::ZERO);
        particles.motions = vec![slide(0.0, 1.0, 2.0)];
        let mut simulation = references(&setup(particles, vec![ball], name, 1e-3));
        // It touches at 0.25, and continues at 2; one that does not bounce is carried along.
        simulation.step(500).expect("steps");
        let (x, v) = phase(&mut simulation);
        assert!((v[0].x - 2.0 * (1.0 + e)).abs() < 1e-9, "{name}: it moves with {}", v[0]);
        assert!((x[0].x - 0.25 * 2.0 * (1.0 + e)).abs() < 5e-3 * (1.0 + e), "{name}: it is at {}", x[0]);
    }
}

/// A belt drags what lies on it, no faster than friction lets it, and in the end as fast as itself.
#[test]
fn a_belt_drags_by_friction() {
    let belt = solid("plane", &[("motion", word("slide")), ("friction", number(0.2))]);
    let mut particles = one(DVec3::ZERO, DVec3::ZERO);
    particles.motions = vec![slide(0.0, 10.0, 5.0)];
    let mut simulation = references(&setup(particles, vec![weight(), belt], "leapfrog", 1e-3));
    simulation.step(100).expect("steps");
    let v = phase(&mut simulation).1[0].x;
    assert!((v - 0.2 * G * 0.1).abs() < 2.0 * G * 1e-3, "{v}");
    simulation.step(400).expect("steps");
    assert!((phase(&mut simulation).1[0].x - 0.5).abs() < 1e-12);
}

/// Solids of random settings among flying particles: after any step no particle is nearer than the thickness.
#[test]
fn no_particle_is_inside_after_any_step() {
    let mut random = Random::new(11);
    let shared = crate::support::device();
    let swing = crate::support::choices::swing();
    for case in 0..48 {
        let mut some = |scale: f64| 0.5 + 0.45 * random.next() * scale;
        let (radius, thickness) = (0.6 * some(1.0) + 0.1, 0.1 * some(1.0));
        let size = DVec3::new(some(1.0), some(1.0), some(1.0)) + DVec3::splat(0.2);
        let (restitution, friction) = (some(1.0), some(1.0));
        let (position, axis) = (0.4 * random.vector(), random.vector());
        let normal = random.vector();
        let (shape, inside, moving) = (SHAPES[case % 4], case % 3 == 0, case % 2 == 0);
        let mut settings = vec![
            ("radius", number(radius)),
            ("size", Value::Vector(size)),
            ("thickness", number(thickness)),
            ("restitution", number(restitution)),
            ("friction", number(friction)),
            ("position", Value::Vector(position)),
            ("axis", Value::Vector(axis)),
            ("normal", Value::Vector(normal)),
            ("inside", Value::Flag(inside)),
        ];
        if moving {
            settings.push(("motion", word("swing")));
        }
        let mut particles = crate::support::cloud(100, case as u64);
        particles.motions = vec![swing.clone()];
        let name = ["leapfrog", "pefrl", "heun", "forest_ruth"][case / 4 % 4];
        let setup = setup(particles, vec![weight(), solid(shape, &settings)], name, 0.02);
        let own = match shape {
            "sphere" => Solid::Sphere(radius),
            "box" => Solid::Box(size),
            "plane" => Solid::Plane(normal.normalize()),
            _ => Solid::Capsule(axis, radius),
        };
        let run = |places: Vec<DVec3>, time: f64, allowed: f64| {
            let pose = if moving { swing.pose(time) } else { motes::motion::Pose::default() };
            let centre = if moving { swing.place(position, time) } else { position };
            for x in places {
                let distance = own.distance(pose.turn.inverse() * (x - centre), 3).1;
                let free = if inside { -distance } else { distance };
                assert!(free > thickness - allowed, "{case}: {shape}, {name}, at {x}: {free}, not {thickness}");
            }
        };
        let mut simulation = references(&setup);
        for step in 1..=10 {
            simulation.step(1).expect("a step");
            let places = phase(&mut simulation).0.iter().map(|x| x.truncate()).collect();
            run(places, f64::from(step) * 0.02, 1e-12);
        }
        if case % 6 == 0 {
            let mut simulation =
                Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation");
            simulation.step(10).expect("steps");
            let places = pollster::block_on(simulation.read(POSITION)).expect("places");
            // Sums of a few numbers up to 2, each rounded by 1e-7.
            run(places.iter().map(|x| x.truncate().as_dvec3()).collect(), 0.2, 2e-6);
        }
    }
}

/// In a periodic box a solid is at all its images; fixed particles are not pushed; other species pass.
#[test]
fn it_meets_images_and_leaves_the_held_alone() {
    let ball = || solid("sphere", &[("position", vector(0.9, 0.0, 0.0)), ("species", number(0.0))]);
    let mut particles = State::default();
    for (x, species) in [(-0.9, 0), (-0.8, 0), (0.7, 1)] {
        particles.push(DVec3::X * x, DVec3::ZERO, 1.0, 0.0);
        *particles.species_mut().last_mut().expect("some") = species;
    }
    particles.held = vec![Held { id: 1, by: Hold::Fixed }];
    let bounds = Bounds::new(DVec3::splat(-1.0), DVec3::splat(1.0), Side::Periodic);
    let setup = Setup { bounds, ..setup(particles, vec![ball()], "leapfrog", 0.1) };
    let mut simulation = references(&setup);
    simulation.step(1).expect("a step");
    let x = phase(&mut simulation).0;
    // From 0.2 beyond the middle of the image at −1.1 it is pushed out to 0.5 from there.
    assert!((x[0].x + 0.6).abs() < 1e-12, "{}", x[0]);
    assert!((x[1].x + 0.8).abs() < 1e-15 && (x[2].x - 0.7).abs() < 1e-15, "{} {}", x[1], x[2]);
}

/// Still and moving, through every drift of a step, with some held, against the references.
#[test]
fn the_kernels_agree_with_their_references() {
    let shared = crate::support::device();
    for (case, shape) in SHAPES.iter().enumerate() {
        for name in ["pefrl", "heun"] {
            let count = 333;
            let mut particles = crate::support::cloud(count, 7);
            particles.motions = vec![slide(0.0, 1.0, 2.0), crate::support::choices::swing()];
            particles.held = (0..9).map(|id| Held { id: 7 * id, by: Hold::Fixed }).collect();
            let settings = [
                ("motion", word("swing")),
                // In the edge of a box the direction out is one of rounding.
                ("inside", Value::Flag(case == 3)),
                ("thickness", number(0.07)),
                ("restitution", number(0.3)),
                ("position", vector(0.2, -0.1, 0.15)),
            ];
            let setup = setup(particles, vec![weight(), solid(shape, &settings)], name, 0.03);
            let gpu: Gpu = crate::support::machines::gpu(&shared, count);
            let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
            simulation.step(3).expect("steps");
            let plan = setup.plans(simulation.backend().machine()).expect("plans").step;
            let mut met = 0;
            for verdict in pollster::block_on(compare(simulation.backend(), &plan, 333)).expect("verdicts") {
                // A turn there and one back: two units in the last place more for each.
                assert!(verdict.worst < 3.0 && !verdict.spilled, "{shape}, {name}: {verdict:?}");
                met += usize::from(verdict.kernel.starts_with("solid") && verdict.changed);
            }
            assert!(met > 0, "{shape}, {name}: it meets no particle");
        }
    }
}
