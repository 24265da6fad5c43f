//! Springs that break: where, when, forever, and on both sides.

use glam::DVec3;
use motes::links::Links;
use motes::settings::Value;
use motes::{Setup, State, VELOCITY};

use super::{at, fix, forces, gpu, made, setup, spring};
use crate::support;
use crate::support::states::{cpu, force, phase, word};

fn tearing(particles: &State, strain: f64, name: &str, dt: f64) -> Setup {
    let mut all = forces(0.0, 0.0);
    all.push(force("tear", &[("strain", Value::Number(strain))]));
    setup(particles, all, name, dt)
}

/// A row of four, of which the last breaks off.
fn row() -> State {
    let mut row = at(&[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]], 1.0);
    row.links.springs = (0..3).map(|i| spring([i, i + 1], 1.0, 100.0)).collect();
    row.velocity_mut()[3] = DVec3::X * 8.0;
    row
}

#[test]
fn a_spring_breaks_in_the_step_in_which_it_is_too_long() {
    let shared = support::device();
    let mut simulation = gpu(&shared, &tearing(&row(), 0.3, "leapfrog", 0.01));
    let all = pollster::block_on(simulation.links()).expect("links").springs;
    assert_eq!(all, row().links.springs);
    let mut broken_at = None;
    for step in 1..=20 {
        simulation.step(1).expect("a step");
        let links: Links = pollster::block_on(simulation.links()).expect("links");
        let x = pollster::block_on(simulation.read(motes::POSITION)).expect("places");
        let longest = (0..3).map(|i| x[i + 1].x - x[i].x).fold(0.0, f32::max);
        match broken_at {
            None if longest > 1.3 => {
                assert_eq!(links.springs, row().links.springs[..2], "the last one breaks");
                broken_at = Some(step);
            }
            None => assert_eq!(links.springs.len(), 3, "step {step}: {longest}"),
            Some(_) => assert_eq!(links.springs.len(), 2, "for ever"),
        }
    }
    let broken_at = broken_at.expect("it breaks");
    assert!((3..=6).contains(&broken_at), "in step {broken_at}");
    // Nothing pulls any more: it flies on at one speed, though it is near.
    let before = pollster::block_on(simulation.read(VELOCITY)).expect("velocities")[3];
    simulation.step(50).expect("steps");
    let after = pollster::block_on(simulation.read(VELOCITY)).expect("velocities")[3];
    assert_eq!(before, after);
}

/// What is left continues in another run as it would have continued in this one.
#[test]
fn broken_stays_broken_over_a_restart() {
    let number = Value::Number;
    let mut sheet = made(
        "cloth",
        &[
            ("columns", number(12.0)),
            ("rows", number(12.0)),
            ("spacing", number(0.1)),
            ("mass", number(0.1)),
            ("stretch", number(200.0)),
            ("jitter", number(0.2)),
            ("pins", word("row")),
        ],
    );
    let (positions, velocities) = sheet.phase_mut();
    for (x, v) in positions.iter().zip(velocities) {
        *v = DVec3::new(if x.x > 0.0 { 4.0 } else { -4.0 }, -3.0, 0.5) * (0.6 - x.y);
    }
    let shared = support::device();
    let mut whole = gpu(&shared, &tearing(&sheet, 0.4, "symplectic_euler", 0.004));
    whole.step(60).expect("steps");
    let links = pollster::block_on(whole.links()).expect("links");
    let torn = sheet.links.springs.len() - links.springs.len();
    assert!(torn > 5 && torn < 300, "{torn} springs are torn");
    let snapshot = pollster::block_on(whole.snapshot()).expect("a snapshot");
    let mut rest = snapshot;
    (rest.links, rest.held) = (links, sheet.held.clone());
    // Through a file, as the command does it.
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("links.csv");
    motes::formats::links::write(std::fs::File::create(&path).expect("a file"), &rest.links).expect("written");
    let usual = motes::formats::links::Usual {
        tie: motes::formats::links::Tie::default(),
        rest: 1.0,
        stiffness: 1.0,
        damping: 0.0,
        angle: 180.0,
        multiplicity: 1,
        phase: 0.0,
    };
    let read = motes::formats::links::read(
        &motes::formats::Input::disk(&path),
        rest.position(),
        &motes::Bounds::default(),
        &usual,
    )
    .expect("links");
    assert_eq!(read.springs, rest.links.springs);
    rest.links.springs = read.springs;
    let mut again = gpu(&shared, &tearing(&rest, 0.4, "symplectic_euler", 0.004));
    whole.step(40).expect("steps");
    again.step(40).expect("steps");
    let [a, b] = [&mut whole, &mut again].map(|s| {
        (pollster::block_on(s.read(motes::POSITION)).expect("places"), pollster::block_on(s.links()).expect("links"))
    });
    assert!(a.1.springs == b.1.springs && b.1.springs.len() < rest.links.springs.len(), "it goes on tearing, alike");
    assert_eq!(a.0, b.0, "to the bit");
}

