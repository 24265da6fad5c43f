//! Every reader is given damaged files: none may panic, hang, or take more than ten times the memory of the file. Memory is counted by
//! the allocator of this process, which therefore runs one test.
//!
//! `FUZZ_SECONDS` (10) is how long, `FUZZ_SEED` (1) where it begins; a failure writes the file, and names seed, round and file.
#![cfg(feature = "scene")]
#![allow(unsafe_code, reason = "an allocator that counts is one")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::time::{Duration, Instant};

use glam::DVec3;
use motes::formats::{self, FORMATS, Options, atomically};
use motes::kernel::{Array, Columns};
use motes::run::Folder;
use motes::run::{self, Found, Run};
use motes::scene::{self, Scene, Source};
use motes::{Cpu, Simulation, State};

/// Counts what is in use, and the most of it.
struct Counting;
static NOW: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

// SAFETY: all calls continue to the system's allocator; nothing but two counters is beside it.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        MOST.fetch_max(NOW.fetch_add(layout.size(), Relaxed) + layout.size(), Relaxed);
        // SAFETY: as for this call.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        NOW.fetch_sub(layout.size(), Relaxed);
        // SAFETY: as for this call.
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// What a reader may take beside ten times its file: buffers of files and of threads \[bytes\].
const BUFFERS: usize = 2 << 20;
/// What a scene may take beside it, which is asked to make at most 300 particles \[bytes\].
const SCENE: usize = 16 << 20;
/// How long a file of a few kilobytes may take.
const LONGEST: Duration = Duration::from_secs(4);

/// A reader, and a file that it reads.
struct Seed {
    name: String,
    bytes: Vec<u8>,
    read: fn(&Path),
    beside: usize,
}

/// A 64-bit permuted congruential generator (O'Neill 2014) without its permutation's second step: enough to choose places.
struct Dice(u64);

impl Dice {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % end.max(1)
    }
}

/// Numbers at which programs go wrong.
const WORDS: [&[u8]; 20] = [
    &[0],
    &[0xff],
    &[0xff; 4],
    &[0xff; 8],
    &[0, 0, 0, 0x80],
    &[0xff, 0xff, 0xff, 0x7f],
    &[0, 0, 0, 0, 0, 0, 0, 0x10],
    &[0, 0, 0, 0, 1],
    &[0, 0, 0xc0, 0x7f],
    b"1152921504606846976",
    b"99999999999999999999",
    b"-1",
    b"1e999",
    b"nan",
    b"\"",
    b"<",
    b",",
    b"\n",
    b"[[",
    b"0",
];

fn damaged(seed: &[u8], other: &[u8], dice: &mut Dice) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..=dice.below(4) {
        let at = dice.below(bytes.len() + 1);
        match dice.below(9) {
            0 if at < bytes.len() => bytes[at] ^= 1 << dice.below(8),
            1 if at < bytes.len() => bytes[at] = u8::try_from(dice.below(256)).unwrap_or(0),
            2 => bytes.truncate(at),
            3 => {
                let end = (at + dice.below(24)).min(bytes.len());
                bytes.drain(at..end);
            }
            4 => {
                let end = (at + dice.below(40)).min(bytes.len());
                let copy = bytes[at..end].to_vec();
                bytes.splice(at..at, copy);
            }
            5 => {
                let from = dice.below(other.len());
                let to = (from + dice.below(64)).min(other.len());
                bytes.splice(at..at, other[from..to].iter().copied());
            }
            6 => {
                let word = WORDS[dice.below(WORDS.len())];
                bytes.splice(at..at, word.iter().copied());
            }
            // Over what is there: lengths stay.
            _ => {
                let word = WORDS[dice.below(WORDS.len())];
                bytes.iter_mut().skip(at).zip(word).for_each(|(to, from)| *to = *from);
            }
        }
    }
    bytes
}

fn state() -> State {
    let mut state = State::default();
    for row in 0..12 {
        let x = f64::from(row);
        state.push(DVec3::new(x, 0.5 * x, -x), DVec3::new(0.0, x, 1.0), 1.0 + x, 0.25);
    }
    state.species_mut().iter_mut().zip(0..).for_each(|(of, row)| *of = row % 3);
    state.set("spin", Array::Vec3(vec![DVec3::ONE; 12])).expect("spins");
    state.set_ids((0..12).map(|row| 2 * row).collect()).expect("ids");
    state
}

