//! Tables whose cells are separated by blanks.

use crate::formats::read;
use glam::DVec3;

use crate::formats::{folder, put, refused};

#[test]
fn blanks_and_tabs_separate_as_commas_do() {
    let folder = folder();
    let rows = [
        ("a.txt", "m x y z vx vy vz\n2 1 2 3 0.5 0 -1e-3\n0 4 5 -6e-1 0 0 0\n"),
        (
            "b.dat",
            "# two bodies\n\n  m\tx  y z\t\tvx vy vz  \r\n2 1 2 3 0.5 0 -1e-3\r\n\r\n# more\r\n  0 4 5 -6e-1 0 0 0",
        ),
        ("c.csv", "\u{feff}mass x y z vx vy vz\r2 1 2 3 0.5 0 -1e-3\r0 4 5 -6e-1 0 0 0\r"),
        // As `numpy.savetxt` writes it.
        ("d.txt", "# from a run\n# mass x y z vx vy vz\n2 1 2 3 0.5 0 -1e-3\n0 4 5 -6e-1 0 0 0\n"),
        ("e.csv", "# mass, x, y, z, vx, vy, vz\n2,1,2,3,0.5,0,-1e-3\n0,4,5,-6e-1,0,0,0\n"),
    ];
    for (name, text) in rows {
        let p = read(&put(&folder, name, text)).unwrap_or_else(|why| panic!("{why}"));
        assert_eq!(p.position(), [DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 5.0, -0.6)], "{name}");
        assert_eq!((p.velocity()[0], p.mass()), (DVec3::new(0.5, 0.0, -1e-3), &[2.0, 0.0][..]), "{name}");
    }
    let p = read(&put(&folder, "f.txt", "id x y z species\n1 1 0 0 7\n0 2 0 0 3\n")).expect("a table");
    assert_eq!((p.position()[0].x, p.species()), (2.0, &[3, 7][..]));
}

#[test]
fn a_table_of_blanks_reports_all_that_is_wrong() {
    refused(
        "a.txt",
        "# made by hand\nx y zz vx mas\n1 2 3 4 5\n\nfour 1e999 3 4 5\n# more\n1 2 3 4 5 6\n1 2\n",
        &[
            "unknown column `mas`; did you mean `mass`?",
            "unknown column `zz`; did you mean `z`?",
            "the column `z` is missing",
            "line 5, column x: `four` is not a number",
            "line 5, column y: `1e999` is not finite",
            "line 7: 6 cells, but 5 columns",
            "line 8, column vx: the cell is missing",
        ],
    );
    refused("a.txt", "1 2 3 4 5 6 7\n1 2 3 4 5 6 7\n", &["its first line is 7 numbers", "mass x y z vx vy vz"]);
    refused("a.csv", "1,2,3\n", &["its first line is 3 numbers"]);
    // A comment that has other words, or more of them, names nothing.
    refused("a.txt", "# x y\n1 2 3\n", &["its first line is 3 numbers"]);
    refused("a.txt", "# made in May\n1 2 3\n", &["unknown column `made`"]);
    refused("a.txt", "x x y z\n1 1 2 3\n", &["the column `x` is there twice"]);
}

/// A table that is longer than what is looked at to tell its kind, and than any buffer.
#[test]
fn a_long_table_of_blanks_keeps_its_order() {
    use std::fmt::Write;
    let mut text = format!("{}x y z\n", "# a long comment\n".repeat(100));
    for i in 0..100_000 {
        let _ = writeln!(text, "{i} {}  {}", i * 2, -i);
    }
    let folder = folder();
    let p = read(&put(&folder, "a.txt", text)).expect("a table");
    assert_eq!(p.len(), 100_000);
    assert!((0..100_000).all(|i| p.position()[i] == DVec3::new(i as f64, 2.0 * i as f64, -(i as f64))));
}
