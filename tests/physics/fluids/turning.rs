//! Fluids that turn, with free surfaces: which viscosities preserve their angular momentum.

use glam::DVec3;
use motes::forces::Component;
use motes::kernel::Backend;
use motes::settings::Value;
use motes::{Bounds, Simulation, State};

use crate::fluids::{gpu, setup};
use crate::support;
use crate::support::Random;
use crate::support::states::{cpu_in, force, word};
use Value::{Flag, Number};

/// The angular velocity; a turn takes 2 π.
const SPIN: f64 = 1.0;
const TURN: f64 = std::f64::consts::TAU;

/// A fluid that turns at first like a solid about z, of particles on a lattice within a shape, off it by some part of a spacing.
fn turning(spacing: f64, flat: bool, off: (u64, f64), inside: impl Fn(DVec3) -> bool) -> State {
    let (mut particles, mut random) = (State::default(), Random::new(off.0));
    let most = (1.0 / spacing).ceil() as i32;
    let mass = spacing.powi(if flat { 2 } else { 3 });
    for k in if flat { 0..1 } else { -most..most } {
        for j in -most..most {
            for i in -most..most {
                let place =
                    DVec3::new(f64::from(i) + 0.5, f64::from(j) + 0.5, if flat { 0.0 } else { f64::from(k) + 0.5 });
                if inside(spacing * place) {
                    let aside = off.1 * random.vector();
                    let x = spacing * (place + if flat { aside.with_z(0.0) } else { aside });
                    particles.push(x, SPIN * DVec3::Z.cross(x), mass, 0.0);
                }
            }
        }
    }
    particles
}

