//! `motes compare`

use std::cmp::Ordering;

use glam::DVec3;
use motes::kernel::Backend;
use motes::lockstep::{self, Verdict};
use motes::scene::Scene;
use motes::{Cpu, Energy, Gpu, Setup, Simulation, State, gpu};
use serde_json::json;

use super::args::{BackendChoice, CompareArgs, DeviceArgs, SceneArgs};
use super::engine;
use super::failure::Failure;
use super::far;

/// The maximum median of the force errors: the rounding error of one f32 is 6e-8, and those of a sum accumulate.
const MEDIAN: f64 = 1e-6;
/// The maximum difference of total energies: forces and velocities are accurate to about 1e-6.
const ENERGY: f64 = 1e-5;
/// The number of steps that are compared kernel by kernel: the first one, and some later ones.
const ROUNDS: usize = 3;

/// Compares the device with the references.
pub async fn compare(args: &CompareArgs) -> Result<(), Failure> {
    let found = engine::open(gpu::adapters(&gpu::instance()).await, args.adapter.as_deref()).await?;
    if !args.theta.is_empty() {
        return far::sweep(args, &found).await;
    }
    let mut scene = load(args, &[])?;
    let setup = scene.setup();
    let verdicts = kernels(&found, &setup).await?;
    let far = far::errors(&found, &setup).await?;
    let over = steps(&found, &setup, args.steps).await?;
    let forces: Vec<&Verdict> =
        verdicts.iter().filter(|v| v.field == "acceleration" && v.kernel != "clear" && v.good()).collect();
    // The rounding error of a weak force is that of a strong one to which it is added.
    let median = forces.iter().map(|v| v.relative[0]).reduce(f64::min).unwrap_or(0.0);
    // Where rounded inputs leave forces undetermined, the others and energies are no better.
    let determined = verdicts.iter().all(Verdict::good);
    let energy = over.energy <= ENERGY || !determined;
    let faults = [
        (!verdicts.iter().all(Verdict::sound), "a kernel is WRONG".to_owned()),
        // NaN counts as too large.
        (
            determined && median.partial_cmp(&MEDIAN).is_none_or(Ordering::is_gt),
            format!("in the median forces differ by {median:.1e}, and {MEDIAN:.0e} is allowed"),
        ),
        (
            !over.good(),
            format!("positions differ by {:.1e} (rms), and {:.1e} is allowed", over.position[0], over.allowed),
        ),
        (!energy, format!("total energies differ by {:.1e}, and {ENERGY:.0e} is allowed", over.energy)),
    ];
    let faults: Vec<String> = faults.into_iter().filter(|(is, _)| *is).map(|(_, what)| what).collect();
    let good = faults.is_empty();
    if args.json {
        let rows: Vec<_> = verdicts.iter().map(row).collect();
        let value = json!({ "scene": scene.name, "particles": setup.state.len(), "device": found.describe(),
            "tolerance": lockstep::TOLERANCE, "kernels": rows, "steps": args.steps, "position_error": over.position,
            "position_scale": over.scale, "energy_error": over.energy, "far_groups": far::rows(&far), "faults": faults, "good": good });
        out!("{value:#}");
    } else {
        out!("{}: {} particles, {} against f64 references\n", scene.name, setup.state.len(), found.describe());
        print_kernels(&verdicts);
        far::print(&far);
        out!("\n{} steps of the device against {} of the references", args.steps, args.steps);
        out!(
            "  positions differ by {:.1e} (rms) of a system of size {:.1e}, at most by {:.1e}",
            over.position[0],
            over.scale,
            over.position[1]
        );
        out!("  total energies differ by {:.1e} of the kinetic and potential ones", over.energy);
        out!("\n{}", if good { "they agree".to_owned() } else { format!("THEY DISAGREE: {}", faults.join("; ")) });
    }
    if good { Ok(()) } else { Err(Failure::Disagreement) }
}

/// The scene, with some more values set.
pub fn load(args: &CompareArgs, more: &[String]) -> Result<Scene, Failure> {
    engine::load(&SceneArgs {
        scene: args.scene.clone(),
        steps: None,
        until: None,
        scale: None,
        overrides: [args.overrides.as_slice(), more].concat(),
        allow_outside: args.allow_outside,
        auto_substeps: false,
        device: DeviceArgs { backend: BackendChoice::Gpu, adapter: args.adapter.clone() },
    })
}

