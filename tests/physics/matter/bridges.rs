//! Bridges of liquid between grains: the force that pulls them off, the distance at which they break, and what they take of the energy.

use std::f64::consts::PI;

use glam::DVec3;
use motes::forces::Component;
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::{Bounds, Error, Setup, State};
use pollster::block_on;

use super::grains::{GRAIN, Grain, state};
use super::{agrees, on_cpu, setup, spread};
use crate::support::states::{force, vector};

const TENSION: f64 = 2.0;
const ANGLE: f64 = 0.3;
const VOLUME: f64 = 0.01;

/// Springs without loss, and liquid; of grains the range is exactly the sum of two radii of a half.
fn wet(kind: &str, more: &[(&'static str, Value)]) -> Box<dyn Component> {
    let given = [
        ("stiffness", 2e4.into()),
        ("restitution", 1.0.into()),
        ("surface_tension", TENSION.into()),
        ("contact_angle", ANGLE.into()),
        ("bridge_volume", VOLUME.into()),
    ];
    let range = (kind == "contact").then_some(("range", Value::Number(1.0)));
    force(kind, &given.into_iter().chain(range).chain(more.iter().cloned()).collect::<Vec<_>>())
}

/// The force of a bridge of two grains of radius a half, a distance apart.
fn pull(gap: f64) -> f64 {
    let x = gap / (VOLUME * 0.125 / 0.5_f64).sqrt();
    2.0 * PI * 0.5 * TENSION * ANGLE.cos() / (1.0 + 1.05 * x + 2.5 * x * x)
}

/// (1 + θ / 2) V^(1/3), and ∫ F ds up to it by the rule of the middle.
fn rupture() -> (f64, f64) {
    let end = (1.0 + 0.5 * ANGLE) * (VOLUME * 0.125).cbrt();
    let work = (0..10_000).map(|k| pull(end * (f64::from(k) + 0.5) / 10_000.0)).sum::<f64>() * end / 10_000.0;
    (end, work)
}

/// A grain at a gap from another, and how fast it comes nearer.
fn two(gap: f64, speed: f64) -> Setup {
    let mut two = [GRAIN, GRAIN];
    (two[1].position, two[1].velocity) = (DVec3::X * (1.0 + gap), -DVec3::X * speed);
    setup(state(&two), vec![wet("contact", &[])], Bounds::default(), 1e-5)
}

fn apart(state: &State) -> [f64; 2] {
    let (x, v) = (state.position()[1] - state.position()[0], state.velocity()[1] - state.velocity()[0]);
    [x.length() - 1.0, v.x]
}

/// No force on the way in. On the way out the bridge takes ∫ F ds of the energy of two grains that part without other losses: v′² = v² − 2 W / m*. It
/// lets go at its rupture distance, beyond the sum of the radii. Negative control: dry grains part with the speed at which they met.
#[test]
fn grains_come_freely_and_part_with_less() {
    let (end, work) = rupture();
    let speed = 3.0_f64;
    let dry = {
        let mut all = two(0.5 * end, speed);
        all.forces = vec![wet("contact", &[("surface_tension", 0.0.into())])];
        all
    };
    for (all, lost) in [(two(0.5 * end, speed), work), (dry, 0.0)] {
        let mut simulation = on_cpu(&all);
        let (mut touched, mut last) = (false, [0.5 * end, -speed]);
        let mut broke = None;
        for _ in 0..60_000 {
            simulation.step(20).expect("steps");
            let now = apart(&block_on(simulation.snapshot()).expect("a state"));
            if now[0] > 0.0 && !touched {
                assert!((now[1] + speed).abs() < 1e-12, "{now:?}");
            }
            touched |= now[0] < 0.0;
            if touched && now[0] > 0.0 && now[1] == last[1] {
                broke = Some(last[0]);
                break;
            }
            last = now;
        }
        let want = (speed * speed - 2.0 * lost / 0.5).sqrt();
        // A contact of 5e-3 has 500 steps, and begins a step late.
        assert!((last[1] / want - 1.0).abs() < 2e-3, "{} is not {want}", last[1]);
        let broke = broke.expect("it breaks");
        if lost > 0.0 {
            // Between two readings they part by 20 steps.
            assert!((broke - end).abs() < 20.0 * 1e-5 * speed * 1.1, "{broke} is not {end}");
        } else {
            assert!(broke < 0.01 * end, "{broke}");
        }
    }
}

/// Grains that meet with less than the energy of their bridge never part.
#[test]
fn slow_grains_stick() {
    let (end, work) = rupture();
    for (part, sticks) in [(0.97, true), (1.03, false)] {
        let speed = (part * 2.0 * work / 0.5_f64).sqrt();
        let mut simulation = on_cpu(&two(0.1 * end, speed));
        simulation.step((4.0 * end / speed / 1e-5) as u32).expect("steps");
        let [gap, _] = apart(&block_on(simulation.snapshot()).expect("a state"));
        assert_eq!(gap < end, sticks, "{part}: {gap} {end}");
    }
}

/// A grain that has touched a fixed grain, or a ceiling, hangs there if it is lighter than the pull of a touch: 2 π R γ cos θ with R of two grains, and
/// twice that with a wall. It falls if it is heavier.
#[test]
fn the_force_that_pulls_grains_off_is_that_of_a_touch() {
    let most = pull(0.0);
    for (kind, times) in [("contact", 1.0), ("contact_wall", 2.0)] {
        for (part, hangs) in [(0.98, true), (1.02, false)] {
            let weight = part * times * most;
            // It is pressed in by as much as it will hang from, so that it does not swing.
            let sunk = (times * most - weight).max(0.0) / 2e4 + 1e-7;
            let lower = Grain { position: -DVec3::Z * (1.0 - sunk), ..GRAIN };
            let mut all = if kind == "contact" {
                let mut all = setup(state(&[GRAIN, lower]), vec![wet(kind, &[])], Bounds::default(), 1e-4);
                all.state.held = vec![Held { id: 0, by: Hold::Fixed }];
                all
            } else {
                let ceiling = [("normal", vector(0.0, 0.0, -1.0)), ("position", vector(0.0, 0.0, -0.5))];
                setup(state(&[lower]), vec![wet(kind, &ceiling)], Bounds::default(), 1e-4)
            };
            all.forces.push(force("uniform", &[("acceleration", vector(0.0, 0.0, -weight))]));
            let mut simulation = on_cpu(&all);
            simulation.step(20_000).expect("steps");
            let now = block_on(simulation.snapshot()).expect("a state");
            let z = now.position().last().expect("a grain").z;
            assert_eq!(z > -1.01, hangs, "{kind} {part}: {z}");
        }
    }
}

/// A restart keeps bridges: steps with a stop between are those without one, to the bit, with grains that are apart.
#[test]
fn bridges_outlive_a_restart() {
    let (end, _) = rupture();
    let all = two(-1e-4, -2.0);
    let shared = crate::support::device();
    let on = |setup: &Setup| motes::Simulation::on(crate::support::machines::gpu(&shared, 2), setup).expect("one");
    let after = |steps: &[u32]| {
        let mut state = all.state.clone();
        for steps in steps {
            let mut simulation = on(&all.with_state(state));
            simulation.step(*steps).expect("steps");
            state = block_on(simulation.snapshot()).expect("a state");
        }
        state
    };
    let (whole, halves) = (after(&[2000]), after(&[1200, 800]));
    let [gap, speed] = apart(&whole);
    assert!(gap > 0.1 * end && gap < end && speed < 1.99, "{gap} {speed}");
    assert_eq!((whole.position(), whole.velocity()), (halves.position(), halves.velocity()));
}

/// Wet grains and a wet wall on the device agree with their references, as bridges form, stretch and break.
#[test]
fn wet_kernels_agree_with_their_references() {
    for (model, angle) in [("linear", 0.0), ("hertz", 0.5)] {
        let more = [
            ("model", Value::Text(model.into())),
            ("young_modulus", 5e3.into()),
            ("stiffness", 5e3.into()),
            ("contact_angle", angle.into()),
            ("restitution", 0.5.into()),
            ("rolling_friction", 0.2.into()),
            ("torsional_friction", 0.1.into()),
        ];
        let mut state = spread(200, 0.97);
        let law = wet("contact", &more);
        crate::support::columns::give(&mut state, &law.columns(), 7);
        let radius = |i: usize| 0.4375 + 0.015_625 * (i % 5) as f64;
        state.set("radius", motes::kernel::Array::Float((0..200).map(radius).collect())).expect("radii");
        state.velocity_mut().iter_mut().for_each(|v| *v *= 8.0);
        let all = setup(state, vec![law, wet("contact_wall", &more)], Bounds::default(), 1.0 / 1024.0);
        agrees(&all, 30, 30.0, &["contact", "contact_wall"]);
    }
}

/// An angle at which liquid does not pull is refused.
#[test]
fn liquid_that_does_not_pull_is_refused() {
    for kind in ["contact", "contact_wall"] {
        let all = setup(state(&[GRAIN]), vec![wet(kind, &[("contact_angle", 1.6.into())])], Bounds::default(), 1e-3);
        match motes::Simulation::on(motes::Cpu::new(1).expect("one"), &all).map(|_| ()) {
            Err(Error::Setting { key, why }) => assert!(key == "contact_angle" && why.contains("1.6"), "{why}"),
            other => panic!("{other:?}"),
        }
    }
}
