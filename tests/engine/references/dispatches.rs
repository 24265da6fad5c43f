//! What takes many dispatches: folded over two dimensions, cut into slices and layers, of more than one dispatch can evaluate.

use motes::gpu::Gpu;
use motes::kernel::{ACCELERATION, Backend, Machine};
use motes::{Setup, Simulation};

use super::{DT, judge, moving, verdicts};
use crate::support::machines::{self, alone, cut, gpu};
use crate::support::states::{force, integrator};

/// A device that dispatches few workgroups in each dimension folds what a large one has in line.
#[test]
fn dispatches_fold_over_two_dimensions() {
    let shared = crate::support::device();
    let few = |limits: &mut motes::wgpu::Limits| limits.max_compute_workgroups_per_dimension = 4;
    let (device, queue) = pollster::block_on(crate::support::limited(&shared, few));
    // 16 workgroups in 4 rows, 5 in 2 rows of 3 (one too many), 4 in line; and layers beside them.
    for count in [1000, 300, 256] {
        for (name, machine) in machines::machines(&shared) {
            let mut gpu = Gpu::new(&device, &queue, u32::try_from(count).expect("few")).expect("a GPU");
            gpu.pad(5);
            // Up to four layers.
            gpu.pretend(Machine { invocations: machine.invocations.min(1000), ..machine });
            let machine = gpu.machine();
            let forces = || vec![force("gravity", &[("softening", motes::settings::Value::Number(0.17))])];
            let mut simulation = moving(gpu, count, forces(), "rk4");
            let setup = Setup {
                state: crate::support::cloud(count, 7),
                forces: forces(),
                integrator: integrator("rk4"),
                dt: DT,
                bounds: motes::Bounds::default(),
                solver: motes::Solver::default(),
            };
            let plan = setup.plans(machine).expect("plans").step;
            judge(&verdicts(simulation.backend(), &plan, count, &name), count, &name, |v| v.field == "alarm");
        }
    }
}

/// Cut into many dispatches, in one layer or more, all pairs are still evaluated; in one layer even bit for bit.
#[test]
fn cuts_change_no_bit() {
    let shared = crate::support::device();
    let count = 1000usize;
    let law = force("gravity", &[("softening", motes::settings::Value::Number(0.17))]);
    for (name, machine) in machines::machines(&shared) {
        if name.contains("layers") {
            continue;
        }
        let whole = machines::kernel(law.as_ref(), count, &machine);
        let layered = machines::kernel(law.as_ref(), count, &Machine { invocations: 1 << 18, ..machine });
        let finish = layered.passes.last().expect("a finish");
        let mut results = Vec::new();
        for (layers, slice) in [(1, 1024), (1, 128), (1, 256), (1, 384), (2, 128), (3, 256)] {
            let of = format!("{name}, {layers} layers of {slice}");
            let kernel = cut(&whole, finish, count, layers, slice);
            let kernel = if slice == 1024 { whole.clone() } else { kernel };
            let mut simulation = moving(gpu(&shared, count), count, Vec::new(), "symplectic_euler");
            judge(&verdicts(simulation.backend(), &alone(kernel), count, &of), count, &of, |_| false);
            let values = pollster::block_on(simulation.read(ACCELERATION)).expect("accelerations");
            if layers == 1 {
                results.push(bytemuck::cast_slice::<_, u8>(&values).to_vec());
            }
        }
        assert!(results.windows(2).all(|w| w[0] == w[1]), "{name}: a cut changes bits");
    }
}

/// So many that a dispatch may not evaluate all of them: of 65 537 sources it evaluates 127 blocks.
#[test]
fn more_than_one_dispatch_can_meet() {
    let shared = crate::support::device();
    let count = 65_537usize;
    let particles = crate::support::cloud(count, 7);
    let mut gpu = gpu(&shared, count);
    let machine = Machine { invocations: 1, meetings: 1 << 30, ..gpu.machine() };
    gpu.pretend(machine);
    let softening = 0.171_875; // held by f32
    let law = || force("gravity", &[("softening", motes::settings::Value::Number(softening))]);
    let kernel = machines::kernel(law().as_ref(), count, &machine);
    assert_eq!(kernel.passes.len(), 6, "five dispatches, and one that adds them up");
    let setup = Setup {
        state: particles,
        forces: Vec::new(),
        integrator: integrator("symplectic_euler"),
        dt: DT,
        bounds: motes::Bounds::default(),
        solver: motes::Solver::default(),
    };
    let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
    let program = simulation.backend().compile(&alone(kernel)).expect("a program");
    simulation.backend().run(&program, 1).expect("a run");
    let got = pollster::block_on(simulation.read(ACCELERATION)).expect("accelerations");
    // The reference would evaluate four billion: look at some, among them those at the seams.
    let all = &setup.state;
    let change = got.iter().map(|a| f64::from(a.truncate().length_squared())).sum::<f64>() / count as f64;
    for i in [0usize, 1, 63, 64, 255, 256, 32_767, 32_768, 40_000, 65_535, 65_536] {
        let (mut a, mut w) = (glam::DVec3::ZERO, 0.0);
        for j in (0..count).filter(|j| *j != i) {
            let r = all.position()[j] - all.position()[i];
            let d = (r.length_squared() + softening * softening).sqrt();
            a += r * (all.mass()[j] / d.powi(3));
            w -= 0.5 * all.mass()[j] / d;
        }
        let (error, error_w) = ((got[i].as_dvec4().truncate() - a).length(), (f64::from(got[i].w) - w).abs());
        // The tolerance of lockstep: parts of the usual change.
        assert!(error < motes::lockstep::TOLERANCE * change.sqrt(), "particle {i}: {error:e}");
        assert!(error_w < motes::lockstep::TOLERANCE * w.abs(), "particle {i}: potential {error_w:e}");
    }
}
