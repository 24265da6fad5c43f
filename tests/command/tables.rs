//! Files that look like tables and are none.

use crate::Place;

#[test]
fn other_formats_are_called_by_their_names() {
    let scene = |file: &str| format!("[simulation]\ndt = 1\nsteps = 1\n[[particles]]\nfile = \"{file}\"\n");
    for (file, bytes, words) in [
        ("a.h5", &b"\x89HDF\r\n\x1a\n\x00\x00"[..], "is an HDF5 file"),
        ("a.xyz", b"2\na comment\nAr 0 0 0\nAr 1 0 0\n", "an XYZ file"),
    ] {
        let place = Place::with(&[("a.toml", &scene(file))]);
        std::fs::write(place.at(file), bytes).expect("written");
        let (code, _, stderr) = place.run("a.toml", "out", &[]);
        assert!(code == 4 && stderr.contains(words), "{file}: {stderr}");
    }
}
