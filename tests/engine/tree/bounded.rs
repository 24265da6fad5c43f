//! The group of targets with the most interactions on its walk has at most ten times the average: a dispatch waits for it.
//!
//! `TREE_BODIES=1000000 TREE_SEEDS=20 cargo test --release --test engine tree::bounded -- --nocapture` looks at as many as one likes.

use glam::{DVec3, Vec4};
use motes::kernel::{ACCELERATION, POSITION};
use motes::settings::{Settings as Words, Value};
use motes::tree::Opening;
use motes::{Bounds, Side, shapes};

use crate::support::{self, Random, Shared, machines};
use crate::tree::met::met;
use crate::tree::walks::{Alone, USUAL, Walk, gravity};

const GEOMETRIC: Opening = Opening::Geometric { theta: 0.7 };
const RELATIVE: Opening = Opening::Relative { alpha: 0.005, g: 1.0, theta: 0.7 };

fn number(name: &str, usual: u32) -> u32 {
    std::env::var(name).map_or(usual, |text| text.parse().expect("a number"))
}

/// A shape of the library, by its keys.
fn built(name: &str, count: u32, seed: u32, more: &[(&'static str, Value)]) -> Vec<DVec3> {
    let shape = shapes::shape(name).expect("a shape");
    let words = Words::defaults(shape.keys)
        .with("count", Value::Number(f64::from(count)))
        .with("seed", Value::Number(f64::from(seed)));
    let words = more.iter().fold(words, |words, (key, x)| words.with(key, x.clone()));
    (shape.build)(&words).expect("particles").position().to_vec()
}

/// Shapes by name, each of about so many bodies.
fn shapes(count: u32, seed: u32) -> Vec<(&'static str, Vec<DVec3>)> {
    let mut random = Random::new(u64::from(seed));
    let half = |name: &str| built(name, count / 2, seed, &[]);
    let apart = |name: &str, by: DVec3| -> Vec<DVec3> {
        half(name).into_iter().flat_map(|x| [x - by, by + DVec3::new(x.z, x.x, x.y)]).collect()
    };
    let flat = [("halo_mass", Value::Number(0.0)), ("disk_height", Value::Number(0.05))];
    let mut drawn = |place: &dyn Fn(DVec3) -> DVec3| (0..count).map(|_| place(random.vector())).collect::<Vec<_>>();
    let shell = drawn(&DVec3::normalize);
    let halo = |(i, x): (usize, DVec3)| if i % 20 == 0 { x * 2.0 } else { x.normalize() };
    let around = drawn(&|x| x).into_iter().enumerate().map(halo).collect();
    let line = drawn(&|x| DVec3::new(x.x, 0.0, 0.0));
    let skew = drawn(&|x| x.x * DVec3::new(1.0, -2.0, 0.5));
    let cusp = drawn(&|x| x * x.length().powi(3));
    vec![
        ("plummer", built("plummer", count, seed, &[])),
        ("hernquist", built("hernquist", count, seed, &[])),
        ("a thin disk", built("disk", count, seed, &flat)),
        ("a disk in its halo", built("disk", count, seed, &[])),
        ("a merger", apart("disk", DVec3::new(12.0, 5.0, 1.0))),
        ("clusters", built("clusters", count, seed, &[])),
        ("sphere", built("sphere", count, seed, &[])),
        ("two far clusters", apart("plummer", DVec3::new(1e4, 3e3, 0.0))),
        ("a shell", shell),
        ("a shell in its halo", around),
        ("a line", line),
        ("a skew line", skew),
        ("a cusp", cusp),
    ]
}

fn bodies(places: &[DVec3]) -> Vec<Vec4> {
    places.iter().map(|x| x.extend(1.0 / places.len() as f64).as_vec4()).collect()
}

/// How many times the average the interactions of the target with the most, and that average.
fn spread(walk: &mut Walk, bodies: &[Vec4], last: &[Vec4]) -> (f32, f32) {
    walk.simulation.write(POSITION, bodies).expect("bodies");
    walk.simulation.write(ACCELERATION, last).expect("their last accelerations");
    let met: Vec<f32> = walk.run().iter().map(|met| met.x + met.y).collect();
    let mean = met.iter().map(|met| f64::from(*met)).sum::<f64>() / met.len() as f64;
    (met.iter().fold(0.0_f32, |most, met| most.max(*met)) / mean as f32, mean as f32)
}

/// The walk that is fastest here; all of them evaluate the same.
fn walk(shared: &Shared, bodies: &[Vec4], bounds: Bounds, opening: Opening) -> Walk {
    let machine = machines::walkers(shared).into_iter().last().expect("a walk").1;
    let gpu = machines::gpu(shared, bodies.len());
    Walk::within(gpu, machine, bodies, bounds, Box::new(Alone(met(opening, 0.0))))
}

#[test]
fn no_group_meets_ten_times_the_average() {
    let shared = support::device();
    let (count, seeds) = (number("TREE_BODIES", 20_000), number("TREE_SEEDS", 2));
    let mut counters: Vec<Walk> = Vec::new();
    let mut pulls: Option<Walk> = None;
    for seed in 1..=seeds {
        for (shape, places) in shapes(count, seed) {
            let bodies = bodies(&places);
            if counters.first().is_none_or(|walk| walk.count() != bodies.len()) {
                counters = [GEOMETRIC, RELATIVE].map(|to| walk(&shared, &bodies, Bounds::default(), to)).into();
                let machine = machines::walkers(&shared).into_iter().last().expect("a walk").1;
                pulls = Some(Walk::new(&shared, machine, &bodies, gravity("tree", USUAL)));
            }
            let pulls = pulls.as_mut().expect("gravity");
            pulls.simulation.write(POSITION, &bodies).expect("bodies");
            let last = pulls.run();
            pollster::block_on(pulls.simulation.check()).expect("no size, seed or shape ends a run");
            for (walk, opening) in counters.iter_mut().zip([GEOMETRIC, RELATIVE]) {
                let (ratio, mean) = spread(walk, &bodies, &last);
                println!("{shape}, seed {seed}, {opening}: {ratio:.2} times {mean:.0}");
                assert!(ratio <= 10.0, "{shape}, seed {seed}, {opening}: a group meets {ratio:.1} times {mean:.0}");
            }
        }
    }
}

#[test]
fn nor_does_one_in_a_periodic_box() {
    let shared = support::device();
    let (count, seeds) = (number("TREE_BODIES", 20_000), number("TREE_SEEDS", 2));
    let bounds = Bounds::new(DVec3::splat(-1.0), DVec3::splat(1.0), Side::Periodic);
    for seed in 1..=seeds {
        let mut random = Random::new(u64::from(seed));
        let even: Vec<DVec3> = (0..count).map(|_| random.vector()).collect();
        let dense = even.iter().map(|x| *x * x.length_squared() / 3.0).collect();
        for (shape, places) in [("a box", even), ("a dense box", dense)] {
            let bodies = bodies(&places);
            let none = vec![Vec4::ZERO; bodies.len()];
            let (ratio, mean) = spread(&mut walk(&shared, &bodies, bounds, GEOMETRIC), &bodies, &none);
            println!("{shape}, seed {seed}: {ratio:.2} times {mean:.0}");
            assert!(ratio <= 10.0, "{shape}, seed {seed}: a group meets {ratio:.1} times {mean:.0}");
        }
    }
}
