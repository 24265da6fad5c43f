//! LAMMPS' benchmark of a melting crystal (bench/in.lj): 32 000 atoms, from the same positions and velocities.

use glam::DVec3;
use motes::Simulation;
use motes::kernel::Backend;
use motes::{Setup, State};
use pollster::block_on;

use super::{crystal, cut, periodic, setup};

const CELLS: u32 = 20;
const DENSITY: f64 = 0.8442;

fn edge() -> f64 {
    (4.0 / DENSITY).powf(1.0 / 3.0)
}

/// The crystal, with the velocities of `velocity all create 1.44 87287 loop geom`: uniform numbers of a generator (Park & Miller, CACM
/// 31, 1192, 1988) that each atom seeds by a hash of its place (Jenkins' one at a time), without momentum, scaled to the temperature.
fn start() -> State {
    let mut state = crystal(CELLS, edge());
    let count = state.len() as f64;
    let mut velocities: Vec<DVec3> = state.position().iter().map(|x| drawn(87_287, *x)).collect();
    let mean = velocities.iter().sum::<DVec3>() / count;
    velocities.iter_mut().for_each(|v| *v -= mean);
    let twice: f64 = velocities.iter().map(|v| v.length_squared()).sum();
    let factor = (1.44 * (3.0 * count - 3.0) / twice).sqrt();
    state.velocity_mut().iter_mut().zip(velocities).for_each(|(v, drawn)| *v = drawn * factor);
    state
}

fn drawn(seed: i32, place: DVec3) -> DVec3 {
    let mut hash = 0u32;
    let places = place.to_array().map(f64::to_le_bytes);
    for byte in seed.to_le_bytes().iter().chain(places.as_flattened()) {
        // Bytes have a sign there.
        hash = hash.wrapping_add(i32::from(byte.cast_signed()).cast_unsigned());
        hash = hash.wrapping_add(hash << 10);
        hash ^= hash >> 6;
    }
    hash = hash.wrapping_add(hash << 3);
    hash ^= hash >> 11;
    hash = hash.wrapping_add(hash << 15);
    let mut state = u64::from(hash & 0x07ff_ffff).max(1);
    let mut next = || {
        state = state * 16_807 % 2_147_483_647;
        state as f64 / 2_147_483_647.0 - 0.5
    };
    // Five are thrown away.
    let x = (0..6).map(|_| next()).last().unwrap_or_default();
    let y = next();
    DVec3::new(x, y, next())
}

/// The potential energy of an atom, the temperature, and the pressure.
fn measured<B: Backend>(simulation: &mut Simulation<B>) -> [f64; 3] {
    let state = block_on(simulation.snapshot()).expect("a state");
    let count = state.len() as f64;
    let potential: f64 = state.scalar("potential").expect("a column").iter().sum();
    let twice: f64 = state.velocity().iter().map(|v| v.length_squared()).sum();
    let virial = block_on(simulation.virial()).expect("a virial");
    let volume = (f64::from(CELLS) * edge()).powi(3);
    [potential / count, twice / (3.0 * count - 3.0), (twice + virial[..3].iter().sum::<f64>()) / (3.0 * volume)]
}

/// What LAMMPS publishes (bench/log.15Jul25.lj.fixed.g++.1), in f64. At step 0 all but the last digits, that is 32 000 sums of f32, 1e-6.
/// Two runs diverge by exp(λ t) with λ below 10, so that rounding, 1e-7, has become 1e-5 at t = 0.5 for single atoms, and a sum of
/// 32 000 is better; 2e-4 is what changes the temperature in a third of a step (2.3 % in ten steps, at step 80: 0.6 %).
#[test]
fn the_melt_has_the_energies_of_lammps() {
    let bounds = periodic(DVec3::ZERO, DVec3::splat(f64::from(CELLS) * edge()));
    let shared = crate::support::device();
    let setup: Setup = setup(start(), vec![cut(2.5, "cut", "list")], bounds, 0.005);
    let gpu = crate::support::machines::gpu(&shared, setup.state.len());
    let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
    for (steps, potential, temperature, pressure) in
        [(0, -6.773_368_1, 1.44, -5.019_707_3), (100, -5.758_505_5, 0.757_453_1, 0.207_261_05)]
    {
        simulation.step(steps).expect("steps");
        let [is, heat, push] = measured(&mut simulation);
        let allowed = if steps == 0 { 1e-6 } else { 2e-4 };
        assert!((is / potential - 1.0).abs() < allowed, "step {steps}: {is} is not {potential}");
        assert!((heat / temperature - 1.0).abs() < allowed, "step {steps}: {heat} is not {temperature}");
        // As the energy, of steep parts of pairs that cancel by a factor of ten.
        assert!((push - pressure).abs() < 10.0 * allowed, "step {steps}: {push} is not {pressure}");
    }
}
