//! What the command says of wrong arguments, and its help, as a file that can be read in one sitting: `UPDATE=1 cargo test --test
//! commands messages` writes it anew.

use std::process::{Command, Stdio};

use crate::golden::{self, Case};

/// The exit code and what stands on standard error; of a command for help, on standard output too.
fn said(folder: &std::path::Path, case: &Case) -> String {
    let here = folder.display().to_string();
    let args: Vec<_> = case.title.split_whitespace().map(|word| word.replace("FOLDER", &here)).collect();
    let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
    command.args(&args).current_dir(folder).env_remove("WGPU_ADAPTER_NAME").env("COLUMNS", "100").stdin(Stdio::null());
    let output = command.output().expect("the program starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).replace(&here, "FOLDER");
    let mut all = format!("exit code {}\n{}", output.status.code().unwrap_or(-1), text(&output.stderr));
    if args.iter().any(|word| word == "--help") {
        all += &text(&output.stdout);
    }
    // Lists of names grow with the registers.
    let lines = all.lines().map(|line| match line.split_once("built-in scenes: ") {
        Some((before, list)) => format!("{before}built-in scenes: {}, …", list.split(", ").next().unwrap_or_default()),
        None => line.trim_end().to_owned(),
    });
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn messages_about_arguments_are_those_of_the_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let put = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).expect("written");
    put("a.csv", b"x,y,z\n1,2,3\n");
    put("b.csv", b"x,y,z\n1,2,3\n4,oops,6\n");
    put("utf16.toml", b"\xff\xfe[\0s\0]\0");
    put("latin.toml", b"[simulation]\n# gr\xfc\xdfe\n");
    put("bodies.toml", b"[simulation]\ndt = 0.1\nsteps = 1\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\n");
    std::fs::create_dir(folder.path().join("empty")).expect("a folder");
    let real = folder.path().canonicalize().expect("it is there");
    golden::compare("tests/commands/messages.txt", |case| said(&real, case));
}
