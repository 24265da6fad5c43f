//! Progress of a run.

use std::path::Path;

use crate::measure::Measure;

/// Hears how a run goes. Every method does nothing unless it is written; `()` hears nothing.
pub trait Progress {
    /// What is worth to be known.
    fn remark(&mut self, text: &str) {
        let _ = text;
    }
    /// What should not be.
    fn warning(&mut self, text: &str) {
        self.remark(text);
    }
    /// So many steps are done.
    fn at(&mut self, step: u64) {
        let _ = step;
    }
    /// An output was measured; `first` is the first of the run.
    fn measured(&mut self, row: &Measure, first: &Measure) {
        let _ = (row, first);
    }
    /// Whether it wants to know the energy more often than outputs tell.
    fn watched(&self) -> bool {
        false
    }
    /// The energy between two outputs.
    fn energy(&mut self, row: &Measure, first: &Measure) {
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

/// A number as one would write it: to twelve digits, for what a sum or a product has rounded is none of its own.
#[must_use]
pub fn plain(x: f64) -> String {
    let x = format!("{x:.11e}").parse().unwrap_or(x);
    if x == 0.0 || (1e-4..1e7).contains(&x.abs()) { format!("{x}") } else { format!("{x:e}") }
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn numbers_are_written_as_one_would() {
        let written = [7.0 * 0.2, 4e-6 * 0.1, 1e20, -0.00025, 0.0, 1600.0].map(plain);
        assert_eq!(written, ["1.4", "4e-7", "1e20", "-0.00025", "0", "1600"]);
    }
}
