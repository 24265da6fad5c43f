//! Mutation: every operator and literal of every shader is changed once, and the lockstep with the references must notice.

mod adaptive;
mod adaptive_stages;
mod alarms;
mod barostats;
mod births;
mod blocks;
mod boundary;
mod bounded;
mod collide;
mod columns;
mod crowds;
mod curious;
mod dfsph;
mod equivalent_dfsph;
mod equivalent_neighbors;
mod equivalent_primitives;
mod equivalents;
mod ewald;
mod fluids;
mod grains;
mod held;
mod implicit;
mod laws;
mod lists;
mod matter;
mod memory;
mod minimum;
mod neighbors;
mod open;
mod pairs;
mod precision;
mod primitives;
mod radau;
mod repeat;
mod rods;
mod sizes;
mod stages;
mod strained;
#[path = "../support/mod.rs"]
mod support;
mod together;
mod trees;
mod two_words;
mod walks;

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use equivalents::{EQUIVALENT, SOLVES};
use open::{ENDLESS, OPEN};
use stages::Stage;
use support::Shared;
use support::equivalents::{Equivalent, Ledger};
use support::joint::roomy;
use support::machines::without_unused_word;
use support::mutants::mutants;
use support::tint;
use together::{APART, File, JOINED, grouped, unnoticed};

/// These have mutants of their own, in `tests/picture`, `tests/physics/questions.rs` and `tests/engine/own_laws`.
const WITHOUT_REFERENCES: [&str; 3] = ["render", "selftest", "own"];

/// Stages that run a mutant that is listed as equivalent: those that noticed most of the others. All of them run
/// when only chosen files are tested.
const ASKED: usize = 1;

/// A software device compiles shaders in one thread, its queue's: two devices keep two cores busy.
const TURNS: usize = 2;

/// The shaders that have references.
fn files() -> Vec<File> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders: Vec<PathBuf> = vec![root.join("shaders")];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                if !WITHOUT_REFERENCES.iter().any(|folder| path.ends_with(folder)) {
                    folders.push(path);
                }
            } else if path.extension().is_some_and(|e| e == "wgsl") {
                let name = path.strip_prefix(root).expect("inside").to_string_lossy().replace('\\', "/");
                let text = std::fs::read_to_string(&path).expect("a text");
                files.push(File { mutants: mutants(&text), name, text });
            }
        }
    }
    // The longest first, so that no thread is left with one when the others are done.
    files.sort_by(|a, b| (b.text.len(), &b.name).cmp(&(a.text.len(), &a.name)));
    files
}

/// Whether each mutant is noticed by a stage. Those on the list are shown to the stages that notice most, or to all where `whole`. Only there
/// those are run that are known to be endless.
fn noticed(stages: &[&Stage], file: &File, listed: &[bool], whole: bool) -> Vec<bool> {
    // Stages beside each other are alike: they are taken from all over the list, so that what one kind overlooks is soon shown to another. The
    // smallest is the first, where it is much smaller: loops that a mutant makes endless run for as long as a driver lets them, once for each
    // particle.
    let mut stages: Vec<(usize, &Stage)> = stages.iter().map(|stage| (0, *stage)).collect();
    let smallest = (0..stages.len()).min_by_key(|place| stages[*place].1.count()).unwrap_or(0);
    if 4 * stages[smallest].1.count() <= stages[0].1.count() {
        stages[..=smallest].rotate_right(1);
    }
    let mut place = 0u32;
    stages.sort_by_cached_key(|_| {
        place += 1;
        (place - 1).reverse_bits()
    });
    let endless = |mutant: usize| ENDLESS.iter().any(|e| e.is(&file.name, &file.mutants[mutant]));
    let run = (0..listed.len()).filter(|mutant| whole || !endless(*mutant));
    let (known, mut alive): (Vec<usize>, Vec<usize>) = run.partition(|mutant| listed[*mutant]);
    for (kills, stage) in &mut stages {
        let before = alive.len();
        alive = unnoticed(stage, file, &alive);
        *kills = before - alive.len();
    }
    stages.sort_by_key(|(kills, _)| std::cmp::Reverse(*kills));
    // One that lives among others is tried alone.
    alive.retain(|mutant| stages.iter().all(|(_, stage)| !unnoticed(stage, file, &[*mutant]).is_empty()));
    let asked = if whole { stages.len() } else { stages.len().min(ASKED) };
    // A device that is slow errs: what is listed and noticed is asked about again, alone.
    let again = |alive: Vec<usize>, stage: &Stage| -> Vec<usize> {
        let rest = unnoticed(stage, file, &alive);
        let lives = |mutant: &usize| rest.contains(mutant) || !unnoticed(stage, file, &[*mutant]).is_empty();
        alive.into_iter().filter(lives).collect()
    };
    alive.extend(stages[..asked].iter().fold(known, |alive, (_, stage)| again(alive, stage)));
    (0..listed.len()).map(|mutant| !alive.contains(&mutant)).collect()
}

