//! Mutation: every operator and literal of every shader is changed once, and the lockstep with the twins must notice.

mod alarms;
mod boundary;
mod curious;
mod equivalent_neighbors;
mod equivalent_primitives;
mod equivalents;
mod held;
mod implicit;
mod laws;
mod neighbors;
mod primitives;
mod rods;
mod stages;
#[path = "../support/mod.rs"]
mod support;

use std::path::{Path, PathBuf};

use equivalents::EQUIVALENT;
use stages::Stage;
use support::equivalents::{Equivalent, Ledger};
use support::mutants::{Mutant, mutants};

/// These have mutants of their own, in `tests/picture_mutants` and `tests/questions.rs`.
const WITHOUT_TWINS: [&str; 2] = ["render", "selftest"];

/// The shaders that have twins, by their names in messages.
fn files() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders: Vec<PathBuf> = vec![root.join("shaders")];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                if !WITHOUT_TWINS.iter().any(|folder| path.ends_with(folder)) {
                    folders.push(path);
                }
            } else if path.extension().is_some_and(|e| e == "wgsl") {
                let name = path.strip_prefix(root).expect("inside").to_string_lossy().replace('\\', "/");
                files.push((name, std::fs::read_to_string(&path).expect("a text")));
            }
        }
    }
    files.sort();
    files
}

/// Whether any stage sees the difference.
fn noticed(stages: &mut [Stage], file: &str, mutant: &Mutant) -> bool {
    stages.iter_mut().filter(|s| s.uses(file)).any(|stage| match stage.mutated(file, &mutant.text) {
        // What does not compile is noticed by everybody.
        None => true,
        Some(plan) => !stage.good(&plan),
    })
}

/// The shaders as they are agree with their twins.
fn agree(stages: &mut [Stage]) {
    for stage in stages {
        let plan = stage.plan.clone();
        assert!(stage.good(&plan), "{}: the shaders as they are do not agree with their twins", stage.name);
    }
}

#[test]
fn every_mutant_is_noticed() {
    let shared = support::device();
    let mut stages = stages::all(&shared);
    agree(&mut stages);
    let has_subgroups = support::machines::subgroups_of_eight(&shared);
    let equivalents = [EQUIVALENT, equivalent_primitives::EQUIVALENT, equivalent_neighbors::EQUIVALENT].concat();
    let mut ledger = Ledger::new(&equivalents);
    // `MUTANTS=near,order cargo test --test mutants -- --nocapture` looks at files of such names alone.
    let only = std::env::var("MUTANTS").unwrap_or_default();
    for (file, text) in files().into_iter().filter(|(file, _)| only.split(',').any(|part| file.contains(part))) {
        let begun = std::time::Instant::now();
        if file.contains("subgroup") && !has_subgroups {
            continue;
        }
        assert!(stages.iter().any(|s| s.uses(&file)), "{file}: no stage runs it");
        for mutant in mutants(&text) {
            let noticed = noticed(&mut stages, &file, &mutant);
            ledger.enter(&file, &mutant, noticed);
        }
        println!("{file}: {:.1} s", begun.elapsed().as_secs_f64());
    }
    // Had a mutant broken the device, all after it would have been noticed for nothing.
    agree(&mut stages);
    // As many as were there when this was written, less a third: an empty list of mutants would be noticed in full.
    let due = |equivalent: &Equivalent| has_subgroups || !equivalent.file.contains("subgroup");
    ledger.close(|equivalent| only.is_empty() && due(equivalent), if only.is_empty() { 700 } else { 0 });
}
