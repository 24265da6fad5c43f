//! Charges with a reaction field.

use glam::DVec3;
use motes::forces::Component;
use motes::kernel::Array;
use motes::links::Link;
use motes::settings::Value;
use motes::{Bounds, Simulation, State};
use pollster::block_on;

use super::{periodic, setup};
use crate::matter::on_cpu;
use crate::support::Random;
use crate::support::states::{force, one, word};

const RANGE: f64 = 2.5;
const CONSTANT: f64 = 1.5;

/// Molecules of three charges, −0.8 between two of 0.4, anywhere in a periodic box.
fn molecules(number: u32, edge: f64, seed: u64) -> (State, Bounds) {
    let mut random = Random::new(seed);
    let mut state: Option<State> = None;
    let (mut charges, mut bonds) = (Vec::new(), Vec::new());
    for n in 0..number {
        let middle = 0.5 * edge * (random.vector() + 1.0);
        let [one_way, other_way] = [0, 1].map(|_| 0.4 * random.vector().normalize());
        for (x, charge) in [(middle + one_way, 0.4), (middle, -0.8), (middle + other_way, 0.4)] {
            let x = (x * 1024.0).round() / 1024.0;
            match &mut state {
                Some(state) => state.push(x, DVec3::ZERO, 1.0, 0.0),
                None => state = Some(one(x, DVec3::ZERO)),
            }
            charges.push(charge);
        }
        let bond = |ends| Link { ends, rest: 0.4, stiffness: 100.0, damping: 0.0, rope: false };
        bonds.extend([bond([3 * n, 3 * n + 1]), bond([3 * n + 1, 3 * n + 2])]);
    }
    let mut state = state.expect("molecules");
    let forces = [coulomb(0.0, 0.0)];
    state.declare(&forces[0].columns()[0]).expect("a column");
    state.set("charge", Array::Float(charges)).expect("charges");
    state.links.springs = bonds;
    (state, periodic(DVec3::ZERO, DVec3::splat(edge)))
}

fn coulomb(permittivity: f64, exclude: f64) -> Box<dyn Component> {
    let settings = [("range", RANGE), ("coulomb", CONSTANT), ("permittivity", permittivity), ("exclude", exclude)];
    let settings = settings.map(|(key, x)| (key, Value::Number(x)));
    force("coulomb", &[&settings[..], &[("over", word("list"))]].concat())
}

/// Forces and energy by the formulas of Tironi et al. 1995 (their 13 and 15, without ions), with ε_rf of a conductor as the limit: each pair by hand.
fn by_hand(state: &State, bounds: &Bounds, permittivity: f64, exclude: usize) -> (Vec<DVec3>, f64) {
    let (mut forces, mut energy) = (vec![DVec3::ZERO; state.len()], 0.0);
    // C_rf = (2 − 2 ε) / (1 + 2 ε), −1 for a conductor.
    let field = if permittivity > 0.0 { (2.0 - 2.0 * permittivity) / (1.0 + 2.0 * permittivity) } else { -1.0 };
    let charge = state.scalar("charge").expect("charges");
    for i in 0..state.len() {
        for j in 0..i {
            let r = bounds.shortest(state.position()[j] - state.position()[i]);
            let distance = r.length();
            if distance >= RANGE || i / 3 == j / 3 && i - j <= exclude {
                continue;
            }
            let charges = CONSTANT * charge[i] * charge[j];
            energy += charges
                * (1.0 / distance - 0.5 * field * distance.powi(2) / RANGE.powi(3) - (1.0 - 0.5 * field) / RANGE);
            let pull = -charges * (distance.powi(-3) + field / RANGE.powi(3)) * r;
            forces[i] += pull;
            forces[j] -= pull;
        }
    }
    (forces, energy)
}

/// 192 charges, with all pairs and without those of bonds, in a vacuum, in water and in a conductor. On the device a charge is rounded by 3e-8, and of
/// some 60 forces that nearly cancel each by a few times 6e-8.
#[test]
fn charges_have_the_reaction_field() {
    for (seed, permittivity, exclude) in [(1, 0.0, 0), (2, 1.0, 1), (3, 78.5, 2), (4, 78.5, 0)] {
        let (state, bounds) = molecules(64, 9.0, seed);
        let (want, energy) = by_hand(&state, &bounds, permittivity, exclude);
        let size = want.iter().map(|f| f.length()).fold(0.0, f64::max);
        let setup = setup(state, vec![coulomb(permittivity, exclude as f64)], bounds, 1e-3);
        let mut cpu = on_cpu(&setup);
        let gpu = crate::support::machines::gpu(&crate::support::device(), setup.state.len());
        let mut gpu = Simulation::on(gpu, &setup).expect("a simulation");
        cpu.step(0).expect("a start");
        gpu.step(0).expect("a start");
        let total = block_on(cpu.snapshot()).expect("a state").energies().expect("energies").iter().sum::<f64>();
        // Parameters are single precision.
        assert!((total - energy).abs() < 1e-6 * energy.abs(), "{seed}: {total} is not {energy}");
        for got in [
            block_on(cpu.read(motes::ACCELERATION)).expect("accelerations"),
            block_on(gpu.read(motes::ACCELERATION)).expect("accelerations"),
        ] {
            for (i, (got, want)) in got.iter().zip(&want).enumerate() {
                let off = (got.truncate().as_dvec3() - *want).length();
                assert!(off < 1e-5 * size, "{seed}, {i}: {got} is not {want}");
            }
        }
    }
}

/// Energies end at 0 at the range, and in a conductor forces do; with ε = 1 the energy is shifted only.
#[test]
fn the_energy_of_a_pair_ends() {
    let pair = |distance: f64, permittivity: f64| {
        let mut state = one(DVec3::ZERO, DVec3::ZERO);
        state.push(DVec3::X * distance, DVec3::ZERO, 1.0, 0.0);
        let forces = vec![coulomb(permittivity, 0.0)];
        state.declare(&forces[0].columns()[0]).expect("a column");
        state.set("charge", Array::Float(vec![1.0, -2.0])).expect("charges");
        let mut cpu = on_cpu(&setup(state, forces, periodic(DVec3::splat(-9.0), DVec3::splat(9.0)), 1e-3));
        cpu.step(0).expect("a start");
        let pull = block_on(cpu.read(motes::ACCELERATION)).expect("accelerations")[0].x;
        let state = block_on(cpu.snapshot()).expect("a state");
        (f64::from(pull), state.energies().expect("energies").iter().sum::<f64>())
    };
    let near = RANGE - 1e-4;
    for permittivity in [0.0, 1.0, 5.0] {
        // The slope there is at most 2 k / R².
        assert!(pair(near, permittivity).1.abs() < 1e-4, "{permittivity}");
    }
    // Opposite charges attract each other: the first is pulled along x.
    assert!(pair(near, 0.0).0.abs() < 1e-3 && (pair(near, 1.0).0 - 3.0 / RANGE.powi(2)).abs() < 1e-3);
    let (pull, energy) = pair(1.0, 1.0);
    assert!((pull - 3.0).abs() < 1e-6 && (energy + 3.0 * (1.0 - 1.0 / RANGE)).abs() < 1e-6, "{pull} {energy}");
}

#[test]
fn permittivities_below_that_of_a_vacuum_are_refused() {
    let error = coulomb(0.5, 0.0).check(&Bounds::default()).expect_err("refused").to_string();
    assert!(error.contains("permittivity = 0.5: that of a vacuum is 1"), "{error}");
    for exclude in [9.0, 20.0] {
        assert!(coulomb(2.0, exclude).check(&Bounds::default()).is_err());
    }
}
