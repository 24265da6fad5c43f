//! Every kernel against its f64 reference, in lockstep: each law alone, each integrator whole, at sizes around the workgroup's.

mod dispatches;
mod two_words;

use std::fmt::Display;

use crate::support::machines::{self, alone, gpu};
use crate::support::states::{force, integrator};
use crate::support::{agrees, choices};
use motes::forces::Stage;
use motes::gpu::Gpu;
use motes::integrators::{INTEGRATORS, Precise, Step};
use motes::kernel::{ACCELERATION, Backend, POSITION, Plan, Precision, VELOCITY};
use motes::lockstep::{Verdict, compare};
use motes::{Setup, Simulation, forces};

const SIZES: [usize; 6] = [1, 2, 63, 64, 65, 1000];
/// Large, so that what is wrong in a step shows.
const DT: f64 = 0.37;

fn setup(count: usize, forces: Vec<Box<dyn forces::Component>>, name: &str) -> Setup {
    Setup {
        state: crate::support::cloud(count, 7),
        forces,
        integrator: integrator(name),
        dt: DT,
        bounds: motes::Bounds::default(),
        solver: motes::Solver::default(),
    }
}

/// A cloud a few steps on its way, so that the clock and all fields hold something.
fn moving(gpu: Gpu, count: usize, forces: Vec<Box<dyn forces::Component>>, name: &str) -> Simulation<Gpu> {
    let mut simulation = Simulation::on(gpu, &setup(count, forces, name)).expect("a simulation");
    simulation.step(3).expect("three steps");
    simulation
}

fn verdicts(gpu: &mut Gpu, plan: &Plan, count: usize, of: &impl Display) -> Vec<Verdict> {
    let count = u32::try_from(count).expect("few");
    let verdicts = pollster::block_on(compare(gpu, plan, count)).unwrap_or_else(|e| panic!("{of}, {count}: {e}"));
    assert!(!verdicts.is_empty(), "{of}: nothing was compared");
    verdicts
}

/// All good, and each kernel changes something; `idle` says which ones may not.
fn judge(verdicts: &[Verdict], count: usize, of: &impl Display, idle: impl Fn(&Verdict) -> bool) {
    for verdict in verdicts {
        assert!(agrees(verdict), "{of}, {count} particles: {verdict:?}");
        assert!(verdict.changed || idle(verdict), "{of}, {count} particles: changes nothing: {verdict:?}");
    }
}

/// What an earlier step left in the fields that a step only uses.
fn fill(gpu: &mut Gpu, plan: &Plan, count: usize) {
    let kept = ["world", "alarm", POSITION.name, VELOCITY.name];
    let filled = |name: &&String| !kept.contains(&name.as_str()) && plan.table(name).is_none();
    for name in plan.fields(u32::try_from(count).expect("few")).keys().filter(filled) {
        let words = vec![0.7f32; usize::try_from(gpu.size(name) / 4).expect("small")];
        gpu.write_bytes(name, 0, bytemuck::cast_slice(&words)).expect("a field");
    }
}

