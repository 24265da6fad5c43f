//! The command and links: what is remarked on, what is said to be kept, and which keys are listed.

use std::path::Path;
use std::process::Command;

fn motes(args: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_motes")).args(args).output().expect("the program starts");
    let text = String::from_utf8([output.stdout, output.stderr].concat()).expect("output is UTF-8");
    assert!(output.status.success(), "motes {args:?}\n{text}");
    text
}

/// A scene of some particles and forces, whose path lives as long as the folder.
fn scene(folder: &Path, particles: &str, forces: &str) -> String {
    let path = folder.join("scene.toml");
    let text = format!(
        "[simulation]\ndt = 0.01\nsteps = 20\n[output]\nformats = [\"csv\"]\n[[particles]]\n{particles}\n{forces}"
    );
    std::fs::write(&path, text).expect("written");
    path.to_str().expect("a path of words").to_owned()
}

const CHAIN: &str = "shape = \"chain\"\ncount = 4\nstiffness = 9\nvelocity = [0.1, 0, 0]";
const SPRING: &str = "[[force]]\nkind = \"spring\"\n";

#[test]
fn springs_depend_on_velocity_where_they_are_damped() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = scene(folder.path(), CHAIN, SPRING);
    let out = folder.path().join("out").to_str().expect("a path of words").to_owned();
    let damped = ["--set", "particles.0.damping=0.5"];
    for (set, damped) in [(&[][..], false), (&damped[..], true)] {
        let words = motes(&[&["check", &path, "--backend", "cpu"], set].concat());
        assert_eq!(words.contains("`spring` depends on velocity: leapfrog is of order 2"), damped, "{words}");
        assert!(!words.contains("no force acts on"), "{words}");
        let words = motes(&[&["run", &path, "-o", &out, "--overwrite", "--backend", "cpu"], set].concat());
        assert_eq!(words.contains("not conserved"), damped, "{words}");
        assert_eq!(words.contains(", error "), !damped, "{words}");
        assert!(words.contains("momentum changed by"), "{words}");
    }
    // A spring that breaks takes its energy, and no momentum.
    let path = scene(folder.path(), CHAIN, &(SPRING.to_owned() + "[[force]]\nkind = \"tear\"\n"));
    let words = motes(&["run", &path, "-o", &out, "--overwrite", "--backend", "cpu"]);
    assert!(words.contains("not conserved") && words.contains("momentum changed by"), "{words}");
}

#[test]
fn what_is_tied_and_does_nothing_is_remarked_on() {
    let folder = tempfile::tempdir().expect("a folder");
    let springs = "no force acts on the springs (3 of them); add a [[force]] of kind = \"spring\"";
    let joints = "no force acts on the joints (2 of them); add a [[force]] of kind = \"joint\"";
    let bent = CHAIN.to_owned() + "\nbending = 0.3";
    let joint = "[[force]]\nkind = \"joint\"\n";
    let sheet = "shape = \"cloth\"\ncolumns = 3\nrows = 3\nstretch = 0\nshear = 0\nbend = 0";
    for (particles, forces, idle) in [
        (CHAIN, "", &[springs][..]),
        (CHAIN, SPRING, &[]),
        (&bent, SPRING, &[joints]),
        (&bent, joint, &[springs]),
        (&bent, "[[force]]\nkind = \"uniform\"\n", &[springs, joints]),
        // A cloth without springs still has triangles, which pictures show.
        (sheet, "", &[]),
    ] {
        let words = motes(&["check", &scene(folder.path(), particles, forces), "--backend", "cpu"]);
        assert_eq!(words.matches("no force acts on").count(), idle.len(), "{particles}\n{forces}\n{words}");
        assert!(idle.iter().all(|remark| words.contains(remark)), "{particles}\n{forces}\n{words}");
    }
}

#[test]
fn the_keys_of_new_sections_are_listed() {
    for (section, keys) in [
        ("solver", &["tolerance", "0.001", "iterations", "solves"][..]),
        ("motion", &["about", "smooth", "repeat", "shift", "turn"]),
        ("links", &["tie", "rest", "stiffness", "damping"]),
    ] {
        let words = motes(&["scenes", "--keys", section]);
        assert!(words.starts_with(&format!("section = \"{section}\": ")), "{words}");
        assert!(keys.iter().all(|key| words.contains(key)), "{keys:?}\n{words}");
    }
}

/// A kernel that no step runs is in no plan.
#[test]
fn kernels_that_nothing_runs_are_not_explained() {
    let words = motes(&["explain", "pendulum", "--backend", "cpu"]);
    let step = words.lines().find_map(|line| line.strip_prefix("step:  ")).expect("a plan");
    let explained: Vec<_> =
        words.lines().zip(words.lines().skip(1)).filter(|(_, next)| next.starts_with("    from ")).collect();
    assert!(explained.len() > 3, "{words}");
    for (name, _) in explained {
        assert!(step.split(" | ").any(|run| run == name), "`{name}` is not in `{step}`");
    }
}
