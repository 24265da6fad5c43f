//! The examples run, without a window: each is what the documentation shows, and says itself what must hold.

#[path = "../../../examples/moving_obstacle.rs"]
mod moving_obstacle;
#[path = "../../../examples/own_law.rs"]
mod own_law;
#[path = "../../../examples/read_back.rs"]
mod read_back;
#[path = "../../../examples/renderer.rs"]
mod renderer;
#[path = "../../../examples/save_and_restore.rs"]
mod save_and_restore;
#[path = "../../../examples/schedule.rs"]
mod schedule;
#[path = "../../../examples/spawn_and_remove.rs"]
mod spawn_and_remove;

/// The names of all, with what they run.
type Main = fn() -> Result<(), Box<dyn std::error::Error>>;
const EXAMPLES: [(&str, Main); 7] = [
    ("moving_obstacle", moving_obstacle::main),
    ("own_law", own_law::main),
    ("read_back", read_back::main),
    ("renderer", renderer::main),
    ("save_and_restore", save_and_restore::main),
    ("schedule", schedule::main),
    ("spawn_and_remove", spawn_and_remove::main),
];
/// What needs a screen or minutes, and is run elsewhere.
const ELSEWHERE: [&str; 2] = ["window", "dam_break"];

#[test]
fn every_example_runs() {
    let _alone = crate::support::device();
    for (name, run) in EXAMPLES {
        run().unwrap_or_else(|error| panic!("examples/{name}.rs: {error}"));
    }
}

#[test]
fn examples_are_short_and_complete() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut found = Vec::new();
    for entry in std::fs::read_dir(&folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().and_then(|name| name.to_str()).unwrap_or_default().to_owned();
        if path.extension().is_none_or(|ending| ending != "rs") || ELSEWHERE.contains(&name.as_str()) {
            continue;
        }
        let lines = std::fs::read_to_string(&path).expect("a text").lines().count();
        assert!(lines <= 80, "examples/{name}.rs has {lines} lines: an example shows one thing");
        found.push(name);
    }
    found.sort();
    let known: Vec<&str> = EXAMPLES.iter().map(|(name, _)| *name).collect();
    assert_eq!(found, known, "an example runs in no test");
}
