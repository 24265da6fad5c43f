//! Mutation of pictures: every operator and literal of their shaders is changed once, and the snapshots must notice. Changes of less
//! than drivers differ by are not: how many are noticed is counted, file by file.

use std::path::Path;
use std::sync::Mutex;

use motes::Gpu;
use motes::kernel::{Plan, Shader, Source};

use super::draw::{Difference, Plans, altered, gpu, rgb, snapshot};
use super::scenes::{self, Scene};
use super::support::mutants::{Mutant, mutants};
use super::support::{self, Shared};

/// A software device compiles shaders in one thread, its queue's: two devices keep two cores busy.
const TURNS: usize = 2;
/// The part of all mutants that is noticed, and of each file's. Others change a picture by less than a driver may, or not at all: an
/// edge of a comparison, the size of a workgroup, a bound of a loop that is never reached.
const ALL: f64 = 0.8;
const EACH: f64 = 0.5;

/// A scene on a device, with the snapshot that its picture is held against.
struct Stage {
    scene: Scene,
    gpu: Gpu,
    plans: Plans,
    want: Vec<u8>,
    not_drawn: [u32; 2],
}

/// Mutants of a file, and how many of them are noticed.
struct Count {
    file: String,
    all: usize,
    noticed: usize,
    unnoticed: Vec<String>,
}

fn stages(shared: &Shared) -> Vec<Stage> {
    let stage = |scene: Scene| {
        let mut gpu = gpu(shared, &scene.state, &scene.picture);
        let plans = Plans::of(&mut gpu, &scene.picture);
        let image = altered(&mut gpu, &scene.picture, &plans, |_| Some(())).expect("a picture");
        let want = snapshot(scene.name);
        assert!(Difference::between(&rgb(&image), &want).is_within(1.0), "{}: not the snapshot", scene.name);
        Stage { not_drawn: [image.outside, image.broken], scene, gpu, plans, want }
    };
    scenes::all().into_iter().map(stage).collect()
}

/// Puts another text in place of a file's; `None` when that does not compile.
fn replace(plan: &mut Plan, file: &str, text: &str) -> Option<()> {
    // A stranger's text: memory is checked, and loops are bounded.
    let theirs = |s: &Source| if s.file == file { Source::theirs(file.into(), text.into()) } else { s.clone() };
    for pass in plan.kernels.iter_mut().flat_map(|kernel| &mut kernel.passes) {
        if pass.shader.sources().iter().any(|s| s.file == file) {
            let sources: Vec<_> = pass.shader.sources().iter().map(theirs).collect();
            pass.shader = Shader::join(&sources).ok()?;
        }
    }
    Some(())
}

impl Stage {
    fn uses(&self, file: &str) -> bool {
        self.plans.passes().any(|pass| pass.shader.sources().iter().any(|s| s.file == file))
    }
    fn notices(&mut self, file: &str, mutant: &Mutant) -> bool {
        let image = altered(&mut self.gpu, &self.scene.picture, &self.plans, |plan| replace(plan, file, &mutant.text));
        image.is_none_or(|image| {
            [image.outside, image.broken] != self.not_drawn
                || !Difference::between(&rgb(&image), &self.want).is_within(1.0)
        })
    }
}

/// A loop that turns the other way ends when its counter has gone once round, after 2³¹ turns; and a workgroup may have any size, which
/// the host reads.
fn is_idle(mutant: &Mutant) -> bool {
    mutant.line.starts_with("for ") && mutant.new == "-=" || mutant.line.starts_with("const WORKGROUP")
}

fn count(stages: &mut [Stage], file: String, text: &str) -> Count {
    // The one that noticed the last mutant is asked first about the next.
    let mut order: Vec<usize> = (0..stages.len()).filter(|k| stages[*k].uses(&file)).collect();
    assert!(!order.is_empty(), "{file}: no scene runs it");
    let mut count = Count { file, all: 0, noticed: 0, unnoticed: Vec::new() };
    for mutant in mutants(text).iter().filter(|mutant| !is_idle(mutant)) {
        count.all += 1;
        match order.iter().position(|k| stages[*k].notices(&count.file, mutant)) {
            Some(first) => {
                order[..=first].rotate_right(1);
                count.noticed += 1;
            }
            None => {
                count.unnoticed.push(format!("{}: {} → {} in {}", mutant.column, mutant.old, mutant.new, mutant.line));
            }
        }
    }
    count
}

#[test]
fn snapshots_notice_broken_shaders() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders/render");
    let name = |path: &Path| format!("shaders/render/{}", path.file_name().expect("a name").to_string_lossy());
    let paths = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let mut files: Vec<_> = paths.map(|p| (name(&p), std::fs::read_to_string(&p).expect("a text"))).collect();
    let chosen = std::env::var("MUTANTS").unwrap_or_default();
    let chosen: Vec<&str> = chosen.split(',').filter(|name| !name.is_empty()).collect();
    files.retain(|(file, _)| chosen.is_empty() || chosen.iter().any(|name| file.ends_with(&format!("/{name}"))));
    // The longest first, so that no thread is left with one when the others are done.
    files.sort_by_key(|(_, text)| text.len());
    let (files, counts) = (Mutex::new(files), Mutex::new(Vec::new()));
    let next = || files.lock().expect("no thread panics").pop();
    std::thread::scope(|scope| {
        for _ in 0..TURNS {
            scope.spawn(|| {
                let mut stages = stages(&support::open());
                while let Some((file, text)) = next() {
                    let count = count(&mut stages, file, &text);
                    println!("{}: {} of {} noticed", count.file, count.noticed, count.all);
                    count.unnoticed.iter().for_each(|one| println!("    not noticed: {one}"));
                    counts.lock().expect("no thread panics").push(count);
                }
                // Had a mutant broken the device, all after it would have been noticed for nothing.
                for stage in &mut stages {
                    let image =
                        altered(&mut stage.gpu, &stage.scene.picture, &stage.plans, |_| Some(())).expect("a picture");
                    assert!(Difference::between(&rgb(&image), &stage.want).is_within(1.0), "{}", stage.scene.name);
                }
            });
        }
    });
    let counts = counts.into_inner().expect("no thread panics");
    let [noticed, all] = [|c: &Count| c.noticed, |c: &Count| c.all].map(|of| counts.iter().map(of).sum::<usize>());
    println!("{noticed} of {all} mutants noticed");
    let part = |noticed: usize, all: usize| noticed as f64 / all as f64;
    for count in counts.iter().filter(|count| count.all > 0) {
        assert!(part(count.noticed, count.all) >= EACH, "{}: {} of {}", count.file, count.noticed, count.all);
    }
    // As many as were there when this was written, less a third: an empty list of mutants would be noticed in full.
    assert!(!chosen.is_empty() || (all > 860 && part(noticed, all) >= ALL), "{noticed} of {all} mutants are noticed");
}
