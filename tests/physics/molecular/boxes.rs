//! The box of a state that a barostat has changed: in files, in checks before a run, in measures; and what lies beyond a cut-off.

use std::io::BufWriter;
use std::path::{Path, PathBuf};

use glam::DVec3;
use motes::forces::Component;
use motes::formats::{Options, Precision, format};
use motes::measure::{Moment, measure};
use motes::scene::{self, Scene, Source};
use motes::settings::Settings;
use motes::settings::Value::{self, Number};
use motes::{Bounds, Setup, Side, State};
use pollster::block_on;

use super::{cut, periodic, setup};
use crate::matter::{on_cpu, spread};
use crate::support::states::{force, word};

const TEXT: &str = r#"
[simulation]
dt = 0.004
steps = 200
integrator = "leapfrog"
[box]
size = [7.0, 7.0, 7.0]
boundary = "periodic"
[[particles]]
shape = "crystal"
cells = [3, 3, 3]
density = 0.4
[[force]]
kind = "lennard_jones"
range = 1.5
truncation = "force_shift"
over = "list"
[[force]]
kind = "berendsen_pressure"
pressure = 9.0
compressibility = 0.2
time = 0.5
every = 1
"#;

/// A setup with a barostat, and a state of it after some steps, in a box that is smaller.
fn pressed() -> (Setup, State) {
    let mut state = spread(125, 1.25);
    let low = DVec3::new(0.5, -1.0, 2.0);
    state.position_mut().iter_mut().for_each(|x| *x = (*x + low + 0.25).as_vec3().as_dvec3());
    let given = [("pressure", 9.0), ("compressibility", 0.2), ("time", 0.5), ("every", 1.0)];
    let forces =
        vec![cut(1.5, "force_shift", "list"), force("berendsen_pressure", &given.map(|(key, x)| (key, Number(x))))];
    let setup = setup(state, forces, periodic(low, low + DVec3::splat(6.25)), 0.004);
    let mut simulation = on_cpu(&setup);
    simulation.step(60).expect("steps");
    let state = block_on(simulation.snapshot()).expect("a state");
    assert!(state.boxed(&setup.bounds).high.x < setup.bounds.high.x - 0.01, "it shrinks");
    (setup, state)
}

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("motes_boxes_{name}_{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

fn write(path: &Path, name: &str, state: &State, bounds: Bounds) {
    let options = Options { precision: Precision::Double, bounds: Some(bounds), ..Options::default() };
    let mut file = BufWriter::new(std::fs::File::create(path).expect("a file"));
    format(name).expect("a format").write.expect("a writer")(&mut file, state, &options).expect("written");
}

/// Archives hold the column, other formats the box in their headers: a state has its box again, and is checked in it. Tables have none.
#[test]
fn a_state_has_its_box_again_from_files() {
    let (setup, state) = pressed();
    let (folder, bounds) = (folder("files"), state.boxed(&setup.bounds));
    let columns = setup.columns().expect("columns");
    for name in ["npz", "hdf5", "ply", "vtp", "xyz", "csv"] {
        let path = folder.join(format!("state.{name}"));
        write(&path, name, &state, bounds);
        let read = motes::formats::read(&path, &columns).expect("a state");
        if name == "csv" {
            assert!(read.vector("box_corner").is_none());
            continue;
        }
        let off = (read.boxed(&setup.bounds).high - bounds.high).abs().max_element();
        assert!(off < 1e-12, "{name}: {off}");
        let again = setup.with_state(read);
        again.check().unwrap_or_else(|error| panic!("{name}: {error}"));
        again.plans(motes::kernel::Machine::HOST).expect("plans");
        let remarks = block_on(motes::diagnose::diagnose(&again)).expect("remarks");
        assert!(remarks.iter().all(|remark| remark.id != "outside"), "{name}: {remarks:?}");
    }
    std::fs::remove_dir_all(folder).expect("removed");
}

/// `--from` with a table is refused, and with an archive or a file that has the box the setup is in it.
#[test]
fn a_run_goes_on_in_the_box_of_its_file() {
    let folder = folder("from");
    let source = Source::Text { name: "pressed.toml".to_owned(), text: TEXT.to_owned(), folder: folder.clone() };
    let load = || {
        let mut scene = Scene::load(&source, &[], &scene::Options::default()).expect("a scene");
        let setup = scene.setup();
        (scene, setup)
    };
    let (_, given) = load();
    let mut simulation = on_cpu(&given);
    simulation.step(60).expect("steps");
    let state = block_on(simulation.snapshot()).expect("a state");
    let bounds = state.boxed(&given.bounds);
    for name in ["npz", "xyz", "csv"] {
        let path = folder.join(format!("snapshot_60.{name}"));
        write(&path, name, &state, bounds);
        let (scene, mut setup) = load();
        let went = motes::run::go_on(&mut setup, &scene, &path);
        if name == "csv" {
            let text = went.expect_err("no box").to_string();
            assert!(text.contains("does not hold the box"), "{text}");
            continue;
        }
        went.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!((setup.bounds.high - bounds.high).abs().max_element() < 1e-12, "{name}");
        setup.check().expect("a setup");
    }
    // Without the barostat there is no such column.
    let (scene, mut setup) = load();
    setup.forces.pop();
    let path = folder.join("snapshot_60.npz");
    let text = motes::run::go_on(&mut setup, &scene, &path).expect_err("a column").to_string();
    assert!(text.contains("unknown array `box_corner`"), "{text}");
    std::fs::remove_dir_all(folder).expect("removed");
}

/// A probe that reaches over more than half of a box that has shrunk is refused then, not wrong.
#[test]
fn a_probe_in_a_box_that_has_shrunk_is_refused() {
    let (setup, state) = pressed();
    let half = 0.5 * (state.boxed(&setup.bounds).high.x - setup.bounds.low.x);
    let state = std::sync::Arc::new(state);
    let probe = |range: f64| {
        let settings =
            measure("probe").expect("a measure").keys.iter().filter_map(|key| Some((key.name, key.default.clone()?)));
        let settings = settings.fold(Settings::default(), |all, (name, value)| all.with(name, value));
        let settings = settings.with("range", Number(range)).with("start", Value::Vector(setup.bounds.low));
        let mut series = (measure("probe").expect("a measure").begin)(&setup, &settings)?;
        series.take(&Moment { state: &state, density: &[], clock: None, links: None, virial: None }).map(drop)
    };
    probe(half - 1e-3).expect("a row");
    let text = probe(half + 1e-3).expect_err("too far").to_string();
    assert!(text.contains("has shrunk"), "{text}");
}

/// ∫ U r² dr of exp(−κ r) / r by hand, and for every law ∫ U′ r³ dr = −U(R) R³ − 3 ∫ U r² dr. The tail of 1 / r is infinite.
#[test]
fn tails_of_pair_laws_are_their_integrals() {
    let (range, steepness) = (2.5_f64, 1.3_f64);
    let with = |kind: &str, more: &[(&'static str, f64)]| -> Box<dyn Component> {
        let mut all = vec![("range", Number(range)), ("truncation", word("cut"))];
        all.extend(more.iter().map(|(key, x)| (*key, Number(*x))));
        force(kind, &all)
    };
    let close = |a: f64, b: f64, what: &str| assert!((a - b).abs() < 1e-9 * b.abs(), "{what}: {a} for {b}");
    let [yukawa] = with("yukawa", &[("strength", 2.0), ("screening", steepness)]).tails()[..1] else {
        panic!("a pair")
    };
    let end = 2.0 * (-steepness * range).exp();
    close(yukawa.energy, end * (range / steepness + steepness.powi(-2)), "yukawa");
    close(yukawa.slope, -end * range * range - 3.0 * yukawa.energy, "yukawa");
    let [morse] = with("morse", &[("depth", 1.5), ("steepness", 4.0), ("distance", 1.1)]).tails()[..1] else {
        panic!("a pair")
    };
    // ∫ exp(−a (r − d)) r² dr from R on.
    let part = |a: f64| (-a * (range - 1.1)).exp() * (range * range / a + 2.0 * range / (a * a) + 2.0 / a.powi(3));
    close(morse.energy, 1.5 * (part(8.0) - 2.0 * part(4.0)), "morse");
    let e = (-4.0 * (range - 1.1)).exp();
    close(morse.slope, -1.5 * e * (e - 2.0) * range.powi(3) - 3.0 * morse.energy, "morse");
    let [bare] = with("yukawa", &[("screening", 0.0)]).tails()[..1] else { panic!("a pair") };
    assert!(bare.energy.is_infinite());
    let setup = setup(
        spread(125, 1.25),
        vec![with("yukawa", &[("screening", 0.0)])],
        Bounds::new(DVec3::splat(-0.5), DVec3::splat(6.0), Side::Periodic),
        0.004,
    );
    let error =
        (measure("tail").expect("a measure").begin)(&setup, &Settings::default()).err().map(|error| error.to_string());
    assert!(error.as_ref().is_some_and(|text| text.contains("no finite sum")), "{error:?}");
}
