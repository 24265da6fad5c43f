//! Loads the scene of the arguments, examines its stability, and divides its steps if requested.

use motes::diagnose::{Judged, Remark, culprit, limit, others, unsafe_steps};
use motes::scene::{Scene, Source};
use motes::sph::Start;
use motes::stability::Verdict;
use motes::{Error, Setup};

use super::args::SceneArgs;
use super::engine;
use super::failure::Failure;

/// A scene, ready to run.
pub struct Loaded {
    /// The scene without its particles and forces, which are in the setup. Its remarks include those on stability.
    pub scene: Scene,
    /// The setup of the simulation.
    pub setup: Setup,
    /// The stability limit by springs, if there are any.
    pub verdict: Option<Verdict>,
    /// The initial state of its fluid, if there is one, and lines about it; remarks on it are among those of the scene.
    pub start: Option<Start>,
    pub lines: Vec<String>,
}

/// Loads the scene of the arguments with additional overrides; `--auto-substeps` divides its steps so that its springs are stable.
pub async fn load(args: &SceneArgs, more: &[String]) -> Result<Loaded, Failure> {
    if !args.auto_substeps {
        return load_from(&Source::find(&args.scene)?, args, more).await;
    }
    let mut loaded = judge(engine::load_with(args, more)?).await?;
    let (dt, steps, every) = (loaded.scene.dt, loaded.scene.steps, loaded.scene.output.every);
    let parts = loaded.verdict.map_or(Some(1), |verdict| verdict.substeps(dt));
    let text = match (loaded.verdict, parts) {
        (None, _) => "--auto-substeps depends on springs, and there are none: dt is unchanged".to_owned(),
        (Some(verdict), Some(1)) => {
            format!("--auto-substeps: dt = {dt} is safe by {}{}", loaded.scene.integrator.name, limit(&verdict))
        }
        (Some(verdict), None) => {
            let name = loaded.scene.integrator.name;
            return Err(Error::Scene(format!(
                "{name} is unstable for {} at any dt: choose another integrator{}",
                culprit(&verdict, &loaded.setup),
                others(&loaded.setup, &verdict)
            ))
            .into());
        }
        (Some(verdict), Some(parts)) => {
            let all = args.overrides.iter().chain(more);
            let old: Vec<String> = all.filter(|o| !o.trim_start().starts_with("simulation.until")).cloned().collect();
            // Rust's shortest digits are read back as the same number.
            let mut new = vec![
                format!("simulation.dt={:?}", dt / parts as f64),
                format!("simulation.steps={}", steps.saturating_mul(parts)),
                format!("output.every={}", every.saturating_mul(parts)),
            ];
            for (number, one) in loaded.scene.measures.iter().enumerate() {
                let every = one.every.map(|every| every.saturating_mul(parts));
                new.extend(every.map(|every| format!("measure.{number}.every={every}")));
            }
            let divided = SceneArgs {
                scene: args.scene.clone(),
                steps: None,
                scale: args.scale,
                until: None,
                overrides: [old, new].concat(),
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

/// Loads a scene of another source with the same arguments.
pub async fn load_from(source: &Source, args: &SceneArgs, more: &[String]) -> Result<Loaded, Failure> {
    examined(engine::load_from(source, args, more)?).await
}

/// Examines a loaded scene, with a remark where its steps are too long.
pub async fn examined(scene: Scene) -> Result<Loaded, Failure> {
    Ok(judge(scene).await?.with_unsafe_steps())
}

impl Loaded {
    /// With a remark where steps are too long for its springs.
    fn with_unsafe_steps(mut self) -> Self {
        let words = self.verdict.and_then(|verdict| unsafe_steps(&verdict, &self.setup));
        self.scene.remarks.extend(words.map(|words| words.to_string()));
        self
    }
}

/// Examines a loaded scene.
pub async fn judge(mut scene: Scene) -> Result<Loaded, Failure> {
    let setup = scene.setup().in_its_box()?.into_owned();
    let Judged { verdict, start, lines, remarks } = Judged::of(&setup, scene.steps).await?;
    scene.remarks.extend(remarks.iter().map(Remark::to_string));
    Ok(Loaded { scene, setup, verdict, start, lines })
}
