//! The command and stiff springs: warnings before, division of steps, what is reported and kept when numbers are lost, and the
//! picture of all integrators.

use std::path::Path;
use std::process::Command;

fn motes(args: &[&str]) -> (i32, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_motes")).args(args).output().expect("the program starts");
    let text = [output.stdout, output.stderr].concat();
    (output.status.code().unwrap_or(-1), String::from_utf8(text).expect("output is UTF-8"))
}

/// Four in a row, the last of half the mass, on springs of ω² = 1000.
const CHAIN: &str = "[simulation]\ndt = 0.1\nsteps = 200\n[output]\nevery = 20\nformats = [\"csv\"]\n[[particles]]\nbodies = [\
    { position = [0, 0, 0], mass = 1 }, { position = [1, 0, 0], mass = 1 }, { position = [2.1, 0, 0], mass = 1 }, \
    { position = [3, 0.1, 0], mass = 0.5 }]\n[[links]]\npairs = [[0, 1], [1, 2], [2, 3]]\nstiffness = 1000\ndamping = 1\n\
    [[force]]\nkind = \"spring\"\n";

struct Folder(tempfile::TempDir);

impl Folder {
    fn with_chain() -> (Self, String) {
        let folder = Self(tempfile::tempdir().expect("a folder"));
        let scene = folder.path("chain.toml");
        std::fs::write(&scene, CHAIN).expect("written");
        (folder, scene)
    }
    fn path(&self, name: &str) -> String {
        self.0.path().join(name).to_str().expect("a path of words").to_owned()
    }
}

#[test]
fn a_check_warns_of_steps_that_springs_do_not_bear() {
    let (_folder, scene) = Folder::with_chain();
    let check = |set: &[&str]| {
        let (code, words) = motes(&[&["check", &scene, "--backend", "cpu"], set].concat());
        assert_eq!(code, 0, "{words}");
        words
    };
    let words = check(&[]);
    // Particle 2: 1000 (1 + 1) of one spring, 1000 (1 + √2) of the other; leapfrog's limit by that and by the damping.
    for said in ["will explode", "spring 2–3", "particle 2", "stiffness 1000", "leapfrog", "safe is 0.0291", "(4 steps"]
    {
        assert!(words.contains(said), "no {said} in\n{words}");
    }
    // Between the bound and what the chain has: 0.0291 and about 0.032.
    let words = check(&["--set", "simulation.dt=0.0295"]);
    assert!(words.contains("may explode"), "{words}");
    let words = check(&["--set", "simulation.dt=0.029"]);
    assert!(!words.contains("explode"), "{words}");
    // Strong damping binds first.
    let words = check(&["--set", "links.0.damping=1000"]);
    assert!(words.contains("the damping of the springs"), "{words}");
    let words = check(&["--auto-substeps"]);
    assert!(
        words.contains("800 steps of 0.025") && words.contains("4 steps of") && !words.contains("explode"),
        "{words}"
    );
    let words = check(&["--auto-substeps", "--set", "simulation.dt=0.01"]);
    assert!(words.contains("dt = 0.01 is safe") && words.contains("200 steps of 0.01"), "{words}");
    // What neither gains nor loses by itself is not helped by damping that there is not.
    let undamped = ["--set", "links.0.damping=0", "--set", "simulation.integrator=forward_euler"];
    assert!(check(&undamped).contains("will explode"));
    let (code, words) = motes(&["check", "throw", "--auto-substeps", "--backend", "cpu"]);
    assert!(code == 0 && words.contains("there are none: dt is unchanged"), "{words}");
}

