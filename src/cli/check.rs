//! `motes check`

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use motes::kernel::{ACCELERATION, Backend};
use motes::render::{Picture, Scenery, Trail};
use motes::{Bounds, Cpu, Gpu, Setup, Simulation};
use serde_json::{Value, json};

use super::args::CheckArgs;
use super::course;
use super::engine::Engine;
use super::failure::Failure;
use super::load::{self, Loaded};
use super::words::duration;
use motes::diagnose::advice;

/// Checks a scene, and predicts the memory and the time of a run.
pub async fn check(args: &CheckArgs) -> Result<(), Failure> {
    let report = examined(args).await?;
    if args.json {
        out!("{:#}", report.json());
    } else {
        report.print();
    }
    Ok(())
}

/// The report on a scene before it runs.
struct Report {
    scene: String,
    particles: u32,
    course: String,
    device: String,
    bounds: Option<Bounds>,
    fluid: Vec<String>,
    forecast: Vec<String>,
    /// Bytes of each field on the device.
    fields: BTreeMap<String, u64>,
    dispatches: u64,
    step: String,
    per_step: Duration,
    steps: u64,
    notes: Vec<String>,
    pictures: Pictures,
}

/// Pictures and frames of a run.
struct Pictures {
    count: u64,
    /// The time of one by the references, and its size; the time of a device is negligible.
    each: Option<(Duration, String)>,
}

impl Report {
    fn whole(&self) -> Duration {
        self.per_step.mul_f64(self.steps as f64)
    }
    fn json(&self) -> Value {
        json!({ "scene": self.scene, "particles": self.particles, "steps": self.steps, "device": self.device,
            "box": self.bounds.map(|bounds| bounds.to_string()), "fluid": self.fluid, "forecast": self.forecast,
            "memory": self.fields, "memory_total": self.fields.values().sum::<u64>(), "dispatches": self.dispatches,
            "step": self.step, "seconds_per_step": self.per_step.as_secs_f64(), "seconds": self.whole().as_secs_f64(),
            "pictures": self.pictures.count,
            "seconds_per_picture": self.pictures.each.as_ref().map(|(each, _)| each.as_secs_f64()), "notes": self.notes })
    }
    fn print(&self) {
        out!("{}: {} particles, {}", self.scene, self.particles, self.course);
        out!("on {}", self.device);
        self.bounds.iter().for_each(|bounds| out!("box: {bounds}"));
        if !self.fluid.is_empty() {
            out!("\nfluid\n{}", self.fluid.join("\n"));
        }
        self.forecast.iter().for_each(|line| out!("{line}"));
        out!("\nmemory on the device");
        let wide = self.fields.keys().map(|name| name.chars().count()).max().unwrap_or(0).max(20);
        for (name, bytes) in &self.fields {
            out!("  {name:wide$} {:>12}", size(*bytes));
        }
        out!("  {:wide$} {:>12}", "in all", size(self.fields.values().sum()));
        out!("\na step: {} dispatches\n  {}", self.dispatches, self.step);
        let [each, whole] = [self.per_step, self.whole()].map(duration);
        let count = self.pictures.count;
        let without = if count > 0 { "files and pictures" } else { "files" };
        out!("\ntime: {each} per step, about {whole} in all, without {without}");
        if let Some((each, size)) = &self.pictures.each {
            let [each, whole] = [*each, each.mul_f64(count as f64)].map(duration);
            out!("pictures: {count} of {size}, {each} each, about {whole} in all");
        }
        self.notes.iter().for_each(|note| out!("note: {note}"));
        out!("\nno faults");
    }
}

async fn examined(args: &CheckArgs) -> Result<Report, Failure> {
    let Loaded { scene, setup, start, lines, .. } = load::load(&args.scene, &[]).await?;
    let count = setup.check()?;
    let picture = Picture::with(&scene.picture, &setup.state, &[], Trail::new(0), &Scenery::of(&setup.state))?;
    let engine = Engine::choose(&args.scene.device).await?;
    let plans = setup.plans(engine.machine(count)?)?;
    let mut fields = BTreeMap::new();
    for plan in plans.all() {
        for (name, bytes) in plan.fields(count) {
            let entry = fields.entry(name).or_insert(0);
            *entry = bytes.max(*entry);
        }
    }
    let (per_step, most) = match &engine {
        Engine::Gpu(found) => {
            let gpu = Gpu::new(&found.device, &found.queue, count)?;
            measure(Simulation::on(gpu, &setup)?, &setup, scene.steps).await?
        }
        Engine::Cpu(_) => measure(Simulation::on(Cpu::new(count)?, &setup)?, &setup, scene.steps).await?,
    };
    let drawn = if scene.output.pictures { scene.steps / scene.output.every + 1 } else { 0 };
    let mut pictures = Pictures { count: drawn + scene.output.frames, each: None };
    if let (Engine::Cpu(_), 1..) = (&engine, pictures.count) {
        let mut simulation = Simulation::on(Cpu::new(count)?, &setup)?;
        let begun = Instant::now();
        let image = simulation.draw(&picture).await?;
        pictures.each = Some((begun.elapsed(), format!("{}×{}", image.width, image.height)));
    }
    let end = scene.steps as f64 * scene.dt;
    let hurry = start
        .and_then(|start| motes::diagnose::hurry(&start.medium, scene.adaptive_step.map_or(setup.dt, |_| 0.0), most));
    let mut notes = engine.remarks(&setup)?;
    notes.extend(scene.remarks.iter().cloned());
    notes.extend(advice(&setup, Some(end))?.iter().map(ToString::to_string));
    notes.extend(hurry);
    let step = engine.runs(&plans.step);
    Ok(Report {
        particles: count,
        course: format!("{} by {}", course::words(&scene), scene.integrator.name),
        device: engine.describe(),
        bounds: Some(setup.bounds).filter(|bounds| *bounds != Bounds::default()),
        fluid: lines,
        forecast: motes::diagnose::forecast(&setup, end),
        fields,
        dispatches: step.dispatches(),
        step: step.to_string(),
        per_step,
        steps: scene.steps,
        notes,
        pictures,
        scene: scene.name,
    })
}

/// Runs some steps, for about a second at most. Returns the time of a step, and the particle with the largest acceleration in the first.
async fn measure<B: Backend>(
    mut simulation: Simulation<B>,
    setup: &Setup,
    steps: u64,
) -> Result<(Duration, (usize, f64)), Failure> {
    // The first step compiles kernels and allocates buffers.
    simulation.step(1)?;
    let fixed = setup.state.fixed();
    let all = simulation.read(ACCELERATION).await?.into_iter().map(|a| f64::from(a.truncate().length())).enumerate();
    let is_free = |id: usize| !fixed.get(id).copied().unwrap_or(false);
    let most = all.filter(|(id, _)| is_free(*id)).fold((0, 0.0), |most, one| if one.1 > most.1 { one } else { most });
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

/// A number of bytes with its unit.
pub fn size(bytes: u64) -> String {
    match bytes {
        0..1024 => format!("{bytes} B"),
        1024..1_048_576 => format!("{:.1} KiB", bytes as f64 / 1024.0),
        1_048_576..1_073_741_824 => format!("{:.1} MiB", bytes as f64 / 1_048_576.0),
        _ => format!("{:.2} GiB", bytes as f64 / 1_073_741_824.0),
    }
}