fn particles(path: &Path) {
    let _ = formats::read(path, &Columns::default());
    if let Ok(contents) = formats::contents(path) {
        let _ = formats::read(path, &formats::known(&contents));
    }
}

/// Loads a scene that names the file.
fn scene(text: &str, path: &Path) {
    let folder = path.parent().unwrap_or(Path::new(".")).to_owned();
    let source = Source::Text { name: "a.toml".to_owned(), text: text.to_owned(), folder };
    let options = scene::Options { most_particles: 300, ..scene::Options::default() };
    if let Ok(mut scene) = Scene::load(&source, &[], &options) {
        let _ = scene.setup().check();
    }
}

const LINKED: &str = "[simulation]\ndt = 0.1\nsteps = 1\n[[particles]]\nshape = \"lattice\"\nsize = [3, 2, 1]\n[[links]]\nfile = \"a.csv\"\n\
                      [[force]]\nkind = \"spring\"\n";
const MESHED: &str = "[simulation]\ndt = 0.001\nsteps = 1\n[[particles]]\nshape = \"wall\"\nsurface = \"mesh\"\nmesh = \"a.obj\"\nspacing = 0.25\n";

/// Files of all formats, as they are written; snapshots of GADGET-2 are not.
fn seeds(folder: &Path) -> Vec<Seed> {
    let mut seeds = Vec::new();
    for format in FORMATS {
        let Some(write) = format.write else { continue };
        let path = folder.join(format!("seed.{}", format.name));
        atomically(&path, |out| write(out, &state(), &Options::default())).expect(format.name);
        let bytes = fs::read(&path).expect("a file");
        seeds.push(Seed { name: format!("a.{}", format.name), bytes, read: particles, beside: BUFFERS });
    }
    for format in FORMATS.iter().filter(|format| format.compresses) {
        let (Some(write), path) = (format.write, folder.join("packed")) else { continue };
        let options = Options { compress: true, ..Options::default() };
        atomically(&path, |out| write(out, &state(), &options)).expect(format.name);
        let bytes = fs::read(&path).expect("a file");
        // What is deflated may take 1032 times its bytes.
        let beside = BUFFERS + 1032 * 2 * bytes.len();
        seeds.push(Seed { name: format!("packed.{}", format.name), bytes, read: particles, beside });
    }
    let mut gadget = vec![0; 256];
    gadget[4] = 3;
    let record = |block: &[u8], all: &mut Vec<u8>| {
        let length = u32::try_from(block.len()).unwrap_or(0).to_le_bytes();
        all.extend([&length[..], block, &length[..]].concat());
    };
    let mut all = Vec::new();
    record(&gadget, &mut all);
    for width in [36, 36, 12, 12] {
        record(&vec![0x3f; width], &mut all);
    }
    let text = |name: &str, text: &str, read| Seed {
        name: name.to_owned(),
        bytes: text.as_bytes().to_vec(),
        read,
        beside: SCENE,
    };
    seeds.push(Seed { name: "a.gadget".to_owned(), bytes: all, read: particles, beside: BUFFERS });
    let blanks = "# m x y z vx vy vz\n1 0 0 0 0 0 0\n2.5e0\t1 -2 3 0 0 0\n";
    seeds.push(Seed { name: "a.dat".to_owned(), bytes: blanks.into(), read: particles, beside: BUFFERS });
    let ascii = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty double z\nelement face 1\n\
                 property list uchar int vertex_indices\nend_header\n0 0 0\n1 2 3\n3 0 1 0\n";
    seeds.push(Seed { name: "b.ply".to_owned(), bytes: ascii.into(), read: particles, beside: BUFFERS });
    seeds.push(text("a.csv", "a,b,rest,stiffness,damping,tie\n0,1,1,10,0,spring\n1,2,0.5,3,0.1,rope\n", |path| {
        scene(LINKED, path);
    }));
    let mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1/1/1 2//1 4\nf -1 -2 -3\n";
    seeds.push(text("a.obj", mesh, |path| scene(MESHED, path)));
    for builtin in ["kepler", "cloth", "dam_break_2d", "salt"] {
        let found = scene::SCENES.iter().find(|scene| scene.name == builtin).expect(builtin);
        seeds.push(text("a.toml", found.text, |path| {
            scene(&String::from_utf8_lossy(&fs::read(path).unwrap_or_default()), path);
        }));
    }
    let checkpoint = checkpoint(folder);
    seeds.push(Seed { name: "checkpoint_0000000000.npz".to_owned(), bytes: checkpoint, read: found, beside: BUFFERS });
    seeds
}

