//! What is said of numbers: those that single precision loses, and how energies went.

use crate::process::{Place, motes, output};

fn body(position: &str, velocity: &str) -> String {
    format!("[[particles]]\nbodies = [{{ position = {position}, velocity = {velocity} }}]\n")
}

fn scene(dt: &str, steps: u32, rest: &str) -> String {
    format!("[simulation]\ndt = {dt}\nsteps = {steps}\n{rest}\n[output]\nformats = [\"csv\"]\n")
}

fn said(text: &str, args: &[&str]) -> String {
    let place = Place::with(&[("a.toml", text)]);
    let (scene, out) = (place.at("a.toml"), place.at("out"));
    let more = if args[0] == "run" { &["-o", out.as_str()][..] } else { &[] };
    let (code, stdout, stderr) = output(&mut motes(&[&[args[0], &scene], &args[1..], more].concat()));
    assert_eq!(code, 0, "{stderr}");
    stdout + &stderr
}

/// One body at x = 1000 with v = 1 stays where it is on the device in steps of 1e-5: numbers there are 6.1e-5 apart.
#[test]
fn a_motion_below_single_precision_is_remarked_on() {
    let words = "move less in a step than the last place of single precision";
    let lost = scene("1e-5", 10, &body("[1000, 0, 0]", "[1, 0, 0]"));
    for command in ["check", "run"] {
        let output = said(&lost, &[command]);
        assert!(
            output.contains(words) && output.contains("|v| dt = 1.0e-5") && output.contains("6.1e-5 apart"),
            "{output}"
        );
    }
    assert!(!said(&lost, &["check", "--backend", "cpu"]).contains(words), "f64 holds it");
    for (dt, position, velocity) in [
        ("1e-3", "[1000, 0, 0]", "[1, 0, 0]"),
        ("1e-5", "[1, 0, 0]", "[1, 0, 0]"),
        ("1e-5", "[1000, 0, 0]", "[0, 0, 0]"),
        ("1e-5", "[1000, 0, 0]", "[0, 1, 0]"),
    ] {
        let output = said(&scene(dt, 10, &body(position, velocity)), &["check"]);
        assert!(!output.contains(words), "{dt} {position} {velocity}: {output}");
    }
}

#[test]
fn a_softening_below_single_precision_is_remarked_on() {
    let words = "the softening 0.05 of `gravity` is";
    let at = |x: &str| {
        let sphere = format!("[[particles]]\nshape = \"plummer\"\ncount = 20\ncenter = [{x}, 0, 0]\n");
        said(&scene("0.01", 2, &format!("{sphere}[[force]]\nkind = \"gravity\"\nsoftening = 0.05\n")), &["check"])
    };
    // Numbers at 10^4 are 9.8e-4 apart, a fiftieth of the softening.
    let output = at("1e4");
    assert!(output.contains(words) && output.contains("off by up to 2 %"), "{output}");
    assert!(!at("0").contains(words));
}

#[test]
fn a_box_crossed_many_times_in_a_step_is_remarked_on() {
    let space = "[box]\nsize = [1, 1, 1]\n";
    let fast = |v: &str| {
        said(&scene("0.01", 2, &(space.to_owned() + &body("[0.5, 0.5, 0.5]", v))), &["check", "--backend", "cpu"])
    };
    assert!(
        fast("[1e10, 0, 0]")
            .contains("particles cross the periodic box in a step, the first is particle 0, 100000000.0 times")
    );
    assert!(!fast("[50, 0, 0]").contains("cross the periodic box"));
}

/// What the device cannot hold ends a run on both backends alike.
#[test]
fn beyond_single_precision_both_backends_end() {
    let near = "[[particles]]\nbodies = [{ position = [0, 0, 0] }, { position = [1e-25, 0, 0] }]\n[[force]]\nkind = \"gravity\"\n";
    for text in [scene("0.01", 3, near), scene("1e30", 2, &body("[0, 0, 0]", "[1e30, 0, 0]"))] {
        for backend in ["cpu", "gpu"] {
            let place = Place::with(&[("a.toml", &text)]);
            let args = ["run", &place.at("a.toml"), "-o", &place.at("out"), "--backend", backend];
            let (code, _, stderr) = output(&mut motes(&args));
            assert!(code == 6 && stderr.contains("stopped being finite in step 0"), "{backend}: {code} {stderr}");
        }
    }
}