/// The references tear what the device tears, and both ends of every spring decide alike.
#[test]
fn both_ends_decide_alike() {
    let mut particles = row();
    fix(&mut particles, [0]);
    let setup = tearing(&particles, 0.3, "leapfrog", 0.01);
    let mut references = cpu(&particles, setup.forces, "leapfrog", 0.01);
    references.step(20).expect("steps");
    let words = references.backend().host().get("link").expect("links");
    let motes::kernel::Array::Uint(words) = words else { panic!("words") };
    let halves: Vec<_> = words.chunks(4).map(motes::links::Half::new).collect();
    let broken: Vec<_> = halves.iter().map(motes::links::Half::is_broken).collect();
    // 0–1 | 1–0, 1–2 | 2–1, 2–3 | 3–2
    assert_eq!(broken, [false, false, false, false, true, true]);
    let (_, v) = phase(&mut references);
    assert!(v[3].x > 4.0);
}

/// A weak chain under a heavy load: without a limit it doubles, with one it stays near it; momentum of what is free stays.
#[test]
fn a_limit_of_strain() {
    let number = Value::Number;
    let limit = |sweeps: f64| force("strain_limit", &[("strain", number(0.05)), ("sweeps", number(sweeps))]);
    let mut chain = at(&[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]], 1.0);
    chain.mass_mut()[3] = 4.0;
    chain.links.springs = (0..3).map(|i| spring([i, i + 1], 1.0, 50.0)).collect();
    fix(&mut chain, [0]);
    let longest = |sweeps: Option<f64>| {
        let mut all = forces(9.81, 1.0);
        all.extend(sweeps.map(limit));
        let mut simulation = cpu(&chain, all, "symplectic_euler", 0.01);
        let mut longest = 0.0_f64;
        for _ in 0..150 {
            simulation.step(1).expect("a step");
            let (x, _) = phase(&mut simulation);
            longest = (0..3).map(|i| (x[i + 1] - x[i]).truncate().length()).fold(longest, f64::max);
        }
        longest
    };
    let (free, few, many) = (longest(None), longest(Some(4.0)), longest(Some(60.0)));
    assert!(free > 1.7 && few < 1.2 && many < 1.06, "{free} without, {few} with a few sweeps, {many} with many");

    let shared = support::device();
    let mut free = chain.clone();
    free.held.clear();
    free.velocity_mut().copy_from_slice(&[DVec3::ZERO, DVec3::Y, DVec3::X * 3.0, DVec3::new(9.0, -1.0, 2.0)]);
    let mut all = forces(0.0, 0.0);
    all.push(limit(8.0));
    let mut simulation = gpu(&shared, &setup(&free, all, "leapfrog", 0.01));
    simulation.step(40).expect("steps");
    let v = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
    let momentum = |v: &dyn Fn(usize) -> DVec3| (0..4).map(|i| free.mass()[i] * v(i)).sum::<DVec3>();
    let (before, after) = (momentum(&|i| free.velocity()[i]), momentum(&|i| v[i].as_dvec4().truncate()));
    // 40 · 8 sweeps, each with a rounding of a place of 3 by 1e-7, over 0.01.
    assert!((after - before).length() < 2e-3, "{before} became {after}");
    let x = pollster::block_on(simulation.read(motes::POSITION)).expect("places");
    assert!((0..3).all(|i| (x[i + 1] - x[i]).truncate().length() < 1.1));
}
