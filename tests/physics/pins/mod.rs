//! Fixed particles: fixed ones stay bit for bit, kinematic ones are where their motions and targets prescribe, under every integrator.

mod motions;

use std::f64::consts::{PI, TAU};

use crate::support::Shared;
use crate::support::states::{force, integrator, vector};
use glam::{DVec3, DVec4, Vec4};
use motes::integrators::INTEGRATORS;
use motes::kernel::{ACCELERATION, Array, Backend, Bounds, POSITION, Side, TARGET, VELOCITY};
use motes::lockstep::compare;
use motes::motion::{Held, Hold, Keyframe, Motion};
use motes::settings::Value;
use motes::{Cpu, Gpu, Setup, Simulation, State};

const DT: f64 = 0.013;

fn key(time: f64, shift: [f64; 3], turn: [f64; 3]) -> Keyframe {
    Keyframe { time, shift: shift.into(), turn: turn.into() }
}

/// One of every kind: at constant speed, gently, by several turns, over and over, begun before the run, and never moving.
pub(crate) fn motions() -> Vec<Motion> {
    let motion = |name: &str, about: [f64; 3], keys: Vec<Keyframe>, smooth, repeat| Motion {
        name: name.to_owned(),
        about: about.into(),
        keys,
        smooth,
        repeat,
    };
    let pulled = vec![key(0.05, [0.0; 3], [0.0; 3]), key(0.31, [0.7, -0.2, 0.4], [0.0; 3])];
    let swung = vec![
        key(-0.1, [0.1, 0.0, 0.0], [0.3, -0.2, 0.1]),
        key(0.1, [0.4, 0.3, -0.2], [-0.5, 0.9, 0.4]),
        key(0.27, [-0.3, 0.1, 0.2], [0.2, 0.1, -1.9]),
    ];
    let spun = vec![key(0.0, [0.0; 3], [0.0; 3]), key(0.4, [0.0; 3], [0.0, 5.0 * PI, 0.0])];
    let round = vec![key(0.02, [0.2, 0.0, 0.0], [0.0; 3]), key(0.117, [0.2, 0.0, 0.0], [0.0, 0.0, TAU])];
    vec![
        motion("pulled", [0.0; 3], pulled, false, false),
        motion("swung", [0.2, -0.4, 0.3], swung, true, false),
        motion("spun", [0.3, 0.1, -0.2], spun, false, false),
        motion("round", [-0.1, 0.2, 0.0], round, true, true),
        motion("still", [0.5; 3], vec![key(0.1, [0.0, 0.3, 0.0], [0.4, 0.0, 0.0])], false, false),
    ]
}

/// A cloud of which some are held: two fixed, then one for each motion, then two with targets.
pub(crate) fn pinned(count: usize) -> State {
    let mut particles = crate::support::cloud(count, 5);
    let led = (0..5).map(|n| Held { id: 7 - n, by: Hold::Motion(n) });
    let others = [(9, Hold::Target), (0, Hold::Fixed), (8, Hold::Target), (1, Hold::Fixed)];
    particles.held = led.chain(others.map(|(id, by)| Held { id, by })).collect();
    particles.motions = motions();
    particles
}

pub(crate) fn setup(particles: State, name: &str) -> Setup {
    let forces = vec![
        force("gravity", &[("softening", Value::Number(0.17))]),
        force("uniform", &[("acceleration", vector(0.3, -2.0, 0.7))]),
        force("drag", &[("linear", Value::Number(0.3))]),
        force("speed_limit", &[("min", Value::Number(0.4)), ("max", Value::Number(0.9))]),
    ];
    Setup {
        state: particles,
        forces,
        integrator: integrator(name),
        dt: DT,
        bounds: Bounds::default(),
        solver: motes::Solver::default(),
    }
}

fn simulation(shared: &Shared, setup: &Setup) -> Simulation<Gpu> {
    Simulation::new(&shared.found.device, &shared.found.queue, setup).expect("a simulation")
}

fn read(simulation: &mut Simulation<Gpu>, field: motes::kernel::Field<Vec4>) -> Vec<Vec4> {
    pollster::block_on(simulation.read(field)).expect("a field")
}

#[test]
fn a_fixed_one_keeps_every_bit() {
    let shared = crate::support::device();
    for entry in INTEGRATORS {
        let mut simulation = simulation(&shared, &setup(pinned(12), entry.name));
        let before = read(&mut simulation, POSITION);
        simulation.step(1000).expect("steps");
        let (after, velocity) = (read(&mut simulation, POSITION), read(&mut simulation, VELOCITY));
        for id in [0, 1] {
            assert_eq!(
                before[id].to_array().map(f32::to_bits),
                after[id].to_array().map(f32::to_bits),
                "{}",
                entry.name
            );
            assert_eq!(velocity[id].truncate(), glam::Vec3::ZERO, "{}", entry.name);
        }
        for id in [10, 11] {
            assert!(before[id] != after[id], "{}: free particles move", entry.name);
        }
        let got = read(&mut simulation, ACCELERATION);
        assert!(got[0].truncate() == glam::Vec3::ZERO && got[0].w != 0.0, "{}: no force, a potential", entry.name);
    }
    // The references hold positions in f64.
    let mut references = Simulation::on(Cpu::new(12).expect("some"), &setup(pinned(12), "rk4")).expect("a simulation");
    let place = |references: &mut Simulation<Cpu>| match references.backend().host().get(POSITION.name) {
        Some(Array::Vec4(x)) => x[0],
        _ => panic!("there are positions"),
    };
    let before: DVec4 = place(&mut references);
    references.step(50).expect("steps");
    assert_eq!(before, place(&mut references));
}

