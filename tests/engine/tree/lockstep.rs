//! Each walk against its reference, which opens the same nodes of the same tree and adds up in f64.

use glam::{DVec3, Vec4};
use motes::settings::Value;
use motes::{Bounds, Gpu, Side};

use crate::support::machines::walkers;
use crate::support::states::{force, word};
use crate::support::{self, Random};
use crate::tree::sets::{awkward, cloud};
use crate::tree::walks::{Settings, USUAL, Walk, gravity};

/// Around what a leaf, a group, eight groups and a node of many levels hold.
const SIZES: [usize; 19] = [1, 2, 3, 4, 5, 8, 9, 31, 32, 33, 63, 64, 65, 255, 256, 257, 1000, 1025, 4097];

fn settings() -> Vec<Settings> {
    let mut all = Vec::new();
    for kernel in ["plummer", "spline"] {
        for multipoles in ["quadrupole", "monopole"] {
            all.push(Settings { kernel, multipoles, theta: 0.7, ..USUAL });
            all.push(Settings { kernel, multipoles, theta: 0.6, alpha: 0.005, softening: 0.01 });
        }
    }
    all
}

/// Accelerations of the step before, some of them zero.
fn last(count: usize) -> Vec<Vec4> {
    let mut random = Random::new(3);
    let mut last: Vec<Vec4> = (0..count).map(|_| random.vector().extend(random.next()).as_vec4()).collect();
    last.iter_mut().skip(100).step_by(97).for_each(|a| *a = Vec4::ZERO);
    last
}

fn agrees(walk: &mut Walk, of: &str, count: usize) {
    let verdict = walk.verdict();
    assert!(verdict.good(), "{of}, {count} bodies: {verdict:?}");
    assert!(verdict.changed || count == 1, "{of}, {count} bodies: changes nothing");
}

#[test]
fn each_walk_agrees_with_its_reference_at_every_size() {
    let shared = support::device();
    let settings = settings();
    for (case, count) in SIZES.into_iter().enumerate() {
        for (turn, (name, machine)) in walkers(&shared).into_iter().enumerate() {
            let settings = settings[(case + 3 * turn) % settings.len()];
            let law = gravity("tree", settings);
            let mut walk = Walk::new(&shared, machine, &cloud(count, 2), law).after(&last(count));
            agrees(&mut walk, &format!("{name}, {settings:?}"), count);
        }
    }
}

#[test]
fn each_law_agrees_with_its_reference() {
    let shared = support::device();
    let count = 1500;
    for settings in settings() {
        for (name, machine) in walkers(&shared) {
            let law = gravity("tree", settings);
            let mut walk = Walk::new(&shared, machine, &cloud(count, 4), law).after(&last(count));
            agrees(&mut walk, &format!("{name}, {settings:?}"), count);
        }
    }
}

#[test]
fn many_agree_with_their_reference() {
    let shared = support::device();
    let count = 20_001;
    for (name, machine) in walkers(&shared) {
        let mut walk = Walk::new(&shared, machine, &cloud(count, 5), gravity("tree", USUAL));
        agrees(&mut walk, name, count);
    }
}

#[test]
fn awkward_sets_agree_with_their_reference() {
    let shared = support::device();
    for (name, machine) in walkers(&shared) {
        for (set, bodies) in awkward(777).into_iter().filter(|(set, _)| *set != "massless") {
            let law = gravity("tree", Settings { theta: 0.7, ..USUAL });
            agrees(&mut Walk::new(&shared, machine, &bodies, law), &format!("{name}, {set}"), 777);
        }
    }
}

/// All images of a cube that repeats, far groups of them as one.
#[test]
fn they_agree_in_a_periodic_cube() {
    let shared = support::device();
    let bounds = Bounds::new(DVec3::splat(-1.0), DVec3::splat(1.0), Side::Periodic);
    for (name, machine) in walkers(&shared) {
        let settings = [
            ("over", word("tree")),
            ("theta", Value::Number(0.9)),
            ("softening", Value::Number(0.17)),
            ("images", word("ewald")),
        ];
        let gpu = support::machines::gpu(&shared, 600);
        let mut walk = Walk::within(gpu, machine, &cloud(600, 8), bounds, force("gravity", &settings));
        agrees(&mut walk, &format!("{name}, all images"), 600);
    }
}

/// In dispatches of a few groups each the walk does the same bit for bit, and so it does where a device folds a dispatch
/// over two dimensions, of which the last row is not full.
#[test]
fn cuts_and_folds_change_no_bit() {
    let shared = support::device();
    let few = |limits: &mut motes::wgpu::Limits| limits.max_compute_workgroups_per_dimension = 5;
    let (device, queue) = pollster::block_on(support::limited(&shared, few));
    let bodies = cloud(700, 6);
    for (name, machine) in walkers(&shared) {
        let whole = Walk::new(&shared, machine, &bodies, gravity("tree", USUAL)).run();
        assert!(whole.iter().all(|a| a.truncate().length() > 0.0), "{name}");
        for targets in [32, 96, 256, 672] {
            let mut cut = Walk::new(&shared, machine, &bodies, gravity("tree", USUAL)).cut(targets);
            agrees(&mut cut, name, 700);
            assert!(cut.run() == whole, "{name}: {targets} targets at once differ");
        }
        let gpu = Gpu::new(&device, &queue, 700).expect("a GPU");
        let mut folded = Walk::on(gpu, machine, &bodies, gravity("tree", USUAL));
        assert!(folded.run() == whole, "{name}: folded it differs");
    }
}
