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

/// Ends differ from that of a step sixteen times shorter by c hᵖ, less a part of 16⁻ᵖ.
#[test]
fn ends_converge_with_the_order_of_the_method() {
    for (integrator, order) in [("leapfrog", 2.0), ("rk4", 4.0), ("forward_euler", 1.0)] {
        let (_folder, out) = folder();
        let integrator = format!("simulation.integrator={integrator}");
        let found = json(&[
            "sweep",
            "kepler",
            "--backend",
            "cpu",
            "--until",
            "0.8",
            "--set",
            &integrator,
            "--vary",
            "simulation.dt=0.004,0.002,0.001,0.00025",
            "-o",
            &out,
        ]);
        let got = found["order"].as_f64().expect("an order");
        // With h = 16, 8 and 4 of the last step, the last point is too low by 4⁻ᵖ: for p = 1 a slope that is 0.2 too steep.
        assert!((got - order).abs() < 0.25, "{integrator}: {got}");
        let runs = found["runs"].as_array().expect("runs");
        let steps: Vec<_> = runs.iter().map(|run| run["steps"].as_u64().expect("steps")).collect();
        assert_eq!(steps, [200, 400, 800, 3200]);
        assert!(
            runs[3]["difference_rms"].is_null()
                && runs[0]["difference_rms"].as_f64() > runs[1]["difference_rms"].as_f64()
        );
        let table = std::fs::read_to_string(Path::new(&out).join("sweep.csv")).expect("a table");
        assert!(table.starts_with("simulation.dt,steps,") && table.lines().count() == 5, "{table}");
        assert!(Path::new(&out).join("sweep.svg").is_file());
        assert!(Path::new(&out).join("simulation.dt=0.002").join("energy.csv").is_file());
    }
}

#[test]
fn a_run_that_fails_stands_beside_those_that_do_not() {
    let (_folder, out) = folder();
    let args = |dts: &str| {
        motes(&[
            "sweep",
            "spring_chain",
            "--backend",
            "cpu",
            "--steps",
            "400",
            "--vary",
            &format!("simulation.dt={dts}"),
            "-o",
            &out,
        ])
    };
    let (code, text, words) = args("0.001,50");
    assert_eq!(code, 0, "{words}");
    assert!(text.contains("failed: ") && words.contains("2 of 2"), "{text}{words}");
    let (code, _, words) = motes(&[
        "sweep",
        "spring_chain",
        "--backend",
        "cpu",
        "--steps",
        "400",
        "--vary",
        "simulation.dt=50,60",
        "-o",
        &out,
    ]);
    assert!(code == 3 && words.contains("no run came to its end"), "{code}: {words}");
    // Results are not replaced without a word.
    let (_, text, _) = args("0.001,0.0005");
    assert!(text.contains("--overwrite"), "{text}");
}

#[test]
fn several_adapters_share_the_runs() {
    let (_folder, out) = folder();
    let found = json(&[
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
        "--adapters",
        "0,0",
        "-o",
        &out,
    ]);
    assert_eq!((found["device"].as_array().map(Vec::len), found["runs"].as_array().map(Vec::len)), (Some(2), Some(6)));
    let seeds: Vec<_> =
        found["runs"].as_array().expect("runs").iter().map(|run| run["set"]["particles.0.seed"].as_str()).collect();
    assert_eq!(seeds, ["1", "1", "2", "2", "3", "3"].map(Some));
    // One of them alone gives the same numbers.
    let (_second, other) = folder();
    let alone = json(&[
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
        "-o",
        &other,
    ]);
    let energies = |value: &serde_json::Value| -> Vec<f64> {
        value["runs"].as_array().expect("runs").iter().filter_map(|run| run["energy_error"].as_f64()).collect()
    };
    assert_eq!(energies(&found), energies(&alone));
}

#[test]
fn wrong_lists_are_refused_before_anything_runs() {
    let (_folder, out) = folder();
    for (vary, why) in [
        ("simulation.dt", "there is no `=`"),
        ("simulation.dt=0.1,,0.2", "a value is empty"),
        ("simulation.dt=0.1,0.1", "0.1 is there twice"),
        ("simulation.dt=0.1,-1", "`dt` must be a number above zero"),
        ("force.0.softness=1,2", "softness"),
    ] {
        let (code, _, words) = motes(&["sweep", "plummer", "--vary", vary, "-o", &out]);
        assert!(code == 3 && words.contains(why), "{vary}: {code}: {words}");
    }
    let (code, _, words) =
        motes(&["sweep", "kepler", "--vary", "simulation.dt=1,2", "--vary", "simulation.dt=3", "-o", &out]);
    assert!(code == 3 && words.contains("twice"), "{words}");
    let many: Vec<String> = (1..=101).map(|n| n.to_string()).collect();
    let seeds = |place: usize| format!("particles.{place}.seed={}", many.join(","));
    let (code, _, words) = motes(&["sweep", "merger", "--vary", &seeds(0), "--vary", &seeds(1), "-o", &out]);
    assert!(code == 3 && words.contains("10201 combinations"), "{words}");
    assert_eq!(motes(&["sweep", "kepler", "-o", &out]).0, 2);
    assert!(!Path::new(&out).exists());
}
