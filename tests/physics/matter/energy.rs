//! The energy of grains: what they lose in contacts is what contacts say that they dissipate.

use glam::DVec3;
use motes::kernel::Array;
use motes::motion::{Held, Hold};
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
    // Exactly the sum of two radii: contacts end beyond it.
    let range = 2.0 * all.iter().map(|grain| grain.radius).fold(0.0, f64::max);
    let ranged: Vec<_> = given.iter().cloned().chain([("range", range.into())]).collect();
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
    // Twelve bridges have the energy of a fall by a tenth of a diameter.
    let wet = [("surface_tension", 3.0.into()), ("contact_angle", 0.4.into()), ("bridge_volume", 0.002.into())];
    for (kind, more) in [("sliding", &[][..]), ("sprung", &sticky), ("constant", &constant), ("wet", &wet)] {
        for model in ["linear", "hertz"] {
            let more: Vec<_> = more.iter().cloned().chain([("model", word(model))]).collect();
            // The fine steps are those that take long.
            for (seed, dt, allowed) in [(3, 5e-4, 0.03), (8, 5e-4, 0.03), (3, 6.25e-5, 0.006)] {
                let off = imbalance(seed, &more, dt);
                println!("{kind} {model} {seed} {dt}: {off:.2e}");
                assert!(off < allowed, "{kind} {model} {seed} {dt}: {off}");
            }
        }
    }
}

/// Two grains that meet obliquely, the second of them free, or fixed with a mass or without one: by springs and friction alone, what is still
/// wound up when they part is heat, and all heat is counted, that of the fixed one too. The range is exactly the sum of two radii.
#[test]
fn all_heat_of_a_contact_is_counted() {
    for (mass, fixed) in [(1.0, false), (1e5, true), (0.0, true)] {
        for model in ["linear", "hertz"] {
            let mut two = [GRAIN, GRAIN];
            (two[0].mass, two[1].position) = (mass, DVec3::X * 1.001);
            (two[1].velocity, two[1].spin) = (DVec3::new(-1.0, 0.6, 0.2), DVec3::new(0.4, 1.0, 3.0));
            let more = [
                ("model", Value::Text(model.into())),
                ("range", 1.0.into()),
                ("stiffness", 2e4.into()),
                ("young_modulus", 1e5.into()),
                ("restitution", 1.0.into()),
                ("tangential_damping", 0.0.into()),
                ("friction", 0.5.into()),
                ("torsional_friction", 0.3.into()),
            ];
            let mut all = setup(state(&two), vec![force("contact", &more)], Bounds::default(), 1e-5);
            if fixed {
                all.state.held = vec![Held { id: 0, by: Hold::Fixed }];
            }
            let mut simulation = on_cpu(&all);
            let mut after = |steps: u32| {
                simulation.step(steps).expect("steps");
                let state = block_on(simulation.snapshot()).expect("a state");
                (energies(&state), (state.position()[1] - state.position()[0]).length())
            };
            let ([start, none], _) = after(0);
            let ([end, lost], apart) = after(8000);
            assert!(none == 0.0 && apart > 1.001 && lost > 1e-3, "{mass} {model}: {none} {lost} {apart}");
            println!("{mass} {model}: {start} {end} {lost} {:.2e}", (end + lost - start) / lost);
            assert!((end + lost - start).abs() < 2e-3 * lost, "{mass} {model}: {start} is not {end} + {lost}");
        }
    }
}

/// At rest only springs push: F = −∇U for grains of different sizes and masses that overlap, a light one and a fixed one among them.
#[test]
fn springs_at_rest_push_down_their_energy() {
    for model in ["linear", "hertz"] {
        let mut random = Random::new(9);
        let mut grain = |i: usize| Grain {
            position: 0.8 * DVec3::new((i % 2) as f64, (i / 2 % 2) as f64, (i / 4) as f64) + 0.05 * random.vector(),
            mass: if i == 5 { 0.0 } else { 1.0 + 0.5 * random.next() },
            radius: 0.45 + 0.03 * random.next(),
            ..GRAIN
        };
        let all: Vec<Grain> = (0..8).map(&mut grain).collect();
        let given = [
            ("range", 1.0.into()),
            ("model", Value::Text(model.into())),
            ("stiffness", 2e4.into()),
            ("young_modulus", 4e4.into()),
        ];
        let particles = state(&all);
        let accelerations = |state: &State| {
            let all = setup(state.clone(), vec![force("contact", &given)], Bounds::default(), 1e-4);
            let mut simulation = on_cpu(&all);
            simulation.step(0).expect("an evaluation");
            let Some(Array::Vec4(all)) = simulation.backend().host().get("acceleration") else {
                panic!("accelerations")
            };
            all
        };
        let potential =
            |state: &State| -> f64 { accelerations(state).iter().zip(state.mass()).map(|(a, m)| a.w * m).sum() };
        let a = accelerations(&particles);
        assert!(a.iter().filter(|a| a.truncate().length() > 1.0).count() == 7, "{a:?}");
        let h = 1e-5;
        for (i, a) in a.iter().enumerate() {
            for k in 0..3 {
                let at = |side: f64| {
                    let mut there = particles.clone();
                    there.position_mut()[i][k] += side * h;
                    potential(&there)
                };
                let (want, got) = (-(at(1.0) - at(-1.0)) / (2.0 * h), all[i].mass * a[k]);
                // The third derivative, h² F″ / 6 with F″ of Hertz's F / δ², and rounding of U, 1e-16 U / h.
                assert!(
                    all[i].mass == 0.0 || (got - want).abs() < 1e-6 * want.abs().max(1.0),
                    "{model} {i}: {got} is not {want}"
                );
            }
        }
    }
}
