//! Same run, same bits: reruns, batches, cut submissions, a caller's encoder and measurements change no byte.

use std::time::Duration;

use crate::support::Shared;
use crate::support::states::{force, integrator, vector};
use motes::forces::Component;
use motes::integrators::INTEGRATORS;
use motes::kernel::{ACCELERATION, Backend, POSITION, VELOCITY};
use motes::settings::Value;
use motes::{Cpu, Gpu, Setup, Simulation};

const COUNT: u32 = 300;
const STEPS: u32 = 30;

/// All forces, everywhere, at every velocity and time.
fn forces() -> Vec<Box<dyn Component>> {
    vec![
        force("gravity", &[("softening", Value::Number(0.17))]),
        force(
            "wind",
            &[("velocity", vector(0.6, 0.2, -0.3)), ("gust", Value::Number(0.7)), ("rate", Value::Number(0.4))],
        ),
        force("drag", &[("linear", Value::Number(0.3)), ("quadratic", Value::Number(0.2))]),
    ]
}

fn setup(name: &str) -> Setup {
    Setup {
        state: crate::support::cloud(COUNT as usize, 5),
        forces: forces(),
        integrator: integrator(name),
        dt: 0.013,
        bounds: motes::Bounds::default(),
        solver: motes::Solver::default(),
    }
}

fn simulation(shared: &Shared, name: &str) -> Simulation<Gpu> {
    Simulation::new(&shared.found.device, &shared.found.queue, &setup(name)).expect("a simulation")
}

/// All that a step leaves for the next one.
fn bytes<B: Backend>(simulation: &mut Simulation<B>) -> Vec<u8> {
    pollster::block_on(async {
        let mut all = Vec::new();
        for field in [POSITION, VELOCITY, ACCELERATION] {
            all.extend_from_slice(bytemuck::cast_slice(&simulation.read(field).await.expect("a field")));
        }
        all
    })
}

/// The same, all 53 bits of the references.
fn wide(simulation: &mut Simulation<Cpu>) -> String {
    let host = simulation.backend().host();
    let fields = [POSITION, VELOCITY, ACCELERATION].map(|field| host.get(field.name).expect("a field"));
    // Debug prints as many digits as read back to the same bits.
    format!("{fields:?}")
}

#[test]
fn the_same_run_twice_and_in_any_batches() {
    let shared = crate::support::device();
    for entry in INTEGRATORS {
        let mut whole = simulation(&shared, entry.name);
        let start = bytes(&mut whole);
        whole.step(STEPS).expect("steps");
        let want = bytes(&mut whole);
        assert_ne!(start, want, "{}: nothing happens", entry.name);

        let mut again = simulation(&shared, entry.name);
        again.step(STEPS).expect("steps");
        assert!(bytes(&mut again) == want, "{}: a rerun differs", entry.name);

        let mut single = simulation(&shared, entry.name);
        for _ in 0..STEPS {
            single.step(1).expect("a step");
        }
        assert!(bytes(&mut single) == want, "{}: single steps differ", entry.name);
        assert!(single.step(0).is_ok() && bytes(&mut single) == want, "{}: no steps are some", entry.name);
    }
}

#[test]
fn the_same_in_many_submissions() {
    let shared = crate::support::device();
    for entry in INTEGRATORS {
        let mut whole = simulation(&shared, entry.name);
        whole.step(STEPS).expect("steps");
        let want = bytes(&mut whole);

        let mut cut = simulation(&shared, entry.name);
        cut.backend().limit_submissions(Duration::from_nanos(1), Duration::from_mins(1));
        // The first submissions teach the queue how little fits.
        for _ in 0..5 {
            cut.step(1).expect("a step");
            cut.backend().wait().expect("an answer");
        }
        let before = cut.backend().submissions();
        cut.step(STEPS - 5).expect("steps");
        let submissions = cut.backend().submissions() - before;
        assert!(submissions > 2 * u64::from(STEPS), "{}: {submissions} submissions are not many", entry.name);
        assert!(bytes(&mut cut) == want, "{}: {submissions} submissions differ from one", entry.name);
        // Twelve iterations of seven evaluations are many dispatches.
        let few = if entry.by_default().estimates_error() { before } else { 5 };
        assert!(whole.backend().submissions() < few, "and one is one");
    }
}

