//! Limits of stability and growth factors on the device: pairs of particles on springs without rest length, which are
//! oscillators bit for bit, a pair for every y = hω, side by side.

use glam::{DVec3, DVec4};
use motes::{POSITION, State, VELOCITY};

use super::{at, forces, gpu, setup, spring};
use crate::support::{self, Shared};

const H: f64 = 0.5;
const MASS: f64 = 0.75;

/// A pair for each y. What they are to each other starts at x = (1, 0, 0), v = (0.3 ω, ω, 0).
fn pairs(ys: &[f64]) -> State {
    let mut particles = State::default();
    for (n, y) in ys.iter().enumerate() {
        let (omega, first) = (y / H, 2 * n as u32);
        let way = DVec3::new(0.3, 1.0, 0.0) * omega / 2.0;
        let mut pair = at(&[[-0.5, 0.0, 0.0], [0.5, 0.0, 0.0]], MASS);
        pair.velocity_mut().copy_from_slice(&[-way, way]);
        pair.links.springs.push(spring([0, 1], 0.0, omega * omega * MASS / 2.0));
        particles.append(&pair).expect("one kind");
        assert_eq!(particles.links.springs[n].ends, [first, first + 1]);
    }
    particles
}

/// Places and velocities of the pairs, relative, after some steps, in units in which the energy is x² + v².
fn run(shared: &Shared, name: &str, ys: &[f64], steps: u32) -> Vec<[DVec4; 2]> {
    let mut simulation = gpu(shared, &setup(&pairs(ys), forces(0.0, 0.0), name, H));
    simulation.step(steps).expect("steps");
    let x = pollster::block_on(simulation.read(POSITION)).expect("places");
    let v = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
    let pair = |(n, y): (usize, &f64)| {
        let of = |f: &[glam::Vec4]| (f[2 * n + 1].as_dvec4() - f[2 * n].as_dvec4()).with_w(0.0);
        [of(&x), of(&v) * (H / y)]
    };
    ys.iter().enumerate().map(pair).collect()
}

const YS: [f64; 5] = [0.1, 0.3, 0.7, 1.0, 1.4];
const STEPS: u32 = 16;

/// The growth factor of the energy in a step.
#[test]
fn growth_factors() {
    let shared = support::device();
    let runge_kutta_2 = |y: f64| 1.0 + y.powi(4) / 4.0;
    let cases: [(&str, Factor); 4] = [
        ("forward_euler", &|y| 1.0 + y * y),
        ("midpoint", &runge_kutta_2),
        ("heun", &runge_kutta_2),
        ("rk4", &|y| 1.0 - y.powi(6) / 72.0 + y.powi(8) / 576.0),
    ];
    for (name, factor) in cases {
        for (y, [x, v]) in YS.iter().zip(run(&shared, name, &YS, STEPS)) {
            let start = 1.0 + 0.09 + 1.0;
            let got = ((x.length_squared() + v.length_squared()) / start).powf(1.0 / f64::from(STEPS));
            // Sixteen steps of a dozen roundings by 6e-8, of which the root takes a sixteenth.
            assert!((got - factor(*y)).abs() < 1e-6 * factor(*y), "{name} at {y}: {got}, not {}", factor(*y));
        }
    }
}

/// The invariant of symplectic integrators: not the energy, but a quadratic form close to it.
#[test]
fn what_is_kept() {
    let shared = support::device();
    let euler: fn(f64, DVec4, DVec4) -> f64 = |y, x, v| x.length_squared() + v.length_squared() - y * x.dot(v);
    let leapfrog: fn(f64, DVec4, DVec4) -> f64 =
        |y, x, v| v.length_squared() + x.length_squared() * (1.0 - y * y / 4.0);
    for name in ["symplectic_euler", "leapfrog"] {
        let form = if name == "leapfrog" { leapfrog } else { euler };
        let ys = [0.1, 0.7, 1.4, 1.9];
        let start = run(&shared, name, &ys, 0);
        for ((y, end), start) in ys.iter().zip(run(&shared, name, &ys, 1000)).zip(start) {
            let (got, want) = (form(*y, end[0], end[1]), form(*y, start[0], start[1]));
            // A walk at random of 1000 steps, √1000 of 1e-7; where the form is small beside its terms, tenfold.
            assert!((got - want).abs() < 1e-4 * want, "{name} at {y}: {got}, not {want}");
            let energy = |[x, v]: [DVec4; 2]| x.length_squared() + v.length_squared();
            assert!((energy(end) / energy(start) - 1.0).abs() > 1e-4, "{name} at {y} keeps the energy too?");
        }
    }
}

