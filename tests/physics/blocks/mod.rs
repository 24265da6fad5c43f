//! Block time steps: against leapfrog to the bit, every kernel against its reference, order, work and what they refuse.

mod kernels;
mod refusals;
mod work;

use glam::DVec3;
use motes::forces::Component;
use motes::integrators::BlockLeapfrog;
use motes::kernel::{Backend, BlockSteps};
use motes::settings::Value;
use motes::simulation::Levels;
use motes::{ACCELERATION, Bounds, POSITION, Setup, Side, Simulation, Solver, State, VELOCITY};

use crate::support::states::{self, cpu, force, one, vector, word};
use crate::support::{self, Random, Shared};

/// As GADGET has it.
const ETA: f64 = 0.025;

fn steps(levels: u32, length: f64) -> BlockSteps {
    BlockSteps { levels, eta: ETA, length, mass: 0.0, shared: false }
}

fn setup(state: State, forces: Vec<Box<dyn Component>>, dt: f64, steps: BlockSteps) -> Setup {
    Setup {
        state,
        forces,
        integrator: Box::new(BlockLeapfrog(steps)),
        dt,
        bounds: Bounds::default(),
        solver: Solver::default(),
    }
}

fn on_gpu(shared: &Shared, setup: &Setup) -> Simulation<motes::Gpu> {
    Simulation::new(&shared.found.device, &shared.found.queue, setup).expect("a simulation")
}

fn levels<B: Backend>(simulation: &mut Simulation<B>) -> Levels {
    pollster::block_on(simulation.levels()).expect("levels").expect("block steps")
}

/// All that a step leaves for the next one.
fn bytes<B: Backend>(simulation: &mut Simulation<B>) -> Vec<u8> {
    pollster::block_on(async {
        simulation.check().await.expect("a sound run");
        let mut all = Vec::new();
        for field in [POSITION, VELOCITY, ACCELERATION] {
            all.extend_from_slice(bytemuck::cast_slice(&simulation.read(field).await.expect("a field")));
        }
        all
    })
}

/// Newton's law over all pairs or a tree.
fn gravity(g: f64, softening: f64, over: &'static str, alpha: f64) -> Box<dyn Component> {
    let all = [
        ("g", Value::Number(g)),
        ("softening", Value::Number(softening)),
        ("over", word(over)),
        ("theta", Value::Number(0.6)),
        ("alpha", Value::Number(alpha)),
    ];
    force("gravity", &all)
}

/// Stars on orbits of all inclinations about a heavy body, from the radius `least` to 1, in the cusp of Bahcall & Wolf (1976), N(r) ∝ r^(5/4);
/// together they are a hundredth of its mass. The body is the first.
fn cusp(count: usize, least: f64, seed: u64) -> State {
    let mut random = Random::new(seed);
    let mut state = State::default();
    let single = |v: DVec3| v.as_vec3().as_dvec3();
    state.push(DVec3::ZERO, DVec3::ZERO, 1.0, 0.01);
    for _ in 1..count {
        let inside = least.powf(1.25);
        let radius = (inside + (1.0 - inside) * 0.5 * (1.0 + random.next())).powf(0.8);
        let place = random.vector().normalize() * radius;
        let across = place.cross(random.vector()).normalize();
        // Between 0.8 and 1.1 of that of a circle.
        let speed = (1.0 / radius).sqrt() * (0.95 + 0.15 * random.next());
        state.push(single(place), single(across * speed), 0.01 / count as f64, 0.001);
    }
    state
}

/// Kinetic and potential energy, in f64.
fn energy(state: &State, softening: f64) -> f64 {
    let (x, v, m) = (state.position(), state.velocity(), state.mass());
    let mut sum = 0.0;
    for i in 0..x.len() {
        sum += 0.5 * m[i] * v[i].length_squared();
        for j in 0..i {
            sum -= m[i] * m[j] / ((x[i] - x[j]).length_squared() + softening * softening).sqrt();
        }
    }
    sum
}

fn state<B: Backend>(simulation: &mut Simulation<B>) -> State {
    pollster::block_on(async {
        simulation.check().await.expect("a sound run");
        simulation.snapshot().await.expect("a state")
    })
}

/// Steps of which a uniform acceleration of 10 puts all particles on a level of 0 to 4: √(2 η ε / 10) is 1.5 of dt / 2ˡ, below that of the level before.
fn on_level(level: i32, dt: f64) -> BlockSteps {
    steps(4, 10.0 * (0.75 * dt * 2.0 * 0.5_f64.powi(level)).powi(2) / (2.0 * ETA))
}

fn assert_on_level<B: Backend>(simulation: &mut Simulation<B>, level: i32, of: &str) {
    let mut want = vec![0; 5];
    want[usize::try_from(level).expect("a level")] = u64::from(simulation.count());
    assert_eq!(levels(simulation).particles, want, "{of}");
}

