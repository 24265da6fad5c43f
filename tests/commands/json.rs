//! `--json`: what programs read, of every command and of every error; `--scale`; and `explain --law`.

use std::process::{Command, Stdio};

use serde_json::Value;

/// Exit code, standard output and standard error.
fn motes(args: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
    let output = command.args(args).env_remove("WGPU_ADAPTER_NAME").stdin(Stdio::null()).output().expect("it starts");
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    (output.status.code().unwrap_or(-1), text(output.stdout), text(output.stderr))
}

/// The one document that a command prints.
fn document(args: &[&str]) -> (i32, Value) {
    let (code, out, err) = motes(args);
    let value = serde_json::from_str(&out).unwrap_or_else(|why| panic!("{args:?}: {why}\n{out}\n{err}"));
    (code, value)
}

#[test]
fn commands_print_one_document() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("words").to_owned();
    std::fs::write(path("a.csv"), "x,y,z,vx,vy,vz,mass\n1,0,0,0,1,0,2\n-1,0,0,0,-1,0,3\n").expect("written");
    let cpu = ["--backend", "cpu"];

    let (code, check) = document(&[&["check", "kepler", "--json"][..], &cpu].concat());
    assert_eq!((code, check["particles"].as_u64(), check["steps"].as_u64().is_some()), (0, Some(2), true));
    assert!(
        check["seconds"].as_f64().expect("seconds") > 0.0 && check["memory"]["position"].as_u64().expect("bytes") > 0
    );
    let total: u64 = check["memory"].as_object().expect("fields").values().filter_map(Value::as_u64).sum();
    assert_eq!(check["memory_total"].as_u64(), Some(total));

    let (code, explain) = document(&[&["explain", "kepler", "--json"][..], &cpu].concat());
    let kernels = explain["kernels"].as_array().expect("kernels");
    let gravity = kernels.iter().find(|kernel| kernel["name"] == "gravity").expect("gravity");
    assert!(code == 0 && gravity["reads"].as_array().expect("buffers").contains(&"position".into()), "{explain}");

    let (_, info) = document(&["info", &path("a.csv"), "--json"]);
    assert_eq!((info["particles"].as_u64(), info["extent"]["low"][0].as_f64()), (Some(2), Some(-1.0)));
    let (_, convert) = document(&["convert", &path("a.csv"), &path("b.npz"), "--json"]);
    assert_eq!((convert["particles"].as_u64(), convert["to_format"].as_str()), (Some(2), Some("npz")));

    let (_, stability) = document(&["stability", "--steps", "5", "-o", &path("a.svg"), "--json", "--backend", "cpu"]);
    assert_eq!(stability["rows"].as_array().map(Vec::len), Some(motes::integrators::INTEGRATORS.len()));

    let (_, scenes) = document(&["scenes", "--json"]);
    assert_eq!(scenes["scenes"].as_array().map(Vec::len), Some(motes::scene::SCENES.len()));
    let (_, scene) = document(&["scenes", "kepler", "--json"]);
    assert!(scene["text"].as_str().expect("a text").contains("[simulation]"));
    let (_, keys) = document(&["scenes", "--keys", "--json"]);
    let entries = keys["entries"].as_array().expect("entries");
    let many = motes::forces::entries().count() + motes::shapes::SHAPES.len() + motes::measure::MEASURES.len();
    assert_eq!(entries.len(), many + motes::scene::SECTIONS.len());
    let softening =
        entries.iter().find(|entry| entry["name"] == "gravity").expect("gravity")["keys"].as_array().expect("keys");
    let softening = softening.iter().find(|key| key["name"] == "softening").expect("a key");
    assert!(softening["default"].is_number() && softening["required"] == false, "{softening}");
}

