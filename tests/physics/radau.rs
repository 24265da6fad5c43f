//! The method of order 15 on the nodes of Radau's quadrature: few bodies through close encounters, against published and exact orbits.

use std::f64::consts::TAU;

use crate::support::states::{cpu, force, integrator, one, phase, vector, word};
use crate::support::{self, Random, Shared, agrees, machines};
use glam::DVec3;
use motes::forces::Component;
use motes::integrators::{Adaptive, Precise};
use motes::kernel::{AdaptiveStep, Backend, Precision};
use motes::lockstep::compare;
use motes::settings::Value;
use motes::simulation::Clock;
use motes::{Cpu, Energy, Gpu, Setup, Simulation, State};

fn gravity() -> Vec<Box<dyn Component>> {
    vec![force("gravity", &[])]
}

/// Adaptive steps, none longer than dt.
fn adaptive(state: &State, forces: Vec<Box<dyn Component>>, dt: f64, precision: Precision) -> Setup {
    let adaptive_step = AdaptiveStep { least: 1e-6 * dt, courant: 0.25, before: None };
    let integrator = Box::new(Adaptive { integrator: integrator("gauss_radau"), adaptive_step });
    Setup { integrator: Box::new(Precise { integrator, precision }), ..Setup::new(state.clone(), forces, dt) }
}

fn references(setup: &Setup) -> Simulation<Cpu> {
    Simulation::on(Cpu::new(setup.check().expect("a setup")).expect("references"), setup).expect("a simulation")
}

fn on(shared: &Shared, setup: &Setup) -> Simulation<Gpu> {
    Simulation::new(&shared.found.device, &shared.found.queue, setup).expect("a simulation")
}

fn clock<B: Backend>(simulation: &mut Simulation<B>) -> Clock {
    pollster::block_on(simulation.clock()).expect("a clock").expect("adaptive steps")
}

/// Runs to a time.
fn until<B: Backend>(simulation: &mut Simulation<B>, time: f64, longest: f64) {
    simulation.stop_at(time).expect("a stop");
    for _ in 0..1_000_000 {
        let clock = clock(simulation);
        if time - clock.time < 1e-7 * longest {
            return;
        }
        simulation.step(clock.steps_before(time, longest).min(200)).expect("steps");
    }
    panic!("{time} is not reached");
}

fn state<B: Backend>(simulation: &mut Simulation<B>) -> State {
    pollster::block_on(simulation.snapshot()).expect("a snapshot")
}

fn energy<B: Backend>(simulation: &mut Simulation<B>) -> f64 {
    let Energy { kinetic, potential, .. } = Energy::of(&state(simulation)).expect("energies");
    kinetic + potential
}

/// A test particle on an ellipse about GM = 1, a = 1, from pericentre.
fn ellipse(eccentricity: f64) -> State {
    let speed = ((1.0 + eccentricity) / (1.0 - eccentricity)).sqrt();
    one(DVec3::new(1.0 - eccentricity, 0.0, 0.0), DVec3::new(0.0, speed, 0.0))
}

/// The problem of Burrau (1913): masses 3, 4 and 5 at rest on a triangle of these sides.
fn pythagorean() -> State {
    let mut state = State::default();
    for (mass, x, y) in [(3.0, 1.0, 3.0), (4.0, -2.0, -1.0), (5.0, 1.0, -1.0)] {
        state.push(DVec3::new(x, y, 0.0), DVec3::ZERO, mass, 0.0);
    }
    state
}

/// Times and places of the three by Taylor series of orders 30 and 40 with 200 bits.
const PYTHAGOREAN: [(f64, [[f64; 2]; 3]); 4] = [
    (
        1.0,
        [
            [0.949_550_134_839_484, 2.773_231_694_945_563],
            [-1.666_229_065_913_729, -0.949_442_409_147_773],
            [0.763_253_171_827_293, -0.904_385_089_649_119],
        ],
    ),
    (
        5.0,
        [
            [2.469_169_667_082_492, -1.227_815_564_157_012],
            [-2.278_202_696_814_357, -0.205_449_538_723_054],
            [0.341_060_357_201_990, 0.901_048_969_472_651],
        ],
    ),
    (
        10.0,
        [
            [0.778_480_410_138_085, 0.141_392_300_290_086],
            [-2.025_092_477_978_199, 0.097_219_384_146_058],
            [1.152_985_736_299_708, -0.162_610_887_490_898],
        ],
    ),
    (
        15.0,
        [
            [1.418_453_697_937_499, 0.686_214_320_664_173],
            [-2.006_538_643_259_155, 0.059_940_801_440_350],
            [0.754_158_695_844_824, -0.459_681_233_550_784],
        ],
    ),
];

