//! The virial and the pressure: published values, −dU/dε of the box, visits, and laws of users.

use glam::DVec3;
use motes::forces::{Component, Custom, Over};
use motes::{Bounds, Setup, Simulation, State};
use pollster::block_on;

use super::{cut, nist, periodic, setup};
use crate::matter::{on_cpu, spread};
use crate::support::states::{force, word};

fn on_gpu(setup: &Setup) -> Result<[f64; 6], motes::Error> {
    let shared = crate::support::device();
    let gpu = crate::support::machines::gpu(&shared, setup.state.len());
    let mut simulation = Simulation::on(gpu, setup)?;
    simulation.step(1)?;
    let before = block_on(simulation.snapshot())?;
    let virial = block_on(simulation.virial())?;
    let after = block_on(simulation.snapshot())?;
    assert_eq!(before, after, "what is measured changes nothing");
    Ok(virial)
}

fn virial(state: &State, bounds: Bounds, law: Box<dyn Component>) -> [f64; 6] {
    block_on(on_cpu(&setup(state.clone(), vec![law], bounds, 1e-3)).virial()).expect("a virial")
}

fn trace(virial: [f64; 6]) -> f64 {
    virial[..3].iter().sum()
}

/// NIST's table has five digits.
#[test]
fn a_configuration_has_the_virial_of_nist() {
    let bounds = periodic(DVec3::splat(-4.0), DVec3::splat(4.0));
    for (range, known) in [(3.0, -46.249), (4.0, -47.869)] {
        let got = trace(virial(&nist::atoms(), bounds, cut(range, "cut", "within")));
        assert!((got - known).abs() < 6e-4, "{range}: {got} is not {known}");
    }
}

/// A box and its particles, longer by a part along one axis.
fn stretched(state: &State, side: DVec3, strain: DVec3) -> f64 {
    let factor = DVec3::ONE + strain;
    let mut state = state.clone();
    state.position_mut().iter_mut().for_each(|x| *x *= factor);
    let setup = setup(state, vec![cut(2.5, "force_shift", "within")], periodic(DVec3::ZERO, side * factor), 1e-3);
    let state = block_on(on_cpu(&setup).snapshot()).expect("a state");
    state.energies().expect("energies").iter().sum()
}

/// W = −dU/dε along each axis, by differences over h and 2 h: (8 (U₁ − U₋₁) − (U₂ − U₋₂)) / 12 h, with an error of h⁴, 1e-12 of some 1e5. A
/// state holds single precision: places and strains are such that it holds them exactly. At the cut-off U'' jumps by 0.04 of what it is at the
/// minimum, for one in 300 of the pairs there, so that 1e-4 is allowed. The shear is that of the sum over pairs.
#[test]
fn the_virial_is_the_slope_of_the_energy() {
    let side = DVec3::splat(7.75);
    let mut state = spread(343, 1.1);
    state.position_mut().iter_mut().for_each(|x| *x = (x.rem_euclid(side) * 1024.0).round() / 1024.0);
    let got = virial(&state, periodic(DVec3::ZERO, side), cut(2.5, "force_shift", "within"));
    let slope = |r: f64| 24.0 * (r.powi(-7) - 2.0 * r.powi(-13));
    let (mut normal, mut shear) = (DVec3::ZERO, DVec3::ZERO);
    for (n, a) in state.position().iter().enumerate() {
        for b in &state.position()[..n] {
            let r = (b - a) - side * ((b - a) / side).round();
            if r.length() < 2.5 {
                let pull = (slope(r.length()) - slope(2.5)) / r.length();
                normal -= pull * r * r;
                shear -= pull * DVec3::new(r.y * r.z, r.x * r.z, r.x * r.y);
            }
        }
    }
    for (got, want) in got.iter().zip([normal.to_array(), shear.to_array()].concat()) {
        assert!((got - want).abs() < 1e-9 * normal.length() && want.abs() > 1e-2, "{got} is not {want}");
    }
    for (axis, along) in [DVec3::X, DVec3::Y, DVec3::Z].into_iter().enumerate() {
        let h = 1.0 / 1024.0;
        let across = |n: f64| stretched(&state, side, -n * h * along) - stretched(&state, side, n * h * along);
        let want = (8.0 * across(1.0) - across(2.0)) / (12.0 * h);
        assert!((got[axis] - want).abs() < 1e-4 * want.abs(), "{axis}: {} is not {want}", got[axis]);
    }
}

