//! Whatever the text: an answer, never a panic.

use motes::scene::{Options, SCENES, Scene, Source};
use proptest::prelude::*;
use proptest::sample::Index;

/// Loads, and prints what there is to print.
fn survives(text: &str, overrides: &[String]) {
    let source =
        Source::Text { name: "fuzz.toml".to_owned(), text: text.to_owned(), folder: "tests/inputs/scenes".into() };
    let options = Options { most_particles: 300, ..Options::default() };
    match Scene::load(&source, overrides, &options) {
        Ok(scene) => {
            let particles = scene.particles.len();
            assert!((1..=300).contains(&particles) && scene.steps > 0 && scene.dt > 0.0);
            let covered: u32 = scene.groups.iter().map(|g| g.ids.end - g.ids.start).sum();
            assert_eq!((covered as usize, scene.particles.species().len()), (particles, particles));
            assert!(motes::boundary::check(&scene.bounds).is_ok());
        }
        Err(faults) => {
            let text = faults.to_string();
            assert!(text.starts_with("error: ") && faults.total >= faults.list.len() && !faults.list.is_empty());
            assert!(!text.contains('\u{1b}'), "no control characters");
        }
    }
}

/// A good scene with every section, small enough to be mutated often.
const GOOD: &str = r##"# See.
[simulation]
dt = 0.01
until = 1.5e0
integrator = "leapfrog"
[box]
low = [-9, -9, -9]
size = [1.8e1, 20, 30]
boundary = "reflecting"
x = "open"
dimensions = 3
[[particles]]
shape = "sphere"
count = 12
color = "#ffcc88"
species = 3
[[particles]]
bodies = [{ position = [1, 0, 0], velocity = [0, 1, 0], mass = 0x1F }, { position = [-1.5, 2_0, 0.0] }]
center = [0, 0, 1]
[[particles]]
shape = "lattice"
size = [2, 3, 2]
[[force]]
kind = "gravity"
softening = 0.05
kernel = 'spline'
[[force]]
wgsl = "swirl.wgsl"
over = "each"
params = { strength = 2.0, axis = [0, 0, 1], "on" = true }
[output]
every = 10
formats = ["csv", "npz"] # not these: """ '''
[picture]
width = 64
"##;

/// Pieces that upset parsers.
const PIECES: &[&str] = &[
    "[",
    "]",
    "[[",
    "{",
    "}",
    "\"",
    "'",
    "\"\"\"",
    "=",
    ",",
    ".",
    "\n",
    "#",
    "-",
    "nan",
    "inf",
    "1e999",
    "-0",
    "0x",
    "1979-05-27",
    "99999999999999999999",
    "\\u0000",
    "\u{feff}",
    "\u{202e}",
    "é",
    "日本",
    "\t",
    "\r",
    "\u{0}",
    "a.b.c",
    "[force]",
    "[simulation]\n",
    "count = 4294967295\n",
    "size = [65536, 65536, 2]\n",
    "file = \"../../x\"\n",
    "file = \"/dev/zero\"\n",
    "steps = 1\n",
    "true",
];

fn mutated() -> impl Strategy<Value = String> {
    let change = (any::<Index>(), any::<Index>(), 0..4_u8, any::<Index>(), any::<char>());
    proptest::collection::vec(change, 1..6).prop_map(|changes| {
        let mut text: Vec<char> = GOOD.chars().collect();
        for (at, length, kind, piece, letter) in changes {
            if text.is_empty() {
                break;
            }
            let start = at.index(text.len());
            let end = (start + length.index(20)).min(text.len());
            match kind {
                0 => drop(text.drain(start..end)),
                1 => drop(text.splice(start..end, PIECES[piece.index(PIECES.len())].chars())),
                2 => text[start] = letter,
                _ => {
                    let copy: Vec<char> = text[start..end].to_vec();
                    let to = piece.index(text.len());
                    drop(text.splice(to..to, copy));
                }
            }
        }
        text.into_iter().collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_text(text in "\\PC{0,200}") {
        survives(&text, &[]);
    }

    #[test]
    fn any_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        survives(&String::from_utf8_lossy(&bytes), &[]);
    }

    #[test]
    fn any_pieces(pieces in proptest::collection::vec(proptest::sample::select(PIECES), 0..40)) {
        survives(&pieces.concat(), &[]);
    }

    #[test]
    fn any_mutation(text in mutated()) {
        survives(&text, &[]);
    }

    #[test]
    fn any_override(words in proptest::collection::vec("[a-z0-9]{0,9}|simulation|particles|force|bodies|dt|0|1", 0..10), value in "\\PC{0,20}|[\\[\\]{}0-9=\"',.]{0,12}") {
        survives(GOOD, &[format!("{}={value}", words.join(".")), words.join("="), value]);
    }
}

#[test]
fn the_good_scene_is_good() {
    // Else the mutations would all report the same fault.
    let text = GOOD.replace("[[force]]\nwgsl = \"swirl.wgsl\"\nover = \"each\"\nparams = { strength = 2.0, axis = [0, 0, 1], \"on\" = true }\n", "");
    let source = Source::Text { name: "good.toml".to_owned(), text, folder: ".".into() };
    let scene = Scene::load(&source, &[], &Options::default()).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!((scene.particles.len(), scene.steps), (26, 150));
}

#[test]
fn nothing_nests_or_repeats_too_much() {
    let many = 200_000;
    for text in [
        "[".repeat(many),
        format!("a = {}", "[".repeat(many)),
        format!("a = {}{}", "[".repeat(many), "]".repeat(many)),
        format!("a = {}", "{a=".repeat(many)),
        format!("a{} = 1", ".a".repeat(many)),
        format!("a{} = 1", " . \"a\" ".repeat(many)),
        format!("[a{}]", ".a".repeat(many)),
        format!(
            "[a{0}]\n{1}b = 1{2}",
            ".a".repeat(78),
            format!("a{} = {{", ".a".repeat(78)).repeat(78),
            "}".repeat(78)
        ),
        "=\n".repeat(many),
        "[[force]]\n".repeat(20_000),
        "[a]\n".repeat(20_000),
        "\"".repeat(many),
        format!("\"{}\" = 1", "a".repeat(many)),
    ] {
        survives(&text, &[]);
        survives(GOOD, std::slice::from_ref(&text));
    }
    for builtin in SCENES {
        survives(builtin.text, &[]);
    }
}