#[test]
fn every_law_alone() {
    let shared = crate::support::device();
    for (turn, entry) in choices::entries().enumerate() {
        for variant in 0..choices::forces(entry).len() {
            let pick = || choices::forces(entry).swap_remove(variant);
            let overs: Vec<_> = pick().1.laws().iter().map(|law| law.over).collect();
            let meet = overs.is_empty() || overs.iter().any(|over| *over != forces::Over::Each);
            let pairs = overs.contains(&forces::Over::Pairs);
            let plain = [("as it is", gpu(&shared, 1).machine())].to_vec();
            let all = if pairs { machines::machines(&shared) } else { plain };
            let count_of_machines = all.len();
            for (place, (machine_name, machine)) in all.into_iter().enumerate() {
                // How a visit divides particles is the same for every law: one law has all sizes on all machines, the others on one of them, by turns.
                let whole = entry.name == "gravity" || !pairs || place == turn % count_of_machines;
                let sizes = if whole { &SIZES[..] } else { &[1, 65] };
                // Three blocks and a half: layers of unequal length; or one more than 65 536, if none may be next to a line.
                for count in sizes.iter().copied().chain([if meet { 333 } else { 65_537 }]) {
                    let (name, law) = pick();
                    let of = format!("{name}, {machine_name}");
                    let mut gpu = gpu(&shared, count);
                    gpu.pretend(machine);
                    // The integrator that needs the fewest pipelines.
                    let mut simulation = moving(gpu, count, vec![law], "symplectic_euler");
                    let law = [pick().1];
                    let cloud = crate::support::cloud(count, 7);
                    // A list has as much room as that of the simulation.
                    let list =
                        setup(count, vec![pick().1], "symplectic_euler").problem(machine).expect("a problem").list;
                    let problem = forces::Problem::new(simulation.count(), machine)
                        .listed(list)
                        .at(cloud.position(), motes::Bounds::default())
                        .of_species(cloud.species())
                        .tied(&cloud.links, &cloud.held);
                    let mut step = Step::new(&law, problem.clone());
                    step.evaluate();
                    let mut plan = step.finished().expect("a plan");
                    // Back to where they began: repulsion leaves no pairs in range, and what brakes in steps as long
                    // as these throws them away.
                    let places = cloud.position().iter().zip(cloud.mass()).map(|(x, m)| x.extend(*m).as_vec4());
                    simulation.write(POSITION, &places.collect::<Vec<_>>()).expect("places");
                    let ways = cloud.velocity().iter().zip(cloud.size()).map(|(v, r)| v.extend(*r).as_vec4());
                    simulation.write(VELOCITY, &ways.collect::<Vec<_>>()).expect("velocities");
                    let laws = plan.ops.len();
                    law[0].stage(Stage::AfterKick, &mut plan, &problem).expect("limits");
                    law[0].stage(Stage::AfterDrift { factor: 0.8 }, &mut plan, &problem).expect("places");
                    if plan.ops.len() > laws {
                        // Faster than the limit has left them, and back to where a solid has turned them away.
                        let mut velocity = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
                        for v in &mut velocity {
                            *v *= glam::Vec4::splat(-2.3).with_w(1.0);
                        }
                        simulation.write(VELOCITY, &velocity).expect("velocities");
                    }
                    // Alone in the world, nothing attracts; a few may be too far, or of other species.
                    let idle = |v: &Verdict| {
                        v.field == "alarm" || v.kernel == "clear" || if pairs { count == 1 } else { count < 333 }
                    };
                    judge(&verdicts(simulation.backend(), &plan, count, &of), count, &of, idle);
                }
            }
        }
    }
}

#[test]
fn every_integrator_whole() {
    let shared = crate::support::device();
    for entry in INTEGRATORS {
        for count in SIZES {
            let forces = || vec![force("uniform", &[]), force("wind", &[]), force("attractor", &[])];
            let gpu = gpu(&shared, count);
            let machine = gpu.machine();
            let mut simulation = moving(gpu, count, forces(), entry.name);
            let setup = Setup {
                state: crate::support::cloud(count, 7),
                forces: forces(),
                integrator: entry.by_default(),
                dt: DT,
                bounds: motes::Bounds::default(),
                solver: motes::Solver::default(),
            };
            let plans = setup.plans(machine).expect("plans");
            fill(simulation.backend(), &plans.step, count);
            // Nothing is broken here, so the watch raises no alarm: it has a test of its own. And the midpoint rule's
            // first slopes weigh nothing.
            // Where nothing is linked, and a solve settles at once, later kernels of it have nothing to do: cloth has a test.
            let solve = ["begin", "product", "advance", "update", "reach", "report"];
            let idle = |v: &Verdict| {
                let weightless = v.kernel.contains(" WEIGHT=0 ") && v.field.starts_with("slope");
                let settled = entry.by_default().is_implicit() && solve.iter().any(|name| v.kernel.starts_with(name));
                // Where accelerations settle at once, or without neighbours: the fields of gauss_radau have tests of their own.
                let along =
                    v.field.starts_with("radau_") || v.field == "acceleration_differences" || v.field == "step_start";
                v.field == "alarm" || weightless || settled || along
            };
            let mut all = verdicts(simulation.backend(), &plans.step, count, &entry.name);
            // Differences of accelerations that are nearly the same are known as well as these are: tests/physics/radau.rs allows for that.
            all.retain(|v| v.field != "acceleration_differences" && !v.field.starts_with("radau_"));
            judge(&all, count, &entry.name, idle);
        }
    }
}

