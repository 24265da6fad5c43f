//! A many-body law in two passes: the embedded-atom potential of Sutton & Chen (Phil. Mag. Lett. 61, 139, 1990) for copper, as the two laws in WGSL of
//! `examples/own_metal`, against sums in f64. Units are eV, Å and atomic mass units.

use std::path::Path;

use glam::DVec3;
use motes::forces::{Component, Custom, Over};
use motes::kernel::{Column, Kind};
use motes::settings::Value;
use motes::{Gpu, Setup, Simulation, State};
use pollster::block_on;

use super::{crystal, periodic, setup};
use crate::support::states::force;

/// ε, a and c of copper with n = 9 and m = 6.
const EPSILON: f64 = 1.2382e-2;
const SPACING: f64 = 3.61;
const C: f64 = 39.432;
const N: f64 = 9.0;
const M: f64 = 6.0;
/// Both sums are smoothed to 0 from the onset to the range.
const ONSET: f64 = 6.0;
const RANGE: f64 = 7.2;
const MASS: f64 = 63.546;
const CELLS: u32 = 5;
const LIST: Over = Over::List { range: RANGE, skin: Some(0.8), slots: 0 };
const NEAR: Over = Over::Near { range: RANGE, of: None };
const DENSITY: &str = "electron_density";

/// The two laws of the example.
fn laws(over: Over) -> Vec<Box<dyn Component>> {
    let text = |file: &str| {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/own_metal");
        std::fs::read_to_string(folder.join(file)).expect("a law")
    };
    let all = [("epsilon", EPSILON), ("spacing", SPACING), ("c", C), ("range", RANGE), ("onset", ONSET)];
    let params = |names: &[&str]| {
        let chosen = all.iter().filter(|(name, _)| names.contains(name));
        chosen.map(|(name, x)| ((*name).to_owned(), Value::Number(*x))).collect::<Vec<_>>()
    };
    let density = Custom {
        params: params(&["spacing", "range", "onset"]),
        into: vec![DENSITY.into()],
        ..Custom::new("density", "density.wgsl", &text("density.wgsl"), over)
    };
    let embedding = Custom {
        params: params(&["epsilon", "spacing", "c", "range", "onset"]),
        ..Custom::new("embedding", "embedding.wgsl", &text("embedding.wgsl"), over)
    };
    vec![Box::new(density), Box::new(embedding)]
}

/// Copper in a cube, under the two laws and others.
fn copper(mut state: State, edge: f64, over: Over, others: Vec<Box<dyn Component>>, dt: f64) -> Setup {
    state.mass_mut().fill(MASS);
    state.declare(&Column::new(DENSITY, Kind::Scalar, "", "the density of electrons").derived()).expect("a column");
    let forces = laws(over).into_iter().chain(others).collect();
    setup(state, forces, periodic(DVec3::ZERO, DVec3::splat(f64::from(CELLS) * edge)), dt)
}

/// A crystal with atoms that are moved at random, to places and in a box that single precision holds exactly.
fn disordered(seed: u64) -> (State, f64) {
    let edge = 3.609_375;
    let mut random = crate::support::Random::new(seed);
    let (mut state, side) = (crystal(CELLS, edge), DVec3::splat(f64::from(CELLS) * edge));
    let grid = |x: DVec3| (x * 1024.0).round() / 1024.0;
    state.position_mut().iter_mut().for_each(|x| *x = grid((*x + 0.25 * random.vector()).rem_euclid(side)));
    (state, edge)
}

fn on_gpu(setup: &Setup, shared: &crate::support::Shared) -> Simulation<Gpu> {
    Simulation::on(crate::support::machines::gpu(shared, setup.state.len()), setup).expect("a simulation")
}

/// Energy, forces, densities and virial of a state, and the sizes of the forces of pairs on an atom.
struct Sums {
    energy: f64,
    forces: Vec<DVec3>,
    densities: Vec<f64>,
    virial: [f64; 6],
    sizes: Vec<f64>,
}

