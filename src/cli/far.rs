//! What is to be said of forces that take far groups as one.

use glam::DVec3;
use motes::forces::Over;
use motes::kernel::{Backend, Machine};
use motes::lockstep::{Truncation, truncation};
use motes::{Gpu, Setup, Simulation, gpu, visit};
use serde_json::{Value, json};

use super::args::CompareArgs;
use super::compare::load;
use super::failure::Failure;

/// A tree has 2²¹ cells along each axis of the box of all: beyond this, the middle has but a few of them.
const FAR: f64 = 3e4;
/// Targets that are compared with direct sums.
const TARGETS: usize = 1000;

/// What the laws of `over = "auto"` choose on a machine: all pairs, or a tree.
pub fn remarks(setup: &Setup, machine: Machine) -> Result<Vec<String>, Failure> {
    let problem = setup.problem(machine)?;
    let from = visit::crossing(&machine);
    let remark = |law: motes::forces::Law| match (law.over, law.chosen(&problem)) {
        (Over::Tree { auto: true, .. }, Over::Pairs) => Some(if problem.capacity < from {
            format!(
                "`{}` is summed directly over all pairs: a tree is faster from about {from} particles on here",
                law.name
            )
        } else {
            format!("`{}` is summed directly over all pairs: a tree cannot group nearest images", law.name)
        }),
        (Over::Tree { auto, opening, .. }, _) => Some(format!(
            "`{}` takes far groups as one, through a tree ({opening}{}): `motes compare` says how exact that is",
            law.name,
            if auto { format!("; faster from about {from} particles on here") } else { String::new() }
        )),
        _ => None,
    };
    let mut all: Vec<_> = setup.forces.iter().flat_map(|force| force.laws()).filter_map(remark).collect();
    let walks = setup.forces.iter().flat_map(|force| force.laws()).any(|law| law.tree(&problem).is_some());
    if let Some(ratio) = Some(spread(setup.state.position())).filter(|ratio| walks && *ratio > FAR) {
        all.push(format!(
            "a particle is {ratio:.0e} times as far out as 98 of 100 are wide: the tree cannot resolve the others, and takes as long \
             as direct summation; remove stray particles, or say over = \"pairs\""
        ));
    }
    Ok(all)
}

/// How much wider the box of all is than that of the middle 98 of 100, along the worst axis.
fn spread(places: &[DVec3]) -> f64 {
    let axis = |axis: usize| {
        let mut along: Vec<f64> = places.iter().map(|x| x[axis]).collect();
        along.sort_by(f64::total_cmp);
        let at =
            |hundredth: usize| along.get((along.len().saturating_sub(1)) * hundredth / 100).copied().unwrap_or(0.0);
        (at(100) - at(0), at(99) - at(1))
    };
    let sides = [axis(0), axis(1), axis(2)];
    let [all, middle] = [|s: &(f64, f64)| s.0, |s: &(f64, f64)| s.1].map(|of| sides.iter().map(of).fold(0.0, f64::max));
    if middle > 0.0 { all / middle } else { 1.0 }
}

/// How wrong the forces of such laws are at the start.
pub async fn errors(found: &gpu::Found, setup: &Setup) -> Result<Vec<Truncation>, Failure> {
    let gpu = Gpu::new(&found.device, &found.queue, setup.check()?)?;
    let mut simulation = Simulation::on(gpu, setup)?;
    // Where the opening is relative, the accelerations at the start decide which groups are opened.
    simulation.snapshot().await?;
    let problem = setup.problem(simulation.backend().machine())?;
    Ok(truncation(simulation.backend(), &setup.forces, &problem, TARGETS).await?)
}

/// The same for JSON.
pub fn rows(errors: &[Truncation]) -> Value {
    let three = |e: [f64; 3]| json!({ "median": e[0], "p99": e[1], "max": e[2] });
    let row = |e: &Truncation| {
        json!({ "law": e.law, "targets": e.targets, "device": three(e.device), "walk": three(e.walk),
            "rounding": three(e.rounding) })
    };
    errors.iter().map(row).collect()
}

/// The same for a terminal.
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

/// Errors over opening angles, with and without quadrupoles.
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

/// Which force of the scene is gravity.
fn gravity(args: &CompareArgs) -> Result<usize, Failure> {
    let mut scene = load(args, &[])?;
    let setup = scene.setup();
    let has = |law: motes::forces::Law| law.distant.sample.is_some();
    let found = setup.forces.iter().position(|force| force.laws().into_iter().any(has));
    found.ok_or_else(|| {
        motes::Error::Scene(format!("{} has no gravity: --theta compares what a tree makes of that", scene.name)).into()
    })
}
