//! Mutation of pictures: every operator and literal of their shaders is changed once, and the f64 reference of the kernel,
//! given the same, must notice.

mod alike;
mod birds;
mod equivalents;
mod scenes;
mod stages;
#[path = "../support/mod.rs"]
mod support;
mod tied;
mod wet;

use std::path::Path;
use std::sync::Mutex;
use std::time::Instant;

use equivalents::EQUIVALENT;
use scenes::{FEW, MANY};
use stages::Stage;
use support::Shared;
use support::equivalents::Ledger;
use support::mutants::{Mutant, mutants};

/// A software device compiles shaders in one thread, its queue's: two devices keep two cores busy.
const TURNS: usize = 2;
/// Stages that run a mutant that is listed as equivalent: those that noticed other mutants last. All of them run
/// when only chosen files are tested.
const ASKED: usize = 8;

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

/// Whether any stage sees the difference; a stage that does runs first from now on.
fn noticed(stages: &mut [&Stage], file: &str, mutant: &Mutant) -> bool {
    let sees = |stage: &&Stage| match stage.mutated(file, &mutant.text) {
        // A mutant that does not compile is noticed.
        None => true,
        Some(kernel) => !stage.good(&kernel),
    };
    let first = stages.iter().position(sees);
    if let Some(first) = first {
        stages[..=first].rotate_right(1);
    }
    first.is_some()
}

/// The shaders as they are agree with their references.
fn agree<'a>(stages: impl Iterator<Item = &'a Stage>) {
    for stage in stages {
        assert!(stage.good(&stage.kernel), "{}: the shader as it is does not agree with its reference", stage.name);
    }
}

/// All stages, on a device of their own.
fn all(shared: &Shared) -> Vec<Stage> {
    let device = pollster::block_on(support::limited(shared, |_| ()));
    let mut stages = Vec::new();
    for (count, scenes) in
        [(FEW, scenes::few()), (MANY, scenes::many()), (MANY, birds::birds()), (FEW, vec![scenes::tall()])]
    {
        let canvas = stages::canvas(&device, count);
        stages.extend(scenes.iter().flat_map(|scene| stages::stages(scene, &canvas)));
    }
    for scene in tied::tied() {
        stages.extend(stages::stages(&scene, &stages::canvas(&device, scene.picture.frame.count as usize)));
    }
    for scene in wet::wet() {
        let all = stages::stages(&scene, &stages::canvas(&device, scene.picture.frame.count as usize));
        stages.extend(all.into_iter().filter(|stage| wet::KERNELS.contains(&stage.kernel.name.as_str())));
    }
    stages
}

/// Takes file after file, until there are no more; `whole` asks every stage about every mutant.
fn work(
    (shared, turn): (&Shared, usize),
    whole: bool,
    next: &dyn Fn() -> Option<(String, String)>,
    ledger: &Mutex<Ledger<'_>>,
) {
    let stages = all(shared);
    agree(stages.iter().skip(turn).step_by(TURNS));
    while let Some((file, text)) = next() {
        let begun = Instant::now();
        let mut its: Vec<&Stage> = stages.iter().filter(|stage| stage.uses(&file)).collect();
        assert!(!its.is_empty(), "{file}: no stage runs it");
        for mutant in mutants(&text).iter().filter(|m| !endless(m)) {
            let listed = ledger.lock().expect("no thread panics").expects(&file, mutant);
            let asked = if listed && !whole { its.len().min(ASKED) } else { its.len() };
            let noticed = noticed(&mut its[..asked], &file, mutant);
            ledger.lock().expect("no thread panics").enter(&file, mutant, noticed);
        }
        println!("{file}: {} stages, {:.1} s", its.len(), begun.elapsed().as_secs_f64());
    }
    // Had a mutant broken the device, all after it would have been noticed for nothing.
    agree(stages.iter().skip(turn).step_by(9));
}

#[test]
fn every_mutant_of_a_picture_is_noticed() {
    let devices: Vec<Shared> = (0..TURNS).map(|_| support::open()).collect();
    let ledger = Mutex::new(Ledger::new(EQUIVALENT, &[]));
    let chosen = std::env::var("MUTANTS").unwrap_or_default();
    let chosen: Vec<&str> = chosen.split(',').filter(|name| !name.is_empty()).collect();
    let is_chosen = |file: &str| chosen.is_empty() || chosen.iter().any(|name| file.ends_with(&format!("/{name}")));
    let mut files = files();
    files.retain(|(file, _)| is_chosen(file));
    // The longest first, so that no thread is left with one when the others are done.
    files.sort_by_key(|(_, text)| text.len());
    let files = Mutex::new(files);
    let next = || files.lock().expect("no thread panics").pop();
    std::thread::scope(|scope| {
        for (turn, shared) in devices.iter().enumerate() {
            let (next, ledger, whole) = (&next, &ledger, !chosen.is_empty());
            scope.spawn(move || work((shared, turn), whole, next, ledger));
        }
    });
    // As many as were there when this was written, less a third: an empty list of mutants would be noticed in full.
    let ledger = ledger.into_inner().expect("no thread panics");
    ledger.close(|e| chosen.is_empty() || is_chosen(&format!("/{}", e.file)), if chosen.is_empty() { 860 } else { 0 });
}
