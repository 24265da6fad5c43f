//! Few bodies.

use glam::DVec3;

use crate::cli::validate::claim::{Claim, Run};

pub const CLAIMS: &[Claim] = &[
    Claim {
        name: "kepler",
        family: "orbits",
        about: "two bodies of masses 0.9 and 0.1 on ellipses, a = 1, e = 0.5, G = 1: half of a period of 2 π",
        run: Run::Builtin("kepler", &["simulation.steps=500"]),
        quantity: "distance of the light one from its apocentre, (−1.35, 0) [a]",
        published: 0.0,
        source: "Kepler 1609, Newton 1687",
        tolerance: 1e-4,
        because: "single precision: 6e-8 of positions and velocities of about 1 in each of 500 steps is 3e-5 at most, and a period that is off by as much another 9e-5 of the way",
        control: &["simulation.integrator=symplectic_euler"],
        long: false,
        measure: |course| course.last().position()[1].distance(DVec3::new(-1.35, 0.0, 0.0)),
    },
    Claim {
        name: "figure_eight",
        family: "orbits",
        about: "three equal bodies on one figure of eight, at t = 1",
        run: Run::Builtin("figure_eight", &["simulation.dt=0.001", "simulation.until=1", "simulation.integrator=rk4"]),
        quantity: "distance of the first body from (0.993582915, 0.219204947) [length]",
        published: 0.0,
        source: "Chenciner & Montgomery, Annals of Mathematics 152, 881, 2000; position by a Taylor series of order 30 with 200 bits",
        tolerance: 1e-5,
        because: "single precision: 1000 roundings of 6e-8, and their growth",
        control: &["force.0.g=1.0001"],
        long: false,
        measure: |course| course.last().position()[0].distance(DVec3::new(0.993_582_915, 0.219_204_947, 0.0)),
    },
    Claim {
        name: "pythagorean",
        family: "orbits",
        about: "three bodies of masses 3, 4 and 5 that fall from rest, after an encounter at t = 1.88 within 0.01",
        run: Run::Builtin("pythagorean", &["simulation.until=5"]),
        quantity: "distance of the lightest from (2.469169667, -1.227815564) [length]",
        published: 0.0,
        source: "Burrau, Astronomische Nachrichten 195, 113, 1913; position by Taylor series of orders 30 and 40 with 200 bits",
        tolerance: 2e-4,
        because: "forces in single precision: roundings of 6e-8, which the encounter multiplies by some hundreds",
        control: &["force.0.g=1.001"],
        long: false,
        measure: |course| course.last().position()[0].distance(DVec3::new(2.469_169_667, -1.227_815_564, 0.0)),
    },
    Claim {
        name: "solar_system",
        family: "orbits",
        about: "the Sun, eight planets and Pluto after a year of 365.25 days, from the states of Mercury 6",
        run: Run::Builtin("solar_system", &[]),
        quantity: "distance of the Earth from its place by an integration of high order [AU]",
        published: 0.0,
        source: "states of Mercury 6 (Chambers, MNRAS 304, 793, 1999); positions by IAS15 (Rein & Spiegel, MNRAS 446, 1424, 2015) and again by DOP853",
        tolerance: 5e-5,
        because: "single precision: 6e-8 AU in each of 487 steps, which the motion of a year turns into 1e-5 AU",
        control: &["simulation.integrator=symplectic_euler"],
        long: false,
        measure: |course| {
            let x = course.last().position();
            (x[3] - x[0]).distance(DVec3::new(0.241_982_637, -0.987_502_305, -0.000_002_330))
        },
    },
];
