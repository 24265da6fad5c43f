//! Chains: waves bit for bit, their dispersion, and how they hang.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use motes::{POSITION, State, VELOCITY};

use super::{at, fix, forces, gpu, setup, spring};
use crate::support;
use crate::support::states::{accelerations, cpu, force, phase, vector};

/// Particles in a row along x, each linked to the next.
fn row(count: usize, spacing: f64, mass: f64, rest: f64, stiffness: f64) -> State {
    let places: Vec<[f64; 3]> = (0..count).map(|i| [spacing * i as f64, 0.0, 0.0]).collect();
    let mut particles = at(&places, mass);
    let last = count as u32 - 1;
    particles.links.springs = (0..last).map(|i| spring([i, i + 1], rest, stiffness)).collect();
    particles
}

/// Where ω dt is 1 for the shortest link, leapfrog is d'Alembert's solution: a wave comes back after 2 (N − 1) steps, to
/// the bit, for all numbers in it are multiples of 2⁻¹¹ below 2¹³.
#[test]
fn a_wave_comes_back_to_the_bit() {
    let shared = support::device();
    let count = 256;
    let mut particles = row(count, 1.0, 1.0, 0.0, 1.0);
    fix(&mut particles, [0, 255]);
    let mut random = support::Random::new(3);
    for x in &mut particles.position_mut()[1..255] {
        *x += DVec3::from(std::array::from_fn(|_| (random.next() * 512.0).round() / 1024.0));
    }
    let mut simulation = gpu(&shared, &setup(&particles, forces(0.0, 0.0), "leapfrog", 1.0));
    let read = |simulation: &mut motes::Simulation<motes::Gpu>, field: motes::kernel::Field<glam::Vec4>| -> Vec<Vec3> {
        let values = pollster::block_on(simulation.read(field)).expect("a field");
        values.iter().map(|v| v.truncate()).collect()
    };
    let start = read(&mut simulation, POSITION);
    simulation.step(255).expect("steps");
    // Half way it stands mirrored.
    let half = read(&mut simulation, POSITION);
    let mirrored = |i: usize| Vec3::X * 255.0 - start[255 - i];
    assert!((0..count).all(|i| half[i] == mirrored(i)), "half way: {} {}", half[7], mirrored(7));
    assert_ne!(half, start, "nothing moves");
    simulation.step(255).expect("steps");
    assert_eq!(read(&mut simulation, POSITION), start);
    assert!(read(&mut simulation, VELOCITY).iter().all(|v| *v == Vec3::ZERO));
}

/// Modes of a chain between walls: ω = 2 √(k/m) sin (n π / 2 (N + 1)), and what leapfrog makes of it, sin (Ω h / 2) = h ω / 2.
#[test]
fn dispersion() {
    let shared = support::device();
    let (free, h) = (64, 0.02);
    // n, ω, Ω of leapfrog
    let known = [
        (1, 1.528_249_434_924_424_7, 1.528_308_929_466_942_3),
        (10, 15.135_651_578_097_988, 15.194_045_507_479_942),
        (32, 44.177_737_714_008_57, 45.757_890_212_585_714),
        (64, 63.227_086_392_341_796, 68.448_082_069_399_2),
    ];
    for (n, omega, numerical) in known {
        assert!((2.0 * (h * omega / 2.0_f64).asin() / h - numerical).abs() < 1e-12, "the numbers say the same");
        let mode = |i: usize| (f64::from(n) * PI * i as f64 / (free as f64 + 1.0)).sin();
        let mut particles = row(free + 2, 1.0, 0.1, 0.0, 100.0);
        fix(&mut particles, [0, 65]);
        for (i, x) in particles.position_mut().iter_mut().enumerate() {
            *x += DVec3::new(0.03, 0.05, -0.02) * mode(i);
        }
        let amplitude = |x: &dyn Fn(usize) -> DVec3| {
            (1..=free).map(|i| mode(i) * (x(i) - DVec3::X * i as f64).y).sum::<f64>() * 2.0 / (free as f64 + 1.0) / 0.05
        };
        let mut simulation = cpu(&particles, forces(0.0, 0.0), "leapfrog", h);
        let mut device = gpu(&shared, &setup(&particles, forces(0.0, 0.0), "leapfrog", h));
        for steps in [7, 93] {
            simulation.step(steps).expect("steps");
            device.step(steps).expect("steps");
            let (x, _) = phase(&mut simulation);
            let done = simulation.steps() as f64;
            let (got, want) = (amplitude(&|i| x[i].truncate()), (numerical * h * done).cos());
            assert!((got - want).abs() < 1e-11, "mode {n} after {done} steps: {got}, not {want}");
            // The start is rounded by 6e-8 of a place up to 64, 4e-6 / 0.05 / √32; and dt by 3e-8 turns the phase.
            let x = pollster::block_on(device.read(POSITION)).expect("places");
            let got = amplitude(&|i| x[i].as_dvec4().truncate());
            assert!((got - want).abs() < 4e-5, "mode {n} on the device after {done} steps: {got}, not {want}");
        }
    }
}

