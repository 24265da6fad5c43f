//! `motes explain`

use std::fmt::Write as _;

use motes::Bounds;
use motes::kernel::{Access, Kernel};
use serde_json::{Value, json};

use super::args::{ExplainArgs, SceneArgs};
use super::course;
use super::engine::Engine;
use super::failure::Failure;
use super::load::{self, Loaded};

/// The documentation of what a law may define, use and bind.
const LAW: &str = include_str!("../../docs/pages/reference/law.md");

/// Prints the plan of a step, and what each kernel reads and writes; or the language of a user's law.
pub async fn explain(args: &ExplainArgs) -> Result<(), Failure> {
    let Some(scene) = args.scene.clone().filter(|_| !args.law) else {
        if args.json {
            out!("{:#}", json!({ "law": LAW }));
        } else {
            out!("{}", LAW.trim_end());
        }
        return Ok(());
    };
    let args_of_scene = SceneArgs {
        scene,
        steps: None,
        until: None,
        overrides: args.overrides.clone(),
        scale: args.scale,
        allow_outside: args.allow_outside,
        auto_substeps: false,
        device: args.device.clone(),
    };
    let Loaded { scene, setup, .. } = load::load(&args_of_scene, &[]).await?;
    let count = setup.check()?;
    let engine = Engine::choose(&args.device).await?;
    let plans = setup.plans(engine.machine(count)?)?;
    let step = engine.runs(&plans.step);
    // Some kernels run more than once.
    let mut described: Vec<&Kernel> = Vec::new();
    for kernel in plans.step.steps() {
        if !described.iter().any(|known| std::ptr::eq(*known, kernel)) {
            described.push(kernel);
        }
    }
    if args.json {
        let kernels: Vec<Value> = described.iter().map(|kernel| as_json(kernel)).collect();
        out!(
            "{:#}",
            json!({ "scene": scene.name, "particles": count, "integrator": scene.integrator.name, "device": engine.describe(),
                "once": plans.start.to_string(), "step": step.to_string(), "dispatches": step.dispatches(),
                "kernels": kernels })
        );
        return Ok(());
    }
    out!("{}: {count} particles, {} by {}", scene.name, course::words(&scene), scene.integrator.name);
    out!("on {}", engine.describe());
    if scene.bounds != Bounds::default() {
        out!("box: {}", scene.bounds);
    }
    out!("");
    if !plans.start.is_empty() {
        out!("once:  {}", plans.start);
    }
    out!("step:  {step}");
    let fused = step.dispatches() < plans.step.dispatches();
    out!("{}", if fused { "       kernels with ` + ` between them are one dispatch\n" } else { "" });
    described.iter().for_each(|kernel| out!("{}", describe(kernel)));
    Ok(())
}

/// The names of the buffers that a kernel reads, or writes, each once.
fn bound(kernel: &Kernel, access: Access) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for (field, _) in kernel.bindings().filter(|(_, b)| b.access == access) {
        if !names.contains(&field) {
            names.push(field);
        }
    }
    names
}

/// The files of its shaders.
fn files(kernel: &Kernel) -> Vec<&str> {
    let sources = kernel.passes.first().into_iter().flat_map(|pass| pass.shader.sources());
    sources.map(|source| source.file.as_ref()).filter(|file| *file != "shaders/world.wgsl").collect()
}

/// The number of its invocations.
fn threads(kernel: &Kernel) -> u64 {
    kernel.passes.iter().map(|p| u64::from(p.threads.count) * u64::from(p.threads.layers)).sum()
}

fn as_json(kernel: &Kernel) -> Value {
    json!({ "name": kernel.name, "files": files(kernel), "reads": bound(kernel, Access::Read),
        "writes": bound(kernel, Access::Write), "dispatches": kernel.passes.len(), "invocations": threads(kernel) })
}

fn describe(kernel: &Kernel) -> String {
    let mut text = format!("{}\n    from    {}", kernel.name, files(kernel).join(" + "));
    for (what, access) in [("reads", Access::Read), ("writes", Access::Write)] {
        let names = bound(kernel, access).join(", ");
        if !names.is_empty() {
            let _ = write!(text, "\n    {what:7} {names}");
        }
    }
    let dispatches = kernel.passes.len();
    let threads = threads(kernel);
    let plural = if dispatches == 1 { "dispatch" } else { "dispatches" };
    let invocations = if threads == 1 { "1 invocation".to_owned() } else { format!("{threads} invocations") };
    let _ = write!(text, "\n    in      {dispatches} {plural} of {invocations} in all");
    text
}
