//! The scene written back: every value of the run, and the same run again.

use motes::forces::Law;
use motes::scene::{Options, SCENES, Scene, Source};

use crate::scenes::{SMALL, load};

/// Loads what was resolved and compares everything.
pub(crate) fn assert_reloads(scene: &Scene, folder: &str) {
    let source =
        Source::Text { name: format!("{}.toml", scene.name), text: scene.resolved.clone(), folder: folder.into() };
    let again =
        Scene::load(&source, &[], &Options::default()).unwrap_or_else(|faults| panic!("{faults}\n{}", scene.resolved));
    assert_eq!(again.resolved, scene.resolved);
    assert_eq!((&again.name, &again.about), (&scene.name, &scene.about));
    assert_eq!((again.dt.to_bits(), again.steps), (scene.dt.to_bits(), scene.steps));
    assert_eq!(again.integrator.name, scene.integrator.name);
    assert_eq!(again.bounds, scene.bounds);
    assert!(again.particles == scene.particles, "{}: other particles", scene.name);
    assert_eq!(again.groups, scene.groups);
    assert_eq!((&again.output, &again.picture), (&scene.output, &scene.picture));
    assert_eq!(laws(&again), laws(scene));
}

fn laws(scene: &Scene) -> Vec<String> {
    let laws = scene.forces.iter().flat_map(|f| f.laws());
    let params = |l: &Law| l.params.iter().map(|(n, v)| format!("{n} {v:?}")).collect::<Vec<_>>();
    laws.map(|l| format!("{} {:?} {:?}", l.name, l.over, params(&l))).collect()
}

#[test]
fn every_built_in_scene_reloads_as_the_same() {
    for builtin in SCENES {
        let scene = Scene::load(&Source::Builtin(builtin), &[], &Options::default())
            .unwrap_or_else(|faults| panic!("{faults}"));
        assert_reloads(&scene, ".");
    }
}

#[test]
fn a_scene_of_everything_reloads_as_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("bodies.csv"), "x,y,z\n0.1,0.2,0.3\n").expect("a file");
    std::fs::write(folder.path().join("swirl.wgsl"), "fn force() {}").expect("a file");
    let text = r#"
        # What one
        #   should see: "quotes" and \ and é.

        # Not this.
        [simulation]
        dt = 0.30000000000000004
        until = 1
        [box]
        low = [-3e22, -100, -3e22]
        size = [6e22, 200.3, 6e22]
        y = "reflecting"
        [[particles]]
        file = "bodies.csv"
        center = [1e-7, -0.0, 1e22]
        color = "skyblue"
        [[particles]]
        shape = "sphere"
        count = 20
        species = 4294967295
        seed = 9007199254740991
        [[force]]
        wgsl = "swirl.wgsl"
        over = "each"
        params = { a = 1, "b \"c\" \\" = [1, 2, 3], d = false }
        [[force]]
        kind = "wind"
        [output]
        formats = ["png", "csv", "png"]
        frames = 5
    "#;
    let path = folder.path().join("every thing.toml");
    std::fs::write(&path, text).expect("a file");
    let overrides = ["particles.1.mass=3".to_owned(), "simulation.integrator=rk4".to_owned()];
    let scene =
        Scene::load(&Source::File(path), &overrides, &Options::default()).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(scene.about, "What one\n  should see: \"quotes\" and \\ and é.");
    assert_eq!(
        scene.remarks,
        ["until = 1.0 is no whole number of steps of dt = 0.30000000000000004: 4 steps of dt = 0.25 reach it"]
    );
    assert_eq!((scene.dt.to_bits(), scene.steps), (0.25_f64.to_bits(), 4));
    let formats: Vec<&str> = scene.output.formats.iter().map(|format| format.name).collect();
    assert_eq!((formats, scene.output.pictures, scene.output.frames), (vec!["csv"], true, 5));
    assert!(scene.resolved.contains("\nmass = 3.0\n") && scene.resolved.contains("\nintegrator = \"rk4\"\n"));
    assert!(scene.resolved.contains("\nseed = 9007199254740991\n"));
    assert_reloads(&scene, &folder.path().to_string_lossy());
    // From elsewhere its files are outside.
    let source = Source::Text { name: "a.toml".to_owned(), text: scene.resolved.clone(), folder: "src".into() };
    assert_eq!(Scene::load(&source, &[], &Options::default()).err().map(|faults| faults.total), Some(2));
    let again = Scene::load(&source, &[], &Options { allow_outside: true, ..Options::default() });
    assert_eq!(again.unwrap_or_else(|faults| panic!("{faults}")).resolved, scene.resolved);
}

#[test]
fn defaults_are_filled_in() {
    let scene = load(SMALL, &[]).unwrap_or_else(|faults| panic!("{faults}"));
    let expected = r#"
# Every value of the run, defaults included.

[simulation]
dt = 0.1
steps = 10
precision = "single"
integrator = "leapfrog"

[solver]
tolerance = 0.001
iterations = 100
solves = 8

[[particles]]
bodies = [
  { position = [0.0, 0.0, 0.0], velocity = [0.0, 0.0, 0.0], mass = 1.0, size = 0.0, species = 0 },
]
center = [0.0, 0.0, 0.0]
velocity = [0.0, 0.0, 0.0]
velocity_factor = 1.0

[output]
every = 1
formats = ["csv", "png"]
frames = 0
columns = []
compress = false
files = 1

[checkpoint]
every = "600.0 s"
keep = 2

[picture]
"#;
    assert!(scene.resolved.starts_with(expected), "{}", scene.resolved);
    assert_eq!(scene.groups[0].color, None);
    assert_reloads(&scene, ".");
}

#[test]
fn until_gives_the_steps_that_reach_it() {
    for (dt, until, steps, remarked) in [
        ("0.1", "1.0", 10, false),
        ("0.1", "0.3", 3, false), // 0.3 / 0.1 is 2.9999999999999996 in f64
        ("0.001", "1000", 1_000_000, false),
        ("1e-6", "1e3", 1_000_000_000, false),
        ("0.3", "2.1", 7, false), // 2.1 / 0.3 is 7.000000000000001
        ("0.3", "1", 4, true),
        ("10", "1", 1, true),
        ("0.007", "1", 143, true),
        ("0.1", "1.000001", 11, true),
    ] {
        let text = SMALL.replace("dt = 0.1", &format!("dt = {dt}")).replace("steps = 10", &format!("until = {until}"));
        let scene = load(&text, &[]).unwrap_or_else(|faults| panic!("{faults}"));
        assert_eq!(scene.steps, steps, "dt = {dt}, until = {until}");
        assert_eq!(!scene.remarks.is_empty(), remarked, "dt = {dt}, until = {until}: {:?}", scene.remarks);
    }
}

#[test]
fn overrides_replace_their_rivals() {
    let steps = |overrides: &[&str]| load(SMALL, overrides).map_or_else(|faults| panic!("{faults}"), |s| s.steps);
    assert_eq!(steps(&["simulation.until=2"]), 20);
    assert_eq!(steps(&["simulation.steps=7", "simulation.steps = 8"]), 8);
    let scene = load(SMALL, &["particles.0.bodies.0.position.1=4", "output.formats=[]", "picture.width=64"]);
    let scene = scene.unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(scene.particles.position()[0].to_array(), [0.0, 4.0, 0.0]);
    assert!(scene.output.formats.is_empty());
    assert_eq!(scene.picture.whole("width"), 64);
}