/// A chain that hangs: spring i carries what is below it, (N − i + 1) m g.
#[test]
fn what_a_hanging_chain_carries() {
    let (count, spacing, mass, stiffness, g) = (13usize, 0.2, 0.3, 700.0, 9.81);
    let mut particles = row(count, spacing, mass, spacing, stiffness);
    let mut depth = 0.0;
    particles.position_mut()[0] = DVec3::ZERO;
    for i in 1..count {
        depth += spacing + (count - i) as f64 * mass * g / stiffness;
        particles.position_mut()[i] = DVec3::new(0.0, 0.0, -depth);
    }
    let n = (count - 1) as f64;
    assert!((depth - (n * spacing + mass * g / stiffness * n * (n + 1.0) / 2.0)).abs() < 1e-12);
    let all = [force("spring", &[]), force("uniform", &[("acceleration", vector(0.0, 0.0, -g))])];
    for (i, a) in accelerations(&all, &particles, 0.0).iter().enumerate().skip(1) {
        // Lengths and stiffnesses are held in f32: 6e-8 of k L / m.
        assert!(a.truncate().length() < 2e-7 * stiffness * spacing / mass, "particle {i}: {a}");
    }
}

/// An elastic chain between two points, found elsewhere by Newton's method.
#[test]
fn an_elastic_catenary() {
    let (stiffness, rest, mass) = (1000.0, 0.075, 0.01);
    let mut particles = row(21, 0.05, mass, rest, stiffness);
    // Along half an ellipse, so that nothing is crumpled.
    for (i, x) in particles.position_mut().iter_mut().enumerate() {
        let angle = PI * (1.0 - i as f64 / 20.0);
        *x = DVec3::new(0.5 + 0.5 * angle.cos(), 0.0, -0.45 * angle.sin());
    }
    fix(&mut particles, [0, 20]);
    let mut simulation = cpu(&particles, forces(9.81, 6.0), "leapfrog", 0.002);
    simulation.step(4500).expect("steps");
    let (x, v) = phase(&mut simulation);
    let still = v.iter().map(|v| v.truncate().length()).fold(0.0, f64::max);
    assert!(still < 1e-8, "it still moves, by {still:e}");
    // L is 0.075 rounded to f32, by 3e-9.
    let near = |id: usize, [a, b]: [f64; 2]| {
        let apart = (x[id].x - a).hypot(x[id].z - b);
        assert!(apart < 2e-7, "particle {id} is {apart:e} away: {}", x[id]);
    };
    near(10, [0.5, -0.511_863_204_320_118_2]);
    near(1, [0.029_703_838_667_606_68, -0.069_968_387_595_197_15]);
    let first = (x[1] - x[0]).truncate();
    let pull = stiffness * (first.length() - rest) * first.normalize().x;
    assert!((pull - 0.395_642_839_097_784_25).abs() < 1e-5, "H is {pull}");
}
