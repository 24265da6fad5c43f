//! `motes crowds`: pedestrians leave a floor plan; a report says how long they need, and where they lose time.

pub mod args;
mod drive;
mod files;
mod page;
mod plan;
mod table;

use std::path::PathBuf;
use std::time::Instant;

use glam::DVec2;
use motes::evacuation::{self, Crowd, Report, Ways};
use motes::run::Progress as _;
use motes::scene::{self, Scene, Source};
use motes::{Cpu, Simulation};

use super::engine::Engine;
use super::failure::Failure;
use super::load;
use super::progress::Progress;
use super::stop;
use super::words::duration;
use args::CrowdsArgs;
use drive::Driven;
use files::Folder;

/// What a report is made of.
pub struct Evacuation<'a> {
    pub args: &'a CrowdsArgs,
    /// The name of the plan.
    pub name: String,
    pub plan: motes::floor_plan::FloorPlan,
    pub report: Report,
    pub driven: Driven,
    pub device: String,
    /// What one should know about the plan, the scene and the device.
    pub remarks: Vec<String>,
    /// The interval between samples, and the step \[s\].
    pub sample: f64,
    pub dt: f64,
}

/// Runs pedestrians out of a plan, and writes the report.
pub async fn crowds(args: &CrowdsArgs) -> Result<(), Failure> {
    let read = plan::read(args)?;
    let name = args.plan.file_stem().map_or_else(|| "plan".to_owned(), |stem| stem.to_string_lossy().into_owned());
    let output = args.output.clone().unwrap_or_else(|| PathBuf::from("out").join(&name));
    let folder = Folder::open(&output, args.overwrite)?;
    let within = args.start.iter().map(|[a, b, c, d]| [DVec2::new(*a, *b), DVec2::new(*c, *d)]).collect();
    let crowd = Crowd {
        people: args.people,
        model: args.model,
        seed: args.seed,
        speed: args.speed,
        within,
        outside: read.landings.clone(),
    };
    let about = format!("{} pedestrians leave {name}, by `motes crowds` (seed {}).", args.people, args.seed);
    let start = evacuation::scene(&read.plan, (&read.wkt, &about), &crowd, args.limit)?;
    let source = Source::Text { name: "scene.toml".to_owned(), text: start.text.clone(), folder: output.clone() };
    let loaded = load::judge(Scene::load(&source, &[], &scene::Options::default())?).await?;
    let (scene, setup) = (loaded.scene, loaded.setup);
    let count = setup.check()?;
    let engine = Engine::choose(&args.device).await?;
    let stop = stop::listen(&args.stop);
    let mut progress = Progress::new(&args.show, 0, scene.steps);
    let others: Vec<String> = engine.remarks(&setup)?.into_iter().chain(scene.remarks.iter().cloned()).collect();
    if !args.show.json {
        progress.say(&format!("{name}: {} pedestrians, on {}", args.people, engine.describe()));
        read.remarks.iter().for_each(|remark| progress.warning(remark));
        others.iter().for_each(|remark| progress.remark(remark));
    }
    let remarks = read.remarks.into_iter().chain(others).collect();
    let begun = Instant::now();
    let (every, steps) = (start.every, scene.steps);
    let driven = match &engine {
        Engine::Gpu(found) => {
            let mut simulation = Simulation::new(&found.device, &found.queue, &setup)?;
            let driven = drive::out(&mut simulation, &setup, (every, steps), &stop, &mut progress).await;
            found.faults.check()?;
            driven?
        }
        Engine::Cpu(_) => {
            drive::out(&mut Simulation::on(Cpu::new(count)?, &setup)?, &setup, (every, steps), &stop, &mut progress)
                .await?
        }
    };
    let _ = progress.finish();
    let ways = Ways::new(read.plan.cells(), driven.distance.clone());
    let report = Report::of(&read.plan, &ways, &driven.record);
    let (dt, sample) = (scene.dt, scene.dt * f64::from(every));
    let done =
        Evacuation { args, name, plan: read.plan, report, driven, device: engine.describe(), remarks, sample, dt };
    let until = done.driven.steps as f64 * dt;
    folder.write(&done, &start.until(until))?;
    if args.show.json {
        out!("{:#}", table::value(&done));
    } else if !args.show.quiet {
        page::summary(&done).iter().for_each(|line| out!("{line}"));
        out!("in {}; report in {}", duration(begun.elapsed()), output.join("report.md").display());
    }
    if done.driven.stopped { Err(Failure::Stopped) } else { Ok(()) }
}
