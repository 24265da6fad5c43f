//! `motes doctor`

use motes::gpu::{self, Found};
use motes::selftest::{self, Finding, Outcome};
use serde_json::json;

use super::args::DoctorArgs;
use super::engine;
use super::failure::Failure;

/// Lists adapters, and tests them.
pub async fn doctor(args: &DoctorArgs) -> Result<(), Failure> {
    let instance = gpu::instance();
    let count = gpu::adapters(&instance).await.len();
    let mut reports = Vec::new();
    let mut failed = false;
    if !args.json {
        out!("motes {}, {} {}\n", env!("CARGO_PKG_VERSION"), std::env::consts::OS, std::env::consts::ARCH);
    }
    let wanted: Vec<String> = match &args.adapter {
        Some(name) => vec![name.clone()],
        None => (0..count).map(|i| i.to_string()).collect(),
    };
    for name in wanted {
        let found = match engine::open(gpu::adapters(&instance).await, Some(&name)).await {
            Ok(found) => found,
            Err(error) if args.adapter.is_some() => return Err(error.into()),
            Err(error) => {
                note!("{name}: {error}");
                failed = true;
                continue;
            }
        };
        if let Some(note) = found.substitute() {
            note!("note: {note}");
        }
        let findings = selftest::run(&found.device, &found.queue).await?;
        failed |= findings.iter().any(|f| f.outcome == Outcome::Fail);
        if args.json {
            reports.push(report(&found, &findings));
        } else {
            print(&name, &found, &findings);
        }
    }
    if args.json {
        out!("{:#}", json!({ "version": env!("CARGO_PKG_VERSION"), "adapters": reports }));
    } else if count == 0 {
        out!("{}\n\n`motes run` works without one, by the f64 references on the processor.", gpu::NO_DRIVER);
    } else {
        out!("`motes run` takes adapter 0 unless --adapter names another.");
    }
    if failed { Err(Failure::Disagreement) } else { Ok(()) }
}

fn print(name: &str, found: &Found, findings: &[Finding]) {
    out!("{name}: {}", found.describe());
    for (fact, value) in found.facts() {
        out!("   {fact:17} {value}");
    }
    for finding in findings {
        out!("   {} {:17}{}", word(finding.outcome), finding.name, finding.text);
    }
    out!();
}

fn word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Pass => "PASS",
        Outcome::Warn => "WARN",
        Outcome::Fail => "FAIL",
    }
}

fn report(found: &Found, findings: &[Finding]) -> serde_json::Value {
    let facts: serde_json::Map<_, _> = found.facts().into_iter().map(|(k, v)| (k.to_owned(), json!(v))).collect();
    let tests: Vec<_> =
        findings.iter().map(|f| json!({ "name": f.name, "outcome": word(f.outcome), "text": f.text })).collect();
    json!({ "adapter": found.describe(), "facts": facts, "tests": tests })
}
