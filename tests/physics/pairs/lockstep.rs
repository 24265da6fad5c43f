//! The device against the references, kernel by kernel; particles that are fixed or not active keep their columns.

use std::collections::BTreeSet;

use motes::forces::Component;
use motes::kernel::{Array, Backend, Column};
use motes::life::Life;
use motes::lockstep::compare;
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::{Setup, Simulation};

use crate::pairs::{by_references, column, setup};
use crate::support::columns::{Bodies, Columned, Grouped, give};
use crate::support::machines::gpu;
use crate::support::states::{force, integrator, word};

fn forces() -> Vec<Box<dyn Component>> {
    let harmonic = force("attractor", &[("profile", word("harmonic")), ("strength", Value::Number(0.7))]);
    vec![Box::new(Columned), Box::new(Bodies { field: true }), Box::new(Grouped), harmonic]
}

fn columns() -> Vec<Column> {
    forces().iter().flat_map(|force| force.columns()).collect()
}

/// Every seventh is fixed, and as many do not live, where the integrator continues then.
fn scene(count: usize, name: &str) -> Setup {
    let mut particles = crate::support::cloud(count, 11);
    particles.links = motes::links::Links::default();
    if count > 7 {
        let fixed = (0..count as u32).filter(|id| id % 7 == 3);
        particles.held = fixed.map(|id| Held { id, by: Hold::Fixed }).collect();
    }
    if count > 7 && !integrator(name).is_implicit() {
        let life: Vec<Life> = (0..count).map(|id| if id % 7 == 5 { Life::Removed } else { Life::Active }).collect();
        particles.set_lives(&life).expect("one for each");
    }
    give(&mut particles, &columns(), 17);
    setup(&particles, forces(), name, 0.07)
}

#[test]
fn kernels_agree_with_their_references() {
    let shared = crate::support::device();
    let mut seen = BTreeSet::new();
    for name in ["leapfrog", "rk4", "backward_euler", "implicit_midpoint", "trapezoid"] {
        for count in [1, 63, 65, 300] {
            let setup = scene(count, name);
            let mut simulation = Simulation::on(gpu(&shared, count), &setup).expect("a simulation");
            simulation.step(2).expect("steps");
            let plans = setup.plans(simulation.backend().machine()).expect("plans");
            for plan in plans.all() {
                let verdicts = pollster::block_on(compare(simulation.backend(), plan, count as u32)).expect("verdicts");
                for verdict in verdicts {
                    assert!(verdict.sound(), "{name}, {count}: {verdict:?}");
                    if verdict.changed {
                        seen.insert(verdict.kernel);
                    }
                }
            }
            pollster::block_on(simulation.check()).expect("numbers");
        }
    }
    for kernel in [
        "kick charge FACTOR=0.5",
        "kick spin FACTOR=0.5",
        "kick dose FACTOR=0.5",
        "kick orientation FACTOR=0.5",
        "drift angle",
        "drift grip",
        "drift reservoir",
        "drift orientation",
        "carry tracer",
        "clear couple",
        "clear leak",
        "clear torque",
        "rk_save angle",
        "rk_save reservoir",
        "rk_finish grip WEIGHT=0.166667",
        "rk_stage dose WEIGHT=0.333333 FACTOR=0.5",
        "rk_stage orientation WEIGHT=0.166667 FACTOR=0.5",
        "rk_finish charge WEIGHT=0.166667",
        "slopes orientation",
        "unit orientation",
        "keep leak",
        "restore couple",
    ] {
        assert!(seen.contains(kernel), "{kernel} changes nothing, of {seen:?}");
    }
}

#[test]
fn fixed_and_inactive_particles_keep_their_columns() {
    for name in ["leapfrog", "forward_euler", "rk4", "heun", "implicit_midpoint"] {
        let setup = scene(40, name);
        let mut simulation = by_references(&setup);
        let states = ["charge", "angle", "spin", "tracer", "orientation", "angular_velocity"];
        let all = |simulation: &mut Simulation<_>| states.map(|name| column(simulation, name));
        let before = all(&mut simulation);
        simulation.step(3).expect("steps");
        for ((now, then), name_of) in all(&mut simulation).into_iter().zip(before).zip(states) {
            for id in 0..40 {
                let same = match (&now, &then) {
                    (Array::Float(now), Array::Float(then)) => now[id].to_bits() == then[id].to_bits(),
                    // The last component of `spin` is what a law says.
                    (Array::Vec4(now), Array::Vec4(then)) if name_of == "spin" => {
                        now[id].truncate() == then[id].truncate()
                    }
                    (Array::Vec4(now), Array::Vec4(then)) => now[id] == then[id],
                    other => panic!("{other:?}"),
                };
                let keeps = id % 7 == 3 || id % 7 == 5 && !integrator(name).is_implicit();
                assert_eq!(same, keeps, "{name}: {name_of} of {id}");
            }
        }
    }
}

/// A measurement between two steps changes no bit, on a device.
#[test]
fn measuring_leaves_no_trace() {
    let shared = crate::support::device();
    for name in ["leapfrog", "rk4"] {
        let setup = scene(65, name);
        let run = |measured: bool| {
            let mut simulation = Simulation::on(gpu(&shared, 65), &setup).expect("a simulation");
            for _ in 0..3 {
                simulation.step(1).expect("a step");
                if measured {
                    pollster::block_on(simulation.snapshot()).expect("a state");
                }
            }
            let gpu = simulation.backend();
            ["charge", "angle", "spin", "tracer", "orientation", "angular_velocity"]
                .map(|name| pollster::block_on(gpu.bytes(name, 0, gpu.size(name))).expect("a column"))
        };
        assert!(run(true) == run(false), "{name}");
    }
}

/// What is NaN is reported with its particle.
#[test]
fn columns_that_are_no_numbers_are_reported() {
    let shared = crate::support::device();
    for (name, value) in [("charge", f64::NAN), ("spin", f64::INFINITY)] {
        let setup = scene(65, "leapfrog");
        let mut device = Simulation::on(gpu(&shared, 65), &setup).expect("a simulation");
        let mut host = by_references(&setup);
        let broken = match column(&mut host, name) {
            Array::Float(mut all) => {
                all[42] = value;
                Array::Float(all)
            }
            Array::Vec4(mut all) => {
                all[42].y = value;
                Array::Vec4(all)
            }
            other => panic!("{other:?}"),
        };
        device.backend().write(name, &broken).expect("a column");
        host.backend().write(name, &broken).expect("a column");
        device.step(1).expect("a step");
        host.step(1).expect("a step");
        let found = [pollster::block_on(device.check()), pollster::block_on(host.check())];
        for found in found {
            assert!(matches!(found, Err(motes::Error::NotFinite { particle: 42, .. })), "{name}: {found:?}");
        }
    }
}