/// How far the bodies are from where they should be, at most.
fn away(state: &State, places: &[[f64; 2]; 3]) -> f64 {
    let far = |(x, place): (&DVec3, &[f64; 2])| (x.x - place[0]).hypot(x.y - place[1]);
    state.position().iter().zip(places).map(far).fold(0.0, f64::max)
}

#[test]
fn the_pythagorean_problem_by_the_references() {
    for precision in [Precision::Single, Precision::Compensated] {
        let setup = adaptive(&pythagorean(), gravity(), 0.1, precision);
        let mut simulation = references(&setup);
        let start = energy(&mut simulation);
        for (time, places) in &PYTHAGOREAN {
            until(&mut simulation, *time, 0.1);
            let error = away(&state(&mut simulation), places);
            // Rounding of 1e-16 grows by close encounters: at t = 1.88 two are 1e-2 apart.
            let bound = if *time < 2.0 { 1e-13 } else { 1e-8 };
            assert!(error < bound, "{precision:?}, at {time}: {error:e}");
        }
        // Through the closest encounter of all, 4.14e-4 at 15.83, and until one body has escaped.
        until(&mut simulation, 70.0, 0.1);
        let change = (energy(&mut simulation) / start - 1.0).abs();
        let bound = if precision == Precision::Single { 1e-8 } else { 1e-9 };
        assert!(change < bound, "{precision:?}: {change:e}");
        let clock = clock(&mut simulation);
        assert!(clock.steps < 4000 && clock.between[0] < 1e-4 * clock.between[1], "{clock:?}");
    }
}

#[test]
fn the_pythagorean_problem_on_a_device() {
    let shared = support::device();
    let setup = adaptive(&pythagorean(), gravity(), 0.1, Precision::DoubleSingle);
    let mut simulation = on(&shared, &setup);
    let start = energy(&mut simulation);
    for (time, places) in &PYTHAGOREAN[..3] {
        until(&mut simulation, *time, 0.1);
        let error = away(&state(&mut simulation), places);
        // Forces are rounded to 6e-8; encounters let that grow as they do above, by 1e4.
        let bound = if *time < 2.0 { 1e-6 } else { 1e-3 };
        assert!(error < bound, "at {time}: {error:e}");
    }
    let change = (energy(&mut simulation) / start - 1.0).abs();
    assert!(change < 1e-5, "{change:e}");
}

#[test]
fn narrow_ellipses() {
    let centre = || vec![force("attractor", &[])];
    for (eccentricity, most) in [(0.5, 35), (0.9, 90), (0.99, 180)] {
        let start = ellipse(eccentricity);
        let mut simulation = references(&adaptive(&start, centre(), 1.0, Precision::Single));
        // A period, to the tick of the clock, in which it moves by no more than 1.5e-8 of a step.
        until(&mut simulation, 5.0 * TAU, 1.0);
        let (x, v) = phase(&mut simulation);
        let energy = 0.5 * v[0].truncate().length_squared() - 1.0 / x[0].truncate().length();
        assert!((energy / -0.5 - 1.0).abs() < 1e-11, "e = {eccentricity}: {energy}");
        let late = clock(&mut simulation).time - 5.0 * TAU;
        let there = start.position()[0] + late * start.velocity()[0];
        // The acceleration at pericentre, times half of the square of that, and what a rounded energy does to the phase.
        let far = (x[0].truncate() - there).length();
        assert!(far < 1e-9 + 1e-9 * start.velocity()[0].length(), "e = {eccentricity}: {far:e}");
        let steps = clock(&mut simulation).steps;
        assert!(steps < 5 * most, "e = {eccentricity}: {steps} steps");
    }
}

