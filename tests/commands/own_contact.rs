//! A contact law of one's own, with a history of its own: the example of the guide runs by the command, with all measures of grains.

use std::path::{Path, PathBuf};
use std::process::Command;

const SCENE: &str = include_str!("../../examples/own_contact/castle.toml");

/// Runs a scene beside the example's law, and returns the folder of its results.
fn run(folder: &Path, name: &str, scene: &str) -> PathBuf {
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/own_contact/bridge.wgsl");
    std::fs::copy(example, folder.join("bridge.wgsl")).expect("a law");
    let (file, out) = (folder.join(format!("{name}.toml")), folder.join(name));
    std::fs::write(&file, scene).expect("a scene");
    let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
    let output = command.arg("run").arg(&file).arg("--output").arg(&out).output().expect("it starts");
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    out
}

/// A table: names and rows.
fn table(file: &Path) -> (Vec<String>, Vec<Vec<f64>>) {
    let text = std::fs::read_to_string(file).unwrap_or_else(|why| panic!("{}: {why}", file.display()));
    let mut lines = text.lines();
    let names = lines.next().expect("names").split(',').map(str::to_owned).collect();
    // Cells that are empty or words are no numbers.
    let cells = |line: &str| line.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect();
    (names, lines.map(cells).collect())
}

/// The example with 144 grains, for so many steps.
fn small(steps: u32) -> String {
    let scene = SCENE.replace("steps = 10000", &format!("steps = {steps}")).replace("every = 2000", "every = 600");
    scene.replace("size = [0.08, 0.08, 0.11]", "size = [0.04, 0.04, 0.09]").replace("0.056]", "0.046]")
}

/// Bridges of liquid hold a block of grains, which runs out without them; each measure that grains have gives numbers.
#[test]
#[ignore = "minutes on a software adapter: `tests/run --test physics --test commands -- --include-ignored` runs it"]
fn a_castle_stands_by_its_bridges_and_is_measured() {
    let folder = tempfile::tempdir().expect("a folder");
    let more = "[[column]]\nname = \"unwrapped\"\nkind = \"vector\"\nrate = \"velocity\"\ninitial = [0, 0, 0]\n[[measure]]\nkind = \"thermo\"\n[[measure]]\nkind = \"diffusion\"\n\
                [[measure]]\nkind = \"probe\"\nstart = [0, 0, 0.01]\nrange = 0.02\n";
    let wet = small(3600) + more;
    let dry = wet.replace("bridge = 0.1", "bridge = 0");
    let tops = [("wet", wet), ("dry", dry)].map(|(name, scene)| {
        let out = run(folder.path(), name, &scene);
        for measure in ["energy", "granular", "thermo", "diffusion", "probe"] {
            let (names, rows) = table(&out.join(format!("{measure}.csv")));
            // Nothing diffuses before time has passed.
            let first = usize::from(measure == "diffusion");
            assert!(
                rows.len() == 7 && rows[first..].iter().flatten().all(|x| x.is_finite()),
                "{measure}: {names:?} {rows:?}"
            );
        }
        let (names, rows) = table(&out.join("granular.csv"));
        let column = |name: &str| names.iter().position(|known| known == name).expect("a column");
        [rows[6][column("top")], rows[6][column("contacts")]]
    });
    println!("{tops:?}");
    let [[wet, held], [dry, loose]] = tops;
    // Nine layers of grains of 8 mm; a dry one lies one or two high.
    assert!(wet > 0.04 && dry < 0.025, "{wet} {dry}");
    assert!(held > 3.0 && loose < 2.0, "{held} {loose}");
}