#[test]
fn a_led_one_is_where_its_motion_says_at_every_step() {
    let shared = crate::support::device();
    let particles = pinned(12);
    for entry in INTEGRATORS {
        let mut simulation = simulation(&shared, &setup(particles.clone(), entry.name));
        for step in 1..=40 {
            simulation.step(1).expect("a step");
            let places = read(&mut simulation, POSITION);
            for (n, motion) in particles.motions.iter().enumerate() {
                let id = 7 - n;
                let home = particles.position()[id];
                let want = motion.place(home, f64::from(step) * DT);
                let got = places[id].truncate().as_dvec3();
                // Two units in the last place of the numbers that are added: the place, the way there, and the arm, which
                // the last place of an angle of several turns moves as often as it is radians.
                let size = want.length() + (want - home).length() + angle(motion) * (home - motion.about).length();
                let error = (got - want).length() / (f64::from(f32::EPSILON) * size);
                assert!(error < 2.0, "{}, {}, step {step}: {got} is {error} ulp from {want}", entry.name, motion.name);
            }
        }
    }
}

/// The largest angle of a motion, and 1 at least.
fn angle(motion: &Motion) -> f64 {
    motion.keys.iter().map(|key| key.turn.length()).fold(1.0, f64::max)
}

/// However late: the time of a key is given in steps, not in seconds that run out of digits.
#[test]
fn a_motion_late_in_a_run_is_as_exact() {
    let shared = crate::support::device();
    let late = 3e6 * DT;
    let mut particles = pinned(12);
    for motion in particles.motions.iter_mut().filter(|motion| !motion.repeat) {
        motion.keys.iter_mut().for_each(|key| key.time += late);
    }
    let setup = setup(particles.clone(), "leapfrog");
    let mut simulation = simulation(&shared, &setup);
    let world = pollster::block_on(simulation.backend().world()).expect("a clock");
    let world = motes::kernel::World { step: 2_999_995, time: 2_999_995.0 * DT, ..world };
    simulation.backend().set_world(world).expect("a clock");
    for step in 1..=30 {
        simulation.step(1).expect("a step");
        let places = read(&mut simulation, POSITION);
        for (n, motion) in particles.motions.iter().enumerate() {
            let home = particles.position()[7 - n];
            let want = motion.place(home, (2_999_995.0 + f64::from(step)) * DT);
            let got = places[7 - n].truncate().as_dvec3();
            // What repeats has turned 4e5 times: its phase is a product of that and a rest in f32, good to 0.03 steps. All else is as good as
            // early in a run.
            let size = want.length() + (want - home).length() + angle(motion) * (home - motion.about).length();
            let allowed = if motion.repeat { 0.05 } else { 2.0 * f64::from(f32::EPSILON) * size };
            assert!((got - want).length() < allowed, "{}, step {step}: {got} is not {want}", motion.name);
        }
    }
}

#[test]
fn a_target_is_reached_in_time_at_one_pace() {
    let shared = crate::support::device();
    for entry in INTEGRATORS {
        let setup = setup(pinned(12), entry.name);
        let run = |batches: &[u32]| {
            let mut simulation = simulation(&shared, &setup);
            let home = read(&mut simulation, POSITION);
            simulation.step(2).expect("steps");
            assert_eq!(read(&mut simulation, POSITION)[8], home[8], "{}: without a target it stays", entry.name);
            let mut target = home.clone();
            let to = home[8].truncate() + glam::Vec3::new(0.5, -0.3, 0.2);
            // A frame of eight steps.
            target[8] = to.extend(10.0 * 0.013);
            simulation.write(TARGET, &target).expect("targets");
            let mut places = Vec::new();
            for steps in batches {
                simulation.step(*steps).expect("steps");
                places.push(read(&mut simulation, POSITION)[8].truncate());
            }
            let all: Vec<u8> = [POSITION, VELOCITY, ACCELERATION]
                .iter()
                .flat_map(|f| bytemuck::cast_slice(&read(&mut simulation, *f)).to_vec())
                .collect();
            (home[8].truncate(), to, places, all)
        };
        let (home, to, places, single) = run(&[1; 12]);
        for (n, place) in (0u16..).zip(&places) {
            let part = (f32::from(n + 1) / 8.0).min(1.0);
            let want = home + part * (to - home);
            // Each step of a few drifts adds a rounding of 6e-8 of a place near 1, and what is left of the time another.
            assert!((*place - want).length() < 4e-6, "{}, step {n}: {place} is not {want}", entry.name);
        }
        assert!((places[11] - to).length() < 2e-7, "{}: it is there, and stays", entry.name);
        assert!(run(&[12]).3 == single, "{}: one batch differs from single steps", entry.name);
        assert!(run(&[3, 1, 8]).3 == single, "{}: batches differ from single steps", entry.name);
    }
}

