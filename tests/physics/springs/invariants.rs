//! What must hold whatever the springs are.

use glam::{DVec3, Vec4};
use motes::links::Link;
use motes::settings::Value;
use motes::{POSITION, State, VELOCITY};

use super::{at, forces, gpu, made, setup};
use crate::support;
use crate::support::states::{accelerations, force};

/// A rumpled sheet on its way.
fn sheet() -> State {
    let number = Value::Number;
    let mut sheet = made(
        "cloth",
        &[
            ("columns", number(13.0)),
            ("rows", number(11.0)),
            ("spacing", number(0.1)),
            ("mass", number(0.02)),
            ("stretch", number(80.0)),
            ("shear", number(30.0)),
            ("bend", number(5.0)),
            ("damping", number(0.0)),
            ("jitter", number(0.3)),
        ],
    );
    let mut random = support::Random::new(9);
    sheet.velocity_mut().iter_mut().for_each(|v| *v = random.vector() * 0.3 + DVec3::new(0.2, -0.1, 0.4));
    sheet
}

#[test]
fn momentum_is_kept_and_time_turns_back() {
    let shared = support::device();
    let sheet = sheet();
    let mut simulation = gpu(&shared, &setup(&sheet, forces(0.0, 0.0), "leapfrog", 0.004));
    simulation.step(150).expect("steps");
    let read = |simulation: &mut motes::Simulation<motes::Gpu>, field| -> Vec<Vec4> {
        pollster::block_on(simulation.read(field)).expect("a field")
    };
    let (x, v) = (read(&mut simulation, POSITION), read(&mut simulation, VELOCITY));
    let momentum = |v: &mut dyn Iterator<Item = DVec3>| 0.02 * v.sum::<DVec3>();
    let (before, after) =
        (momentum(&mut sheet.velocity().iter().copied()), momentum(&mut v.iter().map(|v| v.truncate().as_dvec3())));
    // Both ends round alike; sums of twelve round by 6e-8 of a force of 1: a walk of 150 · 143 steps of 0.004.
    assert!((after - before).length() < 2e-7, "{before} became {after}");
    let turn = |r: &dyn Fn(usize) -> (DVec3, DVec3)| (0..143).map(|i| 0.02 * r(i).0.cross(r(i).1)).sum::<DVec3>();
    let (before, after) = (
        turn(&|i| (sheet.position()[i], sheet.velocity()[i])),
        turn(&|i| (x[i].truncate().as_dvec3(), v[i].truncate().as_dvec3())),
    );
    assert!((after - before).length() < 1e-6, "angular momentum {before} became {after}");

    let back: Vec<Vec4> = v.iter().map(|v| (-v.truncate()).extend(v.w)).collect();
    simulation.write(VELOCITY, &back).expect("velocities");
    simulation.step(150).expect("steps");
    let home = read(&mut simulation, POSITION);
    let far =
        home.iter().zip(sheet.position()).map(|(x, y)| (x.truncate().as_dvec3() - *y).length()).fold(0.0, f64::max);
    let gone = x.iter().zip(sheet.position()).map(|(x, y)| (x.truncate().as_dvec3() - *y).length()).fold(0.0, f64::max);
    assert!(far < 1e-5 && gone > 0.1, "it was {gone} away and comes back to {far:e}");
}

/// Damping acts along springs alone: a body that falls or turns as a whole is not damped.
#[test]
fn damping_lets_a_body_fall_and_turn() {
    let accelerated = |damping: f64, velocity: &dyn Fn(DVec3) -> DVec3| {
        let mut sheet = sheet();
        sheet.links.springs.iter_mut().for_each(|link| link.damping = damping);
        let (positions, velocities) = sheet.phase_mut();
        velocities.iter_mut().zip(positions).for_each(|(v, x)| *v = velocity(*x));
        accelerations(&[force("spring", &[])], &sheet, 0.0)
    };
    let (fall, spin) = (DVec3::new(3.0, -2.0, 9.0), DVec3::new(2.0, -5.0, 1.0));
    let rigid = |x: DVec3| fall + spin.cross(x);
    let apart = |a: &[glam::DVec4], b: &[glam::DVec4]| {
        a.iter().zip(b).map(|(a, b)| (*a - *b).truncate().length()).fold(0.0, f64::max)
    };
    let (without, with) = (accelerated(0.0, &rigid), accelerated(50.0, &rigid));
    assert!(apart(&without, &with) < 1e-9, "{:e}", apart(&without, &with));
    let breathing = |x: DVec3| rigid(x) + 0.1 * x;
    assert!(apart(&without, &accelerated(50.0, &breathing)) > 1.0, "what changes its lengths is damped");
}

