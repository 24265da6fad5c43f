//! `motes explain`

use std::fmt::Write as _;

use motes::Bounds;
use motes::kernel::{Access, Kernel};

use super::args::SceneArgs;
use super::course;
use super::engine::Engine;
use super::failure::Failure;
use super::load::{self, Loaded};

/// Prints the plan of a step, and what each kernel reads and writes.
pub async fn explain(args: &SceneArgs) -> Result<(), Failure> {
    let Loaded { scene, setup, .. } = load::load(args, &[]).await?;
    let count = setup.check()?;
    let engine = Engine::choose(&args.device).await?;
    let plans = setup.plans(engine.machine(count)?)?;
    out!("{}: {count} particles, {} by {}", scene.name, course::words(&scene), scene.integrator.name);
    out!("on {}", engine.describe());
    if scene.bounds != Bounds::default() {
        out!("box: {}", scene.bounds);
    }
    out!("");
    if !plans.start.is_empty() {
        out!("once:  {}", plans.start);
    }
    out!("step:  {}\n", plans.step);
    // Some kernels run more than once.
    let mut described: Vec<*const Kernel> = Vec::new();
    for kernel in plans.step.steps() {
        if !described.contains(&std::ptr::from_ref(kernel)) {
            described.push(kernel);
            out!("{}", describe(kernel));
        }
    }
    Ok(())
}

fn describe(kernel: &Kernel) -> String {
    let name = |access: Access| {
        let mut names: Vec<&str> = Vec::new();
        for (field, _) in kernel.bindings().filter(|(_, b)| b.access == access) {
            if !names.contains(&field) {
                names.push(field);
            }
        }
        names.join(", ")
    };
    let files = kernel.passes.first().map(|pass| {
        let files = pass.shader.sources().iter().map(|s| s.file.as_ref());
        files.filter(|f| !f.ends_with("world.wgsl")).collect::<Vec<_>>().join(" + ")
    });
    let mut text = format!("{}\n    from    {}", kernel.name, files.unwrap_or_default());
    for (what, names) in [("reads", name(Access::Read)), ("writes", name(Access::Write))] {
        if !names.is_empty() {
            let _ = write!(text, "\n    {what:7} {names}");
        }
    }
    let dispatches = kernel.passes.len();
    let threads: u64 = kernel.passes.iter().map(|p| u64::from(p.threads.count) * u64::from(p.threads.layers)).sum();
    let plural = if dispatches == 1 { "dispatch" } else { "dispatches" };
    let invocations = if threads == 1 { "1 invocation".to_owned() } else { format!("{threads} invocations") };
    let _ = write!(text, "\n    in      {dispatches} {plural} of {invocations} in all");
    text
}
