//! Pendulums.

use glam::DVec3;

use crate::cli::validate::claim::{Claim, Run};

pub const CLAIMS: &[Claim] = &[Claim {
    name: "pendulum",
    family: "rods",
    about: "a rigid pendulum of 1 m, let go level with its pivot, after 5/4 of its period of 4 K(sin² 45°) √(L / g) = 2.36784 s",
    run: Run::Builtin("pendulum", &["simulation.dt=0.001183920974", "simulation.until=2.959802434"]),
    quantity: "distance from the lowest point, which it passes with 4.4 m/s [m]",
    published: 0.0,
    source: "Legendre 1825: the complete elliptic integral K",
    tolerance: 5e-4,
    because: "leapfrog at ω dt = 0.003 is off by (ω dt)² / 24 = 4e-7 of the way, and 2500 roundings of 6e-8 by 1.5e-4; three times that",
    control: &["force.1.acceleration=[0, 0, -9.83]"],
    long: false,
    measure: |course| course.last().position()[1].distance(DVec3::NEG_Z),
}];
