//! `motes crowds` on drawings: the bottleneck that is named is that of the same plan as polygons, and it moves with the door.

use std::process::Command;

use serde_json::{Value, json};

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// The report on a plan in a file of this name.
fn report(name: &str, plan: &str, more: &[&str]) -> Value {
    let folder = tempfile::tempdir().expect("a folder");
    let (file, out) = (folder.path().join(name), folder.path().join("out"));
    std::fs::write(&file, plan).expect("a plan");
    let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
    command.arg("crowds").arg(&file).arg("-o").arg(&out).args(["--json", "--backend", "cpu"]).args(more);
    let done = command.output().expect("the program starts");
    let words = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{name}: {words}");
    serde_json::from_slice(&done.stdout).unwrap_or_else(|why| panic!("{why}: {words}"))
}

/// Place and width of the first bottleneck.
fn named(report: &Value) -> [f64; 3] {
    let first = &report["bottlenecks"][0];
    [&first["position"][0], &first["position"][1], &first["width"]].map(number)
}

/// Two rooms of 6 by 8 m with a door of 1.2 m: in each format the report names it, and all leave by the exit with the name of the file.
#[test]
fn the_same_rooms_have_the_same_bottleneck_in_each_format() {
    let corners = json!([
        [0, 0],
        [6, 0],
        [6, 3],
        [6.2, 3],
        [6.2, 0],
        [12, 0],
        [12, 8],
        [6.2, 8],
        [6.2, 4.2],
        [6, 4.2],
        [6, 8],
        [0, 8],
        [0, 0]
    ]);
    let feature = |kind: &str, shape: &str, at: Value| json!({ "type": "Feature", "properties": { "kind": kind, "name": "the way out" }, "geometry": { "type": shape, "coordinates": at } });
    let features = [
        feature("floor", "Polygon", json!([corners])),
        feature("exit", "LineString", json!([[11.5, 0.2], [11.5, 7.8]])),
    ];
    let features = json!({ "type": "FeatureCollection", "features": features }).to_string();
    let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"124mm\" height=\"84mm\" viewBox=\"-0.2 -0.2 12.4 8.4\"><g id=\"walls\" stroke=\"#000\" stroke-width=\"0.2\">\
         <path d=\"M -0.1 -0.1 H 12.1 V 8.1 H -0.1 Z\" fill=\"none\"/><path d=\"M 6.1 0 V 3.8 M 6.1 5 V 8\"/></g>\
         <path d=\"M 11.5 0.2 V 7.8\" stroke=\"red\" stroke-width=\"0.04\" id=\"exit\"><title>the way out</title></path></svg>";
    let line =
        |layer: &str, [a, b, c, d]: [f64; 4]| format!("0\nLINE\n8\n{layer}\n10\n{a}\n20\n{b}\n11\n{c}\n21\n{d}\n");
    let walls = [
        [0.0, 0.0, 12.0, 0.0],
        [12.0, 0.0, 12.0, 8.0],
        [12.0, 8.0, 0.0, 8.0],
        [0.0, 8.0, 0.0, 0.0],
        [6.0, 0.0, 6.0, 3.0],
        [6.2, 0.0, 6.2, 3.0],
        [6.0, 3.0, 6.2, 3.0],
        [6.0, 8.0, 6.0, 4.2],
        [6.2, 8.0, 6.2, 4.2],
        [6.0, 4.2, 6.2, 4.2],
    ];
    let walls: String = walls.into_iter().map(|wall| line("walls", wall)).collect();
    let exit = line("exits", [11.5, 0.2, 11.5, 7.8]);
    let dxf = format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{walls}{exit}0\nENDSEC\n0\nEOF\n"
    );
    let crowd = ["--people", "40", "--start", "0.1,0.1,5.9,7.9"];
    for (name, plan, more) in [
        ("a.geojson", features.as_str(), &[][..]),
        ("a.svg", svg, &["--scale", "1:100", "--origin", "0.2,0.2"]),
        ("a.dxf", &dxf, &[]),
    ] {
        let report = report(name, plan, &[&crowd[..], more].concat());
        let [x, y, width] = named(&report);
        assert!((x - 6.1).hypot(y - 3.6) < 0.5 && (width - 1.2).abs() < 0.1, "{name}: {x} {y}, {width} m wide");
        let exit = &report["exits"][0];
        assert_eq!(exit["count"].as_u64(), Some(40), "{name}");
        assert_eq!(exit["name"].as_str(), Some(if name == "a.dxf" { "exit 1" } else { "the way out" }), "{name}");
    }
}

/// An office of 24 by 14 m on paper, in 1:100: a hall below a corridor of 2 m, three rooms above it, one beside the hall; the corridor ends at two exits. The door
/// of the hall, 1.1 m wide, begins at a distance from the left \[mm on paper\]. Doors with their arcs, desks and words are drawn, too.
fn office(door: f64) -> String {
    let end = door + 11.0;
    format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="250mm" height="150mm" viewBox="-5 -5 250 150">
<defs><g id="desk"><rect width="14" height="7" fill="#555"/><circle cx="7" cy="10" r="2.5" fill="#555"/></g></defs>
<g fill="none" stroke="#1a1a2e" stroke-width="2">
  <path d="M -1 60 V -1 H 241 V 60 M 241 80 V 141 H -1 V 80"/>
  <path d="M 0 59 H 30 M 40 59 H 110 M 120 59 H 190 M 200 59 H 240 M 80 0 V 59 M 160 0 V 59"/>
  <path d="M 0 81 H {door} M {end} 81 H 190 M 202 81 H 240 M 150 81 V 140" stroke-width="2"/>
</g>
<circle cx="60" cy="112" r="3" fill="#1a1a2e"/><path d="M 100 109 h 6 v 6 h -6 z" fill="#1a1a2e"/>
<g stroke="#d62828" stroke-width="1.5"><path id="exit-west" d="M -1 60 V 80"/><path id="exit-east" d="M 241 60 V 80"/></g>
<g id="doors" fill="none" stroke="#000" stroke-width="0.4"><path d="M {door} 81 v 11 a 11 11 0 0 0 11 -11"/></g>
<g id="furniture"><use href="#desk" x="10" y="10"/><use href="#desk" x="170" y="20"/><use href="#desk" x="200" y="110"/></g>
<text x="70" y="130" font-size="6">Hall</text>
</svg>"##
    )
}

#[test]
#[ignore = "minutes on a software adapter: `tests/run --test physics --test commands -- --include-ignored` runs it"]
fn the_bottleneck_of_a_drawn_office_moves_with_the_door() {
    let crowd = ["--scale", "1:100", "--people", "60", "--start", "0.6,0.6,15.3,6.2"];
    for (door, middle) in [(20.0, 3.05), (110.0, 12.05)] {
        let report = report("office.svg", &office(door), &crowd);
        let [x, y, width] = named(&report);
        // The drawing has a margin of 0.5 m; the door's wall is 5.9 m above the lower wall's inner side.
        assert!((x - middle).hypot(y - 6.4) < 0.5 && (width - 1.1).abs() < 0.1, "{door}: {x} {y}, {width} m wide");
        assert!(report["bottlenecks"][0]["held_up"].as_u64() > Some(30), "{}", report["bottlenecks"][0]);
        let remarks = report["remarks"].to_string();
        assert!(remarks.contains("1 <text>") && remarks.contains("named doors, furniture or text"), "{remarks}");
        assert_eq!(report["exits"].as_array().map(Vec::len), Some(2));
    }
}
