//! The energy of grains: what they lose in contacts is what contacts say that they dissipate.

use glam::DVec3;
use motes::settings::Value;
use motes::{Bounds, Setup, State};
use pollster::block_on;

use super::grains::{GRAIN, Grain, state};
use super::{on_cpu, setup};
use crate::support::Random;
use crate::support::states::{force, vector};

/// Kinetic, rotational and potential energy together, and what has been dissipated.
fn energies(state: &State) -> [f64; 2] {
    let [spins, moments] = ["angular_velocity", "inertia"].map(|name| state.vector(name).expect("a column"));
    let turning: f64 = spins.iter().zip(moments).map(|(w, i)| 0.5 * (*i * *w).dot(*w)).sum();
    let moving: f64 = state.velocity().iter().zip(state.mass()).map(|(v, m)| 0.5 * m * v.length_squared()).sum();
    let held: f64 = state.energies().expect("energies").iter().sum();
    [moving + turning + held, state.scalar("dissipated").expect("a column").iter().sum()]
}

/// Twelve grains of different masses that fall onto a floor and onto each other, and turn.
fn falling(seed: u64, more: &[(&'static str, Value)], dt: f64) -> Setup {
    let mut random = Random::new(seed);
    let mut grain = |i: usize| Grain {
        position: DVec3::new(0.9 * (i % 2) as f64, 0.9 * (i / 2 % 2) as f64, 0.6 + 1.1 * (i / 4) as f64)
            + 0.04 * random.vector(),
        velocity: 0.5 * random.vector() - DVec3::Z,
        spin: 2.0 * random.vector(),
        mass: 1.0 + 0.5 * random.next(),
        radius: 0.42 + 0.02 * random.next(),
        ..GRAIN
    };
    let all: Vec<Grain> = (0..12).map(&mut grain).collect();
    let given = [("stiffness", 2e4.into()), ("young_modulus", 4e4.into()), ("restitution", 0.6.into())];
    let given: Vec<_> = given.into_iter().chain(more.iter().cloned()).collect();
    let ranged: Vec<_> = given.iter().cloned().chain([("range", 1.0.into())]).collect();
    let weight = force("uniform", &[("acceleration", vector(0.4, 0.0, -9.81))]);
    let forces = vec![force("contact", &ranged), force("contact_wall", &given), weight];
    setup(state(&all), forces, Bounds::default(), dt)
}

/// How much kinetic, elastic and weight's energy and what is dissipated change in all until each of four times, as a part of what is dissipated.
fn imbalance(seed: u64, more: &[(&'static str, Value)], dt: f64) -> f64 {
    let mut simulation = on_cpu(&falling(seed, more, dt));
    let mut after = |time: f64| {
        simulation.step((time / dt).round() as u32).expect("steps");
        energies(&block_on(simulation.snapshot()).expect("a state"))
    };
    let [start, none] = after(0.0);
    assert_eq!(none, 0.0);
    let mut off = 0.0_f64;
    for _ in 0..4 {
        let [now, lost] = after(0.3);
        // Negative control: by itself the energy falls by about all of that.
        assert!(lost > 1.0 && start - now > 0.9 * lost, "{now} {lost} {start}");
        off = off.max((now + lost - start).abs() / lost);
    }
    off
}

/// Kinetic and elastic energy, that of the weight and what is dissipated are constant, by both models and all kinds of friction; the
/// error is of the order of the step, which is 1/30 and 1/250 of a linear contact: 1.4e-2 and 2.8e-3 at most.
#[test]
fn what_grains_lose_is_what_contacts_dissipate() {
    let word = |text: &'static str| Value::Text(text.into());
    let sticky = [("rolling_friction", 0.3.into()), ("torsional_friction", 0.2.into())];
    let constant = [("rolling_friction", 0.3.into()), ("rolling_model", word("constant"))];
    for (kind, more) in [("sliding", &[][..]), ("sprung", &sticky), ("constant", &constant)] {
        for model in ["linear", "hertz"] {
            let more: Vec<_> = more.iter().cloned().chain([("model", word(model))]).collect();
            for seed in [3, 8] {
                let [coarse, fine] = [5e-4, 6.25e-5].map(|dt| imbalance(seed, &more, dt));
                println!("{kind} {model} {seed}: {coarse:.2e} {fine:.2e}");
                assert!(coarse < 0.03 && fine < 0.006, "{kind} {model} {seed}: {coarse} {fine}");
            }
        }
    }
}
