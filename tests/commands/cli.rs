//! The command as a user meets it: words, files and exit codes.

use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

fn motes(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
    command.args(args).env_remove("WGPU_ADAPTER_NAME").stdin(Stdio::null());
    command
}

fn output(command: &mut Command) -> (i32, String, String) {
    let Output { status, stdout, stderr } = command.output().expect("the program starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("output is UTF-8");
    (status.code().unwrap_or(-1), text(stdout), text(stderr))
}

fn path(folder: &tempfile::TempDir, name: &str) -> String {
    folder.path().join(name).to_str().expect("a path of words").to_owned()
}

fn names(folder: &str) -> Vec<String> {
    let mut names: Vec<_> = std::fs::read_dir(folder)
        .expect("the folder is there")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("a name of words"))
        .collect();
    names.sort();
    names
}

fn text(folder: &str, name: &str) -> String {
    std::fs::read_to_string(Path::new(folder).join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

#[test]
fn a_run_leaves_numbers_a_plot_pictures_and_a_scene_that_gives_the_same_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = path(&folder, "first");
    let small = ["--set", "picture.width=160", "--set", "picture.height=90", "--set", "output.every=10"];
    let formats = ["--set", "output.formats=[\"csv\", \"npz\", \"png\"]"];
    let args = [&["run", "figure_eight", "--steps", "20", "-o", &out][..], &small, &formats].concat();
    let (code, stdout, stderr) = output(&mut motes(&args));
    assert_eq!(code, 0, "{stderr}");
    assert!(stdout.contains("20 steps in") && stdout.contains("energy -1.287"), "{stdout}");
    assert!(stderr.contains("figure_eight: 3 particles, 20 steps"), "{stderr}");
    let expected = [
        "energy.csv",
        "energy.svg",
        "figure_eight.png",
        "picture_00.png",
        "picture_10.png",
        "picture_20.png",
        "scene.toml",
        "snapshot_00.csv",
        "snapshot_00.npz",
        "snapshot_10.csv",
        "snapshot_10.npz",
        "snapshot_20.csv",
        "snapshot_20.npz",
    ];
    assert_eq!(names(&out), expected);
    let energy = text(&out, "energy.csv");
    let header = "step,time,kinetic,potential,total,momentum_x,momentum_y,momentum_z,angular_momentum_x,angular_momentum_y,angular_momentum_z";
    assert_eq!(energy.lines().next(), Some(header));
    assert_eq!(energy.lines().map(|l| l.split(',').count()).collect::<Vec<_>>(), [11; 4]);
    let snapshot = text(&out, "snapshot_20.csv");
    assert!(snapshot.starts_with("id,x,y,z,vx,vy,vz,mass\n0,"), "{snapshot}");
    assert_ne!(snapshot, text(&out, "snapshot_10.csv"), "twenty steps are not ten");

    let again = path(&folder, "again");
    let scene = format!("{out}/scene.toml");
    let (code, _, stderr) = output(&mut motes(&["run", &scene, "-o", &again]));
    assert_eq!(code, 0, "{stderr}");
    for name in ["energy.csv", "snapshot_20.csv"] {
        assert_eq!(text(&out, name), text(&again, name), "{name} of the resolved scene");
    }
    assert!(text(&out, "scene.toml").contains(env!("CARGO_PKG_VERSION")));
}

#[test]
fn faults_of_a_scene_are_listed_together_and_nothing_is_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, out) = (path(&folder, "bad.toml"), path(&folder, "out"));
    let text =
        "[simulation]\ndt = -1\nstep = 5\n[[particles]]\nshape = \"plumer\"\ncount = 0\n[[force]]\nkind = \"gravty\"\n";
    std::fs::write(&scene, text).expect("written");
    let (code, stdout, stderr) = output(&mut motes(&["run", &scene, "-o", &out]));
    assert_eq!((code, stdout.as_str()), (3, ""), "{stderr}");
    for words in
        ["bad.toml:2:6", "did you mean `steps`?", "did you mean \"plummer\"?", "did you mean \"gravity\"?", "^"]
    {
        assert!(stderr.contains(words), "no {words} in\n{stderr}");
    }
    assert!(!Path::new(&out).exists(), "a bad scene writes nothing");
}

