//! Thermostats: the distributions of kinetic energies and velocities, what is conserved, and lockstep.

use std::f64::consts::TAU;

use glam::DVec3;
use motes::forces::Component;
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::{Bounds, Simulation, State};
use pollster::block_on;

use super::setup;
use crate::matter::{agrees, on_cpu, spread};
use crate::support::states::force;

const KT: f64 = 0.7;

/// This thermostat, with its rate per time.
fn bath(name: &'static str, rate: f64, seed: f64) -> Box<dyn Component> {
    let number = Value::Number;
    let more = match name {
        "langevin" => vec![("friction", number(rate)), ("seed", number(seed))],
        "andersen" => vec![("rate", number(rate)), ("seed", number(seed))],
        "csvr" => vec![("time", number(1.0 / rate)), ("seed", number(seed)), ("drift", Value::Flag(rate < 20.0))],
        _ => vec![("time", number(1.0 / rate))],
    };
    force(name, &[&[("temperature", number(KT))], &more[..]].concat())
}

/// Free particles of several masses, with velocities by a seed.
fn gas(count: usize, seed: u64) -> State {
    let mut random = crate::support::Random::new(seed);
    let mut state = State::default();
    for i in 0..count {
        state.push(DVec3::X * i as f64, random.vector(), [1.0, 0.5, 3.0][i % 3], 0.0);
    }
    state
}

fn twice(state: &State) -> f64 {
    state.velocity().iter().zip(state.mass()).map(|(v, m)| m * v.length_squared()).sum()
}

/// A run that goes on from its own state has the bits of one that was never stopped; two seeds have not.
#[test]
fn thermostats_go_on_with_the_same_bits() {
    for name in ["langevin", "andersen", "berendsen", "csvr", "nose_hoover"] {
        let forces = |seed| match name {
            "nose_hoover" => vec![
                force("soft", &[("range", Value::Number(1.5))]),
                force(name, &[("temperature", Value::Number(KT))]),
            ],
            _ => vec![force("soft", &[("range", Value::Number(1.5))]), bath(name, 5.0, seed)],
        };
        let run = |state: State, steps: u32, seed: f64| {
            let mut simulation = on_cpu(&setup(state, forces(seed), Bounds::default(), 0.01));
            simulation.step(steps).expect("steps");
            block_on(simulation.snapshot()).expect("a state")
        };
        let start = || spread(20, 0.9);
        let (whole, other) = (run(start(), 20, 1.0), run(start(), 20, 2.0));
        let parts = run(run(start(), 10, 1.0), 10, 1.0);
        assert!(whole == parts, "{name}: a state does not hold all of it");
        let random = !["berendsen", "nose_hoover"].contains(&name);
        assert_eq!(whole.velocity() != other.velocity(), random, "{name}");
    }
}

/// The largest difference between how samples are distributed and how they should be, times √n: above 1.95 with a probability of 1e-3
/// (Kolmogorov 1933).
pub(super) fn distance(mut samples: Vec<f64>, cumulative: impl Fn(f64) -> f64) -> f64 {
    samples.sort_by(f64::total_cmp);
    let count = samples.len() as f64;
    let off = |(place, x): (usize, &f64)| {
        let (known, place) = (cumulative(*x), place as f64);
        (known - place / count).abs().max((known - (place + 1.0) / count).abs())
    };
    count.sqrt() * samples.iter().enumerate().map(off).fold(0.0, f64::max)
}

/// Of a sum of 2 n squares of normal numbers, half of it below x: 1 − exp(−x) Σ xᵏ / k!, k < n.
pub(super) fn erlang(n: u32, x: f64) -> f64 {
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 1..n {
        term *= x / f64::from(k);
        sum += term;
    }
    1.0 - (-x).exp() * sum
}

/// The normal distribution function, by Simpson's rule.
fn normal(x: f64) -> f64 {
    let steps = 200;
    let h = x / f64::from(steps);
    let density = |k: i32| (-0.5 * (h * f64::from(k)).powi(2)).exp();
    let sum: f64 = (0..steps).step_by(2).map(|k| density(k) + 4.0 * density(k + 1) + density(k + 2)).sum();
    0.5 + sum * h / 3.0 / TAU.sqrt()
}

/// Kinetic energies of 10 free particles, and a velocity in units of √(k T / m), each 5 relaxation times after the one before.
fn sampled(name: &'static str, seed: u64) -> [Vec<f64>; 2] {
    let dt = 0.1;
    let start = setup(gas(10, seed), vec![bath(name, 2.5, seed as f64)], Bounds::default(), dt);
    let mut simulation = on_cpu(&start);
    let [mut energies, mut velocities] = [Vec::new(), Vec::new()];
    for _ in 0..400 {
        simulation.step(20).expect("steps");
        let state = block_on(simulation.snapshot()).expect("a state");
        energies.push(0.5 * twice(&state) / KT);
        velocities.push(state.velocity()[2].y * (3.0 / KT).sqrt());
    }
    [energies, velocities]
}

