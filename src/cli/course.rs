//! The length of a run, as text.

use motes::kernel::Reason;
use motes::scene::Scene;
use motes::settings::plain;
use motes::simulation::{Clock, Levels};
use serde_json::{Value, json};

/// The number and the length of steps, such as `1000 steps of 0.001`.
pub fn words(scene: &Scene) -> String {
    if let Some(adaptive_step) = scene.adaptive_step {
        return format!(
            "{} of time in steps of {} to {}",
            plain(scene.until),
            plain(adaptive_step.least),
            plain(scene.dt)
        );
    }
    let blocks = scene.block_steps.map(|blocks| format!(", in block steps down to dt / {}", blocks.whole()));
    format!("{} of {}{}", steps(scene.steps), plain(scene.dt), blocks.unwrap_or_default())
}

/// `1 step`, `2 steps`.
pub fn steps(count: u64) -> String {
    if count == 1 { "1 step".to_owned() } else { format!("{count} steps") }
}

/// The lengths of adaptive steps, and their limiting criteria.
pub fn summary(clock: &Clock) -> String {
    let [shortest, longest] = clock.between;
    let all = clock.steps.max(1) as f64;
    let some = |(reason, n): (&Reason, &u32)| {
        (*n > 0).then(|| format!("{} {:.1} %", reason.name(), 100.0 * f64::from(*n) / all))
    };
    let reasons: Vec<_> = Reason::ALL.iter().zip(&clock.reasons).filter_map(some).collect();
    format!(
        "adaptive steps: {} from {shortest:.3e} to {longest:.3e}, {:.3e} in the mean; limited by {}; to go on from \
             here, set dt_before = {:.4e}",
        clock.steps,
        clock.mean(),
        reasons.join(", "),
        clock.free
    )
}

/// The work of block time steps, and their levels at the end.
pub fn levels(levels: &Levels) -> String {
    let some = |(level, count): (usize, &u64)| (*count > 0).then(|| format!("{count} of dt / {}", 1_u64 << level));
    let all: Vec<_> = levels.particles.iter().enumerate().filter_map(some).collect();
    format!(
        "block steps: {} substeps, {:.1} % of the evaluations of all particles in each; steps at the end: {}",
        levels.parts,
        100.0 * levels.work(),
        all.join(", ")
    )
}

/// The same as JSON.
pub fn levels_event(levels: Option<&Levels>) -> Value {
    levels.map_or(Value::Null, |levels| {
        json!({ "substeps": levels.parts, "evaluations": levels.evaluations, "work": levels.work(), "particles": levels.particles })
    })
}

/// The steps of a clock as JSON.
pub fn event(clock: Option<&Clock>) -> Value {
    clock.map_or(Value::Null, |clock| {
        let reasons: serde_json::Map<_, _> =
            Reason::ALL.iter().zip(&clock.reasons).map(|(reason, n)| (reason.name().to_owned(), json!(n))).collect();
        json!({ "steps": clock.steps, "shortest": clock.between[0], "longest": clock.between[1], "mean": clock.mean(),
            "reasons": reasons, "next": clock.free })
    })
}
