//! Errors of tree forces against direct summation.

use motes::kernel::Backend;
use motes::lockstep::{Truncation, truncation};
use motes::{Gpu, Setup, Simulation, gpu};
use serde_json::{Value, json};

use super::args::CompareArgs;
use super::compare::load;
use super::failure::Failure;

/// The number of particles at which forces are compared with direct summation.
const TARGETS: usize = 1000;

/// Errors of the tree forces of a scene in its initial state.
pub async fn errors(found: &gpu::Found, setup: &Setup) -> Result<Vec<Truncation>, Failure> {
    let gpu = Gpu::new(&found.device, &found.queue, setup.check()?)?;
    let mut simulation = Simulation::on(gpu, setup)?;
    // The relative opening criterion depends on the initial accelerations.
    simulation.snapshot().await?;
    let problem = setup.problem(simulation.backend().machine())?;
    Ok(truncation(simulation.backend(), &setup.forces, &problem, TARGETS).await?)
}

/// The same as JSON.
pub fn rows(errors: &[Truncation]) -> Value {
    let three = |e: [f64; 3]| json!({ "median": e[0], "p99": e[1], "max": e[2] });
    let row = |e: &Truncation| {
        json!({ "law": e.law, "targets": e.targets, "device": three(e.device), "walk": three(e.walk),
            "rounding": three(e.rounding) })
    };
    errors.iter().map(row).collect()
}

/// The same as text.
pub fn print(errors: &[Truncation]) {
    for e in errors {
        out!("\n{}: {} targets against direct summation in f64: |a − a′| / |a′|", e.law, e.targets);
        out!("  {:24}  {:>9}  {:>9}  {:>9}", "", "median", "99 %", "max");
        for (what, [median, most, max]) in
            [("the device", e.device), ("the same walk in f64", e.walk), ("device against that walk", e.rounding)]
        {
            out!("  {what:24}  {median:9.1e}  {most:9.1e}  {max:9.1e}");
        }
    }
}

/// Errors for several opening angles, with and without quadrupoles.
pub async fn sweep(args: &CompareArgs, found: &gpu::Found) -> Result<(), Failure> {
    let mut rows = Vec::new();
    let mut header = !args.json;
    for theta in &args.theta {
        let mut line = Vec::new();
        for multipoles in ["monopole", "quadrupole"] {
            let gravity = gravity(args)?;
            let set = |key: &str, value: &str| format!("force.{gravity}.{key}={value}");
            let more = [set("over", "tree"), set("theta", &format!("{theta:?}")), set("multipoles", multipoles)];
            let mut scene = load(args, &more)?;
            let setup = scene.setup();
            if header {
                out!(
                    "{}: {} particles, {}, {TARGETS} targets against direct summation in f64\n",
                    scene.name,
                    setup.state.len(),
                    found.describe()
                );
                out!(
                    "| θ | monopole: median | 99 % | max | quadrupole: median | 99 % | max |\n|---|---|---|---|---|---|---|"
                );
                header = false;
            }
            let errors = errors(found, &setup).await?;
            let device = errors.first().map_or([f64::NAN; 3], |e| e.device);
            line.extend(device.map(|x| format!("{x:.1e}")));
            rows.push(json!({ "theta": theta, "multipoles": multipoles, "errors": self::rows(&errors) }));
        }
        if !args.json {
            out!("| {theta} | {} |", line.join(" | "));
        }
    }
    if args.json {
        out!("{:#}", json!({ "scene": args.scene, "device": found.describe(), "rows": rows }));
    }
    Ok(())
}

/// The index of the first force of gravity in the scene.
fn gravity(args: &CompareArgs) -> Result<usize, Failure> {
    let mut scene = load(args, &[])?;
    let setup = scene.setup();
    let has = |law: motes::forces::Law| law.distant.sample.is_some();
    let found = setup.forces.iter().position(|force| force.laws().into_iter().any(has));
    found.ok_or_else(|| {
        motes::Error::Scene(format!(
            "{} has no gravity: --theta compares the tree's gravity with direct summation",
            scene.name
        ))
        .into()
    })
}
