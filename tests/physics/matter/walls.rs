//! `contact_wall`: impacts, rolling and sliding on walls against closed forms, history across restarts, and lockstep.

use glam::DVec3;
use motes::motion::{Keyframe, Motion};
use motes::settings::Value;
use motes::{Bounds, Error, Setup, State};
use pollster::block_on;

use super::grains::{GRAIN, Grain, after, state};
use super::{agrees, on_cpu, setup};
use crate::support::Random;
use crate::support::states::{force, vector};

const G: f64 = 9.81;

fn wall(more: &[(&'static str, Value)]) -> Box<dyn motes::forces::Component> {
    let given = [("stiffness", Value::Number(1e5)), ("tangential_damping", Value::Number(0.5))];
    force("contact_wall", &given.into_iter().chain(more.iter().cloned()).collect::<Vec<_>>())
}

/// Grains on a wall through the origin, in a weight that is inclined by an angle.
fn on_wall(grains: &[Grain], angle: f64, more: &[(&'static str, Value)], dt: f64) -> Setup {
    let weight = force("uniform", &[("acceleration", vector(G * angle.sin(), 0.0, -G * angle.cos()))]);
    setup(state(grains), vec![wall(more), weight], Bounds::default(), dt)
}

/// A grain that has settled into a wall of 1e5 under its weight.
fn lying(angle: f64) -> Grain {
    Grain { position: DVec3::new(0.0, 0.0, 0.5 - G * angle.cos() / 1e5), ..GRAIN }
}

fn spin(state: &State) -> DVec3 {
    state.vector("angular_velocity").expect("spins")[0]
}

/// A sphere that falls on a wall rises to e² of its height, by both models.
#[test]
fn a_sphere_bounces_to_its_height() {
    for (model, dt) in [("linear", 1e-5), ("hertz", 1e-5)] {
        for e in [0.5, 0.9] {
            let drop = 0.4;
            let falling = Grain { position: DVec3::new(0.0, 0.0, 0.5 + drop), ..GRAIN };
            let more = [
                ("model", Value::Text(model.into())),
                ("restitution", e.into()),
                ("young_modulus", 1e8.into()),
                ("stiffness", 4e6.into()),
            ];
            let all = on_wall(&[falling], 0.0, &more, dt);
            let mut simulation = on_cpu(&all);
            // It meets the wall after √(2 h / g), and is at the top e times that later.
            let fall = (2.0 * drop / G).sqrt();
            simulation.step((fall * (1.0 + 0.9 * e) / dt) as u32).expect("steps");
            let risen = block_on(simulation.snapshot()).expect("a state");
            let (z, v) = (risen.position()[0].z - 0.5, risen.velocity()[0].z);
            let height = z + v * v / (2.0 * G);
            // Weight acts during the contact of 0.002 s: g t / v = 0.7 % of the speed, and the end is found to a step, 1 %.
            assert!(v > 0.0 && (height / (e * e * drop) - 1.0).abs() < 0.02, "{model} {e}: {height}");
        }
    }
}

/// A sphere thrown along a wall slides until t = 2 v₀ / 7 μ g, and then rolls with 5/7 v₀.
#[test]
fn sliding_becomes_rolling() {
    let (speed, friction) = (1.0, 0.2);
    let start = Grain { velocity: DVec3::X * speed, ..lying(0.0) };
    let time = 2.0 * speed / (7.0 * friction * G);
    let all = on_wall(&[start], 0.0, &[("friction", friction.into())], 1e-4);
    let before = after(&all, 0.9 * time);
    assert!((before.velocity()[0].x - (speed - friction * G * 0.9 * time)).abs() < 2e-3, "{}", before.velocity()[0]);
    assert!(spin(&before).y * 0.5 < 0.95 * before.velocity()[0].x, "it slides yet: {}", spin(&before));
    let end = after(&all, 3.0 * time);
    // The tangential spring swings about rolling by the force that it had: μ m g / √(kₜ m) = 0.012, damped.
    assert!((end.velocity()[0].x / (5.0 / 7.0 * speed) - 1.0).abs() < 2e-3, "{}", end.velocity()[0]);
    assert!((spin(&end).y * 0.5 / end.velocity()[0].x - 1.0).abs() < 2e-3, "{}", spin(&end));
}

/// On an incline a sphere with rolling friction rests where tan θ < μᵣ, otherwise it rolls with a = 5/7 g (sin θ − μᵣ cos θ), and
/// slides where μ is small. Negative control: without rolling friction nothing rests.
#[test]
fn rolling_friction_holds_a_sphere_on_an_incline() {
    let angle = 0.2_f64;
    for model in ["elastic_plastic", "constant"] {
        let gained = |rolling: f64, friction: f64| {
            let more = [
                ("rolling_friction", rolling.into()),
                ("friction", friction.into()),
                ("rolling_model", Value::Text(model.into())),
                ("restitution", 0.3.into()),
            ];
            let all = on_wall(&[lying(angle)], angle, &more, 1e-4);
            let [early, late] = [0.3, 0.8].map(|time| after(&all, time).velocity()[0].x);
            [late, (late - early) / 0.5]
        };
        let near = |got: f64, want: f64| assert!((got / want - 1.0).abs() < 0.01, "{model}: {got} is not {want}");
        let [speed, _] = gained(angle.tan() / 0.95, 0.5);
        assert!(speed.abs() < 1e-3, "{model}: it rests: {speed}");
        near(gained(0.05, 0.5)[1], 5.0 / 7.0 * G * (angle.sin() - 0.05 * angle.cos()));
        near(gained(0.0, 0.5)[1], 5.0 / 7.0 * G * angle.sin());
        near(gained(0.0, 0.02)[1], G * (angle.sin() - 0.02 * angle.cos()));
    }
}

fn motion(shift: DVec3, turn: DVec3, about: DVec3) -> Motion {
    let key = |time: f64| Keyframe { time, shift: time * shift, turn: time * turn };
    Motion { name: "belt".to_owned(), about, keys: vec![key(0.0), key(10.0)], smooth: false, repeat: false }
}

/// A sphere put on a belt of speed u ends with 2/7 u, rolling backwards on it: its angular momentum about the belt stays 0. The same
/// on the top of a wheel.
#[test]
fn belts_carry_grains_along() {
    let wheel = [("shape", Value::Text("capsule".into())), ("axis", vector(0.0, 10.0, 0.0)), ("radius", 1000.0.into())];
    let centre = DVec3::new(0.0, 0.0, -1000.0);
    let place = [("position", vector(0.0, 0.0, -1000.0))];
    let belt = motion(DVec3::X, DVec3::ZERO, DVec3::ZERO);
    let turns = motion(DVec3::ZERO, DVec3::Y / 1000.0, centre);
    for (motion, more) in [(belt, Vec::new()), (turns, [&wheel[..], &place].concat())] {
        let more = [&more[..], &[("motion", Value::Text("belt".into())), ("friction", 0.3.into())]].concat();
        let mut all = on_wall(&[lying(0.0)], 0.0, &more, 1e-4);
        all.state.motions = vec![motion];
        let end = after(&all, 0.8);
        assert!((end.velocity()[0].x - 2.0 / 7.0).abs() < 2e-3, "{}", end.velocity()[0]);
        assert!((0.5 * spin(&end).y - (2.0 / 7.0 - 1.0)).abs() < 4e-3, "{}", spin(&end));
    }
}

/// In the corner of a container a sphere touches three sides at once: it is pushed by each as by a plane.
#[test]
fn a_corner_has_three_sides() {
    let more = [
        ("shape", Value::Text("box".into())),
        ("size", vector(4.0, 5.0, 6.0)),
        ("position", vector(2.0, 2.5, 3.0)),
        ("inside", true.into()),
        ("restitution", 1.0.into()),
    ];
    let grain = Grain { position: DVec3::new(0.499, 4.502, 0.497), ..GRAIN };
    let mut all = on_wall(&[grain], 0.0, &more, 1e-6);
    all.forces.pop();
    let end = after(&all, 1e-6).velocity()[0] / 1e-6;
    let want = 1e5 * DVec3::new(1e-3, -2e-3, 3e-3);
    assert!((end - want).length() < 1e-3 * want.length(), "{end} is not {want}");
}

/// The surface of a cone, against the nearest of many points on it; on both sides of it, and beyond its ends.
#[test]
fn a_funnel_pushes_from_its_surface() {
    use motes::solids::Solid;
    let (axis, radius, end) = (DVec3::new(0.3, -0.5, 1.1), 0.4, 1.3);
    let funnel = Solid::Cone { axis, radius, end };
    let along = axis.normalize();
    let (x, y) = (along.any_orthonormal_pair().0, along.any_orthonormal_pair().1);
    let mut random = Random::new(3);
    for _ in 0..50 {
        let d = 2.0 * random.vector();
        let (n, distance) = funnel.distance(d, 3);
        let mut nearest = f64::MAX;
        for s in (0..=400).map(|k| f64::from(k) / 400.0) {
            for turn in (0..720).map(|k| f64::from(k) / 720.0 * std::f64::consts::TAU) {
                let out = (radius + s * (end - radius)) * (turn.cos() * x + turn.sin() * y);
                nearest = nearest.min((d - (out + (s - 0.5) * axis)).length());
            }
        }
        // The points are 0.011 apart at most.
        assert!(
            distance <= nearest + 1e-12 && (distance - nearest).abs() < 0.011 && distance > 0.0,
            "{d}: {distance} {nearest}"
        );
        assert!((funnel.distance(d - distance * n, 3).1).abs() < 1e-12 && (n.length() - 1.0).abs() < 1e-12, "{d}: {n}");
    }
}

/// Grains about the origin, of which many touch a wall.
fn cluster() -> State {
    let mut random = Random::new(7);
    let grain = |_| {
        let single = |v: DVec3| v.as_vec3().as_dvec3();
        Grain {
            position: single(1.2 * random.vector()),
            velocity: single(random.vector()),
            spin: single(2.0 * random.vector()),
            radius: f64::from((0.3 + 0.1 * random.next()) as f32),
            ..GRAIN
        }
    };
    let mut state = state(&(0..130).map(grain).collect::<Vec<_>>());
    state.species_mut().copy_from_slice(&crate::support::species(130));
    state
}

fn shapes() -> Vec<Vec<(&'static str, Value)>> {
    let word = |text: &'static str| Value::Text(text.into());
    vec![
        vec![("shape", word("plane")), ("normal", vector(0.3, -0.2, 0.9)), ("rolling_friction", 0.1.into())],
        vec![("shape", word("box")), ("size", vector(1.2, 0.9, 1.4)), ("species", 1.0.into())],
        vec![
            ("shape", word("box")),
            ("size", vector(2.2, 2.0, 1.9)),
            ("inside", true.into()),
            ("torsional_friction", 0.2.into()),
        ],
        vec![
            ("shape", word("sphere")),
            ("radius", 0.6.into()),
            ("model", word("hertz")),
            ("young_modulus", 2e4.into()),
        ],
        vec![("shape", word("sphere")), ("radius", 1.1.into()), ("inside", true.into()), ("friction", 0.02.into())],
        vec![("shape", word("capsule")), ("radius", 0.5.into()), ("axis", vector(0.3, 0.8, -0.2))],
        vec![
            ("shape", word("cone")),
            ("radius", 0.3.into()),
            ("end_radius", 1.1.into()),
            ("axis", vector(0.1, -0.2, 0.9)),
        ],
    ]
}

fn swinging(mut setup: Setup) -> Setup {
    let swing = crate::support::choices::swing();
    setup.state.motions = vec![Motion { name: "belt".to_owned(), ..swing }];
    setup
}

#[test]
fn walls_agree_with_their_reference() {
    for shape in shapes() {
        for moves in [false, true] {
            let moving = moves.then_some(("motion", Value::Text("belt".into())));
            let place = [("position", vector(0.1, -0.05, 0.2)), ("stiffness", 300.0.into())];
            let more: Vec<_> = shape.iter().cloned().chain(place).chain(moving).collect();
            let setup = swinging(setup(cluster(), vec![wall(&more)], Bounds::default(), 1.0 / 512.0));
            // An overlap is the small difference of a radius and a distance; poses are those of motions, to 2e-7.
            agrees(&setup, 3, 6.0, &["contact_wall"]);
        }
    }
}

/// Two walls have histories of their own, and a run that is continued after any step has the bits of one that was not stopped.
#[test]
fn histories_continue_from_states() {
    let plane = |z: f64, up: f64| {
        wall(&[("normal", vector(0.0, 0.0, up)), ("position", vector(0.0, 0.0, z)), ("rolling_friction", 0.1.into())])
    };
    let weight = force("uniform", &[("acceleration", vector(3.0, 0.0, -G))]);
    let grain = Grain { position: DVec3::new(0.0, 0.0, 0.499), spin: DVec3::new(0.1, 0.7, -0.3), ..GRAIN };
    let all = setup(state(&[grain]), vec![plane(0.0, 1.0), plane(0.998, -1.0), weight], Bounds::default(), 1e-4);
    let shared = crate::support::device();
    let on = |setup: &Setup| motes::Simulation::on(crate::support::machines::gpu(&shared, 1), setup).expect("one");
    let mut whole = on(&all);
    whole.step(40).expect("steps");
    let want = block_on(whole.snapshot()).expect("a state");
    for history in ["wall_history", "wall_2_history"] {
        assert!(want.scalar(history).expect("a history").iter().any(|x| *x != 0.0), "{history}");
    }
    assert_ne!(want.scalar("wall_history"), want.scalar("wall_2_history"));
    for first in [13, 24] {
        let mut part = on(&all);
        part.step(first).expect("steps");
        let state = block_on(part.snapshot()).expect("a state");
        let mut rest = on(&all.with_state(state));
        rest.step(40 - first).expect("steps");
        let got = block_on(rest.snapshot()).expect("a state");
        assert_eq!((got.position(), got.velocity()), (want.position(), want.velocity()), "after {first}");
        assert_eq!(got.scalar("wall_history"), want.scalar("wall_history"), "after {first}");
    }
}

#[test]
fn several_evaluations_in_a_step_are_refused() {
    let mut all = on_wall(&[GRAIN], 0.0, &[], 1e-4);
    all.integrator = crate::support::states::integrator("rk4");
    match motes::Simulation::on(motes::Cpu::new(1).expect("one"), &all).map(|_| ()) {
        Err(Error::Scene(why)) => {
            assert!(why.contains("`contact_wall` keeps history") && why.contains("4 times"), "{why}");
        }
        other => panic!("{other:?}"),
    }
}