/// A strong uniform field puts all on one level: then the method is leapfrog with that step, to the bit, whatever else there is.
#[test]
fn on_one_level_it_is_leapfrog_to_the_bit() {
    let shared = support::device();
    let dt = 1.0 / 64.0;
    for (seed, over, alpha, level) in
        [(1, "pairs", 0.0, 0), (2, "pairs", 0.0, 3), (3, "tree", 0.0, 2), (4, "tree", 0.005, 2), (5, "tree", 0.0, 0)]
    {
        for is_shared in [false, true] {
            let forces = || -> Vec<Box<dyn Component>> {
                vec![
                    gravity(0.01, 0.1, over, alpha),
                    force("uniform", &[("acceleration", vector(0.0, 0.0, -10.0))]),
                    force("drag", &[("linear", Value::Number(0.1))]),
                ]
            };
            let state = support::cloud(700, seed);
            let blocks = BlockSteps { shared: is_shared, ..on_level(level, dt) };
            let mut block = on_gpu(&shared, &setup(state.clone(), forces(), dt, blocks));
            block.step(3).expect("steps");
            let got = bytes(&mut block);
            assert_on_level(&mut block, level, over);
            let parts = 1 << level;
            let even = Setup::new(state, forces(), dt / f64::from(parts));
            let mut even = on_gpu(&shared, &even);
            even.step(3 * u32::try_from(parts).expect("few")).expect("steps");
            assert!(got == bytes(&mut even), "{over}, level {level}, shared: {is_shared}");
        }
    }
}

/// The same with all images of a box where space expands: every part of a step has the scale factor of its own time.
#[test]
fn on_one_level_it_is_leapfrog_to_the_bit_where_space_expands() {
    let shared = support::device();
    let dt = 1.0 / 64.0;
    let bounds = Bounds::new(DVec3::splat(-2.0), DVec3::splat(2.0), Side::Periodic);
    for (seed, over, level) in [(1, "pairs", 2), (2, "tree", 3), (3, "tree", 0)] {
        let forces = |hubble: f64| {
            let settings = [
                ("g", Value::Number(0.8)),
                ("softening", Value::Number(0.1)),
                ("over", word(over)),
                ("images", word("ewald")),
                ("hubble", Value::Number(hubble)),
                ("redshift", Value::Number(3.0)),
            ];
            vec![force("gravity", &settings), force("uniform", &[("acceleration", vector(0.0, 0.0, -10.0))])]
        };
        let state = support::cloud(700, seed);
        let block = setup(state.clone(), forces(1.7), dt, on_level(level, dt));
        let mut block = on_gpu(&shared, &Setup { bounds, ..block });
        block.step(3).expect("steps");
        assert_on_level(&mut block, level, over);
        let parts = 1 << level;
        let even = |hubble| {
            let even = Setup { bounds, ..Setup::new(state.clone(), forces(hubble), dt / f64::from(parts)) };
            let mut even = on_gpu(&shared, &even);
            even.step(3 * u32::try_from(parts).expect("few")).expect("steps");
            bytes(&mut even)
        };
        let got = bytes(&mut block);
        assert!(got == even(1.7), "{over}, level {level}");
        // The expansion of a part of a step shows: scale factors differ by a thousandth here.
        assert!(got != even(1.702), "{over}, level {level}");
    }
}

/// Reruns, batches and measurements change no bit.
#[test]
fn same_run_same_bits() {
    let shared = support::device();
    for (over, alpha) in [("pairs", 0.0), ("tree", 0.0), ("tree", 0.01)] {
        let setup = setup(cusp(600, 0.03, 3), vec![gravity(1.0, 0.004, over, alpha)], 0.01, steps(7, 0.0));
        let mut all: Option<Vec<u8>> = None;
        for batches in [&[4][..], &[1, 1, 2], &[3, 1]] {
            let mut simulation = on_gpu(&shared, &setup);
            for (n, batch) in batches.iter().enumerate() {
                simulation.step(*batch).expect("steps");
                if n == 0 && batches.len() == 3 && over == "pairs" {
                    pollster::block_on(simulation.virial()).expect("a virial");
                }
            }
            let got = bytes(&mut simulation);
            assert!(levels(&mut simulation).finest() >= 4, "{over}: {:?}", levels(&mut simulation));
            assert!(all.get_or_insert_with(|| got.clone()) == &got, "{over}, {batches:?}");
        }
    }
}

/// One particle about a centre that is fixed: the error of its phase, where dt and η shrink together, is of order 2.
#[test]
fn it_has_order_two() {
    let time = 2.0;
    let run = |parts: u32, is_shared: bool| {
        let dt = time / f64::from(parts);
        let eta = ETA * (64.0 / f64::from(parts)).powi(2);
        let steps = BlockSteps { levels: 6, eta, length: 0.05, mass: 0.0, shared: is_shared };
        let state = one(DVec3::new(0.5, 0.0, 0.0), DVec3::new(0.0, 3.0_f64.sqrt(), 0.0));
        let setup = setup(state, vec![force("attractor", &[])], dt, steps);
        let mut simulation = Simulation::on(motes::Cpu::new(1).expect("a processor"), &setup).expect("a simulation");
        simulation.step(parts).expect("steps");
        pollster::block_on(simulation.check()).expect("a sound run");
        let (x, v) = states::phase(&mut simulation);
        (x[0].truncate(), v[0].truncate(), levels(&mut simulation).finest())
    };
    let mut fine = cpu(
        &one(DVec3::new(0.5, 0.0, 0.0), DVec3::new(0.0, 3.0_f64.sqrt(), 0.0)),
        vec![force("attractor", &[])],
        "pefrl",
        time / 8192.0,
    );
    fine.step(8192).expect("steps");
    let (x, v) = states::phase(&mut fine);
    let error = |parts: u32, is_shared| {
        let (place, velocity, _) = run(parts, is_shared);
        ((place - x[0].truncate()).length_squared() + (velocity - v[0].truncate()).length_squared()).sqrt()
    };
    for is_shared in [false, true] {
        let errors = [128, 256, 512].map(|parts| error(parts, is_shared));
        let slopes = [(errors[0] / errors[1]).log2(), (errors[1] / errors[2]).log2()];
        assert!(slopes.iter().all(|slope| (slope - 2.0).abs() < 0.3), "{errors:?}: {slopes:?}");
    }
}
