//! Conjugate gradients on the device against those of a textbook in f64, and what the device says of them.

use std::sync::Arc;

use glam::{DVec3, Vec4};
use motes::forces::{Component, Jacobian, Law};
use motes::kernel::{Array, Backend, Source};
use motes::simulation::{Outcome, Solves};
use motes::{ACCELERATION, Gpu, POSITION, Simulation, Solver, State};

use crate::implicit::cloth::{System, cloth};
use crate::implicit::{on_device, on_references, phase, setup};
use crate::support::states::{force, vector};
use crate::support::{self, Shared};

/// A frame of a film.
const H: f64 = 1.0 / 60.0;

fn forces() -> Vec<Box<dyn Component>> {
    vec![force("uniform", &[("acceleration", vector(0.0, 0.0, -9.81))]), force("spring", &[])]
}

fn report<B: Backend>(simulation: &mut Simulation<B>) -> Solves {
    pollster::block_on(simulation.solves()).expect("a report").expect("there are solves")
}

/// Three vectors of a struct, or one of a plain field, for each particle.
fn vectors(simulation: &mut Simulation<Gpu>, name: &str, particles: usize, parts: usize, part: usize) -> Vec<DVec3> {
    let like = Array::Vec4(Vec::new());
    let read = pollster::block_on(simulation.backend().read(name, &like, particles * parts));
    let Ok(Array::Vec4(all)) = read else { panic!("there is a field {name}") };
    all.chunks_exact(parts).map(|one| one[part].truncate()).collect()
}

/// One linear step of a cloth: the device's report, and what the textbook makes of the same system.
fn step(shared: &Shared, particles: &State, solver: Solver) -> (Solves, usize, f64) {
    let count = particles.len();
    let setup = setup(particles, forces(), "linear_backward_euler", H, solver);
    let mut simulation = on_device(shared, &setup);
    simulation.step(1).expect("a step");
    // The right-hand side as the device has it: forces of stiff springs round by more than the tolerance.
    let a = pollster::block_on(simulation.read(ACCELERATION)).expect("accelerations");
    let due = |(a, m): (&Vec4, &f64)| H * m * a.truncate().as_dvec3();
    let b: Vec<DVec3> = a.iter().zip(particles.mass()).map(due).collect();
    let y = vectors(&mut simulation, "directions", count, 3, 2);
    let system = System { particles, h: H, exact: false };
    let iterations = system.iterations(&b, solver.tolerance, 2000).expect("the matrix is positive");
    (report(&mut simulation), iterations, system.residual(&b, &y))
}

#[test]
fn iterations_and_residuals_are_those_of_f64() {
    let shared = support::device();
    for n in [32, 64] {
        for ratio in [1.0, 10.0, 100.0, 1000.0, 10_000.0] {
            let particles = cloth(n, ratio * 0.25 / (H * H));
            let solver = Solver { tolerance: 1e-3, iterations: 60, solves: 1 };
            let (report, want, truth) = step(&shared, &particles, solver);
            let of = format!("n = {n}, h² k / m = {ratio}: {report:?}, f64 {want}, true residual {truth:e}");
            assert_eq!(report.outcome, Outcome::Converged, "{of}");
            assert!(want > 5 && report.iterations.abs_diff(u32::try_from(want).expect("few")) <= 3, "{of}");
            assert!(report.residual <= 1e-3 && (truth / report.residual - 1.0).abs() < 0.02, "{of}");
        }
    }
}

/// Down to where single precision ends: the product rounds to parts of 6e-8, a few of which add up.
#[test]
fn small_residuals_are_true() {
    let shared = support::device();
    for (ratio, iterations) in [(1.0, 40), (100.0, 300)] {
        for tolerance in [1e-4, 1e-5, 1e-6] {
            let particles = cloth(32, ratio * 0.25 / (H * H));
            let (report, want, truth) = step(&shared, &particles, Solver { tolerance, iterations, solves: 1 });
            let of = format!("h² k / m = {ratio}, {tolerance}: {report:?}, f64 {want}, true residual {truth:e}");
            assert_eq!(report.outcome, Outcome::Converged, "{of}");
            assert!((truth - report.residual).abs() < 0.02 * report.residual + 6e-7, "{of}");
        }
    }
}

