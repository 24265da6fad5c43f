//! The shapes by themselves: distances in closed form, the way out of the very middle, and what is refused.

use glam::{DVec3, Vec4};
use motes::kernel::{Backend, POSITION};
use motes::settings::Value;
use motes::solids::{SHAPES, Solid};
use motes::{Cpu, Simulation};

use crate::solids::{number, setup, solid};
use crate::support::Random;
use crate::support::states::{one, vector, word};

#[test]
fn distances_are_those_of_the_nearest_points() {
    let mut random = Random::new(3);
    for _ in 0..200 {
        let d = random.vector() * 2.0;
        let (size, axis, radius) = (DVec3::new(1.3, 0.7, 2.1), random.vector() * 1.5, 0.4 + 0.3 * random.next());
        // The nearest point of a line, sought in a thousand places: the distance is as flat there as a parabola.
        let line = |n: i32| (d - f64::from(n - 500) / 1000.0 * axis).length();
        let nearest = (0..=1000).map(line).fold(f64::INFINITY, f64::min) - radius;
        let (n, distance) = Solid::Capsule(axis, radius).distance(d, 3);
        assert!((distance - nearest).abs() < 1e-3 && distance <= nearest, "{distance} is not {nearest}");
        assert!(((distance + radius) * n).dot(n) > 0.0 && (n.length() - 1.0).abs() < 1e-12);
        let (n, distance) = Solid::Box(size).distance(d, 3);
        let outside = d - d.clamp(-0.5 * size, 0.5 * size);
        let faces = (d.abs() - 0.5 * size).max_element();
        let want = if faces > 0.0 { outside.length() } else { faces };
        assert!((distance - want).abs() < 1e-12, "box: {distance} is not {want}");
        // Straight out: from there the distance is the way back, whatever the solid.
        for solid in [Solid::Box(size), Solid::Capsule(axis, radius), Solid::Sphere(radius), Solid::Plane(DVec3::Y)] {
            let (n, distance) = solid.distance(d, 3);
            let out = d + n * (0.3 - distance);
            assert!((solid.distance(out, 3).1 - 0.3).abs() < 1e-12, "{solid:?} at {d}");
        }
        assert!((n.length() - 1.0).abs() < 1e-12);
    }
    assert_eq!(Solid::Sphere(2.0).distance(DVec3::ZERO, 3), (DVec3::X, -2.0));
    assert_eq!(Solid::Capsule(DVec3::X, 0.5).distance(DVec3::X * 0.2, 3), (-DVec3::Y, -0.5));
    assert_eq!(Solid::Capsule(DVec3::Z, 0.5).distance(DVec3::ZERO, 3), (DVec3::X, -0.5));
    assert_eq!(Solid::Capsule(DVec3::ZERO, 0.5).distance(DVec3::Y, 3), (DVec3::Y, 0.5));
    assert_eq!(Solid::Box(DVec3::ONE).distance(DVec3::Z * 3.0, 2), (DVec3::X, -0.5));
}

/// In the very middle all ways are as long: one of them is taken, and nothing is NaN.
#[test]
fn from_the_very_middle_there_is_a_way_out() {
    let shared = crate::support::device();
    for shape in SHAPES {
        for axis in [DVec3::X, DVec3::Z, DVec3::ZERO] {
            let force = solid(shape, &[("axis", Value::Vector(axis)), ("thickness", number(0.1))]);
            let mut both = one(DVec3::ZERO, DVec3::ZERO);
            both.push(DVec3::ZERO, DVec3::X * 0.2, 1.0, 0.0);
            let setup = setup(both, vec![force], "leapfrog", 0.1);
            let mut simulation =
                Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation");
            simulation.step(1).expect("a step");
            let x: Vec<Vec4> = pollster::block_on(simulation.read(POSITION)).expect("places");
            let out = if *shape == "plane" { 0.1 } else { 0.6 };
            assert!((x[0].truncate().length() - out).abs() < 1e-6, "{shape}: {}", x[0]);
            assert!(x[1].is_finite() && pollster::block_on(simulation.check()).is_ok(), "{shape}: {}", x[1]);
        }
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    let refused = |shape, settings: &[(&'static str, Value)], words: &str| {
        let setup = setup(one(DVec3::ZERO, DVec3::ZERO), vec![solid(shape, settings)], "leapfrog", 0.1);
        let machine = Cpu::new(1).expect("one").machine();
        let error = setup.plans(machine).err().map(|e| e.to_string()).unwrap_or_default();
        assert!(error.contains(words), "{error} does not say `{words}`");
    };
    refused("sphere", &[("restitution", number(1.1))], "restitution 1.1: the maximum is 1");
    refused("plane", &[("motion", word("nowhere"))], "has the motion \"nowhere\"");
    refused("box", &[("size", vector(1.0, -1.0, 1.0))], "has no interior");
    refused("sphere", &[("inside", Value::Flag(true)), ("thickness", number(0.6))], "has no interior");
}
