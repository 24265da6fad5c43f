//! Read-backs are requests: they block nothing, and give what was there when they were made.

use std::future::Future;
use std::pin::pin;
use std::task::{Context, Poll, Waker};
use std::time::{Duration, Instant};

use glam::Vec4;
use motes::kernel::{Field, POSITION, VELOCITY};
use motes::simulation::Readback;
use motes::{Cpu, Error, Gpu, Simulation};

use super::{on_gpu, setup};
use crate::support::states::force;
use crate::support::{cloud, device, open};

/// Looks until the values are there, and says how often, and how long the longest look took.
fn polled(readback: &mut Readback<Vec4>) -> (Result<Vec<Vec4>, Error>, u32, Duration) {
    let (mut looks, mut longest) = (0, Duration::ZERO);
    loop {
        let start = Instant::now();
        let answer = readback.look();
        longest = longest.max(start.elapsed());
        looks += 1;
        if let Some(answer) = answer {
            return (answer, looks, longest);
        }
        std::thread::sleep(Duration::from_millis(2));
    }
}

#[test]
fn several_are_under_way_and_each_gives_its_own_step() {
    let shared = device();
    let setup = setup(cloud(300, 5), vec![force("gravity", &[("softening", 0.17.into())])]);
    let (mut one, mut other) = (on_gpu(&shared, &setup), on_gpu(&shared, &setup));
    pollster::block_on(async {
        let mut under_way = Vec::new();
        for _ in 0..5 {
            under_way.push((one.request(POSITION).expect("asked"), one.request(VELOCITY).expect("asked")));
            one.step(2).expect("steps");
        }
        // One that is dropped changes nothing.
        drop(under_way.remove(1));
        let mut seen = Vec::new();
        for step in [0, 2, 3, 4] {
            while other.steps() < 2 * step {
                other.step(2).expect("steps");
            }
            seen.push((other.read(POSITION).await.expect("read"), other.read(VELOCITY).await.expect("read")));
        }
        assert_ne!(seen[0], seen[1]);
        // Awaited in another order than they were asked for.
        for ((position, velocity), (x, v)) in under_way.into_iter().zip(seen).rev() {
            assert_eq!(velocity.await.expect("velocities"), v);
            assert_eq!(position.await.expect("positions"), x);
        }
    });
}

#[test]
fn a_look_returns_at_once_while_the_device_works() {
    let shared = device();
    let setup = setup(cloud(16_000, 5), vec![force("gravity", &[("over", "pairs".into())])]);
    let mut simulation = on_gpu(&shared, &setup);
    let mut took = Duration::ZERO;
    for _ in 0..3 {
        let start = Instant::now();
        simulation.step(1).expect("a step");
        simulation.backend().wait().expect("done");
        took = start.elapsed();
    }
    // Steps of 256 million pairs for some tenths of a second, on a fast device as on a slow one.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
    let steps = (0.3 / took.as_secs_f64()).clamp(2.0, 1000.0) as u32;
    // In an encoder of the caller's steps wait for nothing either.
    let submit = |simulation: &mut Simulation<Gpu>| {
        let mut encoder = shared.found.device.create_command_encoder(&motes::wgpu::CommandEncoderDescriptor::default());
        simulation.encode(steps, &mut encoder).expect("steps");
        shared.found.queue.submit([encoder.finish()]);
    };
    let start = Instant::now();
    submit(&mut simulation);
    let mut readback = simulation.request(POSITION).expect("asked");
    let asked = start.elapsed();
    let (values, looks, longest) = polled(&mut readback);
    let all = start.elapsed();
    assert_eq!(values.expect("values").len(), 16_000);
    // A look is no wait for them.
    assert!(longest < all / 4, "{looks} looks, the longest {longest:?} of {all:?}, asked after {asked:?}");
    // Lavapipe before Mesa 25 has done all when a submission returns; elsewhere it continues meanwhile.
    let meanwhile = asked < all / 2;
    assert!(looks > 3 || !meanwhile, "{looks} looks, asked after {asked:?} of {all:?}");
    let again = readback.look().expect("an answer").expect_err("they were given");
    assert!(again.to_string().contains("returned already"), "{again}");
    // A read leaves the executor its turn too.
    submit(&mut simulation);
    let start = Instant::now();
    let mut read = pin!(simulation.read(POSITION));
    let first = read.as_mut().poll(&mut Context::from_waker(Waker::noop()));
    let took = start.elapsed();
    assert!(matches!(first, Poll::Pending) || !meanwhile, "the first poll waited for everything");
    if first.is_pending() {
        pollster::block_on(read).expect("read");
    }
    assert!(took < start.elapsed() / 2 || !meanwhile, "its first poll took {took:?} of {:?}", start.elapsed());
}

#[test]
fn dropped_requests_cost_nothing_and_references_answer_at_once() {
    let shared = device();
    let setup = setup(cloud(40, 5), vec![force("gravity", &[])]);
    let mut simulation = on_gpu(&shared, &setup);
    for _ in 0..200 {
        simulation.step(1).expect("a step");
        drop(simulation.request(POSITION).expect("asked"));
    }
    pollster::block_on(simulation.check()).expect("all is well");
    assert_eq!(simulation.steps(), 200);
    let mut references = Simulation::on(Cpu::new(40).expect("some"), &setup).expect("a simulation");
    let values = references.request(POSITION).expect("asked").look().expect("at once").expect("values");
    assert_eq!(values, pollster::block_on(references.read(POSITION)).expect("read"));
}

#[test]
fn a_lost_device_and_an_unknown_field_are_errors() {
    let shared = open();
    let setup = setup(cloud(40, 5), vec![force("gravity", &[])]);
    let mut simulation = on_gpu(&shared, &setup);
    simulation.step(1).expect("a step");
    let asked = |simulation: &mut Simulation<Gpu>, name| simulation.request::<Vec4>(Field::new(name)).map(drop);
    let said = asked(&mut simulation, "positon").expect_err("no such field").to_string();
    assert!(said.contains("`positon`") && said.contains("did you mean `position`"), "{said}");
    let said = simulation.request::<u32>(Field::new("position")).map(drop).expect_err("no words").to_string();
    assert!(said.contains("vec4f") && said.contains("u32"), "{said}");
    let under_way = simulation.request(POSITION).expect("asked");
    shared.found.device.destroy();
    // It had been done before the device went, or is lost with it; it never waits.
    let answer = pollster::block_on(under_way);
    assert!(matches!(answer, Ok(_) | Err(Error::Lost(_))), "{answer:?}");
    let later = match simulation.request(POSITION) {
        Ok(readback) => pollster::block_on(readback),
        Err(error) => Err(error),
    };
    assert!(matches!(later, Err(Error::Lost(_))), "{later:?}");
    assert!(!later.expect_err("it is lost").to_string().contains("bug"), "no fault of the library's");
    let anew = Simulation::new(&shared.found.device, &shared.found.queue, &setup);
    assert!(matches!(anew, Err(Error::Lost(_))), "{:?}", anew.err());
}
