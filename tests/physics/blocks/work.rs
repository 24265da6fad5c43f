//! A concentrated cluster: energy at equal work, and work at equal shortest steps.

use glam::DVec3;
use motes::{Setup, Simulation};

use super::{cusp, energy, gravity, levels, on_gpu, setup, state, steps};
use crate::support::{self, Random};

const SOFTENING: f64 = 0.002;

/// Stars between 0.01 and 1 of a heavy body, in steps that differ by more than a hundred. Ten crossing times r / v of the radius within which half of
/// them are, 0.1: 0.32. Steps of equal length that evaluate as often, or somewhat more often, err more by far.
#[test]
fn energy_is_kept_better_than_by_equal_steps_of_equal_work() {
    let shared = support::device();
    for (seed, is_shared) in [(1, false), (2, false), (3, true)] {
        let start = cusp(400, 0.01, seed);
        let forces = || vec![gravity(1.0, SOFTENING, "pairs", 0.0)];
        let (dt, count) = (0.32 / 20.0, start.len() as f64);
        let mut steps = steps(8, 0.0);
        steps.shared = is_shared;
        let mut block = on_gpu(&shared, &setup(start.clone(), forces(), dt, steps));
        block.step(20).expect("steps");
        let levels = levels(&mut block);
        let before = energy(&start, SOFTENING);
        let error = |end: &motes::State| ((energy(end, SOFTENING) - before) / before).abs();
        let got = error(&state(&mut block));
        if is_shared {
            assert!(got < 2e-4, "{got:e}");
            continue;
        }
        // From level 0 or 1 to level 7 or 8.
        let least = levels.particles.iter().position(|n| *n > 0).expect("some");
        assert!(levels.finest() - least >= 6, "{levels:?}");
        assert!(levels.work() < 0.2, "{levels:?}: {}", levels.work());
        // As many evaluations in steps of equal length.
        let each = (levels.evaluations as f64 / (20.0 * count)).ceil();
        let mut even = on_gpu(&shared, &Setup::new(start, forces(), dt / each));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "few")]
        even.step(20 * each as u32).expect("steps");
        let fixed = error(&state(&mut even));
        assert!(got < 1e-3 && fixed > 10.0 * got, "seed {seed}: {got:e}, and {fixed:e} in steps of equal length");
    }
}

/// The momentum that unequal kicks create is that of the errors of trajectories. Half of the stars, and of their mass, are in a nucleus of a
/// twentieth of the radius.
#[test]
fn momentum_is_kept_as_well_as_trajectories() {
    let shared = support::device();
    for seed in [1, 2] {
        let mut random = Random::new(seed);
        let mut start = motes::State::default();
        let single = |v: DVec3| v.as_vec3().as_dvec3();
        for k in 0..400 {
            let radius = if k % 2 == 0 { 0.05 } else { 1.0 };
            let speed = (0.3_f64 / radius).sqrt();
            start.push(single(radius * random.vector()), single(speed * random.vector()), 1.0 / 400.0, 0.01);
        }
        let setup = setup(start.clone(), vec![gravity(1.0, 0.01, "pairs", 0.0)], 0.02, steps(7, 0.0));
        let mut block = on_gpu(&shared, &setup);
        let momentum =
            |state: &motes::State| -> DVec3 { state.velocity().iter().zip(state.mass()).map(|(v, m)| *v * *m).sum() };
        block.step(10).expect("steps");
        let all: f64 = start.velocity().iter().zip(start.mass()).map(|(v, m)| v.length() * *m).sum();
        let changed = (momentum(&state(&mut block)) - momentum(&start)).length() / all;
        assert!(changed < 1e-3 && changed > 1e-7, "{changed:e}: {:?}", levels(&mut block));
    }
}

/// A heavy body among few light ones is kicked with the shortest steps, however few there are: with steps of its own, which are long, it would take up
/// momentum.
#[test]
fn a_heavy_body_among_few_is_found() {
    let shared = support::device();
    for seed in [1, 2, 3] {
        let start = cusp(80, 0.03, seed);
        let run = |mass: f64| {
            let steps = motes::kernel::BlockSteps { mass, ..steps(8, 0.0) };
            let mut block =
                on_gpu(&shared, &setup(start.clone(), vec![gravity(1.0, 0.004, "pairs", 0.0)], 0.02, steps));
            block.step(50).expect("steps");
            let end = state(&mut block);
            let momentum: DVec3 = end.velocity().iter().zip(end.mass()).map(|(v, m)| *v * *m).sum();
            let before: DVec3 = start.velocity().iter().zip(start.mass()).map(|(v, m)| *v * *m).sum();
            (momentum - before).length()
        };
        let (found, left) = (run(0.0), run(2.0));
        assert!(found < 1e-5 && left > 3.0 * found, "seed {seed}: {found:e}, and {left:e} where it is not");
    }
}

/// The reference for a machine without a driver has the same levels.
#[test]
fn the_processor_has_the_same_levels() {
    let start = cusp(200, 0.03, 4);
    let setup = setup(start, vec![gravity(1.0, 0.005, "pairs", 0.0)], 0.01, steps(7, 0.0));
    let shared = support::device();
    let mut device = on_gpu(&shared, &setup);
    let mut host = Simulation::on(motes::Cpu::new(200).expect("a processor"), &setup).expect("a simulation");
    device.step(1).expect("a step");
    host.step(1).expect("a step");
    assert_eq!(levels(&mut device), levels(&mut host));
    let [a, b] = [state(&mut device), state(&mut host)];
    let apart = a.position().iter().zip(b.position()).map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max);
    assert!(apart < 1e-5, "{apart:e}");
}
