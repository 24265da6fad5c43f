//! Steering of single birds: goals, obstacles, predators, soft walls and wandering, with numbers by hand.

use crate::support::states::{accelerations, cpu, evaluated, force, one, phase, vector, word};
use glam::{DVec3, DVec4};
use motes::forces::Component;
use motes::kernel::World;
use motes::settings::Value;
use motes::{Bounds, Side, State};

const NUMBER: fn(f64) -> Value = Value::Number;

fn alone(force: Box<dyn Component>, x: [f64; 3], v: [f64; 3]) -> DVec4 {
    accelerations(&[force], &one(x.into(), v.into()), 0.0)[0]
}

fn near(got: DVec4, want: [f64; 4]) {
    assert!((got - DVec4::from(want)).length() < 1e-12, "{got}, not {want:?}");
}

#[test]
fn a_goal_is_arrived_at() {
    let goal = |more: &[(&'static str, Value)]| {
        let mut settings =
            vec![("position", vector(3.0, 4.0, 0.0)), ("max_speed", NUMBER(2.0)), ("max_force", NUMBER(9.0))];
        settings.push(("slow_radius", NUMBER(0.0)));
        settings.extend_from_slice(more);
        force("goal", &settings)
    };
    // u = 2 (3, 4) / 5; within 10 of it half as fast.
    near(alone(goal(&[]), [0.0; 3], [1.0, 0.0, 0.0]), [0.2, 1.6, 0.0, 0.0]);
    near(alone(goal(&[("slow_radius", NUMBER(10.0))]), [0.0; 3], [0.0; 3]), [0.6, 0.8, 0.0, 0.0]);
    near(alone(goal(&[("max_force", NUMBER(0.5))]), [0.0; 3], [0.0; 3]), [0.3, 0.4, 0.0, 0.0]);
    // A roost of radius 5.5 is left alone; at the goal itself one stops.
    near(alone(goal(&[("free_radius", NUMBER(5.5))]), [0.0; 3], [1.0; 3]), [0.0; 4]);
    near(alone(goal(&[]), [3.0, 4.0, 0.0], [1.0, 0.0, 0.0]), [-1.0, 0.0, 0.0, 0.0]);
    // It moves, and its nearest image counts.
    let moving = || vec![goal(&[("velocity", vector(-3.0, 0.0, 0.0))])];
    let at = |bounds| {
        evaluated(&moving(), &one(DVec3::ZERO, DVec3::ZERO), World { time: 1.0, dt: 0.1, bounds, ..World::default() })
    };
    near(at(Bounds::default()).0[0], [0.0, 2.0, 0.0, 0.0]);
    let around = Bounds::new(DVec3::splat(-3.0), DVec3::splat(3.0), Side::Periodic);
    near(at(around).0[0], [0.0, -2.0, 0.0, 0.0]);
}

#[test]
fn obstacles_turn_away_particles_heading_into_them() {
    let obstacle = |shape, more: &[(&'static str, Value)]| {
        let mut settings = vec![("shape", word(shape)), ("max_force", NUMBER(8.0)), ("clearance", NUMBER(0.5))];
        settings.push(("look_ahead", NUMBER(2.0)));
        settings.push(("radius", NUMBER(1.0)));
        settings.push(("size", vector(2.0, 4.0, 6.0)));
        settings.extend_from_slice(more);
        force("obstacle", &settings)
    };
    // Straight on from 3.5 away at speed 2: touches after 2 of the 4 ahead.
    near(alone(obstacle("sphere", &[]), [-3.5, 0.0, 0.0], [2.0, 0.0, 0.0]), [-4.0, 0.0, 0.0, 0.0]);
    near(alone(obstacle("box", &[]), [0.0, 0.0, 5.5], [0.0, 0.0, -2.0]), [0.0, 0.0, 4.0, 0.0]);
    let tilted = [("normal", vector(0.0, 3.0, 4.0))];
    near(alone(obstacle("plane", &tilted), [0.0, 1.5, 2.0], [0.0, -1.2, -1.6]), [0.0, 2.4, 3.2, 0.0]);
    // Aslant, at 60° to the normal: the way to y = 0.5 is 2, of 4; cos 60° = 1/2.
    let slant = [3f64.sqrt(), -1.0, 0.0];
    let floor = obstacle("plane", &[("normal", vector(0.0, 1.0, 0.0))]);
    let got = alone(floor, [0.0, 1.5, 0.0], slant);
    // Eight marches of a half each are 1 − 2⁻⁸ of the way.
    let reached = 2.0 * (1.0 - 0.5f64.powi(8));
    near(got, [0.0, 8.0 * (1.0 - reached / 4.0) * 0.5, 0.0, 0.0]);
    // Away, past, at rest outside, or too far ahead: nothing.
    for (x, v) in [
        ([-3.5, 0.0, 0.0], [-2.0, 0.0, 0.0]),
        ([-3.5, 1.6, 0.0], [2.0, 0.0, 0.0]),
        ([-1.6, 0.0, 0.0], [0.0, 0.0, 0.0]),
        ([-5.6, 0.0, 0.0], [2.0, 0.0, 0.0]),
    ] {
        near(alone(obstacle("sphere", &[]), x, v), [0.0; 4]);
    }
    // Touching and inside: straight out, at rest too; out of a box by the nearest face, and by its edge from outside.
    near(alone(obstacle("sphere", &[]), [0.0, -1.4, 0.0], [0.0; 3]), [0.0, -8.0, 0.0, 0.0]);
    near(alone(obstacle("sphere", &[]), [0.0; 3], [1.0, 2.0, 3.0]), [8.0, 0.0, 0.0, 0.0]);
    near(alone(obstacle("box", &[]), [-0.1, 1.5, 1.0], [5.0; 3]), [0.0, 8.0, 0.0, 0.0]);
    near(alone(obstacle("box", &[]), [-1.3, -2.4, 0.0], [0.0; 3]), [-4.8, -6.4, 0.0, 0.0]);
    // A bird that flies at a pillar does not fly through it.
    // A plane has no images: far on its free side in a periodic box there is none behind one's back.
    let around = Bounds::new(DVec3::splat(-2.0), DVec3::splat(2.0), Side::Periodic);
    let world = World { dt: 0.1, bounds: around, ..World::default() };
    let wall = obstacle("plane", &[("normal", vector(1.0, 0.0, 0.0)), ("position", vector(-2.0, 0.0, 0.0))]);
    near(crate::support::states::evaluated(&[wall], &one(DVec3::X, DVec3::ZERO), world).0[0], [0.0; 4]);
    let start = one(DVec3::new(-4.0, 0.3, 0.0), DVec3::X);
    let mut simulation = cpu(&start, vec![obstacle("sphere", &[])], "leapfrog", 0.01);
    let mut nearest = f64::INFINITY;
    for _ in 0..100 {
        simulation.step(10).expect("steps");
        nearest = nearest.min(phase(&mut simulation).0[0].truncate().length());
    }
    assert!(nearest > 1.0 && nearest < 3.0, "it came as near as {nearest}");
}

/// Predator and prey at a distance of 0.6 and of 0.8.
fn hunt() -> State {
    let mut three = one(DVec3::ZERO, DVec3::ZERO);
    three.push(DVec3::X * 0.6, DVec3::Y, 1.0, 0.0);
    three.push(DVec3::Y * 0.8, DVec3::ZERO, 1.0, 0.0);
    three.species_mut().copy_from_slice(&[7, 4, 4]);
    three
}

#[test]
fn prey_flee_and_predators_chase() {
    for over in ["near", "list", "within"] {
        let settings =
            [("range", NUMBER(2.0)), ("strength", NUMBER(5.0)), ("species", NUMBER(4.0)), ("predators", NUMBER(7.0))];
        let flee = force("flee", &[&settings[..], &[("over", word(over))]].concat());
        let a = accelerations(&[flee], &hunt(), 0.0);
        near(a[0], [0.0; 4]);
        near(a[1], [3.5, 0.0, 0.0, 0.0]);
        near(a[2], [0.0, 3.0, 0.0, 0.0]);
        // From two predators the two pushes add up.
        let settings =
            [("range", NUMBER(2.0)), ("strength", NUMBER(5.0)), ("species", NUMBER(7.0)), ("predators", NUMBER(4.0))];
        let flee = force("flee", &[&settings[..], &[("over", word(over))]].concat());
        near(accelerations(&[flee], &hunt(), 0.0)[0], [-3.5, -3.0, 0.0, 0.0]);
        let settings = [
            ("range", NUMBER(0.9)),
            ("max_speed", NUMBER(2.0)),
            ("max_force", NUMBER(9.0)),
            ("species", NUMBER(7.0)),
            ("prey", NUMBER(4.0)),
        ];
        let chase = |more: &[_]| [force("chase", &[&settings[..], &[("over", word(over))], more].concat())];
        // To the middle of (0.6, 0) and (0, 0.8), at full speed.
        let a = accelerations(&chase(&[]), &hunt(), 0.0);
        near(a[0], [1.2, 1.6, 0.0, 0.0]);
        assert!(a[1] == DVec4::ZERO && a[2] == DVec4::ZERO, "{a:?}");
        near(accelerations(&chase(&[("max_force", NUMBER(1.0))]), &hunt(), 0.0)[0], [0.6, 0.8, 0.0, 0.0]);
        near(accelerations(&chase(&[("range", NUMBER(0.7))]), &hunt(), 0.0)[0], [2.0, 0.0, 0.0, 0.0]);
        near(accelerations(&chase(&[("range", NUMBER(0.5))]), &hunt(), 0.0)[0], [0.0; 4]);
    }
}

#[test]
fn soft_walls_give_back_what_they_take() {
    let walls = || {
        let settings = [
            ("low", vector(-1.0, -2.0, -3.0)),
            ("high", vector(1.0, 2.0, 3.0)),
            ("margin", NUMBER(0.5)),
            ("acceleration", NUMBER(4.0)),
        ];
        force("soft_turn", &settings)
    };
    near(alone(walls(), [0.0; 3], [9.0; 3]), [0.0; 4]);
    near(alone(walls(), [0.75, -1.75, 3.5], [0.0; 3]), [-4.0, 4.0, -4.0, 1.0 + 1.0 + 4.0]);
    // In the plane no particle is above the box.
    let flat = Bounds { dimensions: 2, ..Bounds::default() };
    let world = World { dt: 0.1, bounds: flat, ..World::default() };
    near(evaluated(&[walls()], &one(DVec3::new(0.75, 0.0, 3.5), DVec3::ZERO), world).0[0], [-4.0, 0.0, 0.0, 1.0]);
    // v² / 2 a = 1/8 deep into the wall, and back again as fast.
    let mut simulation = cpu(&one(DVec3::ZERO, DVec3::X), vec![walls()], "leapfrog", 1.0 / 1024.0);
    let mut deepest = 0.0f64;
    for _ in 0..1024 {
        simulation.step(1).expect("a step");
        deepest = deepest.max(phase(&mut simulation).0[0].x);
    }
    // A step of the leapfrog across the edge of the wall errs by a dt / 2 of the speed.
    assert!((deepest - 0.625).abs() < 1e-3, "as far as {deepest}");
    let end = phase(&mut simulation).1[0].x;
    assert!((end + 1.0).abs() < 4.0 / 1024.0, "back at {end}");
}

/// The mean square of the velocity grows by σ² t, whatever the step; no direction is favoured, and none is kept.
#[test]
fn wandering_is_diffusion() {
    const COUNT: usize = 4000;
    let many = || {
        let mut many = State::default();
        (0..COUNT).for_each(|_| many.push(DVec3::ZERO, DVec3::ZERO, 1.0, 0.0));
        many
    };
    let n = COUNT as f64;
    for (dt, steps) in [(0.25, 8u32), (0.125, 16), (0.5, 4)] {
        let wander = vec![force("wander", &[("strength", NUMBER(0.7)), ("seed", NUMBER(12.0))])];
        let mut simulation = cpu(&many(), wander, "symplectic_euler", dt);
        simulation.step(steps).expect("steps");
        let v: Vec<DVec3> = phase(&mut simulation).1.iter().map(|v| v.truncate()).collect();
        let want = 0.7 * 0.7 * 2.0;
        // |v|² of a normal distribution in three dimensions varies by √(2/3) of its mean; of few steps by less.
        let square = v.iter().map(|v| v.length_squared()).sum::<f64>() / n;
        assert!((square / want - 1.0).abs() < 4.0 * (2.0 / 3.0 / n).sqrt(), "dt = {dt}: {square}, not {want}");
        let mean = v.iter().sum::<DVec3>() / n;
        assert!(mean.length() < 4.0 * (want / n).sqrt(), "dt = {dt}: a drift of {mean}");
        for axis in 0..3 {
            let part = v.iter().map(|v| v[axis] * v[axis]).sum::<f64>() / n;
            // The square of a normal number varies by √2 of its mean.
            assert!((part / want * 3.0 - 1.0).abs() < 4.0 * (2.0 / n).sqrt(), "dt = {dt}: {part} along axis {axis}");
        }
    }
    // In the plane: no third component, all of σ² in the two.
    let flat = World { dt: 0.25, bounds: Bounds { dimensions: 2, ..Bounds::default() }, ..World::default() };
    let wander = [force("wander", &[("strength", NUMBER(0.7))])];
    let a = evaluated(&wander, &many(), flat).0;
    assert!(a.iter().all(|a| a.z == 0.0 && (a.length() - 0.7 / 0.5).abs() < 1e-12));
    assert!((a.iter().sum::<DVec4>() / n).length() < 4.0 * 1.4 / n.sqrt());
}
