//! CSV: the text itself, what may be left out, and all that can be wrong with it.

use glam::DVec3;
use motes::formats::Precision;

use crate::formats::{bits, csv_bytes, folder, put, read, refused, some};

#[test]
fn a_csv_snapshot_is_the_shortest_text() {
    let mut particles = some(1);
    particles.push(DVec3::new(0.1, -0.0, 1e300), DVec3::new(5e-324, 1e-7, 123_456_789.0), 2.0, 0.0);
    let text = String::from_utf8(csv_bytes(&particles, Precision::Double)).expect("text");
    assert_eq!(text.lines().next(), Some("id,x,y,z,vx,vy,vz,mass"));
    assert_eq!(text.lines().nth(2), Some("1,0.1,-0.0,1e300,5e-324,1e-7,123456789.0,2.0"));
    let text = String::from_utf8(csv_bytes(&some(1), Precision::Single)).expect("text");
    assert_eq!(
        text.lines().nth(1),
        Some("0,0.33333334,-0.00033333333,300000.0,0.57735026,-0.0,0.23333333,0.033333335")
    );
}

#[test]
fn species_are_written_where_there_are_any() {
    let mut particles = some(2);
    particles.species_mut()[1] = 7;
    let text = String::from_utf8(csv_bytes(&particles, Precision::Single)).expect("text");
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines[0], "id,x,y,z,vx,vy,vz,mass,species");
    assert!(lines[1].ends_with(",0") && lines[2].ends_with(",7"), "{text}");
    refused(
        "a.csv",
        "x,y,z,species\n1,2,3,-1\n1,2,3,1.5\n1,2,3\n1,2,3,4294967296\n",
        &[
            "line 2, column species: `-1` is not a whole number from 0 to 4294967295",
            "line 3, column species: `1.5`",
            "line 4, column species: the cell is missing",
            "line 5, column species: `4294967296`",
        ],
    );
    refused("a.csv", "x,y,z,spcies\n", &["unknown column `spcies`; did you mean `species`?"]);
}

#[test]
fn a_large_csv_keeps_its_order() {
    // More than one round of pieces: 32 · 4096 rows.
    let particles = some(140_000);
    let folder = folder();
    let back = read(&put(&folder, "a.csv", csv_bytes(&particles, Precision::Double))).expect("csv");
    assert_eq!(bits(&back), bits(&particles));
}

#[test]
fn a_csv_may_leave_out_much_and_come_in_any_order() {
    let folder = folder();
    let path =
        put(&folder, "a.csv", "# a comment\n name , mass ,x,y,z\n\"Sun, the\",2, 1,2,3\n# more\nEarth,0,4,5,-6e-1\n");
    let p = read(&path).expect("csv");
    assert_eq!(p.position(), [DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 5.0, -0.6)]);
    assert_eq!((p.velocity(), p.mass(), p.size()), (&[DVec3::ZERO; 2][..], &[2.0, 0.0][..], &[0.0; 2][..]));
    assert_eq!(p.species(), [0, 0]);
    let p =
        read(&put(&folder, "b.txt", "size,z,y,x,id,species\n0.5,3,2,1,1,4\n0.25,6,5,4,0,4294967295\n")).expect("csv");
    assert_eq!(p.position(), [DVec3::new(4.0, 5.0, 6.0), DVec3::new(1.0, 2.0, 3.0)]);
    assert_eq!((p.mass(), p.size()), (&[1.0; 2][..], &[0.25, 0.5][..]));
    assert_eq!(p.species(), [u32::MAX, 4]);
}

#[test]
fn a_csv_reports_all_that_is_wrong_at_once() {
    refused(
        "a.csv",
        "# made by hand\nx,y,zz,vx,mas,vx,mass\n1,2,3,4,5,6,nan\n\nfour,1e999,3\n1,2,3,4,5,6,-7,8\n1,2,3,,5,6,7\n",
        &[
            "unknown column `mas`; did you mean `mass`?",
            "unknown column `zz`; did you mean `z`?",
            "the column `vx` is there twice",
            "the column `z` is missing",
            "line 3, column mass: `nan` is not finite",
            "line 5, column x: `four` is not a number",
            "line 5, column y: `1e999` is not finite",
            "line 5, column mass: the cell is missing",
            "line 6: 8 cells, but 7 columns",
            "line 6, column mass: -7.0 is below 0",
        ],
    );
    refused("a.csv", "x,y,z,temperature\n", &["unknown column `temperature`; known are x, y, z, mass"]);
    refused("a.csv", "", &["is empty"]);
    refused("a.csv", "x,y,z\n".to_owned() + &"a,2,3\n".repeat(500), &["line 21", "and 480 more"]);
    refused("a.csv", b"x,y,z\n1,\xff\xfe,3\n", &["line 2, column y", "is not a number"]);
    refused(
        "a.csv",
        "id,x,y,z\n0,1,1,1\n3,1,1,1\n1,1,1,1\n3,1,1,1\n",
        &["line 5: the id 3 is there already, at line 3: ids must differ"],
    );
    refused("a.csv", "id,x,y,z\n-1,1,1,1\n1.5,1,1,1\n", &["`-1` is not a whole number", "`1.5` is not a whole"]);
    refused("a.csv", "id,x,y,z\n4294967295,1,1,1\n", &["ids above 4294967294 are not supported: renumber"]);
}