fn fluid(spacing: f64, more: &[(&'static str, Value)]) -> Box<dyn Component> {
    let all = [("density", Number(1.0)), ("spacing", Number(spacing))];
    force("fluid", &[&all[..], more].concat())
}

/// An equation of state, and both viscosities: a Reynolds number of 50, and one of 100 or so by α.
fn weak(form: &'static str) -> Vec<(&'static str, Value)> {
    let all = [("sound_speed", Number(10.0)), ("alpha", Number(0.1)), ("viscosity", Number(0.02))];
    [&all[..], &[("viscosity_form", word(form))]].concat()
}

/// What keeps a drop together: a pull to the origin, which turns nothing, twice as strong as it takes.
fn pull() -> Box<dyn Component> {
    force("attractor", &[("profile", word("harmonic")), ("strength", Number(2.0 * SPIN * SPIN))])
}

fn plane(flat: bool) -> Bounds {
    Bounds { dimensions: if flat { 2 } else { 3 }, ..Bounds::default() }
}

/// Σ m x × v about z, and what a relative error of 1 in each x or v would make of it, at random: √Σ (m |x| |v|)².
fn spin<B: Backend>(simulation: &mut Simulation<B>) -> [f64; 2] {
    let state = pollster::block_on(simulation.snapshot()).expect("a snapshot");
    let each = || state.position().iter().zip(state.velocity()).zip(state.mass());
    let squares = each().map(|((x, v), m)| (m * x.length() * v.length()).powi(2));
    [each().map(|((x, v), m)| m * x.cross(*v).z).sum(), squares.sum::<f64>().sqrt()]
}

/// A run on the device: the part of the angular momentum that is lost after some turns, and what rounding may make of it.
///
/// A step of single precision rounds each position and velocity twice, to 2⁻²⁴ of it at most, at random: √(4 n) 2⁻²⁴ of the sum above after n
/// steps; four times that happens once in 10⁴ times.
fn lost(state: &State, forces: Vec<Box<dyn Component>>, integrator: &str, dt: f64, turns: f64, flat: bool) -> [f64; 2] {
    let shared = support::device();
    let setup = setup(state, forces, integrator, dt, plane(flat));
    let mut simulation = gpu(&shared, &setup);
    let steps = (turns * TURN / dt).ceil();
    let [first, early] = spin(&mut simulation);
    simulation.step(steps as u32).expect("steps");
    let [last, late] = spin(&mut simulation);
    [1.0 - last / first, 4.0 * (4.0 * steps).sqrt() * 2f64.powi(-24) * early.max(late) / first]
}

/// Asserts that nothing is lost but by rounding, and that 1e-5 is far beyond that.
fn kept([lost, limit]: [f64; 2], name: &str) {
    println!("{name}: lost {lost:.1e} of a limit of {limit:.1e}");
    assert!(limit < 1e-5 && lost.abs() < limit, "{name}: {lost:e}, {limit:e}");
}

/// Asserts that so much is lost that the comparison says something.
fn taken([lost, _]: [f64; 2], name: &str) {
    println!("{name}: lost {lost:.3}");
    assert!(lost > 0.05, "{name}: {lost}: the comparison says nothing");
}

/// The square patch of Colagrossi (2005) and Le Touzé et al. (2013), of side 1.
fn patch(side: u32) -> (State, f64) {
    let spacing = 1.0 / f64::from(side);
    (turning(spacing, true, (1, 0.0), |x| x.truncate().abs().max_element() < 0.5), spacing)
}

#[test]
fn a_square_patch_keeps_its_angular_momentum() {
    for side in [12, 20] {
        let (state, spacing) = patch(side);
        let dt = 0.03 * spacing;
        // Held together, and free, with tensile pressure, as in the publications: up to ω t = 4.
        let held = |form, turns| lost(&state, vec![pull(), fluid(spacing, &weak(form))], "leapfrog", dt, turns, true);
        kept(held("central", 2.0), &format!("a patch of {side}"));
        taken(held("morris", 0.5), "by Morris' form, in half a turn");
        let tensile = [("negative_pressure", Flag(true)), ("density_by", word("continuity"))];
        let free = fluid(spacing, &[&weak("central")[..], &tensile].concat());
        kept(lost(&state, vec![free], "leapfrog", dt, 4.0 / TURN, true), &format!("a free patch of {side}"));
    }
}

/// Pressure that is solved for.
#[test]
#[ignore = "minutes on a software adapter: `tests/run --test physics --test commands -- --include-ignored` runs it"]
fn a_patch_whose_pressure_is_solved_for_keeps_it_too() {
    for side in [10, 14] {
        let (state, spacing) = patch(side);
        let with = |more: &[(&'static str, Value)], turns: f64| {
            let all = [("solver", word("dfsph")), ("viscosity", Number(0.02))];
            let forces = vec![pull(), fluid(spacing, &[&all[..], more].concat())];
            lost(&state, forces, "symplectic_euler", 0.06 * spacing, turns, true)
        };
        kept(with(&[], 2.0), &format!("DFSPH, a patch of {side}"));
        taken(with(&[("viscosity_form", word("morris"))], 0.5), "by Morris' form, in half a turn");
    }
}

/// A drop in space, of two starts.
#[test]
fn a_drop_keeps_its_angular_momentum() {
    let spacing = 0.25;
    for seed in [3, 8] {
        let state = turning(spacing, false, (seed, 0.1), |x| x.length() < 1.0);
        let with = |settings: &[(&'static str, Value)], turns: f64| {
            lost(&state, vec![pull(), fluid(spacing, settings)], "leapfrog", 0.03 * spacing, turns, false)
        };
        kept(with(&weak("central"), 2.0), &format!("a drop of {}", state.len()));
        taken(with(&weak("morris"), 0.5), "by Morris' form, in half a turn");
        taken(with(&[("sound_speed", Number(10.0)), ("xsph", Number(0.05))], 0.5), "by XSPH, in half a turn");
    }
}

/// By the references: 1e-5 and far below.
#[test]
fn references_keep_it_to_their_last_digits() {
    let (square, spacing) = patch(10);
    let ball = turning(0.4, false, (5, 0.1), |x| x.length() < 1.0);
    for (state, spacing, flat) in [(&square, spacing, true), (&ball, 0.4, false)] {
        let lost = |settings: &[(&'static str, Value)]| {
            let forces = vec![pull(), fluid(spacing, settings)];
            let dt = 0.03 * spacing;
            let mut simulation = cpu_in(&plane(flat), state, forces, "leapfrog", dt);
            let [first, _] = spin(&mut simulation);
            simulation.step((2.0 * TURN / dt).ceil() as u32).expect("steps");
            let [last, _] = spin(&mut simulation);
            1.0 - last / first
        };
        let (central, morris) = (lost(&weak("central")), lost(&weak("morris")));
        println!("{} in f64: lost {central:.1e}, Morris {morris:.3}", state.len());
        // √(4 n) 2⁻⁵³ of 5000 steps, tenfold.
        assert!(central.abs() < 2e-13 && morris > 0.05, "{flat}: {central:e}, {morris}");
    }
}

/// Two particles at one place rub along no line: they have finite accelerations.
#[test]
fn two_at_one_place_are_no_fault() {
    let mut two = State::default();
    for speed in [1.0, -1.0] {
        two.push(DVec3::ZERO, DVec3::X * speed, 0.01, 0.0);
    }
    for form in ["central", "morris"] {
        let forces = vec![fluid(0.1, &weak(form))];
        let of = setup(&two, forces, "leapfrog", 1e-3, plane(true));
        let mut device = gpu(&support::device(), &of);
        device.step(1).expect("a step");
        let state = pollster::block_on(device.snapshot()).expect("a snapshot");
        assert!(state.velocity().iter().all(|v| v.is_finite()), "{form}: {:?}", state.velocity());
    }
}