#[test]
fn errors_are_documents_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("words").to_owned();
    std::fs::write(path("a.toml"), "[simulation]\ndt = 0.1\nstep = 10\n").expect("written");
    std::fs::write(path("a.csv"), "x,y\n1,2\n").expect("written");
    for (args, code) in [
        (vec!["run", "kepler", "--json", "--no-such"], 2),
        (vec!["run", "--json"], 2),
        (vec!["check", "no_such_scene", "--json"], 3),
        (vec!["info", "no_such_file.csv", "--json"], 4),
        (vec!["scenes", "no_such_scene", "--json"], 3),
    ] {
        let (got, error) = document(&args);
        assert_eq!(
            (got, error["event"].as_str(), error["code"].as_i64()),
            (code, Some("error"), Some(code.into())),
            "{args:?}: {error}"
        );
        assert!(error["text"].as_str().is_some_and(|text| text.len() > 10), "{error}");
        // Without it, standard output has nothing.
        let plain: Vec<&str> = args.iter().copied().filter(|word| *word != "--json").collect();
        let (got, out, err) = motes(&plain);
        assert!(got == code && out.is_empty() && !err.is_empty(), "{plain:?}: {out}{err}");
    }
    for command in ["run", "check", "explain", "sweep", "compare"] {
        let scene = path("a.toml");
        let mut args = vec![command, &scene, "--json"];
        args.extend((command == "sweep").then_some(["--vary", "simulation.dt=0.1,0.2"]).into_iter().flatten());
        let (code, error) = document(&args);
        let faults = error["faults"].as_array().unwrap_or_else(|| panic!("{command}: {error}"));
        let step = faults.iter().find(|fault| fault["message"].as_str().is_some_and(|text| text.contains("`step`")));
        let step = step.unwrap_or_else(|| panic!("{command}: {error}"));
        assert_eq!((code, step["line"].as_u64(), step["column"].as_u64()), (3, Some(3), Some(1)), "{step}");
    }
    let (code, error) = document(&["info", &path("a.csv"), "--json"]);
    assert_eq!((code, error["code"].as_i64()), (4, Some(4)), "{error}");
}

/// Scenes with one particle and with many have as many times more as is asked, but for whole numbers along axes.
#[test]
fn scenes_scale_by_one_number() {
    let particles = |args: &[&str]| {
        let (code, explain) = document(&[&["explain", "--json", "--backend", "cpu"], args].concat());
        assert_eq!(code, 0, "{args:?}: {explain}");
        explain["particles"].as_f64().expect("a count")
    };
    for (scene, factor, off) in [
        ("plummer", 0.25, 0.001),
        ("galaxy", 0.1, 0.001),
        ("flock", 2.0, 0.001),
        ("periodic_box", 0.125, 0.001),
        ("cosmic_web", 0.125, 0.001),
        // 41 columns become 20, and the like.
        ("flag", 0.25, 0.06),
        ("jelly", 0.2, 0.2),
        ("hair", 0.5, 0.01),
        // Walls have layers, whatever their spacing.
        ("dam_break_2d", 0.25, 0.35),
        // The spacing of a fluid divides its blocks.
        ("droplet", 0.3, 0.25),
    ] {
        let (whole, part) = (particles(&[scene]), particles(&[scene, "--scale", &factor.to_string()]));
        assert!((part / whole / factor - 1.0).abs() < off, "{scene}: {part} of {whole} is not {factor}");
    }
    // Every scene has another resolution without faults, or none.
    let mut refused = Vec::new();
    for scene in motes::scene::SCENES.iter().filter(|scene| !["murmuration", "periodic_box"].contains(&scene.name)) {
        for factor in ["0.3", "1.5"] {
            let (code, out, err) = motes(&["explain", "--json", "--backend", "cpu", scene.name, "--scale", factor]);
            if code != 0 {
                assert!(code == 3 && err.contains("--scale: "), "{} {factor}: {out}{err}", scene.name);
                refused.push(scene.name);
            }
        }
    }
    refused.dedup();
    let own = [
        "kepler",
        "pendulum",
        "double_pendulum",
        "figure_eight",
        "pythagorean",
        "solar_system",
        "salt",
        "argon",
        "vapour",
        "polymer",
        "nanowire",
        "pile",
        "hopper",
        "column_collapse",
        "drum",
        "avalanche",
        "brazil_nut",
        "sandcastle",
        "room",
        "lanes",
        "stiff",
        "spring_chain",
        "poiseuille",
        "hydrostatic",
        "throw",
    ];
    assert!(refused.iter().all(|name| own.contains(name)) && refused.len() > 6, "{refused:?}");
    // What fills a box still does, and weighs as much: 48³ particles of mass m at a spacing of 1 are 24³ of 8 m at 2.
    let (code, out, _) =
        motes(&["check", "periodic_box", "--scale", "0.125", "--backend", "cpu", "--set", "particles.0.mass=0.5"]);
    let note = "--scale 0.125 sets particles.0.size=[24, 24, 24], particles.0.spacing=2.0, particles.0.mass=4.0";
    assert!(code == 0 && out.contains(note), "{out}");
    let (code, _, err) = motes(&["run", "kepler", "--scale", "0"]);
    assert!(code == 2 && err.contains("a number above 0"), "{err}");
}

#[test]
fn the_language_of_a_law_is_printed() {
    let (code, out, _) = motes(&["explain", "--law"]);
    let page = include_str!("../../docs/pages/reference/law.md");
    assert!(code == 0 && out.trim_end() == page.trim_end());
    let (code, _, err) = motes(&["explain"]);
    assert!(code == 2 && err.contains("<SCENE>"), "{err}");
}
