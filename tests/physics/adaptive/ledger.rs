//! The ledger against direct sums, and what it counts.

use glam::DVec3;
use motes::kernel::Machine;
use motes::measure::Ledger;
use motes::motion::{Held, Hold};
use motes::sph::DENSITY;
use motes::{Bounds, Side};

use crate::adaptive::{ADAPTIVE, adapted, drop, fluid, on_gpu};
use crate::support::states::{force, vector};

#[test]
fn its_numbers_are_direct_sums() {
    let mut particles = drop();
    // Closer than at rest: pressure is above 0.
    particles.position_mut().iter_mut().for_each(|x| *x *= 0.93);
    particles.held = [3, 40, 77].map(|id| Held { id, by: Hold::Fixed }).to_vec();
    let weight = force("uniform", &[("acceleration", vector(0.0, 0.0, -3.0))]);
    let mut setup = adapted(&particles, vec![weight, fluid(4.0, &[])], "leapfrog", ADAPTIVE);
    setup.bounds =
        Bounds { low: DVec3::new(-1.0, -1.0, -0.7), high: DVec3::splat(1.0), sides: [Side::Open; 3], dimensions: 3 };
    let shared = crate::support::device();
    let mut simulation = on_gpu(&shared, &setup);
    simulation.step(2).expect("steps");
    let mut snapshot = pollster::block_on(simulation.snapshot()).expect("a snapshot");
    let density = pollster::block_on(simulation.read(DENSITY)).expect("densities");
    let problem = setup.problem(Machine::HOST).expect("a problem");
    let medium = setup.forces[1].resolved(&problem).expect("a fluid").fluid.expect("a medium").medium;
    let ledger = |snapshot: &motes::State, density: &[f32]| {
        Ledger::of(snapshot, density, &medium, &setup.bounds, |id| problem.is_held(id)).expect("energies")
    };
    let row = ledger(&snapshot, &density);

    let fluid = || (0..125usize).filter(|id| ![3, 40, 77].contains(id));
    let (x, v, m) = (snapshot.position(), snapshot.velocity(), snapshot.mass());
    let sum = |of: &dyn Fn(usize) -> f64| fluid().map(of).sum::<f64>();
    let near =
        |a: f64, b: f64, what: &str| assert!((a - b).abs() <= 1e-6 * b.abs().max(1e-9), "{what}: {a} is not {b}");
    assert_eq!((row.count, row.outside, row.broken, row.step), (122, 0, 0, 2));
    near(row.mass, 122.0, "mass");
    near(row.momentum.z, sum(&|i| m[i] * v[i].z), "momentum");
    near(row.kinetic, sum(&|i| 0.5 * m[i] * v[i].length_squared()), "kinetic");
    // Weight is all of the potential energy that is not of pressure; single precision made both.
    let weighs = sum(&|i| 3.0 * m[i] * x[i].z);
    assert!((row.potential - weighs).abs() < 1e-5 * (weighs.abs() + row.internal), "{} is not {weighs}", row.potential);
    // ∫ p / ρ² dρ from ρ₀ by Simpson's rule, p = ρ₀ c² / 7 ((ρ/ρ₀)⁷ − 1).
    let energy = |rho: f64| {
        let f = |r: f64| 1000.0 * 16.0 / 7.0 * ((r / 1000.0f64).powi(7) - 1.0) / (r * r);
        let end = rho.max(1000.0);
        let h = (end - 1000.0) / 64.0;
        (0..64)
            .map(|k| 1000.0 + h * f64::from(k))
            .map(|a| h / 6.0 * (f(a) + 4.0 * f(a + h / 2.0) + f(a + h)))
            .sum::<f64>()
    };
    let rho = |i: usize| f64::from(density[i]);
    assert!(row.internal > 0.0, "it must be pressed");
    near(row.internal, sum(&|i| m[i] * energy(rho(i))), "internal");
    let errors = || fluid().map(|i| (rho(i) / 1000.0 - 1.0).max(0.0));
    near(row.mean_density, errors().sum::<f64>() / 122.0, "mean density");
    near(row.worst_density, errors().fold(0.0, f64::max), "worst density");
    near(rho(row.worst_particle as usize) / 1000.0 - 1.0, row.worst_density, "the worst particle");
    near(row.total(), row.kinetic + row.potential + row.internal, "total");

    // What must stay 0, and does not: three are out, of which one is held; one is broken.
    snapshot.position_mut()[7].z = -0.71;
    snapshot.position_mut()[8].x = 1.01;
    snapshot.position_mut()[40].x = 5.0;
    snapshot.velocity_mut()[9].y = f64::NAN;
    let row = ledger(&snapshot, &density);
    assert_eq!((row.outside, row.broken, row.count), (2, 1, 122));
    assert!((row.mass - 121.0).abs() < 1e-6 && row.kinetic.is_finite());
}
