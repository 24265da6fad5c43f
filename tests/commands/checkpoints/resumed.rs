//! A run that was ended and continues leaves the files of one that was never stopped, byte for byte: for every built-in scene.

use std::path::Path;

use motes::formats::Precision;
use motes::kernel::Backend;
use motes::run::{End, Folder, Found, Moment, Options, Progress, Run, Stop, Writer};
use motes::scene::{self, SCENES, Scene, Source};
use motes::{Cpu, Error, Gpu, Setup, Simulation};
use pollster::block_on;

use crate::checkpoints::{Place, difference};
use crate::support::small::smaller;

pub type On<'a, B> = &'a dyn Fn(&Setup) -> Result<Simulation<B>, Error>;

/// How a run is ended.
#[derive(Clone, Copy, PartialEq)]
pub enum Way {
    Never,
    /// In the middle of an output at this step or later, as if it was killed.
    Killed(u64),
    /// By a request after this step.
    Stopped(u64),
}

/// Fails at an output.
struct Fails(u64);

impl Writer for Fails {
    fn take(&mut self, moment: &Moment<'_>) -> Result<(), Error> {
        if moment.state.step < self.0 { Ok(()) } else { Err(Error::Scene("killed".to_owned())) }
    }
}

/// Asks for an end.
struct Asks(Stop, u64);

impl Progress for Asks {
    fn at(&mut self, step: u64) {
        if step >= self.1 {
            self.0.ask();
        }
    }
}

fn load(name: &str, sets: &[String]) -> Scene {
    let source = Source::find(name).expect("a built-in scene");
    Scene::load(&source, sets, &scene::Options::default()).unwrap_or_else(|faults| panic!("{name}: {faults}"))
}

/// Begins a run, or continues with it, until it ends in some way.
fn part<B: Backend>(
    scene: Option<Scene>,
    out: &Path,
    (on, precision): (On<'_, B>, Precision),
    way: Way,
) -> Result<End, Error> {
    let step = if let Way::Stopped(step) = way { step } else { u64::MAX };
    let stop = Stop::default();
    let more = |options: Options| Options { precision, stop: stop.clone(), ..options };
    let (mut run, setup) = if let Some(mut scene) = scene {
        let setup = scene.setup();
        (Run::new(scene, &setup, more(Options::into(out)))?, setup)
    } else {
        let folder = Folder::hold(out)?;
        let Found::Checkpoint(from, damaged) = Found::of(&folder)? else {
            return Err(Error::Scene("there is no checkpoint".to_owned()));
        };
        assert!(damaged.is_empty(), "{damaged:?}");
        let mut scene = Scene::load(&from.source(), &[], &scene::Options::default()).expect("a scene");
        let mut setup = scene.setup();
        let options = more(from.options(out));
        (Run::resume(scene, &mut setup, options, (folder, *from))?, setup)
    };
    if let Way::Killed(step) = way {
        run.writers.push(Box::new(Fails(step)));
    }
    block_on(run.drive(&mut on(&setup)?, &mut Asks(stop, step)))
}

/// Compares a run in one go with one in several parts.
pub fn compare<B: Backend>(
    name: &str,
    sets: &[String],
    on: (On<'_, B>, Precision),
    ways: &[Way],
) -> Result<(), String> {
    let place = Place::with(&[]);
    let (whole, parts) = (place.at("whole"), place.at("parts"));
    let fail = |error: Error| error.to_string();
    part(Some(load(name, sets)), &whole, on, Way::Never).map_err(fail)?;
    for (number, way) in ways.iter().chain([&Way::Never]).enumerate() {
        let ended = part((number == 0).then(|| load(name, sets)), &parts, on, *way);
        match (way, ended) {
            (Way::Killed(_), Err(Error::Scene(why))) if why == "killed" => {}
            (Way::Stopped(_), Ok(end)) if end.stopped => {}
            (Way::Never, Ok(end)) if !end.stopped => {}
            (_, ended) => return Err(format!("part {number} ends otherwise: {ended:?}")),
        }
    }
    difference(&parts, &whole).map_or(Ok(()), Err)
}

/// What scenes may say beside what they say.
const MORE: &[(&str, &[&str])] = &[
    ("dam_break_2d", &["force.1.spacing=0.1", "simulation.adaptive=true"]),
    (
        "dam_break_2d",
        &["force.1.spacing=0.1", "force.1.solver=dfsph", "force.1.alpha=0", "simulation.integrator=symplectic_euler"],
    ),
    ("plummer", &["particles.0.count=100", "force.0.over=tree", "force.0.alpha=0.01"]),
    // Few particles, whose trails are pictures.
    ("kepler", &["output.frames=5", "picture.auto_frame=false", "picture.extent=3", "picture.center=[0, 0, 0]"]),
];

fn every_scene<B: Backend>(on: (On<'_, B>, Precision), ways: &[Way], size: u32) {
    let scenes = SCENES.iter().map(|scene| (scene.name, smaller(scene.name)));
    let mut failures = Vec::new();
    for (name, sets) in scenes.chain(MORE.iter().copied()) {
        // A small periodic box has cells enough for its range with eight particles along each side.
        let sets = if name == "periodic_box" { &["particles.0.size=[8, 8, 8]"][..] } else { sets };
        let mut all: Vec<String> = vec![
            "simulation.steps=24".to_owned(),
            "output.every=8".to_owned(),
            "output.frames=4".to_owned(),
            "output.formats=[\"npz\", \"png\"]".to_owned(),
            format!("picture.width={size}"),
            format!("picture.height={size}"),
            "checkpoint.every=\"5 steps\"".to_owned(),
        ];
        all.extend(sets.iter().map(|set| (*set).to_owned()));
        if let Err(why) = compare(name, &all, on, ways) {
            failures.push(format!("{name} {sets:?}: {why}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_scene_resumes_on_the_device() {
    let shared = crate::support::device();
    let on = |setup: &Setup| -> Result<Simulation<Gpu>, Error> {
        Simulation::new(&shared.found.device, &shared.found.queue, setup)
    };
    every_scene((&on, Precision::Single), &[Way::Killed(16)], 24);
}

#[test]
fn every_scene_resumes_by_the_references() {
    let on = |setup: &Setup| Simulation::on(Cpu::new(setup.check()?)?, setup);
    every_scene((&on, Precision::Double), &[Way::Killed(8), Way::Stopped(11), Way::Killed(24)], 16);
}
