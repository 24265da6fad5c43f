//! The arrays of an NPZ archive, read as untrusted data.

use std::io::{self, Read, Seek};

use npyz::npz::NpzArchive;
use npyz::zip::CompressionMethod;

use super::csv::unknown;
use super::npy::Header;
use super::problems::Problems;
use super::titles::Title;
use crate::state::KEPT;

/// The maximum ratio of deflate: 258 bytes from 2 bits.
const DEFLATED: u64 = 1032;

/// The arrays beside those of columns.
const OTHERS: [&str; 3] = ["id", "time", "step"];

/// An archive, and its faults so far.
pub(super) struct Arrays<R: Read + Seek> {
    archive: NpzArchive<R>,
    pub(super) problems: Problems,
}

impl<R: Read + Seek> Arrays<R> {
    /// Opens an archive, and records arrays that have neither these titles nor these names as faults.
    pub(super) fn opened(from: R, titles: &[Title<'_>], system: &[&str]) -> io::Result<Self> {
        let mut arrays = Self { archive: NpzArchive::new(from)?, problems: Problems::default() };
        arrays.known(titles, system);
        Ok(arrays)
    }

    /// Records arrays of other names.
    fn known(&mut self, titles: &[Title<'_>], system: &[&str]) {
        let mut names: Vec<&str> = self.archive.array_names().collect();
        names.sort_unstable(); // an archive lists them in the order of a hash
        for name in names {
            if !name.starts_with(KEPT)
                && !titles.iter().any(|known| known.text == name)
                && !OTHERS.contains(&name)
                && !system.contains(&name)
            {
                self.problems.note(|| unknown("array", &name.chars().take(40).collect::<String>(), titles, &OTHERS));
            }
        }
    }

    /// The names of the restart data of a step.
    pub(super) fn kept(&self) -> Vec<String> {
        let mut names: Vec<String> =
            self.archive.array_names().filter(|name| name.starts_with(KEPT)).map(str::to_owned).collect();
        names.sort_unstable();
        names
    }

    /// The numbers of an array, if it exists and is valid.
    pub(super) fn column(&mut self, name: &str) -> Option<Vec<f64>> {
        if self.archive.array_names().any(|known| known == name) {
            let read = array(&mut self.archive, name);
            if let Err(message) = &read {
                self.problems.note(|| format!("the array `{name}` {message}"));
            }
            return read.ok();
        }
        if matches!(name, "x" | "y" | "z") {
            self.problems.note(|| format!("the array `{name}` is missing; x, y and z must be there"));
        }
        None
    }

    /// An array's only number; 0 if it is left out.
    pub(super) fn single(&mut self, name: &str) -> f64 {
        match self.column(name).as_deref() {
            Some([value]) if value.is_finite() && (name == "time" || *value >= 0.0) => {
                return *value;
            }
            Some([value]) => self.problems.note(|| format!("`{name}` is {value}")),
            Some(values) => {
                self.problems.note(|| format!("the array `{name}` holds {} numbers; it must hold one", values.len()));
            }
            None => {}
        }
        0.0
    }
}

/// The numbers of one array, widened.
fn array<R: Read + Seek>(archive: &mut NpzArchive<R>, name: &str) -> Result<Vec<f64>, String> {
    let mut file =
        archive.zip_archive().by_name(&format!("{name}.npy")).map_err(|error| format!("cannot be read ({error})"))?;
    if !matches!(file.compression(), CompressionMethod::Stored | CompressionMethod::Deflated) {
        return Err(format!("is compressed with {}; only stored and deflated arrays are read", file.compression()));
    }
    let (size, packed) = (file.size(), file.compressed_size());
    let header = Header::read(&mut file)?;
    let count = match header.shape[..] {
        [] => 1,
        [count] => count,
        _ => {
            return Err(format!("has the shape {:?}; it must have one axis", header.shape));
        }
    };
    let width = header.kind.width();
    let needed = count.checked_mul(width as u64).and_then(|bytes| bytes.checked_add(header.bytes));
    if needed != Some(size) || size / DEFLATED > packed {
        return Err(format!(
            "announces {count} numbers of {width} bytes behind a header of {}, but the archive holds {size} bytes for it, packed \
             into {packed}",
            header.bytes
        ));
    }
    let values = header.numbers(&mut file, count)?;
    // One more byte, so that the archive compares its checksum.
    match file.read(&mut [0]) {
        Ok(0) => Ok(values),
        Ok(_) => Err(format!("has more data after its {count} numbers")),
        Err(error) => Err(format!("is damaged ({error})")),
    }
}
