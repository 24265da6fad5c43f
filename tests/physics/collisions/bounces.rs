//! Bodies that bounce: closed forms, and gases of hard spheres.

use std::f64::consts::PI;

use glam::DVec3;
use motes::settings::Value;
use motes::{Bounds, Setup, Side, State};

use super::{bodies, bouncing, kinetic, momentum, near, on, references, state, with_radii};
use crate::support::states::{phase, word};
use crate::support::{self, Random};

/// Hard spheres on a lattice in a periodic box, all as fast.
fn gas(cells: usize, spacing: f64, seed: u64) -> (State, Bounds) {
    let mut random = Random::new(seed);
    let mut state = State::default();
    for k in 0..cells.pow(3) {
        let [x, y, z] = [k % cells, k / cells % cells, k / cells / cells].map(|i| i as f64 + 0.5);
        state.push(spacing * DVec3::new(x, y, z), 3f64.sqrt() * random.vector().normalize(), 1.0, 0.0);
    }
    let count = state.len();
    let drift = momentum(&state) / count as f64;
    state.velocity_mut().iter_mut().for_each(|v| *v -= drift);
    let bounds = Bounds::new(DVec3::ZERO, DVec3::splat(spacing * cells as f64), Side::Periodic);
    (with_radii(state, vec![0.5; count]), bounds)
}

/// Spheres that lose no energy take on Maxwell's distribution: from equal speeds ⟨v⁴⟩ / ⟨v²⟩² goes from 1 to 5/3.
#[test]
fn elastic_spheres_become_a_gas() {
    let shared = support::device();
    for seed in [1, 2] {
        let (start, bounds) = gas(12, 1.9, seed);
        let forces = vec![near(1.0, &[("outcome", word("bounce"))])];
        let mut simulation = on(&shared, &Setup { bounds, ..Setup::new(start.clone(), forces, 0.02) });
        simulation.step(600).expect("steps");
        let end = state(&mut simulation);
        // Some 6000 collisions, each of which rounds the energy of two by 1e-7.
        assert!((kinetic(&end) / kinetic(&start) - 1.0).abs() < 2e-6, "{seed}: {}", kinetic(&end));
        assert!((momentum(&end) - momentum(&start)).length() < 1e-2, "{seed}: {}", momentum(&end));
        let mean = |power: i32| end.velocity().iter().map(|v| v.length().powi(power)).sum::<f64>() / end.len() as f64;
        let kurtosis = mean(4) / mean(2).powi(2);
        // √(8 / 3 N) · … of 1728 samples of it is about 0.04.
        assert!((kurtosis - 5.0 / 3.0).abs() < 0.15, "{seed}: {kurtosis}");
    }
}

/// Haff's law (J. Fluid Mech. 134, 401, 1983): spheres that lose energy cool as T = T₀ / (1 + t / τ)², 1 / τ = (1 − e²) ω / 6, with Enskog's rate of
/// collisions ω = 4 n d² χ √(π T₀ / m) and χ of Carnahan & Starling (J. Chem. Phys. 51, 635, 1969).
#[test]
fn inelastic_spheres_cool_by_haffs_law() {
    let shared = support::device();
    let (restitution, spacing, dt, steps) = (0.8f64, 2.4f64, 0.02, 1000);
    // The gas of equal speeds first becomes one of Maxwell's.
    let (start, bounds) = gas(14, spacing, 7);
    let run = |state: State, restitution: f64, steps: u32| {
        let settings = [("outcome", word("bounce")), ("restitution", Value::Number(restitution))];
        let setup = Setup { bounds, ..Setup::new(state, vec![near(1.0, &settings)], dt) };
        let mut simulation = on(&shared, &setup);
        simulation.step(steps).expect("steps");
        self::state(&mut simulation)
    };
    let warm = run(start, 1.0, 800).begin_anew();
    let temperature = |state: &State| 2.0 * kinetic(state) / (3.0 * state.len() as f64);
    let first = temperature(&warm);
    let last = temperature(&run(warm, restitution, steps));
    let density = spacing.powi(-3);
    let part = PI / 6.0 * density;
    let crowded = (1.0 - 0.5 * part) / (1.0 - part).powi(3);
    let rate = 4.0 * density * crowded * (PI * first).sqrt() * (1.0 - restitution * restitution) / 6.0;
    let right = first / (1.0 + rate * dt * f64::from(steps)).powi(2);
    // 2744 spheres have some 13 000 collisions. Steps of a fortieth of a diameter find a grazing one in a hundred too late.
    assert!((last / right - 1.0).abs() < 0.04, "{first} cools to {last}, for {right}");
    assert!(right < 0.6 * first);
}

/// The ball that meets another of e and masses m, M at an angle: momentum, angular momentum, and the speed at which they part.
#[test]
fn bounces_in_the_large() {
    for (restitution, mass) in [(1.0, 1.0), (0.5, 3.0), (0.25, 0.0), (0.0, 2.0)] {
        let start = bodies(&[
            (DVec3::new(-0.3, 0.05, 0.02), DVec3::new(2.0, 0.3, 0.0), 2.0, 0.1),
            (DVec3::new(0.0, 0.0, 0.0), DVec3::new(0.0, -0.2, 0.1), mass, 0.1),
        ]);
        let mut simulation = references(&Setup::new(start.clone(), vec![bouncing(restitution)], 0.01));
        let mut before = (start.position().to_vec(), start.velocity().to_vec());
        let bounced = (0..40).find_map(|_| {
            simulation.step(1).expect("a step");
            let (x, v) = phase(&mut simulation);
            let [x, v] = [x, v].map(|all| all.iter().map(|one| one.truncate()).collect::<Vec<_>>());
            let was = std::mem::replace(&mut before, (x.clone(), v.clone()));
            (v[0] != was.1[0] || v[1] != was.1[1]).then_some((x, v, was.1))
        });
        let (x, v, was) = bounced.expect("a collision");
        let n = (x[1] - x[0]).normalize();
        let (away, toward) = ((v[1] - v[0]).dot(n), (was[1] - was[0]).dot(n));
        assert!(toward < 0.0 && (away + restitution * toward).abs() < 1e-12, "{away}, {toward}");
        let moment = |v: &[DVec3]| 2.0 * x[0].cross(v[0]) + mass * x[1].cross(v[1]);
        assert!((2.0 * (v[0] - was[0]) + mass * (v[1] - was[1])).length() < 1e-12);
        assert!((moment(&v) - moment(&was)).length() < 1e-12);
        // The tangential part is as it was.
        let across = |u: DVec3| u - u.dot(n) * n;
        assert!((across(v[1] - v[0]) - across(was[1] - was[0])).length() < 1e-12);
    }
}
