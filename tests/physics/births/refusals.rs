//! What cannot be is refused, with its reason and where it stands.

use glam::DVec3;
use motes::life::{Birth, Drain, Life, check};
use motes::motion::{Held, Hold};
use motes::scene::{Options, Scene, Source};
use motes::solids::Solid;

const BODY: &str = "[simulation]\ndt = 0.01\nsteps = 100\n[[particles]]\nbodies = [{ position = [0, 1, 0] }]\n";

fn said(text: &str) -> String {
    let source = Source::Text { name: "a.toml".to_owned(), text: text.to_owned(), folder: ".".into() };
    match Scene::load(&source, &[], &Options { most_particles: 5000, ..Options::default() }) {
        Err(faults) => faults.to_string(),
        Ok(_) => "nothing".to_owned(),
    }
}

#[test]
fn faults_of_scenes_name_their_place() {
    let cases = [
        ("[[emitter]]\nspeed = 1\n", "requires either a `spacing`", "a.toml:6:1"),
        ("[[emitter]]\nspeed = 1\nspacing = 0.1\nrate = 3\n", "requires either a `spacing`", "a.toml:6:1"),
        ("[[emitter]]\nspacing = 0.1\n", "lacks `speed`", "a.toml:6:1"),
        ("[[emitter]]\nspeed = 1\nspacing = 0.1\nspeeed = 1\n", "did you mean `speed`?", "a.toml:9:1"),
        ("[[emitter]]\nspeed = 1\nspacing = 0.1\nstart = 7\n", "no particle would be spawned", "a.toml:6:1"),
        ("[[emitter]]\nspeed = 1\nspacing = 0.01\n", "the maximum is 4999", "a.toml:6:1"),
        ("[[emitter]]\nspeed = 1\nrate = 5\nspread = 91\n", "between 0 and 90", "a.toml:6:1"),
        ("[[emitter]]\nspeed = 1\nrate = 5\nfirst = 1\n", "are more than there are", "a.toml:9:9"),
        (
            "[box]\ndimensions = 2\n[[emitter]]\nspeed = 1\nrate = 5\ndirection = [0, 0, 1]\n",
            "out of the plane",
            "a.toml:8:1",
        ),
        ("[[drain]]\nshape = \"box\"\nsize = [0, 0, 0]\n", "is no solid", "a.toml:6:1"),
        ("[[drain]]\nshape = \"cone\"\n", "\"cone\"", "a.toml:7:9"),
        (
            "[[drain]]\n[[force]]\nkind = \"boids\"\nrange = 1\nover = \"within\"\n",
            "evaluates all pairs, and where particles are spawned or removed, some are inactive",
            "a.toml:6:1",
        ),
    ];
    for (text, why, place) in cases {
        let said = said(&format!("{BODY}{text}"));
        assert!(said.contains(why) && said.contains(place), "{text}\n{said}");
    }
    let implicit = BODY.replace("steps = 100", "steps = 100\nintegrator = \"backward_euler\"") + "[[drain]]\n";
    assert!(said(&implicit).contains("implicit integrators cannot be used"), "{}", said(&implicit));
    let tied = format!("{BODY}[[particles]]\nshape = \"chain\"\ncount = 4\n[[drain]]\n[[force]]\nkind = \"spring\"\n");
    assert!(said(&tied).contains("links cannot lose an end"), "{}", said(&tied));
    for good in ["[[emitter]]\nspeed = 1\nrate = 5\n", "[[drain]]\n[[force]]\nkind = \"gravity\"\n"] {
        assert_eq!(said(&format!("{BODY}{good}")), "nothing");
    }
}

#[test]
fn programs_get_the_same_errors() {
    let birth = Birth { id: 1, time: 0.0, velocity: DVec3::X, mass: 1.0, guided: 0.0, emitter: 0 };
    let drain = Drain { solid: Solid::Sphere(1.0), position: DVec3::ZERO, outside: false, species: None };
    let life = [Life::Active, Life::Pending];
    let held = |id| Held { id, by: Hold::Fixed };
    assert!(check((&life, &[birth], &[drain]), &[held(0)], 2, 3).is_ok());
    let up = Birth { velocity: DVec3::Z, ..birth };
    let cases = [
        (check((&life, &[], &[]), &[], 1, 3), "the life of 2 particles is given, but there are 1"),
        (check((&life, &[Birth { id: 2, ..birth }], &[]), &[], 2, 3), "particle 2 is to be spawned, but there are 2"),
        (check((&life, &[birth, birth], &[]), &[], 2, 3), "spawned twice"),
        (check((&life, &[Birth { mass: -1.0, ..birth }], &[]), &[], 2, 3), "negative mass"),
        (check((&life, &[Birth { time: f64::NAN, ..birth }], &[]), &[], 2, 3), "NaN"),
        (check((&life, &[up], &[]), &[], 2, 2), "out of the plane"),
        (check((&life, &[], &[]), &[held(1)], 2, 3), "particle 1 is fixed"),
        (check((&life, &[], &[Drain { solid: Solid::Sphere(0.0), ..drain }]), &[], 2, 3), "drain 0 is no solid"),
        (check((&life, &[], &[drain, Drain { position: DVec3::NAN, ..drain }]), &[], 2, 3), "drain 1 is no solid"),
    ];
    for (result, why) in cases {
        let said = result.expect_err(why).to_string();
        assert!(said.contains(why), "{said}");
    }
}