#[test]
fn exit_codes_are_those_of_the_help() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, help, _) = output(&mut motes(&["--help"]));
    let case = |args: &[&str], code: i32, words: &str| {
        let (got, stdout, stderr) = output(&mut motes(args));
        assert_eq!(got, code, "motes {args:?}\n{stdout}{stderr}");
        assert!(stderr.contains(words), "motes {args:?} does not say {words:?}:\n{stderr}");
        assert!(help.contains(&format!("\n  {code} ")), "{code} is not in the help");
    };
    case(&["run", "throw", "--sideways"], 2, "--sideways");
    case(&["run", "thrwo"], 3, "throw");
    case(&["check", "throw", "--set", "simulation.dt=0"], 3, "simulation.dt=0");

    std::fs::write(path(&folder, "p.csv"), "x,y,z\n1,2,3\n4,oops,6\n").expect("written");
    let scene = path(&folder, "p.toml");
    std::fs::write(&scene, "[simulation]\ndt = 1\nsteps = 1\n[[particles]]\nfile = \"p.csv\"\n").expect("written");
    case(&["check", &scene], 4, "oops");

    case(&["run", "throw", "--adapter", "no such adapter"], 5, "no such adapter");

    let clash = path(&folder, "clash.toml");
    let body = "{ position = [1, 0, 0], mass = 1 }";
    let text = format!(
        "[simulation]\ndt = 0.1\nsteps = 5\n[[particles]]\nbodies = [{body}, {body}]\n[[force]]\nkind = \"gravity\"\n"
    );
    std::fs::write(&clash, text).expect("written");
    for backend in ["gpu", "cpu"] {
        let out = path(&folder, backend);
        case(&["run", &clash, "-o", &out, "--backend", backend], 6, "particle 0 stopped being finite in step 0");
    }

    let file = path(&folder, "file");
    std::fs::write(&file, "").expect("written");
    case(&["run", "throw", "--steps", "1", "-o", &file], 8, &file);
}

#[test]
fn without_a_driver_the_references_run_and_say_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = path(&folder, "out");
    let blind = |args: &[&str]| {
        let mut command = motes(args);
        command
            .env("VK_DRIVER_FILES", "/nonexistent")
            .env("VK_ICD_FILENAMES", "/nonexistent")
            .env("WGPU_BACKEND", "vulkan");
        output(&mut command)
    };
    let (code, _, stderr) = blind(&["run", "kepler", "--steps", "10", "-o", &out, "--set", "output.formats=[\"csv\"]"]);
    assert_eq!(code, 0, "{stderr}");
    assert!(stderr.contains("f64 references") && stderr.contains("mesa-vulkan-drivers"), "{stderr}");
    // The references' digits are those of f64.
    let row = text(&out, "snapshot_10.csv").lines().nth(1).map(str::len);
    assert!(row > Some(80), "{row:?}");
    let (code, _, stderr) = blind(&["run", "kepler", "--backend", "gpu", "-o", &out]);
    assert_eq!(code, 5, "{stderr}");
    let (code, stdout, _) = blind(&["doctor"]);
    assert!(code == 0 && stdout.contains("no GPU driver was found"), "{stdout}");
}

/// Where there is OpenGL, it takes the place of a driver that is named wrongly; else the references do. Either is said.
#[test]
fn a_driver_that_is_not_there_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = path(&folder, "out");
    let wrong = |args: &[&str]| {
        let mut command = motes(args);
        command.env("VK_DRIVER_FILES", "/no/driver.json").env_remove("VK_ICD_FILENAMES").env_remove("WGPU_BACKEND");
        output(&mut command)
    };
    let (code, _, run) = wrong(&["run", "kepler", "--steps", "2", "-o", &out, "--set", "output.formats=[\"csv\"]"]);
    let (_, adapters, doctor) = wrong(&["doctor"]);
    assert_eq!(code, 0, "{run}");
    if adapters.contains("no GPU driver was found") {
        assert!(run.contains("no GPU driver was found"), "{run}");
    } else {
        for words in [&run, &doctor] {
            assert!(words.contains("VK_DRIVER_FILES names /no/driver.json, which is not there; OpenGL"), "{words}");
        }
    }
}

