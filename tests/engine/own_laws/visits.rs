//! A law of one's own means the same over every visit.

use std::path::Path;
use std::process::{Command, Output};

/// What two particles do to each other that are near: it names velocities and species, which a search must bring along.
const LAW: &str = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    if species[you.index] == 0u { (*sum).acceleration += 0.1 * (velocity_of(you) - velocity_of(me)) + 0.01 * r; }
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }
";

fn run(folder: &Path, over: &str) -> Output {
    let scene = format!(
        "[simulation]\ndt = 0.01\nsteps = 3\n[box]\nsize = [2, 2, 2]\n[[particles]]\nshape = \"box\"\ncount = 300\n\
         size = [2, 2, 2]\ncenter = [1, 1, 1]\nspeed = 0.5\n[[force]]\nwgsl = \"law.wgsl\"\n{over}\n[output]\nformats = [\"csv\"]\n"
    );
    std::fs::write(folder.join("scene.toml"), scene).expect("written");
    let program = env!("CARGO_BIN_EXE_motes");
    let arguments = ["run", "scene.toml", "-o", "out", "--overwrite", "--backend", "gpu"];
    Command::new(program).args(arguments).current_dir(folder).output().expect("the program runs")
}

#[test]
fn it_runs_over_every_visit_and_means_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("law.wgsl"), LAW).expect("written");
    let mut last = Vec::new();
    for over in ["over = \"within\"\nrange = 0.4", "over = \"near\"\nrange = 0.4", "over = \"nearest\"\nneighbors = 7"]
    {
        let output = run(folder.path(), over);
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{over}: {said}");
        let states = std::fs::read_to_string(folder.path().join("out/snapshot_3.csv")).expect("a state");
        last.push(states);
    }
    let numbers = |text: &str| -> Vec<f64> {
        let row = |line: &str| line.split(',').map(|n| n.parse().expect("a number")).collect::<Vec<f64>>();
        text.lines().skip(1).flat_map(row).collect()
    };
    let (force, grid, few) = (numbers(&last[0]), numbers(&last[1]), numbers(&last[2]));
    // Three steps, each a few units in the last place of numbers up to 2.
    assert!(force.iter().zip(&grid).all(|(a, b)| (a - b).abs() < 3e-6), "through the grid it is another law");
    assert!(force.iter().zip(&few).any(|(a, b)| (a - b).abs() > 1e-4), "the nearest seven are all in range");
}

/// A law over a tree, with a sum of its own and nothing about far groups: they are evaluated as one, at their centre of mass.
const FAR: &str = "struct Sum { pull: vec3f }
fn merge(total: ptr<function, Sum>, part: Sum) { (*total).pull += part.pull; }
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    (*sum).pull += (you.mass / (0.1 + dot(r, r))) * r;
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.pull, 0.0); }
";

#[test]
fn it_runs_over_a_tree_and_means_nearly_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("law.wgsl"), FAR).expect("written");
    let mut last = Vec::new();
    for over in [
        "over = \"pairs\"",
        "over = \"tree\"\ntheta = 0.4",
        "over = \"tree\"\ntheta = 1.0",
        "over = \"auto\"\ntheta = 1.0",
    ] {
        let scene = format!(
            "[simulation]\ndt = 0.1\nsteps = 1\n[[particles]]\nshape = \"sphere\"\ncount = 2000\n[[force]]\n\
             wgsl = \"law.wgsl\"\n{over}\n[output]\nformats = [\"csv\"]\n"
        );
        std::fs::write(folder.path().join("scene.toml"), scene).expect("written");
        let arguments = ["run", "scene.toml", "-o", "out", "--overwrite", "--backend", "gpu"];
        let program = env!("CARGO_BIN_EXE_motes");
        let output = Command::new(program).args(arguments).current_dir(folder.path()).output().expect("it runs");
        assert!(output.status.success(), "{over}: {}", String::from_utf8_lossy(&output.stderr));
        last.push(std::fs::read_to_string(folder.path().join("out/snapshot_1.csv")).expect("a state"));
    }
    let numbers = |text: &str| -> Vec<f64> {
        text.lines().skip(1).flat_map(|line| line.split(',')).map(|n| n.parse().expect("a number")).collect()
    };
    let all: Vec<Vec<f64>> = last.iter().map(|text| numbers(text)).collect();
    let apart = |other: &[f64]| all[0].iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let [fine, coarse, auto] = [1, 2, 3].map(|i| apart(&all[i]));
    // A step of 0.1 under pulls of about 1, of which θ = 0.4 leaves out θ² / 8 or less.
    assert!(fine > 0.0 && fine < 2e-3 && fine < coarse, "{fine} {coarse}");
    assert!(auto == 0.0, "2000 are too few for a tree: {auto}");
}

#[test]
fn a_name_that_nothing_fills_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let law = LAW.replace("species[you.index]", "colour[you.index]");
    let law = format!("@group(3) @binding(1) var<storage, read> colour: array<u32>;\n{law}");
    std::fs::write(folder.path().join("law.wgsl"), law).expect("written");
    let output = run(folder.path(), "over = \"near\"\nrange = 0.4");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.status.success() && said.contains("nothing fills the field `colour`"), "{said}");
}

#[test]
fn a_force_across_the_plane_is_refused_in_two_dimensions() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = |force: &str| {
        format!(
            "[simulation]\ndt = 0.01\nsteps = 3\n[box]\nsize = [2, 2, 0]\n[[particles]]\nshape = \"box\"\ncount = 30\n\
             size = [2, 2, 0]\nspeed = 0.5\n[[force]]\n{force}\n"
        )
    };
    let check = |force: &str| {
        std::fs::write(folder.path().join("flat.toml"), scene(force)).expect("written");
        let program =
            Command::new(env!("CARGO_BIN_EXE_motes")).args(["check", "flat.toml"]).current_dir(folder.path()).output();
        let output = program.expect("the program runs");
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    for force in ["kind = \"goal\"\nposition = [0, 0, 3]", "kind = \"uniform\"\nacceleration = [0, 0, -1]"] {
        let (code, said) = check(force);
        assert!(code == Some(3) && said.contains("accelerates out of the plane"), "{force}: {code:?} {said}");
    }
    assert_eq!(check("kind = \"goal\"\nposition = [0.3, 0.2, 0]").0, Some(0));
}
