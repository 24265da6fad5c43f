//! `motes check`

use std::collections::{BTreeMap, BTreeSet};
use std::time::{Duration, Instant};

use motes::kernel::{ACCELERATION, Backend};
use motes::render::{Picture, Scenery, Trail};
use motes::{Bounds, Cpu, Gpu, Setup, Simulation};

use super::args::SceneArgs;
use super::course;
use super::engine::Engine;
use super::failure::Failure;
use super::load::{self, Loaded};
use super::words::duration;
use motes::diagnose::advice;

/// Checks a scene: its faults, its memory, and the time that a run would take.
pub async fn check(args: &SceneArgs) -> Result<(), Failure> {
    let Loaded { scene, setup, start, lines, .. } = load::load(args, &[]).await?;
    let count = setup.check()?;
    Picture::with(&scene.picture, &setup.state, &[], Trail::new(0), &Scenery::of(&setup.state))?;
    let engine = Engine::choose(&args.device).await?;
    out!("{}: {count} particles, {} by {}", scene.name, course::words(&scene), scene.integrator.name);
    out!("on {}", engine.describe());
    if scene.bounds != Bounds::default() {
        out!("box: {}", scene.bounds);
    }

    if !lines.is_empty() {
        out!("\nfluid\n{}", lines.join("\n"));
    }

    let plans = setup.plans(engine.machine(count)?)?;
    let end = scene.steps as f64 * scene.dt;
    for line in motes::diagnose::forecast(&setup, end) {
        out!("{line}");
    }
    out!("\nmemory on the device");
    let mut fields = BTreeMap::new();
    for plan in plans.all() {
        for (name, bytes) in plan.fields(count) {
            let entry = fields.entry(name).or_insert(0);
            *entry = bytes.max(*entry);
        }
    }
    let wide = fields.keys().map(|name| name.chars().count()).max().unwrap_or(0).max(20);
    for (name, bytes) in &fields {
        out!("  {name:wide$} {:>12}", size(*bytes));
    }
    out!("  {:wide$} {:>12}", "in all", size(fields.values().sum()));
    out!("\na step: {} dispatches\n  {}", plans.step.dispatches(), plans.step);

    let (per_step, most) = match &engine {
        Engine::Gpu(found) => {
            let gpu = Gpu::new(&found.device, &found.queue, count)?;
            measure(Simulation::on(gpu, &setup)?, &setup, scene.steps).await?
        }
        Engine::Cpu(_) => measure(Simulation::on(Cpu::new(count)?, &setup)?, &setup, scene.steps).await?,
    };
    let total = per_step.mul_f64(scene.steps as f64);
    out!("\ntime: {} per step, about {} in all, without writing files", duration(per_step), duration(total));
    let hurry = start
        .and_then(|start| motes::diagnose::hurry(&start.medium, scene.adaptive_step.map_or(setup.dt, |_| 0.0), most));
    for remark in engine
        .remarks(&setup)?
        .into_iter()
        .chain(
            scene
                .remarks
                .clone()
                .into_iter()
                .chain(advice(&setup, Some(scene.steps as f64 * scene.dt))?.iter().map(ToString::to_string)),
        )
        .chain(hurry)
    {
        out!("note: {remark}");
    }
    out!("\nno faults");
    Ok(())
}

/// Runs some steps, for about a second at most, and gives the time of one; and the particle of the largest acceleration in the first.
async fn measure<B: Backend>(
    mut simulation: Simulation<B>,
    setup: &Setup,
    steps: u64,
) -> Result<(Duration, (usize, f64)), Failure> {
    // The first step pays for what later ones have ready.
    simulation.step(1)?;
    let held: BTreeSet<usize> = setup.state.held.iter().map(|one| one.id as usize).collect();
    let all = simulation.read(ACCELERATION).await?.into_iter().map(|a| f64::from(a.truncate().length())).enumerate();
    let most =
        all.filter(|(id, _)| !held.contains(id)).fold((0, 0.0), |most, one| if one.1 > most.1 { one } else { most });
    let (start, mut batch, mut done) = (Instant::now(), 1, 0);
    loop {
        simulation.step(batch)?;
        simulation.read(ACCELERATION).await?;
        done += u64::from(batch);
        if start.elapsed() > Duration::from_millis(300) || done >= steps.max(2) {
            return Ok((start.elapsed().div_f64(done as f64), most));
        }
        batch *= 2;
    }
}

/// Bytes, for people.
pub fn size(bytes: u64) -> String {
    match bytes {
        0..1024 => format!("{bytes} B"),
        1024..1_048_576 => format!("{:.1} KiB", bytes as f64 / 1024.0),
        1_048_576..1_073_741_824 => format!("{:.1} MiB", bytes as f64 / 1_048_576.0),
        _ => format!("{:.2} GiB", bytes as f64 / 1_073_741_824.0),
    }
}