/// (a / r)ᵏ and its slope, smoothed: S = (R² − r²)² (R² + 2 r² − 3 o²) / (R² − o²)³ beyond the onset o.
fn smoothed(k: f64, r: f64) -> [f64; 2] {
    let value = (SPACING / r).powf(k);
    let slope = -k * value / r;
    if r <= ONSET || r >= RANGE {
        return if r < RANGE { [value, slope] } else { [0.0; 2] };
    }
    let (range, onset, square) = (RANGE * RANGE, ONSET * ONSET, r * r);
    let width = (range - onset).powi(3);
    let part = (range - square).powi(2) * (range + 2.0 * square - 3.0 * onset) / width;
    let change = -12.0 * r * (range - square) * (square - onset) / width;
    [part * value, part * slope + change * value]
}

/// The same sums on a host, in f64, in a box with these sides.
fn sums(places: &[DVec3], sides: DVec3) -> Sums {
    let mut pairs = Vec::new();
    let mut densities = vec![0.0; places.len()];
    let mut energy = 0.0;
    for (i, a) in places.iter().enumerate() {
        for (j, b) in places.iter().enumerate().take(i) {
            let r = (*b - *a) - sides * ((*b - *a) / sides).round();
            if r.length_squared() < RANGE * RANGE {
                let [density, slope] = smoothed(M, r.length());
                let [repulsion, push] = smoothed(N, r.length());
                densities[i] += density;
                densities[j] += density;
                energy += EPSILON * repulsion;
                pairs.push((i, j, r, push, slope));
            }
        }
    }
    energy -= EPSILON * C * densities.iter().map(|density| density.sqrt()).sum::<f64>();
    let (mut forces, mut sizes) = (vec![DVec3::ZERO; places.len()], vec![0.0; places.len()]);
    let mut virial = [0.0; 6];
    for (i, j, r, push, slope) in pairs {
        let embedding = 0.5 * C * (densities[i].sqrt().recip() + densities[j].sqrt().recip());
        let f = EPSILON * (push - embedding * slope) * r / r.length();
        forces[i] += f;
        forces[j] -= f;
        [i, j].into_iter().for_each(|one| sizes[one] += EPSILON * (push.abs() + embedding * slope.abs()));
        let parts = [r.x * f.x, r.y * f.y, r.z * f.z, r.y * f.z, r.x * f.z, r.x * f.y];
        virial.iter_mut().zip(parts).for_each(|(sum, part)| *sum -= part);
    }
    Sums { energy, forces, densities, virial, sizes }
}

/// Of a function its slope, by differences over h and 2 h, with an error of h⁴.
fn slope(h: f64, of: impl Fn(f64) -> f64) -> f64 {
    (8.0 * (of(h) - of(-h)) - (of(2.0 * h) - of(-2.0 * h))) / (12.0 * h)
}

/// The sums in f64 are of one energy: forces and virial are its slopes. In steps of 2e-3 Å differences of r⁻⁹ at 2.2 Å are wrong by 1e-9 of it;
/// where S'' jumps, by 4 / Å², they are wrong by ε c φ / 2 √ρ · 4 h / 4 = 2e-6 eV / Å for each pair there, of which each atom has two or three.
#[test]
fn forces_and_virial_are_slopes_of_the_energy() {
    for seed in [1, 2] {
        let (state, edge) = disordered(seed);
        let sides = DVec3::splat(f64::from(CELLS) * edge);
        let places = state.position().to_vec();
        let all = sums(&places, sides);
        for atom in [0, 137, 321] {
            let axis = atom % 3;
            let moved = |way: f64| {
                let mut places = places.clone();
                places[atom][axis] += way;
                sums(&places, sides).energy
            };
            let (got, want) = (all.forces[atom][axis], -slope(2e-3, moved));
            assert!((got - want).abs() < 1e-5, "seed {seed}, atom {atom}: {got} is not {want}");
        }
        for axis in 0..3 {
            let strained = |strain: f64| {
                let mut factor = DVec3::ONE;
                factor[axis] += strain;
                sums(&places.iter().map(|x| *x * factor).collect::<Vec<_>>(), sides * factor).energy
            };
            let (got, want) = (all.virial[axis], -slope(5e-4, strained));
            // Of 500 atoms with some pairs each, at 7 Å.
            assert!((got - want).abs() < 1e-5 * 500.0, "seed {seed}, axis {axis}: {got} is not {want}");
        }
    }
}