/// The kinetic energy of N degrees of freedom has the gamma distribution of shape N / 2 (three seeds, so that 1.95 is passed once in 150 runs
/// of the test if seeds were drawn anew). That of Berendsen's thermostat is always the same, as it says.
#[test]
fn kinetic_energies_are_canonical_or_said_not_to_be() {
    for name in ["langevin", "andersen", "csvr"] {
        for seed in [1, 2, 3] {
            let [energies, velocities] = sampled(name, seed);
            let mean = energies.iter().sum::<f64>() / 400.0;
            // √(15 / 400) = 0.19
            assert!((mean - 15.0).abs() < 4.0 * 0.19, "{name}, seed {seed}: {mean}");
            let off = distance(energies, |x| erlang(15, x));
            assert!(off < 1.95, "{name}, seed {seed}: {off}");
            // One factor for all velocities turns none of them.
            if name == "csvr" {
                continue;
            }
            let off = distance(velocities, normal);
            assert!(off < 1.95, "{name}, seed {seed}: {off} of velocities");
        }
    }
    let [energies, _] = sampled("berendsen", 1);
    let off = distance(energies[3..].to_vec(), |x| erlang(15, x));
    assert!(off > 5.0, "{off}");
}

/// Exactly T₀ + (T − T₀) exp(−t / τ), whatever the step; and what it gives is what particles get.
#[test]
fn berendsen_relaxes_exponentially_and_counts_its_heat() {
    for dt in [0.5, 0.05] {
        let state = gas(10, 5);
        let before = twice(&state);
        let mut simulation = on_cpu(&setup(state, vec![bath("berendsen", 1.0, 1.0)], Bounds::default(), dt));
        simulation.step((1.0 / dt).round() as u32).expect("steps");
        let state = block_on(simulation.snapshot()).expect("a state");
        let want = 30.0 * KT + (before - 30.0 * KT) * (-1f64).exp();
        assert!((twice(&state) / want - 1.0).abs() < 1e-12, "{} is not {want}", twice(&state));
        let heat = state.scalar("thermostat_heat").expect("a column")[0];
        assert!((heat - 0.5 * (twice(&state) - before)).abs() < 1e-12 * before, "{heat}");
        assert!(heat.abs() > 0.1, "{heat}");
    }
}

/// A free particle keeps exp(−γ t) of its mean velocity, and comes to x² = 2 d k T / m γ (t − (1 − exp(−γ t)) / γ) (Langevin 1908), here from
/// the Maxwell distribution; and an oscillator has ⟨x²⟩ = k T / k (1 − ω² dt² / 4).
#[test]
fn langevin_diffuses_and_an_oscillator_has_its_width() {
    let count = 4000;
    let mut state = State::default();
    let mut random = crate::support::Random::new(9);
    let mut maxwell = || (0..12).map(|_| random.vector()).sum::<DVec3>() * (KT / 4.0 / 2.0).sqrt();
    (0..count).for_each(|_| state.push(DVec3::ZERO, maxwell(), 2.0, 0.0));
    let squares: f64 = state.velocity().iter().map(|v| v.length_squared()).sum::<f64>() / f64::from(count);
    let dt = 0.05;
    let mut simulation = on_cpu(&setup(state.clone(), vec![bath("langevin", 1.5, 11.0)], Bounds::default(), dt));
    simulation.step(40).expect("steps");
    let end = block_on(simulation.snapshot()).expect("a state");
    let square = end.position().iter().map(|x| x.length_squared()).sum::<f64>() / f64::from(count);
    let (gamma, t) = (1.5, 40.0 * dt);
    let lost = 1.0 - f64::exp(-gamma * t);
    // The first velocities have the mean square that they have.
    let want = 6.0 * KT / 2.0 / gamma * (t - lost / gamma) + (squares - 3.0 * KT / 2.0) * (lost / gamma).powi(2);
    // 12 000 squares of normal numbers: √(2 / 12 000) = 1.3 %; and a step of x by v is wrong by (γ dt)² / 12 = 5e-4.
    assert!((square / want - 1.0).abs() < 4.0 * 0.013, "{square} is not {want}");

    let spring = force(
        "attractor",
        &[
            ("profile", crate::support::states::word("harmonic")),
            ("strength", Value::Number(4.0)),
            ("softening", Value::Number(0.0)),
        ],
    );
    let dt = 0.6;
    state.mass_mut().fill(1.0);
    let mut simulation = on_cpu(&setup(state, vec![spring, bath("langevin", 1.5, 12.0)], Bounds::default(), dt));
    let mut squares = Vec::new();
    simulation.step(30).expect("steps");
    for _ in 0..5 {
        simulation.step(10).expect("steps");
        let end = block_on(simulation.snapshot()).expect("a state");
        squares.push(end.position().iter().map(|x| x.length_squared()).sum::<f64>() / f64::from(count) / 3.0);
    }
    // ω² = 4, so that ω² dt² / 4 = 0.36: half as wide again as without the step. 60 000 squares: √(2 / 60 000) = 0.6 %.
    let mean = squares.iter().sum::<f64>() / 5.0;
    let want = KT / 4.0 / (1.0 - 0.36);
    assert!((mean / want - 1.0).abs() < 4.0 * 0.006, "{mean} is not {want}");
}

