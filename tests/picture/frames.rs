//! Frames of built-in scenes: nothing is cut off at the start, and what is framed automatically fills the picture.

use motes::render::{Camera, Picture, Scenery, Trail, framed};
use motes::scene::{Options, SCENES, Scene, Source};
use motes::settings::Settings;
use motes::*;

/// Scenes of which a picture shows a part: stars and birds without an end, planets farther out, bodies and grains that still fall.
const PARTS: &[&str] = &[
    "accretion",
    "avalanche",
    "brazil_nut",
    "cold_collapse",
    "column_collapse",
    "cosmic_web",
    "flock",
    "fountain",
    "galaxy",
    "merger",
    "murmuration",
    "periodic_box",
    "pile",
    "plummer",
    "sandcastle",
    "solar_system",
    "vapour",
    "vicsek",
];

fn scene(name: &str) -> Scene {
    let source = Source::find(name).expect("a built-in scene");
    Scene::load(&source, &[], &Options::default()).unwrap_or_else(|faults| panic!("{name}: {faults}"))
}

/// How far from the middle towards the edges particles are seen at most, to the sides and upwards: 1 is at the edge.
fn filled(settings: &Settings, particles: &State, bounds: &Bounds) -> [f64; 2] {
    let settings = framed(settings, bounds);
    let picture = Picture::with(&settings, particles, &[], Trail::default(), &Scenery::of(particles)).unwrap();
    let Camera { extent, .. } = picture.frame.camera;
    let aspect = f64::from(picture.frame.width) / f64::from(picture.frame.height);
    let mut most = [0.0_f64; 2];
    for (x, radius) in particles.position().iter().zip(particles.size()) {
        let seen = picture.frame.camera.sees(*x).unwrap_or([f64::INFINITY; 2]);
        most = [most[0].max((seen[0].abs() + radius / extent) / aspect), most[1].max(seen[1].abs() + radius / extent)];
    }
    most
}

#[test]
fn nothing_of_a_scene_is_cut_off_at_the_start() {
    let mut wrong = Vec::new();
    for builtin in SCENES.iter().filter(|builtin| !PARTS.contains(&builtin.name)) {
        let scene = scene(builtin.name);
        let [across, up] = filled(&scene.picture, &scene.particles, &scene.bounds);
        println!("{}: {across:.2} {up:.2}", builtin.name);
        if across > 1.0 || up > 1.0 {
            wrong.push(format!("{}: {across:.2} {up:.2}", builtin.name));
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// A margin of 14 % is an eighth of the picture.
#[test]
fn automatic_frames_are_full() {
    for name in ["hair", "droplet", "pendulum", "hydrostatic", "jelly"] {
        let scene = scene(name);
        let settings = scene.picture.clone().with("auto_frame", true.into());
        let [across, up] = filled(&settings, &scene.particles, &Bounds::default());
        assert!((0.85..0.91).contains(&across.max(up)), "{name}: {across} {up}");
    }
}
