//! The list of all VTP files of a run, with their times.

use std::io::{self, Write};
use std::path::Path;

use crate::state::State;

/// A list of files and their times, which ParaView opens as one (`.pvd`).
#[derive(Debug, Default)]
pub struct Collection(Vec<(u64, String)>);

impl Collection {
    /// Its name in the folder of a run.
    pub const NAME: &str = "snapshots.pvd";

    /// The entries of such a file before this step: a run that continues rewrites the later ones.
    #[must_use]
    pub fn before(file: &Path, step: u64) -> Self {
        let text = std::fs::read_to_string(file).unwrap_or_default();
        let entry = |line: &str| {
            let of: u64 = line.split_once("<!-- step ")?.1.split_once(' ')?.0.parse().ok()?;
            (of < step).then(|| (of, line.to_owned()))
        };
        Self(text.lines().filter_map(entry).collect())
    }
    /// Adds the file of a state, which must be in the same folder.
    pub fn add(&mut self, state: &State, file: &Path) {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        let line =
            format!("<DataSet timestep=\"{:?}\" part=\"0\" file=\"{name}\"/><!-- step {} -->", state.time, state.step);
        self.0.push((state.step, line));
    }
    /// Writes it.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, mut out: impl Write) -> io::Result<()> {
        writeln!(
            out,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>"
        )?;
        self.0.iter().try_for_each(|(_, line)| writeln!(out, "{line}"))?;
        writeln!(out, "</Collection>\n</VTKFile>")
    }
}
