//! Density as a state, and what is drawn along.

use glam::DVec3;
use motes::kernel::Array;
use motes::settings::Value;
use motes::{Cpu, Setup, Side, Simulation, State};

use crate::setup;
use crate::support::fluids::{DENSITY, bounds, cloud, fluid};
use crate::support::states::{accelerations_in, cpu_in, word};
use Value::Number;

fn densities(simulation: &mut Simulation<Cpu>) -> Vec<f64> {
    match simulation.backend().host().get("density") {
        Some(Array::Float(all)) => all,
        other => panic!("{other:?}"),
    }
}

/// Sums over the same particles on the same way change as much as the state does, but for the cube of each step.
#[test]
fn continuity_follows_the_sums() {
    let all = bounds(144, true, Side::Periodic);
    let particles = cloud(144, true, false);
    // Nothing pushes: everybody goes straight on.
    let quiet = |by| {
        fluid(&[
            ("sound_speed", Number(1e-9)),
            ("alpha", Number(0.0)),
            ("viscosity", Number(0.0)),
            ("density_by", word(by)),
        ])
    };
    let change = |by, name, dt: f64, steps: u32| {
        let mut simulation = cpu_in(&all, &particles, vec![quiet(by)], name, dt);
        // The measurement evaluates: what is there before the first step.
        pollster::block_on(simulation.snapshot()).expect("a state");
        let first = densities(&mut simulation);
        simulation.step(steps).expect("steps");
        pollster::block_on(simulation.snapshot()).expect("a state");
        densities(&mut simulation).iter().zip(first).map(|(now, then)| now - then).collect::<Vec<_>>()
    };
    let apart =
        |a: &[f64], b: &[f64]| (a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64).sqrt();
    let sums = change("summation", "leapfrog", 0.02, 2);
    let size = apart(&sums, &vec![0.0; sums.len()]);
    assert!(size > 0.02 * DENSITY, "{size}");
    for name in ["leapfrog", "symplectic_euler", "forest_ruth", "pefrl"] {
        let [coarse, fine] =
            [(0.02, 2), (0.01, 4)].map(|(dt, steps)| apart(&change("continuity", name, dt, steps), &sums));
        // The second derivative of the kernel jumps at its edge, and steps of forest_ruth go back and forth.
        assert!(coarse < 0.2 * size && fine < 0.5 * coarse, "{name}: {coarse:e} and {fine:e} of {size:e}");
    }
}

#[test]
fn stages_that_are_thrown_away_are_refused() {
    let particles = cloud(20, true, false);
    let refusal = |name: &str, more: &[(&'static str, Value)]| {
        let setup: Setup = setup(&particles, vec![fluid(more)], name, 0.01, bounds(20, true, Side::Open));
        let machine = motes::kernel::Machine::HOST;
        setup.plans(machine).err().map(|error| error.to_string())
    };
    let continuity = [("density_by", word("continuity"))];
    for name in ["midpoint", "heun", "rk4", "backward_euler", "implicit_midpoint"] {
        let words = refusal(name, &continuity).unwrap_or_default();
        assert!(words.contains("choose leapfrog"), "{name}: {words}");
        assert_eq!(refusal(name, &[]), None, "{name}");
    }
    for name in ["leapfrog", "symplectic_euler", "forest_ruth", "pefrl", "forward_euler"] {
        assert_eq!(refusal(name, &continuity), None, "{name}");
    }
    let words = refusal("leapfrog", &[("diffusion", Number(0.1))]).unwrap_or_default();
    assert!(words.contains("no state to diffuse"), "{words}");
}

/// Diffusion levels densities and keeps their sum; with its weight, those of a fluid at rest stay.
#[test]
fn diffusion_leaves_a_fluid_at_rest_alone() {
    let all = bounds(144, true, Side::Open);
    let mut particles: State = cloud(144, true, false);
    particles.velocity_mut().fill(DVec3::ZERO);
    let weight = DVec3::new(0.03, -0.08, 0.0);
    let run = |told: DVec3, start: &dyn Fn(DVec3) -> f64| {
        let still = [("diffusion", Number(0.1)), ("weight", Value::Vector(told)), ("density_by", word("continuity"))];
        let mut simulation = cpu_in(&all, &particles, vec![fluid(&still)], "symplectic_euler", 1e-6);
        simulation.step(1).expect("a step");
        let dense = particles.position().iter().map(|x| start(*x)).collect::<Vec<_>>();
        motes::kernel::Backend::write(simulation.backend(), "density", &Array::Float(dense.clone()))
            .expect("densities");
        simulation.step(1).expect("a step");
        let now = densities(&mut simulation);
        now.iter().zip(dense).map(|(now, then)| (now - then).abs()).fold(0.0, f64::max)
    };
    // c(ρ)² dρ = ρ w·dr, by Tait's equation with γ = 7.
    let at_rest = |x: DVec3| DENSITY * (1.0 + 6.0 * weight.dot(x) / (2.7 * 2.7)).powf(1.0 / 6.0);
    let (told, untold) = (run(weight, &at_rest), run(DVec3::ZERO, &at_rest));
    // Densities are up to 1.5 % off rest: what is left is 15 times the square of that, and with c₀ for c it would be 5 times it.
    assert!(told < 0.01 * untold && untold > 1e-9, "{told:e} {untold:e}");
}

/// XSPH keeps momentum, and a body that moves as a whole feels nothing of it.
#[test]
fn xsph_draws_together() {
    let all = bounds(100, true, Side::Open);
    let mut particles = cloud(100, true, false);
    let quiet = |xsph: f64| [fluid(&[("alpha", Number(0.0)), ("viscosity", Number(0.0)), ("xsph", Number(xsph))])];
    let felt = |particles: &State| {
        let both = [0.0, 0.5].map(|xsph| accelerations_in(&all, &quiet(xsph), particles, 0.0));
        both[1].iter().zip(&both[0]).map(|(with, without)| (*with - *without).truncate()).collect::<Vec<_>>()
    };
    let drawn = felt(&particles);
    let each = || drawn.iter().zip(particles.mass()).map(|(a, m)| *m * *a);
    let (total, size) = (each().sum::<DVec3>().length(), each().map(DVec3::length).sum::<f64>());
    assert!(total < 1e-12 * size && size > 0.0, "{total:e} of {size}");
    let power: f64 = each().zip(particles.velocity()).map(|(f, v)| f.dot(*v)).sum();
    assert!(power < 0.0, "{power}");
    particles.velocity_mut().fill(DVec3::new(0.3, -0.4, 0.0));
    assert!(felt(&particles).iter().all(|a| a.length() < 1e-12));
}
