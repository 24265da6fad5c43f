//! Files that look like tables and are none.

use crate::process::Place;

#[test]
fn other_formats_are_called_by_their_names() {
    let scene = |file: &str| format!("[simulation]\ndt = 1\nsteps = 1\n[[particles]]\nfile = \"{file}\"\n");
    let (file, bytes) = ("a.h5", &b"\x89HDF\r\n\x1a\n\x00\x00"[..]);
    let place = Place::with(&[("a.toml", &scene(file))]);
    std::fs::write(place.at(file), bytes).expect("written");
    let (code, _, stderr) = place.run("a.toml", "out", &[]);
    assert!(code == 4 && stderr.contains("is an HDF5 file"), "{file}: {stderr}");
}