/// A user's law of Lennard-Jones atoms, without a word about the virial.
const OWN: &str = "
struct Sum { pull: vec3f, energy: f32, gather: u32 }
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let sixth = pow(dot(r, r), -3.0);
    (*sum).pull += 24.0 * sixth * (1.0 - 2.0 * sixth) / dot(r, r) * r;
    (*sum).energy += 4.0 * sixth * (sixth - 1.0);
}
// fn merge(
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.pull, sum.energy) / me.mass; }
";

/// The same by its energy alone.
const POTENTIAL: &str = "
fn energy(me: Particle, you: Particle, distance: f32, inverse: f32) -> Energy {
    let sixth = pow(inverse, 6.0);
    return Energy(4.0 * sixth * (sixth - 1.0), 24.0 * sixth * (1.0 - 2.0 * sixth) / distance);
}
";

/// On the device, however pairs are found, and for a user's law: the same, to some roundings of 343 sums of 60 pairs.
#[test]
fn every_visit_and_own_laws_have_the_same_virial() {
    let bounds = periodic(DVec3::ZERO, DVec3::splat(8.8));
    let mut state = spread(500, 1.1);
    state.position_mut().iter_mut().for_each(|x| *x = x.rem_euclid(DVec3::splat(8.8)));
    let list = |range| Over::List { range, skin: Some(0.2), slots: 0 };
    let own = |over| -> Box<dyn Component> { Box::new(Custom::new("own", "own.wgsl", OWN, over)) };
    let mut laws: Vec<Box<dyn Component>> = vec![own(list(2.5)), own(Over::Near { range: 2.5, of: None })];
    let potential = |over| -> Box<dyn Component> { Box::new(Custom::new("own", "own.wgsl", POTENTIAL, over)) };
    laws.extend([list(2.5), Over::Within { range: 2.5 }].map(potential));
    laws.extend(["within", "near", "list", "auto"].map(|over| cut(2.5, "cut", over)));
    let mut all = Vec::new();
    for law in laws {
        all.push(on_gpu(&setup(state.clone(), vec![law], bounds, 1e-3)).expect("a virial"));
    }
    let mut cpu = on_cpu(&setup(state, vec![cut(2.5, "cut", "within")], bounds, 1e-3));
    cpu.step(1).expect("a step");
    let want = block_on(cpu.virial()).expect("a virial");
    let size = want.iter().map(|w| w.abs()).fold(0.0, f64::max);
    for got in all {
        let off = got.iter().zip(want).map(|(got, want)| (got - want).abs()).fold(0.0, f64::max);
        // 1e-7 of the steepest parts, which cancel by a factor of ten.
        assert!(off < 3e-6 * size, "{got:?} is not {want:?}");
    }
}

#[test]
fn forces_without_a_virial_are_refused() {
    let bounds = periodic(DVec3::ZERO, DVec3::splat(8.8));
    let refused = |law: Box<dyn Component>, bounds| {
        let error = on_gpu(&setup(spread(100, 1.1), vec![law], bounds, 1e-3)).expect_err("no virial");
        error.to_string()
    };
    let why = |law| refused(law, bounds);
    let said = refused(force("gravity", &[("over", word("tree"))]), Bounds::default());
    assert!(said.contains("`gravity` is evaluated over"), "{said}");
    let history = Over::List { range: 2.5, skin: Some(0.2), slots: 1 };
    let said = why(Box::new(Custom::new("own", "own.wgsl", OWN, history)));
    assert!(said.contains("`own` keeps history"), "{said}");
    // What is no sum over pairs, and what is not finite where there is no neighbour.
    let limited = |force: &str| {
        let text = OWN.replace("vec4f(sum.pull, sum.energy)", &format!("vec4f({force}, 0.0)"));
        why(Box::new(Custom::new("own", "own.wgsl", &text, Over::Near { range: 2.5, of: None })))
    };
    let said = limited("sum.pull / (1.0 + length(sum.pull))");
    assert!(said.contains("do not add up"), "{said}");
    let said = limited("sum.pull / length(sum.pull)");
    assert!(said.contains("not finite"), "{said}");
    // Forces from one side push the box as a whole.
    let said = why(force("flee", &[]));
    assert!(said.contains("not equal and opposite"), "{said}");
    // What keeps springs short has no virial either.
    let said = why(force("strain_limit", &[]));
    assert!(said.contains("`strain_limit` constrains distances"), "{said}");
    // What acts on single particles is no part of the pressure of pairs.
    let drag = force("drag", &[]);
    assert_eq!(on_gpu(&setup(spread(100, 1.1), vec![drag], bounds, 1e-3)).expect("none"), [0.0; 6]);
}
