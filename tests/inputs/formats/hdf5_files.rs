//! HDF5: sets of files, and what other programs write.

use std::fs;
use std::path::Path;

use motes::formats;

use super::register::hdf5;
use super::{folder, put, read};

#[cfg(unix)]
#[test]
fn parts_of_a_set_lie_in_one_folder() {
    let (inside, outside) = (folder(), folder());
    let first = put(&inside, "set.0.hdf5", hdf5(3, 2, 0, false));
    let second = inside.path().join("set.1.hdf5");
    std::os::unix::fs::symlink(put(&outside, "other.hdf5", hdf5(3, 2, 1, false)), &second).expect("a link");
    let said = read(&first).expect_err("a link leads outside").to_string();
    assert!(said.contains("set.1.hdf5") && said.contains("outside of the set's folder"), "{said}");
    formats::contents(&first).expect_err("a link leads outside");
    // A set may be named by a link, and a part may be a link that stays.
    fs::remove_file(&second).expect("a link");
    fs::create_dir(inside.path().join("more")).expect("a folder");
    fs::write(inside.path().join("more/b.hdf5"), hdf5(3, 2, 1, false)).expect("a file");
    std::os::unix::fs::symlink("more/b.hdf5", &second).expect("a link");
    assert_eq!(read(&first).expect("both").len(), 6);
}

#[cfg(unix)]
#[test]
fn what_is_no_regular_file_is_refused_at_once() {
    let said = read(Path::new("/dev/zero")).expect_err("a device").to_string();
    assert!(said.contains("is not a regular file"), "{said}");
}
