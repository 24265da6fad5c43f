//! No particle is left out and none is evaluated twice: a law that adds up the mass it sees, in integers, which f32 holds.

use glam::{DVec3, Vec4};
use motes::forces::{Law, Over, Particle};
use motes::kernel::Source;
use motes::tree::Opening;

use crate::support::{self, Random, machines::walkers};
use crate::tree::sets::awkward;
use crate::tree::walks::{Alone, Walk, over};

/// A law with a sum of its own, and none for far groups: they are evaluated as one particle.
const WGSL: &str = "struct Sum { mass: f32, met: f32 }
    fn merge(total: ptr<function, Sum>, part: Sum) {
        (*total).mass += part.mass;
        (*total).met += part.met;
    }
    fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
        (*sum).mass += you.mass;
        // As one: only single particles have an index.
        if you.index < world.count && you.mass > 0.0 { (*sum).met += 1.0; }
    }
    fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.mass, sum.met, me.mass, 0.0); }";

pub fn counted(over: Over) -> Law {
    let gather = |_: &Particle, _: &Particle, _: DVec3, (): &mut ()| ();
    Law::gathering("counted", over, Source::ours("counted", WGSL), Vec::new(), gather, |_, (), _| glam::DVec4::ZERO)
}

/// Whole masses, most of them 1, some 0 or 10⁶; together below 2²⁴.
pub fn weighed(mut bodies: Vec<Vec4>, heavy: bool) -> Vec<Vec4> {
    let step = bodies.len() / 9 + 1;
    for (i, b) in bodies.iter_mut().enumerate() {
        b.w = match i {
            _ if heavy && i % step == 5 => 1e6,
            _ if i % 7 == 2 => 0.0,
            _ => (1 + i % 3) as f32,
        };
    }
    bodies
}

/// Bodies a few roundings apart: those that hold a group are recognised by their places, not by their sizes.
fn roundings() -> Vec<Vec4> {
    let mut random = Random::new(16);
    let mut place = || (1e6 + 0.0625 * (3.0 * random.next()).round()) as f32;
    (0..1024).map(|_| Vec4::new(place(), place(), place(), 0.0)).collect()
}

pub fn complete(of: &str, walk: &mut Walk, bodies: &[Vec4]) -> f32 {
    let total: f32 = bodies.iter().map(|b| b.w).sum();
    let seen = walk.run();
    for (i, (a, me)) in seen.iter().zip(bodies).enumerate() {
        assert_eq!((a.x, a.z), (total - me.w, me.w), "{of}: {i} of {} sees another mass", bodies.len());
    }
    let others = bodies.iter().filter(|b| b.w > 0.0).count() as f32 - 1.0;
    assert!(seen.iter().all(|a| a.y <= others + 1.0), "{of}: a particle is met twice");
    seen.iter().map(|a| a.y).sum::<f32>() / bodies.len() as f32 / others.max(1.0)
}

#[test]
fn every_pair_is_met_once() {
    let shared = support::device();
    for (name, machine) in walkers(&shared) {
        for (turn, (set, bodies)) in awkward(1111).into_iter().enumerate() {
            let theta = [0.3, 0.5, 0.7, 1.0][turn % 4];
            let bodies = weighed(bodies, turn % 2 == 0);
            let mut walk = Walk::new(&shared, machine, &bodies, Box::new(Alone(counted(over(theta)))));
            let met = complete(&format!("{name}, {set}, θ = {theta}"), &mut walk, &bodies);
            // Of those at one place none is ever far.
            assert!((met > 0.99) == (set == "at one place"), "{name}, {set}: {met} of all are met by themselves");
        }
        let crowd = weighed(roundings(), false);
        let mut walk = Walk::new(&shared, machine, &crowd, Box::new(Alone(counted(over(1.0)))));
        let met = complete(&format!("{name}, a few roundings apart"), &mut walk, &crowd);
        assert!(met < 0.9, "{name}: no group is far");
        let mut last = 2.0;
        for theta in [0.3, 0.5, 0.7, 1.0] {
            let bodies = weighed(crate::tree::sets::cloud(4099, 11), true);
            let mut walk = Walk::new(&shared, machine, &bodies, Box::new(Alone(counted(over(theta)))));
            let met = complete(&format!("{name}, θ = {theta}"), &mut walk, &bodies);
            assert!(met < last, "{name}, θ = {theta}: {met} are met by themselves, {last} where θ is less");
            last = met;
        }
        for count in [1, 2, 3, 31, 33, 64, 65, 257] {
            let bodies = weighed(crate::tree::sets::cloud(count, 12), false);
            let mut walk = Walk::new(&shared, machine, &bodies, Box::new(Alone(counted(over(1.0)))));
            complete(name, &mut walk, &bodies);
        }
    }
}

/// The other criterion, and a core that keeps groups away.
#[test]
fn so_they_do_by_any_opening() {
    let shared = support::device();
    let mut random = Random::new(14);
    let last: Vec<Vec4> = (0..1030).map(|_| random.vector().extend(0.0).as_vec4()).collect();
    let bodies = weighed(crate::tree::sets::cloud(1030, 13), true);
    for (name, machine) in walkers(&shared) {
        let relative = Opening::Relative { alpha: 0.01, g: 1e-7, theta: 0.6 };
        for (opening, core) in [(relative, 0.0), (relative, 0.4), (Opening::Geometric { theta: 1.0 }, 0.4)] {
            let law = counted(Over::Tree { opening, core, auto: false });
            let mut walk = Walk::new(&shared, machine, &bodies, Box::new(Alone(law))).after(&last);
            complete(&format!("{name}, {opening}, core {core}"), &mut walk, &bodies);
        }
    }
}

/// So many that what waits to be looked at takes a second word.
#[test]
fn so_they_do_in_a_deep_tree() {
    const COUNT: usize = 262_145;
    let shared = support::device();
    let machine = walkers(&shared).into_iter().last().expect("a walk").1;
    let place = |i: usize| DVec3::new((i % 64) as f64, (i / 64 % 64) as f64, (i / 4096) as f64);
    let bodies: Vec<Vec4> = (0..COUNT).map(|i| place(i).extend(1.0).as_vec4()).collect();
    let mut walk = Walk::new(&shared, machine, &bodies, Box::new(Alone(counted(over(1.0)))));
    complete("deep", &mut walk, &bodies);
}

/// What fills a place, and a particle itself, is passed to no law: one that does not multiply by mass would notice.
#[test]
fn padding_and_oneself_are_not_met() {
    let shared = support::device();
    for count in [1, 2, 5, 31, 32, 33, 63, 70, 333, 1001] {
        let bodies = weighed(crate::tree::sets::cloud(count, 15), false);
        let mut met: Vec<Vec<Vec4>> = Vec::new();
        for (name, machine) in walkers(&shared) {
            let met_beyond = |core| {
                let law = crate::tree::met::met(Opening::Geometric { theta: 0.9 }, core);
                Walk::new(&shared, machine, &bodies, Box::new(Alone(law))).run()
            };
            let all = met_beyond(10.0);
            let others = Vec4::new(0.0, count as f32 - 1.0, 0.0, 0.0);
            assert!(all.iter().all(|met| *met == others), "{name}, {count}: {:?}", all[0]);
            met.push(met_beyond(0.0));
        }
        assert!(met.windows(2).all(|walks| walks[0] == walks[1]), "{count}: walks do not meet the same");
        assert!(count < 333 || met[0].iter().any(|met| met.x > 0.0), "{count}: no group is far");
    }
}