#[test]
fn a_thousand_orbits_without_a_trend() {
    let centre = || vec![force("attractor", &[])];
    let mut simulation = references(&adaptive(&ellipse(0.5), centre(), 1.0, Precision::Compensated));
    let mut errors = Vec::new();
    for orbits in [250.0, 500.0, 1000.0] {
        until(&mut simulation, orbits * TAU, 1.0);
        let (x, v) = phase(&mut simulation);
        let energy = 0.5 * v[0].truncate().length_squared() - 1.0 / x[0].truncate().length();
        errors.push((energy / -0.5 - 1.0).abs());
    }
    // 20 000 steps, each with a rounding error of 1e-16: their random walk is 1.4e-14.
    assert!(errors.iter().all(|error| *error < 2e-13), "{errors:?}");
}

#[test]
fn order_in_fixed_steps() {
    let error = |eccentricity: f64, time: f64, steps: u32, speed: DVec3| {
        let mut start = ellipse(eccentricity);
        start.velocity_mut()[0] += speed;
        let centre = vec![force("attractor", &[("velocity", Value::Vector(speed))])];
        let mut simulation = cpu(&start, centre, "gauss_radau", time / f64::from(steps));
        simulation.step(steps).expect("steps");
        let (x, v) = phase(&mut simulation);
        let mut anomaly = time;
        for _ in 0..60 {
            anomaly -= (anomaly - eccentricity * anomaly.sin() - time) / (1.0 - eccentricity * anomaly.cos());
        }
        let (sin, cos) = anomaly.sin_cos();
        let (rate, minor) = (1.0 / (1.0 - eccentricity * cos), (1.0 - eccentricity * eccentricity).sqrt());
        let (place, way) =
            (DVec3::new(cos - eccentricity, minor * sin, 0.0), DVec3::new(-sin, minor * cos, 0.0) * rate);
        (x[0].truncate() - place - speed * time).length() + (v[0].truncate() - way - speed).length()
    };
    for speed in [DVec3::ZERO, DVec3::new(0.3, -0.2, 0.5)] {
        // Rounding is near: slopes are not those of infinitely short steps, which are 15.
        let [coarse, fine] = [4, 8].map(|steps| error(0.5, 2.3, steps, speed));
        let slope = (coarse / fine).log2();
        assert!((12.5..16.0).contains(&slope) && fine < 2e-11, "{speed}: {slope}, {fine:e}");
        // On a circle three steps of two radians each have an error of 4e-12.
        let circle = error(0.0, 6.0, 4, speed);
        assert!(circle < 1e-12, "{speed}: {circle:e}");
    }
}

#[test]
fn forces_of_velocity_and_time() {
    let (time, rate) = (1.3f64, 0.8);
    let start = one(DVec3::new(0.3, -0.4, 0.2), DVec3::new(0.7, 0.5, -0.6));
    let (x, v) = (start.position()[0], start.velocity()[0]);
    let mut simulation =
        cpu(&start, vec![force("drag", &[("linear", Value::Number(rate))])], "gauss_radau", time / 4.0);
    simulation.step(4).expect("steps");
    let (there, fast) = phase(&mut simulation);
    let slower = (-rate * time).exp();
    let far = (there[0].truncate() - (x + v * (1.0 - slower) / rate)).length();
    assert!(far + (fast[0].truncate() - v * slower).length() < 1e-13, "{far:e}");
    let gusts = || {
        let settings =
            [("velocity", vector(0.6, 0.2, -0.3)), ("gust", Value::Number(0.7)), ("period", Value::Number(0.9))];
        let more = [("wavelength", Value::Number(2.3))];
        vec![force("wind", &[&settings[..], &more[..]].concat()), force("drag", &[("quadratic", Value::Number(0.4))])]
    };
    let ends = [("rk4", 4096), ("gauss_radau", 8)].map(|(name, steps)| {
        let mut simulation = cpu(&start, gusts(), name, time / f64::from(steps));
        simulation.step(steps).expect("steps");
        phase(&mut simulation)
    });
    // The error of rk4 is (h / 0.9)⁴ times a part of the gusts: 1e-13.
    let [fine, coarse] = ends;
    assert!((fine.0[0] - coarse.0[0]).length() + (fine.1[0] - coarse.1[0]).length() < 1e-11);
}

