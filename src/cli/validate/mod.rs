//! `motes validate`: scenes with known results, run on this machine.

mod claim;
mod claims;
mod page;

use std::path::Path;
use std::time::Instant;

use motes::Error;
use serde_json::json;

use self::claim::{Claim, Verdict};
use super::args::ValidateArgs;
use super::engine::Engine;
use super::failure::Failure;
use super::words::duration;

/// Runs the claims that are asked for, and prints a table.
pub async fn validate(args: &ValidateArgs) -> Result<(), Failure> {
    if args.list {
        list(args.json);
        return Ok(());
    }
    let chosen = chosen(args)?;
    if let Some(folder) = &args.output {
        prepared(folder, args.overwrite)?;
    }
    let engine = Engine::choose(&args.device).await?;
    let begun = Instant::now();
    if !args.json {
        engine.own().iter().for_each(|remark| note!("note: {remark}"));
        out!("on {}\n", engine.describe());
    }
    let mut verdicts = Vec::new();
    for claim in chosen {
        let verdict = claim.verdict(&engine, args.controls).await;
        if !args.json {
            print(&verdict);
        }
        verdicts.push(verdict);
    }
    let bad = verdicts.iter().filter(|verdict| !verdict.good()).count();
    let value = json!({ "device": engine.describe(), "claims": verdicts.iter().map(row).collect::<Vec<_>>(), "good": bad == 0 });
    if args.json {
        out!("{value:#}");
    } else {
        let (all, time) = (verdicts.len(), duration(begun.elapsed()));
        out!("\n{} of {all} claims hold, in {time}{}", all - bad, if bad == 0 { "" } else { ": SOME DO NOT" });
    }
    if let Some(folder) = &args.output {
        written(folder, &page::text(&engine.describe(), &verdicts), &format!("{value:#}\n"))?;
    }
    if bad == 0 { Ok(()) } else { Err(Failure::Disagreement) }
}

/// The claims by name, or the short ones, or all.
fn chosen(args: &ValidateArgs) -> Result<Vec<&'static Claim>, Error> {
    for word in &args.names {
        if !claims::all().any(|claim| claim.is(word)) {
            let mut families: Vec<_> = claims::all().map(|claim| claim.family).collect();
            families.dedup();
            let names: Vec<_> = claims::all().map(|claim| claim.name).collect();
            let (families, names) = (families.join(", "), names.join(", "));
            let text =
                format!("there is no claim or family `{word}`: the families are {families}; the claims are {names}");
            return Err(Error::Scene(text));
        }
    }
    let asked = |claim: &&Claim| {
        if args.names.is_empty() { args.all || !claim.long } else { args.names.iter().any(|word| claim.is(word)) }
    };
    Ok(claims::all().filter(asked).collect())
}

fn list(as_json: bool) {
    if as_json {
        let all: Vec<_> = claims::all().map(described).collect();
        out!("{:#}", json!({ "claims": all }));
        return;
    }
    for claim in claims::all() {
        let long = if claim.long { " (with --all)" } else { "" };
        out!("{:<10} {:<16} {}{long}", claim.family, claim.name, claim.about);
    }
}

fn described(claim: &Claim) -> serde_json::Value {
    json!({ "name": claim.name, "family": claim.family, "about": claim.about, "quantity": claim.quantity,
        "published": claim.published, "source": claim.source, "tolerance": claim.tolerance, "because": claim.because, "long": claim.long })
}

fn row(verdict: &Verdict) -> serde_json::Value {
    let mut value = described(verdict.claim);
    let results = json!({ "measured": verdict.measured, "control": verdict.control, "error": verdict.error,
        "holds": verdict.claim.holds(verdict.measured), "good": verdict.good(), "seconds": verdict.time.as_secs_f64() });
    if let (Some(value), Some(results)) = (value.as_object_mut(), results.as_object()) {
        value.extend(results.clone());
    }
    value
}

fn print(verdict: &Verdict) {
    let claim = verdict.claim;
    out!("{} / {}: {}", claim.family, claim.name, claim.about);
    out!("    {}", claim.quantity);
    out!(
        "    measured {}, published {} ± {}: {} ({})",
        number(verdict.measured),
        number(claim.published),
        claim.tolerance,
        verdict.word(),
        duration(verdict.time)
    );
    if let Some(value) = verdict.control {
        out!("    control with {}: {}", claim.control.join(", "), number(value));
    }
    if let Some(error) = &verdict.error {
        out!("    {error}");
    }
    out!("    {}", claim.source);
}

/// Six decimals, or three digits of what is small.
fn number(x: f64) -> String {
    if x != 0.0 && x.abs() < 1e-3 { format!("{x:.2e}") } else { format!("{x:.6}") }
}

const FILES: [&str; 2] = ["validation.md", "validation.json"];

/// The folder, before anything is run. Earlier results in it are kept unless they may be replaced.
fn prepared(folder: &Path, overwrite: bool) -> Result<(), Error> {
    let failed = |message: String| Error::Output { file: folder.to_owned(), message };
    std::fs::create_dir_all(folder).map_err(|why| failed(why.to_string()))?;
    match FILES.iter().find(|name| !overwrite && folder.join(name).exists()) {
        Some(name) => Err(failed(format!(
            "it contains {name} of an earlier run: choose another folder, or replace it with --overwrite"
        ))),
        None => Ok(()),
    }
}

fn written(folder: &Path, page: &str, data: &str) -> Result<(), Error> {
    for (name, text) in FILES.into_iter().zip([page, data]) {
        let file = folder.join(name);
        std::fs::write(&file, text).map_err(|why| Error::Output { file: file.clone(), message: why.to_string() })?;
    }
    Ok(())
}
