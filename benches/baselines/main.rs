//! Steps of motes beside plain Rust and beside one another, in turns: gravity, trees, searches for neighbours, springs and fluids.
//!
//! `cargo bench --bench baselines -- tree --json` measures one topic; `benches/README.md` says what each number is.
#![allow(missing_docs, reason = "a program")]
#![allow(unused_imports, reason = "the tests of its files run in `tests/commands`")]

mod agents;
mod bodies;
mod cells;
mod direct;
mod effort;
mod fluids;
mod gravity;
mod met;
mod neighbors;
mod plot;
mod scaling;
mod sheet;
mod springs;
mod tree;
mod water;
#[path = "../../src/cli/words.rs"]
mod words;

use std::path::PathBuf;
use std::time::Instant;

use clap::{Parser, ValueEnum};
use motes::{Error, Gpu, Simulation, gpu};
use serde_json::json;

/// One measurement takes about this long, unless a step is longer \[s\].
const SPAN: f64 = 0.15;

/// Why a bench did not end well.
type Failure = Error;

/// What is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Topic {
    /// All pairs, and the integrators
    Gravity,
    /// Gravity through a tree, beside all pairs
    Tree,
    /// Searches for neighbours
    Neighbors,
    /// Sheets of springs
    Springs,
    /// Fluids, beside plain Rust
    Fluids,
}

/// Measures motes beside plain Rust.
#[derive(Debug, Parser)]
struct Args {
    /// What to measure; all, if it is left out
    #[arg(value_enum)]
    topic: Option<Topic>,
    /// The smallest number of bodies
    #[arg(long, value_name = "N", default_value_t = 1024)]
    from: u32,
    /// The largest number of bodies
    #[arg(long, value_name = "N", default_value_t = 1_048_576)]
    to: u32,
    /// Leave out sizes of which a step is expected to take longer than this [s]
    #[arg(long, value_name = "S", default_value_t = 10.0)]
    longest: f64,
    /// Leave out plain Rust, during which a GPU would lower its clocks
    #[arg(long)]
    no_baseline: bool,
    /// Draw how the time of a step grows into this SVG: with the bodies for `tree`, with the agents otherwise
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// How often each thing is measured; the median counts
    #[arg(long, value_name = "N", default_value_t = 7)]
    repeat: usize,
    /// An adapter, by a part of its name or by its number in `motes doctor`
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    /// What `cargo bench` says to every bench
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() -> Result<(), Error> {
    pollster::block_on(bench(&Args::parse()))
}

/// Measures what was asked for.
async fn bench(args: &Args) -> Result<(), Failure> {
    let choice = args.adapter.clone().map_or(gpu::Choice::Best, gpu::Choice::Named);
    let found = gpu::open(gpu::choose(gpu::adapters(&gpu::instance()).await, &choice)?).await?;
    let cores = rayon::current_num_threads();
    if !args.json {
        println!("{}\ncommit {}, {cores} cores, {} repeats, medians", found.describe(), commit(), args.repeat);
    }
    let mut value = json!({ "device": found.describe(), "commit": commit(), "version": env!("CARGO_PKG_VERSION"),
        "cores": cores, "repeat": args.repeat });
    for topic in [Topic::Gravity, Topic::Tree, Topic::Neighbors, Topic::Springs, Topic::Fluids] {
        if args.topic.is_none_or(|wanted| wanted == topic) {
            let part = match topic {
                Topic::Gravity => gravity::bench(args, &found).await?,
                Topic::Tree => tree::bench(args, &found)?,
                Topic::Neighbors => neighbors::bench(args, &found).await?,
                Topic::Springs => springs::bench(args, &found)?,
                Topic::Fluids => fluids::bench(args, &found)?,
            };
            if let (Some(all), serde_json::Value::Object(part)) = (value.as_object_mut(), part) {
                all.extend(part);
            }
        }
    }
    if let Some(path) = &args.plot {
        match args.topic {
            Some(Topic::Tree) => plot::tree(path, &value)?,
            _ => plot::neighbors(path, &value)?,
        }
    }
    if args.json {
        println!("{value:#}");
    }
    Ok(())
}

/// The sizes from `--from` to `--to`, each twice the last. `measure` gives the seconds that a step took; sizes of which
/// that is expected to be more than `--longest` are left out.
fn sizes<R>(
    args: &Args,
    growth: f64,
    mut measure: impl FnMut(u32, Option<&R>) -> Result<R, Failure>,
    seconds: impl Fn(&R) -> f64,
) -> Result<Vec<R>, Failure>
where
    R: std::fmt::Display,
{
    let mut rows: Vec<R> = Vec::new();
    let mut count = args.from.max(1);
    while count <= args.to {
        let expected = rows.last().map_or(0.0, |row| growth * seconds(row));
        if expected > args.longest {
            if !args.json {
                println!("{count:>9}  left out: a step is expected to take {expected:.0} s (--longest)");
            }
            break;
        }
        let row = match measure(count, rows.last()) {
            Err(Error::Limit(text) | Error::OutOfMemory(text)) if !rows.is_empty() => {
                if !args.json {
                    println!("{count:>9}  left out: {text}");
                }
                break;
            }
            other => other?,
        };
        if !args.json {
            println!("{row}");
        }
        rows.push(row);
        count = count.saturating_mul(2);
    }
    Ok(rows)
}

/// Seconds of a step of a simulation and of its baseline, where there is one. Both are warm before they count, and take
/// turns, so that what else the machine does falls on both.
fn in_turns(
    args: &Args,
    simulation: &mut Simulation<Gpu>,
    mut baseline: Option<&mut dyn FnMut(u32)>,
) -> Result<(Vec<f64>, Vec<f64>), Failure> {
    baseline = baseline.filter(|_| !args.no_baseline);
    let mut step = |turns| time(turns, || simulation.step(turns).and_then(|()| simulation.backend().wait()));
    let mut turns = [1, 1];
    let (mut device, mut plain) = (Vec::new(), Vec::new());
    for turn in 0..=args.repeat.max(1) {
        let steps = step(turns[0])?;
        let loops = match &mut baseline {
            Some(run) => time(turns[1], || {
                run(turns[1]);
                Ok(())
            })?,
            None => f64::NAN,
        };
        if turn == 0 {
            turns = [step(1)?.min(steps), loops].map(repeats);
            continue;
        }
        device.push(steps);
        if baseline.is_some() {
            plain.push(loops);
        }
    }
    Ok((device, plain))
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
fn repeats(seconds: f64) -> u32 {
    if seconds.is_finite() { (SPAN / seconds).clamp(1.0, 10_000.0) as u32 } else { 1 }
}

/// Seconds of one turn.
fn time(turns: u32, call: impl FnOnce() -> Result<(), Error>) -> Result<f64, Failure> {
    let start = Instant::now();
    call()?;
    Ok(start.elapsed().as_secs_f64() / f64::from(turns))
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The commit, as the environment or git has it.
fn commit() -> String {
    let asked = std::env::var("MOTES_COMMIT").ok();
    let git = || {
        let output = std::process::Command::new("git").args(["rev-parse", "--short=12", "HEAD"]).output().ok()?;
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    asked.or_else(git).unwrap_or_else(|| "unknown".to_owned())
}