/// A few bodies, as they fall.
fn few(count: usize, seed: u64) -> State {
    let mut random = Random::new(seed);
    let mut state = State::default();
    for _ in 0..count {
        state.push(random.vector(), 0.5 * random.vector(), 1.0 + 0.5 * random.next(), 0.0);
    }
    state
}

#[test]
fn a_first_step_that_is_too_long_is_tried_again() {
    let shared = support::device();
    for seed in 1..4 {
        let start = few(5, seed);
        let ends = [0.015_625, 4.0].map(|longest| {
            let mut simulation = references(&adaptive(&start, gravity(), longest, Precision::Compensated));
            until(&mut simulation, 0.25, longest);
            // Only steps that were made count.
            let (clock, tried) = (clock(&mut simulation), pollster::block_on(simulation.unsettled()).expect("tries"));
            assert!(clock.between[1] < 0.1 && tried.is_some() == (longest > 1.0), "{seed}: {clock:?}, {tried:?}");
            state(&mut simulation)
        });
        let apart = |a: &State, b: &State| {
            a.position().iter().zip(b.position()).map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max)
        };
        assert!(apart(&ends[0], &ends[1]) < 1e-9, "{seed}: {:e}", apart(&ends[0], &ends[1]));
        // The same on a device, as well as forces of single precision allow.
        let mut simulation = on(&shared, &adaptive(&start, gravity(), 4.0, Precision::DoubleSingle));
        until(&mut simulation, 0.25, 4.0);
        let error = apart(&ends[0], &state(&mut simulation));
        assert!(error < 1e-5, "{seed}: {error:e}");
    }
}

/// Steps that grow from very short ones let speeds double again and again.
#[test]
fn a_slow_start_is_no_runaway() {
    let mut setup = adaptive(&pythagorean(), gravity(), 0.1, Precision::Single);
    let adaptive_step = AdaptiveStep { least: 1e-7, courant: 0.25, before: Some(1e-7) };
    setup.integrator = Box::new(Adaptive { integrator: integrator("gauss_radau"), adaptive_step });
    let mut simulation = references(&setup);
    until(&mut simulation, 1.0, 0.1);
    pollster::block_on(simulation.check()).expect("no alarm");
    assert!(away(&state(&mut simulation), &PYTHAGOREAN[0].1) < 1e-12);
}

#[test]
fn stops_cost_little_and_change_little() {
    let start = few(5, 7);
    let run = |stops: u32| {
        let mut simulation = references(&adaptive(&start, gravity(), 0.5, Precision::Single));
        for stop in 1..=stops {
            until(&mut simulation, 0.6 * f64::from(stop) / f64::from(stops), 0.5);
        }
        (clock(&mut simulation).steps, state(&mut simulation))
    };
    let ((once, straight), (often, stopped)) = (run(1), run(7));
    assert!(often <= once + 2 * 7 + 4, "{often} steps, and {once} without stops");
    for (a, b) in straight.position().iter().zip(stopped.position()) {
        assert!((*a - *b).length() < 1e-10, "{a}, {b}");
    }
}

#[test]
fn a_run_goes_on_to_the_bit() {
    let shared = support::device();
    for precision in [Precision::Single, Precision::DoubleSingle] {
        let start = few(6, 11);
        let setup = adaptive(&start, gravity(), 0.25, precision);
        let mut whole = on(&shared, &setup);
        whole.step(20).expect("steps");
        let middle = state(&mut whole);
        whole.step(15).expect("steps");
        let mut again = on(&shared, &Setup { state: middle, ..adaptive(&start, gravity(), 0.25, precision) });
        assert!(again.goes_on());
        again.step(15).expect("steps");
        let ends = [state(&mut whole), state(&mut again)];
        assert_eq!(ends[0].position(), ends[1].position(), "{precision:?}");
        assert_eq!(ends[0].velocity(), ends[1].velocity(), "{precision:?}");
        assert_eq!(clock(&mut whole).time.to_bits(), clock(&mut again).time.to_bits());
    }
}

