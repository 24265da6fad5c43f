//! `motes sweep`: errors that fall as the order of the method, failures beside what runs, several adapters, and wrong arguments.

use std::path::Path;
use std::process::Command;

fn motes(args: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_motes")).args(args).output().expect("the program starts");
    let text = |bytes| String::from_utf8(bytes).expect("output is UTF-8");
    (output.status.code().unwrap_or(-1), text(output.stdout), text(output.stderr))
}

fn folder() -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out").to_str().expect("a path of words").to_owned();
    (folder, out)
}

fn json(args: &[&str]) -> serde_json::Value {
    let (code, text, words) = motes(&[args, &["--json"]].concat());
    assert_eq!(code, 0, "{words}");
    serde_json::from_str(&text).unwrap_or_else(|why| panic!("{why}: {text}"))
}

/// Ends differ from that of a step sixteen times shorter by c hᵖ, less a part of 16⁻ᵖ. Steps that do not divide the way are those
/// that are made: 0.0041 is 0.8 / 196.
#[test]
fn ends_converge_with_the_order_of_the_method() {
    for (integrator, order) in [("leapfrog", 2.0), ("rk4", 4.0), ("forward_euler", 1.0)] {
        let (_folder, out) = folder();
        let integrator = format!("simulation.integrator={integrator}");
        let sweep = |dts: &str, more: &[&str]| {
            let dts = format!("simulation.dt={dts}");
            let args = [
                "sweep",
                "kepler",
                "--backend",
                "cpu",
                "--until",
                "0.8",
                "--set",
                &integrator,
                "--vary",
                &dts,
                "-o",
                &out,
            ];
            json(&[&args, more].concat())
        };
        let found = sweep("0.0041,0.002,0.001,0.00025", &[]);
        let got = found["order"].as_f64().expect("an order");
        // With h = 16, 8 and 4 of the last step, the last point is too low by 4⁻ᵖ: for p = 1 a slope that is 0.2 too steep.
        assert!((got - order).abs() < 0.25, "{integrator}: {got}");
        let runs = found["runs"].as_array().expect("runs");
        let steps: Vec<_> = runs.iter().map(|run| run["steps"].as_u64().expect("steps")).collect();
        assert_eq!(steps, [196, 400, 800, 3200]);
        assert!((runs[0]["dt"].as_f64().expect("a step") - 0.8 / 196.0).abs() < 1e-12);
        assert!(runs[3]["difference_rms"].is_null());
        assert!(runs[0]["difference_rms"].as_f64() > runs[1]["difference_rms"].as_f64());
        let table = std::fs::read_to_string(Path::new(&out).join("sweep.csv")).expect("a table");
        assert!(table.starts_with("simulation.dt,steps,dt,") && table.lines().count() == 5, "{table}");
        assert!(Path::new(&out).join("sweep.svg").is_file());
        assert!(Path::new(&out).join("2_simulation.dt=0.002").join("energy.csv").is_file());
        // The coarsest run is no measure of the others, and a plot of another sweep does not stay.
        let found = sweep("0.001,0.002,0.0041", &["--overwrite", "--vary", "simulation.integrator=heun,rk4"]);
        assert!(found["order"].is_null() && !Path::new(&out).join("sweep.svg").exists());
        let found = sweep("0.00025,0.001,0.002,0.0041", &["--overwrite"]);
        assert!(found["order"].is_null(), "{found}");
    }
}

/// Positions differ by the displacement to the nearest image: particles that cross a side stay near themselves.
#[test]
fn ends_in_a_periodic_box_are_compared_with_the_nearest_image() {
    let (folder, out) = folder();
    let scene = folder.path().join("box.toml");
    let text = "[simulation]\ndt = 0.25\nuntil = 1\nintegrator = \"forward_euler\"\n[box]\nlow = [0, 0, 0]\nsize = [1, 1, 1]\n\
                boundary = \"periodic\"\n[[particles]]\nbodies = [{ position = [0.5, 0.5, 0.5], velocity = [0.49, 0, 0] }]\n\
                [[force]]\nkind = \"uniform\"\nacceleration = [0.04, 0, 0]\n";
    std::fs::write(&scene, text).expect("written");
    let scene = scene.to_str().expect("a path of words");
    let found =
        json(&["sweep", scene, "--backend", "cpu", "--vary", "simulation.dt=0.25,0.125,0.0625,0.015625", "-o", &out]);
    // By forward Euler x = 0.5 + 0.49 + 0.02 (1 − h): on both sides of the face at 1.
    for run in found["runs"].as_array().expect("runs").iter().take(3) {
        let (dt, got) = (run["dt"].as_f64().expect("a step"), run["difference_rms"].as_f64().expect("a difference"));
        assert!((got - 0.02 * (dt - 0.015625)).abs() < 1e-12, "{run}");
    }
}