/// A change of ids changes nothing but rounding.
#[test]
fn names_do_not_matter() {
    let sheet = sheet();
    let count = sheet.len() as u32;
    // 5 has no factor in common with 143.
    let name = |id: u32| (5 * id + 17) % count;
    let mut renamed = at(&vec![[0.0; 3]; sheet.len()], 0.02);
    for id in 0..count {
        renamed.position_mut()[name(id) as usize] = sheet.position()[id as usize];
        renamed.velocity_mut()[name(id) as usize] = sheet.velocity()[id as usize];
    }
    renamed.links.springs = sheet.links.springs.iter().map(|l| Link { ends: l.ends.map(name), ..*l }).collect();
    let (a, b) = (accelerations(&forces(9.81, 0.0), &sheet, 0.0), accelerations(&forces(9.81, 0.0), &renamed, 0.0));
    for id in 0..count {
        let apart = (a[id as usize] - b[name(id) as usize]).length();
        assert!(apart < 1e-11 * a[id as usize].length().max(1.0), "particle {id}: {apart:e}");
    }
    assert!((0..sheet.len()).any(|i| a[i] != b[i]), "no particle was renamed");
}

/// A rope pulls, with or without damping, and never pushes.
#[test]
fn ropes_only_pull() {
    for (length, speed, pulls) in [(0.9, 0.0, false), (0.9, 3.0, false), (1.1, 0.0, true), (1.1, -30.0, false)] {
        let mut two = at(&[[0.0; 3], [0.0, length, 0.0]], 2.0);
        two.velocity_mut()[1] = DVec3::Y * speed;
        let rope = Link { ends: [0, 1], rest: 1.0, stiffness: 10.0, damping: 0.5, rope: true };
        two.links.springs = vec![rope];
        let got = accelerations(&[force("spring", &[])], &two, 0.0);
        let pull = (10.0 * (length - 1.0) + 0.5 * speed) * 0.5;
        let want = if pulls { pull } else { 0.0 };
        assert!((got[0].y - want).abs() < 1e-12 && (got[1].y + want).abs() < 1e-12, "{length} {speed}: {got:?}");
        two.links.springs[0].rope = false;
        let spring = accelerations(&[force("spring", &[])], &two, 0.0)[0].y;
        assert!((spring - pull).abs() < 1e-12, "a spring also pushes");
    }
}

/// Air presses on what faces it, lifts what is aslant, and leaves alone what moves along.
#[test]
fn air_on_a_triangle() {
    let air = |v: [f64; 3], settings: &[(&'static str, Value)]| {
        let mut sail = at(&[[0.0; 3], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]], 0.5);
        sail.velocity_mut().copy_from_slice(&[DVec3::from(v); 3]);
        sail.links.triangles.push([0, 1, 2]);
        let got = accelerations(&[force("air", settings)], &sail, 0.0);
        assert!(got.iter().all(|a| *a == got[0]), "corners bear alike");
        got[0].truncate() * 1.5
    };
    let number = Value::Number;
    let coefficients = [("density", number(1.25)), ("drag", number(0.8)), ("lift", number(0.6))];
    let near = |got: DVec3, want: DVec3| assert!((got - want).length() < 1e-12, "{got}, not {want}");
    // Area 1, face on at speed 2: ½ 1.25 · 4 · 0.8.
    near(air([0.0, 0.0, 2.0], &coefficients), DVec3::Z * -2.0);
    near(air([0.0, 0.0, -2.0], &coefficients), DVec3::Z * 2.0);
    // Edge on.
    near(air([2.0, 1.0, 0.0], &coefficients), DVec3::ZERO);
    // At 45°: drag ½ 1.25 · 8 · 0.8 cos α along, lift ½ 1.25 · 8 · 0.6 cos α sin α across.
    let root = 0.5f64.sqrt();
    let heading = DVec3::new(root, 0.0, root);
    let across = DVec3::new(-root, 0.0, root);
    near(air([2.0, 0.0, 2.0], &coefficients), -(4.0 * root * heading) - 3.0 * 0.5 * across);
    // The wind's own frame.
    let wind = [coefficients.as_slice(), &[("wind", Value::Vector(DVec3::new(0.0, 0.0, 5.0)))]].concat();
    near(air([0.0, 0.0, 7.0], &wind), DVec3::Z * -2.0);
}