#[test]
fn what_does_not_converge_says_so() {
    let shared = support::device();
    let particles = cloth(32, 1000.0 * 0.25 / (H * H));
    let solver = Solver { tolerance: 1e-4, iterations: 7, solves: 1 };
    for name in ["linear_backward_euler", "backward_euler"] {
        let setup = setup(&particles, forces(), name, H, solver);
        let (mut device, mut references) = (on_device(&shared, &setup), on_references(&setup));
        device.step(3).expect("steps");
        references.step(3).expect("steps");
        for report in [report(&mut device), report(&mut references)] {
            assert_eq!((report.solves, report.failures, report.first_failure), (3, 3, Some(0)), "{name}: {report:?}");
            assert_eq!((report.outcome, report.iterations, report.most_iterations), (Outcome::RanOut, 7, 7), "{name}");
            assert!(report.residual > 1e-4 && report.residual.is_finite(), "{name}: {report:?}");
        }
    }
    // Explicit integrators solve nothing.
    let mut simulation = on_device(&shared, &setup(&particles, forces(), "leapfrog", 1e-4, solver));
    simulation.step(1).expect("a step");
    assert_eq!(pollster::block_on(simulation.solves()).expect("an answer"), None);
}

/// Newton's method on the cloth: more solves leave less, and fixed particles do not move by a bit.
#[test]
fn newton_converges_on_a_cloth() {
    let shared = support::device();
    let particles = cloth(16, 10.0 * 0.25 / (H * H));
    let mut left = Vec::new();
    for solves in [1, 2, 12] {
        let solver = Solver { tolerance: 1e-3, iterations: 60, solves };
        let mut simulation = on_device(&shared, &setup(&particles, forces(), "backward_euler", H, solver));
        let before = [0, 15].map(|id| phase(&mut simulation, id));
        simulation.step(5).expect("steps");
        assert_eq!([0, 15].map(|id| phase(&mut simulation, id)), before, "the held ones move");
        let report = report(&mut simulation);
        left.push(report.residual);
        assert_eq!(report.outcome == Outcome::Converged, report.residual <= 1e-3, "{report:?}");
        if solves == 12 {
            assert_eq!(report.failures, 0, "{report:?}");
        }
        // The one without links falls as backward Euler has it.
        let (_, v) = phase(&mut simulation, particles.len() - 1);
        let want = 0.3 - 9.81 * 5.0 * H;
        assert!((v.z - want).abs() < 1e-6, "{v} should fall by {want}");
    }
    assert!(left[0] > 3.0 * left[1] && left[1] > left[2], "{left:?}");
}

/// A spring whose Jacobian is exact, as it should not be.
#[derive(Clone)]
struct Exact;

impl Component for Exact {
    fn laws(&self) -> Vec<Law> {
        let law = force("spring", &[]).laws().swap_remove(0);
        let text = law.wgsl.text.replace("max(0.0, 1.0 - abs(link.rest) * inverse)", "1.0 - abs(link.rest) * inverse");
        assert_ne!(text, law.wgsl.text, "the spring has another formula now");
        let jacobian = Jacobian::Links(Arc::new(|_, _, r, link, dx, _| {
            let (t, u) = (1.0 - link.rest / r.length(), r.normalize());
            link.stiffness * (t * dx + (1.0 - t) * u.dot(dx) * u)
        }));
        vec![Law { wgsl: Source::ours("exact_spring", text.leak()), jacobian: Some(jacobian), ..law }]
    }
}

#[test]
fn without_its_clamp_the_matrix_is_not_positive() {
    let shared = support::device();
    let particles = cloth(32, 100.0 * 0.25 / (H * H));
    let gravity = || force("uniform", &[("acceleration", vector(0.0, 0.0, -9.81))]);
    let solver = Solver { tolerance: 1e-3, iterations: 60, solves: 1 };
    let exact = setup(&particles, vec![gravity(), Box::new(Exact)], "linear_backward_euler", H, solver);
    let mut device = on_device(&shared, &exact);
    device.step(1).expect("a step");
    let report = report(&mut device);
    assert_eq!((report.outcome, report.failures), (Outcome::BrokenDown, 1), "{report:?}");
    let system = System { particles: &particles, h: H, exact: true };
    let b = vec![DVec3::new(0.01, -0.02, -0.5); particles.len()];
    assert_eq!(system.iterations(&b, 1e-3, 200), None, "f64 finds a direction of negative curvature too");
    // What was found until then is kept, and is finite.
    let x = pollster::block_on(device.read(POSITION)).expect("positions");
    assert!(x.iter().all(|x| x.is_finite()));
}
