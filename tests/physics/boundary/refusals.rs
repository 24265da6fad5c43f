//! Boxes that cannot be, and particles that do not fit.

use glam::DVec3;
use motes::{Bounds, Error, Side, State};

use crate::boundary::{inside, odd, scattered, setup};

fn refused(particles: State, bounds: Bounds, words: &[&str]) {
    match setup(particles, Vec::new(), "leapfrog", 0.1, bounds).check() {
        Err(Error::Scene(text)) => {
            for word in words {
                assert!(text.contains(word), "`{text}` does not say `{word}`");
            }
        }
        other => panic!("{words:?}: {other:?}"),
    }
}

fn accepted(particles: State, bounds: Bounds) {
    let setup = setup(particles, Vec::new(), "leapfrog", 0.1, bounds);
    assert!(setup.check().is_ok(), "{:?}", setup.check());
}

#[test]
fn boxes_that_cannot_be() {
    for side in [Side::Periodic, Side::Reflecting] {
        let good = odd([side; 3]);
        let particles = || inside(5, &good, 1);
        accepted(particles(), good);
        for dimensions in [0, 1, 4, u32::MAX] {
            let number = dimensions.to_string();
            refused(particles(), Bounds { dimensions, ..good }, &[&number, "2 or 3"]);
        }
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e38, 1e300] {
            refused(particles(), Bounds { low: good.low.with_y(bad), ..good }, &["along y", "8.5e37"]);
            refused(particles(), Bounds { high: good.high.with_x(bad), ..good }, &["along x", "8.5e37"]);
        }
        for high in [-0.7, -0.7 + 1e-12, -3.0] {
            let (number, word) = (high.to_string(), side.name());
            refused(particles(), Bounds { high: good.high.with_x(high), ..good }, &["along x", &number, word, "open"]);
        }
        // Along an open axis it says nothing.
        let open = Bounds { high: good.high.with_y(-3.0), sides: [side, Side::Open, side], ..good };
        accepted(particles(), open);
        refused(particles(), Bounds { dimensions: 2, ..good }, &["2 dimensions", side.name(), "along z"]);
    }
    accepted(inside(5, &odd([Side::Open; 3]), 1), Bounds::default());
}

#[test]
fn particles_that_do_not_fit() {
    let reflecting = odd([Side::Open, Side::Reflecting, Side::Open]);
    let mut particles = inside(5, &reflecting, 1);
    particles.position_mut()[3].y = 3.75;
    refused(particles.clone(), reflecting, &["particle 3", "y = 3.75", "from 3.1 to 3.7", "larger"]);
    // As an earlier run in single precision left it.
    particles.position_mut()[3].y = f64::from(3.7_f32);
    assert!(particles.position()[3].y > 3.7);
    accepted(particles.clone(), reflecting);
    particles.position_mut()[3].x = 99.0;
    accepted(particles, reflecting);
    accepted(scattered(50, &odd([Side::Periodic; 3]), 1), odd([Side::Periodic; 3]));

    let flat = Bounds::new(DVec3::ZERO, DVec3::new(2.0, 3.0, 0.0), Side::Periodic);
    assert_eq!((flat.dimensions, flat.sides[2]), (2, Side::Open));
    let mut plane = inside(5, &odd([Side::Periodic; 3]), 1);
    let (positions, velocities) = plane.phase_mut();
    positions.iter_mut().chain(velocities).for_each(|v| v.z = 0.0);
    accepted(plane.clone(), flat);
    for moving in [false, true] {
        let mut out = plane.clone();
        let vectors = if moving { out.velocity_mut() } else { out.position_mut() };
        vectors[2].z = 0.25;
        refused(out, flat, &["particle 2", "0.25", "2 dimensions", "z = 0", "set dimensions = 3"]);
    }
}
