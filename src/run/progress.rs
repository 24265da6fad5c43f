//! Progress of a run.

use std::path::Path;

use crate::measure::Energy;

/// Receives the progress of a run. The default of every method does nothing; `()` ignores everything.
pub trait Progress {
    /// A note for the user.
    fn remark(&mut self, text: &str) {
        let _ = text;
    }
    /// A warning.
    fn warning(&mut self, text: &str) {
        self.remark(text);
    }
    /// Reports the number of completed steps.
    fn at(&mut self, step: u64) {
        let _ = step;
    }
    /// An output was measured; `first` is the first of the run.
    fn measured(&mut self, row: &Energy, first: &Energy) {
        let _ = (row, first);
    }
    /// Whether the energy should be measured more often than at outputs.
    fn watched(&self) -> bool {
        false
    }
    /// The energy between two outputs.
    fn energy(&mut self, row: &Energy, first: &Energy) {
        let _ = (row, first);
    }
    /// A picture of the film was taken; a thread writes its file.
    fn frame(&mut self, frame: usize, step: u64, file: &Path) {
        let _ = (frame, step, file);
    }
    /// A checkpoint was written.
    fn checkpoint(&mut self, step: u64, file: &Path) {
        let _ = (step, file);
    }
}

impl Progress for () {}
