//! How links are kept: one by one, or by their kind; awkward numbers of them; and a user's own law over them.

use glam::Vec4;
use motes::forces::{Custom, Over};
use motes::kernel::Backend;
use motes::lockstep::compare;
use motes::settings::Value;
use motes::{POSITION, Setup, State};

use super::{at, forces, gpu, made, setup, spring};
use crate::support;
use crate::support::states::{cpu, force, phase};

fn cloth(side: usize, damping: f64) -> State {
    let number = Value::Number;
    let side = number(side as f64);
    made(
        "cloth",
        &[
            ("columns", side.clone()),
            ("rows", side),
            ("spacing", number(0.1)),
            ("mass", number(0.1)),
            ("damping", number(damping)),
            ("jitter", number(0.4)),
        ],
    )
}

/// What may break is kept one by one, what may not by its kind: both say the same.
#[test]
fn links_one_by_one_and_by_their_kind() {
    let shared = support::device();
    for damping in [0.0, 0.3] {
        let mut ends = Vec::new();
        for strain in [None, Some(1e6)] {
            let mut all = forces(9.81, 0.0);
            all.extend(strain.map(|strain| force("tear", &[("strain", Value::Number(strain))])));
            let mut simulation = gpu(&shared, &setup(&cloth(12, damping), all, "leapfrog", 0.002));
            simulation.step(100).expect("steps");
            let kept = [strain.is_some(), strain.is_none()];
            assert_eq!(kept, ["link", "partner"].map(|name| simulation.backend().buffer(name).is_some()));
            ends.push(pollster::block_on(simulation.read(POSITION)).expect("places"));
        }
        let apart = ends[0].iter().zip(&ends[1]).map(|(a, b)| (*a - *b).length()).fold(0.0, f32::max);
        // Another order of the sums: some ulp of a place, grown by 100 steps.
        assert!(apart < 1e-5 && apart > 0.0, "{apart:e} apart");
        let mut references = cpu(&cloth(12, damping), forces(9.81, 0.0), "leapfrog", 0.002);
        references.step(100).expect("steps");
        let (x, _) = phase(&mut references);
        let far = x.iter().zip(&ends[0]).map(|(a, b)| (a.as_vec4() - *b).length()).fold(0.0, f32::max);
        assert!(far < 1e-5, "{far:e} from the references");
    }
}

/// Kernel by kernel, where links are of one to four kinds.
#[test]
fn kinds_in_lockstep() {
    let shared = support::device();
    for kinds in 1..=4u32 {
        for count in [2usize, 63, 64, 65, 300] {
            let places: Vec<[f64; 3]> = (0..count)
                .map(|i| {
                    let t = i as f64;
                    [t.sin(), (1.7 * t).cos(), (0.3 * t).sin()].map(|x| f64::from(x as f32))
                })
                .collect();
            let mut particles = at(&places, 0.75);
            for i in 0..count as u32 - 1 {
                let mut link = spring([i, i + 1], 0.25 * f64::from(i % kinds), 8.0 + f64::from(i % kinds));
                link.damping = 0.5 * f64::from(i % 2 * (kinds - 1));
                if kinds == 4 {
                    link.damping = 0.5;
                    link.rope = i % 4 == 3;
                }
                particles.links.springs.push(link);
            }
            let setup = setup(&particles, forces(0.0, 0.0), "symplectic_euler", 0.05);
            let mut simulation = gpu(&shared, &setup);
            simulation.step(2).expect("steps");
            let plan = setup.plans(simulation.backend().machine()).expect("plans").step;
            let verdicts = pollster::block_on(compare(simulation.backend(), &plan, count as u32)).expect("verdicts");
            let spring = verdicts.iter().find(|v| v.kernel == "spring").expect("springs");
            assert!(
                spring.changed && verdicts.iter().all(motes::lockstep::Verdict::good),
                "{kinds} kinds, {count}: {verdicts:?}"
            );
        }
    }
}

/// One in the middle of many, and one without any.
#[test]
fn a_hub_and_a_hermit() {
    let shared = support::device();
    let spokes = 5000u32;
    let mut places = vec![[0.0; 3], [9.0; 3]];
    places.extend((0..spokes).map(|i| [2.0 + 1e-3 * f64::from(i % 7), 0.0, f64::from(i % 3)]));
    let mut particles = at(&places, 1.0);
    particles.mass_mut()[0] = 1e4;
    particles.links.springs = (0..spokes).map(|i| spring([0, i + 2], 1.0 + f64::from(i % 6) / 8.0, 2.0)).collect();
    let ends: Vec<Vec4> = {
        let mut simulation = gpu(&shared, &setup(&particles, forces(0.0, 0.0), "leapfrog", 0.01));
        simulation.step(20).expect("steps");
        pollster::block_on(simulation.read(POSITION)).expect("places")
    };
    assert_eq!(ends[1], glam::Vec4::new(9.0, 9.0, 9.0, 1.0), "nothing is tied to it");
    let mut references = cpu(&particles, forces(0.0, 0.0), "leapfrog", 0.01);
    references.step(20).expect("steps");
    let (x, _) = phase(&mut references);
    for id in [0, 2, 4999, 5001] {
        assert!((x[id].as_vec4() - ends[id]).length() < 2e-6, "{id}: {} {}", x[id], ends[id]);
    }
}

/// A user's law over links: what a spring of ours does, and its equal.
#[test]
fn a_law_of_ones_own_over_links() {
    let shared = support::device();
    let wgsl = "fn gather(me: Particle, you: Particle, r: vec3f, link: Link, sum: ptr<function, Sum>) {
            let l = length(r);
            (*sum).acceleration += link.stiffness * (l - link.rest) / l * r / me.mass;
        }
        fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }";
    let own = Custom::new("own", "own.wgsl", wgsl, Over::Links);
    let run = |setup: &Setup| {
        let mut simulation = gpu(&shared, setup);
        simulation.step(50).expect("steps");
        pollster::block_on(simulation.read(POSITION)).expect("places")
    };
    let theirs = run(&setup(&cloth(9, 0.0), vec![Box::new(own)], "leapfrog", 0.002));
    let ours = run(&setup(&cloth(9, 0.0), forces(0.0, 0.0), "leapfrog", 0.002));
    let apart = ours.iter().zip(&theirs).map(|(a, b)| (*a - *b).length()).fold(0.0, f32::max);
    assert!(apart < 1e-5, "{apart:e} apart");
    assert!(ours.iter().zip(cloth(9, 0.0).position()).any(|(a, b)| (a.truncate().as_dvec3() - *b).length() > 1e-3));
}