/// With forces K + U less the heat is conserved as K + U is without a thermostat; without momentum there are three degrees of freedom less.
#[test]
fn csvr_counts_its_heat_and_its_degrees_of_freedom() {
    let (side, dt) = (3.0, 0.002);
    let mut state = super::crystal(2, 0.5 * side);
    let mut random = crate::support::Random::new(5);
    let drawn: Vec<DVec3> = (0..state.len()).map(|_| random.vector()).collect();
    let mean = drawn.iter().sum::<DVec3>() / state.len() as f64;
    state.velocity_mut().iter_mut().zip(drawn).for_each(|(v, drawn)| *v = drawn - mean);
    let soft = force(
        "soft",
        &[
            ("strength", Value::Number(40.0)),
            ("range", Value::Number(1.2)),
            ("over", crate::support::states::word("within")),
        ],
    );
    let bath = force(
        "csvr",
        &[("temperature", Value::Number(KT)), ("time", Value::Number(0.05)), ("drift", Value::Flag(false))],
    );
    let bounds = super::periodic(DVec3::ZERO, DVec3::splat(side));
    let mut simulation = on_cpu(&setup(state, vec![soft, bath], bounds, dt));
    let mut all = Vec::new();
    let mut heats = Vec::new();
    for _ in 0..300 {
        simulation.step(25).expect("steps");
        let state = block_on(simulation.snapshot()).expect("a state");
        let potential: f64 = state.energies().expect("energies").iter().sum();
        let heat = state.scalar("thermostat_heat").expect("a column")[0];
        all.push([0.5 * twice(&state), 0.5 * twice(&state) + potential - heat]);
        heats.push(heat);
    }
    let swing = all.iter().map(|[_, kept]| (kept - all[0][1]).abs()).fold(0.0, f64::max);
    let moved = heats.iter().map(|heat| (heat - heats[0]).abs()).fold(0.0, f64::max);
    assert!(moved > 10.0 && swing < 0.01 * moved, "{swing} of {moved}");
    // 93 degrees of freedom, samples a relaxation time apart: √(46.5 · 2.16 / 250) = 0.63 k T.
    let mean = all[50..].iter().map(|[kinetic, _]| kinetic / KT).sum::<f64>() / 250.0;
    assert!((mean - 46.5).abs() < 4.0 * 0.63, "{mean}");
}

#[test]
fn thermostats_agree_with_their_references() {
    for (name, rate) in [
        ("langevin", 1.7),
        ("langevin", 30.0),
        ("andersen", 12.0),
        ("berendsen", 1.7),
        ("berendsen", 30.0),
        ("csvr", 1.7),
        ("csvr", 30.0),
    ] {
        for count in [1, 63, 65, 1000] {
            // One particle without its drift has nothing to regulate.
            if count == 1 && name == "csvr" && rate > 20.0 {
                continue;
            }
            let mut state = spread(count, 1.0);
            if count > 2 {
                state.held = vec![Held { id: 1, by: Hold::Fixed }];
                state.mass_mut()[2] = 0.0;
            }
            let flat = count == 65;
            if flat {
                state.position_mut().iter_mut().for_each(|x| x.z = 0.0);
                state.velocity_mut().iter_mut().for_each(|v| v.z = 0.0);
            }
            let bounds = Bounds { dimensions: if flat { 2 } else { 3 }, ..Bounds::default() };
            let busy = if count > 2 { &[name][..] } else { &[] };
            let rest = state.velocity().get(2).copied();
            let start = setup(state, vec![bath(name, rate, 4_294_967_301.0)], bounds, 0.05);
            // Of a factor near 1 the two terms, of size 1 − c, cancel by about ten.
            let slack = if name == "csvr" { 10.0 } else { 1.0 };
            agrees(&start, 3, slack, busy);
            let mut simulation: Simulation<motes::Cpu> = on_cpu(&start);
            simulation.step(3).expect("steps");
            let end = block_on(simulation.snapshot()).expect("a state");
            assert_eq!(
                end.velocity().get(2).copied() == rest,
                count > 2 || rest.is_none(),
                "what has no mass has no temperature"
            );
            assert!(!flat || end.velocity().iter().all(|v| v.z == 0.0), "{name} leaves the plane");
        }
    }
}
