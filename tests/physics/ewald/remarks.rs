//! What `motes check` says of images that are left out.

use std::process::Command;

const GAS: &str = "[simulation]\ndt = 0.1\nsteps = 2\n[box]\nlow = [-3, -3, -3]\nsize = [6, 6, 6]\n[[particles]]\nshape = \"box\"\n\
                   count = 20\nsize = [5, 5, 5]\n[[force]]\nkind = \"gravity\"\nsoftening = 0.5\n";

fn check(set: &[&str]) -> (bool, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("gas.toml");
    std::fs::write(&scene, GAS).expect("written");
    let mut motes = Command::new(env!("CARGO_BIN_EXE_motes"));
    motes.arg("check").arg(&scene).args(["--backend", "cpu"]);
    let output = motes.args(set.iter().flat_map(|one| ["--set", *one])).output().expect("an exit");
    let text = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    (output.status.success(), text.concat())
}

#[test]
fn images_that_are_left_out_are_remarked_on() {
    let (good, text) = check(&["force.0.images=\"nearest\""]);
    assert!(
        good && text.contains("nearest images only, without an Ewald sum") && text.contains("images = \"ewald\""),
        "{text}"
    );
    let (good, text) = check(&["force.0.images=\"ewald\""]);
    assert!(good && !text.contains("without an Ewald sum"), "{text}");
}

#[test]
fn a_box_that_does_not_fit_is_refused() {
    let (good, text) = check(&["force.0.images=\"ewald\"", "box.size=[6, 6, 5]"]);
    assert!(!good && text.contains("z periodic from -3 to 2"), "{text}");
}