/// What the device computes of disordered states, over both visits: densities, forces, energy and virial as in f64. A power of nine has some ten
/// roundings of 6e-8, so that 1e-6 of the sizes of what is added is allowed, and for the energy and the virial, in which errors of 500 atoms
/// cancel, as much of the sums. Forces of a pair are opposite, so that the momentum changes by the rounding of sums alone.
#[test]
fn two_passes_have_the_sums_of_the_potential() {
    for seed in [1, 2, 3] {
        let (state, edge) = disordered(seed);
        let side = f64::from(CELLS) * edge;
        let want = sums(state.position(), DVec3::splat(side));
        let mut got = Vec::new();
        for over in [LIST, NEAR] {
            let setup = copper(state.clone(), edge, over, Vec::new(), 0.1);
            let shared = crate::support::device();
            let mut simulation = on_gpu(&setup, &shared);
            let state = block_on(simulation.snapshot_of(&[DENSITY, "acceleration"])).expect("a state");
            let densities = state.scalar(DENSITY).expect("densities");
            for (got, want) in densities.iter().zip(&want.densities) {
                assert!((got / want - 1.0).abs() < 1e-6, "{over:?}: {got} is not {want}");
            }
            let forces: Vec<DVec3> = state.vector("acceleration").expect("them").iter().map(|a| MASS * *a).collect();
            let mut most = 0f64;
            for (atom, (got, size)) in forces.iter().zip(&want.sizes).enumerate() {
                let off = (*got - want.forces[atom]).length();
                most = most.max(off / size);
                assert!(off < 1e-6 * size, "{over:?}, atom {atom}: {got} is off by {off} of {size}");
            }
            let size: f64 = want.sizes.iter().sum();
            let push = forces.iter().sum::<DVec3>().length();
            // 500 sums, each wrong by some 6e-8 of its size, to all sides.
            assert!(push < 1e-7 * size / 500f64.sqrt(), "{over:?}: {push} of {size}");
            println!("{over:?}: forces {most:e}, momentum {:e}", push / size * 500f64.sqrt());
            let energy: f64 = state.energies().expect("energies").iter().sum();
            assert!((energy / want.energy - 1.0).abs() < 1e-6, "{over:?}: {energy} is not {}", want.energy);
            let virial = block_on(simulation.virial()).expect("a virial");
            for (got, want) in virial.iter().zip(want.virial) {
                assert!((got - want).abs() < 1e-6 * size * 2.5, "{over:?}: {got} is not {want}");
            }
            got.push(forces);
        }
        let apart = got[0].iter().zip(&got[1]).zip(&want.sizes).map(|((a, b), size)| (*a - *b).length() / size);
        // Some roundings of sums in another order.
        let apart = apart.fold(0.0, f64::max);
        assert!(apart < 1e-6, "list and near differ by {apart}");
    }
}

/// Energy of an atom of a face-centred cubic crystal: by pairs up to the range, or by all up to 16 edges, with the integral beyond.
fn cohesion(edge: f64, whole: bool) -> f64 {
    let far = if whole { 16.01 * edge } else { RANGE };
    let cells = (far / edge).ceil() as i32 + 1;
    let (mut density, mut repulsion) = (0.0, 0.0);
    for k in -cells..=cells {
        for j in -cells..=cells {
            for i in -cells..=cells {
                for b in [[0.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]] {
                    let r = (edge * (DVec3::new(f64::from(i), f64::from(j), f64::from(k)) + DVec3::from(b))).length();
                    if r > 0.0 && r < far {
                        let part = |k: f64| if whole { (SPACING / r).powf(k) } else { smoothed(k, r)[0] };
                        density += part(M);
                        repulsion += part(N);
                    }
                }
            }
        }
    }
    // 4 / a³ atoms in a volume: ∫ (a / r)ᵏ 4 π r² dr.
    let beyond = |k: f64| 16.0 * std::f64::consts::PI / edge.powi(3) * SPACING.powf(k) * far.powf(3.0 - k) / (k - 3.0);
    if whole {
        density += beyond(M);
        repulsion += beyond(N);
    }
    EPSILON * (0.5 * repulsion - C * density.sqrt())
}

