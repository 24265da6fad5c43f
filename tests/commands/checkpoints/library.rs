//! A scene that the library runs alone gives the files that the command gives.

use motes::formats::Precision;
use motes::run::{Moment, Options, Run, Writer};
use motes::scene::{self, Scene, Source};
use motes::{Cpu, Error, Simulation};
use pollster::block_on;

use crate::checkpoints::{Place, SCENE, difference};

/// The words of the command for the references.
pub fn references() -> String {
    format!("f64 references on {} cores of the processor", rayon::current_num_threads())
}

/// Counts outputs.
#[derive(Default)]
struct Counter(std::sync::Arc<std::sync::atomic::AtomicUsize>);

impl Writer for Counter {
    fn take(&mut self, moment: &Moment<'_>) -> Result<(), Error> {
        assert!(moment.state.len() > 1 && moment.state.get("potential").is_none());
        self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        Ok(())
    }
}

#[test]
fn library_and_command_write_the_same_files() {
    let threads = format!("{}", rayon::current_num_threads());
    for (scene, sets) in [
        ("bodies.toml", &[][..]),
        (
            "flock",
            &[
                "particles.0.count=60",
                "simulation.steps=20",
                "output.frames=3",
                "picture.width=32",
                "picture.height=32",
            ],
        ),
        ("dam_break_2d", &["force.1.spacing=0.1", "simulation.steps=12", "output.formats=[\"npz\"]"]),
        ("fountain_pool", &["force.1.spacing=0.08", "simulation.steps=12", "output.formats=[\"xyz\"]"]),
    ] {
        let place = Place::with(&[("bodies.toml", SCENE)]);
        let word = if scene.contains('.') { place.path(scene) } else { scene.to_owned() };
        let mut args = vec!["run", &word, "--backend", "cpu", "-q"];
        args.extend(sets.iter().flat_map(|set| ["--set", set]));
        let out = place.path("command");
        args.extend(["-o", &out]);
        let (code, words) =
            crate::checkpoints::said(crate::checkpoints::motes(&args).env("RAYON_NUM_THREADS", &threads));
        assert_eq!(code, 0, "{scene}: {words}");

        let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
        let source = Source::find(&word).unwrap_or_else(|faults| panic!("{faults}"));
        let mut scene =
            Scene::load(&source, &sets, &scene::Options::default()).unwrap_or_else(|faults| panic!("{faults}"));
        let setup = scene.setup();
        let options =
            Options { device: references(), precision: Precision::Double, ..Options::into(place.at("library")) };
        let mut run = Run::new(scene, &setup, options).expect("a run");
        let counter = Counter::default();
        let count = counter.0.clone();
        run.writers.push(Box::new(counter));
        let cpu = Cpu::new(setup.check().expect("a setup")).expect("a backend");
        let mut simulation = Simulation::on(cpu, &setup).expect("a simulation");
        let end = block_on(run.drive(&mut simulation, &mut ())).expect("the end");
        assert!(!end.stopped && end.steps >= 12);
        assert_eq!(count.load(std::sync::atomic::Ordering::Relaxed), run.energies().len());
        drop(run);
        if let Some(what) = difference(&place.at("library"), &place.at("command")) {
            panic!("{word}: {what}");
        }
    }
}