/// The shaders as they are agree with their references, and their blocks begin with the unused word: without it mutants are read by such
/// drivers in blocks of other numbers, and all of a file count as noticed, whatever they do.
fn agree<'a>(stages: impl Iterator<Item = &'a Stage>) {
    let fault = |stage: &Stage| {
        if let Some(fault) = stage.plan.kernels.iter().find_map(without_unused_word) {
            return Some(format!("{}: {fault}", stage.name));
        }
        stage.allow(stages::PATIENCE);
        let fault = stage.fault(&stage.plan);
        stage.allow(stages::SHORT);
        stage.forget_answers();
        fault.map(|fault| format!("{}: {fault}", stage.name))
    };
    let faults: Vec<String> = stages.filter_map(fault).collect();
    assert!(faults.is_empty(), "the shaders as they are do not agree with their references:\n{}", faults.join("\n"));
}

/// The files that threads take, one after another.
struct Queue<'a> {
    files: &'a [File],
    next: AtomicUsize,
    /// When no more of them are begun.
    end: Option<Instant>,
}

impl Queue<'_> {
    fn take(&self) -> Option<&File> {
        if self.end.is_some_and(|end| Instant::now() >= end) {
            return None;
        }
        self.files.get(self.next.fetch_add(1, Ordering::Relaxed))
    }
    /// Those that no thread has begun.
    fn left(&self) -> &[File] {
        &self.files[self.next.load(Ordering::Relaxed).min(self.files.len())..]
    }
}

/// Takes file after file, until there are no more; `whole` asks every stage about every mutant.
fn work((shared, turn): (&Shared, usize), whole: bool, queue: &Queue<'_>, ledger: &Mutex<Ledger<'_>>) {
    let begun = Instant::now();
    let all = queue.files;
    let mut stages = stages::all(shared);
    println!("{} stages are set up: {:.1} s", stages.len(), begun.elapsed().as_secs_f64());
    if turn == 0 {
        // Stages run on lavapipe, whose subgroups have eight lanes.
        let kernels =
            stages.iter().flat_map(|stage| stage.plan.kernels.iter().map(|kernel| (stage.name.clone(), kernel, 8)));
        tint::write("mutants", &tint::shaders(kernels));
    }
    stages.retain(|stage| all.iter().any(|file| stage.uses(&file.name)));
    for file in all.iter().skip(turn).step_by(TURNS) {
        let stage = stages.iter().find(|stage| stage.uses(&file.name));
        let stage = stage.unwrap_or_else(|| panic!("{}: no stage runs it", file.name));
        assert!(grouped(stage, file), "{}: what its mutants change is grouped wrongly", file.name);
    }
    agree(stages.iter().skip(turn).step_by(TURNS));
    println!("{} stages agree: {:.1} s", stages.len(), begun.elapsed().as_secs_f64());
    stages.iter().for_each(|stage| stage.allow(stages::SHORT));
    while let Some(file) = queue.take() {
        let begun = Instant::now();
        let its: Vec<&Stage> = stages.iter().filter(|stage| stage.uses(&file.name)).collect();
        let listed = |mutant| ledger.lock().expect("no thread panics").expects(&file.name, mutant);
        let listed: Vec<bool> = file.mutants.iter().map(listed).collect();
        let noticed = noticed(&its, file, &listed, whole);
        its.iter().for_each(|stage| stage.forget_answers());
        for (mutant, noticed) in file.mutants.iter().zip(noticed) {
            ledger.lock().expect("no thread panics").enter(&file.name, mutant, noticed);
        }
        let (count, seconds) = (file.mutants.len(), begun.elapsed().as_secs_f64());
        println!("{}: {count} mutants, {} stages, {seconds:.1} s", file.name, its.len());
    }
    // Had a mutant broken the device, all after it would have been noticed for nothing.
    agree(stages.iter().skip(turn).step_by(9));
}

