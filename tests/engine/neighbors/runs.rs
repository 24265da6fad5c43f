//! Runs: the same bits in any batches, one cell list for all its searches, and no image missed on the way out of the box.

use glam::{DVec3, Vec4};
use motes::forces::{Component, Over, Problem};
use motes::integrators::{INTEGRATORS, Step};
use motes::kernel::{Backend, Machine};
use motes::lockstep::{Verdict, compare};
use motes::{Bounds, Gpu, POSITION, Setup, Side, Simulation, VELOCITY};

use crate::neighbors::Curious;
use crate::support::states::integrator;
use crate::support::{self, Shared, machines};

const COUNT: usize = 300;

fn periodic() -> Bounds {
    let sides = [Side::Periodic, Side::Periodic, Side::Open];
    Bounds { low: DVec3::splat(-1.0), high: DVec3::splat(1.0), sides, dimensions: 3 }
}

fn setup(overs: &[Over], bounds: Bounds, name: &str, dt: f64) -> Setup {
    let mut particles = support::cloud(COUNT, 8);
    particles.mass_mut().iter_mut().for_each(|mass| *mass = 0.3);
    let forces = overs.iter().map(|over| Box::new(Curious(*over)) as Box<dyn Component>).collect();
    Setup { state: particles, forces, integrator: integrator(name), dt, bounds, solver: motes::Solver::default() }
}

fn run(shared: &Shared, setup: &Setup, batches: &[u32], scratch: bool) -> Vec<u8> {
    let mut simulation = Simulation::on(machines::gpu(shared, COUNT), setup).expect("a simulation");
    if scratch {
        // What another run left where a grid puts things down.
        for name in ["keys", "arrivals", "slots", "sorted_id of 0.4", "sorted_position of 0.4", "starts of 0.4"] {
            let size = usize::try_from(simulation.backend().size(name)).expect("small");
            simulation.backend().write_bytes(name, 0, &vec![0xA7; size]).expect("a field");
        }
    }
    for steps in batches {
        simulation.step(*steps).expect("steps");
    }
    pollster::block_on(simulation.check()).expect("no alarm");
    let fields = [POSITION, VELOCITY].map(|field| pollster::block_on(simulation.read(field)).expect("a field"));
    fields.iter().flat_map(|field| bytemuck::cast_slice::<Vec4, u8>(field)).copied().collect()
}

#[test]
fn the_same_bits_in_any_batches() {
    let shared = support::device();
    let near = |range| Over::Near { range, of: None };
    for overs in [vec![near(0.4), near(0.25), near(0.4)], vec![near(0.4), Over::Nearest { count: 7 }]] {
        for bounds in [Bounds::default(), periodic()] {
            let setup = setup(&overs, bounds, "leapfrog", 2e-3);
            let whole = run(&shared, &setup, &[100], false);
            assert!(whole != run(&shared, &setup, &[0], false), "nothing happens");
            assert!(whole == run(&shared, &setup, &[100], false), "{overs:?}, {bounds}: a rerun differs");
            assert!(whole == run(&shared, &setup, &[1; 100], false), "{overs:?}, {bounds}: single steps differ");
            assert!(whole == run(&shared, &setup, &[37, 63], true), "{overs:?}, {bounds}: old numbers matter");
        }
    }
}

#[test]
fn a_cell_list_is_built_once_for_all_its_searches() {
    let machine = Machine { software: false, subgroup: 0, invocations: 1 << 18, ..Machine::HOST };
    let near = |range, of| Over::Near { range, of };
    let overs = [near(0.4, None), near(0.25, None), near(0.4, None), Over::Nearest { count: 7 }, near(0.4, Some(1))];
    let setup = setup(&overs, periodic(), "rk4", 1e-3);
    let mut step = Step::new(&setup.forces, Problem::new(300, machine).at(setup.state.position(), setup.bounds));
    step.evaluate();
    let plan = step.finished().expect("a plan");
    let names: Vec<_> = plan.steps().map(|kernel| kernel.name.clone()).collect();
    let built = |of: &str| names.iter().filter(|name| name.starts_with(&format!("grid RANGE={of} CELLS"))).count();
    for of in ["0.4", "0.25", "0.4 species 1", &format!("cells of {:?}", 7.0 / 3.0)] {
        assert_eq!(built(of), 1, "{of}: {plan}");
    }
    assert_eq!(names.iter().filter(|name| name.starts_with("grid")).count(), 4, "{plan}");
    // Two evaluations are two times four, of the same kernels.
    let plans = setup.plans(machine).expect("plans");
    let grids = plans.step.steps().filter(|kernel| kernel.name.starts_with("grid")).count();
    assert_eq!(grids, 16, "{}", plans.step);
    assert_eq!(plans.step.kernels.iter().filter(|kernel| kernel.name.starts_with("grid")).count(), 4);
}

#[test]
fn every_stage_of_every_integrator_agrees_with_brute_force() {
    let shared = support::device();
    for entry in INTEGRATORS {
        for over in [Over::Near { range: 0.4, of: None }, Over::Nearest { count: 5 }] {
            // A long step: stages, and drifts before particles are brought back, leave the box.
            let setup = setup(&[over], periodic(), entry.name, 0.9);
            let gpu: Gpu = machines::gpu(&shared, COUNT);
            let plan = setup.plans(gpu.machine()).expect("plans").step;
            let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
            simulation.step(1).expect("a step");
            let verdicts = pollster::block_on(compare(simulation.backend(), &plan, 300)).expect("a comparison");
            // Along so long a step differences do not settle, and places far from the box are rounded: they have tests of their own.
            let own = ["begin along nodes", "node", "measure", "end along nodes"];
            let settles = |verdict: &&Verdict| !own.iter().any(|name| verdict.kernel.starts_with(name));
            for verdict in verdicts.iter().filter(settles) {
                assert!(verdict.good(), "{}, {over:?}: {verdict:?}", entry.name);
            }
        }
    }
}
