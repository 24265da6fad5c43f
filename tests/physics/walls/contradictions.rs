//! Remarks and errors of `motes check` and `run` on inconsistent scenes.

use std::path::Path;
use std::process::Command;

/// A dam, coarse.
const DAM: &str = r#"
[simulation]
dt = 0.001
steps = 3
integrator = "leapfrog"
[box]
size = [2, 1, 0]
boundary = "open"
[[particles]]
shape = "block"
size = [0.5, 0.8, 0]
center = [0.25, 0.4, 0]
[[particles]]
shape = "tank"
size = [2, 1, 0]
center = [1, 0.5, 0]
open = "+y"
[[force]]
kind = "uniform"
acceleration = [0, -9.81, 0]
[[force]]
kind = "fluid"
spacing = 0.1
sound_speed = 40
alpha = 0.1
"#;
const EMITTER: &str = "[[emitter]]\nshape = \"rectangle\"\nsize = [0.2, 0.2, 0]\ndirection = [1, 0, 0]\nspeed = 50\n";

fn motes(command: &str, text: &str, sets: &[&str]) -> (i32, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("dam.toml");
    std::fs::write(&scene, text).expect("a scene");
    let words: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
    let mut all = vec![command, Path::to_str(&scene).expect("a path"), "--backend", "cpu"];
    let output = folder.path().join("out").display().to_string();
    if command == "run" {
        all.extend(["-o", &output]);
    }
    let out = Command::new(env!("CARGO_BIN_EXE_motes")).args(all).args(words).output().expect("motes");
    let text = [out.stdout, out.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    (out.status.code().unwrap_or(-1), text)
}

fn says(text: &str, sets: &[&str], code: i32, words: &[&str]) {
    let (found, said) = motes("check", text, sets);
    assert_eq!(found, code, "{sets:?}: {said}");
    for word in words {
        assert!(said.contains(word), "{sets:?}: no `{word}` in\n{said}");
    }
}

#[test]
fn steps_that_are_too_long_are_remarked_on_or_refused() {
    // 2 / ω of the lattice: 0.945 (0.1 / 40) 2, less what alpha takes.
    says(DAM, &[], 0, &["  steps        dt = 0.001 is 0.2", "of the stability limit by sound, 0.004"]);
    says(DAM, &["simulation.dt=0.0047"], 0, &["note: this run may explode", "the largest dt that is safe is 0.00"]);
    let lost = "this run would explode";
    says(DAM, &["simulation.dt=0.01"], 3, &[lost, "too long for leapfrog and the fluid's speed of sound"]);
    says(DAM, &["force.1.alpha=20"], 3, &[lost, "viscosity (alpha, viscosity)"]);
    says(DAM, &["force.1.viscosity=10"], 3, &[lost, "viscosity (alpha, viscosity)"]);
    says(DAM, &["force.1.xsph=5"], 3, &[lost, "xsph is 2.", "times the stability limit of leapfrog"]);
    says(DAM, &["force.1.tension=60"], 0, &["begins with an acceleration of", "is its tension too strong"]);
    says(DAM, &["force.1.tension=1000"], 0, &["for which dt = 0.001 is too long: choose 3.44e-4"]);
    let (code, said) = motes("run", DAM, &["simulation.dt=0.01"]);
    assert!(code == 3 && said.contains(lost), "{said}");
    let (_, said) = motes("run", DAM, &["simulation.dt=0.0047"]);
    assert!(said.contains("this run may explode"), "{said}");
    // Adaptive steps keep to limits of their own.
    let (code, said) = motes("check", DAM, &["simulation.adaptive=true", "simulation.dt=0.01"]);
    assert!(code == 0 && !said.contains("explode"), "{said}");
}

#[test]
fn numbers_that_single_precision_does_not_hold_are_refused() {
    says(DAM, &["force.1.density=1e38"], 3, &["the square of the density would be 1.0e76", "choose other numbers"]);
    says(DAM, &["force.1.sound_speed=1e20"], 3, &["the square of sound_speed would be 1.0e40"]);
}

#[test]
fn faults_of_a_fluid_stand_where_they_are_mended() {
    for (set, word) in [
        ("force.1.gamma=17", "gamma = 17"),
        ("force.1.support=9", "support = 9"),
        ("force.1.diffusion=0.1", "diffusion = 0.1"),
    ] {
        let (code, said) = motes("check", DAM, &[set]);
        assert!(code == 3 && said.contains(word) && said.contains(&format!("--set {set}")), "{said}");
    }
    let silent = DAM.replace("sound_speed = 40\n", "");
    says(&silent, &[], 3, &["has no sound_speed", "dam.toml:21:1"]);
    let both = format!("{DAM}walls = \"extrapolate\"\nsolver = \"dfsph\"\n");
    says(&both, &[], 3, &["dam.toml:27:10", "^"]);
    let two = format!("{DAM}[[force]]\nkind = \"fluid\"\nspacing = 0.1\nsound_speed = 9\n");
    says(&two, &[], 3, &["there are two fluids of all particles", "dam.toml:26:1"]);
    let walls = DAM.replace("shape = \"block\"", "shape = \"tank\"");
    says(&walls, &[], 3, &["there is a fluid without particles", "dam.toml:21:1"]);
    let (_, said) = motes("check", DAM, &["force.1.spacing=0"]);
    assert_eq!(said.matches("`spacing` must be a number above zero").count(), 1, "{said}");
}

#[test]
fn a_solid_leaves_its_thickness_free() {
    let solid = "[[force]]\nkind = \"solid\"\nshape = \"box\"\nposition = [0.25, -0.05, 0]\nsize = [0.5, 0.1, 1]\nthickness = 0.06\n";
    let text = format!("{DAM}{solid}");
    says(
        &text,
        &[],
        0,
        &[
            "particles start inside of an obstacle, or closer to it than its thickness, the first is particle 0",
            "1.000e-2",
        ],
    );
    let (_, said) = motes("check", &text, &["force.2.thickness=0.05"]);
    assert!(!said.contains("inside of an obstacle"), "{said}");
    // A container that is smaller than what it holds.
    let text = format!(
        "{DAM}{}",
        solid.replace("[0.25, -0.05, 0]", "[0.25, 0.4, 0]").replace("[0.5, 0.1, 1]", "[0.3, 0.3, 1]\ninside = true")
    );
    says(&text, &[], 3, &["this start would explode", "start inside of obstacles or closer than their thickness"]);
}

#[test]
fn density_that_is_hidden_by_continuity_is_remarked_on() {
    let continuity = "force.1.density_by=continuity";
    says(
        DAM,
        &[continuity],
        0,
        &["every density is the rest density, as density_by = \"continuity\" sets it; by summation it is at most 1.0"],
    );
    let two = DAM.replacen(
        "[[particles]]",
        "[[particles]]\nshape = \"block\"\nsize = [0.5, 0.8, 0]\ncenter = [0.3, 0.45, 0]\n[[particles]]",
        1,
    );
    says(&two, &[continuity], 3, &["by summation, which density by continuity does not detect", "two blocks overlap"]);
}

#[test]
fn contradicting_parts_are_remarked_on() {
    says(DAM, &["particles.1.spacing=0.2"], 0, &["[[particles]] has spacing = 0.2, and its fluid has spacing = 0.1"]);
    says(
        DAM,
        &["particles.1.wall_mass=lattice"],
        0,
        &["has wall_mass = \"lattice\", and its fluid has wall_mass = \"sampled\""],
    );
    says(
        DAM,
        &["particles.0.center=[0.25,0.7,0]"],
        0,
        &["particles of the fluid start outside of the box, the first is particle 35 "],
    );
    let extrapolate = ["force.1.walls=extrapolate", "force.1.weight=[0,-1,0]"];
    says(
        DAM,
        &extrapolate,
        0,
        &["the fluid has weight = [0, -1, 0], and forces accelerate all particles by [0, -9.81, 0]"],
    );
    let (_, said) = motes("check", DAM, &["force.1.walls=extrapolate", "force.1.weight=[0,-9.81,0]"]);
    assert!(!said.contains("forces pull"), "{said}");
    let (_, said) = motes("run", DAM, &["particles.0.density=900"]);
    assert!(said.contains("do their spacing and density agree with the force?"), "run says what check does: {said}");
}

#[test]
fn emitters_go_by_the_fluid() {
    let jet = format!("{DAM}{EMITTER}center = [1, 0.5, 0]\n");
    let (code, said) = motes("check", &jet, &[]);
    assert!(code == 0 && said.contains("emitter 1: ") && !said.contains("weigh "), "{said}");
    let heavy = "particles of emitter 1 have mass 2.0000e1, and density × spacing^2 of the force is 1.0000e1";
    says(&jet, &["emitter.0.density=2000"], 0, &[heavy, "[[emitter]] has density = 2000"]);
    says(&jet, &["emitter.0.center=[0.3,0.4,0]"], 0, &["emitter 1 spawns particles where other particles are"]);
}

#[test]
fn a_periodic_box_holds_two_reaches() {
    let text = "[simulation]\ndt = 1e-3\nsteps = 1\n[box]\nsize = [0.6, 0.6, 0.6]\nboundary = \"periodic\"\n[[particles]]\nshape = \"block\"\n\
                size = [0.6, 0.6, 0.6]\n[[force]]\nkind = \"fluid\"\nspacing = 0.1\nsound_speed = 10\nsupport = 3\n";
    says(text, &["particles.0.center=[0.3,0.3,0.3]"], 0, &[]);
    let words = ["the box is periodic along x with a period of 0.6", "make the box at least 0.8"];
    says(text, &["force.0.support=4"], 3, &words);
}

#[test]
fn notes_are_true_of_what_they_are_about() {
    let (_, said) = motes("check", DAM, &["simulation.integrator=linear_backward_euler"]);
    assert!(said.contains("with a limit on dt: `fluid`"), "{said}");
    let order = "`fluid` depends on velocity: leapfrog is of order 2";
    says(DAM, &[], 0, &[order]);
    assert!(!motes("check", DAM, &["force.1.alpha=0"]).1.contains(order));
    for scene in ["hydrostatic", "poiseuille"] {
        let out = Command::new(env!("CARGO_BIN_EXE_motes"))
            .args(["check", scene, "--backend", "cpu"])
            .output()
            .expect("motes");
        let said = String::from_utf8_lossy(&out.stdout).into_owned();
        assert!(said.contains("no faults") && !said.contains("the speed of sound is"), "{said}");
    }
}
