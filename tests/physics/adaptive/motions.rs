//! What moves by itself goes by the time, not by the number of steps.

use glam::DVec3;
use motes::State;
use motes::kernel::{POSITION, TARGET};
use motes::motion::{Held, Hold, Keyframe, Motion};
use motes::settings::Value;

use crate::adaptive::{ADAPTIVE, DT, Free, adapted, clock, on_gpu};
use crate::support::states::{force, word};

fn swing() -> Motion {
    let key = |time: f64, x: f64, turn: f64| Keyframe {
        time,
        shift: DVec3::new(x, -0.3 * x, 0.1 * x),
        turn: DVec3::new(0.2 * turn, turn, -0.4 * turn),
    };
    Motion {
        name: "swing".to_owned(),
        about: DVec3::new(0.1, 0.2, -0.1),
        keys: vec![key(0.011, 0.0, 0.1), key(0.043, 0.7, 0.8), key(0.062, 0.2, -0.3), key(0.09, 0.0, 0.1)],
        smooth: true,
        repeat: true,
    }
}

#[test]
fn held_ones_are_where_the_time_says() {
    let mut particles = State::default();
    for x in [DVec3::new(0.5, 0.1, 0.3), DVec3::new(-0.2, 0.4, 0.1), DVec3::new(0.3, 0.3, 0.3)] {
        particles.push(x, DVec3::ZERO, 1.0, 0.01);
    }
    particles.motions = vec![swing()];
    let hold = [Hold::Motion(0), Hold::Target, Hold::Fixed];
    particles.held = (0..3).zip(hold).map(|(id, by)| Held { id, by }).collect();
    let homes = particles.position().to_vec();
    for name in ["leapfrog", "rk4"] {
        let setup = adapted(&particles, vec![Box::new(Free)], name, ADAPTIVE);
        let shared = crate::support::device();
        let mut simulation = on_gpu(&shared, &setup);
        let goal = DVec3::new(0.9, -0.4, 0.2);
        let aims = [DVec3::ZERO, goal, DVec3::ZERO].map(|x| x.as_vec3().extend(0.11));
        simulation.write(TARGET, &aims).expect("targets");
        // Lengths that are no parts of each other, and less than the longest.
        let mut time = 0.0;
        for k in 0..24u32 {
            time += DT * (0.2 + 0.7 * f64::from(k * 5 % 7) / 7.0);
            let stop = simulation.stop_at(time).expect("a stop");
            simulation.step(1).expect("a step");
            assert!(clock(&mut simulation).time.to_bits() == stop.to_bits(), "one step must do");
            let places = pollster::block_on(simulation.read(POSITION)).expect("positions");
            let place = |id: usize| places[id].truncate().as_dvec3();
            let led = swing().place(homes[0], stop);
            let aimed = homes[1] + (goal - homes[1]) * (stop / 0.11).min(1.0);
            // Rounding of places near 1 in each of 24 steps, and of the turn.
            for (id, want) in [(0, led), (1, aimed), (2, homes[2])] {
                assert!((place(id) - want).length() < 3e-6, "{name}, step {k}: {id} is at {}, not {want}", place(id));
            }
        }
    }
}

#[test]
fn solids_are_where_the_time_says() {
    let mut particles = State::default();
    // One stands still, and the wall comes to it.
    particles.push(DVec3::new(0.05, 0.0, 0.0), DVec3::ZERO, 1.0, 0.01);
    let key = |time: f64, x: f64| Keyframe { time, shift: DVec3::X * x, turn: DVec3::ZERO };
    particles.motions =
        vec![Motion { name: "push".to_owned(), keys: vec![key(0.0, 0.0), key(1.0, 2.0)], ..Motion::default() }];
    let wall = force(
        "solid",
        &[
            ("shape", word("plane")),
            ("normal", Value::Vector(DVec3::X)),
            ("motion", word("push")),
            ("friction", Value::Number(0.0)),
        ],
    );
    let setup = adapted(&particles, vec![wall, Box::new(Free)], "leapfrog", ADAPTIVE);
    let shared = crate::support::device();
    let mut simulation = on_gpu(&shared, &setup);
    let mut time = 0.0;
    for k in 0..12u32 {
        time += DT * (0.2 + 0.7 * f64::from(k * 5 % 7) / 7.0);
        let stop = simulation.stop_at(time).expect("a stop");
        simulation.step(1).expect("a step");
        let x = f64::from(pollster::block_on(simulation.read(POSITION)).expect("positions")[0].x);
        // It has gone 2 t; a particle behind it is put on it.
        assert!((x - (2.0 * stop).max(0.05)).abs() < 1e-6, "after {stop} at {x}");
    }
    assert!(time > 0.05, "it must have been met");
}
