//! The final report of a run.

use motes::measure::{Ensemble, Estimate, Flocks, HeatCapacity};
use motes::run::{Course, End, Measured, Run};
use serde_json::{Value, json};

use super::args::{BackendChoice, DeviceArgs};
use super::failure::Failure;
use super::progress::Progress;
use super::{course, film, summary};
use motes::diagnose::Conserved;

/// Reports the end of a run.
pub fn conclude(
    run: &Run,
    end: End,
    conserved: &Conserved,
    (progress, device): (&Progress, &DeviceArgs),
) -> Result<(), Failure> {
    let took = progress.finish();
    let (scene, output, count) = (run.scene(), &run.options().output, run.count());
    if let Some(few) = run.pictures.last().map(|image| image.outside).filter(|few| *few > 0) {
        progress.say(&format!("note: {few} of {count} particles are outside of the last picture"));
    }
    let film = run.film.as_ref().map_or_else(Vec::new, |film| film::lines(film, &scene.name, output, progress));
    let rate = end.steps as f64 / end.stepping.as_secs_f64().max(1e-9);
    let rows = run.energies();
    let [first, last] = [rows.first(), rows.last()].map(|row| row.copied().unwrap_or_default());
    let worst = if first.total() == 0.0 { run.looks.change } else { run.looks.change / first.total().abs() };
    let clock = run.course.as_ref().and_then(Course::clock);
    let flock = run.series::<Flocks>().and_then(Flocks::ends);
    let heat = run.series::<HeatCapacity>().map(capacity);
    progress.event(
        "finish",
        json!({ "steps": last.step, "stopped": end.stopped, "seconds": took.as_secs_f64(),
            "stepping_seconds": end.stepping.as_secs_f64(), "steps_per_second": rate,
            "energy": last.total(), "energy_error": last.drift_from(&first), "worst_energy_error": worst,
            "adaptive": course::event(clock), "block_steps": course::levels_event(run.levels.as_ref()), "order": flock.map(|(_, last)| last.order), "heat_capacity": heat,
            "output": output }),
    );
    let say = |text: String| progress.conclude(&text);
    if end.stopped {
        let done = run.course.as_ref().map_or(0, Course::done);
        say(format!("stopped at step {done} of {}; everything up to there is written", scene.steps));
        say(format!("to go on: motes resume {}{}", output.display(), on(device)));
    }
    say(summary::speed(end.steps, count, end.stepping, took));
    clock.map(course::summary).into_iter().for_each(&say);
    run.levels.as_ref().map(course::levels).into_iter().for_each(&say);
    // The particles of a flock propel themselves: their energy is not meaningful.
    if conserved.energy || flock.is_none() {
        say(summary::energy(rows, &run.looks, conserved));
    }
    summary::momentum(rows, conserved).into_iter().for_each(&say);
    run.measures.iter().filter_map(|one| one.series.summary()).for_each(&say);
    let (whole, left) = run.springs;
    left.map(|left| summary::broken(whole, left)).into_iter().for_each(&say);
    let tables: Vec<_> = run.measures.iter().map(Measured::file).collect();
    let tables = tables.join(", ");
    let picture = if run.pictures.wanted() { format!("{}.png, ", scene.name) } else { String::new() };
    say(format!("results in {}: {picture}{tables}, energy.svg, scene.toml, {} states", output.display(), rows.len()));
    film.into_iter().for_each(&say);
    if end.stopped { Err(Failure::Stopped) } else { Ok(()) }
}

/// The heat capacity of a run, or why it has none.
fn capacity(measured: &HeatCapacity) -> Value {
    let estimate = measured.estimate();
    let (found, why) = (estimate.as_ref().ok(), estimate.as_ref().err());
    let (value, error) = (found.map(|one: &Estimate| one.value), found.and_then(|one| one.error));
    let bath = match measured.ensemble() {
        Ensemble::Energy => None,
        Ensemble::Bath(temperature) => Some(temperature),
    };
    json!({ "per_particle": value, "error": error, "states": measured.states(), "bath": bath, "none": why })
}

/// The arguments that select the same device.
fn on(device: &DeviceArgs) -> String {
    let backend = match device.backend {
        BackendChoice::Auto => "",
        BackendChoice::Gpu => " --backend gpu",
        BackendChoice::Cpu => " --backend cpu",
    };
    let adapter = device.adapter.as_ref().map_or_else(String::new, |name| format!(" --adapter {name:?}"));
    format!("{backend}{adapter}")
}
