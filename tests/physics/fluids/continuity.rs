//! Density as a state, and what is drawn along.

use glam::DVec3;
use motes::integrators::INTEGRATORS;
use motes::kernel::Array;
use motes::settings::Value;
use motes::{Cpu, Side, Simulation, State};

use crate::fluids::setup;
use crate::support::fluids::{DENSITY, bounds, cloud, fluid};
use crate::support::states::{accelerations_in, cpu_in, phase, word};
use Value::Number;

/// The speed of sound of the fluid.
const SOUND: f64 = 2.7;

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
    // Nothing pushes: all particles go straight on.
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
    for entry in INTEGRATORS.iter().filter(|entry| entry.by_default().advances_columns()) {
        let name = entry.name;
        let [coarse, fine] =
            [(0.02, 2), (0.01, 4)].map(|(dt, steps)| apart(&change("continuity", name, dt, steps), &sums));
        // The second derivative of the kernel jumps at its edge, and steps of forest_ruth go back and forth.
        assert!(coarse < 0.2 * size && fine < 0.5 * coarse, "{name}: {coarse:e} and {fine:e} of {size:e}");
    }
}

/// A fluid without friction, whose pressure presses it: where particles are, how dense it is there and how they move, after such
/// steps.
fn pressed(name: &str, diffusion: f64, steps: u32) -> Vec<f64> {
    let all = bounds(64, true, Side::Periodic);
    let quiet =
        [("alpha", Number(0.0)), ("viscosity", Number(0.0)), ("kernel", word("wendland")), ("support", Number(2.6))];
    let state = [("density_by", word("continuity")), ("diffusion", Number(diffusion))];
    let forces = vec![fluid(&[&quiet[..], &state].concat())];
    let mut simulation = cpu_in(&all, &cloud(64, true, false), forces, name, 0.06 / f64::from(steps));
    simulation.step(steps).expect("steps");
    let dense = densities(&mut simulation).into_iter().map(|rho| rho / DENSITY);
    // Across the box it is one place.
    let (x, v) = phase(&mut simulation);
    let turns = x.iter().flat_map(|x| (x.truncate() * std::f64::consts::TAU / all.period().x).truncate().to_array());
    let speeds = v.iter().flat_map(|v| (v.truncate() / SOUND).to_array());
    dense.chain(turns.flat_map(|turn| [turn.sin(), turn.cos()])).chain(speeds).collect()
}

/// Of the orders that are declared: explicit methods of kicks and drifts have 2 for what is carried, and 1 where its rate depends on
/// itself, as by diffusion; implicit ones take a fluid explicitly.
#[test]
fn every_integrator_carries_density_along() {
    let exact = [0.0, 0.3].map(|diffusion| pressed("rk4", diffusion, 96));
    for (entry, case) in INTEGRATORS
        .iter()
        .filter(|entry| entry.by_default().advances_columns())
        .flat_map(|entry| [(entry, 0), (entry, 1)])
    {
        let (exact, diffusion) = (&exact[case], [0.0, 0.3][case]);
        let its = entry.by_default();
        let (order, staged) = (its.order(), its.order_with_velocity() > 1);
        let order = match (its.is_implicit(), staged) {
            (true, _) => 1,
            (false, true) => order,
            (false, false) if diffusion > 0.0 => 1,
            (false, false) => order.min(2),
        };
        let error = |steps: u32| {
            let apart = pressed(entry.name, diffusion, steps).into_iter().zip(exact).map(|(a, b)| (a - b).powi(2));
            apart.sum::<f64>().sqrt()
        };
        let steps = [0, 32, 16, 0, 8][order as usize];
        let [coarse, fine] = [steps, 2 * steps].map(error);
        let slope = (coarse / fine).log2();
        let name = format!("{} with diffusion {diffusion}: {coarse:e}, {fine:e}", entry.name);
        assert!((slope - f64::from(order)).abs() < 0.3, "{name}: slope {slope}, not {order}");
    }
}

#[test]
fn diffusion_needs_a_density_that_is_a_state() {
    let setup = setup(
        &cloud(20, true, false),
        vec![fluid(&[("diffusion", Number(0.1))])],
        "leapfrog",
        0.01,
        bounds(20, true, Side::Open),
    );
    let said = setup.plans(motes::kernel::Machine::HOST).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(said.contains("no state to diffuse"), "{said}");
}

/// Diffusion levels densities and keeps their sum; with its weight, those of a fluid at rest stay.
#[test]
fn diffusion_leaves_a_fluid_at_rest_alone() {
    let all = bounds(144, true, Side::Open);
    let mut particles: State = cloud(144, true, false);
    particles.velocity_mut().fill(DVec3::ZERO);
    let weight = DVec3::new(0.03, -0.08, 0.0);
    let run = |given: DVec3, start: &dyn Fn(DVec3) -> f64| {
        let still = [("diffusion", Number(0.1)), ("weight", Value::Vector(given)), ("density_by", word("continuity"))];
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
    let (with, without) = (run(weight, &at_rest), run(DVec3::ZERO, &at_rest));
    // Densities are up to 1.5 % off rest: what is left is 15 times the square of that, and with c₀ for c it would be 5 times it.
    assert!(with < 0.01 * without && without > 1e-9, "{with:e} {without:e}");
}

/// XSPH keeps momentum, and a body that moves as a whole is unchanged by it.
#[test]
fn xsph_draws_together() {
    let all = bounds(100, true, Side::Open);
    let mut particles = cloud(100, true, false);
    let quiet = |xsph: f64| [fluid(&[("alpha", Number(0.0)), ("viscosity", Number(0.0)), ("xsph", Number(xsph))])];
    let drawn_by = |particles: &State| {
        let both = [0.0, 0.5].map(|xsph| accelerations_in(&all, &quiet(xsph), particles, 0.0));
        both[1].iter().zip(&both[0]).map(|(with, without)| (*with - *without).truncate()).collect::<Vec<_>>()
    };
    let drawn = drawn_by(&particles);
    let each = || drawn.iter().zip(particles.mass()).map(|(a, m)| *m * *a);
    let (total, size) = (each().sum::<DVec3>().length(), each().map(DVec3::length).sum::<f64>());
    assert!(total < 1e-12 * size && size > 0.0, "{total:e} of {size}");
    let power: f64 = each().zip(particles.velocity()).map(|(f, v)| f.dot(*v)).sum();
    assert!(power < 0.0, "{power}");
    particles.velocity_mut().fill(DVec3::new(0.3, -0.4, 0.0));
    assert!(drawn_by(&particles).iter().all(|a| a.length() < 1e-12));
}