#[test]
fn programs_read_lines_of_json_and_quiet_is_quiet() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = path(&folder, "out");
    let args = ["run", "throw", "--steps", "30", "-o", &out, "--set", "output.formats=[]", "--set", "output.every=10"];
    let (code, stdout, stderr) = output(&mut motes(&[&args[..], &["--json"]].concat()));
    assert_eq!((code, stderr.as_str()), (0, ""));
    let events: Vec<serde_json::Value> = stdout.lines().map(|l| serde_json::from_str(l).expect("JSON")).collect();
    let kinds: Vec<_> = events.iter().filter_map(|e| e["event"].as_str()).filter(|e| *e != "remark").collect();
    assert_eq!(kinds, ["start", "progress", "progress", "progress", "progress", "finish"]);
    assert_eq!(events.last().map(|e| e["steps"].clone()), Some(30.into()));
    let (code, stdout, stderr) = output(&mut motes(&[&args[..], &["--quiet", "--overwrite"]].concat()));
    assert_eq!((code, stdout.as_str(), stderr.as_str()), (0, "", ""));
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_the_batch_and_writes() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = path(&folder, "out");
    let args = ["run", "kepler", "--steps", "100000000", "-o", &out, "--set", "output.formats=[\"csv\"]"];
    let child = motes(&args).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("the program starts");
    let start = Instant::now();
    while !Path::new(&out).join("energy.csv").exists() || text(&out, "energy.csv").lines().count() < 2 {
        assert!(start.elapsed() < Duration::from_mins(1), "the run does not begin");
        std::thread::sleep(Duration::from_millis(50));
    }
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill");
    assert!(killed.success());
    let Output { status, stdout, .. } = child.wait_with_output().expect("it ends");
    assert_eq!(status.code(), Some(75));
    assert!(String::from_utf8_lossy(&stdout).contains("stopped at step"));
    // Before the first step is done, the first state is the last.
    let states = if String::from_utf8_lossy(&stdout).contains("stopped at step 0 ") { 1 } else { 2 };
    assert_eq!(text(&out, "energy.csv").lines().count(), 1 + states, "the first state and the last");
    assert!(names(&out).iter().filter(|n| n.starts_with("snapshot_")).count() == states);
}

#[test]
fn the_other_commands_print_what_they_promise() {
    let lines = |args: &[&str], words: &[&str]| {
        let (code, stdout, stderr) = output(&mut motes(args));
        assert_eq!(code, 0, "motes {args:?}\n{stdout}{stderr}");
        for word in words {
            assert!(stdout.contains(word), "motes {args:?} does not print {word:?}:\n{stdout}");
        }
        stdout
    };
    lines(
        &["explain", "kepler", "--set", "simulation.integrator=leapfrog"],
        &["step:  kick+drift KICK=0.5 + clear | gravity | kick FACTOR=0.5 + watch | tick"],
    );
    lines(&["check", "fountain"], &["position", "in all", "per step", "no faults"]);
    lines(&["check", "fountain", "--set", "simulation.integrator=leapfrog"], &["depends on velocity", "of order 1"]);
    lines(&["doctor"], &["loops", "compensated sums", "NaN", "timestamps"]);
    lines(&["compare", "kepler", "--steps", "5"], &["gravity", "they agree"]);
    let list = lines(&["scenes"], &[]);
    for scene in motes::scene::SCENES {
        assert!(list.contains(scene.name), "{}", scene.name);
        assert_eq!(lines(&["scenes", scene.name], &[]), scene.text);
    }
}