#[test]
fn through_the_side_of_a_periodic_box() {
    let shared = crate::support::device();
    let mut particles = pinned(12);
    particles.motions[0].keys[1].shift = DVec3::new(5.0, 0.0, 0.0);
    let bounds = Bounds::new(DVec3::splat(-1.0), DVec3::splat(1.0), Side::Periodic);
    let setup = Setup { bounds, ..setup(particles.clone(), "pefrl") };
    let mut simulation = simulation(&shared, &setup);
    for step in 1..=24 {
        simulation.step(1).expect("a step");
        let want = particles.motions[0].place(particles.position()[7], f64::from(step) * DT);
        let got = read(&mut simulation, POSITION)[7].truncate().as_dvec3();
        let apart = bounds.shortest(got - want).length();
        // Of numbers up to 6, a few ulp each.
        assert!(apart < 4e-6, "step {step}: {got} is not {want}");
        assert!(got.abs().max_element() <= 1.0, "step {step}: {got} is outside");
    }
}

#[test]
fn no_mirror_throws_back_prescribed_motions() {
    let shared = crate::support::device();
    let mut particles = pinned(12);
    particles.position_mut().iter_mut().for_each(|x| *x *= 0.9);
    particles.motions[0].keys[1].shift = DVec3::new(5.0, 0.0, 0.0);
    let bounds = Bounds::new(DVec3::splat(-1.0), DVec3::splat(1.0), Side::Reflecting);
    let setup = Setup { bounds, ..setup(particles.clone(), "forest_ruth") };
    let mut simulation = simulation(&shared, &setup);
    simulation.step(25).expect("steps");
    let places = read(&mut simulation, POSITION);
    let want = particles.motions[0].place(particles.position()[7], 25.0 * DT);
    assert!((places[7].truncate().as_dvec3() - want).length() < 4e-6, "{} is not {want}", places[7]);
    for id in [10, 11] {
        assert!(places[id].truncate().abs().max_element() <= 1.0, "free particles stay inside: {}", places[id]);
    }
}

/// Leading and holding against their references, at sizes around the workgroup's.
#[test]
fn the_kernels_agree_with_their_references() {
    let shared = crate::support::device();
    for count in [12usize, 64, 65, 333] {
        let mut particles = pinned(count);
        for id in 12..u32::try_from(count).expect("few") {
            particles.held.push(Held { id, by: [Hold::Fixed, Hold::Target, Hold::Motion(1)][id as usize % 3] });
        }
        let setup = setup(particles, "symplectic_euler");
        let gpu = crate::support::machines::gpu(&shared, count);
        let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
        simulation.step(3).expect("steps");
        let mut places = read(&mut simulation, POSITION);
        let targets: Vec<_> = places.iter().map(|x| (x.truncate() * 1.3).extend(0.2)).collect();
        simulation.write(TARGET, &targets).expect("targets");
        // A displaced particle goes home, whatever holds it.
        for x in &mut places {
            x.x += 0.1;
        }
        simulation.write(POSITION, &places).expect("places");
        let plan = setup.plans(simulation.backend().machine()).expect("plans").step;
        assert!(plan.to_string().starts_with("lead fixed | lead target | lead motion | clear"), "{plan}");
        let count = u32::try_from(count).expect("few");
        for verdict in pollster::block_on(compare(simulation.backend(), &plan, count)).expect("verdicts") {
            let about = verdict.kernel.starts_with("lead") || verdict.kernel == "hold";
            assert!(verdict.good(), "{verdict:?}");
            assert!(verdict.changed || !about, "changes nothing: {verdict:?}");
        }
    }
}

/// A measurement knows what is held, and leaves no trace.
#[test]
fn a_snapshot_has_no_force_on_the_held() {
    let shared = crate::support::device();
    let setup = setup(pinned(12), "leapfrog");
    let mut simulation = simulation(&shared, &setup);
    let first = pollster::block_on(simulation.snapshot()).expect("a snapshot");
    assert_eq!(first.velocity()[0], DVec3::ZERO, "its own velocity counts for nothing");
    assert_ne!(setup.state.velocity()[0], DVec3::ZERO);
    simulation.step(5).expect("steps");
    let before = read(&mut simulation, ACCELERATION);
    pollster::block_on(simulation.snapshot()).expect("a snapshot");
    assert_eq!(before, read(&mut simulation, ACCELERATION));
}
