//! `motes run --from`.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

fn run(scene: &str, out: &Path, more: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
    command.args(["run", scene, "--backend", "gpu", "--steps", "14", "-o"]).arg(out).stdin(Stdio::null());
    for set in
        crate::support::small::smaller(scene).iter().chain(&["output.every=7", "output.formats=[\"npz\", \"csv\"]"])
    {
        command.args(["--set", set]);
    }
    command.args(more).output().expect("the program starts")
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The snapshots of a folder, in the order of their steps.
fn snapshots(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let all = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let mut all: Vec<_> = all
        .filter(|path| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("snapshot_")))
        .filter(|path| path.extension().is_some_and(|e| e == ending))
        .collect();
    all.sort();
    all
}

#[test]
fn a_run_from_an_archive_writes_the_same_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let adaptive = ["--set", "simulation.adaptive=true"];
    let blocks =
        ["--set", "simulation.block_levels=6", "--set", "simulation.dt=0.05", "--set", "force.0.softening=0.02"];
    let breaks = ["--set", "force.1.strain=0.0003"];
    for (name, scene, more) in [
        ("motions", "wave_tank", &[][..]),
        ("births", "fountain_pool", &[]),
        ("adaptive", "dam_break_2d", &adaptive),
        ("broken", "tear", &breaks),
        ("blocks", "plummer", &blocks),
    ] {
        let [first, second] = ["first", "second"].map(|part| folder.path().join(format!("{name}_{part}")));
        let output = run(scene, &first, more);
        assert!(output.status.success(), "{name}: {}", said(&output));
        let want = snapshots(&first, "npz");
        assert_eq!(want.len(), 3, "{name}: {want:?}");
        let from = ["--from", want[1].to_str().expect("a name")];
        let output = run(scene, &second, &[&from, more].concat());
        assert!(
            output.status.success() && said(&output).contains("with the restart data"),
            "{name}: {}",
            said(&output)
        );
        let got = snapshots(&second, "npz");
        assert_eq!(got.len(), 2, "{name}: it begins where the other was: {got:?}");
        for (got, want) in got.iter().zip(&want[1..]) {
            assert_eq!(got.file_name(), want.file_name(), "{name}");
            assert!(std::fs::read(got).expect("a file") == std::fs::read(want).expect("a file"), "{name}: {got:?}");
        }
    }
}

#[test]
fn a_run_from_a_table_takes_the_step_from_its_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let [first, second, third] = ["first", "second", "third"].map(|part| folder.path().join(part));
    let output = run("plummer", &first, &[]);
    assert!(output.status.success(), "{}", said(&output));
    let want = snapshots(&first, "csv");
    let output = run("plummer", &second, &["--from", want[1].to_str().expect("a name")]);
    assert!(output.status.success() && said(&output).contains("step 7") && said(&output).contains("evaluated again"));
    let got = snapshots(&second, "csv");
    assert!(
        std::fs::read(&got[1]).expect("a file") == std::fs::read(&want[2]).expect("a file"),
        "gravity is of places"
    );
    // What cannot continue says why.
    let end = run("plummer", &third, &["--from", want[2].to_str().expect("a name")]);
    assert_eq!(end.status.code(), Some(4));
    assert!(said(&end).contains("--until"), "{}", said(&end));
    let other = run("figure_eight", &third, &["--from", want[1].to_str().expect("a name")]);
    assert_eq!(other.status.code(), Some(4));
    assert!(said(&other).contains("100 particles"), "{}", said(&other));
    let tear = run("tear", &third, &["--from", want[1].to_str().expect("a name")]);
    assert!(said(&tear).contains("broken"), "{}", said(&tear));
}
