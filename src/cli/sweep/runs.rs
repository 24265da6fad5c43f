//! The runs of a sweep: each into a folder of its own, shared among adapters.

use std::path::Path;
use std::sync::Mutex;

use motes::run::{End, Options, Run, Stop};
use motes::{Cpu, Error, Simulation};

use super::outcome::Outcome;
use super::vary;
use crate::cli::args::{DeviceArgs, SweepArgs};
use crate::cli::engine::Engine;
use crate::cli::failure::Failure;
use crate::cli::load;

/// The backends of the runs, each of which makes one run after another.
pub struct Engines(Vec<(DeviceArgs, Engine)>);

impl Engines {
    /// Opens those of the arguments.
    pub async fn open(args: &SweepArgs) -> Result<Self, Error> {
        let device = |adapter: Option<&String>| DeviceArgs {
            adapter: adapter.cloned().or_else(|| args.scene.device.adapter.clone()),
            ..args.scene.device.clone()
        };
        let devices = match &args.adapters[..] {
            [] => vec![device(None)],
            names => names.iter().map(|name| device(Some(name))).collect(),
        };
        let mut engines = Vec::new();
        for device in devices {
            let engine = Engine::choose(&device).await?;
            engines.push((device, engine));
        }
        Ok(Self(engines))
    }
    /// Their names.
    pub fn names(&self) -> Vec<String> {
        self.0.iter().map(|(_, engine)| engine.describe()).collect()
    }
    /// Remarks on them.
    pub fn remarks(&self) -> Vec<String> {
        self.0.iter().flat_map(|(_, engine)| engine.own()).collect()
    }
}

/// Makes all runs; those that a stop prevents are `None`.
pub fn all(
    args: &SweepArgs,
    cases: &[Vec<String>],
    engines: &Engines,
    output: &Path,
    stop: &Stop,
) -> Vec<Option<Outcome>> {
    let left = Mutex::new(cases.iter().enumerate());
    let found: Mutex<Vec<Option<Outcome>>> = Mutex::new(cases.iter().map(|_| None).collect());
    std::thread::scope(|scope| {
        for (device, engine) in &engines.0 {
            let (left, found) = (&left, &found);
            scope.spawn(move || {
                // A device that has reported an error is opened anew.
                let mut another = None;
                while !stop.is_asked() {
                    let Some((place, case)) = left.lock().ok().and_then(|mut left| left.next()) else { return };
                    let folder = output.join(vary::folder(place, cases.len(), case));
                    let engine = another.as_ref().unwrap_or(engine);
                    let outcome = Outcome::of(pollster::block_on(one(args, case, engine, &folder, stop)));
                    let (number, of) = (place + 1, cases.len());
                    args.said(&format!("{number:>3} of {of}  {}  {}", case.join(" "), outcome.words(&folder)));
                    if outcome.has_failed() {
                        another = pollster::block_on(Engine::choose(device)).ok();
                    }
                    if let Ok(mut found) = found.lock() {
                        found[place] = Some(outcome);
                    }
                }
            });
        }
    });
    found.into_inner().unwrap_or_default()
}

/// Makes one run.
async fn one(
    args: &SweepArgs,
    case: &[String],
    engine: &Engine,
    folder: &Path,
    stop: &Stop,
) -> Result<(Run, End), Failure> {
    let loaded = load::load(&args.scene, case).await?;
    let (scene, setup) = (loaded.scene, loaded.setup);
    let options = Options {
        overwrite: args.overwrite,
        device: engine.describe(),
        precision: engine.precision(),
        stop: stop.clone(),
        ..Options::into(folder)
    };
    let mut run = Run::new(scene, &setup, options)?;
    let end = match engine {
        Engine::Gpu(found) => {
            let driven = run.drive(&mut Simulation::new(&found.device, &found.queue, &setup)?, &mut ()).await;
            found.faults.check()?;
            driven?
        }
        Engine::Cpu(_) => run.drive(&mut Simulation::on(Cpu::new(setup.check()?)?, &setup)?, &mut ()).await?,
    };
    Ok((run, end))
}
