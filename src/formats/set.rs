//! Sets of files that hold a state together: `snapshot_007.0.hdf5`, `snapshot_007.1.hdf5`.

use std::path::Path;

use super::input;
use crate::error::Error;

/// Refuses a part outside the folder of the file that was named, such as through a link: only that folder may be read.
pub(super) fn beside(named: &Path, part: &Path) -> Result<(), Error> {
    let real = |path: &Path| std::fs::canonicalize(path).map_err(|why| input(path, why.to_string()));
    let (named, real) = (real(named)?, real(part)?);
    if named.parent().is_some_and(|folder| real.starts_with(folder)) {
        return Ok(());
    }
    Err(input(part, "is a part of a set, and a link leads outside of the set's folder: put all parts into one folder"))
}

/// The text before and after the number of a part: `snapshot_007`, `hdf5`.
pub(super) fn split(path: &Path) -> Option<(String, String)> {
    let (stem, ending) = path.to_str()?.rsplit_once('.')?;
    let (before, number) = stem.rsplit_once('.')?;
    number.parse::<u32>().ok()?;
    Some((before.to_owned(), ending.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::split;

    #[test]
    fn parts_of_a_set_are_numbered_before_the_ending() {
        let of = |name: &str| split(std::path::Path::new(name));
        assert_eq!(of("a/snap_7.0.hdf5"), Some(("a/snap_7".to_owned(), "hdf5".to_owned())));
        assert_eq!((of("snap.hdf5"), of("a.b.hdf5")), (None, None));
    }
}
