//! Molecules of which bonded pairs do not interact otherwise.

use glam::DVec3;
use motes::forces::Component;
use motes::links::{Joint, Link};
use motes::settings::Value;
use motes::{Bounds, Setup, Simulation, State};
use pollster::block_on;

use super::{periodic, setup};
use crate::matter::on_cpu;
use crate::support::Random;
use crate::support::states::{force, one, word};

/// A bond far shorter than σ, so that its pair alone would have an energy of 4 (1 / 0.4)¹² = 2.4e5 ε.
const BOND: f64 = 0.4;
const STIFFNESS: f64 = 2000.0;

fn bond(ends: [u32; 2]) -> Link {
    Link { ends, rest: BOND, stiffness: STIFFNESS, damping: 0.0, rope: false }
}

/// Molecules of so many atoms on a cubic lattice, each a zigzag that is turned anyhow.
fn molecules(side: u32, atoms: u32, spacing: f64, seed: u64) -> (State, Bounds) {
    let mut random = Random::new(seed);
    let mut state: Option<State> = None;
    let half = 0.5 * f64::from(side) * spacing;
    for n in 0..side.pow(3) {
        let place = DVec3::new(f64::from(n % side), f64::from(n / side % side), f64::from(n / side / side));
        let (along, other) = (random.vector().normalize(), random.vector());
        let across = along.cross(other).normalize();
        for atom in 0..atoms {
            let from_middle = f64::from(atom) - 0.5 * f64::from(atoms - 1);
            let zigzag = 0.6 * if atom % 2 == 0 { 1.0 } else { -1.0 };
            let way = (0.8 * from_middle * along + 0.5 * zigzag * across) * BOND;
            let x = (place + 0.5) * spacing - DVec3::splat(half) + way;
            let v = random.vector();
            match &mut state {
                Some(state) => state.push(x, v, 1.0, 0.0),
                None => state = Some(one(x, v)),
            }
        }
    }
    let mut state = state.expect("molecules");
    for first in (0..u32::try_from(state.len()).expect("few")).step_by(atoms as usize) {
        state.links.springs.extend((first..first + atoms - 1).map(|i| bond([i, i + 1])));
        state.links.joints.extend((first + 2..first + atoms).map(|i| Joint {
            ids: [i - 2, i - 1, i],
            stiffness: 30.0,
            rest: 0.0,
        }));
    }
    (state, periodic(DVec3::splat(-half), DVec3::splat(half)))
}

fn liquid(exclude: f64, over: &'static str) -> Vec<Box<dyn Component>> {
    let settings = [
        ("range", Value::Number(2.0)),
        ("truncation", word("force_shift")),
        ("over", word(over)),
        ("exclude", Value::Number(exclude)),
    ];
    vec![force("lennard_jones", &settings), force("spring", &[]), force("joint", &[])]
}

/// The sum over all pairs, written anew: U(r) = 4 (r⁻¹² − r⁻⁶) less its value and slope at 2, of pairs more than so many places apart in a molecule.
fn by_hand(state: &State, bounds: &Bounds, atoms: usize, exclude: usize) -> (Vec<DVec3>, f64) {
    let mut forces = vec![DVec3::ZERO; state.len()];
    let mut total = 0.0;
    for (i, j, _, pull, energy) in pairs(state, bounds, atoms, exclude) {
        total += energy;
        forces[i] += pull;
        forces[j] -= pull;
    }
    (forces, total)
}

/// Both atoms, the way from the first to the second, the force on the first, and the energy.
fn pairs<'a>(
    state: &'a State,
    bounds: &'a Bounds,
    atoms: usize,
    exclude: usize,
) -> impl Iterator<Item = (usize, usize, DVec3, DVec3, f64)> + 'a {
    let energy = |r: f64| 4.0 * (r.powi(-12) - r.powi(-6));
    let slope = |r: f64| 4.0 * (-12.0 * r.powi(-13) + 6.0 * r.powi(-7));
    let x = state.position();
    let all = (0..state.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    all.filter_map(move |(i, j)| {
        let r = bounds.shortest(x[j] - x[i]);
        let bonded = i / atoms == j / atoms && i - j <= exclude;
        let pull = (slope(r.length()) - slope(2.0)) / r.length() * r;
        let ended = energy(r.length()) - energy(2.0) - (r.length() - 2.0) * slope(2.0);
        (!bonded && r.length() < 2.0).then_some((i, j, r, pull, ended))
    })
}