#[test]
fn lost_numbers_leave_neighbors_advice_and_the_last_good_state() {
    let (folder, scene) = Folder::with_chain();
    for (formats, file) in [("[\"csv\"]", "last_good.csv"), ("[\"npz\"]", "last_good.npz"), ("[]", "last_good.npz")] {
        let out = folder.path(file);
        let set = format!("output.formats={formats}");
        let (code, words) = motes(&["run", &scene, "-o", &out, "--overwrite", "--backend", "cpu", "--set", &set]);
        assert_eq!(code, 6, "{words}");
        for said in [
            "stopped being finite",
            "it is linked to",
            "safe is 0.0291",
            "--auto-substeps",
            "last good state, after step",
            file,
        ] {
            assert!(words.contains(said), "no {said} in\n{words}");
        }
        assert!(Path::new(&out).join(file).exists(), "{file}");
    }
    let out = folder.path("last_good.csv");
    let kept = std::fs::read_to_string(Path::new(&out).join("last_good.csv")).expect("a state");
    assert!(kept.lines().count() == 5 && !kept.contains("NaN") && !kept.contains("inf"), "{kept}");
    // A little too long: the run ends where numbers leave single precision, which here is before speeds have doubled eight times
    // in a row (`tests/physics/runaway.rs` has those that do).
    let out = folder.path("slow");
    let (code, words) = motes(&[
        "run",
        &scene,
        "-o",
        &out,
        "--backend",
        "cpu",
        "--set",
        "simulation.dt=0.0345",
        "--json",
        "--steps",
        "2000",
    ]);
    let ended = words.contains("is running away in step") || words.contains("stopped being finite in step");
    assert!(code == 6 && ended && words.contains("\"more\":"), "{words}");
}

#[test]
fn divided_steps_are_run_and_written_down() {
    let (folder, scene) = Folder::with_chain();
    let out = folder.path("out");
    let (code, words) = motes(&["run", &scene, "-o", &out, "--backend", "cpu", "--auto-substeps", "--until", "4"]);
    assert!(code == 0 && words.contains("4 steps of 2.5e-2 in place of one of 0.1"), "{words}");
    let text = std::fs::read_to_string(Path::new(&out).join("scene.toml")).expect("a scene");
    for said in ["dt = 0.025", "steps = 160", "every = 80"] {
        assert!(text.contains(said), "no {said} in\n{text}");
    }
    let (code, words) = motes(&["run", &format!("{out}/scene.toml"), "-o", &folder.path("again"), "--backend", "cpu"]);
    assert!(code == 0 && !words.contains("explode"), "{words}");
}

/// Device and references measure what theory says, to the digits that are shown, under every integrator.
#[test]
fn the_picture_of_all_integrators() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("s.svg");
    let path = file.to_str().expect("a path of words");
    for backend in ["cpu", "gpu"] {
        for (y, z) in [("1", "2.5"), ("0.5", "0.7"), ("1.5", "4")] {
            let args =
                ["stability", "--backend", backend, "--omega-step", y, "--decay-step", z, "--steps", "12", "-o", path];
            let (code, words) = motes(&args);
            assert_eq!(code, 0, "{words}");
            // A method with a column of its own is no map of x and v alone: there is no theory of one step to hold it to.
            let maps = motes::integrators::INTEGRATORS.iter().filter(|entry| entry.by_default().columns().is_empty());
            assert!(maps.clone().count() >= 14);
            for entry in maps {
                let row = words.lines().find(|line| line.split_whitespace().next() == Some(entry.name));
                let row: Vec<&str> =
                    row.unwrap_or_else(|| panic!("no {} in\n{words}", entry.name)).split_whitespace().collect();
                for (got, want) in [(row[1], row[2]), (row[4], row[5])] {
                    let (got, want): (f64, f64) = (got.parse().expect("a number"), want.parse().expect("a number"));
                    // Single precision: a dozen roundings, which a double eigenvalue may show the root of.
                    let allowed = if backend == "gpu" { 1e-3 } else { 2e-6 };
                    assert!(
                        (got - want).abs() <= allowed * want.max(1.0),
                        "{} on {backend}, {y}, {z}: {row:?}",
                        entry.name
                    );
                }
            }
            let svg = std::fs::read_to_string(&file).expect("a picture");
            assert!(svg.ends_with("</svg>\n") && svg.contains("forward_euler") && !svg.contains("NaN"));
            std::fs::remove_file(&file).expect("written anew each time");
        }
    }
    let (code, words) = motes(&["stability", "--omega-step", "0"]);
    assert!(code == 2 && words.contains("above 0"), "{words}");
}