#[test]
fn limits_of_stability() {
    let shared = support::device();
    let limits = [
        ("symplectic_euler", 2.0),
        ("leapfrog", 2.0),
        ("rk4", 8f64.sqrt()),
        ("forest_ruth", 1.573_401_947_435),
        ("pefrl", 2.989_449_545_907),
    ];
    for (name, limit) in limits {
        let ends = run(&shared, name, &[0.995 * limit, 1.005 * limit], 1000);
        let [below, above] = [0, 1].map(|n| ends[n][0].length_squared() + ends[n][1].length_squared());
        // Below, the ellipse of the invariant is 1 / √(1 − 0.995²) = 10 times longer than wide: 100 in energy, about.
        assert!(below < 1e3, "{name} just below its limit: {below:e}");
        // It may have overflowed by then.
        assert!(above.is_nan() || above > 1e6, "{name} just above its limit: {above:e}");
    }
    // Weakly, but without bound: 1.16¹⁰⁰ is 3e6, and 1.0064²⁰⁰⁰ is 3e5.
    for (name, steps) in [("forward_euler", 100), ("midpoint", 2000), ("heun", 2000)] {
        let [x, v] = run(&shared, name, &[0.4], steps)[0];
        let grown = (x.length_squared() + v.length_squared()) / 2.09;
        assert!(grown > 1e5, "{name}: {grown:e}");
    }
}

/// Dampers without stiffness, far apart along x: u = v₂ − v₁ decays, u′ = −a u with a = 2 c / m. The value of u after a step.
fn decay(shared: &Shared, name: &str, zs: &[f64], steps: u32) -> Vec<f64> {
    let mut particles = State::default();
    for (n, z) in zs.iter().enumerate() {
        let mut pair = at(&[[0.0, n as f64, 0.0], [1024.0, n as f64, 0.0]], MASS);
        pair.velocity_mut().copy_from_slice(&[DVec3::X * -0.5, DVec3::X * 0.5]);
        let damping = z / H * MASS / 2.0;
        pair.links.springs.push(motes::links::Link { damping, ..spring([0, 1], 1000.0, 0.0) });
        particles.append(&pair).expect("one kind");
    }
    let mut simulation = gpu(shared, &setup(&particles, forces(0.0, 0.0), name, H));
    simulation.step(steps).expect("steps");
    let v = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
    (0..zs.len()).map(|n| f64::from(v[2 * n + 1].x) - f64::from(v[2 * n].x)).collect()
}

/// The growth factor of a step.
type Factor<'a> = &'a dyn Fn(f64) -> f64;

/// R(z) of u′ = −a u, and where |R| leaves 1.
#[test]
fn decay_and_its_limits() {
    let shared = support::device();
    let second = |z: f64| 1.0 - z + z * z / 2.0;
    let fourth = |z: f64| second(z) - z.powi(3) / 6.0 + z.powi(4) / 24.0;
    let cases: [(&str, Factor, f64); 5] = [
        ("forward_euler", &|z| 1.0 - z, 2.0),
        ("symplectic_euler", &|z| 1.0 - z, 2.0),
        ("midpoint", &second, 2.0),
        ("heun", &second, 2.0),
        ("rk4", &fourth, 2.785_293_563_405),
    ];
    for (name, r, limit) in cases {
        let zs = [0.1, 1.0, 1.7, 2.0];
        for (z, got) in zs.iter().zip(decay(&shared, name, &zs, 1)) {
            // A few roundings by 6e-8, and the pair moves by 1e-3 of its distance along itself.
            assert!((got - r(*z)).abs() < 1e-6, "{name} at {z}: {got}, not {}", r(*z));
        }
        let ends = decay(&shared, name, &[0.98 * limit, 1.02 * limit], 150);
        assert!(ends[0].abs() < 0.2 && (ends[1].is_nan() || ends[1].abs() > 10.0), "{name} about its limit: {ends:?}");
    }
}
