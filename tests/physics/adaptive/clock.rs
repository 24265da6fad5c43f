//! The time by a clock of ticks: stops are reached exactly, batches and reruns give the same bits, and methods keep their order.

use glam::DVec3;
use motes::kernel::{Backend, POSITION, Reason, VELOCITY};
use motes::settings::Value;
use motes::{Simulation, State};

use crate::adaptive::{ADAPTIVE, DT, Free, adapted, clock, drop, fluid, on_cpu, on_gpu};
use crate::support::states::{force, vector};

fn bytes<B: Backend>(simulation: &mut Simulation<B>) -> Vec<u8> {
    pollster::block_on(async {
        let mut all = Vec::new();
        for field in [POSITION, VELOCITY] {
            all.extend_from_slice(bytemuck::cast_slice(&simulation.read(field).await.expect("a field")));
        }
        all
    })
}

/// Without friction, or with some.
fn falling_with(alpha: f64) -> motes::Setup {
    let weight = force("uniform", &[("acceleration", vector(0.0, 0.0, -3.0))]);
    adapted(&drop(), vec![weight, fluid(4.0, &[("alpha", Value::Number(alpha))])], "leapfrog", ADAPTIVE)
}

fn falling() -> motes::Setup {
    falling_with(0.2)
}

#[test]
fn a_run_ends_where_it_shall() {
    let shared = crate::support::device();
    // At a stop forces are evaluated again, with velocities at rest: only those that depend on velocities differ by that.
    let smooth = falling_with(0.0);
    let (mut device, mut reference) = (on_gpu(&shared, &smooth), on_cpu(&smooth));
    // No whole number of anything.
    let until = 0.071_234_567;
    let stop = device.stop_at(until).expect("a stop");
    assert!((stop - until).abs() <= DT / f64::from(1 << 25), "{stop} is not {until}");
    assert!(stop.to_bits() == reference.stop_at(until).expect("a stop").to_bits());
    device.step(40).expect("steps");
    reference.step(40).expect("steps");
    let (now, there) = (clock(&mut device), clock(&mut reference));
    assert_eq!((now.time, there.time, now.dt, now.reason), (stop, stop, 0.0, Reason::Stop));
    assert!(now.steps > 5 && now.steps < 40 && now.steps == device.steps(), "{now:?}");
    // The last were made alike, two or, where the limit has shrunk in between, three, rather than one long and one tiny.
    assert!((2..=3).contains(&now.reasons[Reason::Stop as usize]) && now.between[0] > 0.4 * now.between[1], "{now:?}");
    let rests = bytes(&mut device);
    device.step(20).expect("steps that do nothing");
    assert!(bytes(&mut device) == rests && clock(&mut device) == now, "nothing may change at a stop");
    // On to another stop, as if it had not rested: a run that did not do nothing in between has the same bits.
    device.stop_at(0.1).expect("a stop");
    device.step(30).expect("steps");
    let mut other = on_gpu(&shared, &smooth);
    other.stop_at(until).expect("a stop");
    other.step(u32::try_from(now.steps).expect("few")).expect("steps");
    let end = other.stop_at(0.1).expect("a stop");
    other.step(30).expect("steps");
    assert!(bytes(&mut device) == bytes(&mut other) && bytes(&mut device) != rests);
    assert_eq!((clock(&mut device), clock(&mut device).time), (clock(&mut other), end));
    assert!(device.stop_at(1e12).is_err() && device.stop_at(f64::NAN).is_err());
}

#[test]
fn batches_and_measurements_change_no_bit() {
    let shared = crate::support::device();
    let mut together = on_gpu(&shared, &falling());
    together.step(24).expect("steps");
    let mut apart = on_gpu(&shared, &falling());
    for k in 0..8 {
        apart.step(3).expect("steps");
        if k % 2 == 0 {
            let snapshot = pollster::block_on(apart.snapshot()).expect("a snapshot");
            assert!(snapshot.time.to_bits() == clock(&mut apart).time.to_bits() && snapshot.step == 3 * (k + 1));
        }
    }
    assert!(bytes(&mut together) == bytes(&mut apart));
    assert_eq!(clock(&mut together), clock(&mut apart));
    assert!(clock(&mut together).time > 0.0 && clock(&mut together).time < 24.0 * DT);
}

#[test]
fn it_is_known_how_many_steps_are_safe() {
    let shared = crate::support::device();
    let mut device = on_gpu(&shared, &falling());
    let stop = device.stop_at(0.2).expect("a stop");
    let mut asked = 0u32;
    while clock(&mut device).time < stop {
        let some = clock(&mut device).steps_before(stop, DT);
        let before = clock(&mut device).steps;
        device.step(some).expect("steps");
        let now = clock(&mut device);
        assert!(now.dt > 0.0 && now.steps == before + u64::from(some), "none of {some} may be a rest: {now:?}");
        asked += 1;
        assert!(asked < 100, "it must end");
    }
    assert!(asked > 1 && u64::from(asked) < clock(&mut device).steps, "{asked} looks");
}

/// The end of an orbit about a softened centre, in steps that were chosen before: h (1 + ½ sin 3t), about `1 / n` long.
fn orbit(name: &str, n: u32) -> DVec3 {
    let mut particles = State::default();
    particles.push(DVec3::new(0.8, 0.1, -0.2), DVec3::new(-0.2, 0.9, 0.3), 1.0, 0.0);
    let centre = force("attractor", &[("strength", Value::Number(1.0)), ("softening", Value::Number(0.2))]);
    let mut setup = adapted(&particles, vec![centre, Box::new(Free)], name, ADAPTIVE);
    setup.dt = 2.0 / f64::from(n);
    let mut simulation = on_cpu(&setup);
    // Steps as a smooth function of the number: between the nodes of a fixed map of [0, 1] to the time.
    let time = |u: f64| 2.0 * (u + 0.1 * (6.0 * u).sin() / 6.0 - 0.1 * u * 6.0f64.sin() / 6.0);
    for k in 1..=2 * n {
        simulation.stop_at(time(f64::from(k) / f64::from(2 * n))).expect("a stop");
        simulation.step(1).expect("a step");
    }
    let now = clock(&mut simulation);
    assert!((now.time - 2.0).abs() < 1e-6 && now.steps == u64::from(2 * n), "{now:?}");
    assert!(now.between[1] > 1.15 * now.between[0], "steps must differ: {now:?}");
    let host = simulation.backend().host().read(POSITION).expect("positions")[0];
    host.truncate()
}

#[test]
fn methods_keep_their_order_in_steps_that_differ() {
    for (name, order) in [("symplectic_euler", 1.0), ("leapfrog", 2.0), ("midpoint", 2.0), ("heun", 2.0), ("rk4", 4.0)]
    {
        let ends = [40, 80, 160].map(|n| orbit(name, n));
        // (x(2h) − x(h)) / (x(h) − x(h/2)) → 2^order.
        let slope = ((ends[0] - ends[1]).length() / (ends[1] - ends[2]).length()).log2();
        // The next order makes a few hundredths here; ticks, at 2⁻²⁴ of a step, nothing.
        assert!((slope - order).abs() < 0.15, "{name} has order {slope}");
    }
}