#[test]
fn every_mutant_is_noticed() {
    let devices: Vec<Shared> = (0..TURNS).map(|_| roomy()).collect();
    let has_subgroups = devices.iter().all(support::machines::subgroups_of_eight);
    let equivalents = [
        EQUIVALENT,
        SOLVES,
        equivalent_primitives::EQUIVALENT,
        equivalent_neighbors::EQUIVALENT,
        equivalent_dfsph::EQUIVALENT,
        births::EQUIVALENT,
        lists::EQUIVALENT,
        trees::EQUIVALENT,
        walks::EQUIVALENT,
        adaptive::EQUIVALENT,
        blocks::EQUIVALENT,
        precision::EQUIVALENT,
        radau::EQUIVALENT,
        two_words::EQUIVALENT,
        fluids::EQUIVALENT,
        pairs::EQUIVALENT,
        repeat::EQUIVALENT,
        collide::EQUIVALENT,
        columns::EQUIVALENT,
        grains::EQUIVALENT,
        matter::EQUIVALENT,
        barostats::EQUIVALENT,
        crowds::EQUIVALENT,
        minimum::EQUIVALENT,
    ]
    .concat();
    let ledger = Mutex::new(Ledger::new(&equivalents, OPEN));
    // `MUTANTS=near,order cargo test --test mutants -- --nocapture` looks at files of such names alone.
    let only = std::env::var("MUTANTS").unwrap_or_default();
    let wanted = |file: &str| only.split(',').any(|part| file.contains(part));
    let mut files = files();
    let runs = |file: &str| has_subgroups || !["subgroup", "broadcast"].iter().any(|part| file.contains(part));
    files.retain(|file| wanted(&file.name) && runs(&file.name));
    // `MUTANTS_MINUTES=20` begins no file later than that.
    let minutes = std::env::var("MUTANTS_MINUTES").ok();
    let minutes = minutes.map(|text| text.parse().unwrap_or_else(|_| panic!("MUTANTS_MINUTES={text} is no number")));
    let end = minutes.map(|minutes| Instant::now() + Duration::from_mins(minutes));
    let known = |e: &Equivalent| files.iter().any(|file| file.mutants.iter().any(|mutant| e.is(&file.name, mutant)));
    assert!(!only.is_empty() || ENDLESS.iter().all(known), "a mutant without an end is no mutant any more");
    let queue = Queue { files: &files, next: AtomicUsize::new(0), end };
    std::thread::scope(|scope| {
        for (turn, shared) in devices.iter().enumerate() {
            let (queue, ledger, whole) = (&queue, &ledger, !only.is_empty());
            scope.spawn(move || work((shared, turn), whole, queue, ledger));
        }
    });
    let left = queue.left();
    if !left.is_empty() {
        let names: Vec<&str> = left.iter().map(|file| file.name.as_str()).collect();
        println!("LEFT OUT for lack of time: {} of {} files: {}", left.len(), files.len(), names.join(", "));
    }
    let [joined, apart] = [&JOINED, &APART].map(|count| count.load(Ordering::Relaxed));
    println!("shown {joined} times together with others, {apart} times alone");
    let all_are_shown = only.is_empty() && left.is_empty();
    assert!(!all_are_shown || joined > apart, "{joined} of {} are shown together", joined + apart);
    // As many as were there when this was written, less a third: an empty list of mutants would be noticed in full.
    let due = |equivalent: &Equivalent| has_subgroups || !equivalent.file.contains("subgroup");
    let ledger = ledger.into_inner().expect("no thread panics");
    ledger.close(|equivalent| all_are_shown && due(equivalent), if all_are_shown { 1650 } else { 0 });
}
