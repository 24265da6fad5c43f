//! What stays over many steps: lengths and energy.

use crate::support::states::phase;
use glam::{DVec3, DVec4};
use motes::State;

use crate::rods::{G, chain, device, down, forces, pendulum, read, references, stretch};

/// Of double pendulums of masses 1, per pendulum.
fn energies(x: &[DVec4], v: &[DVec4]) -> Vec<f64> {
    let one = |(x, v): (&DVec4, &DVec4)| 0.5 * v.truncate().length_squared() + G * x.z;
    x.chunks(3).zip(v.chunks(3)).map(|(x, v)| x[1..].iter().zip(&v[1..]).map(one).sum()).collect()
}

/// From hardly moving to going over the top.
const SWINGS: [[f64; 2]; 4] = [[10.0, 5.0], [90.0, 90.0], [120.0, -60.0], [175.0, 160.0]];

fn swings() -> State {
    let mut particles = State::default();
    for [a, b] in SWINGS.map(|angles| angles.map(f64::to_radians)) {
        chain(&mut particles, &[DVec3::ZERO, down(a), down(a) + down(b)], [true, false]);
    }
    particles.links.rods.iter_mut().for_each(|rod| rod.length = 1.0);
    particles
}

/// Steps of a long run: 20 000, or as many as `ROD_STEPS` says; with 100 000 of them the same limits hold.
fn steps() -> u32 {
    std::env::var("ROD_STEPS").map_or(20_000, |text| text.parse().expect("a number"))
}

#[test]
fn lengths_hold_over_many_steps_of_a_double_pendulum() {
    let shared = crate::support::device();
    let start = swings();
    let mut simulation = device(&shared, &start, forces(), "leapfrog", 0.002);
    let (x, v) = read(&mut simulation);
    let first = energies(&x, &v);
    for part in 1..=5 {
        simulation.step(steps() / 5).expect("steps");
        let (x, v) = read(&mut simulation);
        // Places up to 2 are held to 6e-8 or 1.2e-7, each of both ends, and lengths are asked for to 1.5e-7.
        assert!(stretch(&start, &x) < 1e-6, "after {part} fifths: {:e}", stretch(&start, &x));
        for (n, (now, then)) in energies(&x, &v).iter().zip(&first).enumerate() {
            // The lowest place of both is 3 g below the origin.
            assert!((now - then).abs() < 3e-3 * 3.0 * G, "{n}, after {part} fifths: {now}, not {then}");
        }
    }
}

#[test]
fn energy_stays_in_bounds_by_the_references() {
    // How far it is off within the first and the last fifth of the way: a drift would make the last one larger.
    let spread = |name: &str| {
        let mut simulation = references(&pendulum(&[90.0, 90.0].map(f64::to_radians)), forces(), name, 0.005);
        let parts: Vec<f64> = (0..5)
            .map(|_| {
                let off = (0..800).map(|_| {
                    simulation.step(5).expect("steps");
                    let (x, v) = phase(&mut simulation);
                    energies(&x, &v)[0].abs()
                });
                off.fold(0.0, f64::max)
            })
            .collect();
        [parts[0], parts[4]]
    };
    for name in ["leapfrog", "pefrl"] {
        let [first, last] = spread(name);
        assert!(first > 1e-6 && first < 0.05 && last < 1.5 * first, "{name}: {first}, then {last}");
    }
    // Which Runge–Kutta methods do not promise.
    let [first, last] = spread("heun");
    assert!(last > 1.5 * first, "heun: {first}, then {last}");
}
