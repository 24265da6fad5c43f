//! Files (a stand-in until the real readers land).

use std::path::Path;

use glam::DVec3;

use crate::error::Error;
use crate::particles::Particles;

/// Reads particles.
///
/// # Errors
/// The file cannot be read.
pub fn read(path: &Path) -> Result<Particles, Error> {
    let bad = |message: String| Error::Input { file: path.to_owned(), message };
    let text = std::fs::read_to_string(path).map_err(|e| bad(e.to_string()))?;
    let mut all = Particles::default();
    for (i, line) in text.lines().enumerate().skip(1) {
        let n: Vec<f64> = line.split(',').filter_map(|x| x.trim().parse().ok()).collect();
        let [x, y, z] = n[..] else { return Err(bad(format!("line {}: three numbers are wanted", i + 1))) };
        all.push(DVec3::new(x, y, z), DVec3::ZERO, 1.0, 0.0);
    }
    Ok(all)
}