/// The checkpoint of a run that was stopped before its first step.
fn checkpoint(folder: &Path) -> Vec<u8> {
    let source = Source::find("kepler").unwrap_or_else(|faults| panic!("{faults}"));
    let mut scene = Scene::load(&source, &[], &scene::Options::default()).unwrap_or_else(|faults| panic!("{faults}"));
    let setup = scene.setup();
    let options = run::Options::into(folder.join("run"));
    options.stop.ask();
    let mut run = Run::new(scene, &setup, options).expect("a run");
    let cpu = Cpu::new(setup.check().expect("a setup")).expect("a backend");
    let mut simulation = Simulation::on(cpu, &setup).expect("a simulation");
    let end = pollster::block_on(run.drive(&mut simulation, &mut ())).expect("the end");
    assert!(end.stopped);
    drop(run);
    let mut files = fs::read_dir(folder.join("run")).expect("a folder").flatten().map(|entry| entry.path());
    let file = files.find(|path| path.to_string_lossy().contains("checkpoint_")).expect("a checkpoint");
    fs::read(file).expect("a checkpoint")
}

fn found(path: &Path) {
    if let Ok(folder) = Folder::hold(path.parent().unwrap_or(Path::new("."))) {
        let _ = Found::of(&folder);
    }
}

/// Reads a file, and says what is wrong with how that went.
fn fault(seed: &Seed, path: &Path, length: usize) -> Option<String> {
    let read = seed.read;
    let place: PathBuf = path.to_owned();
    let (begun, before) = (Instant::now(), NOW.load(Relaxed));
    MOST.store(before, Relaxed);
    let result = catch_unwind(move || read(&place));
    let (took, most) = (begun.elapsed(), MOST.load(Relaxed).saturating_sub(before));
    if result.is_err() {
        return Some("a panic".to_owned());
    }
    if took > LONGEST {
        return Some(format!("{took:?}"));
    }
    (most > 10 * length + seed.beside).then(|| format!("{most} bytes of memory for {length} of the file"))
}

#[test]
fn damaged_files_are_answers_without_panics_hangs_or_memory() {
    let number = |name: &str, usual: u64| std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(usual);
    let (seconds, seed) = (number("FUZZ_SECONDS", 10), number("FUZZ_SEED", 1));
    let folder = tempfile::tempdir().expect("a folder");
    let seeds = seeds(folder.path());
    // Pools of threads and tables of names are made once.
    motes::cpu::threads().expect("threads");
    let scratch = folder.path().join("scratch");
    fs::create_dir_all(&scratch).expect("a folder");
    let corpus = fs::read_dir("tests/hostile").into_iter().flatten().flatten().map(|entry| entry.path());
    let mut faults = Vec::new();
    let mut judge = |seed: &Seed, bytes: &[u8], what: String| {
        let path = scratch.join(&seed.name);
        fs::write(&path, bytes).expect("a file");
        if let Some(fault) = fault(seed, &path, bytes.len()) {
            let kept = std::env::temp_dir().join(format!("motes-fuzz-{what}-{}", seed.name));
            fs::write(&kept, bytes).expect("a file");
            faults.push(format!("{what}, {}: {fault}; kept as {}", seed.name, kept.display()));
        }
        let _ = fs::remove_file(&path);
    };
    for seed in &seeds {
        judge(seed, &seed.bytes, "undamaged".to_owned());
    }
    for path in corpus {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let bytes = fs::read(&path).expect("a file of the corpus");
        for seed in seeds.iter().filter(|seed| name.ends_with(&seed.name)) {
            judge(seed, &bytes, format!("corpus {name}"));
        }
    }
    let (begun, mut dice, mut round) = (Instant::now(), Dice(seed), 0_u64);
    while begun.elapsed() < Duration::from_secs(seconds) {
        for seed in &seeds {
            let other = &seeds[dice.below(seeds.len())].bytes;
            let bytes = damaged(&seed.bytes, other, &mut dice);
            judge(seed, &bytes, format!("round {round}"));
        }
        round += 1;
    }
    println!("{round} rounds of {} readers, seed {seed}", seeds.len());
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(round > 0);
}
