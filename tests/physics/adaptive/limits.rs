//! Each limit by hand, its reason, and its particle.

use glam::DVec3;
use motes::kernel::Reason;
use motes::settings::Value;
use motes::{Error, State};

use crate::adaptive::{ADAPTIVE, DT, Free, LENGTH, SPACING, Silent, adapted, clock, drop, fluid, on_cpu, on_gpu};
use crate::support::states::{force, vector, word};

/// Lengths are rounded down to twelve binary digits; beside that the device rounds what it multiplies a few times.
const DIGITS: f64 = 1.0 / 2048.0;
const ROUNDING: f64 = 1e-6;

/// Far apart, but for 1 and 2, which come together at 2 × 1.5 along x: so no pair has a pressure force.
fn few() -> State {
    let mut particles = State::default();
    let speeds = [DVec3::new(0.0, 0.4, 0.0), DVec3::X * 1.5, DVec3::X * -1.5, DVec3::new(0.0, 0.0, 0.7)];
    let places = [DVec3::new(0.0, 9.0, 0.0), DVec3::ZERO, DVec3::X * 0.15, DVec3::new(0.0, 0.0, 8.0)];
    for (x, v) in places.into_iter().zip(speeds) {
        particles.push(x, v, 0.25, 0.02);
    }
    particles
}

#[test]
fn a_step_is_as_long_as_its_formula_says() {
    let (c, r) = (ADAPTIVE.courant, f64::from(0.15f32));
    let mu = LENGTH * 3.0 * r / (r * r + 0.01 * LENGTH * LENGTH);
    let weight = |g: f64| force("uniform", &[("acceleration", vector(0.0, 0.0, -g))]);
    let morris = ("viscosity_form", word("morris"));
    // (forces, what limits, which particle, how long)
    let cases = [
        ("signal", vec![fluid(9.0, &[])], Some(1), c * LENGTH / (9.0 + mu)),
        (
            "signal",
            vec![fluid(3.0, &[("alpha", Value::Number(5.0))])],
            Some(1),
            c * LENGTH / (3.0 + mu + 0.6 * 5.0 * 3.0),
        ),
        ("acceleration", vec![weight(700.0), fluid(0.3, &[])], Some(0), c * (LENGTH / 700.0f64).sqrt()),
        ("viscosity", vec![fluid(0.3, &[("viscosity", Value::Number(0.5))])], None, 0.05 * LENGTH * LENGTH / 0.5),
        (
            "viscosity",
            vec![fluid(0.3, &[("viscosity", Value::Number(0.5)), morris])],
            None,
            0.125 * LENGTH * LENGTH / 0.5,
        ),
        ("speed", vec![weight(0.1), Box::new(Silent) as _], Some(1), c * 0.4 * SPACING / 1.5),
        ("longest", vec![Box::new(Free) as _], None, DT),
    ];
    let shared = crate::support::device();
    for (name, forces, limiting, dt) in cases {
        let setup = adapted(&few(), forces, "leapfrog", ADAPTIVE);
        let (mut device, mut reference) = (on_gpu(&shared, &setup), on_cpu(&setup));
        device.step(1).expect("a step");
        reference.step(1).expect("a step");
        for now in [clock(&mut device), clock(&mut reference)] {
            assert_eq!((now.reason.name(), now.particle, now.steps), (name, limiting, 1), "{now:?}");
            let good = (1.0 - DIGITS - ROUNDING)..=(1.0 + ROUNDING);
            assert!(good.contains(&(now.dt / dt)), "{name}: {} is not {dt}", now.dt);
            // One digit fewer would be seen: no step here is a whole power of two.
            assert!(name == "longest" || dt < 0.9 * DT, "{name} must be shorter than the longest");
            assert_eq!(now.reasons.iter().sum::<u32>(), 1);
            assert_eq!(now.between.map(f64::to_bits), [now.dt.to_bits(); 2]);
        }
    }
}