/// 1–2, 1–3 and 1–4 pairs of chains of five in a periodic box, in double precision and on the device. Positions up to 6 are rounded by 2.4e-7 there:
/// that is 3.7e-7 of a distance of 0.64, and of a force that falls with its 13th power 5e-6, of two pairs that cancel along three axes 1.7e-5.
#[test]
fn the_forces_of_molecules_lack_their_bonded_pairs() {
    let (state, bounds) = molecules(4, 5, 3.0, 3);
    for (exclude, over) in [(1, "list"), (2, "list"), (3, "auto")] {
        let (want, energy) = by_hand(&state, &bounds, 5, exclude);
        let laws = || vec![liquid(exclude as f64, over).swap_remove(0)];
        let size = want.iter().map(|f| f.length()).fold(0.0, f64::max);
        let alone = setup(state.clone(), laws(), bounds, 1e-3);
        let mut cpu = on_cpu(&alone);
        cpu.step(0).expect("a start");
        let snapshot = block_on(cpu.snapshot()).expect("a state");
        let total: f64 = snapshot.energies().expect("energies").iter().sum();
        assert!((total - energy).abs() < 1e-9 * (1.0 + energy.abs()), "{exclude}: {total} is not {energy}");
        let mut gpu = Simulation::on(crate::support::machines::gpu(&crate::support::device(), state.len()), &alone)
            .expect("a simulation");
        gpu.step(0).expect("a start");
        for got in [
            block_on(gpu.read(motes::ACCELERATION)).expect("accelerations"),
            block_on(cpu.read(motes::ACCELERATION)).expect("accelerations"),
        ] {
            for (i, (got, want)) in got.iter().zip(&want).enumerate() {
                let off = (got.truncate().as_dvec3() - *want).length();
                assert!(off < 1e-4 + 2e-5 * size, "{exclude}, {i}: {got} is not {want}");
            }
        }
    }
    // The virial is the sum of r · F over the same pairs.
    let sum: f64 = pairs(&state, &bounds, 5, 2).map(|(_, _, r, pull, _)| pull.dot(r)).sum();
    let alone = setup(state.clone(), vec![liquid(2.0, "list").swap_remove(0)], bounds, 1e-3);
    let trace = |w: [f64; 6]| w[0] + w[1] + w[2];
    let host = trace(block_on(on_cpu(&alone).virial()).expect("a virial"));
    let mut gpu = Simulation::on(crate::support::machines::gpu(&crate::support::device(), state.len()), &alone)
        .expect("a simulation");
    let device = trace(block_on(gpu.virial()).expect("a virial"));
    assert!((host + sum).abs() < 1e-9 * sum.abs() && (device + sum).abs() < 1e-4 * sum.abs(), "{host} {device} {sum}");
    // With them, bonds would explode: nothing else in this box comes near that.
    let (_, none) = by_hand(&state, &bounds, 5, 0);
    let (_, some) = by_hand(&state, &bounds, 5, 3);
    assert!(none > 1e6 && some.abs() < 1e4, "{none} {some}");
}

/// A liquid of trimers keeps its energy: leapfrog at dt = 0.0005 with ω = √(3 k / m) = 77 at most errs by (ω dt)² / 8 = 2e-4 of the energy of bonds,
/// and steep pairs, of which ω is a few times that, by some 1e-3 of theirs.
#[test]
fn a_liquid_of_molecules_keeps_its_energy() {
    for seed in [1, 2] {
        let (mut state, bounds) = molecules(4, 3, 2.1, seed);
        state.velocity_mut().iter_mut().for_each(|v| *v *= 0.8);
        let setup: Setup = setup(state, liquid(2.0, "list"), bounds, 5e-4);
        let shared = crate::support::device();
        let mut simulation =
            Simulation::on(crate::support::machines::gpu(&shared, setup.state.len()), &setup).expect("a simulation");
        let mut energy = || {
            let state = block_on(simulation.snapshot()).expect("a state");
            let kinetic: f64 = state.velocity().iter().map(|v| 0.5 * v.length_squared()).sum();
            let total: f64 = kinetic + state.energies().expect("energies").iter().sum::<f64>();
            simulation.step(500).expect("steps");
            block_on(simulation.check()).expect("no alarm");
            total
        };
        let all: Vec<f64> = (0..6).map(|_| energy()).collect();
        let (low, high) = all.iter().fold((f64::MAX, f64::MIN), |(a, b), e| (a.min(*e), b.max(*e)));
        let kinetic = 0.5 * 3.0 * 192.0 * 0.64 / 3.0;
        println!("{seed}: {all:?}");
        assert!(high - low < 0.01 * kinetic && low.is_finite(), "{seed}: {all:?}");
    }
}
