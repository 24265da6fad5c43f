//! Mutation of pictures: every operator and literal of their shaders is changed once, and the f64 twin of the kernel,
//! given the same, must notice.

mod alike;
mod birds;
mod equivalents;
mod scenes;
mod stages;
#[path = "../support/mod.rs"]
mod support;
mod tied;

use std::path::Path;

use equivalents::EQUIVALENT;
use scenes::{FEW, MANY};
use stages::Stage;
use support::equivalents::Ledger;
use support::mutants::{Mutant, mutants};

/// The shaders of pictures, by their names in messages.
fn files() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders/render");
    let paths = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let name = |path: &Path| format!("shaders/render/{}", path.file_name().expect("a name").to_string_lossy());
    let mut files: Vec<_> = paths.map(|p| (name(&p), std::fs::read_to_string(&p).expect("a text"))).collect();
    files.sort();
    files
}

/// A loop that turns the other way ends when its counter has gone once round, after 2³¹ turns.
fn endless(mutant: &Mutant) -> bool {
    mutant.line.starts_with("for ") && mutant.new == "-="
}

fn noticed(stages: &[Stage], file: &str, mutant: &Mutant) -> bool {
    stages.iter().filter(|s| s.uses(file)).any(|stage| match stage.mutated(file, &mutant.text) {
        // What does not compile is noticed by everybody.
        None => true,
        Some(kernel) => !stage.good(&kernel),
    })
}

/// The shaders as they are agree with their twins.
fn agree(stages: &[Stage]) {
    for stage in stages {
        assert!(stage.good(&stage.kernel), "{}: the shader as it is does not agree with its twin", stage.name);
    }
}

#[test]
fn every_mutant_of_a_picture_is_noticed() {
    let shared = support::device();
    let mut stages = Vec::new();
    for (count, scenes) in
        [(FEW, scenes::few()), (MANY, scenes::many()), (MANY, birds::birds()), (FEW, vec![scenes::tall()])]
    {
        let canvas = stages::canvas(&shared, count);
        stages.extend(scenes.iter().flat_map(|scene| stages::stages(scene, &canvas)));
    }
    for scene in tied::tied() {
        stages.extend(stages::stages(&scene, &stages::canvas(&shared, scene.picture.frame.count as usize)));
    }
    agree(&stages);
    let mut ledger = Ledger::new(EQUIVALENT);
    let chosen = std::env::var("MUTANTS").unwrap_or_default();
    let chosen: Vec<&str> = chosen.split(',').filter(|name| !name.is_empty()).collect();
    let is_chosen = |file: &str| chosen.is_empty() || chosen.iter().any(|name| file.ends_with(&format!("/{name}")));
    for (file, text) in files().into_iter().filter(|(file, _)| is_chosen(file)) {
        assert!(stages.iter().any(|s| s.uses(&file)), "{file}: no stage runs it");
        for mutant in mutants(&text).iter().filter(|m| !endless(m)) {
            ledger.enter(&file, mutant, noticed(&stages, &file, mutant));
        }
    }
    // Had a mutant broken the device, all after it would have been noticed for nothing.
    agree(&stages);
    // As many as were there when this was written, less a third: an empty list of mutants would be noticed in full.
    ledger.close(|e| chosen.is_empty() || is_chosen(&format!("/{}", e.file)), if chosen.is_empty() { 510 } else { 0 });
}
