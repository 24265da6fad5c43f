//! Runs by the library and by the command: the same files, also where a run was stopped or killed and continued.

mod faults;
mod killed;
mod library;
mod measures;
mod refused;
mod resumed;
mod stream;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

fn motes(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
    command.args(args).env_remove("WGPU_ADAPTER_NAME").stdin(Stdio::null());
    command
}

/// Exit code, and standard output and standard error.
fn said(command: &mut Command) -> (i32, String) {
    let Output { status, stdout, stderr } = command.output().expect("the program starts");
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    (status.code().unwrap_or(-1), text(stdout) + &text(stderr))
}

/// A folder with files in it.
struct Place(tempfile::TempDir);

impl Place {
    fn with(files: &[(&str, &str)]) -> Self {
        let place = Self(tempfile::tempdir().expect("a folder"));
        for (name, text) in files {
            std::fs::write(place.at(name), text).expect("written");
        }
        place
    }
    fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }
    fn path(&self, name: &str) -> String {
        self.at(name).to_str().expect("a path of words").to_owned()
    }
    /// A run on the CPU backend.
    fn run(&self, scene: &str, out: &str, more: &[&str]) -> (i32, String) {
        let (scene, out) = (self.path(scene), self.path(out));
        said(&mut motes(&[&["run", &scene, "-o", &out, "--backend", "cpu"], more].concat()))
    }
    fn resume(&self, out: &str, more: &[&str]) -> (i32, String) {
        said(&mut motes(&[&["resume", &self.path(out), "--backend", "cpu"], more].concat()))
    }
    fn checkpoints(&self, out: &str) -> Vec<PathBuf> {
        let mut found: Vec<_> = all(&self.at(out)).into_keys().filter(|name| name.starts_with("checkpoint_")).collect();
        found.sort();
        found.iter().map(|name| self.at(out).join(name)).collect()
    }
}

/// All files in a folder and below, by their names, but for the lock.
fn all(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(folder).unwrap_or_else(|why| panic!("{}: {why}", folder.display())) {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        if path.is_dir() {
            found.extend(all(&path).into_iter().map(|(inner, bytes)| (format!("{name}/{inner}"), bytes)));
        } else if name != ".motes-lock" {
            found.insert(name, std::fs::read(&path).expect("read"));
        }
    }
    found
}

/// What two folders have otherwise; nothing where they are the same.
fn difference(got: &Path, want: &Path) -> Option<String> {
    let (got, want) = (all(got), all(want));
    let names = |files: &BTreeMap<String, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    if names(&got) != names(&want) {
        return Some(format!("files {:?}, and not {:?}", names(&got), names(&want)));
    }
    let other = got.iter().find(|(name, bytes)| want[*name] != **bytes)?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(&bytes[..bytes.len().min(3000)]).into_owned();
    let shown = if other.0.ends_with("csv") || other.0.ends_with("toml") {
        format!(":\n{}\nand not\n{}", text(other.1), text(&want[other.0]))
    } else {
        String::new()
    };
    let others: Vec<_> = got.iter().filter(|(name, bytes)| want[*name] != **bytes).map(|(name, _)| name).collect();
    Some(format!("{others:?} have other bytes{shown}"))
}

/// Three bodies and their gravity, with everything that a run writes of them.
const SCENE: &str = "# what one should see\n[simulation]\ndt = 0.01\nsteps = 40\n[[particles]]\nbodies = [{ position = [1, 0, 0], \
    velocity = [0, 0.5, 0] }, { position = [-1, 0, 0], velocity = [0, -0.5, 0] }, { position = [0, 3, 0] }]\n[[force]]\nkind = \
    \"gravity\"\n[output]\nevery = 10\nformats = [\"csv\", \"npz\", \"png\"]\nframes = 6\n[picture]\nwidth = 32\nheight = 32\n\
    [checkpoint]\nevery = \"7 steps\"\n";