/// p = −dE / dΩ and B = Ω d²E / dΩ², of Ω = a³ / 4.
fn pressure(edge: f64, whole: bool) -> f64 {
    -slope(1e-3, |h| cohesion(edge + h, whole)) / (0.75 * edge * edge)
}
fn bulk_modulus(edge: f64, whole: bool) -> f64 {
    -edge / 3.0 * slope(2e-3, |h| pressure(edge + h, whole))
}

/// What was published of copper, by sums over all of a crystal: E_c = 3.49 eV (ε and c give 3.500), a = 3.61 Å, to the digits of c, and
/// B Ω = n m E_c / 18: with E = X (λ⁻ⁿ / n − 2 λ^(−m/2) / m), 9 B Ω = d²E / dλ² = X (n − m / 2) and E_c = X (2 n − m) / n m. That is 143 GPa, as B of
/// copper (142) was to be.
#[test]
fn the_potential_is_that_of_copper() {
    let energy = cohesion(SPACING, true);
    assert!((energy + 3.49).abs() < 0.011, "{energy}");
    let modulus = bulk_modulus(SPACING, true);
    let volume = SPACING.powi(3) / 4.0;
    // c = n Σ (a / r)ⁿ / m √Σ (a / r)ᵐ = 39.4311 by sums of more digits, 2.2e-5 less than published: p Ω = 2.2e-5 X / 3, which with
    // B Ω = 2 X / 3 moves a by a sixth of that, 1.3e-5 Å.
    let rest = SPACING * (1.0 + pressure(SPACING, true) / (3.0 * modulus));
    assert!((rest - 3.61).abs() < 2e-5, "{rest}");
    let want = -N * M * energy / 18.0;
    // An integral stands for what is beyond 16 edges: some 1e-5. The pressure that is left takes part.
    assert!((modulus * volume / want - 1.0).abs() < 1e-4, "{} is not {want}", modulus * volume);
    assert!((160.217_66 * modulus - 142.0).abs() < 2.0, "{modulus}");
}

/// Energy of an atom and pressure of a crystal at rest on the device.
fn at_rest(edge: f64, over: Over) -> [f64; 2] {
    let setup = copper(crystal(CELLS, edge), edge, over, Vec::new(), 0.1);
    let shared = crate::support::device();
    let mut simulation = on_gpu(&setup, &shared);
    let energies = block_on(simulation.snapshot()).expect("a state").energies().expect("energies");
    let virial = block_on(simulation.virial()).expect("a virial");
    let volume = (f64::from(CELLS) * edge).powi(3);
    [energies.iter().sum::<f64>() / energies.len() as f64, virial[..3].iter().sum::<f64>() / (3.0 * volume)]
}

/// The crystal on the device: its energy, pressure and bulk modulus are those of sums up to the range, from which those of the whole potential differ
/// by what the range leaves out: 0.063 eV, 0.24 GPa, and 0.4 % of B.
#[test]
fn a_crystal_of_copper_has_its_energy_pressure_and_bulk_modulus() {
    for over in [LIST, NEAR] {
        let [energy, push] = at_rest(SPACING, over);
        let want = cohesion(SPACING, false);
        // A sum of 134 terms, and a root: some roundings.
        assert!((energy / want - 1.0).abs() < 1e-6, "{over:?}: {energy} is not {want}");
        // 1e-6 of the sizes of r F, some 6 E_c for an atom of 11.8 Å³.
        let want = pressure(SPACING, false);
        let beyond = [cohesion(SPACING, true) - energy, pressure(SPACING, true) - want];
        println!("{over:?}: {energy} {push} {want}, beyond the range {beyond:?}");
        assert!((push - want).abs() < 2e-6, "{over:?}: {push} is not {want}");
        let edges = [SPACING * 0.99, SPACING * 1.01];
        let [below, above] = edges.map(|edge| at_rest(edge, over)[1]);
        let difference = below - above;
        let want = pressure(edges[0], false) - pressure(edges[1], false);
        assert!((difference - want).abs() < 4e-6, "{over:?}: {difference} is not {want}");
        let modulus = difference / (3.0 * 0.02);
        let known = N * M * 3.49 / 18.0 / (0.25 * SPACING.powi(3));
        println!("B {modulus}, published {known}");
        assert!((modulus / known - 1.0).abs() < 0.01, "{over:?}: {modulus} is not {known}");
    }
}

