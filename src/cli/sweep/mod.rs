//! `motes sweep`: runs of a scene for all combinations of some values.

mod outcome;
mod picture;
mod runs;
mod table;
mod vary;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Instant;

use motes::Error;
use serde_json::json;

use super::args::{SceneArgs, SweepArgs};
use super::failure::Failure;
use super::{load, stop};
use outcome::Ended;
use vary::Varied;

/// The maximum number of runs.
const MOST: usize = 10_000;
/// Overrides with which a run writes tables only.
const NO_FILES: [&str; 2] = ["output.formats=[]", "output.frames=0"];

/// Runs a scene with all combinations of values.
pub async fn sweep(args: &SweepArgs) -> Result<(), Failure> {
    let varied = args.vary.iter().map(|text| Varied::parse(text)).collect::<Result<Vec<_>, _>>()?;
    vary::check(&varied)?;
    settled(args, &varied)?;
    let count = varied.iter().fold(1_usize, |count, one| count.saturating_mul(one.values.len()));
    if count > MOST {
        let text = format!("{count} combinations exceed the maximum of {MOST}: give fewer values");
        return Err(Error::Scene(text).into());
    }
    let (args, cases) = (&plain(args), vary::combinations(&varied));
    // All scenes are checked before the first one runs.
    let (mut name, mut remarks) = (String::new(), BTreeSet::new());
    for case in &cases {
        let scene = load::load(&args.scene, case).await?.scene;
        remarks.extend(scene.remarks.iter().map(|remark| format!("{}: {remark}", case.join(" "))));
        name = scene.name;
    }
    let output = args.output.clone().unwrap_or_else(|| PathBuf::from("out").join(format!("{name}_sweep")));
    let engines = runs::Engines::open(args).await?;
    let (csv, svg) = files(&output, args.overwrite)?;
    remarks.extend(engines.remarks());
    remarks.iter().for_each(|remark| args.said(&format!("note: {remark}")));
    let (stop, begun) = (stop::listen(&args.stop), Instant::now());
    let found = runs::all(args, &cases, &engines, &output, &stop);
    let ended: Vec<Ended<'_>> = outcome::compared(&cases, &found);
    table::write(&csv, &varied, &ended)?;
    let drawn = picture::draw(&svg, &name, &varied, &ended)?;
    let order = outcome::order(&varied, &ended);
    if !outcome::end_together(&found) {
        args.said("the runs end at different times, and final states are compared only at the same time: give --until");
    }
    if args.show.json {
        let rows: Vec<_> = ended.iter().map(|one| one.json(&varied)).collect();
        let value = json!({ "scene": name, "device": engines.names(), "runs": rows, "order": order, "output": output,
            "seconds": begun.elapsed().as_secs_f64() });
        out!("{value:#}");
    } else if !args.show.quiet {
        out!("\n{}", table::text(&varied, &ended));
        order.into_iter().for_each(|order| out!("estimated order of convergence: {order:.2}"));
        out!("{}{}", csv.display(), if drawn { format!(", {}", svg.display()) } else { String::new() });
    }
    if stop.is_asked() {
        return Err(Failure::Stopped);
    }
    // If no run has finished, the first failure is that of the sweep.
    if ended.iter().any(|one| one.error.is_none()) {
        return Ok(());
    }
    args.said("no run finished; the first failed with:");
    found.into_iter().flatten().find_map(outcome::Outcome::failure).map_or(Ok(()), Err)
}

/// Refuses to vary a key that another argument sets.
fn settled(args: &SweepArgs, varied: &[Varied]) -> Result<(), Error> {
    let set = [("simulation.until", args.scene.until.is_some()), ("simulation.steps", args.scene.steps.is_some())];
    let length = ["simulation.until", "simulation.steps"];
    let clash = varied.iter().find(|one| {
        set.iter().any(|(key, is_set)| *is_set && length.contains(&one.key.as_str()) && length.contains(key))
    });
    clash.map_or(Ok(()), |one| {
        Err(Error::Scene(format!(
            "{} is varied, and --until or --steps sets how long all runs are: leave one of them out",
            one.key
        )))
    })
}

/// The files of table and plot. Those of an earlier sweep are removed only if requested.
fn files(output: &Path, overwrite: bool) -> Result<(PathBuf, PathBuf), Error> {
    let failed = |file: &Path, message: String| Error::Output { file: file.to_owned(), message };
    std::fs::create_dir_all(output).map_err(|why| failed(output, why.to_string()))?;
    let [csv, svg] = ["sweep.csv", "sweep.svg"].map(|name| output.join(name));
    if csv.exists() && !overwrite {
        return Err(failed(
            output,
            "the folder contains an earlier sweep: choose another with -o, or replace it with --overwrite".to_owned(),
        ));
    }
    for file in [&csv, &svg].into_iter().filter(|file| file.exists()) {
        std::fs::remove_file(file).map_err(|why| failed(file, why.to_string()))?;
    }
    Ok((csv, svg))
}

/// The same overrides without pictures and snapshots, unless the arguments set them.
fn plain(args: &SweepArgs) -> SweepArgs {
    let set = |key: &str| args.scene.overrides.iter().chain(&args.vary).any(|set| set.trim_start().starts_with(key));
    let asked = set("output.formats") || set("output.frames");
    let none = NO_FILES.iter().filter(|_| !asked).map(|set| (*set).to_owned());
    let overrides = args.scene.overrides.iter().cloned().chain(none).collect();
    SweepArgs { scene: SceneArgs { overrides, ..args.scene.clone() }, ..args.clone() }
}

impl SweepArgs {
    /// Reports its progress.
    fn said(&self, text: &str) {
        if !self.show.json && !self.show.quiet {
            note!("{text}");
        }
    }
}