#[test]
fn a_run_that_fails_stands_beside_those_that_do_not() {
    let (_folder, out) = folder();
    let args = |dts: &str, more: &[&str]| {
        let dts = format!("simulation.dt={dts}");
        motes(
            &[&["sweep", "spring_chain", "--backend", "cpu", "--steps", "400", "--vary", &dts, "-o", &out], more]
                .concat(),
        )
    };
    let (code, text, words) = args("0.001,50", &[]);
    assert_eq!(code, 0, "{words}");
    assert!(
        text.contains("failed: ") && words.contains("2 of 2") && words.contains("note: simulation.dt=50: "),
        "{text}{words}"
    );
    // Results are not replaced silently.
    let before = std::fs::read(Path::new(&out).join("sweep.csv")).expect("a table");
    let (code, _, words) = args("0.001,0.0005", &[]);
    assert!(code == 8 && words.contains("--overwrite"), "{code}: {words}");
    assert_eq!(std::fs::read(Path::new(&out).join("sweep.csv")).expect("a table"), before);
    // Where all fail, the sweep fails as the first of them.
    let (code, text, words) = args("50,60", &["--overwrite", "--quiet"]);
    assert!(code == 6 && text.is_empty() && words.starts_with("error: "), "{code}: {text}{words}");
}

/// As many steps as springs ask for, of the length that is varied.
#[test]
fn substeps_are_of_the_varied_step() {
    let (_folder, out) = folder();
    let found = json(&[
        "sweep",
        "spring_chain",
        "--backend",
        "cpu",
        "--until",
        "2",
        "--auto-substeps",
        "--vary",
        "simulation.dt=0.4,0.001",
        "-o",
        &out,
    ]);
    for run in found["runs"].as_array().expect("runs") {
        let time = run["dt"].as_f64().expect("a step") * run["steps"].as_u64().expect("steps") as f64;
        assert!((time - 2.0).abs() < 1e-9 && run["error"].is_null(), "{run}");
    }
}

#[test]
fn several_adapters_share_the_runs() {
    let (_folder, out) = folder();
    let args = [
        "sweep",
        "plummer",
        "--set",
        "particles.0.count=200",
        "--steps",
        "5",
        "--vary",
        "particles.0.seed=1,2,3",
        "--vary",
        "force.0.softening=0.1,0.2",
    ];
    let found = json(&[&args[..], &["--adapters", "0,0", "-o", &out]].concat());
    assert_eq!((found["device"].as_array().map(Vec::len), found["runs"].as_array().map(Vec::len)), (Some(2), Some(6)));
    let seeds: Vec<_> =
        found["runs"].as_array().expect("runs").iter().map(|run| run["set"]["particles.0.seed"].as_str()).collect();
    assert_eq!(seeds, ["1", "1", "2", "2", "3", "3"].map(Some));
    // One of them alone gives the same numbers.
    let (_second, other) = folder();
    let alone = json(&[&args[..], &["-o", &other]].concat());
    let energies = |value: &serde_json::Value| -> Vec<f64> {
        value["runs"]
            .as_array()
            .expect("runs")
            .iter()
            .map(|run| run["energy_error"].as_f64().expect("an error"))
            .collect()
    };
    assert_eq!(energies(&found), energies(&alone));
}

/// What a stop leaves is named.
#[test]
fn a_sweep_that_is_stopped_names_the_run_to_go_on_with() {
    let (_folder, out) = folder();
    let (code, _, words) = motes(&[
        "sweep",
        "plummer",
        "--scale",
        "0.01",
        "--backend",
        "cpu",
        "--steps",
        "100000",
        "--max-hours",
        "1e-4",
        "--vary",
        "particles.0.seed=1,2",
        "-o",
        &out,
    ]);
    assert!(code == 75 && words.contains("motes resume") && words.contains("1_particles.0.seed=1"), "{code}: {words}");
}

#[test]
fn wrong_lists_are_refused_before_anything_runs() {
    let (_folder, out) = folder();
    for (vary, why) in [
        ("simulation.dt", "there is no `=`"),
        ("simulation.dt=0.1,,0.2", "a value is empty"),
        ("simulation.dt=0.1,0.10", "0.10 is there twice"),
        ("simulation.dt=0.1,-1", "`dt` must be a number above zero"),
        ("force.0.softness=1,2", "softness"),
    ] {
        let (code, _, words) = motes(&["sweep", "plummer", "--vary", vary, "-o", &out]);
        assert!(code == 3 && words.contains(why), "{vary}: {code}: {words}");
    }
    let (code, _, words) =
        motes(&["sweep", "kepler", "--vary", "simulation.dt=1,2", "--vary", "simulation.dt=3", "-o", &out]);
    assert!(code == 3 && words.contains("twice"), "{words}");
    let (code, _, words) = motes(&["sweep", "kepler", "--until", "1", "--vary", "simulation.until=1,2", "-o", &out]);
    assert!(code == 3 && words.contains("leave one of them"), "{words}");
    let many = |key: &str| format!("{key}={}", (1..=60).map(|n| n.to_string()).collect::<Vec<_>>().join(","));
    let lists = ["a.a", "a.b", "a.c", "a.d"].map(many);
    let vary = lists.iter().flat_map(|list| ["--vary", list.as_str()]);
    let args: Vec<&str> = ["sweep", "merger", "-o", &out].into_iter().chain(vary).collect();
    let (code, _, words) = motes(&args);
    assert!(code == 3 && words.contains("12960000 combinations"), "{words}");
    assert_eq!(motes(&["sweep", "kepler", "-o", &out]).0, 2);
    assert!(!Path::new(&out).exists());
}