#[test]
fn a_box_is_shown_and_what_it_keeps_is_claimed() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = path(&folder, "gas.toml");
    let gas = "[simulation]\ndt = 0.1\nsteps = 20\n[box]\nlow = [-3, -3, -3]\nsize = [6, 6, 6]\n[[particles]]\nshape = \"box\"\n\
                count = 20\nsize = [5, 5, 5]\nspeed = 3\nspecies = 2\n[[force]]\nkind = \"gravity\"\nsoftening = 0.5\n";
    std::fs::write(&scene, gas).expect("written");
    let shown = "box: x periodic from -3 to 3, y periodic from -3 to 3, z periodic from -3 to 3";
    let (code, stdout, stderr) = output(&mut motes(&["explain", &scene, "--backend", "cpu"]));
    assert!(code == 0 && stdout.contains(shown) && stdout.contains("drift KICK=0.5 | periodic | "), "{stdout}{stderr}");
    let (code, stdout, stderr) = output(&mut motes(&["check", &scene, "--backend", "cpu"]));
    assert!(code == 0 && stdout.contains(shown) && stdout.contains("without an Ewald sum"), "{stdout}{stderr}");
    let out = path(&folder, "out");
    let run = |set: &[&str]| {
        let csv = "output.formats=[\"csv\"]";
        let mut args = vec!["run", &scene, "-o", &out, "--overwrite", "--backend", "cpu", "--set", csv];
        args.extend(set.iter().flat_map(|value| ["--set", *value]));
        let (code, stdout, stderr) = output(&mut motes(&args));
        assert_eq!(code, 0, "{set:?}: {stderr}");
        stdout
    };
    let periodic = run(&[]);
    assert!(periodic.contains("momentum changed by") && !periodic.contains("angular"), "{periodic}");
    assert!(periodic.contains(", error ") && !periodic.contains("not conserved"), "{periodic}");
    let snapshot = text(&out, "snapshot_20.csv");
    assert!(snapshot.starts_with("id,x,y,z,vx,vy,vz,mass,species\n0,") && snapshot.contains(",2\n"), "{snapshot}");
    let reflecting = run(&["box.boundary=reflecting"]);
    assert!(!reflecting.contains("momentum") && !reflecting.contains("not conserved"), "{reflecting}");
    assert!(run(&["box.boundary=open"]).contains("angular momentum by"));
    // A weight that never ends: what falls through the floor comes in at the ceiling.
    let weight = "force.0.acceleration=[0, 0, -1]";
    let falling = gas.replace("kind = \"gravity\"\nsoftening = 0.5\n", "kind = \"uniform\"\n");
    std::fs::write(&scene, falling).expect("written");
    assert!(run(&[weight]).contains("not conserved"));
    assert!(!run(&[weight, "box.z=reflecting"]).contains("not conserved"));
    let (_, keys, _) = output(&mut motes(&["scenes", "--keys", "box"]));
    assert!(["size", "low", "boundary", "dimensions"].iter().all(|key| keys.contains(key)), "{keys}");
}

/// Vicsek's model is a rule for whole steps, and keeps nothing; nor does a limit of speed, or a flight.
#[test]
fn rules_for_whole_steps_want_their_integrators() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = path(&folder, "a.toml");
    let out = path(&folder, "out");
    let output_of = |command: &[&str], integrator: &str, force: &str| {
        let bodies = "bodies = [{ position = [0, 0, 0], mass = 1 }, { position = [0.5, 0, 0], mass = 1 }]";
        let text = format!(
            "[simulation]\ndt = 1\nsteps = 2\nintegrator = \"{integrator}\"\n[[particles]]\n{bodies}\n[[force]]\nkind = {force}\n"
        );
        std::fs::write(&scene, text).expect("written");
        let (code, stdout, stderr) = output(&mut motes(&[&[command[0], &scene], &command[1..]].concat()));
        assert_eq!(code, 0, "{stderr}");
        stdout + &stderr
    };
    let check = |integrator, force| output_of(&["check"], integrator, force);
    let remark = "it requires forward_euler or symplectic_euler";
    for (integrator, remarked) in [("leapfrog", true), ("symplectic_euler", false), ("forward_euler", false)] {
        let words = check(integrator, "\"vicsek\"");
        assert_eq!(words.contains(remark), remarked, "{words}");
        assert!(!words.contains("gains energy"), "{words}");
    }
    assert!(check("forward_euler", "\"gravity\"").contains("gains energy"));
    let run = ["run", "-o", &out, "--overwrite", "--backend", "cpu", "--set", "output.formats=[\"csv\"]"];
    let limited = "\"gravity\"\n[[force]]\nkind = \"speed_limit\"\nmax = 1";
    for (force, energy, momentum) in [
        ("\"gravity\"", true, true),
        (limited, false, false),
        ("\"flee\"", false, false),
        ("\"wander\"", false, false),
        ("\"soft_turn\"", true, false),
    ] {
        let words = output_of(&run, "leapfrog", force);
        assert_eq!((words.contains(", error "), words.contains("momentum changed")), (energy, momentum), "{words}");
    }
}
