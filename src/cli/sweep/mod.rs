//! `motes sweep`: a scene for every combination of some values, and what becomes of it.

mod outcome;
mod picture;
mod table;
mod vary;

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Instant;

use motes::run::{Options, Run, Stop};
use motes::{Cpu, Error, Simulation};
use serde_json::json;

use super::args::{DeviceArgs, SceneArgs, SweepArgs};
use super::engine::Engine;
use super::failure::Failure;
use super::{stop, substeps};
use outcome::{Ended, Outcome};
use vary::Varied;

/// So many runs are made at most.
const MOST: usize = 10_000;
/// What keeps a run to its tables.
const NO_FILES: [&str; 2] = ["output.formats=[]", "output.frames=0"];

/// Runs a scene with all combinations of values.
pub async fn sweep(args: &SweepArgs) -> Result<(), Failure> {
    let varied = args.vary.iter().map(|text| Varied::parse(text)).collect::<Result<Vec<_>, _>>()?;
    vary::check(&varied)?;
    let cases = vary::combinations(&varied);
    if cases.len() > MOST {
        let text = format!("{} combinations are to be run, and {MOST} are the most: give fewer values", cases.len());
        return Err(Error::Scene(text).into());
    }
    let args = &plain(args);
    // What is wrong with any of them is said before the first one runs.
    for case in &cases {
        substeps::load(&args.scene, case).await?;
    }
    let name = substeps::load(&args.scene, &cases[0]).await?.scene.name;
    let output = args.output.clone().unwrap_or_else(|| PathBuf::from("out").join(format!("{name}_sweep")));
    let names: Vec<String> = if args.adapters.is_empty() { vec![String::new()] } else { args.adapters.clone() };
    let mut engines = Vec::new();
    for name in names {
        let adapter = Some(name).filter(|name| !name.is_empty()).or_else(|| args.scene.device.adapter.clone());
        engines.push(Engine::choose(&DeviceArgs { adapter, ..args.scene.device.clone() }).await?);
    }
    let (stop, begun) = (stop::listen(&args.stop), Instant::now());
    let left = Mutex::new(cases.iter().enumerate());
    let found: Mutex<Vec<Option<Outcome>>> = Mutex::new(cases.iter().map(|_| None).collect());
    std::thread::scope(|scope| {
        for engine in &engines {
            let (left, found, stop, output, of) = (&left, &found, &stop, &output, cases.len());
            scope.spawn(move || {
                while !stop.is_asked() {
                    let Some((place, case)) = left.lock().ok().and_then(|mut left| left.next()) else { return };
                    let folder = output.join(vary::folder(case));
                    let outcome = pollster::block_on(one(args, case, engine, &folder, stop));
                    args.said(&format!("{:>3} of {}  {}  {}", place + 1, of, case.join(" "), outcome.words()));
                    if let Ok(mut found) = found.lock() {
                        found[place] = Some(outcome);
                    }
                }
            });
        }
    });
    let found = found.into_inner().unwrap_or_default();
    let ended: Vec<Ended<'_>> = outcome::compared(&cases, &found);
    if ended.is_empty() {
        return Err(Failure::Stopped);
    }
    std::fs::create_dir_all(&output).map_err(|why| Error::Output { file: output.clone(), message: why.to_string() })?;
    let files = (output.join("sweep.csv"), output.join("sweep.svg"));
    table::write(&files.0, &varied, &ended)?;
    let drawn = picture::draw(&files.1, &name, &varied, &ended)?;
    let order = outcome::order(&varied, &ended);
    if !outcome::end_together(&found) {
        args.said(
            "the runs end at different times, and their ends are compared only where these are the same: give --until",
        );
    }
    if args.show.json {
        let rows: Vec<_> = ended.iter().map(|one| one.json(&varied)).collect();
        let value = json!({ "scene": name, "device": engines.iter().map(Engine::describe).collect::<Vec<_>>(), "runs": rows,
            "order": order, "output": output, "seconds": begun.elapsed().as_secs_f64() });
        out!("{value:#}");
    } else if !args.show.quiet {
        out!("\n{}", table::text(&varied, &ended));
        order.into_iter().for_each(|order| {
            out!("ends differ from that of the last run as {} to the power {order:.2}", varied[0].key);
        });
        out!("{}{}", files.0.display(), if drawn { format!(", {}", files.1.display()) } else { String::new() });
    }
    if stop.is_asked() {
        return Err(Failure::Stopped);
    }
    // Where nothing came to its end there is nothing to compare.
    match ended.iter().find_map(|one| one.error.as_ref()).filter(|_| ended.iter().all(|one| one.error.is_some())) {
        Some(text) => Err(Error::Scene(format!("no run came to its end; the first failed so: {text}")).into()),
        None => Ok(()),
    }
}

/// The same without pictures and snapshots, unless they are asked for.
fn plain(args: &SweepArgs) -> SweepArgs {
    let asked = args.scene.overrides.iter().chain(&args.vary).any(|set| set.trim_start().starts_with("output."));
    let none = NO_FILES.iter().filter(|_| !asked).map(|set| (*set).to_owned());
    let overrides = args.scene.overrides.iter().cloned().chain(none).collect();
    SweepArgs { scene: SceneArgs { overrides, ..args.scene.clone() }, ..args.clone() }
}

impl SweepArgs {
    /// Says how far it is.
    fn said(&self, text: &str) {
        if !self.show.json && !self.show.quiet {
            note!("{text}");
        }
    }
}

/// One of the runs, into a folder of its own.
async fn one(args: &SweepArgs, case: &[String], engine: &Engine, folder: &Path, stop: &Stop) -> Outcome {
    let made = async {
        let loaded = substeps::load(&args.scene, case).await.map_err(words)?;
        let (scene, setup) = (loaded.scene, loaded.setup);
        let options = Options {
            overwrite: args.overwrite,
            device: engine.describe(),
            precision: engine.precision(),
            stop: stop.clone(),
            ..Options::into(folder)
        };
        let mut run = Run::new(scene, &setup, options).map_err(|error| error.to_string())?;
        let end = match engine {
            Engine::Gpu(found) => {
                let simulation = Simulation::new(&found.device, &found.queue, &setup);
                let driven = run.drive(&mut simulation.map_err(|e| e.to_string())?, &mut ()).await;
                found.faults.check().and(driven)
            }
            Engine::Cpu(_) => {
                let host = setup.check().and_then(Cpu::new).and_then(|host| Simulation::on(host, &setup));
                run.drive(&mut host.map_err(|e| e.to_string())?, &mut ()).await
            }
        };
        end.map(|end| (run, end)).map_err(|error| error.to_string())
    };
    Outcome::of(made.await)
}

fn words(failure: Failure) -> String {
    match failure {
        Failure::Scene(faults) => faults.to_string(),
        Failure::Error(error) => error.to_string(),
        Failure::Explained(error, more) => format!("{error}\n{more}"),
        Failure::Disagreement | Failure::Stopped => "stopped".to_owned(),
    }
}