#[test]
fn every_kernel_agrees_with_its_reference() {
    let shared = support::device();
    for precision in [Precision::Single, Precision::Compensated, Precision::DoubleSingle] {
        for (name, machine) in machines::machines(&shared) {
            for (count, seed, is_adaptive) in [(1usize, 1, true), (65, 2, true), (333, 3, false)] {
                let mut state = few(count, seed);
                state.position_mut().iter_mut().for_each(|x| *x *= 3.0);
                let forces = || vec![force("gravity", &[("softening", Value::Number(0.5))]), force("uniform", &[])];
                let mut setup = adaptive(&state, forces(), 0.01, precision);
                if !is_adaptive {
                    setup.integrator = Box::new(Precise { integrator: integrator("gauss_radau"), precision });
                }
                let mut gpu = machines::gpu(&shared, count);
                gpu.pretend(machine);
                let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
                simulation.step(2).expect("steps");
                let plan = setup.plans(machine).expect("plans").step;
                let gpu = simulation.backend();
                gpu.compile(&plan).expect("a program");
                let count = u32::try_from(count).expect("few");
                let verdicts = pollster::block_on(compare(gpu, &plan, count)).expect("verdicts");
                assert!(verdicts.iter().any(|verdict| verdict.kernel == "end along nodes"));
                for verdict in &verdicts {
                    // Differences of accelerations that are nearly the same: as far as these say anything.
                    let own = ["begin along", "node", "measure", "end along"];
                    let differs = own.iter().any(|name| verdict.kernel.starts_with(name));
                    let good = if differs { verdict.sound() } else { agrees(verdict) };
                    assert!(good, "{precision:?}, {name}, {count}: {verdict:?}");
                }
            }
        }
    }
}

/// Fixed steps that are too long for the iterations are counted.
#[test]
fn what_does_not_settle_is_said() {
    let shared = support::device();
    let run = |dt: f64| {
        let setup = Setup { integrator: integrator("gauss_radau"), ..Setup::new(few(5, 3), gravity(), dt) };
        let mut simulation = on(&shared, &setup);
        simulation.step(3).expect("steps");
        let mut same = references(&setup);
        same.step(3).expect("steps");
        [
            pollster::block_on(simulation.unsettled()).expect("a report"),
            pollster::block_on(same.unsettled()).expect("a report"),
        ]
    };
    assert_eq!(run(1e-3), [None; 2]);
    // A run that goes on knows of those before.
    let setup = Setup { integrator: integrator("gauss_radau"), ..Setup::new(few(5, 3), gravity(), 3.0) };
    let mut first = references(&setup);
    first.step(2).expect("steps");
    let middle = state(&mut first);
    let mut second = references(&Setup {
        state: middle,
        integrator: integrator("gauss_radau"),
        ..Setup::new(few(5, 3), gravity(), 3.0)
    });
    let both = [pollster::block_on(first.unsettled()), pollster::block_on(second.unsettled())]
        .map(|all| all.expect("a report"));
    assert!(both[0].is_some() && both[0] == both[1], "{both:?}");
    let [device, host] = run(3.0);
    assert!(device.is_some_and(|unsettled| unsettled.first == 0), "{device:?}");
    assert!(host.is_some_and(|unsettled| unsettled.first == 0), "{host:?}");
}

#[test]
fn what_it_refuses() {
    let shared = support::device();
    let refused = |setup: &Setup| {
        Simulation::new(&shared.found.device, &shared.found.queue, setup).err().expect("refused").to_string()
    };
    let fluid = force("fluid", &[("spacing", Value::Number(0.1)), ("sound_speed", Value::Number(10.0))]);
    let text = refused(&adaptive(&few(5, 1), vec![fluid], 0.01, Precision::Single));
    assert!(text.contains("by its own error, and fluid limits them too"), "{text}");
    let settings =
        [("spacing", Value::Number(0.1)), ("sound_speed", Value::Number(10.0)), ("density_by", word("continuity"))];
    let fluid = vec![force("fluid", &settings)];
    let text = refused(&Setup { integrator: integrator("gauss_radau"), ..Setup::new(few(5, 1), fluid, 1e-4) });
    assert!(text.contains("gauss_radau advances positions and velocities alone"), "{text}");
    // In single precision an encounter leaves no step that is short enough.
    let mut simulation = on(&shared, &adaptive(&pythagorean(), gravity(), 0.1, Precision::Single));
    let ended = (0..20).find_map(|_| {
        simulation.step(50).expect("steps");
        pollster::block_on(simulation.check()).err()
    });
    let text = ended.expect("an end").to_string();
    assert!(text.contains("because of the error") && text.contains("double_single"), "{text}");
}
