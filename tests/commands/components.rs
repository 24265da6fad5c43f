//! Every component and every integrator of the registers runs by the command, on what it acts on: the whole way from a scene to files.

use std::path::Path;
use std::process::{Command, Stdio};

use motes::forces;
use motes::settings::{Key, Kind, Value};

/// Two steps of a scene: tables of states, a picture and energies. The words of the program where it fails.
fn run(scene: &str) -> Result<(), String> {
    let folder = tempfile::tempdir().expect("a folder");
    let (file, out) = (folder.path().join("scene.toml"), folder.path().join("out"));
    std::fs::write(&file, scene).expect("a scene");
    std::fs::write(folder.path().join("room.wkt"), include_str!("../../scenes/room.wkt")).expect("a plan");
    let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
    command.arg("run").arg(&file).arg("--output").arg(&out).args(["--steps", "2"]);
    let output = command.stdin(Stdio::null()).output().expect("it starts");
    let words = String::from_utf8_lossy(&output.stderr).into_owned();
    if output.status.code() != Some(0) {
        return Err(format!("{:?}: {words}", output.status.code()));
    }
    let last = last_table(&out);
    // The state of each particle, and nothing that is no number.
    let (rows, spoiled) = (last.lines().count() - 1, ["NaN", "nan", "inf"].iter().any(|word| last.contains(word)));
    if rows < 2 || spoiled { Err(format!("{rows} rows:\n{last}")) } else { Ok(()) }
}

fn last_table(folder: &Path) -> String {
    let files = std::fs::read_dir(folder).expect("results").map(|entry| entry.expect("a file").path());
    let mut tables: Vec<_> = files
        .filter(|file| file.file_name().is_some_and(|name| name.to_string_lossy().starts_with("snapshot")))
        .filter(|file| file.extension().is_some_and(|ending| ending == "csv"))
        .collect();
    tables.sort();
    assert!(tables.len() > 1, "{tables:?}");
    std::fs::read_to_string(tables.last().expect("one")).expect("a table")
}

/// A value for a key that has no default.
fn given(key: &Key) -> String {
    match key.kind {
        Kind::Pairs(keys) => {
            let values: Vec<_> = keys.iter().map(|key| format!("{} = 0.5", key.name)).collect();
            format!("[{{ species = [0, 0], {} }}]", values.join(", "))
        }
        Kind::Vector | Kind::Direction => "[0.2, 0.6, -0.4]".to_owned(),
        Kind::Count | Kind::Whole => "3".to_owned(),
        _ => "0.5".to_owned(),
    }
}

/// The particles on which a component acts, and what else it needs.
fn particles(name: &str) -> &'static str {
    match name {
        "contact" | "contact_wall" => "[[particles]]\nshape = \"grains\"\nsize = [1, 1, 1]\nradius = 0.1\n",
        "rod" => "[[particles]]\nshape = \"chain\"\ncount = 5\nto = [1, 0, 0]\ntie = \"rod\"\n",
        "spring" | "joint" | "air" | "strain_limit" | "tear" => {
            "[[particles]]\nshape = \"cloth\"\ncolumns = 6\nrows = 6\nspacing = 0.1\nmass = 0.01\nstretch = 20\n[[force]]\nkind = \"uniform\"\n"
        }
        "fluid" => "[[particles]]\nshape = \"block\"\nsize = [3, 3, 3]\n",
        // Velocities in the plane.
        "vicsek" => {
            "[box]\nsize = [2, 2, 0]\ndimensions = 2\n[[particles]]\nshape = \"box\"\ncount = 40\nsize = [2, 2, 0]\nspeed = 0.5\n"
        }
        "social_force" => {
            "[[particles]]\nshape = \"lattice\"\nsize = [3, 3, 1]\nspacing = 1\nmass = 80\nradius = 0.3\n"
        }
        "collision_free_speed" => {
            "[box]\nsize = [9, 9, 0]\n[[particles]]\nshape = \"lattice\"\nsize = [3, 3, 1]\nspacing = 1\nradius = 0.2\ndesired_speed = 1.3\n[[force]]\nkind = \"walk\"\n"
        }
        "walk" => "[[particles]]\nshape = \"lattice\"\nsize = [3, 3, 1]\nspacing = 1\ndesired_speed = 1.3\n",
        "navigate" | "social_wall" => {
            "[box]\nsize = [20, 20, 0]\nboundary = \"open\"\n[plan]\nfile = \"room.wkt\"\n[[particles]]\nshape = \"crowd\"\ncount = 9\nsize = [5, 5, 0]\ncenter = [5, 5, 0]\n"
        }
        "born_mayer" | "coulomb" => "[[particles]]\nshape = \"lattice\"\nsize = [3, 3, 3]\nspacing = 1\ncharge = 1\n",
        "collide" => {
            "[box]\nsize = [3, 3, 3]\n[[particles]]\nshape = \"box\"\ncount = 40\nsize = [2, 2, 2]\nspeed = 0.5\ncollision_radius = 0.2\n"
        }
        _ => "[box]\nsize = [3, 3, 3]\n[[particles]]\nshape = \"box\"\ncount = 40\nsize = [2, 2, 2]\nspeed = 0.5\n",
    }
}

const END: &str = "[output]\nevery = 1\nformats = [\"csv\", \"png\"]\n[picture]\nwidth = 64\nheight = 48\n";

