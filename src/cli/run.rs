//! `motes run` and `motes resume`

use std::path::{Path, PathBuf};

use motes::kernel::Backend;
use motes::run::Folder;
use motes::run::{Checkpoint, End, Found, Options, Progress as _, Run};
use motes::scene::{self, Every, Scene};
use motes::simulation::{ListReport, PressureSolves, Solves, Unsettled};
use motes::stability::Verdict;
use motes::{Cpu, Error, Setup, Simulation};
use serde_json::json;

use super::args::{DeviceArgs, ResumeArgs, RunArgs, ShowArgs};
use super::engine::Engine;
use super::failure::Failure;
use super::load::{self, Loaded};
use super::progress::{Progress, SCHEMA};
use super::{aftermath, conclude, course, neighbors, solves, stop};
use motes::diagnose::{advice, conserved};

/// A checkpoint, its folder, and the errors of newer checkpoints.
type Kept = (Folder, Box<Checkpoint>, Vec<Error>);

/// Runs a scene.
pub async fn run(args: &RunArgs) -> Result<(), Failure> {
    let frames = args.frames.map(|n| format!("output.frames={n}"));
    let mut loaded = load::load(&args.scene, &Vec::from_iter(frames)).await?;
    if let Some(path) = &args.from {
        motes::run::go_on(&mut loaded.setup, &loaded.scene, path)?;
    }
    let output = args.output.clone().unwrap_or_else(|| PathBuf::from("out").join(&loaded.scene.name));
    let (ledger, fps, from) = (args.ledger, args.fps, args.from.clone());
    let mut options = Options { ledger, fps, from, overwrite: args.overwrite, ..Options::into(&output) };
    let (mut kept, mut remarks) = (None, Vec::new());
    if args.resume && output.is_dir() {
        let folder = Folder::hold(&output)?;
        match Found::of(&folder)? {
            Found::Checkpoint(from, damaged) => kept = Some((folder, from, damaged)),
            Found::Complete(step) if motes::run::is_of(&folder, &loaded.scene) => {
                complete(&output, step, &args.show);
                return Ok(());
            }
            Found::Begun if motes::run::is_of(&folder, &loaded.scene) => {
                remarks.push(begins_anew(folder, &loaded)?);
                options.overwrite = true;
            }
            // Results of another run are refused, as without --resume.
            Found::Begun | Found::Complete(_) | Found::Nothing => {}
        }
    }
    options.stop = stop::listen(&args.stop);
    start(loaded, options, (kept, remarks), &args.scene.device, &args.show).await
}

/// The note on a run that starts over, because it ended before its first checkpoint; an error if the scene writes none.
fn begins_anew(folder: Folder, loaded: &Loaded) -> Result<String, Error> {
    let folder = folder.named(&loaded.scene.name);
    let count = folder.results()?.len();
    if loaded.scene.checkpoint.every != Every::Never {
        return Ok(format!(
            "{count} results of this scene are removed, and the run starts over: it was ended before its first checkpoint"
        ));
    }
    let message = format!(
        "the folder holds {count} results of a run of this scene, which cannot go on: `[checkpoint] every` is \"never\", and none was written; --overwrite in place of --resume removes \
         them and starts over"
    );
    Err(Error::Output { file: folder.path().to_owned(), message })
}

/// Resumes a run.
pub async fn resume(args: &ResumeArgs) -> Result<(), Failure> {
    let refuse = |message: &str| Err(Error::Output { file: args.folder.clone(), message: message.to_owned() }.into());
    if !args.folder.is_dir() {
        return refuse("the folder does not exist: give the folder of a run");
    }
    let folder = Folder::hold(&args.folder)?;
    let (from, damaged) = match Found::of(&folder)? {
        Found::Checkpoint(from, damaged) => (from, damaged),
        Found::Complete(step) => {
            complete(&args.folder, step, &args.show);
            return Ok(());
        }
        Found::Begun => {
            return refuse(
                "the run was ended before its first checkpoint: `motes run SCENE -o DIR --resume` starts over",
            );
        }
        Found::Nothing => return refuse("no run has written there"),
    };
    let scene = Scene::load(&from.source(), &[], &scene::Options::default())?;
    let mut loaded = load::judge(scene).await?;
    if let Some(path) = from.from() {
        motes::run::go_on(&mut loaded.setup, &loaded.scene, &path)?;
    }
    let options = Options { stop: stop::listen(&args.stop), ..from.options(&args.folder) };
    start(loaded, options, (Some((folder, from, damaged)), Vec::new()), &args.device, &args.show).await
}

