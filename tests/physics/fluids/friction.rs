//! How viscous a fluid is: the decay of a wave of shear.

use std::f64::consts::TAU;

use glam::DVec3;
use motes::settings::Value;
use motes::{Bounds, Side, State};

use crate::support::states::{accelerations_in, force, word};
use Value::Number;

/// The kinematic viscosity that slows down  v = sin(2 π y)  along x, of what rubs, in the plane and in space.
fn viscosity(flat: bool, support: f64, rubs: &[(&'static str, Value)]) -> f64 {
    let n = 20;
    let spacing = 1.0 / f64::from(n);
    let mut particles = State::default();
    let depth = if flat { 1 } else { 9 };
    for k in 0..depth {
        for j in 0..n {
            for i in 0..if flat { n } else { 9 } {
                let x = spacing
                    * DVec3::new(f64::from(i) + 0.5, f64::from(j) + 0.5, if flat { 0.0 } else { f64::from(k) + 0.5 });
                let mass = 1000.0 * spacing.powi(if flat { 2 } else { 3 });
                particles.push(x, DVec3::X * (TAU * x.y).sin(), mass, 0.0);
            }
        }
    }
    let size = if flat { DVec3::new(1.0, 1.0, 0.0) } else { DVec3::new(9.0 * spacing, 1.0, 9.0 * spacing) };
    let settings = [
        ("spacing", Number(spacing)),
        ("support", Number(support)),
        ("kernel", word("wendland")),
        ("sound_speed", Number(10.0)),
    ];
    let settings = [&settings[..], rubs].concat();
    let bounds = Bounds::new(DVec3::ZERO, size, Side::Periodic);
    let got = accelerations_in(&bounds, &[force("fluid", &settings)], &particles, 0.0);
    let slowed: f64 = got.iter().zip(particles.velocity()).map(|(a, v)| a.truncate().dot(*v)).sum();
    let square: f64 = particles.velocity().iter().map(|v| v.length_squared()).sum();
    -slowed / square / (TAU * TAU)
}

#[test]
fn waves_of_shear_are_slowed_by_the_viscosity_that_is_asked_for() {
    for flat in [true, false] {
        // The kernel's sums that are to be integrals are 0.2 to 1 % off; and a wave as long as 5 supports is smoothed:
        // (2 π s)² / 8 or so, 2 % with s = 0.1.
        let laminar =
            |form| viscosity(flat, 4.0, &[("viscosity", Number(0.01)), ("viscosity_form", word(form))]) / 0.01;
        let (morris, central) = (laminar("morris"), laminar("central"));
        println!("laminar: {morris:.4} by Morris, {central:.4} central");
        assert!((morris - 1.0).abs() < 0.04, "flat {flat}: {morris}");
        // Of its neighbours those count that stand aslant: on this lattice, for waves along its edges, the sum is 0.958 of the integral in
        // the plane and 0.980 in space.
        let sum = if flat { 0.958 } else { 0.980 };
        assert!((central / sum - 1.0).abs() < 0.03, "flat {flat}: {central}");
        // ν = α s c / (2 (D + 2)) (Monaghan 2005), where pairs that approach and that part rub; here those alone that approach.
        let dimensions = if flat { 2.0 } else { 3.0 };
        let artificial =
            viscosity(flat, 4.0, &[("alpha", Number(0.1))]) / (0.1 * 0.1 * 10.0 / (4.0 * (dimensions + 2.0)));
        println!("artificial: {artificial:.4}");
        // The same; and of neighbours on a lattice fewer stand aslant than all around.
        assert!((artificial - 1.0).abs() < 0.1, "flat {flat}: {artificial}");
    }
}