/// Without liquid the law is the linear one of `contact`, which keeps its history in slots too: the same way but for rounding. Walls are left out,
/// so that the law alone declares what grains have.
#[test]
fn a_dry_castle_falls_as_by_the_built_in_contact() {
    let folder = tempfile::tempdir().expect("a folder");
    let wall = "[[force]]\nkind = \"contact_wall\"\nstiffness = 1500\nrestitution = 0.5\nfriction = 0.5\n";
    let scene = small(600).replace(wall, "").replace("acceleration = [0, 0, -9.81]", "acceleration = [0, 0, 0]");
    assert!(scene.len() < small(600).len() - wall.len());
    // Two blocks that meet.
    let block = "[[particles]]\nshape = \"grains\"\nsize = [0.04, 0.04, 0.04]\ncenter = [0.008, 0.004, 0.115]\nradius = 0.004\nvelocity = [0.1, 0, -0.5]\n[[force]]\nwgsl";
    let scene = scene.replacen("[[force]]\nwgsl", block, 1);
    let (own, rest) = scene.split_once("[[force]]\nwgsl").expect("a law");
    let rest = rest.split_once("\n\n").expect("another force").1;
    let known =
        "[[force]]\nkind = \"contact\"\nrange = 0.0098\nstiffness = 1500\nrestitution = 0.5\nfriction = 0.5\n\n";
    let last = |name: &str, scene: &str| {
        let (names, rows) = table(&run(folder.path(), name, scene).join("snapshot_600.csv"));
        let column = |name: &str| names.iter().position(|known| known == name).expect("a column");
        let all = ["x", "y", "z", "angular_velocity_x", "angular_velocity_y", "angular_velocity_z"].map(column);
        rows.iter().map(|row| all.map(|n| row[n])).collect::<Vec<_>>()
    };
    let built_in = last("built_in", &format!("{own}{known}{rest}"));
    let apart = |name: &str, scene: &str| {
        let own = last(name, scene);
        assert_eq!(own.len(), built_in.len());
        let differ = |from: usize, to: usize| {
            let pairs = own.iter().zip(&built_in);
            pairs.flat_map(|(a, b)| (from..to).map(move |n| (a[n] - b[n]).abs())).fold(0.0, f64::max)
        };
        [differ(0, 3), differ(3, 6)]
    };
    let spins = built_in.iter().flat_map(|row| &row[3..]).fold(0.0, |all: f64, x| all.max(x.abs()));
    let dry = apart("dry", &scene.replace("bridge = 0.1", "bridge = 0"));
    let wet = apart("wet", &scene);
    println!("{dry:?} {wet:?} {spins}");
    // Rounding is 6e-8 of 0.1 m and of 44 radians per second; 500 steps of contacts amplify it to 1e-9 and 1e-4. After 1200 steps it is 1e-5.
    assert!(spins > 5.0 && dry[0] < 1e-7 && dry[1] < 5e-3, "{dry:?} {spins}");
    assert!(wet[0] > 1e-4 && wet[1] > 1.0, "{wet:?}");
}

/// A law that names a word of history beyond its slots is refused where the word is a number, by `check` too, and stops a run where it is computed.
#[test]
fn words_beyond_the_slots_are_errors() {
    let folder = tempfile::tempdir().expect("a folder");
    let law = include_str!("../../examples/own_contact/bridge.wgsl");
    let kept = "    remember(you, 3u, history.wet);\n";
    let computed = "    for (var w = 3u; w < 6u; w += 1u) { remember(you, w, history.wet); }\n";
    std::fs::write(folder.path().join("bridge.wgsl"), law).expect("a law");
    std::fs::write(folder.path().join("loop.wgsl"), law.replace(kept, computed)).expect("a law");
    let said = |verb: &str, name: &str, slots: u32| {
        let scene = small(900).replace("bridge.wgsl", name).replace("slots = 4", &format!("slots = {slots}"));
        let file = folder.path().join("a.toml");
        std::fs::write(&file, scene).expect("a scene");
        let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
        command.arg(verb).arg(&file);
        if verb == "run" {
            command.arg("--output").arg(folder.path().join("out")).arg("--overwrite");
        }
        let output = command.output().expect("it starts");
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    for verb in ["check", "run"] {
        let (code, words) = said(verb, "bridge.wgsl", 3);
        assert!(
            code == Some(3) && words.contains("word 3") && words.contains("set slots = 4"),
            "{verb}: {code:?} {words}"
        );
    }
    let (code, words) = said("run", "loop.wgsl", 4);
    assert!(code == Some(3) && words.contains("word 5") && words.contains("set slots = 6"), "{code:?} {words}");
    let (code, words) = said("run", "loop.wgsl", 6);
    assert_eq!(code, Some(0), "{words}");
}
