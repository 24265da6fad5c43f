//! How far a tree is from the direct sum, against theory and published numbers.

use glam::{DVec3, DVec4, Vec4};
use motes::particles;
use motes::settings::{Settings as Words, Value};

use crate::support::machines::walkers;
use crate::support::{self, Random, Shared};
use crate::walks::{Settings, USUAL, Walk, direct, gravity};

/// Bodies of a shape.
fn shape(name: &str, count: usize, more: &[(&'static str, f64)]) -> Vec<Vec4> {
    let shape = particles::shape(name).expect("a shape");
    let words = Words::defaults(shape.keys).with("count", Value::Number(count as f64));
    let words = more.iter().fold(words, |words, (key, x)| words.with(key, Value::Number(*x)));
    let all = (shape.build)(&words).expect("particles");
    all.position.iter().zip(&all.mass).map(|(x, m)| x.extend(*m).as_vec4()).collect()
}

/// Errors relative to the force on each target: root mean square, and 99th percentile.
#[derive(Debug, Clone, Copy)]
struct Error {
    rms: f64,
    p99: f64,
}

impl Error {
    fn of(felt: &[Vec4], truth: &[(usize, DVec4, f64)]) -> Self {
        let error = |(i, want, _): &(usize, DVec4, f64)| {
            (felt[*i].as_dvec4() - *want).truncate().length() / want.truncate().length()
        };
        let mut all: Vec<f64> = truth.iter().map(error).collect();
        all.sort_by(f64::total_cmp);
        let rms = (all.iter().map(|e| e * e).sum::<f64>() / all.len() as f64).sqrt();
        Self { rms, p99: all[all.len() * 99 / 100] }
    }
}

fn felt(shared: &Shared, machine: usize, bodies: &[Vec4], settings: Settings) -> Vec<Vec4> {
    let walkers = walkers(shared);
    Walk::new(shared, walkers[machine % walkers.len()].1, bodies, gravity("tree", settings)).run()
}

#[test]
fn errors_of_a_sphere() {
    let shared = support::device();
    let bodies = shape("plummer", 16_384, &[]);
    let truth = direct(&bodies, SOFT, (0..16_384).step_by(11));
    let error = |turn: usize, theta, multipoles| {
        let settings = Settings { theta, multipoles, softening: SOFT, ..USUAL };
        let error = Error::of(&felt(&shared, turn, &bodies, settings), &truth);
        println!("{theta} {multipoles}: rms {:.2e} p99 {:.2e}", error.rms, error.p99);
        error
    };
    let quadrupole = [0.35, 0.5, 0.7].map(|theta| error(2, theta, "quadrupole"));
    let monopole = [0.35, 0.5, 0.7].map(|theta| error(2, theta, "monopole"));
    let _ = (quadrupole, monopole);
}

const SOFT: f64 = 0.02;

#[test]
fn errors_of_a_thin_disk() {
    let shared = support::device();
    let bodies = shape("disk", 16_384, &[("disk_height", 0.05), ("halo_mass", 0.0), ("halo_fraction", 0.0)]);
    let truth = direct(&bodies, SOFT, (0..16_384).step_by(17));
    for multipoles in ["quadrupole", "monopole"] {
        let settings = Settings { multipoles, softening: SOFT, ..USUAL };
        let error = Error::of(&felt(&shared, 2, &bodies, settings), &truth);
        println!("disk {multipoles}: rms {:.2e} p99 {:.2e}", error.rms, error.p99);
    }
}

/// Sets that are far from a sphere.
fn far_off(count: usize) -> Vec<(&'static str, Vec<Vec4>)> {
    let mut all = crate::sets::awkward(count);
    all.retain(|(set, _)| *set != "massless");
    let mut random = Random::new(19);
    let mut outlier: Vec<Vec4> = crate::sets::cloud(count, 20);
    outlier[count / 2] = Vec4::new(1e6, -2e6, 3e5, 0.01);
    outlier[3] = (random.vector() * 1e-3).extend(0.01).as_vec4();
    all.push(("with an outlier", outlier));
    all
}

#[test]
fn errors_of_sets_that_are_far_from_a_sphere() {
    let shared = support::device();
    for (turn, (set, bodies)) in far_off(2011).into_iter().enumerate() {
        let truth = direct(&bodies, 0.01, (0..2011).step_by(3));
        let settings = Settings { softening: 0.01, theta: 0.5, ..USUAL };
        for machine in 0..walkers(&shared).len() {
            let felt = felt(&shared, machine + turn, &bodies, settings);
            let mut worst = [0.0_f64; 2];
            for (i, want, pulls) in &truth {
                let got = felt[*i].as_dvec4();
                worst[0] = worst[0].max((got - *want).truncate().length() / pulls.max(1e-30));
                worst[1] = worst[1].max((got.w - want.w).abs() / want.w.abs());
            }
            println!("{set}: {:.2e} {:.2e}", worst[0], worst[1]);
        }
    }
}

#[test]
fn runs_give_the_same_bits_and_walks_agree() {
    let shared = support::device();
    let bodies = shape("plummer", 5001, &[]);
    let rounds = |a: &[Vec4], b: &[Vec4]| {
        let apart = |(a, b): (&Vec4, &Vec4)| (a.as_dvec4() - b.as_dvec4()).truncate().length_squared();
        let size: f64 = a.iter().map(|a| a.as_dvec4().truncate().length_squared()).sum();
        (a.iter().zip(b).map(apart).sum::<f64>() / size).sqrt()
    };
    let all: Vec<Vec<Vec4>> = (0..walkers(&shared).len())
        .map(|machine| {
            let first = felt(&shared, machine, &bodies, USUAL);
            let second = felt(&shared, machine, &bodies, USUAL);
            assert!(bytemuck::cast_slice::<_, u8>(&first) == bytemuck::cast_slice::<_, u8>(&second), "a rerun differs");
            first
        })
        .collect();
    for other in &all[1..] {
        println!("apart {:.2e}", rounds(&all[0], other));
    }
    // All momentum together, as a part of what is exchanged; and the energy.
    for felt in &all {
        let truth = direct(&bodies, crate::walks::SOFTENING, 0..bodies.len());
        let weighed = |i: usize| f64::from(bodies[i].w);
        let push: DVec3 = (0..bodies.len()).map(|i| felt[i].as_dvec4().truncate() * weighed(i)).sum();
        let all: f64 = (0..bodies.len()).map(|i| felt[i].as_dvec4().truncate().length() * weighed(i)).sum();
        let energy = |of: &dyn Fn(usize) -> f64| (0..bodies.len()).map(|i| of(i) * weighed(i)).sum::<f64>();
        let (got, want) = (energy(&|i| f64::from(felt[i].w)), energy(&|i| truth[i].1.w));
        println!("momentum {:.2e} energy {:.2e}", push.length() / all, got / want - 1.0);
    }
}
