//! `motes convert`, `motes info`, and the list of states that ParaView opens.

use std::fs;
use std::process::{Command, Stdio};

use motes::State;
use motes::formats::vtp::Collection;

fn motes(args: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
    let output = command.args(args).stdin(Stdio::null()).output().expect("the program starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("output is UTF-8");
    (output.status.code().unwrap_or(-1), text(output.stdout), text(output.stderr))
}

fn path(folder: &tempfile::TempDir, name: &str) -> String {
    folder.path().join(name).to_str().expect("a path of words").to_owned()
}

#[test]
fn a_file_is_converted_once_and_described() {
    let folder = tempfile::tempdir().expect("a folder");
    let (table, stars) = (path(&folder, "a.csv"), path(&folder, "stars.hdf5"));
    fs::write(&table, "x,y,z,vx,mass,charge\n1,2,3,4,0.5,-1\n-1,0.25,0,0,2,7\n").expect("a file");
    let (code, said, notes) = motes(&["convert", &table, &stars]);
    assert_eq!((code, notes.as_str()), (0, ""), "{said}");
    assert!(said.starts_with("2 particles from ") && said.contains("(hdf5, single precision)"), "{said}");
    let (code, said, notes) = motes(&["info", &stars]);
    assert_eq!(code, 0, "{notes}");
    for line in [
        "particles  2",
        "time       0.0, step 0",
        "box        none in the file",
        "extent     (-1.0, 0.25, 0.0) to (1.0, 2.0, 3.0)",
        "species    2 of 0",
        "mass       2.5, momentum (2.0, 0.0, 0.0)",
        "energy     4.0 is kinetic",
        "charge    scalar, -1.0 to 7.0",
    ] {
        assert!(said.contains(line), "no `{line}` in\n{said}");
    }
    let before = fs::read(&stars).expect("a file");
    let (code, _, notes) = motes(&["convert", &table, &stars]);
    assert!(code == 8 && notes.contains("use --overwrite"), "{code}: {notes}");
    let (code, _, notes) = motes(&["convert", &stars, &stars]);
    assert!(code == 8 && notes.contains("is the file that is read"), "{code}: {notes}");
    let (code, _, notes) = motes(&["convert", &stars, &stars, "--overwrite"]);
    assert!(code == 8 && notes.contains("is the file that is read"), "{code}: {notes}");
    assert_eq!(fs::read(&stars).expect("a file"), before);
    let (code, _, notes) = motes(&["convert", &stars, &path(&folder, "b.tipsy")]);
    assert!(code == 0 && notes.contains("does not hold `charge`"), "{code}: {notes}");
    let (code, _, notes) = motes(&["info", &path(&folder, "none.ply")]);
    assert!(code == 4 && notes.contains("none.ply"), "{code}: {notes}");
}

#[test]
fn a_conversion_that_fails_leaves_what_was_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let big = path(&folder, "big.csv");
    fs::write(&big, "x,y,z\n1e300,0,0\n").expect("a file");
    for ending in ["npz", "xyz", "csv", "hdf5", "ply", "vtp", "tipsy"] {
        let kept = path(&folder, &format!("kept.{ending}"));
        fs::write(&kept, "what was there").expect("a file");
        let (code, _, notes) = motes(&["convert", &big, &kept, "--precision", "single", "--overwrite"]);
        assert!(code == 8 && notes.contains("1e300"), "{ending} {code}: {notes}");
        assert_eq!(fs::read(&kept).expect("a file"), b"what was there", "{ending}");
    }
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 8, "nothing else is left there");
}

#[test]
fn info_and_convert_tell_what_is_left_out_and_no_more_than_there_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = path(&folder, "mesh.ply");
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n\
                property list uchar int vertex_indices\nelement edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n\
                0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n0 1\n1 2\n";
    fs::write(&mesh, text).expect("a file");
    let (code, said, notes) = motes(&["info", &mesh]);
    assert!(code == 0 && said.contains("left out   1 face, 2 edges"), "{code}: {said}{notes}");
    for word in ["velocity", "mass", "size", "species", "ids", "energy"] {
        assert!(!said.split_whitespace().any(|said| said == word), "{word} is not in the file:\n{said}");
    }
    let (code, said, notes) = motes(&["convert", &mesh, &path(&folder, "mesh.npz")]);
    assert!(code == 0 && notes.contains("does not hold 1 face, 2 edges"), "{code}: {said}{notes}");
}

#[test]
fn a_run_lists_its_states_for_paraview() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = path(&folder, "out");
    let sets = ["--set", "output.formats=[\"vtp\", \"hdf5\", \"ply\"]", "--set", "output.every=2"];
    let args = [&["run", "kepler", "--backend", "cpu", "--steps", "4", "-q", "-o", &out][..], &sets].concat();
    let (code, _, notes) = motes(&args);
    assert_eq!(code, 0, "{notes}");
    let listed = fs::read_to_string(folder.path().join("out/snapshots.pvd")).expect("a list");
    for step in [0, 2, 4] {
        assert!(listed.contains(&format!("file=\"snapshot_{step}.vtp\"/>")), "{listed}");
        for ending in ["vtp", "hdf5", "ply"] {
            assert!(folder.path().join(format!("out/snapshot_{step}.{ending}")).is_file(), "{step} {ending}");
        }
    }
    assert_eq!(listed.matches("<DataSet timestep=").count(), 3, "{listed}");
    // A second run into the folder knows the list for a result.
    let (code, _, notes) = motes(&[&args[..], &["--overwrite"]].concat());
    assert_eq!(code, 0, "{notes}");
    // A run that continues lists what was before it, and what it writes anew.
    let file = folder.path().join("out/snapshots.pvd");
    let mut again = Collection::before(&file, 2);
    for step in [2, 4] {
        let time = listed.split("timestep=\"").nth(step / 2 + 1).and_then(|rest| rest.split('"').next());
        let mut state = State::default();
        state.step = step as u64;
        state.time = time.and_then(|time| time.parse().ok()).expect("a time");
        again.add(&state, &folder.path().join(format!("out/snapshot_{step}.vtp")));
    }
    let mut bytes = Vec::new();
    again.write(&mut bytes).expect("memory");
    assert_eq!(String::from_utf8(bytes).expect("text"), listed);
}

/// What a format has no place for is named when a run begins, once.
#[test]
fn a_run_says_what_tipsy_does_not_hold() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = "[simulation]\ndt = 0.01\nsteps = 4\n[[particles]]\nfile = \"stars.csv\"\n[output]\nevery = 1\nformats = [\"tipsy\"]\n";
    std::fs::write(folder.path().join("a.toml"), scene).expect("written");
    for (table, words) in [("x,y,z,size\n1,2,3,0.5\n", "size"), ("x,y,z\n1,2,3\n", "")] {
        std::fs::write(folder.path().join("stars.csv"), table).expect("written");
        let out = path(&folder, &format!("out{}", words.len()));
        let (code, said, notes) = motes(&["run", &path(&folder, "a.toml"), "-o", &out, "--backend", "cpu"]);
        assert_eq!(code, 0, "{said} {notes}");
        let said = said + &notes;
        assert_eq!(said.matches("`tipsy` files do not hold").count(), usize::from(!words.is_empty()), "{said}");
        assert!(said.contains(words), "{said}");
        assert_eq!(std::fs::metadata(format!("{out}/snapshot_4.tipsy")).expect("written").len(), 32 + 36);
    }
}