#[test]
fn the_same_in_a_callers_encoder() {
    let shared = crate::support::device();
    for entry in INTEGRATORS {
        let mut whole = simulation(&shared, entry.name);
        whole.step(STEPS).expect("steps");
        let want = bytes(&mut whole);

        let mut encoded = simulation(&shared, entry.name);
        for steps in [7, 1, STEPS - 8] {
            let mut encoder =
                shared.found.device.create_command_encoder(&motes::wgpu::CommandEncoderDescriptor::default());
            encoded.encode(steps, &mut encoder).expect("few steps");
            shared.found.queue.submit([encoder.finish()]);
        }
        assert_eq!(encoded.steps(), u64::from(STEPS));
        assert!(bytes(&mut encoded) == want, "{}: steps in a caller's encoder differ", entry.name);
        let clock = pollster::block_on(encoded.backend().world()).expect("a clock");
        assert_eq!(clock.step, STEPS, "{}: the clock is on the device", entry.name);
    }
}

#[test]
fn a_measurement_leaves_no_trace() {
    let shared = crate::support::device();
    for entry in INTEGRATORS {
        let mut whole = simulation(&shared, entry.name);
        whole.step(STEPS).expect("steps");
        let want = bytes(&mut whole);

        let mut measured = simulation(&shared, entry.name);
        for steps in [0, 3, 1, STEPS - 4] {
            measured.step(steps).expect("steps");
            let before = bytes(&mut measured);
            let snapshot = pollster::block_on(measured.snapshot()).expect("a snapshot");
            assert_eq!(snapshot.len(), COUNT as usize);
            assert!(snapshot.energies().expect("energies").iter().sum::<f64>() < 0.0, "gravity binds");
            assert!(bytes(&mut measured) == before, "{}: a snapshot changes the state", entry.name);
        }
        assert!(bytes(&mut measured) == want, "{}: snapshots change the run", entry.name);
    }
}

#[test]
fn the_references_likewise() {
    for entry in INTEGRATORS {
        let fresh = || Simulation::on(Cpu::new(COUNT).expect("some"), &setup(entry.name)).expect("a simulation");
        let (mut whole, mut again, mut measured) = (fresh(), fresh(), fresh());
        whole.step(8).expect("steps");
        for _ in 0..8 {
            again.step(1).expect("a step");
            measured.step(1).expect("a step");
            pollster::block_on(measured.snapshot()).expect("a snapshot");
        }
        let want = wide(&mut whole);
        assert!(wide(&mut again) == want, "{}: single steps differ", entry.name);
        assert!(wide(&mut measured) == want, "{}: snapshots change the run", entry.name);
    }
}

/// Forces are added in the order of their list: another order is the same sum, differently rounded.
#[test]
fn the_order_of_forces_changes_only_rounding() {
    let shared = crate::support::device();
    let run = |order: [usize; 3]| {
        let mut all: Vec<_> = forces().into_iter().map(Some).collect();
        let forces = order.iter().filter_map(|i| all[*i].take()).collect();
        let setup = Setup { forces, ..setup("leapfrog") };
        let mut simulation = Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation");
        simulation.step(1).expect("a step");
        pollster::block_on(simulation.read(ACCELERATION)).expect("accelerations")
    };
    let want = run([0, 1, 2]);
    for order in [[2, 1, 0], [1, 2, 0]] {
        for (a, b) in run(order).into_iter().zip(&want) {
            // Three additions of numbers that are about as large as the sum, here and in the kick and drift before: 10 ulp.
            let allowed = 10.0 * f32::EPSILON * b.length().max(1.0);
            assert!((a - *b).length() <= allowed, "{order:?}: {a} was {b}");
        }
    }
}