/// A crystal with velocities at a temperature, without momentum.
fn warm(seed: u64, temperature: f64) -> State {
    let mut random = crate::support::Random::new(seed);
    let mut state = crystal(CELLS, SPACING);
    let mut drawn: Vec<DVec3> = (0..state.len()).map(|_| (0..6).map(|_| random.vector()).sum()).collect();
    let mean = drawn.iter().sum::<DVec3>() / drawn.len() as f64;
    drawn.iter_mut().for_each(|v| *v -= mean);
    let twice: f64 = drawn.iter().map(|v| MASS * v.length_squared()).sum();
    let factor = (temperature * freedom(&state) / twice).sqrt();
    state.velocity_mut().iter_mut().zip(drawn).for_each(|(v, drawn)| *v = factor * drawn);
    state
}

fn freedom(state: &State) -> f64 {
    3.0 * state.len() as f64 - 3.0
}

fn kinetic(state: &State) -> f64 {
    0.5 * MASS * state.velocity().iter().map(|v| v.length_squared()).sum::<f64>()
}

/// Total energies at equal times.
fn totals(seed: u64, dt: f64, steps: u32) -> Vec<f64> {
    let setup = copper(warm(seed, 0.1), SPACING, LIST, Vec::new(), dt);
    let shared = crate::support::device();
    let mut simulation = on_gpu(&setup, &shared);
    let total = |_| {
        simulation.step(steps).expect("steps");
        let state = block_on(simulation.snapshot()).expect("a state");
        kinetic(&state) + state.energies().expect("energies").iter().sum::<f64>()
    };
    (0..60).map(total).collect()
}

/// By leapfrog the energy swings by a part of dt², and does not drift: the densities that the forces read are those of the same positions.
#[test]
fn the_energy_of_a_metal_is_conserved_to_second_order() {
    for seed in [1, 2] {
        let swing = |all: &[f64]| {
            let mean = all.iter().sum::<f64>() / all.len() as f64;
            let square = all.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / all.len() as f64;
            let late = 2.0 * (all[all.len() / 2..].iter().sum::<f64>() / all.len() as f64) - mean;
            [square.sqrt(), late.abs()]
        };
        // After the first swing, in which half of the kinetic energy goes into displacements.
        let [[coarse, drift], [fine, _]] =
            [(0.8, 3), (0.4, 6)].map(|(dt, steps)| swing(&totals(seed, dt, steps)[10..]));
        println!("seed {seed}: {coarse} {fine} {drift}");
        let order = (coarse / fine).log2();
        assert!((order - 2.0).abs() < 0.3, "seed {seed}: order {order}, {coarse} {fine}");
        assert!(drift < coarse, "seed {seed}: {drift} of {coarse}");
    }
}

/// In each stage of a Runge–Kutta method the forces read the densities of its places: RK4 takes (ω dt)⁶ / 72 of the energy of a mode in a step, at most 7e-7
/// for the 7.5 THz of copper, so that 100 steps take less than 0.005 eV of 75; forces by densities of the stage before are wrong in the first order.
#[test]
fn every_stage_reads_the_densities_of_its_places() {
    for seed in [1, 2] {
        let setup = copper(warm(seed, 0.1), SPACING, LIST, Vec::new(), 0.4);
        let setup = Setup { integrator: crate::support::states::integrator("rk4"), ..setup };
        let shared = crate::support::device();
        let mut simulation = on_gpu(&setup, &shared);
        let total = |steps: u32| {
            simulation.step(steps).expect("steps");
            let state = block_on(simulation.snapshot()).expect("a state");
            kinetic(&state) + state.energies().expect("energies").iter().sum::<f64>()
        };
        let [before, after] = [0, 100].map(total);
        println!("seed {seed}: {before} {after}");
        // Rounding to 1e-7 of 3.4 eV, of 500 atoms.
        assert!((after - before).abs() < 0.005 + 1e-4, "seed {seed}: {before} {after}");
    }
}

