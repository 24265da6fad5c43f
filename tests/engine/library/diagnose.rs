//! A library's user gets the errors and remarks that the command gives.

use glam::DVec3;
use motes::diagnose::{Remark, Severity, conserved, diagnose, of_machine};
use motes::kernel::Machine;
use motes::links::Link;
use motes::scene::{Options, Scene, Source};
use motes::typed::{Gravity, Rod, Solid, Spring, Uniform, contact, default, plummer};
use motes::{Bounds, Error, Setup, State};

fn said(setup: &Setup) -> Result<Vec<Remark>, Error> {
    pollster::block_on(diagnose(setup))
}

fn has(remarks: &[Remark], severity: Severity, words: &[&str]) -> bool {
    let all = |remark: &&Remark| remark.severity == severity && words.iter().all(|word| remark.text.contains(word));
    remarks.iter().find(all).is_some()
}

#[test]
fn what_leads_out_of_the_plane_is_an_error() {
    let mut state = State::default();
    state.push(DVec3::X, DVec3::ZERO, 1.0, 0.0);
    let across = Uniform { acceleration: DVec3::new(0.0, -1.0, 0.5), ..default() };
    let mut setup = Setup::new(state, vec![across.into()], 0.01);
    assert_eq!(said(&setup).expect("in space it is sound"), []);
    setup.bounds = Bounds { dimensions: 2, ..Bounds::default() };
    let error = said(&setup).expect_err("in the plane it is not").to_string();
    assert!(error.contains("`uniform`") && error.contains("5e-1") && error.contains("dimensions = 3"), "{error}");
}

#[test]
fn steps_overlaps_and_precision_are_remarked_on() {
    let mut state = State::default();
    for n in 0..3 {
        state.push(DVec3::X * f64::from(n), DVec3::ZERO, 1.0, 0.0);
    }
    let link = |a, b| Link { ends: [a, b], rest: 1.0, stiffness: 1e6, damping: 0.0, rope: false };
    state.links.springs.extend([link(0, 1), link(1, 2)]);
    let forces = || vec![Spring::default().into(), Solid { radius: 0.3, ..default() }.into()];
    let setup = Setup::new(state, forces(), 0.01);
    let remarks = said(&setup).expect("it can run");
    assert!(
        has(&remarks, Severity::Warning, &["this run", "dt = 0.01 is too long for leapfrog", "springs"]),
        "{remarks:?}"
    );
    assert!(
        has(&remarks, Severity::Note, &["particles start inside of an obstacle", "particle 0", "3.000e-1"]),
        "{remarks:?}"
    );
    let long = remarks.iter().find(|remark| remark.id == "long-step").expect("it is too long");
    let bears = long.number("largest_dt").expect("the way out");
    assert!(long.number("dt") == Some(0.01) && long.to_string().ends_with(long.advice.as_ref().expect("a way out")));
    for (dt, safe) in [(0.99 * bears, true), (1.02 * bears, false)] {
        let remarks = said(&Setup { dt, ..setup.clone() }).expect("it can run");
        assert_eq!(remarks.iter().all(|remark| remark.id != "long-step"), safe, "{dt}: {remarks:?}");
    }
    let calm = said(&Setup { dt: 1e-5, ..setup.clone() }).expect("it can run");
    assert!(calm.iter().all(|remark| remark.severity == Severity::Note), "{calm:?}");
    // Without a spring force nothing comes of springs.
    let idle = said(&Setup { forces: Vec::new(), ..setup }).expect("it can run");
    assert!(has(&idle, Severity::Note, &["no force acts on the springs (2 of them)"]), "{idle:?}");
    let mut far = State::default();
    far.push(DVec3::X * 1e6, DVec3::X * 1e-3, 1.0, 0.0);
    let rounded = of_machine(&Setup::new(far, Vec::new(), 1e-3), Machine::HOST, true).expect("sense");
    assert!(has(&rounded, Severity::Note, &["last place of single precision", "particle 0"]), "{rounded:?}");
    // Numbers at 10⁶ are 2⁻⁴ apart.
    assert_eq!((rounded[0].id, rounded[0].number("last_place")), ("rounded-motion", Some(0.0625)));
}

#[test]
fn what_is_conserved_is_known() {
    let stars = plummer(20).build().expect("stars");
    let setup = Setup::new(stars, vec![Gravity::default().into()], 0.01);
    let all = conserved(&setup).expect("sense");
    assert!(all.energy && all.momentum && all.angular_momentum);
    let weight = Uniform { ..default() };
    let falls = conserved(&Setup { forces: vec![weight.into()], ..setup.clone() }).expect("sense");
    assert!(falls.energy && !falls.momentum);
    // Contacts keep history, which a law alone does not have.
    let mut touches = Setup { forces: vec![contact(0.1).into()], ..setup.clone() };
    let radius = motes::Column::new("radius", motes::Kind::Scalar, "length", "");
    let inertia = motes::Column::new("inertia", motes::Kind::Vector, "mass length²", "");
    let (count, state) = (touches.state.len(), &mut touches.state);
    for (column, values) in [
        (radius, motes::kernel::Array::Float(vec![0.01; count])),
        (inertia, motes::kernel::Array::Vec3(vec![DVec3::splat(1e-6); count])),
    ] {
        state.declare(&column).expect("a column");
        state.set(&column.name, values).expect("a column");
    }
    let touches = conserved(&touches).expect("sense");
    assert!(!touches.energy && touches.momentum && !touches.angular_momentum);
    let bounces = conserved(&Setup { forces: vec![Solid::default().into(), Rod::default().into()], ..setup });
    assert!(!bounces.expect("sense").energy);
}

#[test]
fn a_fluid_whose_steps_are_too_long_is_refused() {
    let scene = |dt: &str| {
        let source = Source::find("dam_break_2d").expect("built in");
        let overrides = [format!("simulation.dt={dt}")];
        let mut scene = Scene::load(&source, &overrides, &Options::default()).unwrap_or_else(|why| panic!("{why}"));
        scene.setup()
    };
    let error = said(&scene("0.1")).expect_err("sound goes through many particles").to_string();
    assert!(error.contains("would explode") && error.contains("speed of sound"), "{error}");
}

#[test]
fn integrators_have_their_words() {
    for entry in motes::integrators::INTEGRATORS {
        assert_eq!(entry.by_default().name(), entry.name);
    }
}
