//! `motes bench kernels`: each kernel of one step of a scene.

use motes::gpu::Found;
use motes::kernel::{Backend, Cost};
use motes::scene::{Options, Scene, Source};
use motes::{Gpu, Simulation};
use serde_json::{Value, json};

use super::super::args::BenchArgs;
use super::super::failure::Failure;
use super::spirv;
use super::{MOST, Rerun, median, times};

/// Measures each kernel of the arguments' scene.
pub async fn kernels(args: &BenchArgs, found: &Found) -> Result<Value, Failure> {
    let word = args.scene.as_deref().unwrap_or_default();
    let setup = Scene::load(&Source::find(word)?, &args.overrides, &Options::default())?.setup();
    let count = setup.state.len();
    let mut simulation = Simulation::new(&found.device, &found.queue, &setup)?;
    let mut rerun = Rerun::of(&mut simulation).await?;
    let steps = times(&mut simulation, &mut rerun, args.repeat.max(1))?;
    rerun.prepare(&mut simulation, MOST)?;
    let (rounds, whole) = rounds(args, &mut simulation).await?;
    let limit = simulation.backend().machine().workgroups;
    let (plan, rows) = simulation.step_plan();
    let plan = plan.fused();
    let mut kernels = Vec::new();
    for cost in plan.costs(rows, limit)? {
        let name = plan.name(&cost).to_owned();
        let seconds =
            rounds.as_ref().map(|rounds| median(&rounds.iter().map(|round| own(round, &cost)).collect::<Vec<_>>()));
        let passes = cost.kernel.and_then(|place| plan.kernels.get(place)).map_or(&[][..], |kernel| &kernel.passes);
        let spirv: Vec<_> = passes.iter().filter_map(spirv::instructions).collect();
        kernels.push(json!({ "kernel": name, "dispatches": cost.most * cost.dispatches, "least_dispatches": cost.least * cost.dispatches,
            "workgroups": cost.least * cost.workgroups, "bytes": cost.least * cost.bytes, "work": cost.least * cost.work,
            "spirv_instructions": spirv.iter().map(|its| its.all).max(),
            "spirv_instructions_per_iteration": spirv.iter().map(|its| its.iteration).max().filter(|its| *its > 0),
            "device_seconds": seconds }));
    }
    let sum = rounds
        .as_ref()
        .map(|rounds| median(&rounds.iter().map(|round| round.iter().map(|its| its.1).sum()).collect::<Vec<_>>()));
    if !args.json {
        table(&kernels, sum, whole, median(&steps));
    }
    Ok(
        json!({ "topic": "kernels", "scene": word, "changes": args.overrides, "particles": count, "seconds_per_step": steps,
        "device_seconds_of_kernels": sum, "device_seconds_of_step": whole, "kernels": kernels }),
    )
}

/// Seconds of every dispatch of a step, in several steps, and of whole steps in one pass.
async fn rounds(
    args: &BenchArgs,
    simulation: &mut Simulation<Gpu>,
) -> Result<(Option<Vec<Vec<(Option<usize>, f64)>>>, Option<f64>), Failure> {
    let (mut rounds, mut whole) = (Vec::new(), Vec::new());
    for _ in 0..args.repeat.max(1) {
        let Some(round) = simulation.timed_step().await? else { return Ok((None, None)) };
        rounds.push(round);
        whole.extend(simulation.timed_whole().await?);
    }
    Ok((Some(rounds), Some(median(&whole))))
}

/// Seconds of a kernel in a round.
fn own(round: &[(Option<usize>, f64)], cost: &Cost) -> f64 {
    round.iter().filter(|(kernel, _)| *kernel == cost.kernel).map(|(_, seconds)| seconds).sum()
}

fn table(kernels: &[Value], sum: Option<f64>, whole: Option<f64>, step: f64) {
    out!(
        "{:>32}  {:>10}  {:>10}  {:>12}  {:>7}  {:>9}",
        "kernel",
        "dispatches",
        "workgroups",
        "bytes",
        "SPIR-V",
        "device µs"
    );
    let micro = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |seconds| format!("{:.1}", 1e6 * seconds));
    let number = |value: &Value| value.as_u64().map_or_else(|| "-".to_owned(), |n| n.to_string());
    for its in kernels {
        let name: String = its["kernel"].as_str().unwrap_or_default().chars().take(32).collect();
        let [dispatches, workgroups, bytes, instructions] =
            ["dispatches", "workgroups", "bytes", "spirv_instructions"].map(|key| number(&its[key]));
        let time = micro(its["device_seconds"].as_f64());
        out!("{name:>32}  {dispatches:>10}  {workgroups:>10}  {bytes:>12}  {instructions:>7}  {time:>9}");
    }
    out!(
        "\nkernels one after another {} µs, a step in one pass {} µs by the device's clock; {} µs by the host's",
        micro(sum),
        micro(whole),
        micro(Some(step))
    );
}
