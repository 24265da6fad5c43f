//! The command among files, signals and limits of the system.

mod folders;
mod memory;
mod names;
mod numbers;
mod signals;
mod streams;
mod tables;

use std::path::Path;
use std::process::{Command, Output, Stdio};

fn motes(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
    command.args(args).env_remove("WGPU_ADAPTER_NAME").stdin(Stdio::null());
    command
}

/// Exit code, standard output and standard error.
fn output(command: &mut Command) -> (i32, String, String) {
    let Output { status, stdout, stderr } = command.output().expect("the program starts");
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    (status.code().unwrap_or(-1), text(stdout), text(stderr))
}

/// A folder with files in it.
struct Place(tempfile::TempDir);

impl Place {
    fn with(files: &[(&str, &str)]) -> Self {
        let place = Self(tempfile::tempdir().expect("a folder"));
        for (name, text) in files {
            place.put(name, text);
        }
        place
    }
    fn put(&self, name: &str, text: &str) -> String {
        std::fs::write(self.0.path().join(name), text).expect("written");
        self.at(name)
    }
    fn at(&self, name: &str) -> String {
        self.0.path().join(name).to_str().expect("a path of words").to_owned()
    }
    fn text(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.path().join(name)).unwrap_or_else(|why| panic!("{name}: {why}"))
    }
    fn names(&self, folder: &str) -> Vec<String> {
        names(&self.0.path().join(folder))
    }
    /// A run on the CPU backend.
    fn run(&self, scene: &str, out: &str, more: &[&str]) -> (i32, String, String) {
        let (scene, out) = (self.at(scene), self.at(out));
        output(&mut motes(&[&["run", &scene, "-o", &out, "--backend", "cpu"], more].concat()))
    }
}

/// A program that is ended with the test, however that ends.
struct Running(std::process::Child);

impl Running {
    /// Waits for its end, for two minutes at most.
    fn ended(&mut self) -> Option<i32> {
        let start = std::time::Instant::now();
        loop {
            if let Some(status) = self.0.try_wait().expect("a status") {
                return status.code();
            }
            assert!(start.elapsed().as_secs() < 120, "it does not end");
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|why| panic!("{}: {why}", folder.display()));
    let mut names: Vec<_> = entries.map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// Three bodies and their gravity, in few files.
const SCENE: &str = "# what one should see\n[simulation]\ndt = 0.01\nsteps = 20\n[[particles]]\nbodies = [{ position = [1, 0, 0], \
    velocity = [0, 0.5, 0] }, { position = [-1, 0, 0], velocity = [0, -0.5, 0] }]\n[[force]]\nkind = \"gravity\"\n[output]\n\
    every = 10\nformats = [\"csv\"]\n# notes at its end\n";