#[test]
fn integrators_in_two_words() {
    let shared = crate::support::device();
    for name in ["forward_euler", "symplectic_euler", "leapfrog", "forest_ruth", "pefrl"] {
        for count in SIZES {
            let integrator = Precise { integrator: integrator(name), precision: Precision::Compensated };
            let forces = vec![force("wind", &[]), force("attractor", &[])];
            let setup = Setup { integrator: Box::new(integrator), dt: 0.001_7, ..setup(count, forces, name) };
            let gpu = gpu(&shared, count);
            let plan = setup.plans(gpu.machine()).expect("plans").step;
            let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
            simulation.step(3).expect("three steps");
            let idle = |v: &Verdict| v.field == "alarm";
            judge(&verdicts(simulation.backend(), &plan, count, &name), count, &name, idle);
        }
    }
}

#[test]
fn what_surrounds_a_measurement() {
    let shared = crate::support::device();
    for count in SIZES {
        let forces = || vec![force("uniform", &[]), force("drag", &[("linear", motes::settings::Value::Number(0.3))])];
        let gpu = gpu(&shared, count);
        let machine = gpu.machine();
        let mut simulation = moving(gpu, count, forces(), "leapfrog");
        let setup = Setup {
            state: crate::support::cloud(count, 7),
            forces: forces(),
            integrator: integrator("leapfrog"),
            dt: DT,
            bounds: motes::Bounds::default(),
            solver: motes::Solver::default(),
        };
        let (before, after) = setup.plans(machine).expect("plans").measure;
        judge(&verdicts(simulation.backend(), &before, count, &"before"), count, &"before", |_| false);
        simulation.write(ACCELERATION, &vec![glam::Vec4::splat(0.7); count]).expect("another acceleration");
        judge(&verdicts(simulation.backend(), &after, count, &"after"), count, &"after", |_| false);
    }
}

#[test]
fn the_watch_sees_what_is_broken() {
    let shared = crate::support::device();
    let broken = [f32::NAN, f32::from_bits(0x7fc0_0001), f32::from_bits(0xff80_0001), f32::INFINITY, f32::NEG_INFINITY];
    for count in [2usize, 65, 1000] {
        for (case, bad) in broken.into_iter().enumerate() {
            let mut simulation = moving(gpu(&shared, count), count, vec![force("uniform", &[])], "symplectic_euler");
            let setup = Setup {
                state: crate::support::cloud(count, 7),
                forces: vec![force("uniform", &[])],
                integrator: integrator("symplectic_euler"),
                dt: DT,
                bounds: motes::Bounds::default(),
                solver: motes::Solver::default(),
            };
            let machine = simulation.backend().machine();
            let plan = setup.plans(machine).expect("plans").step;
            let watch = plan.kernels.into_iter().find(|k| k.name == "watch").expect("a watch");
            let id = count - 1 - case.min(count - 1);
            let place = case % 4;
            let field = [POSITION, VELOCITY, ACCELERATION][case % 3];
            let mut values = pollster::block_on(simulation.read(field)).expect("a field");
            values[id][place] = bad;
            // `Simulation::write` would refuse it.
            let bits = bytemuck::cast_slice(&values);
            simulation.backend().write_bytes(field.name, 0, bits).expect("a field");
            judge(&verdicts(simulation.backend(), &alone(watch), count, &"watch"), count, &"watch", |_| false);
            match pollster::block_on(simulation.check()) {
                Err(motes::Error::NotFinite { particle, step: 3 }) => assert_eq!(particle as usize, id),
                other => panic!("{bad} in particle {id}: {other:?}"),
            }
        }
    }
}
