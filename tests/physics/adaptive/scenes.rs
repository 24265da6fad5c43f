//! Scenes with adaptive steps: what they may say, what they are refused for, and what a run leaves.

use std::process::Command;

use motes::kernel::AdaptiveStep;
use motes::scene::{Options, Scene, Source};

const HEAD: &str = "[simulation]\ndt = 0.01\nuntil = 0.055\n";
const REST: &str = "
[[particles]]
shape = \"block\"
size = [0.5, 0.4, 0]
spacing = 0.1
[[force]]
kind = \"uniform\"
acceleration = [0, -1, 0]
[[force]]
kind = \"fluid\"
spacing = 0.1
sound_speed = 8
[box]
low = [-1, -1, 0]
size = [2, 2, 0]
dimensions = 2
[output]
every = 2
formats = [\"csv\"]
";

fn load(text: &str) -> Result<Scene, String> {
    let source = Source::Text { name: "a.toml".to_owned(), text: text.to_owned(), folder: ".".into() };
    Scene::load(&source, &[], &Options::default()).map_err(|faults| faults.to_string())
}

#[test]
fn keys_are_read_and_written_back() {
    let of = |more: &str| load(&format!("{HEAD}{more}{REST}")).unwrap_or_else(|faults| panic!("{faults}"));
    let plain = of("adaptive = true\n");
    assert_eq!(plain.adaptive_step, Some(AdaptiveStep { least: 1e-5, courant: 0.25, before: None }));
    assert_eq!((plain.steps, plain.until), (6, 0.055));
    assert!(plain.remarks.iter().any(|text| text.contains("symplectic")), "{:?}", plain.remarks);
    let given = of("adaptive = true\ndt_min = 1e-4\ncfl = 0.4\ndt_before = 0.002\nintegrator = \"rk4\"\n");
    assert_eq!(given.adaptive_step, Some(AdaptiveStep { least: 1e-4, courant: 0.4, before: Some(0.002) }));
    assert!(given.remarks.is_empty(), "{:?}", given.remarks);
    let again = load(&given.resolved).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!((again.adaptive_step, again.until, again.steps, again.dt), (given.adaptive_step, given.until, 6, 0.01));
    assert_eq!((of("adaptive = false\n").adaptive_step, of("").adaptive_step), (None, None));
}

#[test]
fn refusals_show_the_place() {
    let refused = |more: &str, rest: &str| load(&format!("{HEAD}{more}{rest}")).err().expect("it must be refused");
    let place = "--> a.toml:4:1\n";
    let dry = REST.replace("[[force]]\nkind = \"fluid\"\nspacing = 0.1\nsound_speed = 8\n", "");
    for (more, rest, says) in [
        ("adaptive = true\n", dry.as_str(), "no force limits the time step"),
        ("adaptive = true\nintegrator = \"trapezoid\"\n", REST, "the integrator is implicit"),
        ("adaptive = true\nintegrator = \"beeman\"\n", REST, "three equally spaced times"),
        ("adaptive = true\ndt_min = 0.02\n", REST, "the shortest step is 2e-2 and the longest 1e-2"),
        ("cfl = 0.3\n", REST, "`cfl` is for adaptive steps"),
        ("dt_min = 0.003\n", REST, "`dt_min` is for adaptive steps"),
    ] {
        let said = refused(more, rest);
        assert!(said.contains(says) && said.contains(place) && said.contains('^'), "{said}");
    }
    let walks = format!("{REST}[[force]]\nkind = \"wander\"\n");
    let said = refused("adaptive = true\n", &walks);
    assert!(said.contains("a random walk has one kick per step") && said.contains(place), "{said}");
}

#[test]
fn a_run_ends_in_time_and_keeps_its_books() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("fall.toml");
    let text = format!("{HEAD}adaptive = true\n{REST}");
    std::fs::write(&scene, text).expect("written");
    let run = |out: &str, more: &[&str]| {
        let out = folder.path().join(out);
        let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
        let done = command.arg("run").arg(&scene).arg("--output").arg(&out).args(more).output().expect("it starts");
        let words = String::from_utf8_lossy(&done.stdout).into_owned();
        assert!(done.status.success(), "{words}{}", String::from_utf8_lossy(&done.stderr));
        let table = std::fs::read_to_string(out.join("fluid.csv")).expect("a ledger");
        let rows: Vec<Vec<String>> = table.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect();
        (words, rows)
    };
    let (words, rows) = run("few", &[]);
    assert!(
        words.contains("adaptive steps: ") && words.contains("limited by signal") && words.contains("fluid: mass"),
        "{words}"
    );
    assert!(words.contains("fluid.csv") && words.contains("all particles finite and inside of the box"), "{words}");
    let column = |rows: &[Vec<String>], name: &str| {
        let place = rows[0].iter().position(|cell| cell == name).unwrap_or_else(|| panic!("no column {name}"));
        rows[1..].iter().map(|row| row[place].clone()).collect::<Vec<_>>()
    };
    let times: Vec<f64> = column(&rows, "time").iter().map(|x| x.parse().expect("a number")).collect();
    // Every second one of the longest steps, and the end, which is none of those.
    for (time, want) in times.iter().zip([0.0, 0.02, 0.04, 0.055]) {
        assert!((time - want).abs() < 1e-9, "{times:?}");
    }
    assert_eq!(times.len(), 4);
    let (_, every) = run("all", &["--ledger", "--quiet"]);
    let steps: Vec<u64> = column(&every, "step").iter().map(|x| x.parse().expect("a number")).collect();
    let last: u64 = column(&rows, "step").last().expect("rows").parse().expect("a number");
    assert_eq!(steps, (0..=last).collect::<Vec<_>>());
    assert_eq!(every.last(), rows.last(), "looking at every step must change none");
    let dts: Vec<f64> = column(&every, "dt").iter().map(|x| x.parse().expect("a number")).collect();
    assert!((dts.iter().sum::<f64>() - 0.055).abs() < 1e-9, "{dts:?}");
}
