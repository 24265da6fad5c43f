//! Files of particles that are damaged, in each format that is written and read.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::Path;

use glam::DVec3;
use motes::State;
use motes::formats::{FORMATS, Format, Options};
use motes::kernel::Columns;

use crate::golden;

const GOLDEN: &str = "tests/inputs/messages/damaged.txt";
const ABOUT: &str =
    "# What is said of a file of each format that is cut after some eighths of it, or has a byte 255 there.\n";

fn good() -> State {
    let mut state = State::default();
    for i in 0..40 {
        let x = f64::from(i) + 1.0 / 3.0;
        state.push(DVec3::new(x, -0.5 * x, 7.0 / x), DVec3::new(0.25, -x, 1.0), 1.0 + x, 0.5);
    }
    (state.time, state.step) = (2.5, 77);
    state
}

fn written(format: &Format, path: &Path) -> Vec<u8> {
    let write = format.write.expect("a writer");
    let mut file = BufWriter::new(File::create(path).expect("a file"));
    write(&mut file, &good(), &Options::default()).expect("written");
    file.flush().expect("written");
    drop(file);
    std::fs::read(path).expect("it is there")
}

/// What reading these bytes says; nothing where they are good.
fn said(path: &Path, bytes: &[u8]) -> Option<String> {
    std::fs::write(path, bytes).expect("a file");
    motes::formats::read(path, &Columns::default()).err().map(|error| error.to_string())
}

#[test]
fn damaged_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut text = ABOUT.to_owned();
    for format in FORMATS.iter().filter(|format| format.write.is_some() && format.read.is_some()) {
        let path = folder.path().join(format!("a.{}", format.name));
        let bytes = written(format, &path);
        let _ = writeln!(text, "\n==== {}", format.name);
        for eighth in 0..8 {
            let at = bytes.len() * eighth / 8;
            let mut changed = bytes.clone();
            changed[at] = 255;
            for (what, bytes) in [("cut", &bytes[..at]), ("255", &changed[..])] {
                let said = said(&path, bytes).unwrap_or_else(|| "(it is read)".to_owned());
                let _ = writeln!(text, "{what} at {eighth}/8: {said}");
            }
        }
    }
    let text = super::cleaned(&text, folder.path());
    golden::matched(GOLDEN, &std::fs::read_to_string(GOLDEN).unwrap_or_default(), &text);
}
