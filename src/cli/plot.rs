//! Plots.

use std::path::Path;

use motes::{Error, Measure};

/// Energies over time.
pub fn energy(_path: &Path, _rows: &[Measure], _title: &str) -> Result<(), Error> {
    Ok(())
}