#[test]
fn steps_grow_by_a_fifth_at_most() {
    let adaptive_step = motes::kernel::AdaptiveStep { before: Some(DT / 64.0), ..ADAPTIVE };
    let shared = crate::support::device();
    let mut simulation = on_gpu(&shared, &adapted(&few(), vec![Box::new(Free)], "leapfrog", adaptive_step));
    let mut last = DT / 64.0;
    let mut grown = 0;
    for _ in 0..30 {
        simulation.step(1).expect("a step");
        let now = clock(&mut simulation);
        // A fifth of an integer of ticks, of which there are 260000 or more.
        assert!(now.dt <= 1.2 * last && (now.dt > 1.2 * last * (1.0 - 1e-5) || now.dt >= DT), "{last} then {}", now.dt);
        grown += u32::from(now.reason == Reason::Growth);
        last = now.dt;
    }
    // 1.2²² = 55 and 1.2²³ = 66: 22 steps are held back.
    assert_eq!((grown, last), (22, DT));
}

#[test]
fn device_and_references_take_the_same_steps() {
    let shared = crate::support::device();
    for name in ["leapfrog", "symplectic_euler", "midpoint", "heun", "rk4", "forest_ruth", "pefrl", "forward_euler"] {
        let weight = force("uniform", &[("acceleration", vector(0.0, 0.0, -3.0))]);
        let setup = adapted(&drop(), vec![weight, fluid(4.0, &[("alpha", Value::Number(0.2))])], name, ADAPTIVE);
        let (mut device, mut reference) = (on_gpu(&shared, &setup), on_cpu(&setup));
        let mut alike = 0;
        for _ in 0..12 {
            device.step(1).expect("a step");
            reference.step(1).expect("a step");
            let (here, there) = (clock(&mut device), clock(&mut reference));
            assert_eq!(here.reason, there.reason, "{name}");
            // Where a length is at the edge of a digit, rounding takes it to either side.
            assert!((here.dt - there.dt).abs() <= 2.0 * DIGITS * there.dt, "{name}: {} and {}", here.dt, there.dt);
            alike += u32::from(here.dt.to_bits() == there.dt.to_bits());
        }
        // Rates differ by about 1e-6, so that one step in 500 is at an edge.
        assert!(alike >= 11, "{name}: {alike} of 12 steps are alike");
        assert!(clock(&mut device).reasons[Reason::Signal as usize] > 0, "{name} must be limited");
        assert!((device.steps(), reference.steps()) == (12, 12));
    }
}

#[test]
fn too_short_a_step_ends_a_run() {
    let weight = force("uniform", &[("acceleration", vector(0.0, 0.0, -7e8))]);
    let setup = adapted(&few(), vec![weight, fluid(9.0, &[])], "leapfrog", ADAPTIVE);
    let shared = crate::support::device();
    let mut device = on_gpu(&shared, &setup);
    pollster::block_on(device.check()).expect("nothing has happened yet");
    device.step(3).expect("steps");
    let Err(Error::TooShort { step, wanted, least, reason, particle, .. }) = pollster::block_on(device.check()) else {
        panic!("a step of a millionth must be reported");
    };
    assert_eq!((step, reason, particle.as_str(), least), (0, "acceleration", "particle 0", ADAPTIVE.least));
    let want = ADAPTIVE.courant * (LENGTH / 7e8f64).sqrt();
    assert!((wanted / want - 1.0).abs() < ROUNDING, "{wanted} is not {want}");
    // None is shorter than the shortest, whatever is asked for: 16777 ticks.
    assert!((clock(&mut device).dt / ADAPTIVE.least - 1.0).abs() < 1e-4);
    let mut reference = on_cpu(&setup);
    reference.step(3).expect("steps");
    let said = pollster::block_on(reference.check()).expect_err("the reference says the same").to_string();
    assert!(
        said.contains("step 0") && said.contains("acceleration of particle 0") && said.contains("dt_min"),
        "{said}"
    );
}