fn complete(folder: &Path, step: u64, show: &ShowArgs) {
    if show.json {
        out!("{}", json!({ "event": "complete", "schema": SCHEMA, "step": step, "output": folder }));
    } else if !show.quiet {
        out!("the run in {} is complete, with step {step}: there is nothing to resume", folder.display());
    }
}

async fn start(
    Loaded { scene, mut setup, verdict, .. }: Loaded,
    mut options: Options,
    (kept, mut remarks): (Option<Kept>, Vec<String>),
    device: &DeviceArgs,
    show: &ShowArgs,
) -> Result<(), Failure> {
    let count = setup.check()?;
    let engine = Engine::choose(device).await?;
    options.device = engine.describe();
    options.precision = engine.precision();
    let conserved = conserved(&setup)?;
    let mut run = if let Some((folder, from, damaged)) = kept {
        remarks
            .extend(damaged.iter().map(|error| format!("a checkpoint is damaged, and an older one is used: {error}")));
        Run::resume(scene, &mut setup, options, (folder, *from))?
    } else {
        remarks.extend(
            engine.remarks(&setup)?.into_iter().chain(
                scene
                    .remarks
                    .clone()
                    .into_iter()
                    .chain(advice(&setup, Some(scene.steps as f64 * scene.dt))?.iter().map(ToString::to_string)),
            ),
        );
        Run::new(scene, &setup, options)?
    };
    let mut progress = Progress::new(show, motes::run::begun(run.scene(), &setup.state), run.scene().steps);
    announce(&run, &mut progress, &remarks);
    // All checks come before the first file is written.
    let driven = match &engine {
        Engine::Gpu(found) => {
            let mut simulation = Simulation::new(&found.device, &found.queue, &setup)?;
            let driven = drive(&mut run, &mut simulation, &mut progress).await;
            // Errors that the device reported outside of calls explain the failure.
            found.faults.check()?;
            driven
        }
        Engine::Cpu(_) => {
            let mut simulation = Simulation::on(Cpu::new(count)?, &setup)?;
            drive(&mut run, &mut simulation, &mut progress).await
        }
    };
    let result = match driven {
        Ok(Driven { end, solves, pressures, unsettled, list }) => {
            let concluded = conclude::conclude(&run, end, &conserved, (&progress, device));
            solves::tell(&progress, solves, pressures);
            solves::tell_unsettled(&progress, unsettled, run.scene().adaptive_step.is_some());
            neighbors::tell(&progress, list);
            concluded
        }
        Err(error) => Err(explain(&run, error, &setup, verdict.as_ref())),
    };
    if let (Err(Failure::Error(Error::Timeout { .. })), Engine::Gpu(_)) = (&result, &engine) {
        // To drop a device that does not respond would block.
        let _ = result.err().map(Failure::report);
        stop::leave(7);
    }
    result
}

/// The results of a run that its final report uses.
struct Driven {
    end: End,
    solves: Option<Solves>,
    unsettled: Option<Unsettled>,
    pressures: Option<[PressureSolves; 2]>,
    list: Option<ListReport>,
}

async fn drive<B: Backend>(
    run: &mut Run,
    simulation: &mut Simulation<B>,
    progress: &mut Progress,
) -> Result<Driven, Error> {
    let end = run.drive(simulation, progress).await?;
    let (solves, pressures) = (simulation.solves().await?, simulation.pressure_solves().await?);
    let unsettled = simulation.unsettled().await?;
    Ok(Driven { end, solves, pressures, unsettled, list: simulation.neighbor_list() })
}

/// Prints the scene, its number of particles and its device.
fn announce(run: &Run, progress: &mut Progress, remarks: &[String]) {
    let (scene, count, Options { output, device, .. }) = (run.scene(), run.count(), run.options());
    progress.event(
        "start",
        json!({ "version": env!("CARGO_PKG_VERSION"), "scene": scene.name, "particles": count, "steps": scene.steps,
            "dt": scene.dt, "block_levels": scene.block_steps.map(|steps| steps.levels), "integrator": scene.integrator.name, "device": device, "output": output }),
    );
    progress.say(&format!("{}: {count} particles, {} by {}", scene.name, course::words(scene), scene.integrator.name));
    progress.say(&format!("on {device}"));
    remarks.iter().for_each(|remark| progress.remark(remark));
}

/// Explains NaN or a runaway, and writes the last valid state.
fn explain(run: &Run, error: Error, setup: &Setup, verdict: Option<&Verdict>) -> Failure {
    let (scene, Options { output, precision, .. }) = (run.scene(), run.options());
    let way = verdict.and_then(|verdict| motes::diagnose::way_out(verdict, setup));
    let to = (output.as_path(), &*scene.output.formats, *precision);
    aftermath::explain(error, setup, way.as_deref(), run.last.as_deref(), to)
}