/// Compares every kernel of some steps, each with the inputs that it had on the device.
async fn kernels(found: &gpu::Found, setup: &Setup) -> Result<Vec<Verdict>, Failure> {
    let count = setup.check()?;
    let mut gpu = Gpu::new(&found.device, &found.queue, count)?;
    gpu.pad(16);
    let mut simulation = Simulation::on(gpu, setup)?;
    let mut worst: Vec<Verdict> = Vec::new();
    let plan = setup.plans(simulation.backend().machine())?.step;
    for _ in 0..ROUNDS {
        simulation.step(1)?;
        let round = lockstep::compare(simulation.backend(), &plan, count).await?;
        for verdict in round {
            match worst.iter_mut().find(|w| w.kernel == verdict.kernel && w.field == verdict.field) {
                Some(known) if known.worst >= verdict.worst => known.changed |= verdict.changed,
                Some(known) => *known = Verdict { changed: known.changed | verdict.changed, ..verdict },
                None => worst.push(verdict),
            }
        }
    }
    for kernel in plan.kernels.iter().filter(|k| k.reference.is_none()) {
        note!("note: `{}` has no reference: its errors are not measured", kernel.name);
    }
    Ok(worst)
}

/// The differences between device and references after some steps.
struct Over {
    /// rms and maximum \[length\]
    position: [f64; 2],
    /// The rms distance from the centre \[length\].
    scale: f64,
    /// |E − E'| / (|K| + |W|)
    energy: f64,
    /// The maximum rms of the differences of positions.
    allowed: f64,
}

impl Over {
    fn good(&self) -> bool {
        self.position[0] <= self.allowed && self.position[1].is_finite()
    }
}

async fn steps(found: &gpu::Found, setup: &Setup, steps: u32) -> Result<Over, Failure> {
    let mut device = Simulation::new(&found.device, &found.queue, setup)?;
    let mut references = Simulation::on(Cpu::new(setup.check()?)?, setup)?;
    device.step(steps)?;
    references.step(steps)?;
    let (a, b) = (device.snapshot().await?, references.snapshot().await?);
    let (x, y) = (a.position(), b.position());
    let bounds = b.boxed(&setup.bounds);
    let errors: Vec<f64> = x.iter().zip(y).map(|(x, y)| bounds.shortest(*x - *y).length()).collect();
    let rms = |of: &[f64]| (of.iter().map(|e| e * e).sum::<f64>() / of.len().max(1) as f64).sqrt();
    let center = Energy::of(&b)?.center;
    let distances: Vec<f64> = y.iter().map(|y| y.distance(center)).collect();
    let travelled = travelled(&b, setup);
    let scale = rms(&distances).max(y.iter().map(|y| y.length()).fold(0.0, f64::max) * 1e-3);
    // In each step the error of a position grows by half a unit in the last place, and by about 1e-6 of the displacement by forces.
    let allowed = f64::from(f32::EPSILON) * rms(&y.iter().map(|y| y.length()).collect::<Vec<_>>()) * f64::from(steps)
        + 1e-5 * rms(&travelled) * f64::from(steps).sqrt();
    let (ea, eb) = (Energy::of(&a)?.total(), Energy::of(&b)?.total());
    let size = Energy::of(&b)?.kinetic + Energy::of(&b)?.potential.abs();
    let energy = if size > 0.0 { (ea - eb).abs() / size } else { 0.0 };
    Ok(Over { position: [rms(&errors), errors.iter().copied().fold(0.0, f64::max)], scale, energy, allowed })
}

fn travelled(after: &State, setup: &Setup) -> Vec<f64> {
    let before: &[DVec3] = setup.state.position();
    let bounds = after.boxed(&setup.bounds);
    after.position().iter().zip(before).map(|(x, y)| bounds.shortest(*x - *y).length()).collect()
}

fn print_kernels(verdicts: &[Verdict]) {
    let wide = verdicts.iter().map(|v| v.kernel.len()).max().unwrap_or(0).max(6);
    let long = verdicts.iter().map(|v| v.field.len()).max().unwrap_or(0).max(5);
    out!("{:wide$}  {:long$}  {:>9}  {:>9}  {:>9}  {:>9}", "kernel", "field", "median", "99 %", "max", "of limit");
    for v in verdicts {
        let verdict = match (v.good(), v.changed) {
            (false, _) if v.spilled => "WROTE BEYOND THE END",
            (false, _) if v.sound() => "ok, within the rounding of inputs",
            (false, _) => "WRONG",
            (true, false) => "unchanged",
            (true, true) => "ok",
        };
        let [median, most, max] = v.relative;
        out!(
            "{:wide$}  {:long$}  {median:9.1e}  {most:9.1e}  {max:9.1e}  {:9.3}  {verdict}",
            v.kernel,
            v.field,
            v.worst
        );
    }
    out!(
        "\nmedian, 99 % and max are |device − reference| / |change|, per particle. The limit is {:.0e} of the change (or of its\n\
         rms, where that is more) plus 2 units in the last place; the last column is the largest error as a part of it.",
        lockstep::TOLERANCE
    );
}

fn row(v: &Verdict) -> serde_json::Value {
    json!({ "kernel": v.kernel, "field": v.field, "median": v.relative[0], "p99": v.relative[1], "max": v.relative[2],
        "of_limit": v.worst, "element": v.element, "changed": v.changed, "of_limit_conditioned": v.conditioned, "good": v.sound() })
}