#[test]
fn what_makes_no_sense_is_refused() {
    let refused = |forces: Vec<Box<dyn motes::forces::Component>>, name: &str, adaptive_step| {
        let setup = adapted(&few(), forces, name, adaptive_step);
        let shared = crate::support::device();
        match motes::Simulation::new(&shared.found.device, &shared.found.queue, &setup) {
            Ok(_) => panic!("it must be refused"),
            Err(error) => error.to_string(),
        }
    };
    let free = || -> Vec<Box<dyn motes::forces::Component>> { vec![Box::new(Free)] };
    let no_limit = refused(vec![force("gravity", &[])], "leapfrog", ADAPTIVE);
    assert!(no_limit.contains("no force limits the time step"), "{no_limit}");
    let two = refused(vec![Box::new(Free), Box::new(Free)], "leapfrog", ADAPTIVE);
    assert!(two.contains("2 forces limit"), "{two}");
    assert!(refused(free(), "backward_euler", ADAPTIVE).contains("implicit"));
    let even = refused(vec![Box::new(Free), force("wander", &[])], "leapfrog", ADAPTIVE);
    assert!(even.contains("random walk"), "{even}");
    let with = |least: f64, courant: f64, before: Option<f64>| motes::kernel::AdaptiveStep { least, courant, before };
    for (adaptive_step, says) in [
        (with(1.01 * DT, 0.3, None), "shortest step"),
        (with(0.9e-6 * DT, 0.3, None), "shortest step"),
        (with(DT / 10.0, 1.01, None), "Courant"),
        (with(DT / 10.0, 0.0, None), "Courant"),
        (with(DT / 10.0, 0.3, Some(DT / 11.0)), "before the first"),
        (with(DT / 10.0, 0.3, Some(1.1 * DT)), "before the first"),
    ] {
        let said = refused(free(), "leapfrog", adaptive_step);
        assert!(said.contains(says), "{said}");
    }
}

/// The longest step that a viscosity allows is stable: the shortest wave dies out, and at eight times as long a step it does not. Along
/// the lattice it is longitudinal, which a central force damps fastest.
#[test]
fn what_viscosity_bears_is_what_is_allowed() {
    let side = 12;
    let shear = |times: f64, form: &'static str, support: f64, kernel: &'static str| {
        let mut particles = State::default();
        for i in 0..side * side {
            let place = DVec3::new(f64::from(i % side) + 0.5, f64::from(i / side) + 0.5, 0.0);
            // The shortest waves there are: a chequered one, and one along x.
            let odd = if form == "morris" { i % side + i / side } else { i % side };
            let v = if odd % 2 == 0 { 0.01 } else { -0.01 };
            particles.push(SPACING * place, DVec3::X * v, 1000.0 * SPACING * SPACING, 0.0);
        }
        let size = DVec3::new(1.0, 1.0, 0.0) * SPACING * f64::from(side);
        let more = [
            ("viscosity", Value::Number(0.5)),
            ("viscosity_form", word(form)),
            ("support", Value::Number(support)),
            ("kernel", word(kernel)),
            ("negative_pressure", Value::Flag(true)),
        ];
        let length = 0.5 * support * SPACING;
        let setup = motes::Setup {
            state: particles,
            forces: vec![fluid(0.01, &more)],
            integrator: crate::support::states::integrator("leapfrog"),
            dt: times * if form == "morris" { 0.125 } else { 0.05 } * length * length / 0.5,
            bounds: motes::Bounds::new(DVec3::ZERO, size, motes::Side::Periodic),
            solver: motes::Solver::default(),
        };
        let mut simulation = on_cpu(&setup);
        simulation.step(40).expect("steps");
        let state = pollster::block_on(simulation.snapshot()).expect("a snapshot");
        state.velocity().iter().map(|v| v.length()).fold(0.0, f64::max)
    };
    for (support, kernel) in [(2.0, "cubic"), (3.0, "wendland"), (2.0, "wendland"), (4.0, "wendland")] {
        for form in ["morris", "central"] {
            let (allowed, more) = (shear(1.0, form, support, kernel), shear(8.0, form, support, kernel));
            println!("{form} {kernel} {support}: {allowed:e} {more:e}");
            assert!(allowed < 0.001 && more > 0.01, "{form} {kernel}, {support} spacings: {allowed:e}, {more:e}");
        }
    }
}