#[test]
fn every_component_runs_by_the_command() {
    let mut faults = Vec::new();
    let mut count = 0;
    for entry in forces::entries() {
        let keys: Vec<_> = entry.keys.iter().filter(|key| key.default.is_none()).collect();
        let mut keys: String =
            keys.iter().fold(String::new(), |all, key| all + &format!("{} = {}\n", key.name, given(key)));
        // Zero is no speed of sound.
        keys.extend((entry.name == "fluid").then_some("sound_speed = 20\n"));
        let scene = format!(
            "[simulation]\ndt = 0.0001\nsteps = 2\n{}[[force]]\nkind = \"{}\"\n{keys}{END}",
            particles(entry.name),
            entry.name
        );
        count += 1;
        if let Err(why) = run(&scene) {
            faults.push(format!("{}: {why}\n{scene}", entry.name));
        }
    }
    assert!(count > 30 && faults.is_empty(), "{count} components:\n{}", faults.join("\n"));
}

#[test]
fn every_integrator_runs_by_the_command() {
    let mut faults = Vec::new();
    for entry in motes::integrators::INTEGRATORS {
        let words: Vec<_> =
            entry.keys.iter().filter(|key| matches!(key.default, None | Some(Value::Text(_)))).collect();
        assert!(words.iter().all(|key| key.default.is_some()), "{}: {words:?}", entry.name);
        let scene = format!(
            "[simulation]\ndt = 0.0001\nsteps = 2\nintegrator = \"{}\"\n{}[[force]]\nkind = \"gravity\"\nsoftening = 0.1\n{END}",
            entry.name,
            particles("gravity")
        );
        if let Err(why) = run(&scene) {
            faults.push(format!("{}: {why}\n{scene}", entry.name));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Walls that put pedestrians back say so at the end of a run, with the number that the column has; forces that keep them off leave nothing to say.
#[test]
fn corrections_by_walls_are_reported() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = |stiffness: u32| {
        format!(
            "[simulation]\ndt = 0.05\nsteps = 60\nintegrator = \"leapfrog\"\n{}speed_spread = 0\n[[force]]\nkind = \"walk\"\ndirection = [-1, 0, 0]\n\
             [[force]]\nkind = \"social_wall\"\nrepulsion = 0\nstiffness = {stiffness}\nfriction = 0\n{END}",
            particles("social_wall")
        )
    };
    std::fs::write(folder.path().join("room.wkt"), include_str!("../../scenes/room.wkt")).expect("a plan");
    let words = |stiffness: u32| {
        let file = folder.path().join(format!("scene_{stiffness}.toml"));
        std::fs::write(&file, scene(stiffness)).expect("a scene");
        let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
        let out = folder.path().join(format!("out_{stiffness}"));
        let output = command.arg("run").arg(&file).arg("--output").arg(&out).stdin(Stdio::null()).output();
        let output = output.expect("it starts");
        let words = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{words}");
        (words, last_table(&out))
    };
    let (said, table) = words(0);
    let mut rows = table.lines();
    let column = rows.next().expect("a head").split(',').position(|name| name == "wall_corrections").expect("it");
    let counts: Vec<f64> =
        rows.map(|row| row.split(',').nth(column).expect("a cell").parse().expect("a number")).collect();
    let (all, of) = (counts.iter().sum::<f64>(), counts.iter().filter(|count| **count > 0.0).count());
    assert!(
        all > 3.0 && said.contains(&format!("{of} pedestrians were put back in front of walls, {all} times in all")),
        "{said}"
    );
    assert!(!words(6000).0.contains("put back"));
}

/// A state with which a run goes on is asked for the floor and for ways, as that of a start is.
#[test]
fn states_that_go_on_are_on_the_floor_with_a_way() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = "[simulation]\ndt = 0.001\nsteps = 4\nintegrator = \"leapfrog\"\n[box]\nsize = [30, 30, 0]\nboundary = \"open\"\n[plan]\n\
         wkt = \"MULTIPOLYGON (((0 0, 5 0, 5 10, 0 10, 0 0)), ((5.1 0, 10 0, 10 10, 5.1 10, 5.1 0))) LINESTRING (1 1, 1 2)\"\n\
         [[particles]]\nshape = \"crowd\"\ncount = 3\nsize = [1, 3, 0]\ncenter = [3, 5, 0]\n[[force]]\nkind = \"navigate\"\n\
         [[force]]\nkind = \"social_wall\"\n";
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, format!("{scene}{END}")).expect("a scene");
    let words = |name: &str, more: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
        command.arg("run").arg(&file).arg("--output").arg(folder.path().join(name)).args(more);
        let output = command.stdin(Stdio::null()).output().expect("it starts");
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let (code, said) = words("whole", &["--steps", "2"]);
    assert_eq!(code, Some(0), "{said}");
    let table = last_table(&folder.path().join("whole"));
    let from = |name: &str, x: Option<&str>| {
        let moved =
            |row: &str| match (row.split_once(',').and_then(|(id, rest)| Some((id, rest.split_once(',')?.1))), x) {
                (Some(("0", rest)), Some(x)) => format!("0,{x},{rest}"),
                _ => row.to_owned(),
            };
        let text: Vec<String> = table.lines().map(moved).collect();
        std::fs::create_dir(folder.path().join(format!("from_{name}"))).expect("a folder");
        let state = folder.path().join(format!("from_{name}")).join("snapshot_2.csv");
        std::fs::write(&state, text.join("\n") + "\n").expect("a state");
        words(name, &["--from", &state.to_string_lossy()])
    };
    let (code, said) = from("same", None);
    assert_eq!(code, Some(0), "{said}");
    for (name, x, why) in [
        (
            "off",
            "12",
            "1 particles are on or in a wall, or off the floor of the plan, the first of them particle 0 at 12 ",
        ),
        ("sealed", "7", "1 particles have no way to an exit, the first of them particle 0 at 7 "),
    ] {
        let (code, said) = from(name, Some(x));
        assert!(code != Some(0) && said.contains(why), "{code:?}: {said}");
    }
}