/// A pendulum begins and ends where it is slow: the largest kinetic energy is in between.
#[test]
fn errors_of_energy_are_relative_to_its_maximum() {
    let change = |sets: &[&str]| -> f64 {
        let place = Place::with(&[]);
        let sets: Vec<&str> = sets.iter().flat_map(|set| ["--set", *set]).collect();
        let out = place.at("out");
        let args =
            [&["run", "pendulum", "-o", &out, "--backend", "cpu", "--set", "output.formats=[\"csv\"]"][..], &sets];
        let (code, stdout, stderr) = output(&mut motes(&args.concat()));
        assert_eq!(code, 0, "{stderr}");
        let (before, _) = stdout.split_once(" of the largest kinetic energy").unwrap_or_else(|| panic!("{stdout}"));
        before.rsplit(' ').next().and_then(|word| word.parse().ok()).unwrap_or_else(|| panic!("{stdout}"))
    };
    let often = change(&["simulation.dt=0.01", "simulation.integrator=forward_euler", "output.every=1"]);
    let seldom = change(&["simulation.dt=0.01", "simulation.integrator=forward_euler", "output.every=100000"]);
    // One look in 20 steps misses the largest by less than a tenth.
    assert!(often.abs() < 1.0 && (seldom / often - 1.0).abs() < 0.1, "{often} {seldom}");
}

/// An ellipse is measured at its two ends alone, where leapfrog has its energy back: what it loses and gains on the way is reported, too.
#[test]
fn the_largest_energy_error_is_that_of_the_way() {
    let place = Place::with(&[]);
    let out = place.at("out");
    let sets = ["simulation.integrator=leapfrog", "simulation.dt=0.02", "output.every=100000", "output.formats=[]"];
    let sets: Vec<&str> = sets.iter().flat_map(|set| ["--set", *set]).collect();
    let args = [&["run", "kepler", "-o", &out, "--backend", "cpu", "--until", "6.283185307179586"][..], &sets].concat();
    let (code, stdout, stderr) = output(&mut motes(&args));
    assert_eq!(code, 0, "{stderr}");
    let number = |after: &str| -> f64 {
        let (_, rest) = stdout.split_once(after).unwrap_or_else(|| panic!("{stdout}"));
        rest.split([' ', ',']).next().and_then(|word| word.parse().ok()).unwrap_or_else(|| panic!("{stdout}"))
    };
    let (end, most) = (number(", error ").abs(), number(", at most "));
    assert!(most > 3.0 * end && most < 0.1, "{end} {most}");
}

/// Where there is no energy there is nothing to relate its change to.
#[test]
fn a_body_at_rest_has_an_energy_that_is_a_number() {
    let text = scene("0.01", 40, &body("[0, 0, 0]", "[0, 0, 0]"));
    let said = said(&text, &["run", "--backend", "cpu"]);
    assert!(said.contains("at most 0.0e0 in") && !said.contains("NaN"), "{said}");
}

/// Rods follow their pins at once: a motion that jumps throws them.
#[test]
fn a_jump_of_a_motion_on_rods_is_remarked_on() {
    let words = "jumps in velocity by";
    let hair = |smooth: bool, dt: &str| {
        let text = format!(
            "[simulation]\ndt = {dt}\nsteps = 400\n[[motion]]\nname = \"head\"\nsmooth = {smooth}\nkeys = [{{ time = 0 }}, \
             {{ time = 0.2, shift = [0, 0, 0.05] }}, {{ time = 0.4, shift = [0.2, 0, 0.05] }}, {{ time = 0.5 }}]\n[[particles]]\n\
             shape = \"hair\"\nstrands = 3\nmotion = \"head\"\n[[force]]\nkind = \"rod\"\n[output]\nformats = []\n"
        );
        said(&text, &["check", "--backend", "cpu"])
    };
    let output = hair(false, "0.0035");
    assert!(output.contains(words) && output.contains("\"head\"") && output.contains("smooth = true"), "{output}");
    assert!(!hair(true, "0.0035").contains(words));
    assert!(!hair(false, "0.0001").contains(words));
}

/// A weight that is the same everywhere limits no step, and rounding is no weight.
#[test]
fn remarks_do_not_mislead() {
    let spring = "[[particles]]\nshape = \"chain\"\ncount = 3\npins = \"first\"\n[[force]]\nkind = \"spring\"\n[[force]]\nkind = \"uniform\"\n\
                  acceleration = [0, 0, -9.81]\n[[force]]\nkind = \"attractor\"\n";
    let output = said(&scene("0.001\nintegrator = \"backward_euler\"", 2, spring), &["check", "--backend", "cpu"]);
    assert!(output.contains("with a limit on dt: `attractor`; constant: `uniform`"), "{output}");
    let drop = "[box]\nsize = [4, 4, 0]\nboundary = \"open\"\n[[particles]]\nshape = \"drop\"\nsize = [0.5, 0.5, 0]\ncenter = [2, 2, 0]\n\
                [[force]]\nkind = \"attractor\"\nprofile = \"harmonic\"\nposition = [2, 2, 0]\nstrength = 1\n\
                [[force]]\nkind = \"fluid\"\nspacing = 0.1\nsound_speed = 9\ndensity_by = \"continuity\"\ndiffusion = 0.1\n";
    let output = said(&scene("0.001", 2, drop), &["check", "--backend", "cpu"]);
    assert!(!output.contains("the fluid has weight"), "{output}");
    let pulled = drop.replace("position = [2, 2, 0]", "position = [2, 1, 0]");
    let output = said(&scene("0.001", 2, &pulled), &["check", "--backend", "cpu"]);
    assert!(output.contains("the fluid has weight"), "{output}");
}