/// Thermostats hold the temperature of a metal: k T of 600 K, from a crystal that begins with half of what it needs.
#[test]
#[ignore = "minutes on a software adapter: `tests/run --test physics --test commands -- --include-ignored` runs it"]
fn thermostats_hold_a_metal_at_its_temperature() {
    let kt = 0.0517;
    for seed in [1, 2] {
        let number = Value::Number;
        let all = [
            ("langevin", vec![("friction", number(0.05))]),
            ("csvr", vec![("time", number(10.0)), ("drift", Value::Flag(false))]),
        ];
        for (name, more) in all {
            let common = [("temperature", number(kt)), ("seed", number(seed as f64))];
            let bath = force(name, &[&common[..], &more].concat());
            let setup = copper(warm(seed, kt), SPACING, LIST, vec![bath], 0.4);
            let shared = crate::support::device();
            let mut simulation = on_gpu(&setup, &shared);
            simulation.step(300).expect("steps");
            let mut mean = 0.0;
            for _ in 0..40 {
                simulation.step(20).expect("steps");
                let state = block_on(simulation.snapshot()).expect("a state");
                let freedom = if name == "csvr" { freedom(&state) } else { freedom(&state) + 3.0 };
                mean += 2.0 * kinetic(&state) / freedom / kt / 40.0;
            }
            println!("{name}, seed {seed}: {mean}");
            // √(2 / 1500) = 3.7 % of a sample, of which 40 are 8 apart, and remember each other for 10: as 20 that do not. And leapfrog's
            // velocities are too slow by (ω dt)² / 8, 0.4 % at the fastest mode of copper.
            assert!((mean - 1.0).abs() < 4.0 * 0.037 / 20f64.sqrt(), "{name}, seed {seed}: {mean}");
        }
    }
}

/// LAMMPS (22 July 2025, `eam/alloy`, the functions in tables of 40 000 rows) from two disordered states at rest: potential energy, kinetic energy and pressure at
/// the start and after 100 steps of 3 fs. In so short a time rounding, 1e-6 of forces of 1 eV / Å, grows to some 1e-5.
#[test]
fn a_metal_moves_as_in_lammps() {
    let known = [
        (1, 0, [-1_601.860_253_7, 0.0, 0.098_810_569]),
        (1, 100, [-1_663.926_052_3, 61.687_053_8, 0.055_183_060]),
        (2, 0, [-1_597.893_100_5, 0.0, 0.102_517_194]),
        (2, 100, [-1_660.173_894_4, 61.895_670_1, 0.058_549_030]),
    ];
    for (seed, steps, want) in known {
        let (state, edge) = disordered(seed);
        let setup = copper(state, edge, LIST, Vec::new(), 0.3);
        let shared = crate::support::device();
        let mut simulation = on_gpu(&setup, &shared);
        simulation.step(steps).expect("steps");
        let state = block_on(simulation.snapshot()).expect("a state");
        let virial = block_on(simulation.virial()).expect("a virial");
        let volume = (f64::from(CELLS) * edge).powi(3);
        let push = (2.0 * kinetic(&state) + virial[..3].iter().sum::<f64>()) / (3.0 * volume);
        let got = [state.energies().expect("energies").iter().sum(), kinetic(&state), push];
        let part = if steps == 0 { 1e-6 } else { 1e-5 };
        let off = [0, 1, 2].map(|n| (got[n] - want[n]).abs() / [1600.0, 60.0, 0.2][n]);
        println!("seed {seed}, step {steps}: {off:?}");
        assert!(off.iter().all(|off| *off < part), "seed {seed}, step {steps}: {got:?} is not {want:?}");
    }
}
