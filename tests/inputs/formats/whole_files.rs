//! Files that were cut off, and files that must never be.

use std::fs;
use std::io::Write;
use std::path::Path;

use motes::error::Error;
use motes::formats::{Precision, atomically, csv};

use crate::formats::{csv_bytes, folder, npz_bytes, put, read, refusal, some, tipsy_bytes};

#[test]
fn what_was_cut_off_is_an_error() {
    let folder = folder();
    for (name, bytes) in [
        ("a.tipsy", tipsy_bytes(&some(20))),
        ("a.npz", npz_bytes(&some(20), Precision::Single)),
        ("b.npz", npz_bytes(&some(20), Precision::Double)),
    ] {
        assert!(read(&put(&folder, name, &bytes)).is_ok());
        for part in 0..16 {
            refusal(&put(&folder, name, &bytes[..bytes.len() * part / 16]));
        }
    }
    // Text cut behind a row is good text: an error, or the rows before the cut and at most one that lost digits.
    let all = some(20);
    let bytes = csv_bytes(&all, Precision::Double);
    for part in 0..16 {
        let path = put(&folder, "a.csv", &bytes[..bytes.len() * part / 16]);
        if let Ok(less) = read(&path) {
            let whole = less.len().saturating_sub(1);
            assert!(less.len() < 20 && less.position()[..whole] == all.position()[..whole]);
        }
    }
}

#[test]
fn an_error_of_the_writer_leaves_the_file_alone() {
    let folder = folder();
    let path = put(&folder, "a.csv", "old");
    let failed = atomically(&path, |out| {
        out.write_all(&vec![b'x'; 1 << 17])?;
        Err(std::io::Error::other("no more"))
    });
    let Err(Error::Output { file, message }) = failed else { panic!("{failed:?}") };
    assert_eq!((file, message.as_str()), (path.clone(), "no more"));
    assert_eq!(fs::read(&path).expect("still there"), b"old");
    atomically(&path, |out| csv::write_csv(out, &some(3), Precision::Single)).expect("written");
    assert_eq!(read(&path).expect("csv").len(), 3);
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1, "a temporary file is left");
    let nowhere = folder.path().join("no such folder/a.csv");
    assert!(matches!(atomically(&nowhere, |_| Ok(())), Err(Error::Output { file, .. }) if file == nowhere));
    assert!(matches!(atomically(folder.path(), |_| Ok(())), Err(Error::Output { .. })));
}

#[cfg(unix)]
#[test]
fn links_are_followed_and_devices_kept() {
    use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
    let folder = folder();
    let path = put(&folder, "real.csv", "old");
    let link = folder.path().join("link.csv");
    symlink(&path, &link).expect("a link");
    atomically(&link, |out| out.write_all(b"new")).expect("written");
    assert!(link.is_symlink() && fs::read(&path).expect("real") == b"new");
    assert_ne!(fs::metadata(&path).expect("real").permissions().mode() & 0o044, 0, "others cannot read it");
    let null = Path::new("/dev/null");
    atomically(null, |out| out.write_all(b"gone")).expect("written");
    assert!(fs::metadata(null).expect("null").file_type().is_char_device());
}

#[test]
fn what_is_not_there_is_an_error() {
    let folder = folder();
    assert!(refusal(&folder.path().join("a.csv")).contains("No such file") || cfg!(not(unix)));
    assert!(refusal(folder.path()).contains("is a folder"));
}
