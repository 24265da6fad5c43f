//! Steps that springs bear: a warning before a run, and the division of steps that are too long.

use motes::integrators::{Entry, INTEGRATORS};
use motes::scene::Scene;
use motes::sph::Start;
use motes::stability::{Flow, Verdict};
use motes::{Error, Setup};

use super::args::SceneArgs;
use super::engine;
use super::failure::Failure;
use super::{flow, fluid};

/// A scene, ready to run.
pub struct Loaded {
    /// Without its particles and forces, which are in the setup. Its remarks tell what its steps are to its springs.
    pub scene: Scene,
    /// What the simulation is made of.
    pub setup: Setup,
    /// What springs ask of its steps, if there are any.
    pub verdict: Option<Verdict>,
    /// How its fluid starts, if there is one, and the lines that tell of it; what is to be noted is among the scene's remarks.
    pub start: Option<Start>,
    pub lines: Vec<String>,
}

/// Loads the scene of the arguments, with more values set; with `--auto-substeps` in steps that its springs bear.
pub async fn load(args: &SceneArgs, more: &[String]) -> Result<Loaded, Failure> {
    let mut loaded = judge(engine::load_with(args, more)?).await?;
    let (dt, steps, every) = (loaded.scene.dt, loaded.scene.steps, loaded.scene.output.every);
    let parts = loaded.verdict.map_or(Some(1), |verdict| verdict.substeps(dt));
    if !args.auto_substeps {
        let words = loaded.verdict.and_then(|verdict| warning(&verdict, &loaded));
        loaded.scene.remarks.extend(words);
        return Ok(loaded);
    }
    let text = match (loaded.verdict, parts) {
        (None, _) => "--auto-substeps goes by springs, and there are none: steps stay as they are".to_owned(),
        (Some(verdict), Some(1)) => {
            format!("--auto-substeps: dt = {dt} is safe by {}{}", loaded.scene.integrator.name, limit(&verdict))
        }
        (Some(verdict), None) => {
            let name = loaded.scene.integrator.name;
            return Err(Error::Scene(format!(
                "no dt makes {name} safe for {}: choose another integrator{}",
                culprit(&verdict, &loaded.setup),
                others(&loaded.scene, &verdict)
            ))
            .into());
        }
        (Some(verdict), Some(parts)) => {
            let all = args.overrides.iter().chain(more);
            let old: Vec<String> = all.filter(|o| !o.trim_start().starts_with("simulation.until")).cloned().collect();
            // Rust's shortest digits are read back as the same number.
            let new = [
                format!("simulation.dt={:?}", dt / parts as f64),
                format!("simulation.steps={}", steps.saturating_mul(parts)),
                format!("output.every={}", every.saturating_mul(parts)),
            ];
            let divided = SceneArgs {
                scene: args.scene.clone(),
                steps: None,
                until: None,
                overrides: [old, new.to_vec()].concat(),
                allow_outside: args.allow_outside,
                auto_substeps: true,
                device: args.device.clone(),
            };
            let text = format!(
                "--auto-substeps: {parts} steps of {:e} in place of one of {dt}, because of {}{}",
                dt / parts as f64,
                culprit(&verdict, &loaded.setup),
                limit(&verdict)
            );
            loaded = judge(engine::load_with(&divided, &[])?).await?;
            text
        }
    };
    loaded.scene.remarks.push(text);
    Ok(loaded)
}

/// The same of a scene that is loaded.
pub async fn judge(mut scene: Scene) -> Result<Loaded, Failure> {
    let setup = scene.setup();
    let (start, mut lines) = (setup.start()?, Vec::new());
    if let Some(start) = &start {
        let (said, notes) = fluid::remarks(&setup, start)?;
        lines = said;
        scene.remarks.extend(notes);
    }
    if let Some(flow) = Flow::of(&setup, &|| scene.integrator()).await? {
        lines.extend(flow::line(&flow, setup.dt));
        scene.remarks.extend(flow::warning(&flow, &scene)?);
    }
    let verdict = Verdict::of(&setup, &|| scene.integrator(), scene.steps).await?;
    Ok(Loaded { scene, setup, verdict, start, lines })
}

/// The spring that asks for the shortest step.
fn culprit(verdict: &Verdict, setup: &Setup) -> String {
    if !verdict.by_damping && verdict.joints > verdict.bound.stiffness.sum {
        return format!("the bending stiffness of the joints (ω² up to {:.1e})", verdict.joints);
    }
    let row = if verdict.by_damping { verdict.bound.damping } else { verdict.bound.stiffness };
    let what = if verdict.by_damping { "damping" } else { "stiffness" };
    match setup.state.links.springs.get(row.spring) {
        Some(spring) => {
            let ([a, b], k, c) = (spring.ends, spring.stiffness, spring.damping);
            format!(
                "the {what} of the springs at particle {}, most of all of spring {a}–{b} (stiffness {k}, damping {c})",
                row.particle
            )
        }
        None => format!("the {what} of the springs"),
    }
}

/// The largest safe dt, after a comma.
fn limit(verdict: &Verdict) -> String {
    if verdict.safe.is_infinite() {
        ", which bears any".to_owned()
    } else {
        format!(", which bears up to dt = {}", digits(verdict.safe))
    }
}

/// Three digits, rounded down: what is safe stays safe.
pub fn digits(x: f64) -> String {
    let scale = 10f64.powf(2.0 - x.abs().log10().floor());
    let down = if x > 0.0 { (x * scale).floor() / scale } else { x };
    if down == 0.0 || (1e-3..1e5).contains(&down) {
        format!("{}", (down * 1e9).round() / 1e9)
    } else {
        format!("{down:.2e}")
    }
}

/// What is wrong with the steps of a scene, and the way out; nothing where they are safe.
fn warning(verdict: &Verdict, loaded: &Loaded) -> Option<String> {
    let sure = if loaded.scene.dt > verdict.lost { "will explode" } else { "may explode" };
    Some(format!("this run {sure}: {}", way_out(verdict, &loaded.scene, &loaded.setup)?))
}

/// Why steps are too long for springs, and what to do; nothing where they are safe.
pub fn way_out(verdict: &Verdict, scene: &Scene, setup: &Setup) -> Option<String> {
    let (dt, name) = (scene.dt, scene.integrator.name);
    let way = match verdict.substeps(dt) {
        Some(1) => return None,
        Some(parts) => format!(
            "the largest dt that is safe is {}: set it, or --auto-substeps ({parts} steps for each)",
            digits(verdict.safe)
        ),
        None => "no dt is safe: choose another integrator".to_owned(),
    };
    let spring = culprit(verdict, setup);
    Some(format!("dt = {dt} is too long for {name} and {spring}; {way}{}", others(scene, verdict)))
}

/// Integrators that bear any step, after a comma.
fn others(scene: &Scene, verdict: &Verdict) -> String {
    // Joints stay explicit under all of them.
    if verdict.joints > 0.0 {
        return String::new();
    }
    let bears = |entry: &&Entry| entry.by_default().damps_at_any_step() && entry.name != scene.integrator.name;
    let names: Vec<_> = INTEGRATORS.iter().filter(bears).map(|entry| entry.name).collect();
    if names.is_empty() { String::new() } else { format!(", or take {}, which bears any dt", names.join(" or ")) }
}
