//! Files that look like tables and are none.

use crate::process::Place;

#[test]
fn a_file_that_ends_behind_its_signature_is_refused() {
    let scene = |file: &str| format!("[simulation]\ndt = 1\nsteps = 1\n[[particles]]\nfile = \"{file}\"\n");
    let (file, bytes) = ("a.h5", &b"\x89HDF\r\n\x1a\n\x00\x00"[..]);
    let place = Place::with(&[("a.toml", &scene(file))]);
    std::fs::write(place.at(file), bytes).expect("written");
    let (code, _, stderr) = place.run("a.toml", "out", &[]);
    assert!(code == 4 && stderr.contains("a.h5: cannot be read as HDF5"), "{file}: {stderr}");
}
